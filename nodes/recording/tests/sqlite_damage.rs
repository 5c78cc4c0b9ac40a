//! Broken and hostile databases: what can be read is read, what is lost is said, and nothing is executed.
#![cfg(feature = "sqlite")]

mod database;

use std::path::PathBuf;
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
    assert_eq!(read(&path).0, without(&[]));
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
