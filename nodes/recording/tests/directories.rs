//! Directories as recorders leave them: every metadata version, none, a broken one, one that disagrees; split and compressed
//! files, and missing ones.
#![allow(clippy::unwrap_used, reason = "helpers of tests, which may panic")]

mod common;

use std::path::{Path, PathBuf};

use common::mcap_files::*;
use common::*;
use mcap::records::op;
use recording::check::check;
use recording::repair::{Repaired, default_output, repair};
use recording::{Durability, Recording};

const QOS_NUMBERS: &str = "- history: 1\\n  depth: 5\\n  reliability: 1\\n  durability: 1\\n  deadline:\\n    sec: 0\\n    nsec: 0\\n  \
    lifespan:\\n    sec: 0\\n    nsec: 0\\n  liveliness: 1\\n  liveliness_lease_duration:\\n    sec: 0\\n    nsec: 0\\n  \
    avoid_ros_namespace_conventions: false";

/// `metadata.yaml` as the ROS 2 of each version writes it, for `count` poses in these files.
fn metadata(version: u32, count: u64, files: &[&str]) -> String {
    let (start, duration) = (log_time_ns(0), (count.max(1) - 1) * STEP_NS);
    let mut text =
        format!("rosbag2_bagfile_information:\n  version: {version}\n  storage_identifier: mcap\n");
    if version <= 2 {
        text += "  storage_format: cdr\n";
    }
    text += &format!(
        "  duration:\n    nanoseconds: {duration}\n  starting_time:\n    nanoseconds_since_epoch: {start}\n"
    );
    text += &format!("  message_count: {count}\n  topics_with_message_count:\n    - topic_metadata:\n");
    text += &format!("        name: /pose\n        type: {TYPE}\n        serialization_format: cdr\n");
    match version {
        ..=3 => {}
        4..=8 => text += &format!("        offered_qos_profiles: \"{QOS_NUMBERS}\"\n"),
        _ => {
            text += "        offered_qos_profiles:\n          - history: keep_last\n            depth: 5\n            \
                reliability: reliable\n            durability: transient_local\n            deadline:\n              \
                sec: 0\n              nsec: 0\n            lifespan:\n              sec: 0\n              nsec: 0\n            \
                liveliness: automatic\n            liveliness_lease_duration:\n              sec: 0\n              nsec: 0\n            \
                avoid_ros_namespace_conventions: false\n";
        }
    }
    if version >= 7 {
        text += "        type_description_hash: RIHS01_12\n";
    }
    text += &format!("      message_count: {count}\n");
    if version >= 3 {
        text += "  compression_format: \"\"\n  compression_mode: \"\"\n";
    }
    text += "  relative_file_paths:\n";
    for file in files {
        text += &format!("    - {file}\n");
    }
    if version >= 5 {
        text += "  files:\n";
        for file in files {
            text += &format!(
                "    - path: {file}\n      starting_time:\n        nanoseconds_since_epoch: {start}\n      duration:\n        \
                 nanoseconds: {duration}\n      message_count: {count}\n"
            );
        }
    }
    if version >= 6 {
        text += "  custom_data:\n    operator: one\n    attempt: 3\n";
    }
    if version >= 8 {
        text += "  ros_distro: jazzy\n";
    }
    text
}

/// A directory of such files.
fn directory(files: &[(&str, &[u8])]) -> (tempfile::TempDir, PathBuf) {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("session");
    std::fs::create_dir(&path).unwrap();
    for (name, bytes) in files {
        std::fs::write(path.join(name), bytes).unwrap();
    }
    (directory, path)
}

fn found(path: &Path) -> (Vec<u64>, Vec<String>, Vec<String>) {
    let recording = Recording::open(path).unwrap();
    let (messages, errors) = read(&recording);
    let damage = recording.damage().iter().chain(&errors).map(ToString::to_string).collect();
    (numbers(&messages), damage, recording.metadata_disagreements().to_vec())
}

