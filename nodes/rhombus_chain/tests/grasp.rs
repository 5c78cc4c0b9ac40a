//! Holding the surface, pulling it, letting go.
#![allow(clippy::expect_used, reason = "a helper that cannot go on stops its test")]

mod common;

use common::{block, body, law, tissue};
use glam::DVec3;
use rhombus_chain::{Body, Interaction, Mode, Step};

const RADIUS_M: f64 = 0.005;
const MS: i64 = 1_000_000;
/// The depth at which the tests close the gripper.
const CLOSED_AT_M: f64 = 0.003;

fn a_block() -> Body {
    body(block(DVec3::splat(0.1), 10))
}

/// A probe over the top side, pressed in by `depth_m`.
fn pressed(depth_m: f64) -> DVec3 {
    DVec3::new(0.011, 0.007, 0.05 + RADIUS_M - depth_m)
}

fn step(body: &Body, interaction: &mut Interaction, ms: i64, probe: DVec3, grasp: bool) -> Step {
    interaction.step(body, &tissue(), ms * MS, probe, grasp).expect("an answer")
}

/// Pressed at 0 ms, closed at 1 ms.
fn grasped(body: &Body) -> (Interaction, Step) {
    let mut interaction = Interaction::new();
    step(body, &mut interaction, 0, pressed(CLOSED_AT_M), false);
    let held = step(body, &mut interaction, 1, pressed(CLOSED_AT_M), true);
    assert_eq!(held.mode, Mode::Grasp);
    (interaction, held)
}

fn force_at(depth_m: f64) -> f64 {
    law(2).at_depth(depth_m).expect("finite").force_n
}

#[test]
fn closing_the_gripper_does_not_change_the_force() {
    let body = a_block();
    let mut interaction = Interaction::new();
    let open = step(&body, &mut interaction, 0, pressed(CLOSED_AT_M), false);
    let held = step(&body, &mut interaction, 1, pressed(CLOSED_AT_M), true);
    assert!(held.force_n.distance(open.force_n) < 1e-12);
    assert!((held.depth_m - CLOSED_AT_M).abs() < 1e-15);
}

#[test]
fn after_50_ms_the_force_is_that_of_the_way_since_the_grasp() {
    let body = a_block();
    let (mut interaction, _) = grasped(&body);
    let still = step(&body, &mut interaction, 51, pressed(CLOSED_AT_M), true);
    assert!(still.force_n.length() < 1e-9 && still.depth_m.abs() < 1e-15, "where it was closed is rest now");
    for way_m in [0.004, -0.004, 0.02] {
        let probe = pressed(CLOSED_AT_M) + DVec3::Z * way_m;
        let pulled = step(&body, &mut interaction, 60, probe, true);
        assert!((pulled.depth_m + way_m).abs() < 1e-15, "pulling is negative depth");
        assert!((pulled.normal_force_n - force_at(-way_m)).abs() < 1e-12);
        assert!(pulled.force_n.distance(DVec3::Z * force_at(-way_m)) < 1e-9);
    }
    assert!(force_at(-0.004) < 0.0, "the body pulls back");
}

#[test]
fn halfway_through_the_ramp_half_of_the_first_depth_is_left() {
    let body = a_block();
    let (mut interaction, _) = grasped(&body);
    let step = step(&body, &mut interaction, 26, pressed(CLOSED_AT_M), true);
    assert!((step.depth_m - 0.5 * CLOSED_AT_M).abs() < 1e-15);
    assert!((step.local_law.depth_offset_m - 0.5 * CLOSED_AT_M).abs() < 1e-15);
}

#[test]
fn across_the_normal_a_spring_of_half_the_rest_stiffness_pulls_back() {
    let body = a_block();
    let (mut interaction, _) = grasped(&body);
    let aside = DVec3::new(0.003, -0.004, 0.0);
    let step = step(&body, &mut interaction, 60, pressed(CLOSED_AT_M) + aside, true);
    let expected = -aside * 0.5 * law(2).rest_stiffness_n_per_m();
    assert!(step.force_n.distance(expected) < 1e-9, "{} {expected}", step.force_n);
}

#[test]
fn what_is_held_stays_held_wherever_the_probe_goes() {
    let body = a_block();
    let (mut interaction, held) = grasped(&body);
    for (ms, probe) in [(60, DVec3::new(0.5, 0.0, 0.0)), (61, DVec3::ZERO), (62, DVec3::new(0.0, 0.0, 0.08))]
    {
        let step = step(&body, &mut interaction, ms, probe, true);
        assert_eq!(
            (step.mode, step.surface_point, step.proxy),
            (Mode::Grasp, held.surface_point, held.proxy)
        );
        assert_eq!(step.normal, held.normal);
    }
}

#[test]
fn the_local_law_of_a_grasp_gives_the_force_of_the_step() {
    let body = a_block();
    let (mut interaction, _) = grasped(&body);
    for ms in [10, 30, 51, 80] {
        let probe = pressed(CLOSED_AT_M) + DVec3::new(0.002, 0.001, 1e-4 * ms as f64);
        let step = step(&body, &mut interaction, ms, probe, true);
        let force = step.local_law.force_n(tissue().law(), probe);
        assert!(force.distance(step.force_n) < 1e-12);
    }
}

