//! `rhombus replay` as an integrator's CI uses it: the same recording, the same bits, and what differs is found.
#![expect(clippy::unwrap_used, reason = "a test may fail here")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use recording::cdr::{decode, encode};
use recording::messages::{PoseStamped, TransformStamped, own_definition};
use recording::{MessageRef, Recording, Topic, TopicId, Writer};

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn bag(name: &str) -> String {
    format!("tests/bags/{name}")
}

fn rhombus(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_rhombus"))
        .args(arguments)
        .current_dir(repository())
        .env_remove("AMENT_PREFIX_PATH")
        .output()
        .unwrap()
}

fn replay(recording: &str, more: &[&str]) -> Output {
    rhombus(&[&["replay", recording, "--params", "config/liver.yaml"], more].concat())
}

fn code(output: &Output) -> i32 {
    output.status.code().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

/// Copies a recording; `change` gives what becomes of each message, by its number in the recording.
fn changed(
    from: &str,
    to: &Path,
    mut change: impl FnMut(usize, &MessageRef<'_>, &str) -> Vec<Vec<u8>>,
    type_of: impl Fn(&Topic) -> Topic,
) {
    let recording = Recording::open(repository().join(from)).unwrap();
    let mut writer = Writer::create(to, "").unwrap();
    let ids: Vec<TopicId> = recording
        .topics()
        .iter()
        .map(|recorded| writer.add_topic(type_of(&recorded.topic)).unwrap())
        .collect();
    let mut messages = recording.messages();
    let mut number = 0;
    while let Some(message) = messages.next_ref() {
        let message = message.unwrap();
        let name = recording.topics()[message.topic].topic.name.clone();
        for data in change(number, &message, &name) {
            writer.write(ids[message.topic], message.log_time_ns, &data).unwrap();
        }
        number += 1;
    }
    writer.close().unwrap();
}

fn golden(folder: &Path, name: &str) -> String {
    let golden = folder.join(format!("golden_{name}")).to_str().unwrap().to_owned();
    let output = replay(&bag(name), &["--record", &golden]);
    assert_eq!(code(&output), 0, "{}", said(&output));
    golden
}

/// The one committed hash: today, on every machine, with and without optimization.
#[test]
fn every_recording_is_answered_with_the_committed_bits() {
    let committed = std::fs::read_to_string(repository().join("tests/bags/sha256.txt")).unwrap();
    let rows: Vec<Vec<&str>> = committed
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.split_whitespace().collect())
        .collect();
    assert_eq!(rows.len(), 6);
    for row in rows {
        let [name, params, digest] = row[..] else { panic!("{row:?}") };
        let output = rhombus(&["replay", &bag(name), "--params", params, "--json"]);
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(report["sha256"], digest, "{name}");
        assert_eq!(report["unusable"], 0, "{name}");
        assert_eq!(report["rejected"].as_array().unwrap().iter().filter_map(|n| n.as_u64()).sum::<u64>(), 0);
        assert!(report["surfaces"].as_u64().unwrap() > 70, "{name}");
    }
}

#[test]
fn a_recorded_replay_is_what_the_next_replay_computes() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["press", "grasp_and_pull"] {
        let golden = golden(folder.path(), name);
        let output = replay(&bag(name), &["--expect", &golden]);
        assert_eq!(code(&output), 0, "{}", said(&output));
        assert!(said(&output).contains("same as"), "{}", said(&output));
    }
}

#[test]
fn a_change_of_one_parameter_in_the_sixth_digit_is_found_and_may_be_tolerated() {
    let folder = tempfile::tempdir().unwrap();
    let golden = golden(folder.path(), "press");
    let set = "chains.normal_stiffness=[230.0, 580.001, 1240.0]";
    let reports =
        ["r.svg", "r.xml", "r.md"].map(|name| folder.path().join(name).to_str().unwrap().to_owned());
    let output = replay(
        &bag("press"),
        &[
            "--set",
            set,
            "--expect",
            &golden,
            "--plot",
            &reports[0],
            "--junit",
            &reports[1],
            "--markdown",
            &reports[2],
        ],
    );
    assert_eq!(code(&output), 1);
    assert!(said(&output).contains("/servo_cf: DIFFERENT"), "{}", said(&output));
    assert!(said(&output).contains("normal_stiffness[1] is 580.001 N/m instead of 580.0 N/m"));
    let written = reports.map(|path| std::fs::read_to_string(path).unwrap());
    assert!(written[0].starts_with("<svg") || written[0].starts_with("<?xml"), "{}", &written[0][..60]);
    assert!(written[1].contains("<failure") && written[1].contains("testsuite"));
    assert!(written[2].contains("| /servo\\_cf | **different** |"), "{}", written[2]);

    let tolerances = ["servo_cf=1e-6,0", "contact_law=0.01,0", "contact_state=0.001,0"];
    let tolerances = tolerances.iter().flat_map(|tolerance| ["--tolerance", tolerance]);
    let arguments: Vec<&str> = ["--set", set, "--expect", &golden].into_iter().chain(tolerances).collect();
    let output = replay(&bag("press"), &arguments);
    assert_eq!(code(&output), 0, "{}", said(&output));
}

