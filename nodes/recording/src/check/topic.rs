//! One topic of a recording, looked at message by message.

use serde::Serialize;

use super::periods::{Periods, Times};
use super::stamps::StampOrder;
use super::values::{Facts, Look, look_at};
use crate::messages::is_same;
use crate::qos::Qos;
use crate::reader::MessageRef;
use crate::topic::{RecordedTopic, Topic};

/// What the recording says about the fields of a type.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(tag = "state", content = "reason", rename_all = "snake_case")]
pub enum DefinitionState {
    /// The same fields in the same order as here.
    Agrees,
    /// There is one, and the type is not known here, or nothing of it can be compared.
    NotKnown,
    /// There is none.
    Missing,
    /// Other fields: the bytes do not mean what this version would read.
    Differs(String),
}

/// Messages that cannot be what they are said to be.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Failures {
    /// How many.
    pub messages: u64,
    /// The first of them: number of the message in its topic, from 1.
    pub first_at: u64,
    /// What is wrong with the first.
    pub reason: String,
}

/// A topic of a recording.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TopicReport {
    /// Absolute name.
    pub name: String,
    /// Such as `geometry_msgs/msg/PoseStamped`.
    #[serde(rename = "type")]
    pub type_name: String,
    /// `cdr`.
    pub serialization_format: String,
    /// Messages that can be read.
    pub messages: u64,
    /// Messages that were recorded, as far as the recording itself says.
    pub recorded: u64,
    /// Bytes of all messages that can be read.
    pub bytes: u64,
    /// Rate, gaps, order of the log times.
    #[serde(flatten)]
    pub periods: Periods,
    /// Order of the stamps; `None` for types without a header or that are not known here.
    pub stamps: Option<StampOrder>,
    /// Of each publisher, as far as it was recorded.
    pub offered_qos: Vec<Qos>,
    /// `RIHS01_...`; empty where it was not recorded.
    pub type_hash: String,
    /// Whether the type has the fields this version knows.
    pub definition: DefinitionState,
    /// Messages that are not what their type says.
    pub undecodable: Option<Failures>,
    /// Messages with NaN, infinite numbers or quaternions that are no rotation.
    pub unsound: u64,
    /// The first of them: number of the message in its topic, from 1.
    pub first_unsound_at: Option<u64>,
    /// Messages in big-endian encoding, which is read as well.
    pub big_endian: u64,
    /// Messages with bytes behind their last field, which are left out.
    pub with_rest: u64,
}

/// A topic while it is being read.
pub(crate) struct TopicCheck<'a> {
    topic: &'a RecordedTopic,
    /// In `metadata.yaml`; 0 without one.
    announced: u64,
    look: Option<Look>,
    messages: u64,
    bytes: u64,
    times: Times,
    stamps: Option<StampOrder>,
    undecodable: Option<Failures>,
    unsound: u64,
    first_unsound_at: Option<u64>,
    big_endian: u64,
    with_rest: u64,
}

impl<'a> TopicCheck<'a> {
    /// With the count of `metadata.yaml`, 0 without one.
    pub(crate) fn new(topic: &'a RecordedTopic, announced: u64) -> Self {
        Self {
            topic,
            announced,
            look: look_at(&topic.topic.type_name),
            messages: 0,
            bytes: 0,
            times: Times::default(),
            stamps: None,
            undecodable: None,
            unsound: 0,
            first_unsound_at: None,
            big_endian: 0,
            with_rest: 0,
        }
    }

    /// Messages come in stored order.
    pub(crate) fn take(&mut self, message: &MessageRef<'_>) {
        self.messages += 1;
        self.bytes += message.data.len() as u64;
        self.times.take(message.log_time_ns);
        let Some(look) = self.look else { return };
        match look(message.data) {
            Ok(facts) => self.take_facts(&facts),
            Err(error) => self.fail(error.to_string()),
        }
        if message.data.get(1) == Some(&0) {
            self.big_endian += 1;
        }
    }

    fn take_facts(&mut self, facts: &Facts) {
        if let Some(stamp) = &facts.stamp {
            self.stamps.get_or_insert_default().take(self.messages, stamp);
        }
        if !facts.sound {
            self.unsound += 1;
            self.first_unsound_at.get_or_insert(self.messages);
        }
        self.with_rest += u64::from(facts.has_rest);
    }

    fn fail(&mut self, reason: String) {
        let first_at = self.messages;
        self.undecodable.get_or_insert(Failures { messages: 0, first_at, reason }).messages += 1;
    }

    pub(crate) fn bounds_ns(&self) -> Option<(u64, u64)> {
        self.times.bounds_ns()
    }

    pub(crate) fn finish(self) -> TopicReport {
        let Topic { name, type_name, serialization_format, offered_qos, definition } = &self.topic.topic;
        let state = match is_same(type_name, definition) {
            Err(reason) => DefinitionState::Differs(reason),
            Ok(_) if definition.text.trim().is_empty() => DefinitionState::Missing,
            Ok(true) => DefinitionState::Agrees,
            Ok(false) => DefinitionState::NotKnown,
        };
        TopicReport {
            name: name.clone(),
            type_name: type_name.clone(),
            serialization_format: serialization_format.clone(),
            messages: self.messages,
            recorded: self.topic.message_count.max(self.announced),
            bytes: self.bytes,
            periods: self.times.finish(),
            stamps: self.stamps,
            offered_qos: offered_qos.clone(),
            type_hash: definition.type_hash.clone(),
            definition: state,
            undecodable: self.undecodable,
            unsound: self.unsound,
            first_unsound_at: self.first_unsound_at,
            big_endian: self.big_endian,
            with_rest: self.with_rest,
        }
    }
}
