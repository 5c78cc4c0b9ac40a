//! MCAP files as other programs write them: what the format allows is read, and nothing of it is damage.
#![allow(clippy::unwrap_used, reason = "helpers of tests, which may panic")]

mod common;

use std::path::PathBuf;

use common::mcap_files::*;
use common::*;
use mcap::records::op;
use recording::cdr::encode;
use recording::check::{Report, Verdict, check};
use recording::repair::repair;
use recording::{MessageDefinition, Playback, Recording, Topic, Writer};

/// A file with these bytes, in a directory of its own.
fn on_disk(bytes: &[u8]) -> (tempfile::TempDir, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("written.mcap");
    std::fs::write(&path, bytes).unwrap();
    (directory, path)
}

/// A message as `compression_mode: MESSAGE` stores it.
fn frame(number: u64) -> Vec<u8> {
    zstd::bulk::compress(&encode(&pose(number)), 1).unwrap()
}

#[test]
fn messages_compressed_one_by_one_are_read_and_repaired_as_they_were_recorded() {
    for shape in [PLAIN, ZSTD, LOOSE] {
        for summary in [true, false] {
            let shape = Shape { summary, ..shape };
            let (guard, path) = on_disk(&file_of(shape, 0..1000, 150, frame));
            let report = check(&path);
            assert_eq!(report.verdict, Verdict::Whole, "{shape:?}: {:?}", report.problems);
            let output = guard.path().join("repaired");
            assert!(repair(&path, &output, &|| true).unwrap().all_saved, "{shape:?}");
            for path in [&path, &output] {
                let recording = Recording::open(path).unwrap();
                let (messages, errors) = read(&recording);
                assert!(errors.is_empty(), "{errors:?}");
                assert_eq!(numbers(&messages), (0..1000).collect::<Vec<_>>(), "{shape:?}");
            }
        }
    }
}

#[test]
fn a_message_whose_compression_is_broken_costs_itself_and_is_said() {
    let broken = |number| match number {
        30 => frame(number)[..20].to_vec(),
        _ => frame(number),
    };
    for shape in [PLAIN, ZSTD, LOOSE] {
        let recording = opened(&file_of(shape, 0..100, 20, broken)).unwrap();
        let (messages, errors) = read(&recording);
        assert_eq!(
            numbers(&messages),
            (0..100).filter(|number| *number != 30).collect::<Vec<_>>(),
            "{shape:?}"
        );
        let errors: Vec<_> = errors.iter().map(ToString::to_string).collect();
        assert!(
            errors.len() == 1 && errors[0].contains("1 message") && errors[0].contains("zstd"),
            "{errors:?}"
        );
    }
}

/// Each decompresses to 60 MB: a minute for all of them.
#[test]
fn of_messages_that_are_bombs_a_file_gives_no_more_than_its_allowance() {
    let bomb = zstd::bulk::compress(&vec![0; 60_000_000], 1).unwrap();
    let (_guard, path) = on_disk(&file_of(PLAIN, 0..2000, 1, |_| bomb.clone()));
    let recording = Recording::open(&path).unwrap();
    let mut messages = recording.stored_messages();
    let (mut bytes, mut refused) = (0, 0);
    while let Some(message) = messages.next_ref() {
        match message {
            Ok(message) => bytes += message.data.len(),
            Err(_) => refused += 1,
        }
    }
    assert!(bytes <= 3 << 30 && refused > 1900, "{bytes} bytes, {refused} refused");
}

/// `channel_message_counts` of a file is empty where its writer did not count: MCAP allows that.
fn without_channel_counts(mut bytes: Vec<u8>) -> Vec<u8> {
    let (_, place) = records(&bytes).into_iter().find(|(kind, _)| *kind == op::STATISTICS).unwrap();
    let counts = place.start + 9 + 8 + 2 + 4 * 4 + 8 + 8;
    bytes.splice(counts..place.end, [0; 4]);
    bytes[place.start + 1..place.start + 9]
        .copy_from_slice(&((counts + 4 - place.start - 9) as u64).to_le_bytes());
    // Neither summary offsets nor a checksum, which would be wrong now.
    let footer = bytes.len() - 8 - 20;
    bytes[footer + 8..footer + 20].fill(0);
    bytes
}

