//! An open device: states up, wrenches down, and every one of them accounted for.

use std::cell::Cell;
use std::time::Duration;

use assert_no_alloc::assert_no_alloc;
use devices::serial::SerialDevice;
use devices::{Device, DeviceState, MotorsOff, Wrench};
use glam::DVec3;

use crate::double::{Double, press, read_until, wait_until};

/// One of the numbers in the status.
fn status(device: &SerialDevice, state: &DeviceState, name: &str) -> i32 {
    let place = device.description().status_names.iter().position(|known| *known == name);
    state.status[place.unwrap()]
}

/// Wrenches that differ in every number but one, in numbers that an f32 holds exactly.
fn wrench(number: u32) -> Wrench {
    let x = f64::from(number) / 64.0;
    Wrench {
        force_n: DVec3::new(x, -2.0 * x, 3.0),
        torque_n_m: DVec3::new(0.125, -x / 64.0, 0.0),
        gripper_force_n: -x,
    }
}

/// The wrench as the record has it.
fn numbers(wrench: &Wrench) -> [f64; 7] {
    let (f, t) = (wrench.force_n, wrench.torque_n_m);
    [f.x, f.y, f.z, t.x, t.y, t.z, wrench.gripper_force_n]
}

/// Presses until the motors give that wrench.
fn press_until_felt(double: &Double, device: &mut SerialDevice, wrench: &Wrench) {
    wait_until("the wrench at the motors", || {
        press(device, wrench);
        double.record().last().is_some_and(|line| line.wrench == numbers(wrench))
    });
}

#[test]
fn states_say_what_the_device_measures() {
    let double = Double::start("--from 0.01,-0.02,0.03 --to 0.01,-0.02,0.03");
    let mut device = double.open().unwrap();
    let first = read_until(&mut device, |_| true);
    assert!((first.pose.translation - DVec3::new(0.01, -0.02, 0.03)).length() < 1e-7);
    assert_eq!(first.gripper_rad, Some(0.25));
    assert_eq!(first.buttons, 0b10);
    assert_eq!(first.joints[..4], [0.125, 0.25, 0.375, 0.0]);
    assert!(first.homed && first.motors_off.is_none());
    read_until(&mut device, |state| state.device_time_ns > first.device_time_ns + 50_000_000);
}

#[test]
fn the_wrench_at_the_motors_is_the_one_commanded_and_comes_in_order() {
    let double = Double::start("");
    let mut device = double.open().unwrap();
    device.enable().unwrap();
    for number in 0..100 {
        press_until_felt(&double, &mut device, &wrench(number));
    }
    let record = double.record().into_iter().filter(|line| !line.is_zero());
    let mut felt: Vec<[f64; 7]> = record.map(|line| line.wrench).collect();
    felt.dedup();
    let commanded: Vec<[f64; 7]> = (0..100).map(|number| numbers(&wrench(number))).collect();
    assert_eq!(felt, commanded);
}

#[test]
fn motors_are_on_between_enable_and_disable_and_no_force_is_felt_outside() {
    let double = Double::start("");
    let mut device = double.open().unwrap();
    device.command(&wrench(7)).unwrap();
    device.enable().unwrap();
    press_until_felt(&double, &mut device, &wrench(9));
    device.disable().unwrap();
    device.disable().unwrap();
    double.wait_for(0, |line| line.event == "off");
    // What is commanded now reaches motors that are off.
    let echoed = |state: &DeviceState| state.status[5];
    let commands = echoed(&read_until(&mut device, |_| true));
    for _ in 0..5 {
        device.command(&wrench(11)).unwrap();
    }
    let state = read_until(&mut device, |state| echoed(state) == commands + 5);
    assert_eq!(status(&device, &state, "commands"), echoed(&state));
    assert_eq!(state.motors_off, None, "the device did what it was told");
    drop(device);
    assert!(double.open().is_ok());
    let record = double.record();
    let off = record.iter().rposition(|line| line.event == "off").unwrap();
    assert!(record[off..].iter().all(|line| line.is_zero()));
    assert!(record.iter().take_while(|line| line.event != "enable").all(|line| line.is_zero()));
}

#[test]
fn dropping_the_device_switches_the_motors_off_at_once() {
    let double = Double::start("");
    let last_event_of_a_driver = || {
        let mut device = double.open().unwrap();
        device.enable().unwrap();
        press_until_felt(&double, &mut device, &wrench(5));
        let before = double.record().len();
        drop(device);
        double.wait_for(before, |line| line.event == "off" || line.event == "watchdog").event
    };
    // On a busy machine the watchdog may come first, but not every time.
    assert!((0..20).any(|_| last_event_of_a_driver() == "off"));
}