#[test]
fn metadata_of_versions_1_to_9_is_read_and_completes_what_the_file_does_not_say() {
    for version in 1..=9 {
        let text = metadata(version, 100, &["session_0.mcap"]);
        let (_guard, path) =
            directory(&[("session_0.mcap", &file(PLAIN, 0..100, 50)), ("metadata.yaml", text.as_bytes())]);
        let recording = Recording::open(&path).unwrap();
        assert!(
            recording.metadata_disagreements().is_empty(),
            "{version}: {:?}",
            recording.metadata_disagreements()
        );
        assert_eq!(read(&recording).0.len(), 100);
        let topic = &recording.topics()[0].topic;
        let durability = topic.offered_qos.first().map(|offer| offer.durability);
        assert_eq!(durability, (version >= 4).then_some(Durability::TransientLocal), "{version}");
        assert_eq!(topic.definition.type_hash, if version >= 7 { "RIHS01_12" } else { "" }, "{version}");
    }
}

#[test]
fn metadata_that_cannot_be_read_stops_nothing_and_is_named() {
    let whole = metadata(9, 100, &["session_0.mcap"]);
    let broken = [
        whole.replace("version: 9", "version: 10").into_bytes(),
        whole.replace("  storage_identifier: mcap\n", "").into_bytes(),
        whole.as_bytes()[..300].to_vec(),
        b"\xff\xfe\x00".to_vec(),
        b"".to_vec(),
        "a: &a [x]\nb: *c".as_bytes().to_vec(),
        "[".repeat(100_000).into_bytes(),
    ];
    for text in broken {
        let (_guard, path) =
            directory(&[("session_0.mcap", &file(PLAIN, 0..100, 50)), ("metadata.yaml", &text)]);
        let (messages, damage, disagreements) = found(&path);
        assert_eq!((messages.len(), damage.len()), (100, 0));
        assert!(disagreements.len() == 1 && disagreements[0].contains("metadata.yaml"), "{disagreements:?}");
    }
}

/// Each takes a YAML parser more than half a minute, or gigabytes.
#[test]
fn metadata_that_would_take_minutes_is_refused_in_time() {
    let whole = metadata(9, 100, &["session_0.mcap"]);
    let custom = |text: &str| whole.replace("operator: one", text);
    let bombs = [
        (custom(&format!("operator: {}", "[".repeat(200_000))), "nested deeper than 64"),
        (
            custom(&format!(
                "operator: &a [{}]\n    others: [{}]",
                "x,".repeat(700_000),
                "*a,".repeat(500_000)
            )),
            "aliases",
        ),
        (
            (0..200_000).map(|number| format!("%TAG !{number}! a\n")).collect::<String>() + "---\n" + &whole,
            "directives",
        ),
    ];
    for (text, reason) in bombs {
        let (_guard, path) =
            directory(&[("session_0.mcap", &file(PLAIN, 0..100, 50)), ("metadata.yaml", text.as_bytes())]);
        let begun = std::time::Instant::now();
        let (messages, damage, disagreements) = found(&path);
        assert!(begun.elapsed().as_secs() < 10, "{reason}: {:?}", begun.elapsed());
        assert_eq!((messages.len(), damage.len()), (100, 0));
        assert!(disagreements.len() == 1 && disagreements[0].contains(reason), "{disagreements:?}");
    }
}

#[test]
fn where_metadata_and_files_disagree_the_files_are_right_and_the_difference_is_named() {
    let text = metadata(9, 77, &["session_0.mcap"]).replace("name: /pose", "name: /other");
    let (_guard, path) =
        directory(&[("session_0.mcap", &file(PLAIN, 0..100, 50)), ("metadata.yaml", text.as_bytes())]);
    let (messages, damage, disagreements) = found(&path);
    assert_eq!((messages.len(), damage.len()), (100, 0));
    let told = disagreements.join("\n");
    for words in ["/other", "/pose", "77 messages", "there are 100", "76000000 ns", "99000000 ns"] {
        assert!(told.contains(words), "{words} is missing in {told}");
    }
}

