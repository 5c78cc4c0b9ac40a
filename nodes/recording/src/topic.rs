//! What a recording knows about a topic.

use crate::{MessageDefinition, Qos};

/// A topic as it is announced to a recording.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Topic {
    /// Absolute name, such as `/left/measured_cp`.
    pub name: String,
    /// Such as `geometry_msgs/msg/PoseStamped`.
    pub type_name: String,
    /// How the messages are encoded: `cdr` for everything ROS 2 sends.
    pub serialization_format: String,
    /// What each publisher offered when the recording began. Empty: not known.
    pub offered_qos: Vec<Qos>,
    /// Text and hash of the type. The text is empty where none was found.
    pub definition: MessageDefinition,
}

/// A topic found in a recording.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RecordedTopic {
    /// Name, type, QoS and definition.
    pub topic: Topic,
    /// How many messages it has.
    pub message_count: u64,
}
