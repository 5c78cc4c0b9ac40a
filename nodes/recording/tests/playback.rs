//! The order of a replay, and reading a part of the topics.
#![allow(clippy::unwrap_used, reason = "helpers of tests, which may panic")]

mod common;

use common::*;
use recording::{Durability, Playback, Qos, Recording, Topic, Writer};

fn latched(name: &str) -> Topic {
    let offered_qos = vec![Qos { durability: Durability::TransientLocal, ..Qos::default() }];
    Topic { offered_qos, ..topic(name) }
}

/// Messages by topic and number, over several chunks; the names of latched topics begin with `/latched`.
fn recorded(topics: &[&str], messages: &[(&str, u64)]) -> (tempfile::TempDir, Recording) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    let mut writer = Writer::create(&path, "").unwrap();
    let ids: Vec<_> = topics
        .iter()
        .map(|name| {
            let topic = if name.starts_with("/latched") { latched(name) } else { topic(name) };
            writer.add_topic(topic).unwrap()
        })
        .collect();
    for (name, number) in messages {
        let topic = ids[topics.iter().position(|known| known == name).unwrap()];
        writer.write(topic, log_time_ns(*number), &recording::cdr::encode(&pose(*number))).unwrap();
        writer.flush().unwrap();
    }
    writer.close().unwrap();
    let recording = Recording::open(path).unwrap();
    (directory, recording)
}

/// What is played, as `topic number`.
fn played(recording: &Recording, playback: &Playback) -> Vec<String> {
    let items = recording.playback(playback).map(|message| {
        let message = message.unwrap();
        let name = &recording.topics()[message.topic].topic.name;
        format!("{name} {}", (message.log_time_ns - START_NS) / STEP_NS)
    });
    items.collect()
}

const TOPICS: [&str; 4] = ["/pose", "/latched_tf", "/latched_mesh", "/latched_never"];
const MESSAGES: [(&str, u64); 8] = [
    ("/pose", 0),
    ("/latched_tf", 1),
    ("/pose", 2),
    ("/latched_tf", 3),
    ("/pose", 5),
    ("/latched_mesh", 6),
    ("/latched_mesh", 7),
    ("/pose", 8),
];
const MS: u64 = 1_000_000;

#[test]
fn from_the_beginning_the_first_message_of_each_latched_topic_goes_first_and_none_comes_twice() {
    let (_directory, recording) = recorded(&TOPICS, &MESSAGES);
    let expected = [
        "/latched_tf 1",
        "/latched_mesh 6",
        "/pose 0",
        "/pose 2",
        "/latched_tf 3",
        "/pose 5",
        "/latched_mesh 7",
        "/pose 8",
    ];
    assert_eq!(played(&recording, &Playback::default()), expected);
}

#[test]
fn from_the_middle_latched_topics_say_first_what_they_had_said() {
    let (_directory, recording) = recorded(&TOPICS, &MESSAGES);
    let playback = Playback { start_ns: 4 * MS, ..Playback::default() };
    let expected =
        ["/latched_tf 1", "/latched_tf 3", "/latched_mesh 6", "/pose 5", "/latched_mesh 7", "/pose 8"];
    assert_eq!(played(&recording, &playback), expected);
}

#[test]
fn a_duration_ends_the_rest_and_not_what_subscribers_take_for_granted() {
    let (_directory, recording) = recorded(&TOPICS, &MESSAGES);
    let playback = Playback { start_ns: MS, duration_ns: Some(2 * MS), ..Playback::default() };
    let expected = ["/latched_tf 1", "/latched_mesh 6", "/pose 2", "/latched_tf 3"];
    assert_eq!(played(&recording, &playback), expected);
}

