//! `rhombus device`, the real executable, against doubles that speak the real interfaces of the devices.
#![expect(clippy::expect_used, clippy::panic, reason = "a test may fail here")]

mod common;
#[path = "device/double.rs"]
mod double;

use common::{Folder, Run};
use double::Double;
use serde_json::Value;

/// A check that is short and asks for little: other tests share the machine.
const QUICK: &[&str] = &["--rate", "100", "--seconds", "0.5", "--json"];

/// The same at a rate at which no watchdog strikes.
const PUSH: &[&str] = &["--rate", "1000", "--seconds", "0.5", "--json", "--forces", "--yes"];

/// A check of a device: exit code and JSON, with nothing on stderr.
fn check(arguments: &[&str]) -> (i32, Value) {
    check_with(arguments, QUICK)
}

fn check_with(arguments: &[&str], more: &[&str]) -> (i32, Value) {
    let Run { code, stdout, stderr } = Folder::new().run(&[&["device", "check"], arguments, more].concat());
    assert_eq!(stderr, "", "{arguments:?}");
    (code, serde_json::from_str(&stdout).expect("JSON and nothing else"))
}

/// One line of it.
fn line<'a>(report: &'a Value, name: &str) -> &'a Value {
    let lines = report["findings"].as_array().expect("lines");
    lines.iter().find(|line| line["name"] == name).unwrap_or_else(|| panic!("no line {name}: {report}"))
}

fn text(value: &Value) -> &str {
    value.as_str().expect("text")
}

/// The only line of a check whose device did not open, with exit code 1: what was found, and the remedy.
fn not_opened(arguments: &[&str]) -> (String, String) {
    let (code, report) = check(arguments);
    assert_eq!((code, &report["device"], &report["ok"]), (1, &Value::Null, &Value::Bool(false)), "{report}");
    assert_eq!(report["findings"].as_array().map(Vec::len), Some(1), "{report}");
    let line = line(&report, "open");
    (text(&line["found"]).to_owned(), text(&line["remedy"]).to_owned())
}

/// What is asked of every device that is well.
fn is_well(code: i32, report: &Value) {
    for name in ["device", "limits", "watchdog", "numbers", "orientation", "homed", "workspace", "brakes"] {
        assert_eq!(line(report, name)["verdict"], "ok", "{name}: {report}");
    }
    nothing_fails(code, report);
}

/// Lines about how punctual this machine is: other tests have it at the same time.
const PUNCTUALITY: &[&str] = &["loop_rate", "lateness", "read_time", "command_time", "device_rate", "gaps"];

/// No line about the device is a failure, and the exit code is that of the lines.
fn nothing_fails(code: i32, report: &Value) {
    let lines = report["findings"].as_array().expect("lines");
    let failed: Vec<_> =
        lines.iter().filter(|line| line["verdict"] == "failure").map(|line| text(&line["name"])).collect();
    assert!(failed.iter().all(|name| PUNCTUALITY.contains(name)), "{failed:?}: {report}");
    let is_well = failed.is_empty();
    assert_eq!((code, &report["ok"]), (i32::from(!is_well), &Value::Bool(is_well)), "{report}");
}

#[test]
fn the_simulated_device_is_well_and_says_what_it_is() {
    let (code, report) = check(&["simulated"]);
    is_well(code, &report);
    assert_eq!(report["device"]["backend"], "simulated");
    assert_eq!(line(&report, "position_noise")["numbers"]["peak_to_peak_x_m"], 0.0);
    assert_eq!(line(&report, "limits")["numbers"]["max_force_n"], 20.0);
    assert!(report["findings"].as_array().expect("lines").iter().all(|line| line["name"] != "forces"));
}

#[test]
fn the_pointers_hand_is_there_without_a_pointer_and_is_listed_as_built_in() {
    let (code, report) = check(&["pointer"]);
    is_well(code, &report);
    assert_eq!(report["device"]["backend"], "pointer");
    let (code, report) = check_with(&["pointer"], PUSH);
    is_well(code, &report);
    assert_eq!(line(&report, "forces")["verdict"], "ok", "{report}");
    assert!(Folder::new().refusal(&["device", "check", "pointer:7"]).contains("no serial number"));
}

