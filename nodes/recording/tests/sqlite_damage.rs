//! Broken and hostile databases: what can be read is read, what is lost is said, and nothing is executed.
#![cfg(feature = "sqlite")]
#![allow(clippy::unwrap_used, reason = "helpers of tests, which may panic")]

mod database;

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use database::*;
use proptest::prelude::*;
use recording::Recording;
use tempfile::TempDir;

const COUNT: i64 = 3000;
const SIZE: usize = 100;

/// A recording of [`COUNT`] messages.
fn recording() -> (TempDir, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.db3");
    recorded(&path, COUNT, SIZE);
    (directory, path)
}

fn without(lost: &[i64]) -> Vec<i64> {
    (0..COUNT).filter(|number| !lost.contains(number)).collect()
}

#[test]
fn a_leaf_of_garbage_costs_its_own_messages_and_they_are_counted_with_their_place() {
    let (_directory, path) = recording();
    let leaves = pages_of(&path, "messages", "leaf");
    let spoiled = leaves[leaves.len() / 2];
    let lost = numbers_on(&path, spoiled);
    spoil(&path, spoiled);
    let (numbers, said) = read(&path);
    assert_eq!(numbers, without(&lost));
    let (first, last) = (lost[0] + 1, lost[lost.len() - 1] + 1);
    let sentence = format!("messages lost: {}, with the ids {first} to {last}", lost.len());
    let place = format!("at byte {}: ", (spoiled - 1) * PAGE);
    assert!(said.iter().any(|said| said.contains(&sentence) && said.contains(&place)), "{said:?}");
}

#[test]
fn behind_a_broken_inner_page_nothing_is_lost() {
    let (_directory, path) = recording();
    let inner = pages_of(&path, "messages", "internal");
    spoil(&path, inner[0]);
    let (numbers, said) = read(&path);
    assert_eq!(numbers, without(&[]));
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(said[0].contains(&format!("at byte {}: ", (inner[0] - 1) * PAGE)), "{said:?}");
}

#[test]
fn without_the_first_page_topics_and_messages_are_found() {
    let (_directory, path) = recording();
    spoil(&path, 1);
    let recording = Recording::open(&path).unwrap();
    let topics: Vec<_> = recording.topics().iter().map(|found| &found.topic).collect();
    assert_eq!([topics[0].name.as_str(), topics[1].name.as_str()], ["/pose", "/force"]);
    assert_eq!((topics[0].definition.text.as_str(), topics[0].definition.type_hash.as_str()), (TEXT, HASH));
    assert_eq!(topics[0].offered_qos.len(), 1);
    let (numbers, said) = read(&path);
    assert_eq!(numbers, without(&[]));
    assert!(said[0].contains("does not begin with the SQLite magic bytes"), "{said:?}");
}

#[test]
fn a_broken_index_costs_nothing() {
    let (_directory, path) = recording();
    for page in pages_of(&path, "timestamp_idx", "leaf") {
        spoil(&path, page);
    }
    assert_eq!(read(&path), (without(&[]), vec![]));
}

#[test]
fn a_cut_file_gives_what_is_in_front_of_the_cut() {
    let (_directory, path) = recording();
    let leaves = pages_of(&path, "messages", "leaf");
    let cut = leaves[leaves.len() / 2];
    let kept: Vec<_> =
        leaves.iter().filter(|leaf| **leaf < cut).flat_map(|leaf| numbers_on(&path, *leaf)).collect();
    change(&path, |bytes| bytes.truncate((cut - 1) * PAGE + 1000));
    let (numbers, said) = read(&path);
    assert!(kept.iter().all(|number| numbers.contains(number)), "{} of {}", numbers.len(), kept.len());
    assert!(said.iter().any(|said| said.contains(&format!("the file is cut: {cut} of "))), "{said:?}");
}

