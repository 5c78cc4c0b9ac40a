//! Writes the corpus that fuzzing starts from: `write_recording_fuzz_corpus nodes/recording/fuzz/corpus`. The same files each time.

use std::path::Path;

use mcap::records::MessageHeader;
use mcap::{Compression, WriteOptions};
use recording::cdr::encode;
use recording::messages::*;

const START_NS: u64 = 1_700_000_000_000_000_000;
/// Brackets that take a YAML parser a second.
const DEEP: usize = 40_000;
const POSE: &str = "std_msgs/Header header\ngeometry_msgs/Pose pose\n\
    ================================================================================\n\
    MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n";
const QOS: &str = "- history: keep_last\n  depth: 1\n  reliability: reliable\n  durability: transient_local\n  deadline:\n    \
    sec: 0\n    nsec: 0\n  lifespan:\n    sec: 0\n    nsec: 0\n  liveliness: automatic\n  liveliness_lease_duration:\n    \
    sec: 0\n    nsec: 0\n  avoid_ros_namespace_conventions: false";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let corpus = std::env::args().nth(1).ok_or("usage: write_recording_fuzz_corpus DIRECTORY")?;
    let save = |target: &str, name: &str, bytes: &[u8]| -> std::io::Result<()> {
        let directory = Path::new(&corpus).join(target);
        std::fs::create_dir_all(&directory)?;
        std::fs::write(directory.join(name), bytes)
    };
    for (name, compression, chunks, summary) in [
        ("plain", None, true, true),
        ("zstd", Some(Compression::Zstd), true, true),
        ("lz4", Some(Compression::Lz4), true, true),
        ("loose", None, false, true),
        ("without_summary", None, true, false),
    ] {
        let bytes = file(compression, chunks, summary)?;
        save("mcap", name, &bytes)?;
        save("mcap", &format!("{name}_cut"), bytes.get(..bytes.len() * 2 / 3).unwrap_or_default())?;
    }
    save("mcap", "deep_qos", &deep_qos()?)?;
    save("sqlite", "one_topic", &database()?)?;
    for (name, text) in metadata() {
        save("metadata", name, text.as_bytes())?;
    }
    save("definition", "pose_stamped", POSE.as_bytes())?;
    save(
        "definition",
        "joy",
        b"# Buttons\nuint8 LEFT = 1\nHeader header\nfloat32[] axes [1, 2]\nint32[<=8] buttons\n",
    )?;
    let header = Header { stamp: Time { sec: 1, nanosec: 2 }, frame_id: "base".to_owned() };
    save("cdr", "pose_stamped", &encode(&PoseStamped { header: header.clone(), ..Default::default() }))?;
    let state = JointState {
        header: header.clone(),
        name: vec!["jaw".to_owned()],
        position: vec![0.5],
        ..Default::default()
    };
    save("cdr", "joint_state", &encode(&state))?;
    let surface = SurfaceDisplacement {
        header: header.clone(),
        topology_version: 7,
        vertex: vec![3],
        displacement: vec![0.1; 3],
    };
    save("cdr", "surface_displacement", &encode(&surface))?;
    let frame =
        TransformStamped { header: header.clone(), child_frame_id: "tip".to_owned(), ..Default::default() };
    save("cdr", "tf", &encode(&TFMessage { transforms: vec![frame] }))?;
    save(
        "cdr",
        "contact_law",
        &encode(&ContactLaw { header, units: vec![3], angle: vec![0.7], ..Default::default() }),
    )?;
    Ok(())
}