#[test]
fn a_missing_part_is_damage_and_the_others_are_read() {
    let text = metadata(9, 300, &["session_0.mcap", "session/session_1.mcap", "session_2.mcap"]);
    let (first, last) = (file(PLAIN, 0..100, 50), file(ZSTD, 200..300, 50));
    let (_guard, path) = directory(&[
        ("session_0.mcap", &first),
        ("session_2.mcap", &last),
        ("metadata.yaml", text.as_bytes()),
    ]);
    let (messages, damage, disagreements) = found(&path);
    assert_eq!(messages, (0..100).chain(200..300).collect::<Vec<_>>());
    assert!(damage.len() == 1 && damage[0].contains("session_1.mcap"), "{damage:?}");
    assert!(disagreements.iter().any(|told| told.contains("session_1.mcap")), "{disagreements:?}");
}

#[test]
fn where_nothing_that_metadata_names_is_there_what_is_there_is_read() {
    let text = metadata(9, 100, &["other_0.mcap"]);
    let first = file(PLAIN, 0..100, 50);
    let (_guard, path) = directory(&[("session_0.mcap", &first), ("metadata.yaml", text.as_bytes())]);
    let (messages, damage, disagreements) = found(&path);
    assert_eq!(messages, (0..100).collect::<Vec<_>>());
    assert!(damage.len() == 1 && damage[0].contains("other_0.mcap"), "{damage:?}");
    assert!(disagreements.iter().any(|told| told.contains("names other_0.mcap")), "{disagreements:?}");
    std::fs::write(path.join("another_0.mcap"), &first).unwrap();
    let error = Recording::open(&path).map(drop).unwrap_err().to_string();
    assert!(error.contains("another_0.mcap; session_0.mcap"), "{error}");
}

#[test]
fn a_part_that_metadata_does_not_name_yet_is_read_and_a_copy_in_another_storage_is_not() {
    let text = metadata(9, 100, &["session_0.mcap"]);
    let (first, second) = (file(PLAIN, 0..100, 50), file(PLAIN, 100..200, 50));
    let (_guard, path) = directory(&[
        ("session_0.mcap", &first),
        ("session_1.mcap", &second),
        ("copy.mcap", &first),
        ("session_0.db3", b"not looked at"),
        ("metadata.yaml", text.as_bytes()),
    ]);
    let (messages, damage, disagreements) = found(&path);
    assert_eq!((messages, damage), ((0..200).collect(), vec![]));
    assert!(
        disagreements.iter().any(|told| told.contains("does not name session_1.mcap")),
        "{disagreements:?}"
    );
}

#[test]
fn one_part_that_is_no_recording_at_all_does_not_stop_the_others() {
    let (_guard, path) = directory(&[
        ("session_0.mcap", b""),
        ("session_1.mcap", &file(PLAIN, 0..10, 5)),
        ("session_2.mcap", b"text"),
    ]);
    let (messages, damage, _) = found(&path);
    assert_eq!((messages.len(), damage.len()), (10, 2));
    assert!(damage[0].contains("empty") && damage[1].contains("magic"), "{damage:?}");
}

#[test]
fn equal_times_in_several_parts_keep_the_order_of_the_parts() {
    let (first, second) = (file(PLAIN, 0..50, 10), file(ZSTD, 0..50, 7));
    let (_guard, path) = directory(&[("session_9.mcap", &first), ("session_10.mcap", &second)]);
    let recording = Recording::open(&path).unwrap();
    assert_eq!(numbers(&read(&recording).0), (0..50).flat_map(|number| [number, number]).collect::<Vec<_>>());
    assert_eq!(recording.topics()[0].message_count, 100);
}

