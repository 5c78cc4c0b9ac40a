//! What opening finds, and what it says when it does not open.

use std::time::Duration;

use devices::serial::{Settings, list, open};
use devices::{Device, DeviceError};

use crate::double::{Double, settings};

fn refusal(options: &str) -> DeviceError {
    match Double::start(options).open() {
        Ok(_) => panic!("{options} was opened"),
        Err(error) => error,
    }
}

/// What a device that answers wrongly is refused with.
fn protocol(options: &str) -> String {
    match refusal(options) {
        error @ DeviceError::Protocol { .. } => error.to_string(),
        error => panic!("{options}: {error}"),
    }
}

fn assert_says(error: &str, parts: &[&str]) {
    for part in parts {
        assert!(error.contains(part), "{error:?} does not say {part:?}");
    }
}

#[test]
fn an_open_device_is_the_one_that_said_hello() {
    let double = Double::start("--serial A7 --joints 3 --rate 500");
    let device = double.open().unwrap();
    let description = device.description();
    assert_eq!(description.backend, "serial");
    assert_eq!((description.model.as_str(), description.serial.as_str()), ("Double delta", "A7"));
    assert_eq!(description.firmware, "1.0.0");
    assert_eq!(description.limits.max_force_n, Some(20.0));
    assert!((description.limits.max_torque_n_m.unwrap() - 0.4).abs() < 1e-6);
    assert_eq!(description.limits.max_gripper_force_n, Some(8.0));
    assert!((description.limits.workspace.radius_m - 0.18).abs() < 1e-6);
    assert_eq!(description.buttons, ["button1", "button2"]);
    assert_eq!(description.joints, ["joint1", "joint2", "joint3"]);
    assert!(description.has_gripper && !description.needs_homing);
    assert_eq!(description.watchdog, Some(Duration::from_millis(20)));
    assert_eq!(device.state_rate_hz(), 500);
}

#[test]
fn one_of_two_is_chosen_by_its_serial_number_and_never_by_chance() {
    let (one, two) = (Double::start("--serial LEFT"), Double::start("--serial RIGHT"));
    std::os::unix::fs::symlink(two.port(), one.ports().join("other")).unwrap();
    let both = settings(&one.ports());
    let with_serial = |serial: &str| open(Settings { serial: serial.to_owned(), ..both.clone() });

    let serial = |device: &dyn Device| device.description().serial.clone();
    assert_eq!(serial(&with_serial("RIGHT").unwrap()), "RIGHT");
    assert_eq!(serial(&with_serial("LEFT").unwrap()), "LEFT");
    match open(both.clone()) {
        Err(DeviceError::Ambiguous { found, .. }) => assert_eq!(found, ["LEFT", "RIGHT"]),
        other => panic!("{:?}", other.err()),
    }
    let Err(none) = with_serial("THIRD") else { panic!() };
    assert_says(&none.to_string(), &["THIRD", "LEFT at ", "RIGHT at ", "device.serial"]);

    let mut serials: Vec<String> = list(&both).unwrap().found.into_iter().map(|found| found.serial).collect();
    serials.sort();
    assert_eq!(serials, ["LEFT", "RIGHT"]);
}

#[test]
fn two_with_the_same_serial_number_are_told_apart_by_their_ports() {
    let (one, two) = (Double::start(""), Double::start(""));
    std::os::unix::fs::symlink(two.port(), one.ports().join("other")).unwrap();
    let Err(error) = open(settings(&one.ports())) else { panic!() };
    assert_says(
        &error.to_string(),
        &["serial.port", "ports/device", "ports/other", "do not tell them apart"],
    );
}

#[test]
fn a_port_that_is_in_use_is_busy_until_it_is_not() {
    let double = Double::start("");
    let first = double.open().unwrap();
    assert!(matches!(double.open(), Err(DeviceError::Busy { .. })));
    let listed = list(&double.settings()).unwrap();
    assert!(
        listed.found.is_empty() && matches!(listed.problems[..], [DeviceError::Busy { .. }]),
        "{listed:?}"
    );
    drop(first);
    assert!(double.open().is_ok());
}

