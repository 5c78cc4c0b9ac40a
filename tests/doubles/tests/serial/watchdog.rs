//! A driver that stops driving: the device's own watchdog takes the force away.

use std::time::Duration;

use devices::{Device, Wrench};
use glam::DVec3;

use crate::client::{Client, FORCE_N};
use crate::double::{Double, Line, press, read_until, wait_until};

const WATCHDOG: Duration = Duration::from_millis(20);

/// The last command before the watchdog acted for the last time, and the watchdog's line.
fn last_command_and_watchdog(record: &[Line]) -> (&Line, &Line) {
    let at = record.iter().rposition(|line| line.event == "watchdog").unwrap();
    (&record[at - 1], &record[at])
}

fn assert_force_ended_in_time(record: &[Line], longest_tick: Duration) {
    let (command, watchdog) = last_command_and_watchdog(record);
    assert_eq!(command.wrench[0], FORCE_N, "it was pressing");
    assert!(watchdog.is_zero());
    let held = Duration::from_nanos(watchdog.t_ns - command.t_ns);
    assert!(held >= WATCHDOG && held <= WATCHDOG + longest_tick, "{held:?}, double's tick {longest_tick:?}");
}

#[test]
fn a_killed_driver_leaves_no_force_after_20_ms() {
    let double = Double::start("");
    let client = Client::start(&double.port());
    double.wait_for(0, |line| !line.is_zero());
    client.signal("KILL");
    double.wait_for(0, |line| line.event == "watchdog");
    let record = double.record();
    assert_force_ended_in_time(&record, double.end());
}

#[test]
fn a_stopped_driver_leaves_no_force_after_20_ms_and_gets_none_back_when_it_goes_on() {
    let double = Double::start("");
    let mut client = Client::start(&double.port());
    double.wait_for(0, |line| !line.is_zero());
    client.signal("STOP");
    double.wait_for(0, |line| line.event == "watchdog");
    client.signal("CONT");
    assert!(client.ended_well());
    wait_until("another 50 commands", || {
        let record = double.record();
        let (_, watchdog) = last_command_and_watchdog(&record);
        record.iter().filter(|line| line.t_ns > watchdog.t_ns).count() > 50
    });
    let record = double.record();
    let (_, watchdog) = last_command_and_watchdog(&record);
    assert!(record.iter().filter(|line| line.t_ns > watchdog.t_ns).all(Line::is_zero));
    assert_force_ended_in_time(&record, double.end());
}

#[test]
fn a_device_whose_watchdog_acted_pushes_again_after_it_is_enabled_again() {
    let double = Double::start("");
    let mut device = double.open().unwrap();
    let push = Wrench::of_force(DVec3::Z);
    device.enable().unwrap();
    device.command(&push).unwrap();
    let watchdog = double.wait_for(0, |line| line.event == "watchdog");
    read_until(&mut device, |state| state.motors_off.is_some());
    device.command(&push).unwrap();
    device.enable().unwrap();
    let state = device.read();
    assert!(state.is_ok_and(|state| state.motors_off.is_none()), "what it said before does not count");
    wait_until("a push", || {
        press(&mut device, &push);
        double.record().iter().any(|line| line.t_ns > watchdog.t_ns && !line.is_zero())
    });
    let record = double.record();
    let acted = record.iter().position(|line| line.event == "watchdog").unwrap();
    let until_enabled = record[acted..].iter().take_while(|line| line.event != "enable");
    assert!(until_enabled.into_iter().all(Line::is_zero));
}
