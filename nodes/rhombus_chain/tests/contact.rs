//! Contact of a probe with a body: depth, force, memory, continuity, and what cannot shake it.
#![allow(clippy::expect_used, reason = "a helper that cannot go on stops its test")]

mod common;

use common::{Random, block, body, bumpy, icosphere, tissue};
use glam::DVec3;
use proptest::prelude::*;
use rhombus_chain::{Body, Interaction, LocalLaw, Mode, Step, StepError};

const RADIUS_M: f64 = 0.005;
const MS: i64 = 1_000_000;

/// The answer to a probe that appears at `probe`.
fn touch(body: &Body, probe: DVec3) -> Step {
    Interaction::new().step(body, &tissue(), 0, probe, false).expect("an answer")
}

/// Moves the probe along a straight line in steps of `step_m`; returns all answers.
fn drive(body: &Body, interaction: &mut Interaction, from: DVec3, to: DVec3, step_m: f64) -> Vec<Step> {
    let steps = (from.distance(to) / step_m).ceil() as i64;
    let answer = |k: i64| {
        let probe = from.lerp(to, k as f64 / steps as f64);
        interaction.step(body, &tissue(), k * MS, probe, false).expect("an answer")
    };
    (0..=steps).map(answer).collect()
}

#[test]
fn a_pressed_flat_side_pushes_out_with_the_force_of_the_law() {
    let body = body(block(DVec3::splat(0.1), 10));
    for depth_m in [1e-6, 1e-3, 4e-3, 6e-3] {
        let step = touch(&body, DVec3::new(0.013, -0.007, 0.05 + RADIUS_M - depth_m));
        let law = tissue().law().at_depth(depth_m).expect("finite");
        assert_eq!(step.mode, Mode::Contact);
        assert!((step.depth_m - depth_m).abs() < 1e-15);
        assert!(step.normal.distance(DVec3::Z) < 1e-12);
        assert!(step.force_n.distance(DVec3::Z * law.force_n) < 1e-9);
        assert!((step.normal_force_n - law.force_n).abs() < 1e-9);
        assert!((step.stiffness_n_per_m - law.stiffness_n_per_m).abs() < 1e-6);
        assert!(step.proxy.distance(DVec3::new(0.013, -0.007, 0.05)) < 1e-12);
        let at = step.surface_point.expect("touched");
        assert!(body.mesh().position(at).distance(step.proxy) < 1e-15);
    }
}

#[test]
fn around_a_sphere_the_force_points_away_from_its_centre() {
    let body = body(icosphere(0.05, 3));
    let mut random = Random(1);
    for _ in 0..200 {
        let direction = random.direction();
        let step = touch(&body, direction * (0.05 + RADIUS_M - 0.002));
        // The facets are up to 0.3 mm inside the sphere.
        assert!((step.depth_m - 0.002).abs() < 3.5e-4, "{}", step.depth_m);
        assert!(step.normal.angle_between(direction) < 0.01);
        assert!(step.force_n.dot(direction) > 0.0);
    }
}

#[test]
fn nothing_is_felt_beyond_the_probe_radius() {
    let body = body(bumpy(3));
    let mut random = Random(2);
    for _ in 0..200 {
        let at = random.surface_point(body.mesh());
        let (out, normal) = (body.mesh().position(at), body.mesh().normal(at));
        let step = touch(&body, out + normal * (RADIUS_M + 0.02));
        if body.index().closest(body.mesh(), out + normal * (RADIUS_M + 0.02), RADIUS_M).is_none() {
            assert_eq!((step.mode, step.force_n, step.depth_m), (Mode::None, DVec3::ZERO, 0.0));
            assert_eq!((step.surface_point, step.normal), (None, DVec3::ZERO));
            assert_eq!(step.local_law, LocalLaw::default());
        }
    }
}

