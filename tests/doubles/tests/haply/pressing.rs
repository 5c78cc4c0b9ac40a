//! Places, orientations and forces on their way through the service.

use std::time::Duration;

use assert_no_alloc::assert_no_alloc;
use devices::{Device, Wrench};
use glam::{DQuat, DVec3};

use crate::double::{Double, eventually, press};

#[test]
fn a_push_forward_arrives_as_the_services_y_whichever_key_it_understands() {
    for service in ["3.5", "3.4"] {
        let double = Double::start(&["--service", service]);
        let mut device = double.open();
        device.enable().unwrap();
        press(&mut device, DVec3::new(1.0, 0.25, -0.5), 50);
        let expected = DVec3::new(-0.25, 1.0, -0.5);
        let pushed = double
            .record()
            .iter()
            .filter(|(_, event, force)| event == "command" && *force == expected)
            .count();
        assert!(pushed > 10, "{service}: {pushed} commands with the force");
    }
}

#[test]
fn a_place_of_the_service_is_turned_into_the_device_frame_and_its_velocity_too() {
    // The hand rests at x 0.1 (right), y 0.2 (forward), z 0.3.
    let double = Double::start(&["--from", "0.1,0.2,0.3", "--to", "0.1,0.2,0.3"]);
    let mut device = double.open();
    let state = press(&mut device, DVec3::ZERO, 20);
    assert!((state.pose.translation - DVec3::new(0.2, -0.1, 0.3)).length() < 1e-9);
    assert_eq!(state.pose.rotation, DQuat::IDENTITY);
    drop((device, double));
    // It moves with 0.05 m/s along the service's x, which is -y.
    let double = Double::start(&["--to", "0.3,0,0", "--during", "6"]);
    let mut device = double.open();
    let state = press(&mut device, DVec3::ZERO, 1000);
    assert!((state.linear_velocity_m_per_s - DVec3::new(0.0, -0.05, 0.0)).length() < 1e-3, "{state:?}");
}

#[test]
fn the_grip_turns_the_handle_and_has_the_buttons() {
    let double = Double::start(&["--grips", "61548"]);
    let mut device = double.open();
    assert_eq!(device.description().buttons, ["a", "b", "c", "home"]);
    let mut state = press(&mut device, DVec3::ZERO, 300);
    assert_eq!(state.buttons, 0b0101);
    // It turns about the service's y with 0.5 rad/s: about forward, which is x. Readings that a busy machine holds up for a
    // moment come with a wrong time between them.
    eventually("the speed of the turn", || {
        state = press(&mut device, DVec3::ZERO, 20);
        (state.angular_velocity_rad_per_s - DVec3::new(0.5, 0.0, 0.0)).length() < 0.05
    });
    let (axis, angle) = state.pose.rotation.to_axis_angle();
    assert!(angle > 0.1 && (axis - DVec3::X).length() < 1e-6, "{axis} {angle}");
    let battery = device.description().status_names.iter().position(|name| *name == "grip_battery_percent");
    assert_eq!(state.status[battery.unwrap()], 50);
}

#[test]
fn the_force_moves_the_hand_as_far_as_its_spring_lets_it() {
    let double = Double::start(&["--stiffness", "100", "--damping", "10"]);
    let mut device = double.open();
    device.enable().unwrap();
    let rest = DVec3::new(0.0, 0.0, 0.01);
    eventually("there", || {
        let state = press(&mut device, DVec3::Z, 20);
        (state.pose.translation - rest).length() < 1e-4 && state.linear_velocity_m_per_s.length() < 1e-3
    });
}

#[test]
fn after_opening_and_after_disabling_no_command_moves_the_motors() {
    let double = Double::start(&[]);
    let mut device = double.open();
    press(&mut device, DVec3::X, 50);
    assert!(double.record().iter().all(|(_, _, force)| *force == DVec3::ZERO), "off after opening");
    device.enable().unwrap();
    press(&mut device, DVec3::X, 50);
    device.disable().unwrap();
    device.disable().unwrap();
    eventually("off", || double.record().last().unwrap().1 == "off");
    let lines = double.record().len();
    press(&mut device, DVec3::X, 50);
    assert_eq!(double.record().len(), lines, "no force after disabling");
    device.enable().unwrap();
    press(&mut device, DVec3::Y, 50);
    assert_eq!(double.record().last().unwrap().2, -DVec3::X, "and again after enabling");
}

#[test]
fn enabling_begins_without_a_force_whatever_was_commanded_before() {
    let double = Double::start(&[]);
    let mut device = double.open();
    device.command(&Wrench::of_force(DVec3::X)).unwrap();
    device.enable().unwrap();
    eventually("a command", || double.record().last().is_some_and(|line| line.1 == "command"));
    std::thread::sleep(Duration::from_millis(60));
    assert!(double.record().iter().all(|(_, _, force)| *force == DVec3::ZERO));
}

#[test]
fn reading_and_commanding_allocate_nothing() {
    let double = Double::start(&["--grips", "61548"]);
    let mut device = double.open();
    device.enable().unwrap();
    for _ in 0..500 {
        assert_no_alloc(|| {
            device.read().unwrap();
            device.command(&Wrench::of_force(DVec3::X)).unwrap();
        });
        std::thread::sleep(Duration::from_micros(500));
    }
    assert!(double.record().len() > 50);
}