#[test]
fn a_message_whose_continuation_is_broken_is_lost_alone_also_where_more_is_broken() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.db3");
    recorded(&path, 100, 20_000);
    let overflow = pages_of(&path, "messages", "overflow");
    let inner = pages_of(&path, "messages", "internal");
    // On the first page of a chain, the link to the next one leads nowhere.
    let broken = overflow[50 * (overflow.len() / 100)];
    change(&path, |bytes| bytes[(broken - 1) * PAGE..][..4].fill(0xff));
    let (numbers, said) = read(&path);
    assert_eq!(numbers.len(), 99);
    assert!(said.len() == 1 && said[0].contains("cannot be read"), "{said:?}");
    spoil(&path, inner[0]);
    let (numbers, said) = read(&path);
    assert_eq!(numbers.len(), 99);
    assert!(said.iter().any(|said| said.contains("the pages on which it continues are broken")), "{said:?}");
}

#[test]
fn a_tree_that_leads_back_into_itself_ends() {
    let (_directory, path) = recording();
    let inner = pages_of(&path, "messages", "internal")[0];
    // The last child of the root becomes its first leaf.
    change(&path, |bytes| {
        let root = &mut bytes[(inner - 1) * PAGE..][..PAGE];
        let cell = usize::from(u16::from_be_bytes([root[12], root[13]]));
        root.copy_within(cell..cell + 4, 8);
    });
    let (numbers, said) = read(&path);
    assert_eq!(numbers, without(&[]));
    assert!(said.iter().any(|said| said.contains("leads back into itself")), "{said:?}");
}

#[test]
fn a_wrong_number_on_the_way_to_a_row_costs_nothing() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.db3");
    recorded(&path, 30_000, SIZE);
    let inner = pages_of(&path, "messages", "internal");
    // Every number at which the way forks becomes smaller; the links themselves are whole.
    change(&path, |bytes| {
        for page in inner {
            let page = &mut bytes[(page - 1) * PAGE..][..PAGE];
            for place in 0..usize::from(u16::from_be_bytes([page[3], page[4]])) {
                let cell = usize::from(u16::from_be_bytes([page[12 + 2 * place], page[13 + 2 * place]]));
                page[cell + 4] &= 0x80;
            }
        }
    });
    let (numbers, said) = read(&path);
    assert_eq!(numbers, (0..30_000).collect::<Vec<_>>(), "{said:?}");
    assert!(said.iter().any(|said| said.contains("is not where the table says")), "{said:?}");
}

#[test]
fn rows_that_are_no_messages_are_counted_by_what_is_wrong_and_cost_no_other() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.db3");
    let database = tables(&path, 4);
    database
        .execute_batch(
            "DROP TABLE messages; CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, data);
             INSERT INTO messages(topic_id, timestamp, data) VALUES
             (1, 1, NULL), (1, 1, 'text'), (1, -5, x'00'), (1, NULL, x'00'), ('x', 1, x'00'), (7, 5, x'00'),
             (1, 5, x'000100000000000000000000'), (1, 6, zeroblob(67108865)), (1, 2.5, x'00');",
        )
        .unwrap();
    let (numbers, said) = read(&path);
    assert_eq!(numbers, [0]);
    for part in [
        "topic that is nowhere described: 2, the first with id 5",
        "negative time or none: 3, the first with id 3 (-5 ns)",
        "something else than bytes as their data: 2, the first with id 1",
        "larger than the accepted 67108864 bytes: 1, the first with id 8 (67108865 bytes)",
    ] {
        assert!(said.iter().any(|said| said.contains(part)), "{part}: {said:?}");
    }
}

#[test]
fn what_is_no_plain_table_is_refused_by_name_and_not_executed() {
    let endless = "WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c)
                   SELECT x AS id, 1 AS topic_id, x AS timestamp, zeroblob(1000) AS data FROM c";
    for (sql, reason) in [
        (format!("CREATE VIEW messages AS {endless}"), "\"messages\" is of the kind \"view\""),
        (
            "CREATE VIRTUAL TABLE messages USING fts3(id, topic_id, timestamp, data)".into(),
            "of the kind \"virtual\"",
        ),
        (
            "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, data AS (zeroblob(1000000)))"
                .into(),
            "column \"data\" of its table \"messages\" is computed",
        ),
        (
            "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, data) WITHOUT ROWID".into(),
            "\"messages\" has no row numbers",
        ),
        ("CREATE TABLE messages(id TEXT, topic_id, timestamp, data)".into(), "not its integer primary key"),
    ] {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.db3");
        let database = tables(&path, 4);
        database.execute_batch("DROP TABLE messages").unwrap();
        database.execute_batch(&sql).unwrap();
        let said = refusal(&path);
        assert!(said.contains(reason), "{said}");
    }
}

