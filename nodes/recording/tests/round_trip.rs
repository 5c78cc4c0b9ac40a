//! What the writer writes, the reader reads: every message, in order, with its topic.
#![allow(clippy::unwrap_used, reason = "helpers of tests, which may panic")]

mod common;

use common::*;
use proptest::prelude::*;
use recording::cdr::{decode, encode};
use recording::messages::PoseStamped;
use recording::{Durability, Error, Qos, Recording, Writer, WriterOptions};

#[test]
fn every_message_comes_back_in_order_over_many_chunks() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    recorded(&path, 5000);
    let recording = Recording::open(&path).unwrap();
    assert!(recording.damage().is_empty(), "{:?}", recording.damage());
    let (messages, errors) = read(&recording);
    assert!(errors.is_empty(), "{errors:?}");
    assert_eq!(messages.len(), 5000);
    for (number, message) in (0..).zip(&messages) {
        assert_eq!(message.log_time_ns, log_time_ns(number));
        assert_eq!(u64::from(message.sequence), number + 1);
        assert_eq!(decode::<PoseStamped>(&message.data).unwrap(), pose(number));
    }
    assert_eq!(recording.log_time_bounds_ns(), Some((START_NS, log_time_ns(4999))));
    let metadata = std::fs::read_to_string(path.join("metadata.yaml")).unwrap();
    assert!(metadata.contains("nanoseconds: 4999000000"), "{metadata}");
    assert_eq!(recording.topics()[0].message_count, 5000);
}

#[test]
fn topics_keep_type_qos_hash_and_text_and_may_come_late() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    let mut writer = Writer::create(&path, "jazzy").unwrap();
    let first = writer.add_topic(topic("/first")).unwrap();
    write(&mut writer, first, 0..3);
    let mut latched = topic("/late");
    latched.offered_qos =
        vec![Qos { durability: Durability::TransientLocal, ..Qos::default() }, Qos::default()];
    let late = writer.add_topic(latched.clone()).unwrap();
    write(&mut writer, late, 3..5);
    let nothing = writer.add_topic(topic("/nothing")).unwrap();
    let written = writer.close().unwrap();
    assert_ne!(late, nothing);
    let counts = [("/first", 3), ("/late", 2), ("/nothing", 0)].map(|(name, count)| (name.to_owned(), count));
    assert_eq!(written.message_counts, counts);
    let recording = Recording::open(&path).unwrap();
    let topics: Vec<_> =
        recording.topics().iter().map(|topic| (topic.topic.clone(), topic.message_count)).collect();
    assert_eq!(topics, [(topic("/first"), 3), (latched, 2), (topic("/nothing"), 0)]);
}

#[test]
fn equal_times_keep_the_order_in_which_they_were_stored_and_late_ones_are_sorted_in() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    let mut writer = Writer::create(&path, "").unwrap();
    let topics = [writer.add_topic(topic("/a")).unwrap(), writer.add_topic(topic("/b")).unwrap()];
    // Pairs of equal times over several chunks; every tenth pair is a millisecond late.
    for number in 0..2000_u64 {
        let time = log_time_ns(if number % 10 == 0 { number } else { number + 1 });
        for topic in topics {
            writer.write(topic, time, &encode(&pose(number))).unwrap();
        }
    }
    writer.close().unwrap();
    let (messages, errors) = read(&Recording::open(&path).unwrap());
    assert!(errors.is_empty());
    assert_eq!(messages.len(), 4000);
    assert!(messages.is_sorted_by_key(|message| message.log_time_ns));
    for equal in messages.chunk_by(|one, other| one.log_time_ns == other.log_time_ns) {
        let stored: Vec<_> = equal.iter().map(|message| (message.sequence, message.topic)).collect();
        assert!(stored.is_sorted(), "{stored:?}");
    }
}