#[test]
fn a_probe_that_appears_inside_is_found_however_deep() {
    for body in [body(icosphere(0.05, 3)), body(block(DVec3::splat(0.1), 10)), body(bumpy(3))] {
        for p in [DVec3::new(0.001, 0.002, 0.003), DVec3::new(-0.01, 0.01, 0.005)] {
            let step = touch(&body, p);
            assert_eq!(step.mode, Mode::Contact);
            let (_, distance) = body.index().closest(body.mesh(), p, 1.0).expect("inside");
            assert!(step.depth_m >= RADIUS_M + 0.9 * distance, "{} at {distance}", step.depth_m);
            assert!(step.force_n.is_finite());
        }
    }
}

#[test]
fn a_probe_pushed_through_a_thin_lobe_does_not_come_out_of_the_other_side() {
    let slab = body(block(DVec3::new(0.2, 0.2, 0.008), 20));
    let above = |z: f64| DVec3::new(0.003, 0.004, z);
    let steps = drive(&slab, &mut Interaction::new(), above(0.02), above(-0.03), 1e-4);
    let last = steps.last().expect("steps");
    assert!((last.depth_m - (RADIUS_M + 0.004 + 0.03)).abs() < 1e-12, "{}", last.depth_m);
    assert!(last.normal.distance(DVec3::Z) < 1e-12);
    // One that appears there belongs to the near side.
    assert_eq!(touch(&slab, above(-0.03)).mode, Mode::None);
    assert!(touch(&slab, above(-0.003)).normal.distance(-DVec3::Z) < 1e-12);
}

#[test]
fn separation_resets_the_memory() {
    let slab = body(block(DVec3::new(0.2, 0.2, 0.008), 20));
    let above = |z: f64| DVec3::new(0.003, 0.004, z);
    let mut interaction = Interaction::new();
    drive(&slab, &mut interaction, above(0.02), above(-0.002), 1e-4);
    interaction.step(&slab, &tissue(), 1000 * MS, above(0.0091), false).expect("an answer");
    assert_eq!(interaction.impressions().count(), 0, "lifted off");
    let step = interaction.step(&slab, &tissue(), 1001 * MS, above(-0.002), false).expect("an answer");
    assert!(step.normal.distance(-DVec3::Z) < 1e-12, "now the other side is nearer");
}

#[test]
fn the_tip_of_a_cone_of_a_thousand_faces_can_be_pressed() {
    let n = 1000u32;
    let rim = |k: u32| {
        let angle = f64::from(k) / f64::from(n) * std::f64::consts::TAU;
        DVec3::new(libm::cos(angle), libm::sin(angle), 0.0) * 0.05
    };
    let mut vertices: Vec<DVec3> = (0..n).map(rim).collect();
    vertices.extend([DVec3::Z * 0.02, -DVec3::Z * 0.02]);
    let sides = |k: u32| [[k, (k + 1) % n, n], [(k + 1) % n, k, n + 1]];
    let body = body((vertices, (0..n).flat_map(sides).collect()));
    let mut interaction = Interaction::new();
    let above = |depth_m: f64| DVec3::new(1e-5, 0.0, 0.02 + RADIUS_M - depth_m);
    for step in drive(&body, &mut interaction, above(0.0005), above(0.004), 1e-5) {
        assert_eq!(step.mode, Mode::Contact);
        assert!(step.normal.angle_between(DVec3::Z) < 0.1);
    }
}

/// Slides `body`'s surface in steps of `step_m`, pressed in by `depth_m`, and returns the largest change of
/// force in one step, as a multiple of what the change of position alone would give on a flat side.
fn worst_change(body: &Body, depth_m: f64, step_m: f64, seed: u64) -> f64 {
    let (tissue, mut random) = (tissue(), Random(seed));
    let stiffness = tissue.law().at_depth(depth_m).expect("finite").stiffness_n_per_m;
    let mut worst: f64 = 0.0;
    for _ in 0..12 {
        let at = random.surface_point(body.mesh());
        let mut probe = body.mesh().position(at) + body.mesh().normal(at) * (RADIUS_M - 1e-4);
        let (mut interaction, mut direction) = (Interaction::new(), random.direction());
        let mut last = interaction.step(body, &tissue, 0, probe, false).expect("an answer");
        for k in 1..3000 {
            direction = (direction - last.normal * direction.dot(last.normal)).normalize_or_zero();
            let inward = (depth_m - last.depth_m).clamp(-step_m, step_m) / step_m;
            probe += (direction - last.normal * inward).normalize_or_zero() * step_m;
            let step = interaction.step(body, &tissue, k * MS, probe, false).expect("an answer");
            assert_eq!(step.mode, Mode::Contact);
            worst = worst.max((step.force_n - last.force_n).length() / (stiffness * step_m));
            last = step;
        }
    }
    worst
}

