//! Cables, faults and ends of programs: what is lost, and that the motors are off.

use devices::force_dimension::open;
use devices::{Device, DeviceError, MotorsOff, Wrench};
use glam::DVec3;

use crate::double::{Double, feed_until, read_until_error};

const PUSH: Wrench = Wrench::of_force(DVec3::new(0.0, 5.0, 0.0));

#[test]
fn an_unplugged_device_is_lost_and_opens_again_when_plugged_in() {
    let mut double = Double::start(&["--device", "omega.3:501"]);
    let mut device = double.open();
    device.enable().unwrap();
    device.command(&PUSH).unwrap();
    double.tell("0 unplug");
    let lost = |error: DeviceError| assert!(matches!(error, DeviceError::Lost { .. }), "{error}");
    lost(device.read().unwrap_err());
    lost(device.command(&PUSH).unwrap_err());
    lost(device.disable().unwrap_err());
    assert!(matches!(open(double.settings("501")), Err(DeviceError::NotFound { .. })));

    double.tell("0 plug");
    lost(device.read().unwrap_err());
    drop(device);
    let mut device = open(double.settings("501")).unwrap();
    device.enable().unwrap();
    feed_until(&mut device, PUSH, |state| state.motors_off.is_none() && state.status[5] == 1);
}

#[test]
fn dropping_leaves_the_motors_off() {
    let double = Double::start(&[]);
    let mut device = double.open();
    device.enable().unwrap();
    device.command(&PUSH).unwrap();
    drop(device);
    assert!(["off", "watchdog"].contains(&double.last_switch().as_str()), "{:?}", double.record());
    assert_eq!(double.last().wrench, Wrench::ZERO);
    double.open();
}

#[test]
fn a_panic_leaves_the_motors_off() {
    let double = Double::start(&[]);
    let mut device = double.open();
    device.enable().unwrap();
    let panicked = std::panic::catch_unwind(std::panic::AssertUnwindSafe(move || {
        device.command(&PUSH).unwrap();
        // A panic without its message on the terminal, which takes longer than the watchdog.
        std::panic::resume_unwind(Box::new("a fault in the loop"));
    }));
    assert!(panicked.is_err());
    assert!(["off", "watchdog"].contains(&double.last_switch().as_str()), "{:?}", double.record());
}

#[test]
fn disabling_twice_is_no_error_and_takes_the_force_away_before_the_motors() {
    let double = Double::start(&[]);
    let mut device = double.open();
    device.enable().unwrap();
    device.command(&PUSH).unwrap();
    device.disable().unwrap();
    device.disable().unwrap();
    let record = double.record();
    let off = record.iter().position(|line| line.event == "off" || line.event == "watchdog").unwrap();
    assert_eq!(record[off - 1].event, "command");
    assert!(record[off - 1].wrench == Wrench::ZERO || record[off].event == "watchdog", "{record:?}");
}

#[test]
fn garbage_while_running_is_a_loss_that_says_what_was_wrong() {
    for (kind, word) in [
        ("nan", "position is not a finite"),
        ("far", "1 m"),
        ("frame", "rotation"),
        ("mirror", "mirrored"),
        ("velocity", "velocity"),
        ("gripper", "gripper"),
        ("silent", "communication"),
        ("stuck", "repeats an old position"),
    ] {
        let mut double = Double::start(&["--device", "sigma.7-right"]);
        let mut device = double.open();
        device.read().unwrap();
        double.tell(&format!("0 garbage {kind}"));
        let error = read_until_error(&mut device);
        assert!(matches!(error, DeviceError::Lost { .. }), "{kind}: {error}");
        assert!(error.to_string().contains(word), "{kind}: {error}");
    }
}

#[test]
fn a_repeated_position_keeps_its_time() {
    let mut double = Double::start(&[]);
    let mut device = double.open();
    let fresh = device.read().unwrap();
    let next = device.read().unwrap();
    assert!(next.device_time_ns > fresh.device_time_ns);
    double.tell("0 garbage stuck");
    assert_eq!(device.read().unwrap().device_time_ns, device.read().unwrap().device_time_ns);
}

#[test]
fn a_pause_of_the_loop_is_told_as_the_watchdogs_and_enabling_ends_it() {
    let double = Double::start(&[]);
    let mut device = double.open();
    device.enable().unwrap();
    feed_until(&mut device, PUSH, |state| state.status[5] == 1);
    std::thread::sleep(std::time::Duration::from_millis(80));
    assert!(double.was_late());
    let state = device.read().unwrap();
    assert_eq!(state.motors_off, Some(MotorsOff::Watchdog));
    device.command(&PUSH).unwrap();
    assert_eq!(double.last().wrench, Wrench::ZERO, "a command alone brings no force back");
    device.enable().unwrap();
    feed_until(&mut device, PUSH, |state| state.motors_off.is_none() && state.status[5] == 1);
}

#[test]
fn homing_does_not_cost_the_watchdog() {
    let double = Double::start(&["--unhomed"]);
    let mut device = double.open();
    device.enable().unwrap();
    device.home().unwrap();
    device.command(&PUSH).unwrap();
    std::thread::sleep(std::time::Duration::from_millis(80));
    assert_eq!(double.last_switch(), "watchdog");
}