#[test]
fn as_text_each_line_has_its_verdict_and_each_warning_its_remedy() {
    let Run { code, stdout: text, .. } =
        Folder::new().run(&["device", "check", "simulated", "--rate", "100", "--seconds", "0.2"]);
    let mut lines = text.lines();
    let mut counts = [0, 0, 0];
    while let Some(line) = lines.next() {
        let verdicts = ["ok ", "warning ", "failure "];
        let Some(verdict) = verdicts.iter().position(|verdict| line.starts_with(verdict)) else {
            let [ok, warnings, failures] = counts;
            assert_eq!(line, format!("{ok} ok, warnings: {warnings}, failures: {failures}"), "{text}");
            continue;
        };
        counts[verdict] += 1;
        if verdict > 0 {
            assert!(lines.next().is_some_and(|next| next.trim_start().starts_with("-> ")), "{text}");
        }
    }
    assert_eq!(code, i32::from(counts[2] > 0), "{text}");
    assert!(counts[0] > 10, "{text}");
}

#[test]
fn forces_need_a_typed_word_and_without_it_nothing_is_opened() {
    let folder = Folder::new();
    // Stdin is empty.
    let refusal = folder.refusal(&["device", "check", "simulated", "--forces"]);
    assert!(refusal.contains("not confirmed") && refusal.contains("--yes"), "{refusal}");
    assert!(folder.refusal(&["device", "check", "simulated", "--yes"]).contains("--forces"));
}

#[test]
fn with_forces_the_simulated_hand_goes_where_it_is_pushed() {
    let (code, report) = check_with(&["simulated"], PUSH);
    is_well(code, &report);
    let forces = line(&report, "forces");
    assert_eq!(forces["verdict"], "ok", "{report}");
    for axis in ["along_x_m", "along_y_m", "along_z_m"] {
        // 0.5 N on a hand of 500 N/m is 1 mm at the most.
        let along = forces["numbers"][axis].as_f64().expect("a number");
        assert!((0.1e-3..1e-3).contains(&along), "{axis}: {along}");
    }
}

#[test]
fn a_command_line_that_is_not_accepted_is_exit_code_2_with_what_is() {
    let folder = Folder::new();
    let refused = |arguments: &[&str], with: &[&str]| {
        let refusal = folder.refusal(&[&["device", "check"], arguments].concat());
        assert!(with.iter().all(|word| refusal.contains(word)), "{refusal}");
    };
    refused(&["phantom"], &["\"phantom\"", "force_dimension", "spacemouse", "simulated"]);
    refused(&["simulated:7"], &["no serial number"]);
    refused(&["haply:A", "--serial", "B"], &["haply:A", "--serial B"]);
    refused(&["simulated", "--rate", "5000"], &["10 to 4000 Hz"]);
    refused(&["simulated", "--rate", "-1"], &["10 to 4000 Hz"]);
    refused(&["simulated", "--seconds", "0"], &["0.1 to 60 s"]);
    refused(&["simulated", "--seconds", "nan"], &["0.1 to 60 s"]);
    refused(&["serial", "--baud", "9600"], &["serial.baud", "57600"]);
    refused(&["haply", "--url", "http://localhost"], &["haply.url", "ws://HOST:PORT"]);
    refused(&["force_dimension:left"], &["device.serial", "left"]);
}

#[test]
fn a_self_built_device_is_well_and_its_motors_stay_off() {
    let double = Double::serial("--serial D7");
    let (code, report) = check(&["serial:D7", "--port", &double.port()]);
    is_well(code, &report);
    assert_eq!(report["device"]["serial"], "D7");
    assert!(
        report["findings"].as_array().expect("lines").iter().any(|line| line["name"] == "line"),
        "{report}"
    );
    double.motors_stayed_off();
}

#[test]
fn a_self_built_device_is_pushed_only_with_forces_and_never_by_more_than_half_a_newton() {
    let mut double = Double::serial("");
    let (mut code, mut report) = check_with(&["serial", "--port", &double.port()], PUSH);
    // On a busy machine the double may be kept from its line for 20 ms, and its watchdog strikes.
    for _ in 0..5 {
        if double.record().iter().all(|line| line.event != "watchdog") {
            break;
        }
        assert_eq!(line(&report, "forces")["verdict"], "failure", "{report}");
        double = Double::serial("");
        (code, report) = check_with(&["serial", "--port", &double.port()], PUSH);
    }
    is_well(code, &report);
    assert_eq!(line(&report, "forces")["verdict"], "ok", "{report}");
    let record = double.record();
    let largest_n = record.iter().map(|line| line.force_n).fold(0.0, f64::max);
    assert!((0.2..=0.5 + 1e-6).contains(&largest_n), "{largest_n}");
    assert_eq!(record.iter().filter(|line| line.event == "enable").count(), 1);
    double.motors_are_off();
}

