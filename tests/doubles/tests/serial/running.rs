//! An open device: states up, wrenches down, and every one of them accounted for.

use assert_no_alloc::assert_no_alloc;
use devices::serial::SerialDevice;
use devices::{Device, DeviceState, MotorsOff, Wrench};
use glam::DVec3;

use crate::double::{Double, read_until, wait_until};

/// One of the numbers in the status.
pub(crate) fn status(device: &SerialDevice, state: &DeviceState, name: &str) -> i32 {
    let place = device.description().status_names.iter().position(|known| *known == name);
    state.status[place.unwrap()]
}

fn wrench(number: u32) -> Wrench {
    // Numbers that an f32 holds exactly.
    let x = f64::from(number) / 64.0;
    Wrench {
        force_n: DVec3::new(x, -2.0 * x, 3.0),
        torque_n_m: DVec3::new(0.125, -x / 64.0, 0.0),
        gripper_force_n: -x,
    }
}

#[test]
fn states_say_what_the_device_measures() {
    let double = Double::start("--from 0.01,-0.02,0.03 --to 0.01,-0.02,0.03");
    let mut device = double.open().unwrap();
    let first = device.read().unwrap();
    assert!((first.pose.translation - DVec3::new(0.01, -0.02, 0.03)).length() < 1e-7);
    assert_eq!(first.gripper_rad, Some(0.25));
    assert_eq!(first.buttons, 0b10);
    assert_eq!(first.joints[..4], [0.125, 0.25, 0.375, 0.0]);
    assert!(first.homed && first.motors_off.is_none());
    let later = read_until(&mut device, |state| state.device_time_ns > first.device_time_ns + 50_000_000);
    assert_eq!(status(&device, &later, "bad_frames"), 0);
}

#[test]
fn the_wrench_at_the_motors_is_the_one_commanded_and_comes_in_order() {
    let double = Double::start("");
    let mut device = double.open().unwrap();
    device.enable().unwrap();
    for number in 0..200 {
        device.command(&wrench(number)).unwrap();
        // One at a time, so that each of them is seen.
        read_until(&mut device, |state| {
            state.motors_off.is_none()
                && double.record().iter().filter(|l| !l.is_zero()).count() > number as usize
        });
    }
    let felt: Vec<_> = double.record().into_iter().filter(|line| !line.is_zero()).collect();
    assert_eq!(felt.len(), 200);
    for (number, line) in (0..).zip(felt) {
        let wanted = wrench(number);
        let (f, t) = (wanted.force_n, wanted.torque_n_m);
        assert_eq!(line.wrench, [f.x, f.y, f.z, t.x, t.y, t.z, wanted.gripper_force_n]);
    }
}

#[test]
fn motors_are_on_between_enable_and_disable_and_no_force_is_felt_outside() {
    let double = Double::start("");
    let mut device = double.open().unwrap();
    device.command(&wrench(7)).unwrap();
    device.enable().unwrap();
    let enabled = double.wait_for(0, |line| line.event == "enable");
    device.command(&wrench(9)).unwrap();
    double.wait_for(0, |line| line.t_ns >= enabled.t_ns && !line.is_zero());
    device.disable().unwrap();
    device.disable().unwrap();
    device.command(&wrench(11)).unwrap();
    double.wait_for(0, |line| line.event == "off");
    let mut device_state = device.read().unwrap();
    wait_until("quiet", || {
        device_state = device.read().unwrap();
        status(&device, &device_state, "commands") == 7
    });
    assert_eq!(device_state.motors_off, None, "the device did what it was told");
    let record = double.record();
    let off = record.iter().position(|line| line.event == "off").unwrap();
    assert!(record[off..].iter().all(|line| line.is_zero()));
    assert!(record.iter().take_while(|line| line.event != "enable").all(|line| line.is_zero()));
}

#[test]
fn dropping_the_device_switches_the_motors_off_at_once() {
    let double = Double::start("");
    let mut device = double.open().unwrap();
    device.enable().unwrap();
    device.command(&wrench(5)).unwrap();
    double.wait_for(0, |line| !line.is_zero());
    drop(device);
    let off = double.wait_for(0, |line| line.event == "off" || line.event == "watchdog");
    assert_eq!(off.event, "off");
}

