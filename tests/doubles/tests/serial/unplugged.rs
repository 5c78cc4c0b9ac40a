//! The cable: out, and in again.

use devices::{Device, DeviceError, Wrench};
use glam::DVec3;

use crate::double::{Double, press, read_until, wait_until};

fn lost(result: Result<impl Sized, DeviceError>) -> bool {
    match result {
        Ok(_) => false,
        Err(DeviceError::Lost { .. }) => true,
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn an_unplugged_device_is_lost_and_its_watchdog_takes_the_force_away() {
    let double = Double::start("");
    let mut device = double.open().unwrap();
    device.enable().unwrap();
    let push = Wrench::of_force(DVec3::X);
    device.command(&push).unwrap();
    double.wait_for(0, |line| !line.is_zero());
    double.signal("USR1");
    wait_until("a loss", || lost(device.command(&push)));
    assert!(lost(device.read()) && lost(device.command(&push)) && lost(device.enable()), "it stays lost");
    assert!(lost(device.disable()));
    double.wait_for(0, |line| line.event == "watchdog");
}

#[test]
fn a_device_that_is_plugged_in_again_opens_with_the_same_settings_and_without_force() {
    let double = Double::start("");
    let mut device = double.open().unwrap();
    device.enable().unwrap();
    device.command(&Wrench::of_force(DVec3::X)).unwrap();
    double.wait_for(0, |line| !line.is_zero());
    double.signal("USR1");
    wait_until("a loss", || lost(device.command(&Wrench::ZERO)));
    assert!(matches!(double.open(), Err(DeviceError::NotFound { .. })));
    drop(device);
    let before = double.record().len();
    double.signal("USR2");
    wait_until("a port", || double.port().exists());
    let mut device = double.open().unwrap();
    read_until(&mut device, |_| true);
    assert!(double.record()[before..].iter().all(|line| line.is_zero()));
    device.enable().unwrap();
    wait_until("a push", || {
        press(&mut device, &Wrench::of_force(DVec3::Y));
        double.record()[before..].iter().any(|line| line.wrench[1] == 1.0)
    });
}

#[test]
fn a_device_that_falls_silent_is_lost_after_100_ms() {
    let double = Double::start("--fault mute");
    let mut device = double.open().unwrap();
    let last = read_until(&mut device, |_| true);
    device.enable().unwrap();
    let mut error = None;
    wait_until("a loss", || {
        error = device.command(&Wrench::ZERO).and(device.read()).err();
        error.is_some()
    });
    assert_eq!(error, Some(DeviceError::Lost { device: "serial", reason: "no state for 100 ms" }));
    assert!(last.motors_off.is_none());
}
