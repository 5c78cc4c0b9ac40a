//! What a repair leaves on the disk, whatever happens while it runs.
#![allow(clippy::unwrap_used, reason = "helpers of tests, which may panic")]

mod common;

use std::cell::Cell;
use std::path::Path;

use common::*;
use recording::check::{Verdict, check};
use recording::repair::{RepairError, default_output, repair};
use recording::{Recording, Writer};

fn names(directory: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(directory).unwrap();
    let mut names: Vec<_> =
        entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn a_repair_that_is_interrupted_anywhere_leaves_nothing_behind() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    recorded(&path, 5000);
    // Asked with each thousandth message: while writing, and while reading back.
    for questions in 0..10 {
        let asked = Cell::new(0);
        let go_on = || {
            asked.set(asked.get() + 1);
            asked.get() <= questions
        };
        let error = repair(&path, &directory.path().join("new"), &go_on).unwrap_err();
        assert!(matches!(error, RepairError::Interrupted), "{error}");
        assert_eq!(names(directory.path()), ["session"], "after {questions} questions");
    }
    assert!(repair(&path, &directory.path().join("new"), &|| true).unwrap().all_saved);
    assert_eq!(names(directory.path()), ["new", "session"]);
}

#[test]
fn of_a_killed_recorder_everything_that_reached_the_disk_is_saved_and_the_result_is_whole() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    let mut writer = Writer::create(&path, "jazzy").unwrap();
    let topic = writer.add_topic(topic("/pose")).unwrap();
    write(&mut writer, topic, 0..3700);
    // As SIGKILL does: nothing of the writer runs any more.
    std::mem::forget(writer);
    let readable = read(&Recording::open(&path).unwrap()).0;
    assert_eq!(check(&path).verdict, Verdict::Damaged);
    let output = default_output(&path);
    let repaired = repair(&path, &output, &|| true).unwrap();
    assert_eq!(repaired.saved, readable.len() as u64);
    assert!(repaired.all_saved, "{repaired:?}");
    assert_eq!(read(&Recording::open(&output).unwrap()).0, readable);
    // The definition of these tests is another one than that of the type; nothing else is wrong.
    let problems = check(&output).problems;
    assert!(problems.iter().all(|problem| problem.contains("definition")), "{problems:?}");
}

#[test]
fn messages_that_may_not_be_what_was_recorded_are_saved_and_not_called_all() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    recorded(&path, 100);
    let file = path.join("session_0.mcap");
    let mut bytes = std::fs::read(&file).unwrap();
    let message = recording::cdr::encode(&pose(7));
    let at = bytes.windows(message.len()).position(|window| window == message).unwrap();
    bytes[at + message.len() - 1] ^= 1;
    std::fs::write(&file, bytes).unwrap();
    let repaired = repair(&path, &default_output(&path), &|| true).unwrap();
    assert_eq!((repaired.saved, repaired.lost, repaired.all_saved), (100, 0, false), "{repaired:?}");
    assert!(repaired.problems.iter().any(|problem| problem.contains("checksum")), "{repaired:?}");
}
