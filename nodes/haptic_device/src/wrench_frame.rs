//! In which axes a commanded wrench is given. CRTK says it by the topic's name, ROS by the frame of the header; both must
//! agree, because a force in the wrong axes is a force in the wrong direction.

use devices::Axes;
use rhombus_chain::frame_of_message;

/// The two frames of a device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct DeviceFrames {
    /// Stands still: "left/device_base".
    pub(crate) base: String,
    /// Moves with the handle: "left/device_tip".
    pub(crate) tip: String,
}

impl DeviceFrames {
    /// The tip is named after the base: "device_base" and "device_tip", "wand" and "wand_tip".
    pub(crate) fn new(base: String) -> DeviceFrames {
        let tip = format!("{}_tip", base.strip_suffix("_base").unwrap_or(&base));
        DeviceFrames { base, tip }
    }

    /// The frame in which wrenches of these axes are published.
    pub(crate) fn of(&self, axes: Axes) -> &str {
        match axes {
            Axes::Base => &self.base,
            Axes::Tip => &self.tip,
        }
    }

    /// Whether a wrench that shall have these axes has them: its header names the frame, or none.
    pub(crate) fn check(&self, axes: Axes, frame_id: &str) -> Result<(), String> {
        let (frame, own) = (frame_of_message(frame_id), self.of(axes));
        if frame.is_empty() || frame == own {
            return Ok(());
        }
        Err(format!("frame_id is \"{frame}\"; accepted here are \"{own}\" and \"\""))
    }
}

/// The axes of `body/` wrenches.
pub(crate) fn body_axes(absolute: bool) -> Axes {
    if absolute { Axes::Base } else { Axes::Tip }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tip_is_named_after_the_base() {
        for (base, tip) in [
            ("device_base", "device_tip"),
            ("left/device_base", "left/device_tip"),
            ("PSM1_base", "PSM1_tip"),
            ("wand", "wand_tip"),
        ] {
            assert_eq!(DeviceFrames::new(base.to_owned()).tip, tip);
        }
    }

    #[test]
    fn a_wrench_in_other_axes_than_its_topics_is_refused_and_one_without_a_frame_is_not() {
        let frames = DeviceFrames::new("left/device_base".to_owned());
        let accepts = |axes, frame: &str| frames.check(axes, frame).is_ok();
        for axes in [Axes::Base, body_axes(true)] {
            assert!(
                accepts(axes, "") && accepts(axes, "left/device_base") && accepts(axes, "/left/device_base")
            );
            assert!(!accepts(axes, "left/device_tip") && !accepts(axes, "device_base"));
        }
        let tip = body_axes(false);
        assert!(accepts(tip, "") && accepts(tip, "left/device_tip") && !accepts(tip, "left/device_base"));
        let refusal = frames.check(tip, "elsewhere").unwrap_err();
        assert_eq!(refusal, "frame_id is \"elsewhere\"; accepted here are \"left/device_tip\" and \"\"");
    }
}