#[test]
fn commands_beyond_the_limits_are_scaled_down_by_the_device() {
    let double = Double::start("");
    let mut device = double.open().unwrap();
    device.enable().unwrap();
    device.command(&Wrench::of_force(DVec3::new(30.0, 40.0, 0.0))).unwrap();
    let felt = double.wait_for(0, |line| !line.is_zero());
    assert!((felt.wrench[0] - 12.0).abs() < 1e-5 && (felt.wrench[1] - 16.0).abs() < 1e-5, "{felt:?}");
}

#[test]
fn echoes_measure_the_round_trip() {
    let double = Double::start("");
    let mut device = double.open().unwrap();
    device.enable().unwrap();
    let state = {
        let mut state = device.read().unwrap();
        wait_until("an echo", || {
            device.command(&Wrench::ZERO).unwrap();
            state = device.read().unwrap();
            status(&device, &state, "round_trip_us") > 0
        });
        state
    };
    // The double looks at its line every 250 us and the state then waits for its turn.
    assert!(status(&device, &state, "round_trip_us") < 1_000_000);
    assert_eq!(status(&device, &state, "lost_commands"), 0);
}

#[test]
fn lost_late_and_repeated_states_are_counted_and_never_go_back_in_time() {
    for (fault, lost, stale) in
        [("dropped", true, false), ("reordered", true, true), ("repeated", false, true)]
    {
        let double = Double::start(&format!("--fault {fault}"));
        let mut device = double.open().unwrap();
        let mut last_ns = 0;
        let mut end = device.read().unwrap();
        wait_until("200 states", || {
            end = device.read().unwrap();
            assert!(end.device_time_ns >= last_ns);
            last_ns = end.device_time_ns;
            status(&device, &end, "states") > 200
        });
        assert_eq!(status(&device, &end, "lost_states") >= 15, lost, "{fault}: {:?}", end.status);
        assert_eq!(status(&device, &end, "stale_states") >= 15, stale, "{fault}: {:?}", end.status);
        assert_eq!(status(&device, &end, "refused_states"), 0);
    }
}

#[test]
fn a_bad_command_takes_the_force_away_until_the_next_good_one() {
    let double = Double::start("--fault bad-commands");
    let mut device = double.open().unwrap();
    device.enable().unwrap();
    let mut state = device.read().unwrap();
    wait_until("counts", || {
        device.command(&wrench(64)).unwrap();
        state = device.read().unwrap();
        status(&device, &state, "lost_commands") >= 5
    });
    let record = double.record();
    let first = record.iter().position(|line| !line.is_zero()).unwrap();
    let zeros = record[first..].iter().filter(|line| line.event == "command" && line.is_zero()).count();
    assert!(zeros >= 5, "{zeros}");
    assert!(record.iter().all(|line| line.is_zero() || line.wrench[0] == 1.0));
}

#[test]
fn the_device_says_why_it_keeps_its_motors_off() {
    let double = Double::start("--max-speed 0.05 --to 0.1,0,0 --during 0.5 --after 0.3");
    let mut device = double.open().unwrap();
    device.enable().unwrap();
    let mut state = device.read().unwrap();
    wait_until("a cause", || {
        device.command(&Wrench::ZERO).unwrap();
        state = device.read().unwrap();
        state.motors_off.is_some()
    });
    assert_eq!(state.motors_off, Some(MotorsOff::Velocity));
}

#[test]
fn homing_ends_when_the_device_has_found_its_reference() {
    let double = Double::start("--homing 0.3");
    let mut device = double.open().unwrap();
    assert!(device.description().needs_homing);
    let before = device.read().unwrap();
    assert!(!before.homed);
    device.home().unwrap();
    let after = read_until(&mut device, |_| true);
    assert!(after.homed);
    assert!(after.device_time_ns - before.device_time_ns >= 300_000_000);
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
    for number in 0..500 {
        std::thread::sleep(std::time::Duration::from_millis(1));
        assert_no_alloc(|| {
            device.read().unwrap();
            device.command(&wrench(number)).unwrap();
        });
    }
    double.signal("USR1");
    wait_until("an end", || assert_no_alloc(|| device.read().and(device.command(&Wrench::ZERO))).is_err());
}