#[test]
fn after_release_the_force_fades_over_50_ms_of_stamps() {
    let body = a_block();
    let (mut interaction, _) = grasped(&body);
    let away = DVec3::new(0.011, 0.012, 0.08);
    let held = step(&body, &mut interaction, 100, away, true);
    let released = step(&body, &mut interaction, 101, away, false);
    assert!(released.force_n.distance(held.force_n) < 1e-12, "no jump");
    assert_eq!(released.mode, Mode::None);
    for (ms, share) in [(111, 0.8), (126, 0.5), (150, 0.02), (151, 0.0), (1000, 0.0)] {
        let step = step(&body, &mut interaction, ms, away, false);
        assert!(step.force_n.distance(held.force_n * share) < 1e-12, "{ms} ms");
    }
    // The depth is long gone, the state is that of a new interaction but for the stamp.
    assert_eq!(interaction.impressions().count(), 0);
}

#[test]
fn a_probe_that_still_presses_takes_over_while_the_grasp_fades() {
    let body = a_block();
    let (mut interaction, _) = grasped(&body);
    let probe = pressed(0.004);
    let held = step(&body, &mut interaction, 100, probe, true);
    let contact_n = DVec3::Z * force_at(0.004);
    for (ms, share) in [(101, 0.0), (121, 0.4), (146, 0.9), (151, 1.0)] {
        let step = step(&body, &mut interaction, ms, probe, false);
        assert_eq!(step.mode, Mode::Contact);
        assert!(step.force_n.distance(held.force_n.lerp(contact_n, share)) < 1e-9, "{ms} ms");
        assert!((step.local_law.stiffness_factor - share).abs() < 1e-12);
    }
}

#[test]
fn closing_again_while_a_grasp_fades_does_not_make_the_force_jump() {
    let body = a_block();
    let (mut interaction, _) = grasped(&body);
    let probe = pressed(0.004);
    let mut last = step(&body, &mut interaction, 100, probe, true);
    let largest = force_at(0.004);
    for ms in 101..200 {
        let grasp = (ms / 7) % 2 == 0; // a gripper that chatters
        let now = step(&body, &mut interaction, ms, probe, grasp);
        let change = now.force_n.distance(last.force_n);
        assert!(change < 2.5 * largest / 50.0, "{change} N of {largest} N in 1 ms at {ms} ms");
        last = now;
    }
}

#[test]
fn a_gripper_that_closes_on_air_holds_nothing_until_it_opens_and_closes_again() {
    let body = a_block();
    let mut interaction = Interaction::new();
    let air = DVec3::new(0.0, 0.0, 0.08);
    assert_eq!(step(&body, &mut interaction, 0, air, true).mode, Mode::None);
    assert_eq!(step(&body, &mut interaction, 1, pressed(0.002), true).mode, Mode::Contact);
    assert_eq!(step(&body, &mut interaction, 2, pressed(0.002), false).mode, Mode::Contact);
    assert_eq!(step(&body, &mut interaction, 3, pressed(0.002), true).mode, Mode::Grasp);
    // A new interaction counts as open.
    assert_eq!(step(&body, &mut Interaction::new(), 0, pressed(0.002), true).mode, Mode::Grasp);
}

#[test]
fn time_is_that_of_the_stamps_alone() {
    let body = a_block();
    let (mut quick, _) = grasped(&body);
    let (mut slow, _) = grasped(&body);
    let mut through = Vec::new();
    for ms in 2..=40 {
        through.push(step(&body, &mut quick, ms, pressed(CLOSED_AT_M), true));
    }
    let once = step(&body, &mut slow, 40, pressed(CLOSED_AT_M), true);
    assert_eq!(through.last(), Some(&once), "the number of poses in between does not matter");
    let again = step(&body, &mut slow, 40, pressed(CLOSED_AT_M), true);
    assert_eq!(again, once, "no time, no change");
}

#[test]
fn a_held_point_and_a_fading_one_move_the_surface() {
    let body = a_block();
    let (mut interaction, _) = grasped(&body);
    let probe = pressed(CLOSED_AT_M) + DVec3::new(0.002, 0.0, 0.01);
    step(&body, &mut interaction, 100, probe, true);
    let held: Vec<_> = interaction.impressions().collect();
    assert_eq!(held.len(), 1);
    assert!((held[0].depth_m + 0.01).abs() < 1e-12);
    assert!(held[0].lateral_m.distance(DVec3::X * 0.002) < 1e-12);
    step(&body, &mut interaction, 101, probe, false);
    step(&body, &mut interaction, 126, probe, false);
    let fading: Vec<_> = interaction.impressions().collect();
    assert_eq!(fading.len(), 1);
    assert!((fading[0].depth_m + 0.005).abs() < 1e-12, "half of it");
    assert!(fading[0].lateral_m.distance(DVec3::X * 0.001) < 1e-12);
}
