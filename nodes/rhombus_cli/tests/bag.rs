//! `rhombus bag`, the real executable, on whole and broken recordings.
#![expect(clippy::expect_used, clippy::panic, reason = "a test may fail here")]

mod common;
#[path = "../../../tests/bags/damaged/mod.rs"]
mod damaged;

use std::collections::BTreeSet;
use std::path::Path;
use std::process::{Command, Output};

use common::{Folder, Run};
use damaged::{Case, Expected, hostile, mcap_file, whole};
use recording::Recording;
use serde_json::Value;

/// What is promised of a check of a file up to 10 MB.
const MOST_MEMORY_BYTES: u64 = 500_000_000;
const MOST_SECONDS: u64 = 20;

/// Runs with the promised limits: beyond them the system refuses memory or ends the process.
fn limits(folder: &Folder, arguments: &[&str]) -> Output {
    let mut command = Command::new("prlimit");
    command.arg(format!("--as={MOST_MEMORY_BYTES}")).arg(format!("--cpu={MOST_SECONDS}"));
    command.arg(env!("CARGO_BIN_EXE_rhombus")).args(arguments).current_dir(folder.path("."));
    command.output().expect("prlimit is part of util-linux")
}

/// As [`limits`], of a run that must end by itself.
fn limited(folder: &Folder, arguments: &[&str]) -> Run {
    let Output { status, stdout, stderr } = limits(folder, arguments);
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    let (stdout, stderr) = (text(stdout), text(stderr));
    let code = status.code().unwrap_or_else(|| panic!("{arguments:?} ended by {status}: {stderr}"));
    Run { code, stdout, stderr }
}

fn code_of(expected: Expected) -> i32 {
    match expected {
        Expected::Whole => 0,
        Expected::Damaged => 1,
        Expected::Unreadable => 2,
    }
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap_or_else(|error| panic!("{error}: {text}"))
}

fn number(value: &Value) -> u64 {
    value.as_u64().unwrap_or_else(|| panic!("{value} is not a number"))
}

/// A folder with the whole recording `session`.
fn with_session() -> Folder {
    let folder = Folder::new();
    whole::write(&folder.path("session"));
    folder
}

/// Everything below a directory: paths and bytes.
fn content(path: &Path) -> Vec<(String, Vec<u8>)> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(path).expect("a directory") {
        let path = entry.expect("an entry").path();
        match path.is_dir() {
            true => found.extend(content(&path)),
            false => found.push((path.display().to_string(), std::fs::read(&path).expect("a file"))),
        }
    }
    found.sort();
    found
}

fn names(path: &Path) -> BTreeSet<String> {
    let entries = std::fs::read_dir(path).expect("a directory");
    entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect()
}

