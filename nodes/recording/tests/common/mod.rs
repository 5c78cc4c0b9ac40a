//! A recording for tests: what it contains follows from the number of each message.
#![allow(dead_code, reason = "each test file uses what it needs")]

pub(crate) mod mcap_files;

use std::path::Path;

use recording::cdr::encode;
use recording::messages::{Header, PoseStamped, Time};
use recording::{Error, Message, MessageDefinition, Qos, Recording, Topic, TopicId, Writer};

/// 2023-11-14, in ns.
pub(crate) const START_NS: u64 = 1_700_000_000_000_000_000;
/// 1 kHz.
pub(crate) const STEP_NS: u64 = 1_000_000;

pub(crate) fn topic(name: &str) -> Topic {
    Topic {
        name: name.to_owned(),
        type_name: "geometry_msgs/msg/PoseStamped".to_owned(),
        serialization_format: "cdr".to_owned(),
        offered_qos: vec![Qos::default()],
        definition: MessageDefinition {
            encoding: "ros2msg".to_owned(),
            text: "std_msgs/Header header\n".to_owned(),
            type_hash: "RIHS01_00".to_owned(),
        },
    }
}

pub(crate) fn log_time_ns(number: u64) -> u64 {
    START_NS + number * STEP_NS
}

pub(crate) fn pose(number: u64) -> PoseStamped {
    let header = Header { stamp: Time { sec: 0, nanosec: number as u32 }, frame_id: "base".to_owned() };
    let mut pose = PoseStamped { header, ..PoseStamped::default() };
    pose.pose.position.x = number as f64 * 1e-3;
    pose
}

/// Writes messages `numbers` of one topic, 1 ms apart.
pub(crate) fn write(writer: &mut Writer, topic: TopicId, numbers: std::ops::Range<u64>) {
    for number in numbers {
        writer.write(topic, log_time_ns(number), &encode(&pose(number))).unwrap();
    }
}

/// A closed recording of `count` messages on `/pose`.
pub(crate) fn recorded(directory: &Path, count: u64) {
    let mut writer = Writer::create(directory, "jazzy").unwrap();
    let topic = writer.add_topic(topic("/pose")).unwrap();
    write(&mut writer, topic, 0..count);
    writer.close().unwrap();
}

/// All messages that can be read, and all errors on the way.
pub(crate) fn read(recording: &Recording) -> (Vec<Message>, Vec<Error>) {
    let mut messages = Vec::new();
    let mut errors = Vec::new();
    for item in recording.messages() {
        match item {
            Ok(message) => messages.push(message),
            Err(error) => errors.push(error),
        }
    }
    (messages, errors)
}

/// What can be read of a file with these bytes.
pub(crate) fn opened(bytes: &[u8]) -> Result<Recording, Error> {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("broken.mcap");
    std::fs::write(&path, bytes).unwrap();
    Recording::open(&path)
}

/// The numbers of the poses that are read, by their log times; every message must be the pose of its time.
pub(crate) fn numbers(messages: &[Message]) -> Vec<u64> {
    let number = |message: &Message| {
        let number = (message.log_time_ns - START_NS) / STEP_NS;
        assert_eq!(message.data, encode(&pose(number)), "message {number}");
        number
    };
    messages.iter().map(number).collect()
}