#[test]
fn a_device_that_is_found_does_not_hide_ports_that_are_in_use_or_answer_garbage() {
    let (free, used) = (Double::start("--serial FREE"), Double::start("--serial USED"));
    let garbage = Double::start("--fault garbage");
    for (name, other) in [("used", &used), ("garbage", &garbage)] {
        std::os::unix::fs::symlink(other.port(), free.ports().join(name)).unwrap();
    }
    let _used = used.open().unwrap();
    let listed = list(&settings(&free.ports())).unwrap();
    let [found] = &listed.found[..] else { panic!("{listed:?}") };
    assert_eq!(found.serial, "FREE");
    let said: Vec<String> = listed.problems.iter().map(ToString::to_string).collect();
    assert_eq!(said.len(), 2, "{said:?}");
    assert!(said.iter().any(|text| text.contains("in use")), "{said:?}");
    assert!(said.iter().any(|text| text.contains("garbage")), "{said:?}");
}

#[test]
fn a_port_that_is_not_there_or_is_no_port_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let missing = settings(&folder.path().join("ttyUSB7"));
    match open(missing.clone()) {
        Err(error @ DeviceError::NotFound { .. }) => {
            assert_says(&error.to_string(), &["ttyUSB7 does not exist", "plug the device in"]);
        }
        other => panic!("{:?}", other.err()),
    }
    let Err(error) = open(settings(folder.path())) else { panic!() };
    assert_says(&error.to_string(), &["is an empty folder"]);
    let file = folder.path().join("file");
    std::fs::write(&file, "no port").unwrap();
    let Err(error) = open(settings(&file)) else { panic!() };
    assert_says(&error.to_string(), &["does not open as a serial port"]);
    let Err(error) = open(Settings { baud: 9600, ..missing }) else { panic!() };
    assert_says(&error.to_string(), &["serial.baud = 9600", "57600 to 12000000"]);
}

#[test]
fn a_device_at_another_rate_is_a_baud_mismatch() {
    let double = Double::start("--baud 115200");
    let at = |baud| open(Settings { baud, ..double.settings() }).map(|_| ());
    // It does not understand the question.
    assert_says(&at(921_600).unwrap_err().to_string(), &["no answer, 0 bytes within 3 s", "serial.baud"]);
    assert_eq!(at(115_200), Ok(()));
    // It is still sending states to whoever was there before.
    assert_says(
        &at(921_600).unwrap_err().to_string(),
        &[" bytes within 3 s", "baud mismatch", "serial.baud"],
    );
}

#[test]
fn noise_half_frames_and_silence_are_told_apart_by_what_came() {
    assert_says(&protocol("--fault garbage"), &[" bytes within 3 s", "baud mismatch", "serial.baud"]);
    assert_says(
        &protocol("--fault half-frames"),
        &["no valid frame", "broken ones", "bytes lost on the way"],
    );
    assert_says(&protocol("--fault silent"), &["no answer, 0 bytes within 3 s", "power, cable, firmware"]);
    assert_says(&protocol("--fault no-hello"), &["valid frames", "no hello"]);
    assert_says(&protocol("--fault no-states"), &["said hello, but sent no state within 500 ms"]);
}

#[test]
fn another_version_of_the_protocol_is_refused() {
    assert_says(&protocol("--fault old-protocol"), &["speaks version 0", "this program 1", "same version"]);
}

#[test]
fn limits_that_are_none_are_refused() {
    assert_says(&protocol("--fault zero-force"), &["its maximum force is 0 N"]);
    assert_says(&protocol("--fault nan-force"), &["its maximum force is NaN N"]);
    assert_says(&protocol("--fault zero-workspace"), &["its workspace radius is 0 m"]);
    assert_says(&protocol("--fault no-watchdog"), &["its watchdog is 0 ms", "1 to 50 ms"]);
    assert_says(&protocol("--fault no-text"), &["serial number", "printable ASCII"]);
    assert_says(&protocol("--joints 9"), &["it has 9 joints", "at most 8"]);
}

#[test]
fn states_that_are_none_are_refused() {
    assert_says(&protocol("--fault zero-quaternion"), &["no unit quaternion"]);
    assert_says(&protocol("--fault nan-position"), &["a NaN or an infinity"]);
    assert_says(&protocol("--fault other-joints"), &["another number of joints"]);
}

#[test]
fn a_device_that_is_started_after_the_hello_began_is_still_found() {
    let double = Double::start("");
    double.signal("STOP");
    let settings = double.settings();
    let opening = std::thread::Builder::new().spawn(move || open(settings).map(|_| ())).unwrap();
    std::thread::sleep(Duration::from_millis(500));
    double.signal("CONT");
    assert_eq!(opening.join().unwrap(), Ok(()));
}