#[test]
fn what_is_no_database_says_so() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.db3");
    std::fs::write(&path, "").unwrap();
    assert!(refusal(&path).contains("the file is empty"));
    std::fs::write(&path, "bag of something else").unwrap();
    assert!(refusal(&path).contains("does not begin with the SQLite magic bytes"));
    std::fs::write(&path, [b"SQLite format 3\0".as_slice(), &[0xff; 5000]].concat()).unwrap();
    assert!(refusal(&path).contains("not a recording"));
    std::fs::remove_file(&path).unwrap();
    rusqlite::Connection::open(&path)
        .unwrap()
        .execute_batch("CREATE TABLE cars(id INTEGER PRIMARY KEY)")
        .unwrap();
    assert!(refusal(&path).contains("no table \"topics\""));
}

#[test]
fn a_journal_left_behind_is_said_and_never_rolled_back() {
    let (_directory, path) = recording();
    let journal = path.with_extension("db3-journal");
    std::fs::write(&journal, [0xd9; 600]).unwrap();
    let (numbers, said) = read(&path);
    assert_eq!(numbers, without(&[]));
    assert!(
        said.len() == 1 && said[0].contains("a.db3-journal") && said[0].contains("was stopped"),
        "{said:?}"
    );
    assert!(journal.exists());
}

#[test]
fn a_log_that_is_none_is_said_and_the_database_read() {
    let (_directory, path) = recording();
    std::fs::write(path.with_extension("db3-wal"), [0xd9; 6000]).unwrap();
    let (numbers, said) = read(&path);
    assert_eq!(numbers, without(&[]));
    assert!(said.len() == 1 && said[0].contains("a.db3-wal") && said[0].contains("6000 bytes"), "{said:?}");
}

/// Messages that are in the database and those that are in its log alone, one transaction each.
const MERGED: i64 = 100;
const LOGGED: i64 = 200;
/// Of a log, and of a frame in it in front of its page.
const LOG_HEAD: usize = 32;
const FRAME_HEAD: usize = 24;

/// A recording as a recorder leaves it that was killed: database and log.
fn killed() -> (TempDir, PathBuf, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let (path, log) = (directory.path().join("a.db3"), directory.path().join("a.db3-wal"));
    std::fs::write(&path, &KILLED.0).unwrap();
    std::fs::write(&log, &KILLED.1).unwrap();
    (directory, path, log)
}

static KILLED: LazyLock<(Vec<u8>, Vec<u8>)> = LazyLock::new(|| {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.db3");
    let database = tables(&path, 4);
    database.query_row("PRAGMA journal_mode = WAL", [], |_| Ok(())).unwrap();
    database.query_row("PRAGMA wal_autocheckpoint = 0", [], |_| Ok(())).unwrap();
    add(&database, 0..MERGED, SIZE);
    database.query_row("PRAGMA wal_checkpoint(TRUNCATE)", [], |_| Ok(())).unwrap();
    for number in MERGED..MERGED + LOGGED {
        add(&database, number..number + 1, SIZE);
    }
    (std::fs::read(&path).unwrap(), std::fs::read(path.with_extension("db3-wal")).unwrap())
});

/// A copy of database and log while both are open.
fn left_behind(path: &Path) -> (TempDir, PathBuf, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let (database, log) = (directory.path().join("a.db3"), directory.path().join("a.db3-wal"));
    std::fs::copy(path, &database).unwrap();
    std::fs::copy(path.with_extension("db3-wal"), &log).unwrap();
    (directory, database, log)
}

fn flip(path: &Path, at: usize) {
    change(path, |bytes| bytes[at] ^= 1);
}

