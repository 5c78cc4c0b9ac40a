//! SQLite databases with broken pages, and databases that are no recordings.

use std::path::PathBuf;

use recording::cdr::{Message, encode};
use recording::messages::PoseStamped;
use rusqlite::{Connection, params};

use super::Expected::{Damaged, Unreadable, Whole};
use super::whole::{POSE_TEXT, log_time_ns, pose};
use super::{Case, Expected};

const PAGE: usize = 4096;
const COUNT: u64 = 2000;
/// As rosbag2 of Jazzy makes them.
const TABLES: &str = "
CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);
CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata TEXT NOT NULL);
CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, serialization_format TEXT NOT NULL,
  offered_qos_profiles TEXT NOT NULL, type_description_hash TEXT NOT NULL);
CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, encoding TEXT NOT NULL,
  encoded_message_definition TEXT NOT NULL, type_description_hash TEXT NOT NULL);
CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL);
CREATE INDEX timestamp_idx ON messages (timestamp ASC);
INSERT INTO schema VALUES (4, 'jazzy');";

pub fn cases() -> Vec<Case> {
    let whole = database(COUNT);
    let pages = whole.len() / PAGE;
    let with_garbage = |places: &[usize]| {
        let mut bytes = whole.clone();
        for page in places {
            let mut state = 0x2545_f491_u32;
            for byte in &mut bytes[page * PAGE..(page + 1) * PAGE] {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                *byte = (state >> 24) as u8;
            }
        }
        bytes
    };
    let mut other_tables = Vec::new();
    other_tables.extend(saved(|connection| {
        connection.execute_batch("CREATE TABLE notes(id INTEGER PRIMARY KEY, text TEXT)").unwrap();
    }));
    let mut magic = whole.clone();
    magic[3] = b'X';
    let file =
        |name, expected: Expected, words, readable, bytes| Case::file(name, expected, words, readable, bytes);
    vec![
        file("whole.db3", Whole, &["whole"], COUNT, whole.clone()),
        file("empty.db3", Unreadable, &["empty"], 0, Vec::new()),
        file("wrong_magic.db3", Damaged, &["magic"], COUNT, magic),
        file(
            "garbage_pages.db3",
            Damaged,
            &["garbage_pages.db3"],
            COUNT / 2,
            with_garbage(&[pages / 2, pages / 2 + 1]),
        ),
        file(
            "garbage_last_page.db3",
            Damaged,
            &["garbage_last_page.db3"],
            COUNT / 2,
            with_garbage(&[pages - 1]),
        ),
        file("garbage_first_page.db3", Damaged, &["magic"], COUNT, with_garbage(&[0])),
        file("cut.db3", Damaged, &["cut.db3"], COUNT / 3, whole[..whole.len() / 2 + 100].to_vec()),
        logged("log_flipped", Damaged, &["log_0.db3-wal", "broken pages in the log: 1"], COUNT, |log| {
            log[LOG_FRAMES + FRAME + 200] ^= 1;
        }),
        logged("log_head_flipped", Damaged, &["broken heads in the log: 1"], COUNT, |log| log[17] ^= 1),
        logged("log_of_garbage", Damaged, &["log is broken", "bytes"], COUNT / 2, |log| {
            (0..).zip(log.iter_mut()).for_each(|(at, byte): (usize, &mut u8)| *byte = ((at * at) >> 3) as u8);
        }),
        logged("log_of_a_killed_recorder", Damaged, &["metadata.yaml"], COUNT, |_| {}),
        file("other_tables.db3", Unreadable, &["other_tables.db3"], 0, other_tables),
    ]
}

/// Where the frames of a write-ahead log begin, and the size of one.
const LOG_FRAMES: usize = 32;
const FRAME: usize = 24 + PAGE;

/// A directory whose recorder was killed: half of the poses are in the write-ahead log alone, which `change` breaks.
fn logged(
    name: &'static str,
    expected: Expected,
    words: &'static [&'static str],
    readable: u64,
    change: impl FnOnce(&mut [u8]),
) -> Case {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("log_0.db3");
    let connection = Connection::open(&path).unwrap();
    connection.execute_batch(&format!("PRAGMA page_size = {PAGE}")).unwrap();
    connection.query_row("PRAGMA journal_mode = WAL", [], |_| Ok(())).unwrap();
    connection.query_row("PRAGMA wal_autocheckpoint = 0", [], |_| Ok(())).unwrap();
    connection.execute_batch("BEGIN").unwrap();
    fill(&connection, COUNT / 2);
    connection.execute_batch("COMMIT").unwrap();
    connection.query_row("PRAGMA wal_checkpoint(TRUNCATE)", [], |_| Ok(())).unwrap();
    let mut insert =
        connection.prepare("INSERT INTO messages (topic_id, timestamp, data) VALUES (1, ?1, ?2)").unwrap();
    // A transaction for each, so that the last page of the table is in the log again and again.
    for number in COUNT / 2..COUNT {
        insert.execute(params![log_time_ns(number) as i64, encode(&pose(number))]).unwrap();
    }
    let database = std::fs::read(&path).unwrap();
    let mut log = std::fs::read(path.with_extension("db3-wal")).unwrap();
    change(&mut log);
    Case {
        name,
        expected,
        words,
        readable,
        files: vec![(PathBuf::from("log_0.db3"), database), (PathBuf::from("log_0.db3-wal"), log)],
    }
}

/// A database of poses.
pub fn database(count: u64) -> Vec<u8> {
    saved(|connection| fill(connection, count))
}

/// Tables, a topic and its poses.
pub fn fill(connection: &Connection, count: u64) {
    connection.execute_batch(TABLES).unwrap();
    let topic = "INSERT INTO topics VALUES (1, '/measured_cp', ?1, 'cdr', '', 'RIHS01_0f')";
    connection.execute(topic, [PoseStamped::TYPE_NAME]).unwrap();
    let definition = "INSERT INTO message_definitions VALUES (1, ?1, 'ros2msg', ?2, 'RIHS01_0f')";
    connection.execute(definition, [PoseStamped::TYPE_NAME, POSE_TEXT]).unwrap();
    let mut insert =
        connection.prepare("INSERT INTO messages (topic_id, timestamp, data) VALUES (1, ?1, ?2)").unwrap();
    for number in 0..count {
        insert.execute(params![log_time_ns(number) as i64, encode(&pose(number))]).unwrap();
    }
}

/// The bytes of a database that `fill` fills.
pub fn saved(fill: impl FnOnce(&Connection)) -> Vec<u8> {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("made.db3");
    let connection = Connection::open(&path).unwrap();
    connection.execute_batch(&format!("PRAGMA page_size = {PAGE}; BEGIN")).unwrap();
    fill(&connection);
    connection.execute_batch("COMMIT").unwrap();
    drop(connection);
    std::fs::read(path).unwrap()
}
