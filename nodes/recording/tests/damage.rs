//! Killed recorders and broken files: what is whole is read, what is not is said, and nothing panics.
#![allow(clippy::unwrap_used, reason = "helpers of tests, which may panic")]

mod common;

use std::path::Path;

use common::*;
use proptest::prelude::*;
use recording::{Recording, Writer};

/// The bytes of a closed recording of two seconds: four chunks or five.
fn whole_file() -> Vec<u8> {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    recorded(&path, 2000);
    std::fs::read(path.join("session_0.mcap")).unwrap()
}

#[test]
fn a_killed_recorder_loses_less_than_a_second() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    let mut writer = Writer::create(&path, "jazzy").unwrap();
    let topic = writer.add_topic(topic("/pose")).unwrap();
    write(&mut writer, topic, 0..3700);
    // As SIGKILL does: nothing of the writer runs any more.
    std::mem::forget(writer);
    let recording = Recording::open(&path).unwrap();
    assert_eq!(recording.damage().len(), 1);
    assert!(recording.damage()[0].to_string().contains("stopped hard"), "{}", recording.damage()[0]);
    let (messages, errors) = read(&recording);
    assert!(errors.is_empty());
    assert!(messages.len() > 2700 && messages.len() < 3700, "{}", messages.len());
    assert_eq!(recording.topics()[0].message_count, messages.len() as u64);
    for (number, message) in (0..).zip(&messages) {
        assert_eq!(message.log_time_ns, log_time_ns(number));
    }
}

#[test]
fn after_a_flush_a_killed_recorder_loses_nothing() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    let mut writer = Writer::create(&path, "").unwrap();
    let topic = writer.add_topic(topic("/pose")).unwrap();
    write(&mut writer, topic, 0..10);
    writer.flush().unwrap();
    std::mem::forget(writer);
    assert_eq!(read(&Recording::open(&path).unwrap()).0.len(), 10);
}

#[test]
fn a_killed_recorder_of_large_messages_loses_little_more_than_a_mebibyte() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    let mut writer = Writer::create(&path, "").unwrap();
    let topic = writer.add_topic(topic("/large")).unwrap();
    for number in 0..500 {
        writer.write(topic, log_time_ns(0) + number, &[0; 10_000]).unwrap();
    }
    std::mem::forget(writer);
    let found = read(&Recording::open(&path).unwrap()).0.len();
    assert!(found >= 500 - 120, "{found}");
}

#[test]
fn a_chunk_with_a_wrong_checksum_is_said_and_its_messages_are_read() {
    let mut bytes = whole_file();
    // The x of some pose in the second chunk: ten bytes into the payload of message 700.
    let needle = recording::cdr::encode(&pose(700));
    let at = bytes.windows(needle.len()).position(|window| window == needle).unwrap();
    bytes[at + 30] ^= 1;
    let recording = opened(&bytes).unwrap();
    let (messages, errors) = read(&recording);
    assert_eq!(errors.len(), 1, "{errors:?}");
    assert!(errors[0].to_string().contains("checksum"), "{}", errors[0]);
    assert_eq!(messages.len(), 2000);
    for (number, message) in (0..).zip(&messages) {
        assert_eq!(message.log_time_ns, log_time_ns(number));
        assert_eq!(message.data == recording::cdr::encode(&pose(number)), number != 700, "{number}");
    }
}

#[test]
fn a_broken_summary_costs_nothing() {
    let bytes = whole_file();
    let intact = read(&opened(&bytes).unwrap()).0;
    let mut broken = bytes.clone();
    let in_summary = broken.len() - 100;
    broken[in_summary] ^= 0xff;
    assert_eq!(read(&opened(&broken).unwrap()).0, intact);
    let cut = &bytes[..bytes.len() - 20];
    assert_eq!(read(&opened(cut).unwrap()).0, intact);
}

#[test]
fn a_summary_that_is_wrong_is_not_believed() {
    let bytes = whole_file();
    let topics = |bytes: &[u8]| opened(bytes).unwrap().topics().to_vec();
    let intact = topics(&bytes);
    // The name of the topic in the summary, which then no longer has its checksum.
    let name = bytes.windows(5).rposition(|window| window == b"/pose").unwrap();
    let mut renamed = bytes.clone();
    renamed[name + 1] = b'n';
    assert_eq!(topics(&renamed), intact);
    // A summary without checksum that says of itself that it is not complete: three channels, and one is there.
    let mut incomplete = bytes.clone();
    let footer = bytes.len() - 8 - 20;
    incomplete[footer + 16..footer + 20].fill(0);
    let summary = u64::from_le_bytes(bytes[footer..footer + 8].try_into().unwrap()) as usize;
    let mut at = summary;
    while bytes[at] != mcap::records::op::STATISTICS {
        at += 9 + u64::from_le_bytes(bytes[at + 1..at + 9].try_into().unwrap()) as usize;
    }
    incomplete[at + 9 + 10] = 3;
    assert_eq!(topics(&incomplete), intact);
}