#[test]
fn files_compressed_as_a_whole_are_read_alone_and_in_their_directory() {
    let compressed = zstd::bulk::compress(&file(PLAIN, 0..500, 50), 3).unwrap();
    let text = metadata(9, 500, &["session_0.mcap.zstd"])
        .replace("compression_format: \"\"", "compression_format: zstd")
        .replace("compression_mode: \"\"", "compression_mode: FILE");
    let (_guard, path) =
        directory(&[("session_0.mcap.zstd", &compressed), ("metadata.yaml", text.as_bytes())]);
    for path in [path.clone(), path.join("session_0.mcap.zstd")] {
        assert_eq!(found(&path), ((0..500).collect(), vec![], vec![]));
    }
    // Some versions name the file as it was before.
    std::fs::write(path.join("metadata.yaml"), text.replace(".mcap.zstd", ".mcap")).unwrap();
    assert_eq!(found(&path), ((0..500).collect(), vec![], vec![]));
}

#[test]
fn a_compressed_file_that_is_cut_is_read_up_to_there_and_a_bomb_is_refused_in_time() {
    let whole = file(PLAIN, 0..20_000, 500);
    let compressed = zstd::bulk::compress(&whole, 1).unwrap();
    let (_guard, path) = directory(&[("session_0.mcap.zstd", &compressed[..compressed.len() / 2])]);
    let (messages, damage, _) = found(&path);
    assert!(messages.len() > 2000 && messages.len() < 20_000, "{}", messages.len());
    assert!(
        damage.iter().any(|told| told.contains("session_0.mcap.zstd") && told.contains("breaks off")),
        "{damage:?}"
    );

    let (_guard, path) = directory(&[("session_0.mcap.zstd", b"no compression at all")]);
    let error = Recording::open(&path).unwrap_err().to_string();
    assert!(error.contains("session_0.mcap.zstd") && error.contains("zstd"), "{error}");
}

/// Each copy of a file has what its own bytes give, and all of them together what one has beside that.
#[test]
fn copies_of_a_bomb_in_one_directory_decompress_to_no_more_than_one() {
    let inside = vec![0; 60 << 20];
    let stored = zstd::bulk::compress(&inside, 1).unwrap();
    let size = (inside.len() as u64).to_le_bytes();
    let length = (stored.len() as u64).to_le_bytes();
    let content = [&[0; 16][..], &size, &[0; 4], &4_u32.to_le_bytes(), b"zstd", &length, &stored].concat();
    let chunk = [&[op::CHUNK][..], &(content.len() as u64).to_le_bytes(), &content].concat();
    let bomb = [mcap::MAGIC, &chunk.repeat(15)].concat();
    let copies: Vec<_> = (0..4).map(|number| format!("session_{number}.mcap")).collect();
    let files: Vec<_> = copies.iter().map(|name| (name.as_str(), &bomb[..])).collect();
    let (_guard, path) = directory(&files);
    let damage: Vec<_> = Recording::open(&path).unwrap().damage().iter().map(ToString::to_string).collect();
    let left_out = damage.iter().filter(|told| told.contains("behind others")).count();
    assert!(left_out >= 40, "{left_out}: {damage:?}");

    let zeros = [&file(PLAIN, 0..100, 50)[..], &vec![0; 200 << 20]].concat();
    let whole = zstd::bulk::compress(&zeros, 1).unwrap();
    let (_guard, path) = directory(&[("a_0.mcap.zstd", &whole), ("a_1.mcap.zstd", &whole)]);
    let damage: Vec<_> = Recording::open(&path).unwrap().damage().iter().map(ToString::to_string).collect();
    assert!(
        damage.iter().any(|told| told.contains("a_1.mcap.zstd") && told.contains("decompresses to more")),
        "{damage:?}"
    );
}