#[test]
fn metadata_of_humble_is_written_on_request_and_no_other_version() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    let with = |metadata_version| WriterOptions { metadata_version, ..WriterOptions::default() };
    let mut writer = Writer::create_with(&path, with(5)).unwrap();
    let topic = writer.add_topic(topic("/pose")).unwrap();
    write(&mut writer, topic, 0..10);
    writer.close().unwrap();
    let text = std::fs::read_to_string(path.join("metadata.yaml")).unwrap();
    assert!(text.contains("version: 5") && text.contains("reliability: 1"), "{text}");
    for newer in ["custom_data", "ros_distro", "type_description_hash", "reliable"] {
        assert!(!text.contains(newer), "{text}");
    }
    let recording = Recording::open(&path).unwrap();
    assert_eq!((read(&recording).0.len(), recording.metadata_disagreements()), (10, &[][..]));
    assert_eq!(recording.topics()[0].topic.offered_qos, [Qos::default()]);
    let refused = Writer::create_with(directory.path().join("other"), with(7)).err().unwrap().to_string();
    assert!(refused.contains("version 7") && refused.contains("9, 5"), "{refused}");
    assert!(!directory.path().join("other").exists());
}

#[test]
fn a_recording_is_never_overwritten() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    recorded(&path, 1);
    let before = std::fs::read(path.join("session_0.mcap")).unwrap();
    let error = Writer::create(&path, "").err().unwrap();
    assert!(matches!(error, Error::Exists { .. }) && error.to_string().contains("session"), "{error}");
    assert_eq!(std::fs::read(path.join("session_0.mcap")).unwrap(), before);
}

#[test]
fn a_recording_without_messages_reads_as_empty() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    Writer::create(&path, "").unwrap().close().unwrap();
    let recording = Recording::open(&path).unwrap();
    assert_eq!(recording.log_time_bounds_ns(), None);
    assert_eq!(read(&recording).0.len() + recording.damage().len() + recording.topics().len(), 0);
}

#[test]
fn a_bare_file_and_a_directory_without_metadata_read_the_same() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    recorded(&path, 700);
    let whole = read(&Recording::open(&path).unwrap()).0;
    std::fs::remove_file(path.join("metadata.yaml")).unwrap();
    assert_eq!(read(&Recording::open(&path).unwrap()).0, whole);
    assert_eq!(read(&Recording::open(path.join("session_0.mcap")).unwrap()).0, whole);
}

#[test]
fn split_files_are_one_recording_with_one_topic_in_the_order_of_their_numbers() {
    let directory = tempfile::tempdir().unwrap();
    let joined = directory.path().join("joined");
    std::fs::create_dir(&joined).unwrap();
    // Twelve parts, so that the order of the numbers is not that of the letters; each begins when the last one ends.
    for part in 0..12_u64 {
        let path = directory.path().join("part");
        let mut writer = Writer::create(&path, "").unwrap();
        let topic = writer.add_topic(topic("/pose")).unwrap();
        write(&mut writer, topic, part * 10..part * 10 + 11);
        writer.close().unwrap();
        std::fs::rename(path.join("part_0.mcap"), joined.join(format!("joined_{part}.mcap"))).unwrap();
        std::fs::remove_dir_all(path).unwrap();
    }
    let recording = Recording::open(&joined).unwrap();
    assert_eq!(recording.topics().len(), 1);
    assert_eq!(recording.topics()[0].message_count, 132);
    let found: Vec<_> =
        read(&recording).0.iter().map(|message| (message.log_time_ns, message.sequence)).collect();
    let part = |part: u64| (0..11).map(move |i| (log_time_ns(part * 10 + i), i as u32 + 1));
    assert_eq!(found, (0..12).flat_map(part).collect::<Vec<_>>());
}