#[test]
fn one_bit_of_a_log_costs_no_message_that_another_page_of_it_has_and_is_said() {
    let (_directory, path, log) = killed();
    let all: Vec<i64> = (0..MERGED + LOGGED).collect();
    assert_eq!(read(&path), (all.clone(), vec![]));
    let frame = FRAME_HEAD + PAGE;
    for (what, at, words) in [
        ("a page", LOG_HEAD + 2 * frame + FRAME_HEAD + 100, "broken pages in the log: 1, 4120 bytes"),
        ("the checksum of a page", LOG_HEAD + 5 * frame + 16, "broken pages in the log: 1, 4120 bytes"),
        ("the number of a page", LOG_HEAD + 7 * frame + 3, "broken pages in the log: 1, 4120 bytes"),
        ("the salt of a page", LOG_HEAD + 9 * frame + 8, "broken heads in the log: 1"),
        ("the salt of the log", 17, "broken heads in the log: 1"),
        ("the magic of the log", 0, "broken heads in the log: 1"),
        ("the order of bytes", 3, "broken heads in the log: 1"),
        ("the size of a page", 10, "broken heads in the log: 1"),
    ] {
        flip(&log, at);
        let (numbers, said) = read(&path);
        assert_eq!(numbers, all, "{what}: {said:?}");
        assert!(
            said.len() == 1 && said[0].contains("a.db3-wal") && said[0].contains(words),
            "{what}: {said:?}"
        );
        flip(&log, at);
    }
}

#[test]
fn a_broken_page_that_no_other_one_repeats_costs_its_messages_and_is_said() {
    let (_directory, path, log) = killed();
    // The last transaction of all.
    change(&log, |bytes| {
        let end = bytes.len();
        bytes[end - 100] ^= 1;
    });
    let (numbers, said) = read(&path);
    assert!(numbers.len() as i64 >= MERGED + LOGGED - 1, "{}", numbers.len());
    assert!(said[0].contains("broken pages in the log: 1"), "{said:?}");
}

#[test]
fn what_an_older_log_left_behind_is_normal_and_an_unfinished_transaction_is_said() {
    let live = tempfile::tempdir().unwrap();
    let path = live.path().join("a.db3");
    let database = tables(&path, 4);
    database.query_row("PRAGMA journal_mode = WAL", [], |_| Ok(())).unwrap();
    add(&database, 0..MERGED + LOGGED, SIZE);
    // The log begins anew and keeps its length.
    database.query_row("PRAGMA wal_checkpoint(RESTART)", [], |_| Ok(())).unwrap();
    add(&database, MERGED + LOGGED..MERGED + LOGGED + 1, SIZE);
    let (_directory, path, log) = left_behind(&path);
    assert_eq!(read(&path), ((0..=MERGED + LOGGED).collect(), vec![]));
    drop(database);

    let (_directory, path, cut) = killed();
    assert!(std::fs::metadata(&log).unwrap().len() > 5 * PAGE as u64, "there is something left behind");
    change(&cut, |bytes| bytes.truncate(bytes.len() - 10));
    let (numbers, said) = read(&path);
    assert_eq!(numbers, (0..MERGED + LOGGED - 1).collect::<Vec<_>>());
    assert!(said.len() == 1 && said[0].contains("bytes at its end are not used"), "{said:?}");
}

#[test]
fn messages_that_do_not_say_how_large_they_are_count_with_what_they_take() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.db3");
    let database = tables(&path, 4);
    // As streams are compressed: nobody knew the size when the head was written.
    let unsaid = |bytes: &[u8]| zstd::stream::encode_all(bytes, 1).unwrap();
    let mut insert =
        database.prepare("INSERT INTO messages(topic_id, timestamp, data) VALUES (1, ?1, ?2)").unwrap();
    for number in 0..5000 {
        let frame = unsaid(&data(number, SIZE));
        insert.execute(rusqlite::params![START_NS + number, frame]).unwrap();
    }
    let (numbers, said) = read(&path);
    assert_eq!((numbers, said), ((0..5000).collect(), vec![]));
}

