//! Databases for tests, built as the versions of rosbag2 build them: what a message contains follows from its number.
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests, which may panic")]
#![allow(dead_code, reason = "each test file uses what it needs")]

use std::ops::Range;
use std::path::Path;

use recording::{Error, Message, Recording};
use rusqlite::Connection;

pub(crate) const START_NS: i64 = 1_700_000_000_000_000_000;
pub(crate) const STEP_NS: i64 = 1_000_000;
/// Version 9 of the metadata: words. Versions before 9: numbers.
pub(crate) const QOS_WORDS: &str = "- history: keep_last\n  depth: 5\n  reliability: reliable\n  durability: transient_local\n  deadline:\n    sec: 9223372036\n    nsec: 854775807\n  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n  liveliness: automatic\n  liveliness_lease_duration:\n    sec: 9223372036\n    nsec: 854775807\n  avoid_ros_namespace_conventions: false";
pub(crate) const QOS_NUMBERS: &str = "- history: 1\n  depth: 5\n  reliability: 1\n  durability: 1\n  deadline:\n    sec: 9223372036\n    nsec: 854775807\n  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n  liveliness: 1\n  liveliness_lease_duration:\n    sec: 9223372036\n    nsec: 854775807\n  avoid_ros_namespace_conventions: false";
pub(crate) const HASH: &str = "RIHS01_ab";
pub(crate) const TEXT: &str = "std_msgs/Header header\n";

/// A database with the tables of a version of rosbag2's schema, 1 to 4, and the topics 1 `/pose` and 2 `/force`.
pub(crate) fn tables(path: &Path, version: u32) -> Connection {
    let database = Connection::open(path).unwrap();
    let mut columns =
        "id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, serialization_format TEXT NOT NULL"
            .to_owned();
    if version >= 2 {
        columns.push_str(", offered_qos_profiles TEXT NOT NULL");
    }
    if version >= 3 {
        database
            .execute_batch(
                "CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
                 CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);",
            )
            .unwrap();
        database.execute("INSERT INTO schema VALUES (?1, 'jazzy')", [version]).unwrap();
    }
    if version >= 4 {
        columns.push_str(", type_description_hash TEXT NOT NULL");
        database
            .execute_batch(
                "CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding TEXT NOT NULL,
                 encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL);",
            )
            .unwrap();
        let row = "INSERT INTO message_definitions(topic_type, encoding, encoded_message_definition, type_description_hash)
                   VALUES ('geometry_msgs/msg/PoseStamped', 'ros2msg', ?1, ?2)";
        database.execute(row, [TEXT, HASH]).unwrap();
    }
    database
        .execute_batch(&format!(
            "CREATE TABLE topics({columns});
             CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL);
             CREATE INDEX timestamp_idx ON messages (timestamp ASC);"
        ))
        .unwrap();
    for (name, type_name) in
        [("/pose", "geometry_msgs/msg/PoseStamped"), ("/force", "geometry_msgs/msg/WrenchStamped")]
    {
        let qos = if version < 4 { QOS_NUMBERS } else { QOS_WORDS };
        let texts = [name, type_name, "cdr", qos, if name == "/pose" { HASH } else { "" }];
        let (marks, count) = match version {
            1 => ("?1, ?2, ?3", 3),
            2 | 3 => ("?1, ?2, ?3, ?4", 4),
            _ => ("?1, ?2, ?3, ?4, ?5", 5),
        };
        let sql = format!("INSERT INTO topics VALUES (NULL, {marks})");
        database.execute(&sql, rusqlite::params_from_iter(&texts[..count])).unwrap();
    }
    database
}

/// The bytes of message `number`: CDR head, the number, and some more up to `size`.
pub(crate) fn data(number: i64, size: usize) -> Vec<u8> {
    let mut data = vec![0, 1, 0, 0];
    data.extend(number.to_le_bytes());
    data.resize(size.max(data.len()), number as u8);
    data
}

