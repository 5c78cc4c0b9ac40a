//! What there is to say about a topic.

use super::topic::{DefinitionState, TopicReport};
use super::values::{is_pose, look_at};
use crate::cdr::Message as _;
use crate::messages::{Bool, JointState, Joy, PoseStamped, TransformStamped, WrenchStamped};

/// Topics of this product by their last words, and the types they are played with.
const NAMED: &[(&str, &[&str])] = &[
    ("measured_cp", &[PoseStamped::TYPE_NAME, TransformStamped::TYPE_NAME]),
    ("servo_cf", &[WrenchStamped::TYPE_NAME]),
    ("gripper/measured_js", &[JointState::TYPE_NAME]),
    ("grasp", &[Bool::TYPE_NAME]),
    ("clutch", &[Joy::TYPE_NAME]),
];

impl TopicReport {
    /// Whether it says where a device is.
    pub(super) fn is_pose(&self) -> bool {
        is_pose(&self.type_name)
    }

    /// What makes messages of it unusable.
    pub(super) fn problems(&self) -> Vec<String> {
        let Self { name, type_name, messages, recorded, .. } = self;
        let mut problems = Vec::new();
        if recorded > messages {
            problems.push(format!("{name}: {messages} of {recorded} recorded messages can be read"));
        }
        if let DefinitionState::Differs(reason) = &self.definition {
            problems.push(format!("{name}: recorded with another definition of {type_name}: {reason}"));
        } else if self.is_of_unknown_encoding() {
            let format = &self.serialization_format;
            problems.push(format!("{name}: its messages are encoded as {format:?}; accepted: \"cdr\""));
        } else if let Some(failures) = &self.undecodable {
            let (count, at, reason) = (failures.messages, failures.first_at, &failures.reason);
            problems.push(format!(
                "{name}: {count} of {messages} messages cannot be decoded; the first is message {at}: {reason}"
            ));
        }
        problems
    }

    /// How many of its messages are not what their type says here; of a type that is not known here that is not known.
    pub(super) fn unlike_its_type(&self) -> u64 {
        match (&self.definition, &self.undecodable) {
            (DefinitionState::Differs(_), _) => self.messages,
            (_, undecodable) => undecodable.as_ref().map_or(0, |failures| failures.messages),
        }
    }

    /// What is odd about it.
    pub(super) fn remarks(&self) -> Vec<String> {
        let Self { name, type_name, messages, .. } = self;
        let mut remarks = Vec::new();
        let mut remark = |sentence: String| remarks.push(format!("{name}: {sentence}"));
        if let Some(accepted) = self.expected_types()
            && !accepted.contains(&type_name.as_str())
        {
            let accepted = accepted.join(" or ");
            remark(format!("its type is {type_name}; a replay takes {accepted} under this name"));
        }
        if self.definition == DefinitionState::Missing && *messages > 0 {
            remark(format!(
                "the definition of {type_name} is not in the recording; readers without it need ROS"
            ));
        }
        if self.definition == DefinitionState::NotKnown && look_at(type_name).is_some() {
            remark(format!(
                "the definition of {type_name} is neither in ros2msg nor has it a type hash: whether its fields are those of \
                 this version is not known"
            ));
        }
        if let Some(oddities) = self.stamps.as_ref().and_then(|stamps| stamps.oddities()) {
            remark(format!("of {messages} stamps {oddities}"));
        }
        if let Some(first) = self.first_unsound_at {
            let count = self.unsound;
            remark(format!(
                "{count} of {messages} messages have NaN, infinite numbers or a quaternion that is no rotation; \
                 the first is message {first}"
            ));
        }
        if self.big_endian > 0 {
            remark(format!(
                "{} of {messages} messages are big-endian, which is read as well",
                self.big_endian
            ));
        }
        if self.with_rest > 0 {
            remark(format!(
                "{} of {messages} messages have bytes behind their last field, which are left out",
                self.with_rest
            ));
        }
        let back = self.periods.log_times_back;
        if back > 0 {
            remark(format!(
                "{back} of {messages} messages are stored behind later ones; they are read by log time"
            ));
        }
        remarks
    }

    /// A type that is known, in an encoding that is not.
    fn is_of_unknown_encoding(&self) -> bool {
        self.serialization_format != "cdr" && self.undecodable.is_some()
    }

    fn expected_types(&self) -> Option<&'static [&'static str]> {
        let ends = |words: &str| {
            self.name.strip_suffix(words).is_some_and(|before| before.is_empty() || before.ends_with('/'))
        };
        NAMED.iter().find(|(words, _)| ends(words)).map(|(_, types)| *types)
    }
}