#[test]
fn one_stamp_one_message_more_and_one_message_less_are_found_where_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let golden = golden(folder.path(), "press");
    let check = |name: &str, change: &dyn Fn(usize, &MessageRef<'_>) -> Vec<Vec<u8>>, expected: &str| {
        let path = folder.path().join(name);
        changed(&bag("press"), &path, |number, message, _| change(number, message), Topic::clone);
        let output = replay(path.to_str().unwrap(), &["--expect", &golden]);
        assert_eq!(code(&output), 1, "{name}: {}", said(&output));
        assert!(said(&output).contains(expected), "{name}: {}", said(&output));
    };
    let later = |number: usize, message: &MessageRef<'_>| {
        let mut pose: PoseStamped = decode(message.data).unwrap();
        if number == 700 {
            pose.header.stamp.nanosec += 1;
        }
        vec![encode(&pose)]
    };
    check("stamp", &later, "message #700");
    check("less", &|n, m| if n == 700 { vec![] } else { vec![m.data.to_vec()] }, "1 missing");
    check("more", &|n, m| vec![m.data.to_vec(); if n == 700 { 2 } else { 1 }], "1 extra");
}

/// Before 2021 CRTK's poses were transforms.
#[test]
fn poses_of_older_recordings_give_the_same_answers() {
    let folder = tempfile::tempdir().unwrap();
    let golden = golden(folder.path(), "press");
    let older = folder.path().join("older");
    let as_transform = |_: usize, message: &MessageRef<'_>, name: &str| {
        if name != "/measured_cp" {
            return vec![message.data.to_vec()];
        }
        let PoseStamped { header, pose } = decode(message.data).unwrap();
        let mut transform =
            TransformStamped { header, child_frame_id: "tip".to_owned(), ..Default::default() };
        let p = pose.position;
        (transform.transform.translation.x, transform.transform.translation.y) = (p.x, p.y);
        transform.transform.translation.z = p.z;
        transform.transform.rotation = pose.orientation;
        vec![encode(&transform)]
    };
    let retyped = |topic: &Topic| {
        let mut topic = topic.clone();
        if topic.name == "/measured_cp" {
            topic.name = "/PSM1/position_cartesian_current".to_owned();
            topic.type_name = "geometry_msgs/msg/TransformStamped".to_owned();
            topic.definition = own_definition(&topic.type_name).unwrap();
        }
        topic
    };
    changed(&bag("press"), &older, as_transform, retyped);
    let remap = "/PSM1/position_cartesian_current:=/measured_cp";
    let output = replay(older.to_str().unwrap(), &["--expect", &golden, "--remap", remap]);
    assert_eq!(code(&output), 0, "{}", said(&output));
}

#[test]
fn what_cannot_be_compared_is_exit_code_2_and_one_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let golden = golden(folder.path(), "press");
    let empty = folder.path().join("empty");
    Writer::create(&empty, "").unwrap().close().unwrap();
    let cases: [(&str, &[&str], &str); 7] = [
        ("tests/bags/nowhere", &[], "tests/bags/nowhere"),
        ("README.md", &[], "README.md"),
        (empty.to_str().unwrap(), &[], "no poses on /measured_cp"),
        ("tests/bags/two_devices", &[], "--namespace"),
        ("tests/bags/press", &["--remap", "/a:=/b"], "/a is not in the recording"),
        ("tests/bags/press", &["--expect", "tests/bags/nowhere"], "tests/bags/nowhere"),
        ("tests/bags/press", &["--record", &golden], "exists already"),
    ];
    for (recording, more, expected) in cases {
        let output = replay(recording, more);
        assert_eq!(code(&output), 2, "{recording} {more:?}: {}", said(&output));
        assert!(output.stdout.is_empty(), "{}", said(&output));
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(error.contains(expected) && error.trim_end().lines().count() == 1, "{error}");
    }
    // Nothing in common is no agreement.
    let output = replay(&bag("press"), &["--expect", "tests/bags/press"]);
    assert_ne!(code(&output), 0, "{}", said(&output));
    let output = replay(&bag("press"), &["--expect", &golden, "--tolerance", "servo_cf=x"]);
    assert_eq!(code(&output), 2, "{}", said(&output));
}

#[test]
fn a_recording_of_forces_only_asks_for_no_surface() {
    let output = replay(&bag("press"), &["--set", "surface.rate=0.0", "--json"]);
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&report["poses"], &report["surfaces"]), (&1500.into(), &0.into()));
}
