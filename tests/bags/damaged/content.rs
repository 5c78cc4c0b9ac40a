//! Files that are whole as files, with messages that are not what they should be.

use recording::cdr::{Message, encode};
use recording::messages::{PoseStamped, WrenchStamped};
use recording::{Topic, Writer};

use super::Case;
use super::Expected::{Damaged, Whole};
use super::whole::{self, FORCE_TEXT, POSE_TEXT, force, one_topic, pose, topic};

/// Messages in each of these files.
const COUNT: u64 = 500;
/// The one that is broken, from 1.
const BROKEN: u64 = 200;

pub fn cases() -> Vec<Case> {
    [stamps(), poses(), encodings(), types()].into_iter().flatten().collect()
}

/// A file of poses in which one is changed.
fn with_pose(name: &'static str, words: &'static [&'static str], change: impl Fn(&mut PoseStamped)) -> Case {
    let bytes = one_topic(topic("/measured_cp", PoseStamped::TYPE_NAME, POSE_TEXT), COUNT, |number| {
        let mut message = pose(number);
        if number == BROKEN - 1 {
            change(&mut message);
        }
        encode(&message)
    });
    Case::file(name, Whole, words, COUNT, bytes)
}

fn stamps() -> Vec<Case> {
    vec![
        with_pose("stamp_repeats.mcap", &["repeat", "message 200"], |pose| {
            pose.header.stamp = whole::header(BROKEN - 2).stamp;
        }),
        with_pose("stamp_jumps_back.mcap", &["jump back", "message 200"], |pose| pose.header.stamp.sec -= 1),
        with_pose("stamp_is_zero.mcap", &["zero", "message 200"], |pose| {
            pose.header.stamp = recording::messages::Time::default();
        }),
    ]
}

fn poses() -> Vec<Case> {
    vec![
        with_pose("nan_position.mcap", &["NaN", "message 200"], |pose| pose.pose.position.y = f64::NAN),
        with_pose("nan_rotation.mcap", &["NaN", "message 200"], |pose| pose.pose.orientation.w = f64::NAN),
        with_pose("no_rotation.mcap", &["rotation", "message 200"], |pose| pose.pose.orientation.w = 0.0),
    ]
}

fn encodings() -> Vec<Case> {
    let poses = || topic("/measured_cp", PoseStamped::TYPE_NAME, POSE_TEXT);
    let changed = |change: &dyn Fn(&mut Vec<u8>)| {
        one_topic(poses(), COUNT, |number| {
            let mut bytes = encode(&pose(number));
            if number == BROKEN - 1 {
                change(&mut bytes);
            }
            bytes
        })
    };
    let mut json = poses();
    json.serialization_format = "json".to_owned();
    vec![
        Case::file(
            "short_cdr.mcap",
            Damaged,
            &["/measured_cp", "message 200", "needed"],
            COUNT,
            changed(&|bytes| bytes.truncate(40)),
        ),
        Case::file("empty_cdr.mcap", Damaged, &["/measured_cp", "message 200"], COUNT, changed(&Vec::clear)),
        Case::file(
            "long_cdr.mcap",
            Whole,
            &["1 of 500 messages", "behind their last field"],
            COUNT,
            changed(&|bytes| bytes.extend([0; 64])),
        ),
        Case::file(
            "huge_text_in_cdr.mcap",
            Damaged,
            &["message 200", "4294967295"],
            COUNT,
            changed(&|bytes| bytes[12..16].fill(0xff)),
        ),
        Case::file(
            "big_endian_cdr.mcap",
            Whole,
            &["big-endian"],
            COUNT,
            one_topic(poses(), COUNT, big_endian),
        ),
        Case::file(
            "unknown_encoding.mcap",
            Damaged,
            &["/measured_cp", "json"],
            COUNT,
            one_topic(json, COUNT, |number| format!("{{\"x\": {number}}}").into_bytes()),
        ),
    ]
}

fn types() -> Vec<Case> {
    let mut json = topic("/measured_cp", PoseStamped::TYPE_NAME, POSE_TEXT);
    json.serialization_format = "json".to_owned();
    let other_fields =
        POSE_TEXT.replace("geometry_msgs/Pose pose\n", "geometry_msgs/Pose pose\nfloat32 quality\n");
    vec![
        Case::file(
            "another_type.mcap",
            Whole,
            &["/measured_cp", "WrenchStamped", "PoseStamped"],
            COUNT,
            one_topic(topic("/measured_cp", WrenchStamped::TYPE_NAME, FORCE_TEXT), COUNT, |n| {
                encode(&force(n))
            }),
        ),
        Case::file(
            "another_definition.mcap",
            Damaged,
            &["/measured_cp", "definition", "quality"],
            COUNT,
            one_topic(topic("/measured_cp", PoseStamped::TYPE_NAME, &other_fields), COUNT, |n| {
                encode(&pose(n))
            }),
        ),
        Case::file(
            "two_definitions.mcap",
            Damaged,
            &["/measured_cp", "more than one definition", "quality"],
            COUNT,
            two_topics(
                topic("/measured_cp", PoseStamped::TYPE_NAME, POSE_TEXT),
                topic("/measured_cp", PoseStamped::TYPE_NAME, &other_fields),
            ),
        ),
        Case::file(
            "two_encodings.mcap",
            Damaged,
            &["/measured_cp", "\"cdr\"", "\"json\""],
            COUNT,
            two_topics(topic("/measured_cp", PoseStamped::TYPE_NAME, POSE_TEXT), json),
        ),
        Case::file(
            "no_pose.mcap",
            Whole,
            &["no poses"],
            COUNT,
            one_topic(topic("/servo_cf", WrenchStamped::TYPE_NAME, FORCE_TEXT), COUNT, |n| encode(&force(n))),
        ),
        Case::file(
            "no_messages.mcap",
            Whole,
            &["no messages"],
            0,
            one_topic(topic("/measured_cp", PoseStamped::TYPE_NAME, POSE_TEXT), 0, |_| Vec::new()),
        ),
        Case::file(
            "no_definition.mcap",
            Whole,
            &["/measured_cp", "definition"],
            COUNT,
            one_topic(topic("/measured_cp", PoseStamped::TYPE_NAME, ""), COUNT, |n| encode(&pose(n))),
        ),
    ]
}

/// Poses, the first half on one topic and the others on another.
fn two_topics(first: Topic, second: Topic) -> Vec<u8> {
    let (_, bytes) = whole::made(|path| {
        let mut writer = Writer::create(path, "jazzy").unwrap();
        let ids = [first, second].map(|topic| writer.add_topic(topic).unwrap());
        for number in 0..COUNT {
            let id = ids[usize::from(number >= COUNT / 2)];
            writer.write(id, whole::log_time_ns(number), &encode(&pose(number))).unwrap();
        }
        writer.close().unwrap();
    });
    bytes
}

/// A pose as a big-endian machine writes it.
fn big_endian(number: u64) -> Vec<u8> {
    let message = pose(number);
    let mut bytes = vec![0, 0, 0, 0];
    bytes.extend(message.header.stamp.sec.to_be_bytes());
    bytes.extend(message.header.stamp.nanosec.to_be_bytes());
    let frame = message.header.frame_id.as_bytes();
    bytes.extend((frame.len() as u32 + 1).to_be_bytes());
    bytes.extend(frame);
    bytes.push(0);
    bytes.resize(4 + (bytes.len() - 4).next_multiple_of(8), 0);
    let (at, rotation) = (&message.pose.position, &message.pose.orientation);
    for value in [at.x, at.y, at.z, rotation.x, rotation.y, rotation.z, rotation.w] {
        bytes.extend(value.to_be_bytes());
    }
    bytes
}