/// Adds messages `numbers` in one transaction, 1 ms apart, even ones on `/pose` and odd ones on `/force`.
pub(crate) fn add(database: &Connection, numbers: Range<i64>, size: usize) {
    database.execute_batch("BEGIN").unwrap();
    let mut statement =
        database.prepare("INSERT INTO messages(topic_id, timestamp, data) VALUES (?1, ?2, ?3)").unwrap();
    for number in numbers {
        statement
            .execute(rusqlite::params![1 + number % 2, START_NS + number * STEP_NS, data(number, size)])
            .unwrap();
    }
    database.execute_batch("COMMIT").unwrap();
}

/// A closed recording of `count` messages of `size` bytes in the file `path`.
pub(crate) fn recorded(path: &Path, count: i64, size: usize) {
    let database = tables(path, 4);
    add(&database, 0..count, size);
    // Each message's pages are in a row.
    database.execute_batch("VACUUM").unwrap();
    database.close().unwrap();
}

/// The number in a message; -1 in a shorter one than [`data`] makes.
pub(crate) fn number(message: &Message) -> i64 {
    let bytes = message.data.get(4..).and_then(|rest| rest.first_chunk());
    bytes.map_or(-1, |bytes| i64::from_le_bytes(*bytes))
}

/// Numbers of all messages that can be read, and everything that is said about those that cannot, on opening and reading.
pub(crate) fn read(path: &Path) -> (Vec<i64>, Vec<String>) {
    let recording = Recording::open(path).unwrap();
    let mut said: Vec<_> = recording.damage().iter().map(Error::to_string).collect();
    let mut numbers = Vec::new();
    for item in recording.messages() {
        match item {
            Ok(message) => numbers.push(number(&message)),
            Err(error) => said.push(error.to_string()),
        }
    }
    (numbers, said)
}

/// Why a file does not open.
pub(crate) fn refusal(path: &Path) -> String {
    match Recording::open(path) {
        Ok(_) => panic!("{} opens", path.display()),
        Err(error) => error.to_string(),
    }
}

/// Size of a page, bytes.
pub(crate) const PAGE: usize = 4096;

/// Changes the bytes of a file.
pub(crate) fn change(path: &Path, change: impl FnOnce(&mut Vec<u8>)) {
    let mut bytes = std::fs::read(path).unwrap();
    change(&mut bytes);
    std::fs::write(path, bytes).unwrap();
}

/// Fills a page, counted from 1, with what is no page.
pub(crate) fn spoil(path: &Path, page: usize) {
    change(path, |bytes| {
        let end = bytes.len().min(page * PAGE);
        bytes[(page - 1) * PAGE..end].fill(0xa5);
    });
}

/// The pages of a table or an index, counted from 1: its `leaf`, `internal` or `overflow` pages.
pub(crate) fn pages_of(path: &Path, name: &str, kind: &str) -> Vec<usize> {
    let database = Connection::open(path).unwrap();
    let sql = "SELECT pageno FROM dbstat WHERE name = ?1 AND pagetype = ?2 ORDER BY pageno";
    let mut statement = database.prepare(sql).unwrap();
    let pages = statement.query_map([name, kind], |row| row.get::<_, u32>(0)).unwrap();
    pages.map(|page| page.unwrap() as usize).collect()
}

/// Numbers of the messages in the rows of a leaf, counted from 1. Between the rows are copies of what other pages have now.
pub(crate) fn numbers_on(path: &Path, page: usize) -> Vec<i64> {
    let bytes = std::fs::read(path).unwrap();
    let page = &bytes[(page - 1) * PAGE..page * PAGE];
    let rows = usize::from(u16::from_be_bytes([page[3], page[4]]));
    let begin = |row: usize| usize::from(u16::from_be_bytes([page[8 + 2 * row], page[9 + 2 * row]]));
    let number = |row: usize| {
        let mut rest = page[begin(row)..].windows(12);
        let data = rest.find(|data| data.starts_with(&[0, 1, 0, 0])).unwrap();
        i64::from_le_bytes(*data[4..].first_chunk().unwrap())
    };
    (0..rows).map(number).collect()
}