#[test]
fn what_is_no_regular_file_is_refused_without_waiting_for_it() {
    let directory = tempfile::tempdir().unwrap();
    let at = |name: &str| directory.path().join(name);
    let pipe =
        |path: &Path| assert!(std::process::Command::new("mkfifo").arg(path).status().unwrap().success());
    for name in ["pipe.mcap", "pipe.db3", "pipe.mcap.zstd"] {
        pipe(&at(name));
    }
    std::os::unix::fs::symlink("/dev/zero", at("device.mcap")).unwrap();
    std::fs::create_dir(at("session")).unwrap();
    std::fs::write(at("session").join("session_0.mcap"), file(PLAIN, 0..10, 10)).unwrap();
    pipe(&at("session").join("metadata.yaml"));
    // Whoever opens a pipe waits until somebody writes into it, so this is done beside the test.
    let (sender, receiver) = std::sync::mpsc::sync_channel(1);
    let names = ["pipe.mcap", "pipe.db3", "pipe.mcap.zstd", "device.mcap"].map(at);
    let session = at("session");
    let beside = std::thread::Builder::new().name("opens pipes".to_owned());
    let opening = beside.spawn(move || {
        let refusals = names.map(|name| Recording::open(name).unwrap_err().to_string());
        let session = Recording::open(session).unwrap();
        sender.send((refusals, session)).unwrap();
    });
    assert!(opening.is_ok());
    let (refusals, session) = receiver.recv_timeout(std::time::Duration::from_secs(60)).unwrap();
    for refusal in &refusals {
        assert!(refusal.contains("no regular file"), "{refusal}");
    }
    let told = session.metadata_disagreements();
    assert!(told.len() == 1 && told[0].contains("metadata.yaml: it is no regular file"), "{told:?}");
    assert_eq!(read(&session).0.len(), 10);
}

#[test]
fn a_recording_of_more_parts_than_a_process_may_open_is_read() {
    let directory = tempfile::tempdir().unwrap();
    for part in 0..300 {
        let path = directory.path().join(format!("session_{part}.mcap"));
        std::fs::write(path, file(PLAIN, 3 * part..3 * part + 3, 3)).unwrap();
    }
    let open_files = || std::fs::read_dir("/proc/self/fd").unwrap().count();
    let before = open_files();
    let recording = Recording::open(directory.path()).unwrap();
    assert!(open_files() < before + 150, "{before} files open before, {} with it", open_files());
    assert!(recording.damage().is_empty());
    assert_eq!(numbers(&read(&recording).0), (0..900).collect::<Vec<_>>());
}

#[test]
fn a_topic_with_two_definitions_is_two_topics_and_one_with_other_comments_is_one() {
    let directory = tempfile::tempdir().unwrap();
    let text = "std_msgs/Header header\ngeometry_msgs/Pose pose\n";
    let described = |text: &str, format: &str| {
        let mut topic = topic("/pose");
        topic.definition.text = text.to_owned();
        topic.serialization_format = format.to_owned();
        topic
    };
    let with = |name: &str, variants: &[recording::Topic]| {
        let path = directory.path().join(name);
        let mut writer = recording::Writer::create(&path, "jazzy").unwrap();
        for (number, topic) in (0..).zip(variants) {
            let id = writer.add_topic(topic.clone()).unwrap();
            write(&mut writer, id, 10 * number..10 * number + 10);
        }
        writer.close().unwrap();
        Recording::open(path).unwrap()
    };
    let counts = |recording: &Recording| {
        assert!(recording.metadata_disagreements().is_empty(), "{:?}", recording.metadata_disagreements());
        recording.topics().iter().map(|found| found.message_count).collect::<Vec<_>>()
    };
    let other = described(&text.replace("pose\n", "elsewhere\n"), "cdr");
    let two = with("definitions", &[described(text, "cdr"), other]);
    assert_eq!(counts(&two), [10, 10]);
    assert_eq!(two.topics()[1].topic.definition.text, text.replace("pose\n", "elsewhere\n"));
    assert_eq!(two.messages_of(&[1]).count(), 10);
    assert_eq!(counts(&with("encodings", &[described(text, "cdr"), described(text, "json")])), [10, 10]);
    let commented = described(&format!("# Where the handle is.\n{text}"), "cdr");
    let one = with("comments", &[described(text, "cdr"), commented, described("", "cdr")]);
    assert_eq!(counts(&one), [30]);
}

