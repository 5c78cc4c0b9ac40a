//! Where body, devices and probes stand, for tf.

use node_kit::{NodeKit, PublishError, Publisher, topics, transform_stamped};
use r2r::tf2_msgs::msg::TFMessage;
use rhombus_chain::Pose;
use scene::Scene;

use crate::device_view::InFrame;

/// Last part of the frame of a device's probe.
const PROBE: &str = "probe";

/// Publishes `/tf_static` once and `/tf` for the probes.
pub(crate) struct Transforms {
    moving: Publisher<TFMessage>,
    probe_frames: Vec<String>,
}

impl Transforms {
    /// Say where body and devices stand.
    pub(crate) fn new(kit: &mut NodeKit, scene: &Scene) -> anyhow::Result<Transforms> {
        let moving = kit.publish(&topics::TF, "")?;
        let fixed = kit.publish(&topics::TF_STATIC, "")?;
        let names = |device: &str, parameter: &str| kit.frame_id_of_device(device, parameter);
        fixed.publish(&fixed_transforms(scene, names))?;
        let probe_frames = scene.session.devices.iter().map(|device| names(device, PROBE)).collect();
        Ok(Transforms { moving, probe_frames })
    }

    /// Whether anybody would hear where the probes are.
    pub(crate) fn are_read(&self) -> bool {
        self.moving.readers() > 0
    }

    /// Say where the probes are: for each device its pose and the stamp it was measured at.
    pub(crate) fn publish_probes(&self, probes: &[Option<(i64, InFrame<Pose>)>]) -> Result<(), PublishError> {
        let transforms: Vec<_> = probes
            .iter()
            .zip(&self.probe_frames)
            .filter_map(|(probe, frame)| {
                let (stamp_ns, probe) = probe.as_ref()?;
                Some(transform_stamped(*stamp_ns, &probe.frame_id, frame, &probe.value))
            })
            .collect();
        if transforms.is_empty() {
            return Ok(());
        }
        self.moving.publish(&TFMessage { transforms })
    }
}

/// The body and, where there is only one, the device in the scene; of several devices each driver says where its own
/// stands. `names` makes a frame of a device's sub-namespace ("" for the node's own) and a parameter. A device whose
/// frame's name is given verbatim ("/PSM1_base") stands in somebody else's tree, unless the parameters say where it
/// stands: a frame with two parents would break tf.
fn fixed_transforms(scene: &Scene, names: impl Fn(&str, &str) -> String) -> TFMessage {
    let scene_frame = names("", &scene.session.scene_frame_id);
    let body = (names("", &scene.body.frame_id), scene.body.scene_from_body);
    let is_ours =
        !scene.device.frame_id.starts_with('/') || scene.parameters().is_given("device.scene_from_device");
    let device = match scene.session.devices.as_slice() {
        [device] if is_ours => Some((names(device, &scene.device.frame_id), scene.device.scene_from_device)),
        _ => None,
    };
    let transforms = std::iter::once(body)
        .chain(device.filter(|(frame, _)| *frame != scene_frame))
        .map(|(frame, scene_from_frame)| transform_stamped(0, &scene_frame, &frame, &scene_from_frame));
    TFMessage { transforms: transforms.collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::frame_id;
    use scene::{Origin, Value};

    fn frames(namespace: &str, values: &[(&str, Value)]) -> Vec<(String, String)> {
        let values = values.iter().map(|(name, value)| ((*name).to_owned(), value.clone()));
        let scene = Scene::from_values(values, Origin::named("a test")).unwrap();
        let names = |device: &str, parameter: &str| frame_id(&format!("{namespace}/{device}"), parameter);
        let transforms = fixed_transforms(&scene, names).transforms;
        transforms.into_iter().map(|t| (t.header.frame_id, t.child_frame_id)).collect()
    }

    fn pairs(expected: &[(&str, &str)]) -> Vec<(String, String)> {
        expected.iter().map(|(parent, child)| ((*parent).to_owned(), (*child).to_owned())).collect()
    }

    #[test]
    fn body_and_device_stand_in_the_scene_of_their_namespace() {
        assert_eq!(frames("", &[]), pairs(&[("scene", "body"), ("scene", "device_base")]));
        let left = pairs(&[("left/scene", "left/body"), ("left/scene", "left/device_base")]);
        assert_eq!(frames("/left", &[]), left);
    }

    #[test]
    fn a_single_device_has_its_frame_and_of_several_each_driver_says_where_it_stands() {
        let devices = |names: &[&str]| {
            ("devices", Value::StringArray(names.iter().map(|name| (*name).to_owned()).collect()))
        };
        let left = [("scene", "body"), ("scene", "left/device_base")];
        assert_eq!(frames("", &[devices(&["left"])]), pairs(&left));
        assert_eq!(frames("", &[devices(&["left", "right"])]), pairs(&left[..1]));
    }

    #[test]
    fn a_frame_of_somebody_elses_tree_gets_no_second_parent() {
        let base = ("device.frame_id", Value::String("/PSM1_base".to_owned()));
        assert_eq!(frames("", std::slice::from_ref(&base)), pairs(&[("scene", "body")]));
        let pose = Value::DoubleArray(vec![0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 1.0]);
        let given = [base, ("device.scene_from_device", pose)];
        assert_eq!(frames("", &given), pairs(&[("scene", "body"), ("scene", "PSM1_base")]));
    }
}
