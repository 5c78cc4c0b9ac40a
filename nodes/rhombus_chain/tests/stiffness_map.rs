//! Regional stiffness: the factor, its gradient through the proxy, and what contact, grasp and motor loop make of it.
#![allow(clippy::expect_used, reason = "a helper that cannot go on stops its test")]

mod common;

use common::{Random, block, body, bumpy, icosphere, tissue};
use glam::DVec3;
use rhombus_chain::{Body, Interaction, LocalLaw, Mode, Step, StiffnessMap, StiffnessMapError, SurfaceMesh};

const RADIUS_M: f64 = 0.005;
const MS: i64 = 1_000_000;

/// `body` with the factor `factor` says at each vertex.
fn mapped(body: Body, mut factor: impl FnMut(DVec3) -> f64) -> Body {
    let factors = body.mesh().vertices().iter().map(|p| factor(*p)).collect();
    let map = StiffnessMap::new(factors, body.mesh()).expect("accepted factors");
    body.with_stiffness(map).expect("its own map")
}

fn touch(body: &Body, probe: DVec3) -> Step {
    Interaction::new().step(body, &tissue(), 0, probe, false).expect("an answer")
}

/// A probe over a random point, pressed in by up to 4.5 mm.
fn random_probe(mesh: &SurfaceMesh, random: &mut Random) -> DVec3 {
    let at = random.surface_point(mesh);
    mesh.position(at) + mesh.normal(at) * (RADIUS_M - 0.0005 - 0.004 * random.unit())
}

#[test]
fn a_body_that_is_three_times_as_stiff_everywhere_pushes_with_three_times_the_force() {
    let plain = body(bumpy(3));
    let stiff = mapped(plain.clone(), |_| 3.0);
    let mut random = Random(21);
    for _ in 0..500 {
        let probe = random_probe(plain.mesh(), &mut random);
        let (one, three) = (touch(&plain, probe), touch(&stiff, probe));
        assert!(three.force_n.distance(one.force_n * 3.0) <= 1e-14 * three.force_n.length());
        assert!(
            (three.stiffness_n_per_m - 3.0 * one.stiffness_n_per_m).abs() <= 1e-12 * three.stiffness_n_per_m
        );
        assert!((three.normal_force_n - 3.0 * one.normal_force_n).abs() <= 1e-14 * three.normal_force_n);
        assert_eq!((three.depth_m, three.surface_point), (one.depth_m, one.surface_point));
    }
}

#[test]
fn a_map_of_ones_changes_no_bit() {
    let plain = body(bumpy(3));
    let ones = mapped(plain.clone(), |_| 1.0);
    let mut random = Random(22);
    for _ in 0..500 {
        let probe = random_probe(plain.mesh(), &mut random);
        assert_eq!(touch(&plain, probe), touch(&ones, probe));
    }
}

#[test]
fn the_force_is_the_law_times_the_factor_less_the_energy_times_the_gradient() {
    let body = mapped(body(block(DVec3::splat(0.1), 10)), |p| 2.0 + 10.0 * p.x - 6.0 * p.y);
    for depth_m in [1e-4, 1e-3, 4e-3] {
        let (x, y) = (0.013, -0.007);
        let step = touch(&body, DVec3::new(x, y, 0.05 + RADIUS_M - depth_m));
        let law = tissue().law().at_depth(depth_m).expect("finite");
        let factor = 2.0 + 10.0 * x - 6.0 * y;
        let expected = DVec3::new(-10.0 * law.energy_j, 6.0 * law.energy_j, factor * law.force_n);
        assert!(step.force_n.distance(expected) < 1e-12 * expected.length(), "{} {expected}", step.force_n);
        assert!((step.normal_force_n - factor * law.force_n).abs() < 1e-12);
        assert!((step.stiffness_n_per_m - factor * law.stiffness_n_per_m).abs() < 1e-9);
        assert!((step.local_law.stiffness_factor - factor).abs() < 1e-12);
    }
}

/// Central difference of the factor along the three axes, with the contact followed.
fn difference(body: &Body, probe: DVec3, by_m: f64) -> DVec3 {
    let factor = |offset: DVec3| {
        let mut interaction = Interaction::new();
        interaction.step(body, &tissue(), 0, probe, false).expect("an answer");
        let step = interaction.step(body, &tissue(), MS, probe + offset, false).expect("an answer");
        step.local_law.stiffness_factor
    };
    let along = |axis: DVec3| (factor(axis * by_m) - factor(-axis * by_m)) / (2.0 * by_m);
    DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z))
}

