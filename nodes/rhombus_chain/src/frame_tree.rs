//! Where frames are relative to another: what the parameters, `/tf` and `/tf_static` say.
//!
//! Transforms come from the parameters (where body and devices stand in the scene) and from `/tf` and `/tf_static`.
//! A transform is the latest one heard: stamps are not interpolated, because the frames of a session (bases of
//! devices, the body) stand still and a stale answer is better than a missing force.

use std::collections::BTreeMap;

use crate::Pose;

/// More frames than this are a broken publisher, not a scene.
const MAX_FRAMES: usize = 10_000;

/// The frame of a message as tf knows it: without the leading "/" that older drivers still send.
pub fn frame_of_message(frame_id: &str) -> &str {
    frame_id.strip_prefix('/').unwrap_or(frame_id)
}

/// Where a frame stands in its parent.
#[derive(Clone, Debug, PartialEq)]
struct Edge {
    parent: String,
    parent_from_child: Pose,
}

/// All transforms known to a node.
#[derive(Clone, Debug, Default)]
pub struct FrameTree {
    heard: BTreeMap<String, Edge>,
    from_parameters: BTreeMap<String, Edge>,
    ignored: u64,
    version: u64,
}

impl FrameTree {
    /// A tree that knows nothing.
    pub fn new() -> FrameTree {
        FrameTree::default()
    }

    /// Add a transform that the parameters give. A transform heard for the same child is preferred, unless it leads
    /// nowhere.
    pub fn set_from_parameters(&mut self, parent: &str, child: &str, parent_from_child: Pose) {
        self.version += 1;
        self.from_parameters.insert(child.to_owned(), Edge { parent: parent.to_owned(), parent_from_child });
    }

    /// Take over a transform from `/tf` or `/tf_static`: `[x, y, z, qx, qy, qz, qw]` of the child in the parent.
    /// One that is not finite, whose quaternion is not of unit length (within 1e-3), or that has no child or is its
    /// own parent, is ignored and counted.
    pub fn hear(&mut self, parent: &str, child: &str, parent_from_child: [f64; 7]) {
        let (parent, child) = (frame_of_message(parent), frame_of_message(child));
        let known = self.heard.contains_key(child);
        let acceptable = !child.is_empty() && parent != child && (known || self.heard.len() < MAX_FRAMES);
        let (true, Ok(parent_from_child)) = (acceptable, Pose::from_array(parent_from_child)) else {
            self.ignored += 1;
            return;
        };
        let edge = Edge { parent: parent.to_owned(), parent_from_child };
        if self.heard.get(child) != Some(&edge) {
            self.version += 1;
            self.heard.insert(child.to_owned(), edge);
        }
    }

    /// Number of transforms that were ignored because they made no sense.
    pub fn ignored(&self) -> u64 {
        self.ignored
    }

    /// Changes whenever an answer of [`FrameTree::lookup`] may have changed.
    pub fn version(&self) -> u64 {
        self.version
    }

    /// Pose of the frame `source` in the frame `target` (`target_from_source`), or none when nothing connects them.
    /// Ends on any input: a loop of transforms connects nothing.
    pub fn lookup(&self, target: &str, source: &str) -> Option<Pose> {
        if target.is_empty() || source.is_empty() {
            return None;
        }
        self.lookup_preferring(&self.heard, &self.from_parameters, target, source)
            .or_else(|| self.lookup_preferring(&self.from_parameters, &self.heard, target, source))
    }

    fn lookup_preferring(
        &self,
        first: &BTreeMap<String, Edge>,
        second: &BTreeMap<String, Edge>,
        target: &str,
        source: &str,
    ) -> Option<Pose> {
        let target_ancestors = ancestors(first, second, target);
        let source_ancestors = ancestors(first, second, source);
        source_ancestors.iter().find_map(|(frame, ancestor_from_source)| {
            let (_, ancestor_from_target) = target_ancestors.iter().find(|(other, _)| other == frame)?;
            Some(ancestor_from_target.inverse() * *ancestor_from_source)
        })
    }
}

