//! SQLite databases with broken pages, and databases that are no recordings.

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
        file("other_tables.db3", Unreadable, &["other_tables.db3"], 0, other_tables),
    ]
}

/// A database of poses.
pub fn database(count: u64) -> Vec<u8> {
    saved(|connection| {
        connection.execute_batch(TABLES).unwrap();
        let topic = "INSERT INTO topics VALUES (1, '/measured_cp', ?1, 'cdr', '', 'RIHS01_0f')";
        connection.execute(topic, [PoseStamped::TYPE_NAME]).unwrap();
        let definition = "INSERT INTO message_definitions VALUES (1, ?1, 'ros2msg', ?2, 'RIHS01_0f')";
        connection.execute(definition, [PoseStamped::TYPE_NAME, POSE_TEXT]).unwrap();
        let mut insert = connection
            .prepare("INSERT INTO messages (topic_id, timestamp, data) VALUES (1, ?1, ?2)")
            .unwrap();
        for number in 0..count {
            insert.execute(params![log_time_ns(number) as i64, encode(&pose(number))]).unwrap();
        }
    })
}

/// The bytes of a database that `fill` fills.
fn saved(fill: impl FnOnce(&Connection)) -> Vec<u8> {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("made.db3");
    let connection = Connection::open(&path).unwrap();
    connection.execute_batch(&format!("PRAGMA page_size = {PAGE}; BEGIN")).unwrap();
    fill(&connection);
    connection.execute_batch("COMMIT").unwrap();
    drop(connection);
    std::fs::read(path).unwrap()
}