/// Four poses on two topics.
fn file(compression: Option<Compression>, chunks: bool, summary: bool) -> Result<Vec<u8>, mcap::McapError> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let options = WriteOptions::new().profile("ros2").library("").compression(compression).use_chunks(chunks);
    let mut writer =
        options.emit_summary_records(summary).emit_summary_offsets(summary).create(&mut bytes)?;
    let schema = writer.add_schema("geometry_msgs/msg/PoseStamped", "ros2msg", POSE.as_bytes())?;
    let latched = [("offered_qos_profiles".to_owned(), QOS.to_owned())].into();
    let channels = [
        writer.add_channel(schema, "/a", "cdr", &Default::default())?,
        writer.add_channel(schema, "/b", "cdr", &latched)?,
    ];
    for number in 0..4_u64 {
        let channel_id = if number % 2 == 0 { channels[0] } else { channels[1] };
        let log_time = START_NS + number * 1_000_000;
        let header = MessageHeader { channel_id, sequence: number as u32, log_time, publish_time: log_time };
        writer.write_to_known_channel(&header, &encode(&PoseStamped::default()))?;
        if number == 1 {
            writer.flush()?;
        }
    }
    writer.finish()?;
    drop(writer);
    Ok(bytes.into_inner())
}

/// One channel whose quality of service is brackets.
fn deep_qos() -> Result<Vec<u8>, mcap::McapError> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut writer = WriteOptions::new().profile("ros2").library("").use_chunks(false).create(&mut bytes)?;
    let schema = writer.add_schema("std_msgs/msg/Bool", "ros2msg", b"bool data")?;
    let qos = format!("- a: {}", "[".repeat(DEEP));
    let channel_id =
        writer.add_channel(schema, "/a", "cdr", &[("offered_qos_profiles".to_owned(), qos)].into())?;
    let header = MessageHeader { channel_id, sequence: 0, log_time: START_NS, publish_time: START_NS };
    writer.write_to_known_channel(&header, &encode(&Bool::default()))?;
    writer.finish()?;
    drop(writer);
    Ok(bytes.into_inner())
}

/// Small pages, so that a few rows fill several.
fn database() -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let file = tempfile::NamedTempFile::new()?;
    let connection = rusqlite::Connection::open(file.path())?;
    connection.execute_batch(
        "PRAGMA page_size = 512; PRAGMA journal_mode = OFF;
         CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
         CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, serialization_format TEXT NOT NULL,
             offered_qos_profiles TEXT NOT NULL, type_description_hash TEXT NOT NULL);
         CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL);
         CREATE INDEX timestamp_idx ON messages (timestamp ASC);
         INSERT INTO schema VALUES (4, 'jazzy');
         INSERT INTO topics VALUES (1, '/a', 'geometry_msgs/msg/PoseStamped', 'cdr', '', 'RIHS01_00');",
    )?;
    for number in 0..12_i64 {
        let row = (number + 1, START_NS as i64 + number, encode(&PoseStamped::default()));
        connection.execute("INSERT INTO messages VALUES (?1, 1, ?2, ?3)", row)?;
    }
    drop(connection);
    Ok(std::fs::read(file.path())?)
}

/// Of Foxy, Humble and Jazzy.
fn metadata() -> Vec<(&'static str, String)> {
    let text = |version: u32, qos: &str, behind: &str| {
        format!(
            "rosbag2_bagfile_information:\n  version: {version}\n  storage_identifier: mcap\n  duration:\n    nanoseconds: 3000000\n  \
             starting_time:\n    nanoseconds_since_epoch: {START_NS}\n  message_count: 4\n  topics_with_message_count:\n    \
             - topic_metadata:\n        name: /a\n        type: geometry_msgs/msg/PoseStamped\n        \
             serialization_format: cdr\n        offered_qos_profiles: {qos}\n      message_count: 2\n  \
             compression_format: \"\"\n  compression_mode: \"\"\n  relative_file_paths:\n    - session_0.mcap\n{behind}"
        )
    };
    let numbers = "\"- history: 1\\n  depth: 5\\n  reliability: 1\\n  durability: 1\"";
    vec![
        ("version_4", text(4, numbers, "")),
        ("version_5", text(5, numbers, "  files: []\n")),
        ("version_9", text(9, "[]", "  files: []\n  custom_data: ~\n  ros_distro: jazzy\n")),
        ("deep", text(9, "[]", &format!("  files: []\n  custom_data: {}", "[".repeat(DEEP)))),
        ("aliases", text(9, "&a [*b, *b]", &format!("  custom_data: [{}]\n", "*a, ".repeat(1000)))),
        ("directives", format!("{}---\n{}", "%TAG !a! b\n".repeat(1000), text(9, "[]", ""))),
    ]
}