/// The frame itself and its parents up to the root (or to the first repetition), each with `ancestor_from_frame`.
fn ancestors<'a>(
    first: &'a BTreeMap<String, Edge>,
    second: &'a BTreeMap<String, Edge>,
    frame: &'a str,
) -> Vec<(&'a str, Pose)> {
    let mut found = vec![(frame, Pose::IDENTITY)];
    let mut current = (frame, Pose::IDENTITY);
    while let Some(edge) = first.get(current.0).or_else(|| second.get(current.0)) {
        if found.iter().any(|(frame, _)| *frame == edge.parent) {
            break;
        }
        current = (&edge.parent, edge.parent_from_child * current.1);
        found.push(current);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DQuat, DVec3};

    fn shift(x: f64) -> Pose {
        Pose { translation: DVec3::new(x, 0.0, 0.0), rotation: DQuat::IDENTITY }
    }

    fn shift_message(x: f64) -> [f64; 7] {
        [x, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    }

    fn x_of(pose: Option<Pose>) -> Option<f64> {
        pose.map(|pose| pose.translation.x)
    }

    #[test]
    fn the_slash_of_older_drivers_is_no_part_of_a_frame() {
        assert_eq!(frame_of_message("/old_driver"), "old_driver");
        assert_eq!(frame_of_message("tool"), "tool");
    }

    #[test]
    fn a_pose_is_carried_through_parents_up_and_down_the_tree() {
        let mut tree = FrameTree::new();
        tree.set_from_parameters("scene", "body", shift(1.0));
        tree.hear("world", "scene", shift_message(10.0));
        tree.hear("world", "arm", shift_message(100.0));
        tree.hear("arm", "tool", shift_message(1000.0));
        assert_eq!(x_of(tree.lookup("body", "tool")), Some(1089.0));
        assert_eq!(x_of(tree.lookup("tool", "body")), Some(-1089.0));
        assert_eq!(x_of(tree.lookup("scene", "scene")), Some(0.0));
        assert_eq!(tree.lookup("body", "nowhere"), None);
        assert_eq!(tree.lookup("body", ""), None);
    }

    #[test]
    fn rotations_compose_in_the_order_of_the_tree() {
        let quarter_turn = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2);
        let mut tree = FrameTree::new();
        tree.set_from_parameters("scene", "base", Pose { translation: DVec3::X, rotation: quarter_turn });
        tree.hear("base", "tool", [2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
        let scene_from_tool = tree.lookup("scene", "tool").unwrap();
        assert!(scene_from_tool.translation.abs_diff_eq(DVec3::new(1.0, 2.0, 0.0), 1e-12));
        assert!(scene_from_tool.rotate(DVec3::X).abs_diff_eq(DVec3::Y, 1e-12));
    }

    #[test]
    fn the_latest_transform_heard_counts_and_replaces_the_parameters() {
        let mut tree = FrameTree::new();
        tree.set_from_parameters("scene", "base", shift(1.0));
        assert_eq!(x_of(tree.lookup("scene", "base")), Some(1.0));
        tree.hear("scene", "base", shift_message(2.0));
        let version = tree.version();
        tree.hear("scene", "base", shift_message(2.0));
        assert_eq!(tree.version(), version, "the same transform again changes nothing");
        tree.hear("/scene", "/base", shift_message(3.0));
        assert!(tree.version() > version);
        assert_eq!(x_of(tree.lookup("scene", "base")), Some(3.0));
    }

    #[test]
    fn a_transform_heard_that_leads_nowhere_does_not_hide_the_parameters() {
        let mut tree = FrameTree::new();
        tree.set_from_parameters("scene", "left/base", shift(1.0));
        tree.hear("left/scene", "left/base", shift_message(7.0));
        assert_eq!(x_of(tree.lookup("scene", "left/base")), Some(1.0));
    }

    #[test]
    fn loops_end_and_connect_nothing_new() {
        let mut tree = FrameTree::new();
        tree.hear("a", "b", shift_message(1.0));
        tree.hear("b", "c", shift_message(1.0));
        tree.hear("c", "a", shift_message(1.0));
        assert_eq!(tree.lookup("scene", "a"), None);
        assert!(tree.lookup("a", "b").is_some());
    }

    #[test]
    fn senseless_transforms_are_ignored_and_counted() {
        let mut tree = FrameTree::new();
        tree.hear("scene", "base", shift_message(5.0));
        tree.hear("scene", "base", shift_message(f64::NAN));
        tree.hear("scene", "base", shift_message(f64::INFINITY));
        tree.hear("scene", "base", [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.9]);
        tree.hear("scene", "base", [0.0; 7]);
        tree.hear("scene", "", shift_message(0.0));
        tree.hear("scene", "scene", shift_message(0.0));
        assert_eq!(tree.ignored(), 6);
        assert_eq!(x_of(tree.lookup("scene", "base")), Some(5.0));
    }
}