#[test]
fn selected_topics_alone_are_played() {
    let (_directory, recording) = recorded(&TOPICS, &MESSAGES);
    let number = |name: &str| recording.topics().iter().position(|topic| topic.topic.name == name).unwrap();
    let playback = Playback { topics: vec![number("/latched_mesh"), 99], ..Playback::default() };
    assert_eq!(played(&recording, &playback), ["/latched_mesh 6", "/latched_mesh 7"]);
    let playback = Playback { topics: vec![number("/pose")], start_ns: 3 * MS, ..Playback::default() };
    assert_eq!(played(&recording, &playback), ["/pose 5", "/pose 8"]);
}

#[test]
fn a_start_behind_the_end_or_beyond_all_numbers_plays_only_what_is_latched() {
    let (_directory, recording) = recorded(&TOPICS, &MESSAGES);
    for start_ns in [100 * MS, u64::MAX] {
        let playback = Playback { start_ns, duration_ns: Some(u64::MAX), ..Playback::default() };
        let expected = ["/latched_tf 1", "/latched_tf 3", "/latched_mesh 6", "/latched_mesh 7"];
        assert_eq!(played(&recording, &playback), expected);
    }
}

#[test]
fn messages_of_some_topics_leave_damage_alone_that_has_none_of_them() {
    let (directory, _) = recorded(&TOPICS, &MESSAGES);
    let file = directory.path().join("session/session_0.mcap");
    let mut bytes = std::fs::read(&file).unwrap();
    let needle = recording::cdr::encode(&pose(6));
    let at = bytes.windows(needle.len()).position(|window| window == needle).unwrap();
    bytes[at + 30] ^= 1;
    std::fs::write(&file, bytes).unwrap();
    let recording = Recording::open(&file).unwrap();
    let number = |name: &str| recording.topics().iter().position(|topic| topic.topic.name == name).unwrap();
    let of = |name: &str| recording.messages_of(&[number(name)]);
    assert_eq!((of("/pose").count(), of("/pose").filter(Result::is_err).count()), (4, 0));
    // Both messages are still framed as messages, and what one of them says is not what was written.
    assert_eq!((of("/latched_mesh").count(), of("/latched_mesh").filter(Result::is_err).count()), (3, 1));
    // Told once, although the latched part and the rest both meet it.
    assert_eq!(recording.playback(&Playback::default()).filter(Result::is_err).count(), 1);
}

#[test]
fn borrowed_and_owned_messages_are_the_same_and_stored_order_is_that_of_the_file() {
    let messages: Vec<_> = (0..50).map(|number| ("/pose", (number * 7) % 50)).collect();
    let (_directory, recording) = recorded(&["/pose"], &messages);
    let mut borrowed = Vec::new();
    let mut iterator = recording.messages();
    while let Some(message) = iterator.next_ref() {
        borrowed.push(message.unwrap().to_message());
    }
    assert_eq!(borrowed, read(&recording).0);
    assert_eq!(numbers(&borrowed), (0..50).collect::<Vec<_>>());
    let stored: Vec<_> = recording.stored_messages().map(Result::unwrap).collect();
    assert_eq!(numbers(&stored), messages.iter().map(|(_, number)| *number).collect::<Vec<_>>());
}

#[test]
fn blocks_that_all_span_the_same_time_are_merged_in_bounded_memory() {
    // 60 chunks of a mebibyte, each with messages from all over the recording: not all of them fit into memory at once.
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    let mut writer = Writer::create(&path, "").unwrap();
    let topic = writer.add_topic(topic("/large")).unwrap();
    for chunk in 0..60 {
        for number in 0..10 {
            writer.write(topic, log_time_ns(number * 60 + chunk), &vec![chunk as u8; 100_000]).unwrap();
        }
        writer.flush().unwrap();
    }
    writer.close().unwrap();
    let recording = Recording::open(path).unwrap();
    let (messages, errors) = read(&recording);
    assert!(errors.is_empty(), "{errors:?}");
    for (number, message) in (0..600).zip(&messages) {
        assert_eq!((message.log_time_ns, u64::from(message.data[0])), (log_time_ns(number), number % 60));
    }
    assert_eq!(messages.len(), 600);
}