/// What a repair says of the recording at `path`.
fn repaired(path: &Path) -> Repaired {
    repair(path, &default_output(path), &|| true).unwrap()
}

#[test]
fn a_hole_in_the_numbers_of_the_parts_is_a_disagreement_and_nobody_knows_what_was_in_it() {
    let part = |number: u64| file(PLAIN, 10 * number..10 * number + 10, 5);
    let parts = |numbers: &[u64]| {
        let files: Vec<_> =
            numbers.iter().map(|number| (format!("session_{number}.mcap"), part(*number))).collect();
        directory(&files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice())).collect::<Vec<_>>())
    };
    for (numbers, told) in [
        (&[0, 1, 3][..], "session_2.mcap is not there, and session_3.mcap is"),
        (&[1, 2], "session_0.mcap is not there, and session_1.mcap is"),
        (&[0, 9, 10], "session_1.mcap to session_8.mcap are not there, and session_9.mcap is"),
    ] {
        let (_guard, path) = parts(numbers);
        let (messages, damage, disagreements) = found(&path);
        assert_eq!((messages.len(), damage.len()), (10 * numbers.len(), 0));
        assert!(disagreements.len() == 1 && disagreements[0].contains(told), "{disagreements:?}");
        assert!(check(&path).problems.iter().any(|problem| problem.contains(told)));
        let repaired = repaired(&path);
        assert_eq!((repaired.saved, repaired.all_saved), (10 * numbers.len() as u64, false), "{repaired:?}");
        assert_eq!(repaired.topics[0].lost, None);
    }
    let (_guard, path) = parts(&[0, 1, 2]);
    assert_eq!(found(&path), ((0..30).collect(), vec![], vec![]));
    assert!(repaired(&path).all_saved);
}

#[test]
fn a_hole_before_a_part_that_metadata_does_not_name_yet_is_a_disagreement_and_its_counts_are_not_all() {
    let text = metadata(9, 100, &["session_5.mcap"]);
    let (first, later) = (file(PLAIN, 0..100, 50), file(PLAIN, 300..400, 50));
    let (_guard, path) = directory(&[
        // The parts before were deleted by a recorder that keeps the newest ones.
        ("session_5.mcap", &first),
        ("session_7.mcap", &later),
        ("metadata.yaml", text.as_bytes()),
    ]);
    let (_, _, disagreements) = found(&path);
    let told = disagreements.join("\n");
    assert!(told.contains("session_6.mcap is not there") && !told.contains("session_4"), "{told}");
    assert!(!repaired(&path).all_saved);

    // Without the hole: what is broken in a part that metadata does not count yet may have held anything.
    let cut = &later[..later.len() * 3 / 4];
    let (_guard, path) =
        directory(&[("session_5.mcap", &first), ("session_6.mcap", cut), ("metadata.yaml", text.as_bytes())]);
    let repaired = repaired(&path);
    assert!(repaired.saved > 100 && !repaired.all_saved, "{repaired:?}");
}

#[test]
fn parts_are_read_in_the_order_of_their_numbers_though_some_are_compressed() {
    let compressed = zstd::bulk::compress(&file(PLAIN, 0..50, 10), 3).unwrap();
    let (_guard, path) =
        directory(&[("session_0.mcap.zstd", &compressed), ("session_1.mcap", &file(PLAIN, 0..60, 10))]);
    let recording = Recording::open(&path).unwrap();
    let stored: Vec<_> = recording.stored_messages().map(|message| message.unwrap()).collect();
    assert_eq!(numbers(&stored), (0..50).chain(0..60).collect::<Vec<_>>());
}
