//! Which topics of a recording say what to the model.

use anyhow::{Context, bail, ensure};
use recording::messages::{Bool, JointState, Joy, PoseStamped, TFMessage, TransformStamped, is_same};
use recording::{Playback, RecordedTopic, Recording, cdr::Message, remapped};
use scene::topic;

/// What a message of a topic means to the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Input {
    /// A pose of this device.
    Pose(usize),
    /// The same, as CRTK had it before 2021: the transform of the handle in its frame.
    Transform(usize),
    /// Hold the surface.
    Grasp(usize),
    /// Opening of the gripper.
    Gripper(usize),
    /// Let the hand move without the probe.
    Clutch(usize),
    /// Where frames are.
    Frames,
}

/// The inputs in a recording.
#[derive(Clone, Debug)]
pub(super) struct Inputs {
    /// Where the session's topics stand, "/" for none.
    pub(super) namespace: String,
    /// By the number of the topic.
    of_topic: Vec<Option<Input>>,
}

impl Inputs {
    /// Finds the topics of `devices` (sub-namespaces, "" for the session's own). `namespace`: where the session's topics
    /// stand; what fits the recording when `None`. `remap`: recorded names and the names they have for the model.
    ///
    /// # Errors
    /// No poses, poses of several sessions, a topic of another type or definition, names that cannot be meant.
    pub(super) fn find(
        recording: &Recording,
        devices: &[String],
        namespace: Option<&str>,
        remap: &[(String, String)],
    ) -> anyhow::Result<Self> {
        let recorded: Vec<&str> =
            recording.topics().iter().map(|recorded| recorded.topic.name.as_str()).collect();
        let heard = remapped(&recorded, remap).context("--remap")?;
        let namespace = match namespace {
            Some(namespace) => namespace.to_owned(),
            None => found_namespace(&heard, devices)?,
        };
        let mut of_topic = vec![None; heard.len()];
        for ((recorded, name), slot) in recording.topics().iter().zip(&heard).zip(&mut of_topic) {
            *slot = input(&recorded.topic.type_name, name, &namespace, devices)
                .and_then(|found| found.map(|input| same(recorded).map(|()| input)).transpose())
                .with_context(|| format!("{}: {}", recording.path().display(), recorded.topic.name))?;
        }
        let inputs = Self { namespace, of_topic };
        let has_poses = inputs.of_topic.iter().zip(recording.topics()).any(|(input, recorded)| {
            matches!(input, Some(Input::Pose(_) | Input::Transform(_))) && recorded.message_count > 0
        });
        let wanted =
            || devices.iter().map(|device| topic::of_device(&inputs.namespace, device, topic::MEASURED_CP));
        ensure!(
            has_poses,
            "{}: no poses on {}; its topics are {}; accepted: --namespace, `devices` in the parameter file, or --remap FROM:={}",
            recording.path().display(),
            wanted().collect::<Vec<_>>().join(" or "),
            names(recording),
            topic::MEASURED_CP,
        );
        Ok(inputs)
    }

    /// What a topic means, by its number.
    pub(super) fn of(&self, topic: usize) -> Option<Input> {
        self.of_topic.get(topic).copied().flatten()
    }

    /// These topics alone, in the order of a replay.
    pub(super) fn playback(&self) -> Playback {
        let topics = (0..self.of_topic.len()).filter(|&topic| self.of(topic).is_some()).collect();
        Playback { topics, ..Playback::default() }
    }
}

fn names(recording: &Recording) -> String {
    let names: Vec<&str> = recording.topics().iter().map(|recorded| recorded.topic.name.as_str()).collect();
    if names.is_empty() { "none".to_owned() } else { names.join(" ") }
}

/// The namespace in which the first device that has poses is; the root where that fits.
fn found_namespace(heard: &[String], devices: &[String]) -> anyhow::Result<String> {
    let mut found: Vec<String> = Vec::new();
    for device in devices.iter().filter(|device| !device.starts_with('/')) {
        let end = topic::of_device("/", device, topic::MEASURED_CP);
        let namespaces = heard.iter().filter_map(|name| name.strip_suffix(&end));
        for namespace in namespaces.map(|namespace| if namespace.is_empty() { "/" } else { namespace }) {
            if !found.iter().any(|known| known == namespace) {
                found.push(namespace.to_owned());
            }
        }
    }
    match found.as_slice() {
        [] => Ok("/".to_owned()),
        [one] => Ok(one.clone()),
        several if several.iter().any(|namespace| namespace == "/") => Ok("/".to_owned()),
        several => bail!(
            "poses in the namespaces {}, and the parameters have {} of them; accepted: --namespace NAME for one of them, or \
             `devices` in the parameter file for all",
            several.join(" "),
            devices.len(),
        ),
    }
}

