//! What passes through an open device: poses one way, wrenches the other.

use assert_no_alloc::assert_no_alloc;
use devices::{Device, MotorsOff, Wrench};
use glam::DVec3;

use crate::double::{Double, feed_until, undisturbed};

fn push(x: f64) -> Wrench {
    Wrench::of_force(DVec3::new(x, 0.25 * x, -0.5 * x))
}

fn full(x: f64) -> Wrench {
    Wrench { torque_n_m: DVec3::new(0.01 * x, -0.02 * x, 0.03), gripper_force_n: 0.5 * x, ..push(x) }
}

/// The wrenches that reached the motors, without those of switching on and off.
fn commands(double: &Double) -> Vec<Wrench> {
    let wrenches = double.record().into_iter().filter(|line| line.event == "command").map(|line| line.wrench);
    wrenches.filter(|wrench| *wrench != Wrench::ZERO).collect()
}

#[test]
fn the_wrench_at_the_motors_is_the_one_commanded_whatever_the_hand() {
    for name in ["sigma.7-right", "sigma.7-left", "lambda.7-left"] {
        let sent: Vec<Wrench> = (1..=20).map(|step| full(0.3 * f64::from(step))).collect();
        let double = undisturbed(|| {
            let double = Double::start(&["--device", name]);
            let mut device = double.open();
            device.enable().unwrap();
            for wrench in &sent {
                device.read().unwrap();
                device.command(wrench).unwrap();
            }
            double
        });
        assert_eq!(commands(&double), sent, "{name}");
    }
}

#[test]
fn a_device_gets_only_what_it_has_motors_for() {
    for (name, torque, grip) in
        [("delta.3", 0.0, 0.0), ("omega.7-left", 0.0, 1.0), ("lambda.6-right", 1.0, 0.0)]
    {
        let double = undisturbed(|| {
            let double = Double::start(&["--device", name]);
            let mut device = double.open();
            device.enable().unwrap();
            device.command(&full(2.0)).unwrap();
            double
        });
        let wanted = full(2.0);
        let expected = Wrench {
            force_n: wanted.force_n,
            torque_n_m: torque * wanted.torque_n_m,
            gripper_force_n: grip * wanted.gripper_force_n,
        };
        assert_eq!(commands(&double), [expected], "{name}");
    }
}

#[test]
fn motors_are_off_after_opening_and_stay_off_until_enabled() {
    let double = Double::start(&[]);
    let mut device = double.open();
    device.read().unwrap();
    device.command(&push(5.0)).unwrap();
    assert!(commands(&double).is_empty());
    assert!(double.record().iter().all(|line| line.event != "enable"));
    assert_eq!(device.read().unwrap().motors_off, None, "nobody asked for them");
}

#[test]
fn enabling_brings_back_no_force_from_before() {
    let double = undisturbed(|| {
        let double = Double::start(&[]);
        let mut device = double.open();
        device.enable().unwrap();
        device.command(&push(5.0)).unwrap();
        device.disable().unwrap();
        device.enable().unwrap();
        assert!(["command", "watchdog"].contains(&double.last().event.as_str()), "an explicit zero");
        double
    });
    let record = double.record();
    let second = record.iter().rposition(|line| line.event == "enable").unwrap();
    assert!(record[second..].iter().all(|line| line.wrench == Wrench::ZERO), "{record:?}");
}

#[test]
fn a_saturated_motor_is_no_error() {
    let double = undisturbed(|| {
        let double = Double::start(&["--peak-force", "5"]);
        let mut device = double.open();
        device.enable().unwrap();
        device.command(&Wrench::of_force(DVec3::X * 12.0)).expect("2 is a success");
        double
    });
    assert_eq!(commands(&double), [Wrench::of_force(DVec3::X * 5.0)]);
}

#[test]
fn velocity_is_zero_before_the_sdk_knows_it_and_the_hands_own_afterwards() {
    let double = Double::start(&["--to", "0.29,0,0", "--during", "4"]);
    let mut device = double.open();
    let moving = feed_until(&mut device, Wrench::ZERO, |state| state.linear_velocity_m_per_s.x > 0.06);
    assert!(moving.linear_velocity_m_per_s.x < 0.09, "{moving:?}");
    // A pause, as homing makes one: the estimate begins anew.
    std::thread::sleep(std::time::Duration::from_millis(150));
    assert_eq!(device.read().unwrap().linear_velocity_m_per_s, DVec3::ZERO);
}

