//! What is opened, and every reason not to.

use std::process::Command;
use std::time::Duration;

use devices::force_dimension::{Settings, WATCHDOG, list, open};
use devices::{Device, DeviceError};
use glam::DVec3;

use crate::double::Double;

#[test]
fn every_family_says_its_name_its_limits_and_what_it_has() {
    // Name of the double's, model, force, torque, gripper force, whether it has a gripper.
    let families = [
        ("delta.3", "delta.3", 20.0, None, None, false),
        ("omega.3", "omega.3", 12.0, None, None, false),
        ("omega.6-right", "omega.6 right", 12.0, None, None, false),
        ("omega.6-left", "omega.6 left", 12.0, None, None, false),
        ("omega.7-right", "omega.7 right", 12.0, None, Some(8.0), true),
        ("omega.7-left", "omega.7 left", 12.0, None, Some(8.0), true),
        ("sigma.3", "sigma.3", 12.0, None, None, false),
        ("sigma.7-right", "sigma.7 right", 12.0, Some(0.2), Some(8.0), true),
        ("sigma.7-left", "sigma.7 left", 12.0, Some(0.2), Some(8.0), true),
        ("lambda.3", "lambda.3", 12.0, None, None, false),
        ("lambda.6-right", "lambda.6 right", 12.0, Some(0.2), None, false),
        ("lambda.6-left", "lambda.6 left", 12.0, Some(0.2), None, false),
        ("lambda.7-right", "lambda.7 right", 12.0, Some(0.2), Some(8.0), true),
        ("lambda.7-left", "lambda.7 left", 12.0, Some(0.2), Some(8.0), true),
        ("falcon", "Falcon", 8.0, None, None, false),
    ];
    for (name, model, force, torque, grip, has_gripper) in families {
        let double = Double::start(&["--device", &format!("{name}:11311")]);
        let mut device = double.open();
        let description = device.description().clone();
        assert_eq!((description.model.as_str(), description.serial.as_str()), (model, "11311"));
        assert_eq!(description.limits.max_force_n, Some(force), "{name}");
        assert_eq!(description.limits.max_torque_n_m, torque, "{name}");
        assert_eq!(description.limits.max_gripper_force_n, grip, "{name}");
        assert_eq!(description.has_gripper, has_gripper, "{name}");
        assert_eq!(description.buttons.len(), if name == "falcon" { 4 } else { 1 });
        assert_eq!(description.watchdog, Some(WATCHDOG));
        assert!(description.firmware.contains("controller 3.2, SDK 3.17.5.0"), "{}", description.firmware);
        let state = device.read().unwrap();
        assert_eq!(state.gripper_rad, has_gripper.then_some(0.3), "{name}");
    }
}

#[test]
fn a_wrist_gives_the_orientation_that_its_frame_says() {
    let double =
        Double::start(&["--device", "sigma.7-right", "--from", "0.01,0.02,-0.03", "--to", "0.01,0.02,-0.03"]);
    let pose = double.open().read().unwrap().pose;
    assert!(pose.translation.abs_diff_eq(DVec3::new(0.01, 0.02, -0.03), 1e-6), "{pose:?}");
    assert!((pose.rotation * DVec3::X).abs_diff_eq(DVec3::Y, 1e-12), "{pose:?}");
}

#[test]
fn a_dropped_generation_and_a_bare_controller_are_refused_in_a_sentence() {
    for (number, word) in
        [("61", "dropped"), ("64", "dropped"), ("82", "controller"), ("7", "not a known device")]
    {
        let double = Double::start(&["--device", number]);
        let (error, text) = double.refusal();
        assert!(matches!(error, DeviceError::Protocol { .. }) && text.contains(word), "{text}");
        assert!(list(&double.settings("")).unwrap()[0].what.contains(word));
    }
}

#[test]
fn of_two_devices_one_is_chosen_by_its_serial_number_and_none_without() {
    let double = Double::start(&["--device", "omega.3:501", "--device", "omega.7-left:502"]);
    let (error, text) = double.refusal();
    let expected =
        DeviceError::Ambiguous { device: "force_dimension", found: vec!["501".into(), "502".into()] };
    assert_eq!(error, expected, "{text}");

    let left = open(double.settings("502")).unwrap();
    let right = open(double.settings(" 501 ")).unwrap();
    assert_eq!(left.description().model, "omega.7 left");
    assert_eq!(right.description().model, "omega.3");

    let text = open(double.settings("503")).err().unwrap().to_string();
    assert!(text.contains("503") && text.contains("501, 502"), "{text}");
}

#[test]
fn an_empty_bus_says_what_to_do() {
    let mut double = Double::start(&[]);
    double.tell("0 unplug");
    let (error, text) = double.refusal();
    assert!(matches!(error, DeviceError::NotFound { .. }), "{text}");
    assert!(text.contains("SDK 3.17.5.0") && text.contains("power"), "{text}");
    assert_eq!(list(&double.settings("")), Ok(Vec::new()));
}

#[test]
fn a_device_that_this_program_has_open_is_in_use_until_it_is_dropped() {
    let double = Double::start(&["--device", "omega.3:501"]);
    let mut first = double.open();
    for serial in ["", "501"] {
        assert!(matches!(open(double.settings(serial)), Err(DeviceError::Busy { .. })));
    }
    let found = list(&double.settings("")).unwrap();
    assert_eq!(found[0].what, "omega.3, open in this program");
    first.read().expect("neither has closed it");
    drop(first);
    double.open();
}