/// What a topic of this name is to the model.
fn input(type_name: &str, name: &str, namespace: &str, devices: &[String]) -> anyhow::Result<Option<Input>> {
    let is = |input: Input, accepted: &[&str]| {
        ensure!(accepted.contains(&type_name), "type {type_name}; accepted: {}", accepted.join(" or "));
        Ok(Some(input))
    };
    if name == topic::TF || name == topic::TF_STATIC {
        return is(Input::Frames, &[TFMessage::TYPE_NAME]);
    }
    for (index, device) in devices.iter().enumerate() {
        let is_named = |topic: &str| name == topic::of_device(namespace, device, topic);
        if is_named(topic::MEASURED_CP) {
            let input = match type_name == TransformStamped::TYPE_NAME {
                true => Input::Transform(index),
                false => Input::Pose(index),
            };
            return is(input, &[PoseStamped::TYPE_NAME, TransformStamped::TYPE_NAME]);
        }
        if is_named(topic::GRASP) {
            return is(Input::Grasp(index), &[Bool::TYPE_NAME]);
        }
        if is_named(topic::GRIPPER_MEASURED_JS) {
            return is(Input::Gripper(index), &[JointState::TYPE_NAME]);
        }
        if is_named(topic::CLUTCH) {
            return is(Input::Clutch(index), &[Joy::TYPE_NAME]);
        }
    }
    Ok(None)
}

/// Whether a topic can be decoded.
fn same(recorded: &RecordedTopic) -> anyhow::Result<()> {
    let topic = &recorded.topic;
    ensure!(topic.serialization_format == "cdr", "encoding {:?}; accepted: cdr", topic.serialization_format);
    is_same(&topic.type_name, &topic.definition).map(drop).map_err(anyhow::Error::msg)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn namespace(heard: &[&str], devices: &[&str]) -> anyhow::Result<String> {
        let owned = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        found_namespace(&owned(heard), &owned(devices))
    }

    #[test]
    fn the_namespace_is_the_one_that_has_the_devices_poses() {
        assert_eq!(namespace(&["/measured_cp", "/tf"], &[""]).unwrap(), "/");
        assert_eq!(namespace(&["/or/measured_cp"], &[""]).unwrap(), "/or");
        assert_eq!(
            namespace(&["/or/left/measured_cp", "/or/right/measured_cp"], &["left", "right"]).unwrap(),
            "/or"
        );
        assert_eq!(namespace(&["/or/left/measured_cp"], &["left", "right"]).unwrap(), "/or", "one is silent");
        assert_eq!(namespace(&["/measured_cp", "/or/measured_cp"], &[""]).unwrap(), "/");
        assert_eq!(namespace(&["/tf"], &[""]).unwrap(), "/");
        let several = namespace(&["/left/measured_cp", "/right/measured_cp"], &[""]).unwrap_err().to_string();
        assert!(several.contains("/left /right") && several.contains("--namespace"), "{several}");
    }

    #[test]
    fn a_topic_of_another_type_is_refused_and_other_topics_are_left_alone() {
        let devices = ["left".to_owned()];
        let of = |name: &str, type_name: &str| input(type_name, name, "/or", &devices);
        assert_eq!(
            of("/or/left/measured_cp", "geometry_msgs/msg/PoseStamped").unwrap(),
            Some(Input::Pose(0))
        );
        let older = of("/or/left/measured_cp", "geometry_msgs/msg/TransformStamped").unwrap();
        assert_eq!(older, Some(Input::Transform(0)));
        assert_eq!(of("/or/left/measured_cv", "geometry_msgs/msg/TwistStamped").unwrap(), None);
        assert_eq!(of("/elsewhere/grasp", "std_msgs/msg/String").unwrap(), None);
        let error = of("/or/left/grasp", "std_msgs/msg/String").unwrap_err().to_string();
        assert_eq!(error, "type std_msgs/msg/String; accepted: std_msgs/msg/Bool");
    }
}