#[test]
fn texts_that_take_more_than_a_file_can_have_are_left_out_and_said() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.db3");
    let database = tables(&path, 4);
    add(&database, 0..10, SIZE);
    let long = "[".repeat(300_000);
    database.execute("UPDATE topics SET offered_qos_profiles = ?1 WHERE id = 2", [&long]).unwrap();
    let text = "#".repeat(4_000_000);
    database
        .execute("INSERT INTO message_definitions VALUES (9, 'a/msg/B', 'ros2msg', ?1, '')", [&text])
        .unwrap();
    for id in 10..30 {
        let row = rusqlite::params![id, format!("/{id}")];
        database.execute("INSERT INTO topics VALUES (?1, ?2, 'a/msg/B', 'cdr', '', '')", row).unwrap();
    }
    let (numbers, said) = read(&path);
    assert_eq!(numbers, (0..10).collect::<Vec<_>>());
    assert!(said.iter().any(|said| said.contains("topics left without theirs: 12")), "{said:?}");
    assert!(
        said.iter().any(|said| said.contains("qualities of service") && said.ends_with("theirs: 1")),
        "{said:?}"
    );
    let recording = Recording::open(&path).unwrap();
    assert_eq!(recording.topics().len(), 22, "the topics themselves are there");
    assert_eq!(recording.topics()[0].topic.offered_qos.len(), 1, "so are those that are not too long");
}

#[test]
fn without_any_topic_left_nothing_can_be_read() {
    let (_directory, path) = recording();
    spoil(&path, pages_of(&path, "topics", "leaf")[0]);
    let said = refusal(&path);
    assert!(said.contains("has no topics, and 3000 messages"), "{said}");
}

const FEW: i64 = 600;

/// A recording of [`FEW`] messages, and the pages of its table of messages with the numbers of what is on each.
struct Small {
    bytes: Vec<u8>,
    pages: Vec<(usize, Vec<i64>)>,
}

static SMALL: LazyLock<Small> = LazyLock::new(|| {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("a.db3");
    recorded(&path, FEW, SIZE);
    let leaves = pages_of(&path, "messages", "leaf").into_iter().map(|page| (page, numbers_on(&path, page)));
    let inner = pages_of(&path, "messages", "internal").into_iter().map(|page| (page, Vec::new()));
    let pages = leaves.chain(inner).collect();
    Small { bytes: std::fs::read(&path).unwrap(), pages }
});

type Place = prop::sample::Index;

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn flipped_bytes_on_pages_of_messages_cost_no_message_of_another_page(
        flips in proptest::collection::vec((any::<Place>(), any::<Place>(), 1..=255_u8), 1..20),
    ) {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.db3");
        let mut bytes = SMALL.bytes.clone();
        let mut touched = Vec::new();
        for (page, at, bits) in &flips {
            let (page, _) = page.get(&SMALL.pages);
            touched.push(*page);
            bytes[(page - 1) * PAGE + at.index(PAGE)] ^= bits;
        }
        std::fs::write(&path, bytes).unwrap();
        let (numbers, said) = read(&path);
        for (page, expected) in SMALL.pages.iter().filter(|(page, _)| !touched.contains(page)) {
            let missing = expected.iter().find(|number| !numbers.contains(number));
            prop_assert!(missing.is_none(), "message {missing:?} of page {page}: {said:?}");
        }
    }

    #[test]
    fn a_flipped_byte_of_a_log_is_always_said(at in any::<Place>(), bits in 1..=255_u8) {
        let (_directory, path, log) = killed();
        change(&log, |bytes| {
            let at = at.index(bytes.len());
            bytes[at] ^= bits;
        });
        let (numbers, said) = read(&path);
        prop_assert!(!said.is_empty());
        // One broken page costs what it alone had: at most the last transaction or a page of rows.
        prop_assert!(numbers.len() as i64 > MERGED + LOGGED - 40, "{}: {said:?}", numbers.len());
    }

    #[test]
    fn flipped_bytes_anywhere_end_in_messages_or_an_error(
        flips in proptest::collection::vec((any::<Place>(), 1..=255_u8), 1..30),
        head in proptest::collection::vec((0..PAGE, 1..=255_u8), 0..4),
    ) {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("a.db3");
        let mut bytes = SMALL.bytes.clone();
        for (at, bits) in flips.iter().map(|(at, bits)| (at.index(SMALL.bytes.len()), bits)).chain(head.iter().map(|(at, bits)| (*at, bits))) {
            bytes[at] ^= bits;
        }
        std::fs::write(&path, bytes).unwrap();
        if let Ok(recording) = Recording::open(&path) {
            // Every message and every error at most once.
            prop_assert!(recording.messages().count() <= 2 * FEW as usize);
        }
    }
}
