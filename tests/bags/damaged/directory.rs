//! Directories whose files do not agree.

use std::path::PathBuf;

use recording::Writer;
use recording::cdr::Message as _;
use recording::messages::PoseStamped;

use super::Expected::{Damaged, Unreadable, Whole};
use super::{Case, Expected, whole};

pub fn cases() -> Vec<Case> {
    let (metadata, bytes) = whole::bytes();
    let metadata = String::from_utf8(metadata).unwrap();
    let (poses, all) =
        (format!("message_count: {}", whole::POSES), format!("message_count: {}", whole::MESSAGES));
    assert!(metadata.contains(&poses) && metadata.contains(&all), "{metadata}");
    let empty = whole::made(|path| {
        let mut writer = Writer::create(path, "jazzy").unwrap();
        writer.add_topic(whole::topic("/measured_cp", PoseStamped::TYPE_NAME, whole::POSE_TEXT)).unwrap();
        writer.close().unwrap();
    });
    let with = |name, expected, words, metadata: &str| Case {
        name,
        expected,
        words,
        readable: if expected == Damaged { whole::MESSAGES } else { 0 },
        files: vec![
            (PathBuf::from("metadata.yaml"), metadata.as_bytes().to_vec()),
            (PathBuf::from("session_0.mcap"), bytes.clone()),
        ],
    };
    let directory =
        |name, expected: Expected, words, readable, files| Case { name, expected, words, readable, files };
    let second_file = metadata.replace("  - session_0.mcap", "  - session_0.mcap\n  - session_1.mcap");
    assert_ne!(second_file, metadata);
    vec![
        with(
            "metadata_counts_disagree",
            Damaged,
            &["2001"],
            &metadata.replace(&poses, "message_count: 2001"),
        ),
        with(
            "metadata_names_missing_topic",
            Damaged,
            &["/elsewhere"],
            &metadata.replace("/servo_cf", "/elsewhere"),
        ),
        with("metadata_names_missing_file", Damaged, &["session_1.mcap"], &second_file),
        with("metadata_is_garbage", Damaged, &["metadata.yaml"], "rosbag2_bagfile_information: [1, 2"),
        with("metadata_is_empty", Damaged, &["metadata.yaml"], ""),
        with("metadata_of_the_future", Damaged, &["version"], &metadata.replace("version: 9", "version: 99")),
        directory(
            "no_metadata",
            Damaged,
            &["metadata.yaml"],
            whole::MESSAGES,
            vec![(PathBuf::from("session_0.mcap"), bytes.clone())],
        ),
        directory(
            "a_part_is_missing",
            Damaged,
            &["session_1.mcap is not there"],
            2 * whole::MESSAGES,
            ["session_0.mcap", "session_2.mcap"].map(|name| (PathBuf::from(name), bytes.clone())).to_vec(),
        ),
        directory(
            "several_recordings",
            Unreadable,
            &["several recordings", "grasp_0.mcap", "session_0.mcap to session_1.mcap"],
            0,
            ["session_0.mcap", "session_1.mcap", "grasp_0.mcap"]
                .map(|name| (PathBuf::from(name), bytes.clone()))
                .to_vec(),
        ),
        directory(
            "a_recording_and_its_copy_in_another_storage",
            Unreadable,
            &["several recordings", "session_0.db3", "session_0.mcap"],
            0,
            ["session_0.mcap", "session_0.db3"].map(|name| (PathBuf::from(name), bytes.clone())).to_vec(),
        ),
        directory(
            "metadata_only",
            Unreadable,
            &["session_0.mcap"],
            0,
            vec![(PathBuf::from("metadata.yaml"), metadata.into_bytes())],
        ),
        directory(
            "no_messages_at_all",
            Whole,
            &["no messages"],
            0,
            vec![(PathBuf::from("metadata.yaml"), empty.0), (PathBuf::from("session_0.mcap"), empty.1)],
        ),
        directory("nothing_in_it", Unreadable, &["metadata.yaml"], 0, Vec::new()),
        directory(
            "other_files",
            Unreadable,
            &["metadata.yaml"],
            0,
            vec![(PathBuf::from("notes.txt"), b"nothing recorded\n".to_vec())],
        ),
    ]
}