#[test]
fn where_the_summary_does_not_count_by_channel_the_messages_are_counted() {
    for shape in [PLAIN, ZSTD, LOOSE] {
        let bytes = without_channel_counts(file_of(shape, 0..1000, 150, |number| encode(&pose(number))));
        let (_guard, path) = on_disk(&bytes);
        let report = check(&path);
        assert_eq!(
            (report.verdict, report.topics[0].recorded),
            (Verdict::Whole, 1000),
            "{:?}",
            report.problems
        );
        let recording = Recording::open(&path).unwrap();
        assert_eq!(recording.topics()[0].message_count, 1000, "{shape:?}");
        assert_eq!(recording.playback(&Playback::default()).count(), 1000, "{shape:?}");
    }
}

/// The Python library `rosbags` gives a chunk without messages the times of a recording without messages.
#[test]
fn a_chunk_without_messages_may_end_before_it_begins() {
    let record =
        |kind: u8, content: &[u8]| [&[kind], &(content.len() as u64).to_le_bytes()[..], content].concat();
    for (start_ns, end_ns) in [(i64::MAX as u64, 0_u64), (u64::MAX, 0), (0, 0)] {
        let empty = file(Shape { summary: false, ..LOOSE }, 0..0, 1);
        let definitions = records(&empty)
            .into_iter()
            .filter(|(kind, _)| [op::SCHEMA, op::CHANNEL].contains(kind))
            .flat_map(|(_, place)| empty[place].to_vec())
            .collect::<Vec<_>>();
        let size = (definitions.len() as u64).to_le_bytes();
        let head =
            [&start_ns.to_le_bytes()[..], &end_ns.to_le_bytes(), &size, &[0; 4], &[0; 4], &size].concat();
        let header = records(&empty)[0].1.clone();
        let bytes = [
            mcap::MAGIC,
            &empty[header],
            &record(op::CHUNK, &[head, definitions].concat()),
            &record(op::DATA_END, &[0; 4]),
            &record(op::FOOTER, &[0; 20]),
            mcap::MAGIC,
        ];
        let (guard, path) = on_disk(&bytes.concat());
        let report = check(&path);
        assert_eq!(
            (report.verdict, &report.problems[..]),
            (Verdict::Whole, &[][..]),
            "{start_ns} to {end_ns}"
        );
        assert_eq!(report.topics[0].name, "/pose");
        assert!(repair(&path, &guard.path().join("repaired"), &|| true).unwrap().all_saved);
    }
}

/// A recording of poses whose definition is this.
fn check_of(encoding: &str, text: &str, type_hash: &str) -> Report {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    let [encoding, text, type_hash] = [encoding, text, type_hash].map(str::to_owned);
    let mut writer = Writer::create(&path, "jazzy").unwrap();
    let definition = MessageDefinition { encoding, text, type_hash };
    let topic = writer.add_topic(Topic { definition, ..topic("/measured_cp") }).unwrap();
    write(&mut writer, topic, 0..10);
    writer.close().unwrap();
    check(&path)
}

#[test]
fn without_a_text_in_ros2msg_the_type_hash_says_whether_the_definition_is_another() {
    const KNOWN: &str = "RIHS01_10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8";
    for (encoding, text) in [("ros2idl", "struct PoseStamped {};"), ("ros2msg", "")] {
        let other = check_of(encoding, text, &KNOWN.replace("10f", "00f"));
        assert_eq!(other.verdict, Verdict::Damaged, "{encoding}: {:?}", other.remarks);
        assert!(
            other.problems[0].contains("another definition") && other.problems[0].contains(KNOWN),
            "{:?}",
            other.problems
        );
        assert_eq!(check_of(encoding, text, KNOWN).verdict, Verdict::Whole, "{encoding}");
    }
    let unknown = check_of("ros2idl", "struct PoseStamped {};", "");
    assert_eq!(unknown.verdict, Verdict::Whole);
    assert!(unknown.remarks.iter().any(|remark| remark.contains("is not known")), "{:?}", unknown.remarks);
    assert!(
        !check_of("ros2idl", "struct PoseStamped {};", KNOWN)
            .remarks
            .iter()
            .any(|remark| remark.contains("is not known"))
    );
}