/// A file in memory with messages of these times, in chunks or not, and neither indexes nor a summary.
fn plain_file(chunks: bool, times_ns: &[&[u64]]) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let options = mcap::WriteOptions::new().use_chunks(chunks).compression(None).emit_message_indexes(false);
    let mut writer =
        options.emit_summary_records(false).emit_summary_offsets(false).create(&mut bytes).unwrap();
    let schema = writer.add_schema("geometry_msgs/msg/PoseStamped", "ros2msg", b"").unwrap();
    let channel_id = writer.add_channel(schema, "/pose", "cdr", &Default::default()).unwrap();
    for (number, row) in times_ns.iter().enumerate() {
        for &log_time in *row {
            let header =
                mcap::records::MessageHeader { channel_id, sequence: 0, log_time, publish_time: log_time };
            writer.write_to_known_channel(&header, &encode(&pose(log_time))).unwrap();
        }
        // Something between two rows.
        writer.add_channel(schema, &format!("/other_{number}"), "cdr", &Default::default()).unwrap();
    }
    writer.finish().unwrap();
    drop(writer);
    bytes.into_inner()
}

fn times_in(bytes: &[u8]) -> Vec<u64> {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("plain.mcap");
    std::fs::write(&path, bytes).unwrap();
    let recording = Recording::open(&path).unwrap();
    let (messages, errors) = read(&recording);
    assert!(errors.is_empty(), "{errors:?}");
    assert_eq!(recording.topics()[0].message_count, messages.len() as u64);
    for message in &messages {
        assert_eq!(decode::<PoseStamped>(&message.data).unwrap(), pose(message.log_time_ns));
    }
    messages.iter().map(|message| message.log_time_ns).collect()
}

#[test]
fn messages_outside_of_chunks_are_read_in_order_of_time_too() {
    assert_eq!(times_in(&plain_file(false, &[&[5, 1], &[3, 2], &[4]])), [1, 2, 3, 4, 5]);
    assert_eq!(times_in(&plain_file(true, &[&[5, 1], &[3, 2], &[4]])), [1, 2, 3, 4, 5]);
}

#[test]
fn messages_right_behind_a_chunk_are_not_taken_for_part_of_it() {
    let record_end = |bytes: &[u8], at: usize| {
        at + 9 + u64::from_le_bytes(bytes[at + 1..at + 9].try_into().unwrap()) as usize
    };
    let end_of_first = |bytes: &[u8], opcode: u8| {
        let mut at = mcap::MAGIC.len();
        while bytes[at] != opcode {
            at = record_end(bytes, at);
        }
        (at, record_end(bytes, at))
    };
    let chunked = plain_file(true, &[&[1, 3]]);
    let loose = plain_file(false, &[&[2]]);
    let (_, chunk_end) = end_of_first(&chunked, mcap::records::op::CHUNK);
    let (message, message_end) = end_of_first(&loose, mcap::records::op::MESSAGE);
    let both: Vec<_> = [&chunked[..chunk_end], &loose[message..message_end], &chunked[chunk_end..]].concat();
    assert_eq!(times_in(&both), [1, 2, 3]);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]

    #[test]
    fn reading_is_a_stable_sort_by_time_whatever_the_times_and_chunks(
        messages in proptest::collection::vec((0..40_u64, 0..3_usize, prop::bool::weighted(0.1)), 0..200),
    ) {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("session");
        let mut writer = Writer::create(&path, "").unwrap();
        let topics = ["/a", "/b", "/c"].map(|name| writer.add_topic(topic(name)).unwrap());
        for (number, (time, topic, ends_chunk)) in (0_u32..).zip(&messages) {
            writer.write(topics[*topic], *time, &number.to_le_bytes()).unwrap();
            if *ends_chunk {
                writer.flush().unwrap();
            }
        }
        writer.close().unwrap();
        let mut expected: Vec<_> =
            (0_u32..).zip(&messages).map(|(number, (time, topic, _))| (*time, *topic, number)).collect();
        expected.sort_by_key(|(time, ..)| *time);
        let (read, errors) = read(&Recording::open(&path).unwrap());
        prop_assert!(errors.is_empty());
        let found: Vec<_> = read
            .iter()
            .map(|message| {
                let number = u32::from_le_bytes(message.data[..].try_into().unwrap());
                (message.log_time_ns, message.topic, number)
            })
            .collect();
        prop_assert_eq!(found, expected);
    }
}