#[test]
fn an_interrupted_check_switches_the_motors_off_and_says_so() {
    let double = Double::serial("");
    let folder = Folder::new();
    let mut check =
        folder.command(&[&["device", "check", "serial", "--port", &double.port()], PUSH].concat());
    let child = check.stdout(std::process::Stdio::piped()).spawn().expect("it starts");
    double.wait_for("enable");
    let kill = std::process::Command::new("kill").arg("-INT").arg(child.id().to_string()).status();
    assert!(kill.expect("kill runs").success());
    let output = child.wait_with_output().expect("it ends");
    let report: Value = serde_json::from_slice(&output.stdout).expect("JSON and nothing else");
    assert_eq!(output.status.code(), Some(1), "{report}");
    let all = report["findings"].as_array().expect("lines");
    let stopped = all.iter().any(|line| text(&line["found"]).starts_with("stopped with motors on"));
    let struck = all.iter().any(|line| text(&line["found"]).contains("switched its motors off"));
    assert!(stopped || struck, "{report}");
    double.motors_are_off();
}

#[test]
fn states_that_get_lost_on_the_way_are_counted_and_are_a_warning() {
    let double = Double::serial("--fault dropped");
    let (code, report) = check(&["serial", "--port", &double.port()]);
    nothing_fails(code, &report);
    let line = line(&report, "line");
    assert_eq!(line["verdict"], "warning", "{report}");
    // One in ten of 1000 a second, for half a second.
    let lost = line["numbers"]["lost_states"].as_f64().expect("a number");
    assert!((10.0..=100.0).contains(&lost) && !text(&line["remedy"]).is_empty(), "{line}");
}

#[test]
fn what_is_wrong_with_a_self_built_device_is_one_sentence_with_its_remedy() {
    for (options, baud, found, remedy) in [
        ("--fault garbage", "921600", "no valid frame", "serial.baud"),
        ("--fault silent", "921600", "no answer, 0 bytes", "power"),
        ("--fault zero-force", "921600", "maximum force is 0", "hello"),
        ("--fault nan-force", "921600", "maximum force is NaN", "hello"),
        ("--fault nan-position", "921600", "NaN", "states"),
        ("--fault old-protocol", "921600", "version 0", "same version"),
        ("--baud 921600", "115200", "no answer, 0 bytes", "serial.baud"),
    ] {
        let double = Double::serial(options);
        let (told, what_to_do) = not_opened(&["serial", "--port", &double.port(), "--baud", baud]);
        assert!(told.contains(found), "{options}: {told}");
        assert!(what_to_do.contains(remedy), "{options}: {what_to_do}");
        double.motors_stayed_off();
    }
}

#[test]
fn a_device_that_another_program_has_is_busy() {
    let double = Double::serial("");
    let holder = double.hold();
    let (told, remedy) = not_opened(&["serial", "--port", &double.port()]);
    assert!(told.contains("in use by another program"), "{told}");
    assert_eq!(remedy, "end that program, then try again");
    drop(holder);
}

#[test]
fn absent_devices_are_named_with_where_they_were_looked_for() {
    let (told, remedy) = not_opened(&["serial", "--port", "/nowhere/tty"]);
    assert!(
        told.contains("/nowhere/tty does not exist") && remedy.contains("serial.port"),
        "{told}; {remedy}"
    );
    let (told, remedy) = not_opened(&["haply", "--url", "ws://127.0.0.1:9"]);
    assert!(
        told.contains("ws://127.0.0.1:9") && remedy.contains("start the Haply service"),
        "{told}; {remedy}"
    );
    let (told, remedy) = not_opened(&["force_dimension", "--sdk", "/nowhere/sdk"]);
    assert!(told.contains("/nowhere/sdk") && remedy.contains("forcedimension.com"), "{told}; {remedy}");
    let (told, remedy) = not_opened(&["spacemouse:no-such"]);
    assert!(told.contains("no spacemouse device") && !remedy.is_empty(), "{told}; {remedy}");
}

#[test]
fn a_force_dimension_device_is_well_and_its_motors_stay_off() {
    let double = Double::force_dimension(&["--device", "omega.7-right:31"]);
    let (code, report) = check(&["force_dimension:31", "--sdk", &double.folder()]);
    is_well(code, &report);
    assert!(text(&report["device"]["firmware"]).contains("SDK 3."), "{report}");
    assert_eq!(line(&report, "gripper")["verdict"], "ok", "{report}");
    assert!(text(&line(&report, "watchdog")["found"]).contains("31.25 ms"), "{report}");
    double.motors_stayed_off();
}

#[test]
fn a_force_dimension_device_that_is_not_homed_is_a_warning_and_is_not_pushed() {
    let double = Double::force_dimension(&["--unhomed"]);
    let (code, report) = check_with(&["force_dimension", "--sdk", &double.folder()], PUSH);
    nothing_fails(code, &report);
    assert_eq!(line(&report, "homed")["verdict"], "warning", "{report}");
    assert!(text(&line(&report, "forces")["found"]).contains("not homed"), "{report}");
    double.motors_stayed_off();
}