#[test]
fn the_gradient_is_that_of_the_factor_under_a_probe_that_moves() {
    for (name, plain) in [("sphere", body(icosphere(0.05, 3))), ("bumpy", body(bumpy(3)))] {
        let mut random = Random(23);
        let body = mapped(plain, |_| 0.5 + 4.0 * random.unit());
        let mut random = Random(24);
        for _ in 0..300 {
            let probe = random_probe(body.mesh(), &mut random);
            let step = touch(&body, probe);
            let gradient = step.local_law.stiffness_gradient_per_m;
            let weights = step.surface_point.expect("touched").barycentric;
            if weights.min_element() < 0.01 {
                continue; // the difference would look over the edge, where another gradient begins
            }
            let error = difference(&body, probe, 1e-7).distance(gradient);
            assert!(error < 1e-5 * gradient.length(), "{name}: {error} of {gradient}");
            assert!(gradient.dot(step.normal).abs() < 1e-9 * gradient.length(), "{name}");
        }
    }
}

#[test]
fn under_a_probe_as_deep_as_the_radius_of_curvature_the_gradient_stays_bounded() {
    let sphere = icosphere(0.004, 2);
    let body = mapped(body(sphere), |p| 1.0 + 100.0 * p.x.abs());
    let plane = 100.0 * 1.1;
    let mut random = Random(25);
    for _ in 0..2000 {
        let step = touch(&body, random.direction() * 0.004 * random.unit());
        let local = step.local_law;
        assert!(local.stiffness_gradient_per_m.length() <= 10.0 * plane);
        assert!(step.force_n.is_finite());
    }
}

#[test]
fn the_law_for_the_motor_loop_gives_the_force_of_the_step() {
    let mut random = Random(26);
    let body = mapped(body(bumpy(3)), |_| 0.5 + 4.0 * random.unit());
    for _ in 0..500 {
        let probe = random_probe(body.mesh(), &mut random);
        let step = touch(&body, probe);
        assert!(step.local_law.force_n(tissue().law(), probe).distance(step.force_n) < 1e-12);
    }
}

#[test]
fn the_force_of_the_law_for_the_motor_loop_is_the_gradient_of_its_energy() {
    let law = LocalLaw {
        mode: Mode::Contact,
        normal: DVec3::Z,
        probe_radius_m: RADIUS_M,
        stiffness_factor: 2.0,
        stiffness_gradient_per_m: DVec3::new(150.0, -80.0, 0.0),
        ..LocalLaw::default()
    };
    let tissue = tissue();
    let energy = |probe: DVec3| {
        let response = tissue.law().at_depth(law.depth_m(probe)).expect("finite");
        law.factor(probe) * response.energy_j
    };
    for probe in [DVec3::new(0.0, 0.0, 0.002), DVec3::new(0.003, 0.004, 0.001), DVec3::new(-0.02, 0.0, 0.003)]
    {
        let by_m = 1e-7;
        let along = |axis: DVec3| (energy(probe - axis * by_m) - energy(probe + axis * by_m)) / (2.0 * by_m);
        let expected = DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z));
        assert!(law.force_n(tissue.law(), probe).distance(expected) < 1e-6, "{probe}");
    }
    let beyond = DVec3::new(-0.02, 0.0, 0.003);
    assert_eq!(
        (law.factor(beyond), law.force_n(tissue.law(), beyond)),
        (0.0, DVec3::ZERO),
        "never a negative factor"
    );
    for absurd in [DVec3::splat(1e308), DVec3::new(1e308, 0.0, -1e308)] {
        assert!(law.force_n(tissue.law(), absurd).is_finite());
    }
}

