//! A disk that is really full while a recording is written. Needs the right to mount a small file system in memory; without
//! it these tests say so and check nothing.
#![allow(clippy::unwrap_used, reason = "helpers of tests, which may panic")]

mod common;

use std::path::Path;
use std::process::Command;

use common::*;
use recording::cdr::encode;
use recording::repair::repair;
use recording::{Recording, Writer};

/// A mounted disk of 2 MB.
struct SmallDisk(tempfile::TempDir);

impl SmallDisk {
    /// `None` where mounting is not permitted.
    #[expect(clippy::print_stderr, reason = "a test that checks nothing must say so")]
    fn mount() -> Option<Self> {
        let directory = tempfile::tempdir().unwrap();
        let mount = ["-t", "tmpfs", "-o", "size=2m", "small_disk"];
        match Command::new("mount").args(mount).arg(directory.path()).output() {
            Ok(output) if output.status.success() => Some(Self(directory)),
            failed => {
                eprintln!("skipped, mounting is not permitted here: {failed:?}");
                None
            }
        }
    }

    fn path(&self) -> &Path {
        self.0.path()
    }
}

impl Drop for SmallDisk {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(self.path()).status();
    }
}

#[test]
fn a_recording_on_a_full_disk_ends_with_one_error_and_keeps_what_was_written() {
    let Some(disk) = SmallDisk::mount() else { return };
    let path = disk.path().join("session");
    let mut writer = Writer::create(&path, "jazzy").unwrap();
    let topic = writer.add_topic(topic("/pose")).unwrap();
    let failed = (0..1_000_000).find_map(|number| {
        let written = writer.write(topic, log_time_ns(number), &encode(&pose(number)));
        written.err().map(|error| (number, error.to_string()))
    });
    let (number, said) = failed.unwrap();
    assert!(
        said.contains("session_0.mcap: cannot write: ") && said.contains("No space left on device"),
        "{said}"
    );
    assert!(writer.close().is_err(), "nothing pretends that it is whole");
    let recording = Recording::open(&path).unwrap();
    assert!(!recording.damage().is_empty());
    let read = numbers(&read(&recording).0);
    assert_eq!(read, (0..read.len() as u64).collect::<Vec<_>>());
    // Chunks have 768 kB at most, and the last one may be cut.
    assert!(read.len() > 5000 && read.len() as u64 <= number, "{} of {number}", read.len());
    drop(recording);
    // Elsewhere there is room to save it.
    let elsewhere = tempfile::tempdir().unwrap();
    let repaired = repair(&path, &elsewhere.path().join("saved"), &|| true).unwrap();
    assert_eq!(repaired.saved, read.len() as u64);
}

#[test]
fn a_repair_on_a_full_disk_leaves_nothing_behind() {
    let Some(disk) = SmallDisk::mount() else { return };
    let elsewhere = tempfile::tempdir().unwrap();
    let path = elsewhere.path().join("session");
    recorded(&path, 30_000);
    let error = repair(&path, &disk.path().join("saved"), &|| true).unwrap_err().to_string();
    assert!(error.contains("No space left on device"), "{error}");
    assert_eq!(std::fs::read_dir(disk.path()).unwrap().count(), 0);
}
