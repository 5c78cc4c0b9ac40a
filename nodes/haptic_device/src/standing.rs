//! Where the device's base stands in the scene: said once on `/tf_static`, and kept for whoever comes later.

use anyhow::Result;
use node_kit::{NodeKit, Publisher, topics, transform_stamped};
use r2r::tf2_msgs::msg::TFMessage;
use scene::Scene;

/// Says where the base stands for as long as it is kept; nothing when the base's frame is in somebody else's tree: one
/// named verbatim ("/PSM1_base") that no parameter has placed. A frame with two parents would break tf.
pub(crate) struct Standing {
    _publisher: Option<Publisher<TFMessage>>,
}

impl Standing {
    /// `base` is the frame of the device's poses.
    pub(crate) fn new(kit: &mut NodeKit, scene: &Scene, base: &str) -> Result<Standing> {
        let scene_frame = kit.frame_id_of_session(&scene.session.devices, &scene.session.scene_frame_id);
        let is_ours = !scene.device.frame_id.starts_with('/')
            || scene.parameters().is_given("device.scene_from_device");
        if !is_ours || scene_frame == base {
            return Ok(Standing { _publisher: None });
        }
        let publisher = kit.publish(&topics::TF_STATIC, "")?;
        let transform = transform_stamped(0, &scene_frame, base, &scene.device.scene_from_device);
        publisher.publish(&TFMessage { transforms: vec![transform] })?;
        Ok(Standing { _publisher: Some(publisher) })
    }
}