#[test]
fn the_force_changes_continuously_while_the_probe_slides() {
    // Pressed in by the probe's radius at most: its centre stays outside, where the normals do not cross.
    for (name, body, allowed) in [
        ("sphere of 80 faces", body(icosphere(0.05, 1)), 1.5),
        ("block", body(block(DVec3::splat(0.1), 4)), 2.5),
        ("fine block", body(block(DVec3::splat(0.1), 40)), 6.0),
        ("bumpy body", body(bumpy(3)), 12.0),
    ] {
        for depth_m in [0.001, 0.0049] {
            for step_m in [1e-5, 1e-6] {
                let worst = worst_change(&body, depth_m, step_m, 5);
                // A jump would be a hundred times larger at a tenth of the step.
                assert!(
                    worst < allowed,
                    "{name}: {worst} times the stiffness, depth {depth_m}, step {step_m}"
                );
            }
        }
    }
}

#[test]
fn the_force_changes_continuously_with_depth() {
    let body = body(bumpy(3));
    let mut random = Random(8);
    for _ in 0..20 {
        let at = random.surface_point(body.mesh());
        let (out, normal) = (body.mesh().position(at), body.mesh().normal(at));
        let steps = drive(&body, &mut Interaction::new(), out + normal * 0.006, out + normal * 0.0005, 1e-6);
        for pair in steps.windows(2) {
            let change = (pair[1].force_n - pair[0].force_n).length();
            assert!(change < 10.0 * 600.0 * 1e-6, "{change}");
        }
        assert!(steps.last().expect("steps").depth_m > 0.004);
    }
}

#[test]
fn the_local_law_gives_the_force_of_the_step_and_its_stiffness() {
    let body = body(bumpy(3));
    let (tissue, mut random) = (tissue(), Random(3));
    for _ in 0..500 {
        let at = random.surface_point(body.mesh());
        // From touching to deeper than the surface's curvature allows.
        let probe = body.mesh().position(at) + body.mesh().normal(at) * (RADIUS_M - 0.025 * random.unit());
        let step = touch(&body, probe);
        if step.mode == Mode::None {
            continue;
        }
        let force = step.local_law.force_n(tissue.law(), probe);
        assert!(
            force.distance(step.force_n) <= 1e-12 * (1.0 + step.force_n.length()),
            "{force} {}",
            step.force_n
        );
        assert!((step.local_law.depth_m(probe) - step.depth_m).abs() < 1e-15);
        assert_eq!((step.local_law.stiffness_factor, step.local_law.depth_offset_m), (1.0, 0.0));
        // And a straight line's worth around it.
        let nearer = step.local_law.force_n(tissue.law(), probe - step.normal * 1e-7);
        let slope = (nearer.length() - force.length()) / 1e-7;
        assert!((slope - step.stiffness_n_per_m).abs() < 1e-3 * step.stiffness_n_per_m);
        assert_eq!(step.local_law.force_n(tissue.law(), probe + step.normal), DVec3::ZERO, "lifted off");
    }
    assert_eq!(LocalLaw::default().force_n(tissue.law(), DVec3::ONE), DVec3::ZERO);
}

#[test]
fn equal_states_and_inputs_give_equal_bits() {
    let body = body(bumpy(3));
    let (tissue, mut random) = (tissue(), Random(4));
    let mut first = Interaction::new();
    for k in 0..2000 {
        let at = random.surface_point(body.mesh());
        let probe = body.mesh().position(at) + body.mesh().normal(at) * 0.01 * (random.unit() - 0.3);
        let grasp = random.unit() < 0.3;
        let mut second = first.clone();
        let answers = [&mut first, &mut second]
            .map(|interaction| interaction.step(&body, &tissue, k * MS, probe, grasp).expect("an answer"));
        assert_eq!(
            answers[0].force_n.to_array().map(f64::to_bits),
            answers[1].force_n.to_array().map(f64::to_bits)
        );
        assert_eq!(answers[0], answers[1]);
        assert_eq!(first, second);
    }
}