#[test]
fn a_held_body_is_as_stiff_as_at_the_held_point_wherever_the_probe_goes() {
    let plain = body(block(DVec3::splat(0.1), 10));
    let body = mapped(plain.clone(), |p| 2.0 + 10.0 * p.x);
    let probe = DVec3::new(0.011, 0.007, 0.05 + RADIUS_M - 0.003);
    let factor = 2.11;
    let answers = |body: &Body| {
        let mut interaction = Interaction::new();
        let mut step = |ms: i64, probe: DVec3, grasp: bool| {
            interaction.step(body, &tissue(), ms * MS, probe, grasp).expect("an answer")
        };
        let open = step(0, probe, false);
        let held = step(1, probe, true);
        (open, held, step(60, probe + DVec3::new(0.004, -0.002, 0.003), true))
    };
    let (open, held, moved) = answers(&body);
    assert_eq!(held.mode, Mode::Grasp);
    assert!(held.force_n.distance(open.force_n) < 1e-12, "closing the gripper changes no force");
    assert!(open.force_n.x < 0.0, "pushed to the soft side");
    let (_, _, unmapped) = answers(&plain);
    assert!(moved.force_n.distance(unmapped.force_n * factor) < 1e-12 * moved.force_n.length());
    assert_eq!(moved.local_law.stiffness_gradient_per_m, DVec3::ZERO);
    let lateral = factor * tissue().lateral_stiffness_n_per_m();
    assert!((moved.local_law.lateral_stiffness_n_per_m - lateral).abs() < 1e-9);
}

#[test]
fn while_the_gripper_closes_the_force_goes_to_that_of_the_held_point_without_a_jump() {
    let body = mapped(body(block(DVec3::splat(0.1), 10)), |p| 2.0 + 100.0 * (p.x + 0.05));
    let probe = DVec3::new(0.011, 0.007, 0.05 + RADIUS_M - 0.003);
    let mut interaction = Interaction::new();
    let mut last = interaction.step(&body, &tissue(), 0, probe, false).expect("an answer");
    let first = last.force_n.length();
    for ms in 1..60 {
        let step = interaction.step(&body, &tissue(), ms * MS, probe, true).expect("an answer");
        assert!(step.force_n.distance(last.force_n) < 2.5 * first / 50.0, "{ms} ms");
        assert!(step.local_law.force_n(tissue().law(), probe).distance(step.force_n) < 1e-12);
        last = step;
    }
    assert!(last.force_n.length() < 1e-12);
}

#[test]
fn factors_that_cannot_be_meant_are_refused() {
    let plain = body(block(DVec3::splat(0.1), 2));
    let mesh = plain.mesh();
    let vertices = mesh.vertices().len();
    assert_eq!(
        StiffnessMap::new(vec![1.0; vertices - 1], mesh),
        Err(StiffnessMapError::Count { factors: vertices - 1, vertices })
    );
    for factor in [0.0, -1.0, 0.9e-3, 1.1e3, f64::INFINITY] {
        let mut factors = vec![1.0; vertices];
        factors[7] = factor;
        assert_eq!(StiffnessMap::new(factors, mesh), Err(StiffnessMapError::Factor { vertex: 7, factor }));
    }
    let mut factors = vec![1.0; vertices];
    factors[0] = f64::NAN;
    let error = StiffnessMap::new(factors, mesh).expect_err("no number");
    assert!(error.to_string().starts_with("stiffness factor NaN of vertex 0 "), "{error}");
    let other = body(block(DVec3::splat(0.1), 3));
    let map = StiffnessMap::new(vec![1.0; vertices], mesh).expect("accepted factors");
    assert!(matches!(other.with_stiffness(map), Err(StiffnessMapError::OtherMesh { .. })));
}

#[test]
fn the_extremes_are_accepted_and_between_vertices_the_factor_is_linear() {
    let plain = body(block(DVec3::splat(0.1), 2));
    let mesh = plain.mesh();
    let factors: Vec<f64> = (0..mesh.vertices().len()).map(|v| if v % 2 == 0 { 1e-3 } else { 1e3 }).collect();
    let map = StiffnessMap::new(factors.clone(), mesh).expect("the extremes");
    assert_eq!(map.range(), (1e-3, 1e3));
    let mut random = Random(27);
    for _ in 0..100 {
        let at = random.surface_point(mesh);
        let corners = mesh.triangles()[at.face as usize].map(|v| factors[v as usize]);
        let expected: f64 = corners.iter().zip(at.barycentric.to_array()).map(|(c, b)| c * b).sum();
        assert!((map.at(&at) - expected).abs() < 1e-12 * 1e3);
    }
}
