//! Where a target on `pointer_target` is for the device: what its frame says, and whether it is a place at all.

use devices::pointer::{NotATarget, Target};
use glam::DVec3;
use rhombus_chain::{Pose, frame_of_message};
use thiserror::Error;

/// Why a target is not followed, whenever it comes.
#[derive(Clone, Debug, Error, PartialEq)]
pub(crate) enum NoTarget {
    #[error("frame_id is \"{frame}\"; accepted here are {accepted}")]
    Frame { frame: String, accepted: String },
    #[error(transparent)]
    Place(#[from] NotATarget),
}

/// The frames in which a target may come, with the way from each to the device.
#[derive(Clone, Debug)]
pub(crate) struct PointerFrames {
    frames: [Frame; 3],
}

#[derive(Clone, Debug)]
struct Frame {
    name: String,
    base_from_frame: Pose,
    motion_scale: f64,
}

impl PointerFrames {
    /// `base`, `scene` and `body` are the frames' names. A place in the base's frame is where the handle is to go, as
    /// `measured_cp` says it; one in the scene or on the body is where the probe is to go, which moves `motion_scale` times as far.
    pub(crate) fn new(
        base: &str,
        (scene, scene_from_base): (&str, Pose),
        (body, base_from_body): (&str, Pose),
        motion_scale: f64,
    ) -> PointerFrames {
        let frame = |name: &str, base_from_frame, motion_scale| Frame {
            name: name.to_owned(),
            base_from_frame,
            motion_scale,
        };
        PointerFrames {
            frames: [
                frame(base, Pose::IDENTITY, 1.0),
                frame(scene, scene_from_base.inverse(), motion_scale),
                frame(body, base_from_body, motion_scale),
            ],
        }
    }

    /// The target in the device frame, to be followed for `valid_for_s`. No frame means the device's own.
    ///
    /// # Errors
    /// [`NoTarget`].
    pub(crate) fn target(
        &self,
        frame_id: &str,
        position: DVec3,
        valid_for_s: f64,
    ) -> Result<Target, NoTarget> {
        let name = frame_of_message(frame_id);
        let Some(frame) = self.frames.iter().find(|frame| name.is_empty() || frame.name == name) else {
            let accepted =
                self.frames.iter().map(|frame| format!("\"{}\", ", frame.name)).collect::<String>();
            return Err(NoTarget::Frame { frame: name.to_owned(), accepted: accepted + "\"\"" });
        };
        let position_in_device = frame.base_from_frame.transform_point(position) / frame.motion_scale;
        if position.is_finite() {
            Ok(Target::new(position_in_device, valid_for_s)?)
        } else {
            Err(NotATarget::NotFinite(position).into())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;

    fn frames(motion_scale: f64) -> PointerFrames {
        let turn = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2);
        let scene_from_base = Pose { translation: DVec3::new(0.1, 0.0, 0.0), rotation: turn };
        let scene_from_body = Pose { translation: DVec3::new(0.0, 0.0, 0.1), rotation: DQuat::IDENTITY };
        let base_from_body = scene_from_base.inverse() * scene_from_body;
        PointerFrames::new("left/base", ("scene", scene_from_base), ("body", base_from_body), motion_scale)
    }

    fn position(frames: &PointerFrames, frame_id: &str) -> DVec3 {
        frames.target(frame_id, DVec3::new(0.1, 0.02, 0.03), 0.3).unwrap().position()
    }

    #[test]
    fn the_same_place_is_the_same_in_every_frame() {
        let frames = frames(1.0);
        assert_eq!(position(&frames, ""), DVec3::new(0.1, 0.02, 0.03));
        assert_eq!(position(&frames, "left/base"), position(&frames, "/left/base"));
        // The base stands at x = 0.1 in the scene, its x axis along the scene's y.
        assert!(position(&frames, "scene").distance(DVec3::new(0.02, 0.0, 0.03)) < 1e-15);
        assert!(position(&frames, "body").distance(DVec3::new(0.02, 0.0, 0.13)) < 1e-15);
    }

    #[test]
    fn the_probe_moves_motion_scale_times_as_far_as_the_handle() {
        let frames = frames(2.0);
        assert_eq!(position(&frames, "left/base"), DVec3::new(0.1, 0.02, 0.03), "where the handle is to go");
        assert!(position(&frames, "body").distance(DVec3::new(0.01, 0.0, 0.065)) < 1e-15);
    }

    #[test]
    fn another_frame_and_a_place_that_is_not_finite_are_refused_in_words() {
        let refusal =
            |frame: &str, x: f64| frames(1.0).target(frame, DVec3::splat(x), 0.3).unwrap_err().to_string();
        assert_eq!(
            refusal("map", 0.0),
            "frame_id is \"map\"; accepted here are \"left/base\", \"scene\", \"body\", \"\""
        );
        for x in [f64::NAN, f64::INFINITY, f64::MAX] {
            assert!(refusal("body", x).contains("not finite"), "{x}");
        }
    }

    #[test]
    fn a_place_that_the_handle_does_not_reach_is_refused_whatever_frame_names_it() {
        let far = DVec3::new(0.1, 0.0, 0.08);
        let refusal = |frame: &str, motion_scale| frames(motion_scale).target(frame, far, 0.3);
        // 0.18 m over the base, above what the handle reaches, unless the probe moves twice as far as the handle.
        let out = refusal("body", 1.0).unwrap_err();
        assert!(matches!(out, NoTarget::Place(NotATarget::OutOfReach(_))), "{out}");
        assert!(refusal("body", 2.0).is_ok() && refusal("left/base", 1.0).is_ok());
    }
}
