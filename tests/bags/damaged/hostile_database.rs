//! Databases that are made to cost time and memory.

use rusqlite::{Connection, params};

use super::sqlite_file::{self, saved};
use super::whole::log_time_ns;

const PAGE: usize = 4096;

/// Names and bytes.
pub fn files() -> Vec<(&'static str, Vec<u8>)> {
    vec![
        ("qos_nested.db3", with_qos(&"[".repeat(9_000_000))),
        ("qos_of_numbers.db3", with_qos(&format!("[{}1]", "1,".repeat(4_400_000)))),
        ("definition_of_many.db3", saved(definition_of_many)),
        ("tiny_topics.db3", saved(tiny_topics)),
        ("message_bombs.db3", saved(|connection| bombs(connection, &zeros(60 << 20, true), 3300))),
        ("message_bombs_unsaid.db3", saved(|connection| bombs(connection, &zeros(60 << 20, false), 3300))),
        ("tiny_messages_with_gaps.db3", broken_magic(saved(tiny_messages))),
        ("texts_that_share_pages.db3", shared_texts()),
    ]
}

fn with_qos(qos: &str) -> Vec<u8> {
    saved(|connection| {
        sqlite_file::fill(connection, 500);
        connection.execute("UPDATE topics SET offered_qos_profiles = ?1", [qos]).unwrap();
    })
}

fn definition_of_many(connection: &Connection) {
    sqlite_file::fill(connection, 500);
    let text = "#".repeat(5_000_000);
    connection
        .execute("INSERT INTO message_definitions VALUES (2, 'a/msg/B', 'ros2msg', ?1, '')", [text])
        .unwrap();
    let mut insert =
        connection.prepare("INSERT INTO topics VALUES (?1, ?2, 'a/msg/B', 'cdr', '', '')").unwrap();
    for id in 2..20_000 {
        insert.execute(params![id, format!("/{id}")]).unwrap();
    }
}

fn tiny_topics(connection: &Connection) {
    sqlite_file::fill(connection, 500);
    let mut insert = connection.prepare("INSERT INTO topics VALUES (?1, ?2, 'a', 'cdr', '', '')").unwrap();
    for id in 2..400_000 {
        insert.execute(params![id, format!("/{id}")]).unwrap();
    }
}

fn tiny_messages(connection: &Connection) {
    sqlite_file::fill(connection, 0);
    connection.execute_batch("DROP INDEX timestamp_idx").unwrap();
    let mut insert = connection
        .prepare("INSERT INTO messages (id, topic_id, timestamp, data) VALUES (?1, 1, ?2, x'')")
        .unwrap();
    for number in 0..600_000 {
        insert.execute([2 * number, number]).unwrap();
    }
}

fn broken_magic(mut bytes: Vec<u8>) -> Vec<u8> {
    bytes[3] = b'X';
    bytes
}

fn bombs(connection: &Connection, bomb: &[u8], count: u64) {
    sqlite_file::fill(connection, 0);
    let mut insert =
        connection.prepare("INSERT INTO messages (topic_id, timestamp, data) VALUES (1, ?1, ?2)").unwrap();
    for number in 0..count {
        insert.execute(params![log_time_ns(number) as i64, bomb]).unwrap();
    }
}

/// A frame of zstd with four bytes for each 128 KiB of zeros, which says its size or does not.
fn zeros(size: u64, is_said: bool) -> Vec<u8> {
    const BLOCK: u64 = 128 << 10;
    let mut frame = vec![0x28, 0xb5, 0x2f, 0xfd];
    if is_said {
        frame.extend([0xc0, 0x38]);
        frame.extend(size.to_le_bytes());
    } else {
        frame.extend([0x00, 0x38]);
    }
    let mut left = size;
    while left > 0 {
        let length = left.min(BLOCK);
        left -= length;
        let head = u32::from(left == 0) | 2 | (length as u32) << 3;
        frame.extend(&head.to_le_bytes()[..3]);
        frame.push(0);
    }
    frame
}

/// Pages of rows whose texts all go on in the same page, which goes on in itself: each row is 9 MB long.
fn shared_texts() -> Vec<u8> {
    const PAGES: usize = 2400;
    const LOOP: u32 = 1200;
    let varint = |mut value: u64| {
        let mut bytes = vec![(value & 0x7f) as u8];
        while value > 0x7f {
            value >>= 7;
            bytes.insert(0, (value & 0x7f) as u8 | 0x80);
        }
        bytes
    };
    // What stays on the leaf itself of a row that goes on elsewhere.
    let local = (PAGE - 12) * 32 / 255 - 23;
    let size = local + 9_000_000 / (PAGE - 4) * (PAGE - 4);
    let mut pages = vec![0; PAGES * PAGE];
    let mut id = 0;
    for page in pages.chunks_mut(PAGE).take(LOOP as usize - 100).skip(1) {
        let mut end = PAGE;
        let mut count = 0;
        loop {
            // The columns: nothing, two short texts, and a long one.
            let mut columns = vec![0];
            [2, 2].iter().for_each(|length| columns.extend(varint(13 + 2 * length)));
            let long = size - 1 - columns.len() - 4 - 4;
            columns.extend(varint(13 + 2 * long as u64));
            let mut content = varint(columns.len() as u64 + 1);
            content.extend(columns);
            content.extend(b"/xab");
            content.resize(local, b'x');
            let mut row = varint(size as u64);
            row.extend(varint(id));
            row.extend(content);
            row.extend(LOOP.to_be_bytes());
            if end < row.len() + 8 + 2 * (count + 1) {
                break;
            }
            end -= row.len();
            page[end..end + row.len()].copy_from_slice(&row);
            page[8 + 2 * count..][..2].copy_from_slice(&(end as u16).to_be_bytes());
            count += 1;
            id += 1;
        }
        page[0] = 0x0d;
        page[3..5].copy_from_slice(&(count as u16).to_be_bytes());
        page[5..7].copy_from_slice(&(end as u16).to_be_bytes());
    }
    pages[(LOOP as usize - 1) * PAGE..][..4].copy_from_slice(&LOOP.to_be_bytes());
    pages
}
