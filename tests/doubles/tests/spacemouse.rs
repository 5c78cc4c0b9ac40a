//! The SpaceMouse backend on written-down reports of both layouts, by their own clock, from the outside.
#![cfg(feature = "spacemouse")]
#![expect(clippy::unwrap_used, reason = "tests, their helpers too")]

use assert_no_alloc::{AllocDisabler, assert_no_alloc};
use devices::spacemouse::{self, Settings, SpaceMouse, WORKSPACE};
use devices::{Device, DeviceError, DeviceState};
use glam::{DQuat, DVec3};

#[global_allocator]
static ALLOCATOR: AllocDisabler = AllocDisabler;

const SPACE_NAVIGATOR: &str =
    include_str!("../../../nodes/devices/src/spacemouse/reports/space_navigator.txt");
const WIRELESS: &str = include_str!("../../../nodes/devices/src/spacemouse/reports/space_mouse_wireless.txt");

const MS: u64 = 1_000_000;

fn device(recording: &str) -> SpaceMouse {
    spacemouse::replay(recording, &Settings::default()).unwrap()
}

/// Reads every millisecond up to `until_ms`, and gives the last state.
fn play(device: &mut SpaceMouse, from_ms: u64, until_ms: u64) -> DeviceState {
    let mut last = None;
    for ms in from_ms..=until_ms {
        last = Some(device.read_at(ms * MS).unwrap());
    }
    last.unwrap()
}

/// Speed of half a push with the deadband of 0.03: (0.5 - 0.03)/(1 - 0.03) of 0.05 m/s.
fn half_push_m_per_s() -> f64 {
    0.05 * (0.5 - 0.03) / (1.0 - 0.03)
}

#[test]
fn separate_reports_move_forward_and_then_turn_left() {
    let mut device = device(SPACE_NAVIGATOR);
    let pushed = play(&mut device, 0, 300);
    assert!((pushed.linear_velocity_m_per_s - DVec3::X * half_push_m_per_s()).length() < 1e-9);
    let moved = play(&mut device, 301, 599);
    // Deflected from 100 ms to 500 ms.
    let expected = DVec3::X * half_push_m_per_s() * 0.4;
    assert!((moved.pose.translation - expected).length() < 1e-9, "{}", moved.pose.translation);
    assert_eq!(moved.linear_velocity_m_per_s, DVec3::ZERO);
    assert_eq!(moved.pose.rotation, DQuat::IDENTITY);
    let turned = play(&mut device, 600, 1400);
    assert!((turned.pose.translation - expected).length() < 1e-9, "it turns where it is");
    // 0.8 rad/s for 480 ms about up.
    assert!(turned.pose.rotation.angle_between(DQuat::from_rotation_z(0.8 * 0.48)) < 1e-6);
}

#[test]
fn buttons_are_those_that_are_pressed() {
    let mut device = device(SPACE_NAVIGATOR);
    assert_eq!(device.description().buttons, ["button1", "button2"]);
    let pressed: Vec<u32> = [599, 600, 650, 700]
        .into_iter()
        .scan(0, |from, until| {
            let state = play(&mut device, *from, until);
            *from = until + 1;
            Some(state.buttons)
        })
        .collect();
    assert_eq!(pressed, [0b00, 0b01, 0b11, 0b00]);
}

#[test]
fn one_report_of_six_axes_lifts_and_tilts_and_a_cap_out_of_reach_stops() {
    let mut device = device(WIRELESS);
    let end = play(&mut device, 0, 3000);
    // The last report is of 674 ms; 100 ms later the cap counts as let go.
    let seconds = 0.774 - 0.05;
    let expected = DVec3::Z * 0.05 * seconds;
    assert!((end.pose.translation - expected).length() < 1e-9, "{}", end.pose.translation);
    assert!(end.pose.rotation.angle_between(DQuat::from_rotation_x(0.8 * seconds)) < 1e-6);
    assert_eq!(end.linear_velocity_m_per_s, DVec3::ZERO);
    assert_eq!(end.angular_velocity_rad_per_s, DVec3::ZERO);
}

#[test]
fn how_often_it_is_read_does_not_change_where_it_goes() {
    let mut often = device(SPACE_NAVIGATOR);
    let mut seldom = device(SPACE_NAVIGATOR);
    let fine = (0..=5600u64).map(|quarter| often.read_at(quarter * MS / 4).unwrap()).last().unwrap();
    let coarse = (0..=350u64).map(|step| seldom.read_at(step * 4 * MS).unwrap()).last().unwrap();
    assert!((fine.pose.translation - coarse.pose.translation).length() < 1e-9);
    assert!(fine.pose.rotation.angle_between(coarse.pose.rotation) < 1e-6);
}

#[test]
fn reading_allocates_nothing() {
    let mut device = device(SPACE_NAVIGATOR);
    let turned = assert_no_alloc(|| (0..1400).filter_map(|ms| device.read_at(ms * MS).ok()).last());
    assert!(turned.unwrap().pose.rotation.angle_between(DQuat::IDENTITY) > 0.3);
}

#[test]
fn homing_puts_the_handle_back_to_the_middle() {
    let mut device = device(SPACE_NAVIGATOR);
    assert_ne!(play(&mut device, 0, 1400).pose.translation, WORKSPACE.centre);
    device.home().unwrap();
    let home = device.read_at(1401 * MS).unwrap();
    assert_eq!((home.pose.translation, home.pose.rotation), (WORKSPACE.centre, DQuat::IDENTITY));
}

#[test]
fn a_serial_that_no_device_has_is_not_found_and_the_message_says_what_was_looked_for() {
    let settings = Settings { serial: "no such device".to_owned(), ..Settings::default() };
    match spacemouse::open(settings) {
        Err(error @ DeviceError::NotFound { .. }) => {
            let text = error.to_string();
            assert!(text.contains("looked for") && text.contains("hidraw"), "{text}");
        }
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("opened"),
    }
    assert!(spacemouse::list(&Settings::default()).is_ok());
}