#[test]
fn a_file_cut_anywhere_opens_and_has_every_message_before_the_cut() {
    let bytes = whole_file();
    let chunk = first_chunk(&bytes);
    let chunk_end = chunk + 9 + u64::from_le_bytes(bytes[chunk + 1..chunk + 9].try_into().unwrap()) as usize;
    let in_first = read(&opened(&bytes[..chunk_end]).unwrap()).0.len();
    assert!(in_first > 400, "{in_first}");
    // The channel is described in the first 700 bytes of the chunk; a message has 115 bytes or so.
    let cuts = (chunk..chunk + 40).chain([chunk + 1000, chunk + 20_000, chunk_end - 1]);
    for cut in cuts.chain(chunk_end..chunk_end + 40) {
        let recording = opened(&bytes[..cut]).unwrap();
        let damage = recording.damage();
        assert!(damage.last().unwrap().to_string().contains("stopped hard"), "cut at {cut}: {damage:?}");
        let (found, errors) = read(&recording);
        let expected = (cut.min(chunk_end).saturating_sub(chunk + 700) / 115).min(in_first);
        assert!(found.len() >= expected, "cut at {cut}: {} of {expected}", found.len());
        assert!(errors.is_empty(), "cut at {cut}: {errors:?}");
        for (number, message) in (0..).zip(&found) {
            assert_eq!(message.log_time_ns, log_time_ns(number), "cut at {cut}");
        }
    }
}

#[test]
fn what_is_no_recording_is_refused_with_its_name() {
    let directory = tempfile::tempdir().unwrap();
    let at = |name: &str| directory.path().join(name);
    let refused = |path: &Path, words: &[&str]| {
        let message = Recording::open(path).unwrap_err().to_string();
        for word in words.iter().chain(&[path.file_name().unwrap().to_str().unwrap()]) {
            assert!(message.contains(word), "{word:?} is missing in: {message}");
        }
    };
    refused(&at("missing"), &["cannot open"]);
    std::fs::write(at("empty.mcap"), "").unwrap();
    refused(&at("empty.mcap"), &["empty"]);
    std::fs::write(at("text.mcap"), "not a recording at all").unwrap();
    refused(&at("text.mcap"), &["magic bytes"]);
    std::fs::create_dir(at("folder")).unwrap();
    refused(&at("folder"), &[".mcap", ".db3"]);
}

fn first_chunk(bytes: &[u8]) -> usize {
    let mut at = mcap::MAGIC.len();
    while bytes[at] != mcap::records::op::CHUNK {
        at += 9 + u64::from_le_bytes(bytes[at + 1..at + 9].try_into().unwrap()) as usize;
    }
    at
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn no_change_of_a_file_makes_the_reader_panic_or_invent_messages(
        changes in proptest::collection::vec((place(), any::<u8>()), 0..6),
        cut in proptest::option::of(any::<prop::sample::Index>()),
    ) {
        let mut bytes = WHOLE.with(Vec::clone);
        for (at, value) in changes {
            let at = at.in_file(bytes.len());
            bytes[at] = value;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        if let Ok(recording) = opened(&bytes) {
            let (messages, _) = read(&recording);
            prop_assert!(messages.len() <= 2000);
        }
    }

    #[test]
    fn any_bytes_behind_the_magic_do_no_harm(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        let file: Vec<u8> = mcap::MAGIC.iter().chain(&bytes).copied().collect();
        if let Ok(recording) = opened(&file) {
            read(&recording);
        }
    }
}

/// Where to break a file. Heads and the summary are a thousandth of it and decide everything, so they come up often.
#[derive(Debug, Clone)]
enum Place {
    Head(usize),
    Tail(usize),
    Anywhere(prop::sample::Index),
}

impl Place {
    fn in_file(&self, length: usize) -> usize {
        match self {
            Place::Head(at) => *at,
            Place::Tail(at) => length - 1 - at,
            Place::Anywhere(at) => at.index(length),
        }
    }
}

fn place() -> impl Strategy<Value = Place> {
    prop_oneof![
        (0..1200_usize).prop_map(Place::Head),
        (0..2000_usize).prop_map(Place::Tail),
        any::<prop::sample::Index>().prop_map(Place::Anywhere),
    ]
}

thread_local! {
    static WHOLE: Vec<u8> = whole_file();
}
