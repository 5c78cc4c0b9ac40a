//! The whole recording that the broken ones are made from.

use std::path::Path;

use recording::cdr::{Message, encode};
use recording::messages::{
    Bool, Header, Point, Pose, PoseStamped, Quaternion, Time, Vector3, Wrench, WrenchStamped,
};
use recording::{MessageDefinition, Qos, Topic, TopicId, Writer};

/// 2023-11-14, ns since 1970.
pub const START_NS: u64 = 1_700_000_000_000_000_000;
/// 1 kHz.
pub const STEP_NS: u64 = 1_000_000;
/// Poses; as many forces, and a grasp with each hundredth.
pub const POSES: u64 = 2000;
/// All messages.
pub const MESSAGES: u64 = POSES * 2 + POSES / 100;

pub const POSE_TEXT: &str = "std_msgs/Header header\ngeometry_msgs/Pose pose\n\
================================================================================\nMSG: std_msgs/Header\n\
builtin_interfaces/Time stamp\nstring frame_id\n\
================================================================================\nMSG: builtin_interfaces/Time\n\
int32 sec\nuint32 nanosec\n\
================================================================================\nMSG: geometry_msgs/Pose\n\
Point position\nQuaternion orientation\n\
================================================================================\nMSG: geometry_msgs/Point\n\
float64 x\nfloat64 y\nfloat64 z\n\
================================================================================\nMSG: geometry_msgs/Quaternion\n\
float64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n";
pub const FORCE_TEXT: &str = "std_msgs/Header header\ngeometry_msgs/Wrench wrench\n\
================================================================================\nMSG: std_msgs/Header\n\
builtin_interfaces/Time stamp\nstring frame_id\n\
================================================================================\nMSG: builtin_interfaces/Time\n\
int32 sec\nuint32 nanosec\n\
================================================================================\nMSG: geometry_msgs/Wrench\n\
Vector3 force\nVector3 torque\n\
================================================================================\nMSG: geometry_msgs/Vector3\n\
float64 x\nfloat64 y\nfloat64 z\n";
pub const BOOL_TEXT: &str = "bool data\n";

/// A topic of a type with the text of its definition.
pub fn topic(name: &str, type_name: &str, text: &str) -> Topic {
    Topic {
        name: name.to_owned(),
        type_name: type_name.to_owned(),
        serialization_format: "cdr".to_owned(),
        offered_qos: vec![Qos::default()],
        definition: MessageDefinition {
            encoding: if text.is_empty() { "" } else { "ros2msg" }.to_owned(),
            text: text.to_owned(),
            type_hash: "RIHS01_0f".to_owned(),
        },
    }
}

pub fn log_time_ns(number: u64) -> u64 {
    START_NS + number * STEP_NS
}

pub fn header(number: u64) -> Header {
    let time_ns = log_time_ns(number);
    let stamp = Time { sec: (time_ns / 1_000_000_000) as i32, nanosec: (time_ns % 1_000_000_000) as u32 };
    Header { stamp, frame_id: "device_base".to_owned() }
}

pub fn pose(number: u64) -> PoseStamped {
    let position = Point { x: number as f64 * 1e-6, y: -0.1, z: 0.2 };
    let orientation = Quaternion { w: 1.0, ..Quaternion::default() };
    PoseStamped { header: header(number), pose: Pose { position, orientation } }
}

pub fn force(number: u64) -> WrenchStamped {
    let force = Vector3 { z: number as f64 * 1e-3, ..Vector3::default() };
    WrenchStamped { header: header(number), wrench: Wrench { force, torque: Vector3::default() } }
}

/// Writes the whole recording into a directory that does not exist.
pub fn write(directory: &Path) {
    let mut writer = Writer::create(directory, "jazzy").unwrap();
    let poses = writer.add_topic(topic("/measured_cp", PoseStamped::TYPE_NAME, POSE_TEXT)).unwrap();
    let forces = writer.add_topic(topic("/servo_cf", WrenchStamped::TYPE_NAME, FORCE_TEXT)).unwrap();
    let grasp = writer.add_topic(topic("/grasp", Bool::TYPE_NAME, BOOL_TEXT)).unwrap();
    for number in 0..POSES {
        let time = log_time_ns(number);
        writer.write(poses, time, &encode(&pose(number))).unwrap();
        writer.write(forces, time, &encode(&force(number))).unwrap();
        if number % 100 == 0 {
            writer.write(grasp, time, &encode(&Bool { data: number % 200 == 0 })).unwrap();
        }
    }
    writer.close().unwrap();
}

/// `(metadata.yaml, session_0.mcap)` of the whole recording, which is a directory `session`.
pub fn bytes() -> (Vec<u8>, Vec<u8>) {
    made(write)
}

/// The two files of what `write` writes into the directory it is given.
pub fn made(write: impl FnOnce(&Path)) -> (Vec<u8>, Vec<u8>) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    write(&path);
    let read = |name: &str| std::fs::read(path.join(name)).unwrap();
    (read("metadata.yaml"), read("session_0.mcap"))
}

/// A recording with one topic, whose messages `message` makes.
pub fn one_topic(topic: Topic, count: u64, message: impl Fn(u64) -> Vec<u8>) -> Vec<u8> {
    let (_, bytes) = made(|path| {
        let mut writer = Writer::create(path, "jazzy").unwrap();
        let id: TopicId = writer.add_topic(topic).unwrap();
        for number in 0..count {
            writer.write(id, log_time_ns(number), &message(number)).unwrap();
        }
        writer.close().unwrap();
    });
    bytes
}

/// A file with so many topics of one message each, more than a recording of this crate can have.
pub fn many_topics(count: u16) -> Vec<u8> {
    let mut writer = mcap::Writer::new(std::io::Cursor::new(Vec::new())).unwrap();
    let schema = writer.add_schema(Bool::TYPE_NAME, "ros2msg", BOOL_TEXT.as_bytes()).unwrap();
    let data = encode(&Bool { data: true });
    for number in 0..count {
        let name = format!("/robots/number_{number}/is_enabled");
        let channel_id =
            writer.add_channel(schema, &name, "cdr", &std::collections::BTreeMap::new()).unwrap();
        let log_time = log_time_ns(u64::from(number));
        let header =
            mcap::records::MessageHeader { channel_id, sequence: 0, log_time, publish_time: log_time };
        writer.write_to_known_channel(&header, &data).unwrap();
    }
    writer.finish().unwrap();
    writer.into_inner().into_inner()
}
