//! Where the frame of a device's poses is, remembered from pose to pose.

use node_kit::{FrameTree, frames};
use rhombus_chain::Pose;

/// The last frame looked up, and what was found.
#[derive(Debug, Default)]
pub(crate) struct Place {
    frame_id: String,
    version: Option<u64>,
    body_from_frame: Option<Pose>,
}

impl Place {
    /// `body_from_frame`, looked up only when the frame or any transform has changed since the last call.
    pub(crate) fn find(&mut self, tree: &FrameTree, body_frame: &str, frame_id: &str) -> Option<Pose> {
        if self.version != Some(tree.version()) || self.frame_id != frame_id {
            self.version = Some(tree.version());
            frame_id.clone_into(&mut self.frame_id);
            self.body_from_frame = tree.lookup(body_frame, frames::frame_of_message(frame_id));
        }
        self.body_from_frame
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_follows_the_frame_of_the_pose_and_the_transforms() {
        let mut tree = FrameTree::new();
        tree.hear("body", "left", [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
        tree.hear("body", "right", [2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
        let mut place = Place::default();
        let mut x =
            |tree: &FrameTree, frame: &str| place.find(tree, "body", frame).map(|pose| pose.translation.x);
        assert_eq!(x(&tree, "left"), Some(1.0));
        assert_eq!(x(&tree, "/right"), Some(2.0));
        assert_eq!(x(&tree, "nowhere"), None);
        tree.hear("body", "nowhere", [3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
        assert_eq!(x(&tree, "nowhere"), Some(3.0));
    }
}