#[test]
fn a_device_of_another_program_is_in_use() {
    // As the SDK may say it: in use, busy, or only that fewer are available than there are.
    for code in ["20", "3", "6"] {
        let double = Double::start(&["--device", "omega.3:501", "--refuse", code]);
        let (error, text) = double.refusal();
        assert!(matches!(error, DeviceError::Busy { .. }), "{text}");
        assert!(list(&double.settings("")).unwrap()[0].what.contains("in use by another program"));
    }
}

#[test]
fn a_device_in_use_beside_a_free_one_keeps_nobody_from_the_free_one() {
    let double = Double::start(&["--device", "omega.3:501", "--refuse", "20", "--device", "omega.3:502"]);
    assert_eq!(open(double.settings("502")).unwrap().description().serial, "502");
    assert!(matches!(open(double.settings("501")), Err(DeviceError::Busy { .. })));
}

#[test]
fn a_device_that_may_not_be_opened_names_the_udev_rules() {
    let double = Double::start(&["--refuse", "4"]);
    let (error, text) = double.refusal();
    assert!(matches!(error, DeviceError::Permission { .. }), "{text}");
    assert!(text.contains("70-rhombus-haptics.rules"), "{text}");
}

#[test]
fn an_sdk_of_a_version_that_is_not_known_is_refused_by_its_number() {
    for version in ["3.9.2.0", "3.15.9.9", "2.6.0.1", "4.0.0.0"] {
        let double = Double::start(&["--sdk-version", version]);
        let (error, text) = double.refusal();
        assert!(matches!(error, DeviceError::Library { .. }), "{text}");
        for part in [version, "3.16", "libdrd.so.3", "forcedimension.com"] {
            assert!(text.contains(part), "{part} in {text}");
        }
    }
    Double::start(&["--sdk-version", "3.16.0.0"]).open();
}

#[test]
fn a_library_without_the_sdks_functions_names_the_first_that_it_lacks() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("empty.c"), "int nothing_of_an_sdk;\n").unwrap();
    let built = Command::new("cc")
        .current_dir(folder.path())
        .args(["-shared", "-o", "libdrd.so.3", "empty.c"])
        .status()
        .unwrap();
    assert!(built.success());
    let settings = Settings { serial: String::new(), sdk: folder.path().to_path_buf(), period_s: 1e-3 };
    let error = open(settings).err().unwrap();
    let text = error.to_string();
    assert!(matches!(error, DeviceError::Library { .. }), "{text}");
    assert!(text.contains("libdrd.so.3 has no function dhdGetSDKVersion"), "{text}");
}

#[test]
fn libdhd_alone_drives_but_does_not_home() {
    let double = Double::start(&["--only-dhd", "--unhomed"]);
    let mut device = double.open();
    assert!(!device.read().unwrap().homed, "the status numbers say it");
    let error = device.home().unwrap_err();
    assert!(matches!(error, DeviceError::Unsupported { .. }), "{error}");
    assert!(error.to_string().contains("libdrd"), "{error}");
}

#[test]
fn limits_that_are_none_are_refused_and_a_smaller_one_holds() {
    for value in ["0", "nan", "inf"] {
        let (error, text) = Double::start(&["--max-force", value]).refusal();
        assert!(matches!(error, DeviceError::Protocol { .. }) && text.contains("largest force"), "{text}");
        for (option, word) in [("--max-torque", "largest torque"), ("--max-gripper-force", "gripper force")] {
            let (error, text) = Double::start(&["--device", "sigma.7-right", option, value]).refusal();
            assert!(matches!(error, DeviceError::Protocol { .. }) && text.contains(word), "{text}");
        }
        // A limit of what the device does not have is nobody's.
        Double::start(&["--max-torque", value, "--max-gripper-force", value]).open();
    }
    let double = Double::start(&["--max-force", "4.5"]);
    assert_eq!(double.open().description().limits.max_force_n, Some(4.5));
}

#[test]
fn garbage_at_the_first_reading_is_refused() {
    for (kind, word) in [
        ("nan", "position is not a finite number"),
        ("far", "1 m away"),
        ("frame", "not a rotation"),
        ("mirror", "mirrored"),
        ("gripper", "gripper angle"),
        ("silent", "communication"),
    ] {
        let (error, text) = Double::start(&["--device", "sigma.7-left", "--garbage", kind]).refusal();
        assert!(matches!(error, DeviceError::Protocol { .. }) && text.contains(word), "{kind}: {text}");
    }
}

#[test]
fn the_watchdog_is_what_the_controller_says_it_is() {
    let watchdog = |answer| {
        let double = Double::start(&["--firmware-watchdog", answer]);
        open(double.settings("")).map(|device| device.description().watchdog)
    };
    assert_eq!(watchdog("none"), Ok(None));
    assert_eq!(watchdog("160"), Ok(Some(Duration::from_millis(20))));
    // Off, longer than was set, and one that 1 kHz cannot feed.
    for answer in ["0", "255", "7"] {
        let text = watchdog(answer).unwrap_err().to_string();
        assert!(text.contains("watchdog"), "{text}");
    }
}