#[test]
fn buttons_and_gripper_come_as_they_are_pressed_and_opened() {
    let mut double = Double::start(&["--device", "omega.7-left", "--gripper", "0.1"]);
    let mut device = double.open();
    let state = device.read().unwrap();
    assert_eq!((state.buttons, state.gripper_rad), (0, Some(0.1)));
    double.tell("0 press 0");
    double.tell("0 press 9");
    double.tell("0 gripper 0.45");
    let state = device.read().unwrap();
    assert_eq!((state.buttons, state.gripper_rad), (1, Some(0.45)), "it has one button, and opens with plus");
}

#[test]
fn the_falcon_has_four_buttons_and_no_homing_of_its_own() {
    let mut double = Double::start(&["--device", "falcon:65535"]);
    let mut device = double.open();
    assert_eq!(device.description().buttons, ["center", "left", "top", "right"]);
    double.tell("0 press 3");
    assert_eq!(device.read().unwrap().buttons, 8);
    assert!(device.home().is_err());
}

#[test]
fn homing_leaves_the_motors_as_they_were() {
    let double = Double::start(&["--unhomed"]);
    let mut device = double.open();
    assert!(!device.read().unwrap().homed);
    device.home().unwrap();
    assert!(device.read().unwrap().homed);
    assert_eq!(double.last_switch(), "off");
    assert!(double.record().iter().any(|line| line.event == "enable"), "homing has moved it");

    device.enable().unwrap();
    device.home().unwrap();
    feed_until(&mut device, push(1.0), |state| state.motors_off.is_none());
    device.disable().unwrap();
    assert!(commands(&double).contains(&push(1.0)), "still enabled");
}

#[test]
fn homing_that_fails_says_so_and_leaves_the_motors_off() {
    let double = Double::start(&["--unhomed", "--homing-fails"]);
    let mut device = double.open();
    let text = device.home().unwrap_err().to_string();
    assert!(text.contains("homing failed"), "{text}");
    assert_eq!(double.last_switch(), "off");
    assert!(!device.read().unwrap().homed);
}

#[test]
fn gravity_compensation_is_switched_and_reported() {
    let double = Double::start(&[]);
    let mut device = double.open();
    let place = device.description().status_names.iter().position(|&name| name == "gravity").unwrap();
    for on in [false, true] {
        device.set_gravity_compensation(on).unwrap();
        feed_until(&mut device, Wrench::ZERO, |state| state.status[place] == i32::from(on));
    }
}

#[test]
fn the_device_says_why_it_has_switched_its_motors_off() {
    // Too fast: the handle is torn away while it is on.
    let double = Double::start(&["--threshold", "0.2", "--to", "0.1,0,0", "--after", "2", "--during", "0.1"]);
    let mut device = double.open();
    device.enable().unwrap();
    let state = feed_until(&mut device, Wrench::ZERO, |state| {
        state.motors_off.is_some_and(|why| why != MotorsOff::Watchdog)
    });
    assert_eq!(state.motors_off, Some(MotorsOff::Velocity));
    assert!(double.record().iter().any(|line| line.event == "velocity"));

    // The button on the device.
    let mut double = Double::start(&[]);
    let mut device = double.open();
    device.enable().unwrap();
    feed_until(&mut device, Wrench::ZERO, |state| state.status[5] == 1);
    double.tell("0 force-button");
    let state = feed_until(&mut device, Wrench::ZERO, |state| state.motors_off.is_some());
    assert!(matches!(state.motors_off, Some(MotorsOff::Button | MotorsOff::Watchdog)), "{state:?}");
}

#[test]
fn reading_and_commanding_allocate_nothing() {
    let double = Double::start(&["--device", "sigma.7-left"]);
    let mut device = double.open();
    device.enable().unwrap();
    for step in 0..200 {
        // Twice the time between two looks at the status numbers passes, so that those are within.
        std::thread::sleep(std::time::Duration::from_micros(100));
        assert_no_alloc(|| {
            assert!(device.read().is_ok());
            assert!(device.command(&full(0.01 * f64::from(step))).is_ok());
        });
    }
    assert_no_alloc(|| assert!(device.disable().is_ok() && device.enable().is_ok()));
}