#[test]
fn a_check_says_of_every_broken_recording_how_much_of_it_can_be_used_and_why() {
    let folder = Folder::new();
    let mut wrong = Vec::new();
    for case in damaged::all() {
        case.write(&folder.path("."));
        let before = content(&folder.path("."));
        let Run { code, stdout, stderr } = limited(&folder, &["bag", "check", case.name]);
        let unsaid: Vec<_> = case.words.iter().filter(|word| !stdout.contains(**word)).collect();
        let in_json = limited(&folder, &["bag", "check", "--json", case.name]);
        let readable = number(&json(&in_json.stdout)["message_count"]);
        let expected = code_of(case.expected);
        if (code, in_json.code) != (expected, expected) || !unsaid.is_empty() || readable < case.readable {
            let least = case.readable;
            wrong.push(format!(
                "{}: exit codes {code} and {}, expected {expected}; not said: {unsaid:?}; {readable} readable, at least \
                 {least} expected\n{stdout}{stderr}",
                case.name, in_json.code
            ));
        }
        assert_eq!(stderr, "", "{}", case.name);
        assert_eq!(content(&folder.path(".")), before, "{}: a check changes nothing", case.name);
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_check_of_a_hostile_file_keeps_its_exit_codes_and_its_limits() {
    let mut wrong = Vec::new();
    for case in hostile::cases() {
        let folder = Folder::new();
        case.write(&folder.path("."));
        let output = limits(&folder, &["bag", "check", "--json", case.name]);
        if !matches!(output.status.code(), Some(0..=2)) {
            let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
            wrong.push(format!("{}: {}: {stderr}", case.name, output.status));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_whole_recording_is_whole_as_a_directory_and_as_a_bare_file() {
    let folder = with_session();
    for path in ["session", "session/", "./session", "session/session_0.mcap"] {
        let Run { code, stdout, stderr } = limited(&folder, &["bag", "check", path]);
        assert_eq!((code, stderr.as_str()), (0, ""), "{path}: {stdout}");
        assert_eq!(stdout, format!("{path}: whole: 4020 messages on 3 topics, 1.999 s\n"));
    }
}

#[test]
fn wrong_usage_of_bag_is_exit_code_3_and_help_is_0() {
    let folder = with_session();
    for arguments in [
        &["bag"][..],
        &["bag", "check"],
        &["bag", "check", ""],
        &["bag", "check", "session", "session"],
        &["bag", "check", "--frobnicate", "session"],
        &["bag", "check", "session", "--output", "new"],
        &["bag", "info"],
        &["bag", "repair"],
        &["bag", "repair", "session", "--output"],
        &["bag", "frobnicate", "session"],
        &["--frobnicate", "bag", "check", "session"],
        &["--frobnicate", "value", "bag", "check", "session"],
    ] {
        let run = folder.run(arguments);
        assert_eq!((run.code, run.stdout.as_str()), (3, ""), "{arguments:?}: {}", run.stderr);
        assert!(run.stderr.contains("--help"), "{arguments:?}: {}", run.stderr);
    }
    assert_eq!(folder.run(&["bag", "check", "--help"]).code, 0);
    for arguments in
        [&["evaluate", "--frobnicate"][..], &["--frobnicate", "evaluate", "bag"], &["--frobnicate"]]
    {
        assert_eq!(folder.run(arguments).code, 2, "{arguments:?}: other commands keep their code");
    }
}

#[test]
fn what_is_no_recording_is_told_what_is_one() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path("empty")).expect("made");
    let refusal = folder.refusal(&["bag", "repair", "empty"]);
    let accepted = match cfg!(feature = "sqlite") {
        true => "a rosbag2 directory of .mcap or .db3 files, with metadata.yaml or without, or one such file",
        false => "a rosbag2 directory of .mcap files, with metadata.yaml or without, or one such file",
    };
    assert!(refusal.contains(&format!("accepted: {accepted}")), "{refusal}");
}

#[test]
fn what_is_not_there_is_not_readable() {
    let folder = Folder::new();
    for arguments in [&["bag", "check", "missing"][..], &["bag", "info", "missing"]] {
        let run = folder.run(arguments);
        assert_eq!(run.code, 2, "{arguments:?}: {}", run.stdout);
        assert!(run.stdout.contains("nothing can be read"), "{}", run.stdout);
    }
    assert!(folder.refusal(&["bag", "repair", "missing"]).contains("missing"));
    assert_eq!(names(&folder.path(".")), BTreeSet::new(), "nothing is left behind");
}

/// Such as a directory with everything that was recorded on a day.
#[test]
fn a_directory_of_several_recordings_without_metadata_is_refused_and_names_them() {
    let folder = with_session();
    std::fs::create_dir(folder.path("day")).expect("made");
    for name in ["left_0.mcap", "right_0.mcap", "right_1.mcap"] {
        std::fs::copy(folder.path("session/session_0.mcap"), folder.path("day").join(name)).expect("copied");
    }
    let found = "day: holds several recordings and no metadata.yaml that says which files are one: left_0.mcap; \
                 right_0.mcap to right_1.mcap; name one file";
    for command in ["info", "check"] {
        let run = folder.run(&["bag", command, "day"]);
        assert_eq!((run.code, run.stdout.contains(found)), (2, true), "{}", run.stdout);
    }
    assert!(folder.refusal(&["bag", "repair", "day"]).contains(found));
    assert_eq!(folder.run(&["bag", "check", "day/left_0.mcap"]).code, 0);
}

#[test]
fn info_says_rates_gaps_stamps_qos_and_types() {
    let folder = Folder::new();
    let bytes = whole::one_topic(
        whole::topic("/measured_cp", "geometry_msgs/msg/PoseStamped", whole::POSE_TEXT),
        1000,
        // Two messages of each hundred have the stamp of the one before.
        |number| recording::cdr::encode(&whole::pose(if number % 50 == 49 { number - 1 } else { number })),
    );
    std::fs::write(folder.path("poses.mcap"), bytes).expect("written");
    let info = folder.json(&["bag", "info", "poses.mcap", "--json"]);
    assert_eq!(info["verdict"], "whole");
    assert_eq!(info["start_ns"], whole::START_NS);
    let topic = &info["topics"][0];
    assert_eq!(topic["name"], "/measured_cp");
    assert_eq!(topic["messages"], 1000);
    assert_eq!(topic["mean_rate_hz"], 1000.0);
    assert_eq!(topic["median_ns"], 1_000_000);
    assert_eq!(topic["gaps"], 0);
    assert_eq!(topic["stamps"]["repeats"], 20);
    assert_eq!(topic["definition"]["state"], "agrees");
    assert_eq!(topic["offered_qos"][0]["reliability"], "reliable");
    let text = folder.success(&["bag", "info", "poses.mcap"]);
    for words in [
        "start     2023-11-14T22:13:20.000000000Z",
        "duration  0.999 s",
        "/measured_cp  geometry_msgs/msg/PoseStamped",
        "1000.000 Hz",
        "20 repeat the one before; the first is that of message 50",
        "reliable, volatile",
        "agrees",
        "RIHS01_0f",
        "poses.mcap: whole: 1000 messages on 1 topic, 0.999 s",
    ] {
        assert!(text.contains(words), "{words:?} is missing in:\n{text}");
    }
}

#[test]
fn info_finds_the_largest_gap_and_where_it_is() {
    let folder = Folder::new();
    let (_, bytes) = whole::made(|path| {
        let mut writer = recording::Writer::create(path, "jazzy").expect("created");
        let topic = whole::topic("/measured_cp", "geometry_msgs/msg/PoseStamped", whole::POSE_TEXT);
        let id = writer.add_topic(topic).expect("added");
        // 10 ms are missing behind message 300 and 4 ms behind message 600.
        for number in (0..301).chain(310..601).chain(604..1000) {
            let data = recording::cdr::encode(&whole::pose(number));
            writer.write(id, whole::log_time_ns(number), &data).expect("written");
        }
        writer.close().expect("closed");
    });
    std::fs::write(folder.path("gaps.mcap"), bytes).expect("written");
    let topic = &folder.json(&["bag", "info", "gaps.mcap", "--json"])["topics"][0];
    assert_eq!(topic["gaps"], 2);
    assert_eq!(topic["largest_gap"]["length_ns"], 10_000_000);
    assert_eq!(topic["largest_gap"]["after_ns"], whole::log_time_ns(300));
}

/// What a repair of `case` did: exit code and JSON.
fn repaired(folder: &Folder, case: &Case) -> (i32, Option<Value>) {
    let run = folder.run(&["bag", "repair", case.name, "--output", "saved", "--json"]);
    (run.code, (run.code < 2).then(|| json(&run.stdout)))
}

#[test]
fn a_repair_makes_a_whole_recording_of_all_that_a_check_can_read() {
    for case in damaged::all() {
        let folder = Folder::new();
        case.write(&folder.path("."));
        let before = content(&folder.path("."));
        let readable =
            number(&json(&folder.run(&["bag", "check", "--json", case.name]).stdout)["message_count"]);
        let (code, report) = repaired(&folder, &case);
        let Some(report) = report else {
            assert_eq!((code, case.expected), (2, Expected::Unreadable), "{}", case.name);
            assert_eq!(content(&folder.path(".")), before, "{}: nothing is left behind", case.name);
            continue;
        };
        assert_ne!(case.expected, Expected::Unreadable, "{}", case.name);
        assert_eq!(number(&report["saved"]), readable, "{}", case.name);
        let remaining = report["remaining"].as_array().expect("a list");
        let is_whole = report["all_saved"] == true && remaining.is_empty();
        assert_eq!(code == 0, is_whole, "{}: {report}", case.name);
        let checked = folder.run(&["bag", "check", "saved"]);
        assert_eq!(checked.code == 0, remaining.is_empty(), "{}: {}", case.name, checked.stdout);
        if case.expected == Expected::Whole {
            assert_eq!(code, 0, "{}: {report}", case.name);
        }
        let saved = Recording::open(folder.path("saved")).expect("it opens");
        assert!(saved.damage().is_empty() && saved.metadata_disagreements().is_empty(), "{}", case.name);
        assert_eq!(
            saved.messages().map(|message| message.map(|_| 1)).sum::<Result<u64, _>>().expect("whole"),
            readable
        );
        std::fs::remove_dir_all(folder.path("saved")).expect("removed");
        assert_eq!(content(&folder.path(".")), before, "{}: the old one is as it was", case.name);
    }
}

/// A repair helps where places cannot be read, and not where the messages are not what their type says.
#[test]
fn what_a_repair_cannot_change_is_said_by_it_and_a_check_does_not_send_there() {
    let advice = "what to do: rhombus bag repair";
    for (name, remaining) in [
        ("short_cdr.mcap", 1),
        ("unknown_encoding.mcap", 500),
        ("another_definition.mcap", 500),
        ("two_definitions.mcap", 250),
        ("two_encodings.mcap", 0),
    ] {
        let folder = Folder::new();
        let case = damaged::all().into_iter().find(|case| case.name == name).expect("it is made");
        case.write(&folder.path("."));
        let before = folder.run(&["bag", "check", name]);
        assert_eq!(before.code, 1, "{name}: {}", before.stdout);
        assert!(!before.stdout.contains(advice), "{name}: {}", before.stdout);
        let repair = folder.run(&["bag", "repair", name, "--output", "saved"]);
        assert_eq!(repair.code, 1, "{name}: {}", repair.stdout);
        let said = match remaining {
            0 => "nothing lost; topics have messages of several kinds; kept as recorded\n".to_owned(),
            1 => "nothing lost; 1 message is not what its type says; kept as recorded\n".to_owned(),
            _ => {
                format!("nothing lost; {remaining} messages are not what their type says; kept as recorded\n")
            }
        };
        assert!(
            repair.stdout.ends_with(&said) && !repair.stdout.contains("whole"),
            "{name}: {}",
            repair.stdout
        );
        let after = folder.run(&["bag", "check", "saved"]);
        assert_eq!(after.code, 1, "{name}: {}", after.stdout);
        assert!(!after.stdout.contains(advice), "{name}: {}", after.stdout);
        for problem in after.stdout.lines().filter_map(|line| line.strip_prefix("  problem: ")) {
            assert!(repair.stdout.contains(&format!("remains: {problem}\n")), "{name}: {}", repair.stdout);
        }
    }
    let folder = with_session();
    let whole = std::fs::read(folder.path("session/session_0.mcap")).expect("read");
    std::fs::write(folder.path("cut.mcap"), &whole[..whole.len() / 2]).expect("written");
    assert!(folder.run(&["bag", "check", "cut.mcap"]).stdout.contains(advice));
}

#[test]
fn a_repair_says_in_numbers_what_was_lost() {
    let flipped = mcap_file::cases().into_iter().find(|case| case.name == "flipped_in_chunk.mcap");
    let case = flipped.expect("it is made");
    let folder = Folder::new();
    case.write(&folder.path("."));
    let text = folder.run(&["bag", "repair", case.name]).stdout;
    let (code, report) = repaired(&folder, &case);
    let report = report.expect("something is saved");
    assert_eq!(code, 1);
    assert_eq!(number(&report["saved"]) + number(&report["lost"]), whole::MESSAGES);
    for (topic, recorded) in
        report["topics"].as_array().expect("topics").iter().zip([whole::POSES, whole::POSES, 20])
    {
        assert_eq!(number(&topic["saved"]) + number(&topic["lost"]), recorded, "{topic}");
        let said = format!(
            "{}: {} saved, {} lost",
            topic["name"].as_str().expect("text"),
            topic["saved"],
            topic["lost"]
        );
        assert!(text.contains(&said), "{said:?} is missing in:\n{text}");
    }
    assert!(folder.path("flipped_in_chunk_repaired/metadata.yaml").exists(), "the name without --output");
    assert_eq!(folder.run(&["bag", "check", "flipped_in_chunk_repaired"]).code, 0);
}

#[test]
fn a_repair_keeps_topics_times_sequences_and_bytes() {
    let folder = with_session();
    let text = folder.success(&["bag", "repair", "session"]);
    assert!(text.ends_with("session_repaired: whole: 4020 messages saved, nothing lost\n"), "{text}");
    let open = |name: &str| Recording::open(folder.path(name)).expect("it opens");
    let (old, new) = (open("session"), open("session_repaired"));
    assert_eq!(old.topics(), new.topics());
    let all = |recording: &Recording| recording.messages().collect::<Result<Vec<_>, _>>().expect("whole");
    assert!(all(&old) == all(&new), "the messages are the same");
}

/// Such as a file in which every topic that a robot ever had is a channel.
#[test]
fn a_repair_of_more_topics_than_metadata_takes_is_refused_at_once() {
    let folder = Folder::new();
    let bytes = whole::many_topics(20_000);
    std::fs::write(folder.path("many.mcap"), bytes).expect("written");
    let refusal = folder.refusal(&["bag", "repair", "many.mcap"]);
    assert!(refusal.contains("20000 topics") && refusal.contains("accepted"), "{refusal}");
    assert_eq!(names(&folder.path(".")), BTreeSet::from(["many.mcap".to_owned()]), "nothing is left behind");
}

#[test]
fn a_repair_overwrites_nothing_and_does_not_write_into_the_old_recording() {
    let folder = with_session();
    std::fs::create_dir(folder.path("taken")).expect("made");
    let before = content(&folder.path("."));
    let refusal = folder.refusal(&["bag", "repair", "session", "--output", "taken"]);
    assert!(refusal.contains("taken") && refusal.contains("not overwritten"), "{refusal}");
    let refusal = folder.refusal(&["bag", "repair", "session", "--output", "session/new"]);
    assert!(refusal.contains("inside"), "{refusal}");
    let refusal = folder.refusal(&["bag", "repair", "session", "--output", "missing/new"]);
    assert!(refusal.contains("missing"), "{refusal}");
    assert_eq!(content(&folder.path(".")), before);
}

#[test]
fn a_repair_that_cannot_write_all_of_it_leaves_nothing_behind() {
    let folder = with_session();
    // As on a full disk: files cannot grow beyond this, and writing says so instead of ending the process.
    let script = format!(
        "trap '' XFSZ; exec prlimit --fsize=100000 {} bag repair session --output new",
        env!("CARGO_BIN_EXE_rhombus")
    );
    let output = Command::new("sh").args(["-c", &script]).current_dir(folder.path(".")).output().expect("sh");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{stderr}");
    assert!(stderr.contains("cannot write"), "{stderr}");
    assert_eq!(names(&folder.path(".")), BTreeSet::from(["session".to_owned()]), "nothing is left behind");
}

#[test]
fn a_verdict_keeps_its_exit_code_where_nothing_can_be_printed() {
    let folder = with_session();
    std::fs::write(folder.path("empty.mcap"), "").expect("written");
    let cut = std::fs::read(folder.path("session/session_0.mcap")).expect("read");
    std::fs::write(folder.path("cut.mcap"), &cut[..cut.len() / 2]).expect("written");
    for (path, expected) in [("session", 0), ("cut.mcap", 1), ("empty.mcap", 2)] {
        let full = std::fs::File::options().write(true).open("/dev/full").expect("it is there");
        let output = folder.command(&["bag", "check", path]).stdout(full).output().expect("it starts");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(expected), "{path}: {said}");
        assert_eq!(said.trim_end().lines().count(), 1, "{said}");
        assert!(said.contains("cannot write to stdout: No space left"), "{said}");
    }
}

#[test]
fn the_reason_of_the_system_is_said_once() {
    let folder = Folder::new();
    std::os::unix::fs::symlink("loop.mcap", folder.path("loop.mcap")).expect("made");
    for arguments in [
        &["bag", "repair", "loop.mcap"][..],
        &["bag", "repair", "loop.mcap", "--output", "loop.mcap/new"],
        &["replay", "loop.mcap", "--params", "none.yaml"],
    ] {
        let refusal = folder.refusal(arguments);
        assert!(refusal.matches("os error").count() <= 1, "{refusal}");
    }
    let refusal = folder.refusal(&["bag", "repair", "loop.mcap"]);
    assert!(refusal.contains("os error 40"), "{refusal}");
}

#[test]
fn what_a_repair_says_of_lost_messages_does_not_depend_on_the_name_of_the_file() {
    let flipped = mcap_file::cases().into_iter().find(|case| case.name == "flipped_in_chunk.mcap");
    let mut bytes = flipped.expect("it is made").files.remove(0).1;
    // Without its closing records, where the recording itself does not say how many messages it had.
    bytes.truncate(damaged::records::chunks(&bytes).last().expect("chunks").end);
    let folder = Folder::new();
    std::fs::create_dir(folder.path("closing records")).expect("made");
    std::fs::write(folder.path("closing records/x.mcap"), &bytes).expect("written");
    let run = folder.run(&["bag", "repair", "closing records/x.mcap", "--output", "saved"]);
    assert_eq!(run.code, 1, "{}", run.stdout);
    assert!(!run.stdout.contains("nothing lost"), "{}", run.stdout);
}