#[test]
fn commands_beyond_the_limits_are_scaled_down_by_the_device() {
    let double = Double::start("");
    let mut device = double.open().unwrap();
    device.enable().unwrap();
    let mut felt = None;
    wait_until("a push", || {
        press(&mut device, &Wrench::of_force(DVec3::new(30.0, 40.0, 0.0)));
        felt = double.record().into_iter().find(|line| !line.is_zero());
        felt.is_some()
    });
    let felt = felt.unwrap().wrench;
    assert!((felt[0] - 12.0).abs() < 1e-5 && (felt[1] - 16.0).abs() < 1e-5, "{felt:?}");
}

#[test]
fn echoes_measure_the_round_trip() {
    let double = Double::start("");
    let mut device = double.open().unwrap();
    device.enable().unwrap();
    let mut last = None;
    wait_until("an echo", || {
        last = press(&mut device, &Wrench::ZERO);
        last.is_some_and(|state| status(&device, &state, "round_trip_us") > 0)
    });
    let state = last.unwrap();
    assert!(status(&device, &state, "longest_round_trip_us") >= status(&device, &state, "round_trip_us"));
    assert_eq!(status(&device, &state, "lost_commands"), 0);
}

#[test]
fn lost_late_and_repeated_states_are_counted_and_never_go_back_in_time() {
    // A busy machine loses others too, but puts none in another order.
    for (fault, lost, late) in [("dropped", 15, 0), ("reordered", 15, 15), ("repeated", 0, 15)] {
        let double = Double::start(&format!("--fault {fault}"));
        let mut device = double.open().unwrap();
        let last_ns = Cell::new(0);
        let states = device.description().status_names.iter().position(|name| *name == "states").unwrap();
        let end = read_until(&mut device, |state| {
            assert!(state.device_time_ns >= last_ns.replace(state.device_time_ns));
            state.status[states] > 200
        });
        assert!(status(&device, &end, "lost_states") >= lost, "{fault}: {:?}", end.status);
        let stale = status(&device, &end, "stale_states");
        assert!(stale >= late && (late > 0 || stale == 0), "{fault}: {:?}", end.status);
        assert_eq!(status(&device, &end, "refused_states"), 0);
    }
}

#[test]
fn a_bad_command_takes_the_force_away_until_the_next_good_one() {
    let double = Double::start("--fault bad-commands");
    let mut device = double.open().unwrap();
    device.enable().unwrap();
    wait_until("lost commands", || {
        std::thread::sleep(Duration::from_millis(1));
        press(&mut device, &wrench(64)).is_some_and(|state| status(&device, &state, "lost_commands") >= 5)
    });
    let record = double.record();
    let first = record.iter().position(|line| !line.is_zero()).unwrap();
    let zeros = record[first..].iter().filter(|line| line.event == "command" && line.is_zero()).count();
    assert!(zeros >= 4, "{zeros}");
    assert!(record.iter().all(|line| line.is_zero() || line.wrench == numbers(&wrench(64))));
}

#[test]
fn the_device_says_why_it_keeps_its_motors_off() {
    let double = Double::start("--max-speed 0.05 --to 0.15,0,0 --during 1.5 --after 0.3");
    let mut device = double.open().unwrap();
    device.enable().unwrap();
    wait_until("a cause", || {
        let cause = press(&mut device, &Wrench::ZERO).and_then(|state| state.motors_off);
        assert!(matches!(cause, None | Some(MotorsOff::Velocity | MotorsOff::Watchdog)), "{cause:?}");
        cause == Some(MotorsOff::Velocity)
    });
}

#[test]
fn homing_ends_when_the_device_has_found_its_reference() {
    let double = Double::start("--homing 0.1");
    let mut device = double.open().unwrap();
    assert!(device.description().needs_homing);
    let before = read_until(&mut device, |_| true);
    assert!(!before.homed);
    device.home().unwrap();
    let after = read_until(&mut device, |_| true);
    assert!(after.homed);
    assert!(after.device_time_ns - before.device_time_ns >= 100_000_000);
    assert!(double.record().iter().all(|line| line.event != "enable"));
}

#[test]
fn gravity_compensation_can_be_switched() {
    let double = Double::start("");
    let mut device = double.open().unwrap();
    assert_eq!(device.set_gravity_compensation(true), Ok(()));
    assert_eq!(device.set_gravity_compensation(false), Ok(()));
}

#[test]
fn reading_and_commanding_allocate_nothing() {
    let double = Double::start("--fault reordered");
    let mut device = double.open().unwrap();
    device.enable().unwrap();
    let mut states = 0;
    for number in 0..500 {
        std::thread::sleep(Duration::from_millis(1));
        let (state, commanded) = assert_no_alloc(|| (device.read(), device.command(&wrench(number))));
        assert_eq!(commanded, Ok(()));
        states += u32::from(state.is_ok());
    }
    assert!(states > 100, "{states}");
    double.signal("USR1");
    wait_until("an end", || assert_no_alloc(|| device.command(&Wrench::ZERO).and(device.read())).is_err());
}
