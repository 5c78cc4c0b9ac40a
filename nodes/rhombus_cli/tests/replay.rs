//! `rhombus replay` as an integrator's CI uses it: the same recording, the same bits, and what differs is found.
#![expect(clippy::unwrap_used, reason = "a test may fail here")]

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use recording::cdr::{decode, encode};
use recording::messages::{PoseStamped, Time, TransformStamped, Vector3, WrenchStamped, own_definition};
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

/// The one committed hash: today, on every machine, with debug assertions and without.
#[test]
fn every_recording_is_answered_with_the_committed_bits() {
    let committed = std::fs::read_to_string(repository().join("tests/bags/sha256.txt")).unwrap();
    let rows: Vec<Vec<&str>> = committed
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| line.split_whitespace().collect())
        .collect();
    assert_eq!(rows.len(), 8);
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

/// Programs that keep a core busy for ever, ended with this value.
struct Busy(Vec<Child>);

impl Drop for Busy {
    fn drop(&mut self) {
        for program in &mut self.0 {
            // Whoever is gone already is gone.
            let _ = program.kill();
            let _ = program.wait();
        }
    }
}

/// Whatever runs beside it, and on however many cores.
#[test]
fn one_core_and_two_under_load_give_the_same_bits() {
    let busy =
        || Command::new("sh").args(["-c", "while :; do :; done"]).stdout(Stdio::null()).spawn().unwrap();
    let _busy = Busy((0..2).map(|_| busy()).collect());
    let committed = std::fs::read_to_string(repository().join("tests/bags/sha256.txt")).unwrap();
    let allowed = std::fs::read_to_string("/proc/self/status").unwrap();
    let allowed = allowed.lines().find_map(|line| line.strip_prefix("Cpus_allowed_list:")).unwrap().trim();
    let first = allowed.split(['-', ',']).next().unwrap();
    for cores in [first, allowed] {
        let output = Command::new("taskset")
            .args(["--cpu-list", cores, env!("CARGO_BIN_EXE_rhombus"), "replay", "tests/bags/grasp_and_pull"])
            .args(["--params", "config/liver.yaml", "--json"])
            .current_dir(repository())
            .output()
            .unwrap();
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let digest = report["sha256"].as_str().unwrap();
        assert!(
            committed.contains(&format!("grasp_and_pull config/liver.yaml {digest}")),
            "cores {cores}: {digest}"
        );
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
    check("more", &|n, m| vec![m.data.to_vec(); if n == 700 { 2 } else { 1 }], "1 too many");
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

/// As rmw_fastrtps leaves them behind the last field when a program serializes without sending.
#[test]
fn bytes_behind_the_last_field_of_a_message_change_no_answer() {
    let folder = tempfile::tempdir().unwrap();
    let golden = golden(folder.path(), "grasp_and_pull");
    let longer = folder.path().join("longer");
    let with_rest = |number: usize, message: &MessageRef<'_>, _: &str| {
        let rest: &[u8] = if number.is_multiple_of(2) { &[0; 8] } else { &[0xa5; 4] };
        vec![[message.data, rest].concat()]
    };
    changed(&bag("grasp_and_pull"), &longer, with_rest, Topic::clone);
    let output = replay(longer.to_str().unwrap(), &["--expect", &golden]);
    assert_eq!(code(&output), 0, "{}", said(&output));
}

#[test]
fn what_cannot_be_compared_is_exit_code_2_and_one_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let golden = golden(folder.path(), "press");
    let empty = folder.path().join("empty");
    Writer::create(&empty, "").unwrap().close().unwrap();
    let day = folder.path().join("day");
    std::fs::create_dir(&day).unwrap();
    for name in ["press", "slide"] {
        let file = format!("{name}_0.mcap");
        std::fs::copy(repository().join(bag(name)).join(&file), day.join(&file)).unwrap();
    }
    let two = |left: &'static str, right: &'static str| ["--remap", left, "--remap", right];
    let merged = two("/left/measured_cp:=/measured_cp", "/right/measured_cp:=/measured_cp");
    let twice = two("/left/measured_cp:=/measured_cp", "/left/measured_cp:=/other");
    let swallowed = ["--remap", "/left/measured_cp:=/right/measured_cp"];
    let cases: [(&str, &[&str], &str); 11] = [
        (day.to_str().unwrap(), &[], "several recordings"),
        (
            "tests/bags/two_devices",
            &merged,
            "/left/measured_cp and /right/measured_cp would both be /measured_cp",
        ),
        ("tests/bags/two_devices", &twice, "/left/measured_cp is given two names, /measured_cp and /other"),
        ("tests/bags/two_devices", &swallowed, "/left/measured_cp and /right/measured_cp would both be"),
        ("tests/bags/nowhere", &[], "tests/bags/nowhere"),
        ("README.md", &[], "README.md"),
        (empty.to_str().unwrap(), &[], "no poses on /measured_cp"),
        ("tests/bags/two_devices", &[], "--namespace"),
        ("tests/bags/press", &["--remap", "/a:=/b"], "/a is not among the topics /measured_cp"),
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

/// Poses of which none can be decoded: the replay finds that out at its end.
fn without_poses(folder: &Path) -> String {
    let path = folder.join("without_poses");
    changed(&bag("press"), &path, |_, message, _| vec![message.data[..8].to_vec()], Topic::clone);
    path.to_str().unwrap().to_owned()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_replay_that_fails_leaves_no_recording_and_the_next_one_is_not_in_its_way() {
    let folder = tempfile::tempdir().unwrap();
    let broken = without_poses(folder.path());
    let new = folder.path().join("new").to_str().unwrap().to_owned();
    let output = replay(&broken, &["--record", &new]);
    assert_eq!(code(&output), 2, "{}", said(&output));
    assert!(said(&output).contains("no pose could be read"), "{}", said(&output));
    assert_eq!(names(folder.path()), ["without_poses"]);

    // As on a full disk: files cannot grow beyond this.
    let script = format!(
        "trap '' XFSZ; exec prlimit --fsize=100000 {} replay {} --params config/liver.yaml --record {new}",
        env!("CARGO_BIN_EXE_rhombus"),
        bag("press"),
    );
    let output = Command::new("sh").args(["-c", &script]).current_dir(repository()).output().unwrap();
    assert_eq!(code(&output), 2, "{}", said(&output));
    assert_eq!(names(folder.path()), ["without_poses"]);

    let output = replay(&bag("press"), &["--record", &new]);
    assert_eq!(code(&output), 0, "{}", said(&output));
    assert_eq!(names(folder.path()), ["new", "without_poses"]);
    assert_eq!(names(Path::new(&new)), ["metadata.yaml", "new_0.mcap"]);
    // Directories above it are made, as before.
    let deep = folder.path().join("a/b/new");
    let output = replay(&bag("press"), &["--record", deep.to_str().unwrap()]);
    assert_eq!(code(&output), 0, "{}", said(&output));
    assert_eq!(names(&folder.path().join("a/b")), ["new"]);
}

/// A CI shows the files that it finds: those of the run before would say that all is well.
#[test]
fn where_nothing_could_be_compared_the_reports_say_so_and_no_older_ones_stay() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let reports = ["r.xml", "r.md", "r.svg"].map(path);
    let written = ["--junit", &reports[0], "--markdown", &reports[1], "--plot", &reports[2]];
    let broken = without_poses(folder.path());
    let golden = golden(folder.path(), "press");
    let press = bag("press");
    let cases: [(&str, &[&str], &str); 5] = [
        (&press, &["--expect", "tests/bags/nowhere"], "tests/bags/nowhere"),
        ("tests/bags/elsewhere", &["--expect", &golden], "tests/bags/elsewhere"),
        (&press, &["--expect", &golden, "--set", "nonsense=1"], "nonsense"),
        (&press, &["--expect", &golden, "--tolerance", "servo_cf=x"], "servo_cf"),
        (&broken, &["--expect", &golden], "no pose could be read"),
    ];
    for (recording, more, reason) in cases {
        for path in &reports {
            std::fs::write(path, "all is well").unwrap();
        }
        let output = replay(recording, &[more, &written].concat());
        assert_eq!(code(&output), 2, "{more:?}: {}", said(&output));
        let [junit, markdown, plot] = reports.each_ref().map(|path| std::fs::read_to_string(path).unwrap());
        assert!(junit.contains("tests=\"1\" failures=\"0\" errors=\"1\""), "{junit}");
        assert!(junit.contains("<error message=") && junit.contains(reason), "{junit}");
        assert!(markdown.contains("## Replay: not compared"), "{markdown}");
        assert!(markdown.replace('\\', "").contains(reason), "{markdown}");
        assert!(plot.contains("<svg") && !plot.contains("all is well"), "{plot}");
    }
    // Nor where the replay is killed, as by the time limit of a CI job: here while it waits for its parameters.
    for path in &reports {
        std::fs::write(path, "all is well").unwrap();
    }
    let pipe = path("params.yaml");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let arguments = [&["replay", &press, "--params", &pipe, "--expect", &golden][..], &written].concat();
    let mut command = Command::new(env!("CARGO_BIN_EXE_rhombus"));
    command.args(arguments).current_dir(repository()).stderr(Stdio::null());
    let child = Busy(vec![command.spawn().unwrap()]);
    let is_stale = |path: &String| std::fs::read_to_string(path).unwrap().contains("all is well");
    let end = Instant::now() + Duration::from_secs(20);
    while reports.iter().any(is_stale) && Instant::now() < end {
        std::thread::sleep(Duration::from_millis(20));
    }
    drop(child);
    assert!(!reports.iter().any(is_stale));
}

/// The forces of a recording in their order, with their stamps.
fn forces(path: &Path) -> Vec<(Time, Vector3)> {
    let recording = Recording::open(path).unwrap();
    let place = recording.topics().iter().position(|found| found.topic.name == "/servo_cf").unwrap();
    let messages =
        recording.messages_of(&[place]).map(|message| decode::<WrenchStamped>(&message.unwrap().data));
    messages.map(|force| force.unwrap()).map(|force| (force.header.stamp, force.wrench.force)).collect()
}

/// Replays the recording `press` with the poses changed; the report, the poses' stamps and the forces.
fn with_poses(
    change: impl Fn(usize, &mut PoseStamped),
) -> (serde_json::Value, Vec<Time>, Vec<(Time, Vector3)>) {
    let folder = tempfile::tempdir().unwrap();
    let (path, golden) = (folder.path().join("changed"), folder.path().join("golden"));
    let stamps = std::cell::RefCell::new(Vec::new());
    let changed_pose = |number: usize, message: &MessageRef<'_>, _: &str| {
        let mut pose: PoseStamped = decode(message.data).unwrap();
        change(number, &mut pose);
        stamps.borrow_mut().push(pose.header.stamp.clone());
        vec![encode(&pose)]
    };
    changed(&bag("press"), &path, changed_pose, Topic::clone);
    let (path, golden) = (path.to_str().unwrap(), golden.to_str().unwrap());
    let output = replay(path, &["--record", golden, "--json"]);
    assert_eq!(code(&output), 0, "{}", said(&output));
    let again = replay(path, &["--expect", golden]);
    assert_eq!(code(&again), 0, "{}", said(&again));
    let report = serde_json::from_slice(&output.stdout).unwrap();
    (report, stamps.into_inner(), forces(Path::new(golden)))
}

const NO_FORCE: Vector3 = Vector3 { x: 0.0, y: 0.0, z: 0.0 };

#[test]
fn poses_that_are_none_are_answered_with_no_force_and_cost_no_other() {
    let (report, stamps, forces) = with_poses(|number, pose| {
        let at = &mut pose.pose.position;
        match number {
            400 => at.x = f64::NAN,
            401 => at.y = f64::INFINITY,
            402 => at.z = 1e308,
            403 => pose.pose.orientation.w = f64::NAN,
            404 => pose.pose.orientation.w = 0.0,
            _ => {}
        }
    });
    // Not finite, no rotation, out of reach.
    assert_eq!((&report["poses"], &report["rejected"]), (&1500.into(), &serde_json::json!([3, 1, 0, 0, 1])));
    assert_eq!(forces.iter().map(|(stamp, _)| stamp.clone()).collect::<Vec<_>>(), stamps, "each is answered");
    assert!(forces[400..405].iter().all(|(_, force)| *force == NO_FORCE));
    assert!(forces[399].1 != NO_FORCE && forces[410].1 != NO_FORCE, "in contact before and behind");
}

#[test]
fn stamps_that_repeat_go_back_or_are_zero_are_each_answered_and_a_pose_behind_goes_on() {
    let (report, stamps, forces) = with_poses(|number, pose| match number {
        350 => pose.header.stamp.nanosec -= 1_000_000,
        400 => pose.header.stamp.nanosec -= 50_000_000,
        450 => pose.header.stamp = Time::default(),
        _ => {}
    });
    assert_eq!(report["poses"], 1500, "{report}");
    assert_eq!(report["rejected"][3], 2, "{report}");
    assert_eq!(forces.iter().map(|(stamp, _)| stamp.clone()).collect::<Vec<_>>(), stamps, "each is answered");
    assert!(forces[350].1 != NO_FORCE, "a stamp that repeats is no step back");
    assert!(forces[400].1 == NO_FORCE && forces[450].1 == NO_FORCE);
    assert!(forces[420].1 != NO_FORCE && forces[470].1 != NO_FORCE, "contact comes back");
}

#[test]
fn stamps_that_all_go_back_give_no_force_and_surfaces_at_their_rate() {
    let (report, _, forces) = with_poses(|number, pose| {
        let ns = 1_500_000_000 - number as u32 * 1_000_000;
        pose.header.stamp =
            Time { sec: 1_700_000_000 + (ns / 1_000_000_000) as i32, nanosec: ns % 1_000_000_000 };
    });
    assert_eq!(report["rejected"][3], 1499, "{report}");
    assert!(forces.iter().skip(1).all(|(_, force)| *force == NO_FORCE));
    let surfaces = report["surfaces"].as_u64().unwrap();
    assert!((85..=95).contains(&surfaces), "60 Hz over 1.5 s, not one for each pose: {surfaces}");
}

/// Copies a recording and flips a bit of the message data in the middle of its file.
fn flipped(from: &Path, to: &Path) {
    std::fs::create_dir(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let mut bytes = std::fs::read(&path).unwrap();
        if path.extension().is_some_and(|extension| extension == "mcap") {
            let middle = bytes.len() / 2;
            bytes[middle] ^= 1;
        }
        std::fs::write(to.join(path.file_name().unwrap()), bytes).unwrap();
    }
}

#[test]
fn what_cannot_be_read_on_either_side_is_no_agreement() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let whole = golden(folder.path(), "press");
    flipped(&repository().join("tests/bags/press"), Path::new(&path("press")));
    flipped(Path::new(&whole), Path::new(&path("golden")));
    // What the rest of the broken recording is answered with.
    let output = replay(&path("press"), &["--record", &path("of_the_rest")]);
    assert_eq!(code(&output), 0, "{}", said(&output));
    assert!(said(&output).contains("place of the recording could not be read"), "{}", said(&output));
    for (recording, expected, words) in [
        (path("press"), path("of_the_rest"), "could not be read"),
        (path("press"), whole, "could not be read"),
        (bag("press"), path("golden"), "the golden recording is damaged"),
    ] {
        let reports = ["r.xml", "r.md"].map(path);
        let more = ["--expect", &expected, "--junit", &reports[0], "--markdown", &reports[1]];
        let output = replay(&recording, &more);
        assert_eq!(code(&output), 2, "{}", said(&output));
        let text = said(&output);
        assert!(text.contains("not compared with") && text.contains(words), "{text}");
        let [junit, markdown] = reports.map(|path| std::fs::read_to_string(path).unwrap());
        assert!(junit.contains("<error message=") && !junit.contains("errors=\"0\""), "{junit}");
        assert!(markdown.contains("## Replay: not compared"), "{markdown}");
        let output = replay(&recording, &["--expect", &expected, "--json"]);
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!((code(&output), &report["comparison"]["verdict"]), (2, &"not compared".into()));
        let reason = report["comparison"]["reason"].as_str().unwrap();
        assert!(reason.contains(words), "{reason}");
    }
}
