//! rosbag2's SQLite storage: every version of its schema, the order of messages, and a directory that stays as it was.
#![cfg(feature = "sqlite")]
#![allow(clippy::unwrap_used, reason = "helpers of tests, which may panic")]

mod database;

use std::collections::BTreeSet;
use std::io::Read;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;

use database::*;
use recording::{Durability, History, Recording, Reliability};

fn names_in(directory: &Path) -> BTreeSet<String> {
    let name = |entry: std::io::Result<std::fs::DirEntry>| entry.unwrap().file_name().into_string().unwrap();
    std::fs::read_dir(directory).unwrap().map(name).collect()
}

#[test]
fn every_version_of_the_schema_reads_with_what_it_has() {
    for version in 1..=4 {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("session_0.db3");
        add(&tables(&path, version), 0..10, 100);
        let recording = Recording::open(&path).unwrap();
        assert!(recording.damage().is_empty(), "{version}: {:?}", recording.damage());
        let [pose, force] = recording.topics() else { panic!("{version}: {:?}", recording.topics()) };
        assert_eq!((pose.message_count, force.message_count), (5, 5));
        let topic = &pose.topic;
        assert_eq!(topic.name, "/pose");
        assert_eq!(topic.type_name, "geometry_msgs/msg/PoseStamped");
        assert_eq!(topic.serialization_format, "cdr");
        match version {
            1 => assert!(topic.offered_qos.is_empty()),
            _ => {
                let [qos] = topic.offered_qos[..] else { panic!("{version}: {:?}", topic.offered_qos) };
                assert_eq!((qos.history, qos.depth), (History::KeepLast, 5));
                assert_eq!(
                    (qos.reliability, qos.durability),
                    (Reliability::Reliable, Durability::TransientLocal)
                );
            }
        }
        let definition = &topic.definition;
        let expected = if version == 4 { ("ros2msg", TEXT, HASH) } else { ("", "", "") };
        assert_eq!(
            (definition.encoding.as_str(), definition.text.as_str(), definition.type_hash.as_str()),
            expected
        );
        assert!(force.topic.definition.text.is_empty());
        let messages: Vec<_> = recording.messages().map(Result::unwrap).collect();
        assert_eq!(messages.iter().map(number).collect::<Vec<_>>(), (0..10).collect::<Vec<_>>());
        assert_eq!(messages[3].log_time_ns, (START_NS + 3 * STEP_NS) as u64);
        assert_eq!(messages[3].data, data(3, 100));
    }
}

#[test]
fn messages_come_by_time_and_equal_times_by_id() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.db3");
    let database = tables(&path, 3);
    // Stored times: 5, 3, 5, 1, 3; and one that comes in far behind a megabyte of others.
    for (number, time) in [5, 3, 5, 1, 3].into_iter().enumerate() {
        let row = rusqlite::params![time, data(number as i64, 20)];
        database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES (1, ?1, ?2)", row).unwrap();
    }
    for number in 5..40 {
        let row = rusqlite::params![1000 + number, data(number, 100_000)];
        database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES (2, ?1, ?2)", row).unwrap();
    }
    let row = rusqlite::params![3, data(40, 20)];
    database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES (1, ?1, ?2)", row).unwrap();
    let (numbers, said) = read(&path);
    let expected: Vec<_> = [3, 1, 4, 40, 0, 2].into_iter().chain(5..40).collect();
    assert_eq!((numbers, said), (expected, vec![]));
}

#[test]
fn messages_compressed_one_by_one_come_as_they_were() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.db3");
    let database = tables(&path, 4);
    for number in 0..50 {
        let frame = zstd::bulk::compress(&data(number, 100_000), 3).unwrap();
        let row = rusqlite::params![START_NS + number, frame];
        database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES (1, ?1, ?2)", row).unwrap();
    }
    let recording = Recording::open(&path).unwrap();
    let messages: Vec<_> = recording.messages().map(Result::unwrap).collect();
    assert_eq!(messages.len(), 50);
    assert!(messages.iter().zip(0..).all(|(message, number)| message.data == data(number, 100_000)));
}

#[test]
fn a_compressed_message_that_grows_beyond_all_bounds_is_damage_and_costs_no_other() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.db3");
    let database = tables(&path, 4);
    let bomb = zstd::stream::encode_all(std::io::repeat(0).take(200 << 20), 1).unwrap();
    for (number, frame) in
        [zstd::bulk::compress(&data(0, 50), 3).unwrap(), bomb, data(2, 50)].into_iter().enumerate()
    {
        let row = rusqlite::params![number as i64, frame];
        database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES (1, ?1, ?2)", row).unwrap();
    }
    let (numbers, said) = read(&path);
    assert_eq!(numbers, [0, 2]);
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(said[0].contains("message 2 is ") && said[0].contains("decompress to more than"), "{said:?}");
}

#[test]
fn reading_changes_nothing_in_the_directory_and_needs_no_right_to_write_there() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("strange ?#%41 name.db3");
    // Marked as a database with a write-ahead log, which SQLite itself would make beside it.
    let database = tables(&path, 4);
    database.query_row("PRAGMA journal_mode = WAL", [], |_| Ok(())).unwrap();
    add(&database, 0..100, 50);
    database.close().unwrap();
    let before = std::fs::read(&path).unwrap();
    std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o400)).unwrap();
    std::fs::set_permissions(directory.path(), std::fs::Permissions::from_mode(0o500)).unwrap();
    let read = read(&path);
    let names = names_in(directory.path());
    std::fs::set_permissions(directory.path(), std::fs::Permissions::from_mode(0o700)).unwrap();
    assert_eq!(read, ((0..100).collect(), vec![]));
    assert_eq!(names, BTreeSet::from(["strange ?#%41 name.db3".to_owned()]));
    assert_eq!(std::fs::read(&path).unwrap(), before);
}

#[test]
fn what_is_still_in_the_log_of_a_running_or_killed_recorder_is_read_too() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.db3");
    let database = tables(&path, 4);
    database.query_row("PRAGMA journal_mode = WAL", [], |_| Ok(())).unwrap();
    add(&database, 0..2000, 100);
    database.query_row("PRAGMA wal_checkpoint(TRUNCATE)", [], |_| Ok(())).unwrap();
    // Too little for SQLite to move it into the database by itself.
    add(&database, 2000..2100, 100);
    let live = read(&path);
    // A recorder that is killed leaves all files as they are.
    let left_behind = tempfile::tempdir().unwrap();
    for name in ["a.db3", "a.db3-wal"] {
        std::fs::copy(directory.path().join(name), left_behind.path().join(name)).unwrap();
    }
    drop(database);
    assert_eq!(live, ((0..2100).collect(), vec![]));
    assert_eq!(read(&left_behind.path().join("a.db3")), ((0..2100).collect(), vec![]));
    assert_eq!(names_in(left_behind.path()), BTreeSet::from(["a.db3".to_owned(), "a.db3-wal".to_owned()]));
    // A log cut inside a transaction counts up to the last whole one.
    change(&left_behind.path().join("a.db3-wal"), |log| log.truncate(log.len() - 10));
    assert_eq!(read(&left_behind.path().join("a.db3")).0, (0..2000).collect::<Vec<_>>());
}