#[test]
fn what_is_wrong_with_a_force_dimension_device_is_one_sentence_with_its_remedy() {
    for (options, found, remedy) in [
        (&["--refuse", "20"][..], "in use by another program", "end that program"),
        (&["--refuse", "4"][..], "permission denied", "udev"),
        (&["--max-force", "0"][..], "largest force is 0", "off and on again"),
        (&["--max-force", "nan"][..], "largest force is NaN", "off and on again"),
        (&["--sdk-version", "3.12.0.0"][..], "SDK 3.12.0.0", "3.16 or newer"),
        (
            &["--device", "omega.3:5", "--device", "omega.3:6"][..],
            "2 force_dimension devices",
            "force_dimension:5",
        ),
    ] {
        let double = Double::force_dimension(options);
        let (told, what_to_do) = not_opened(&["force_dimension", "--sdk", &double.folder()]);
        assert!(told.contains(found), "{options:?}: {told}");
        assert!(what_to_do.contains(remedy), "{options:?}: {what_to_do}");
    }
}

#[test]
fn an_inverse3_is_well_and_gets_no_force_but_zero() {
    let double = Double::haply(&["--devices", "049D", "--grips", "61C8"]);
    let (code, report) = check(&["haply:049D", "--url", double.ready()]);
    // The service's device enters force mode by a force of zero when it is opened: that is no push.
    is_well(code, &report);
    assert!(text(&line(&report, "buttons")["found"]).contains("pressed meanwhile: a, c"), "{report}");
    assert!(double.record().iter().all(|line| line.force_n == 0.0));
}

#[test]
fn an_inverse3_that_says_nonsense_is_one_sentence_with_its_remedy() {
    let none = Double::haply(&["--devices", ""]);
    let (told, remedy) = not_opened(&["haply", "--url", none.ready()]);
    assert!(told.contains("lists no Inverse3") && remedy.contains("connect the device"), "{told}; {remedy}");
    let two = Double::haply(&["--devices", "049D,0BAD"]);
    let (told, remedy) = not_opened(&["haply", "--url", two.ready()]);
    assert!(told.contains("049D, 0BAD") && remedy.contains("haply:049D"), "{told}; {remedy}");
}

#[test]
fn list_tells_what_is_there_what_is_not_and_why_and_is_1_when_there_is_nothing() {
    let folder = Folder::new();
    let list = |more: &[&str]| {
        let nowhere = ["device", "list", "--json", "--url", "ws://127.0.0.1:9"];
        let Run { code, stdout, stderr } = folder.run(&[&nowhere[..], more].concat());
        assert_eq!(stderr, "");
        (code, serde_json::from_str::<Value>(&stdout).expect("JSON and nothing else"))
    };
    let of = |listing: &Value, backend: &str| {
        let all = listing["backends"].as_array().expect("backends").clone();
        all.into_iter().find(|answer| answer["backend"] == backend).expect("each backend is asked")
    };
    let serial = Double::serial("--serial D9");
    let (code, listing) = list(&["--port", &serial.port(), "--sdk", "/nowhere/sdk"]);
    assert_eq!(code, 0, "{listing}");
    assert_eq!(of(&listing, "serial")["devices"][0]["name"], "serial:D9", "{listing}");
    assert!(
        text(&of(&listing, "force_dimension")["problems"][0]["problem"]).contains("/nowhere/sdk"),
        "{listing}"
    );
    assert!(
        text(&of(&listing, "force_dimension")["problems"][0]["remedy"]).contains("forcedimension.com"),
        "{listing}"
    );
    assert!(
        text(&of(&listing, "haply")["problems"][0]["problem"]).contains("no service listens"),
        "{listing}"
    );
    assert!(listing["device_files"].is_array() && listing["udev_rules"].is_object());
    serial.motors_stayed_off();

    let empty = Double::serial("--fault silent");
    let (code, listing) = list(&["--port", &empty.port(), "--sdk", "/nowhere/sdk"]);
    let is_nothing = |answer: &Value| answer["devices"].as_array().is_some_and(Vec::is_empty);
    // A machine with a device of its own at hand lists that.
    let nothing = listing["backends"].as_array().expect("backends").iter().all(is_nothing);
    assert_eq!(code, i32::from(nothing), "{listing}");
    let why = &of(&listing, "serial")["problems"][0];
    assert!(text(&why["problem"]).contains(&empty.port()) && !text(&why["remedy"]).is_empty(), "{listing}");
}