#[test]
fn a_stamp_may_repeat_but_not_go_back() {
    let body = body(block(DVec3::splat(0.1), 4));
    let (tissue, mut interaction) = (tissue(), Interaction::new());
    let probe = DVec3::new(0.0, 0.0, 0.052);
    let first = interaction.step(&body, &tissue, 7 * MS, probe, false).expect("an answer");
    let again = interaction.step(&body, &tissue, 7 * MS, probe, false).expect("an answer");
    assert_eq!(first, again);
    let before = interaction.clone();
    let error = interaction.step(&body, &tissue, 6 * MS, probe, false).expect_err("goes back");
    assert_eq!(error, StepError::StampWentBack { previous_ns: 7 * MS, stamp_ns: 6 * MS });
    assert!(error.to_string().contains("6000000 ns comes after 7000000 ns"), "{error}");
    assert_eq!(interaction, before, "nothing has changed");
    interaction.reset();
    assert_eq!(interaction, Interaction::new());
    assert!(interaction.step(&body, &tissue, i64::MIN, probe, false).is_ok());
    assert!(interaction.step(&body, &tissue, i64::MAX, probe, true).is_ok());
}

#[test]
fn a_position_that_is_no_place_is_refused_and_changes_nothing() {
    let body = body(block(DVec3::splat(0.1), 4));
    let (tissue, mut interaction) = (tissue(), Interaction::new());
    interaction.step(&body, &tissue, 0, DVec3::new(0.0, 0.0, 0.052), false).expect("an answer");
    let before = interaction.clone();
    for bad in [f64::NAN, f64::INFINITY, 1e300, -2e6] {
        let error =
            interaction.step(&body, &tissue, MS, DVec3::new(0.0, bad, 0.0), false).expect_err("no place");
        assert!(matches!(error, StepError::Position(_)), "{error:?}");
        assert_eq!(interaction, before);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    #[test]
    fn no_leap_of_the_probe_leads_to_anything_but_a_finite_answer(
        leaps in prop::collection::vec((-1.0f64..1.0, -1.0f64..1.0, -1.0f64..1.0, -6i32..7, any::<bool>()), 1..40),
    ) {
        let (body, tissue, mut interaction) = (body(bumpy(2)), tissue(), Interaction::new());
        for (k, (x, y, z, exponent, grasp)) in leaps.into_iter().enumerate() {
            let probe = DVec3::new(x, y, z) * 10f64.powi(exponent);
            let step = interaction.step(&body, &tissue, k as i64 * 20 * MS, probe, grasp).expect("an answer");
            let numbers = [step.force_n, step.proxy, step.normal, step.local_law.anchor];
            prop_assert!(numbers.iter().all(|v| v.is_finite()) && step.depth_m.is_finite());
            if let Some(at) = step.surface_point {
                prop_assert!(at.barycentric.min_element() >= 0.0);
                prop_assert!((at.barycentric.element_sum() - 1.0).abs() < 1e-12);
                prop_assert!((step.normal.length() - 1.0).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn a_probe_that_leaps_farther_than_it_can_be_followed_is_answered_like_a_new_contact() {
    let body = body(icosphere(0.05, 6));
    let pressed_at = |direction: DVec3| direction * (0.05 + RADIUS_M - 0.003);
    let mut interaction = Interaction::new();
    interaction.step(&body, &tissue(), 0, pressed_at(DVec3::Z), false).expect("an answer");
    let elsewhere = pressed_at(DVec3::new(0.1, 0.05, -1.0).normalize_or_zero());
    let leapt = interaction.step(&body, &tissue(), MS, elsewhere, false).expect("an answer");
    assert_eq!(leapt, touch(&body, elsewhere));
    assert!((leapt.depth_m - 0.003).abs() < 1e-4, "{}", leapt.depth_m);
}
