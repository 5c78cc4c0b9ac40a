//! Calibrated bodies: the contact moves by its depth, directions turn with the body, nothing jumps.
#![allow(clippy::expect_used, reason = "a helper that cannot go on stops its test")]

mod calibrated;
mod common;

use calibrated::{Pressed, calibrated, mesh, plain, press, tissue, turned};
use common::{Random, body, bumpy, icosphere, surface, tissue_with};
use glam::{DMat3, DVec3};
use rhombus_chain::{Body, Response, ResponseError, ResponseParts, Spread, SurfacePoint, tangent_frame};

#[test]
fn equal_shares_and_no_direction_are_the_normal_motion_of_parallel_chains() {
    let tissue = tissue();
    let classic = body(bumpy(4));
    let calibrated = calibrated(classic.mesh().clone(), plain(classic.mesh(), 0));
    let (mut one, mut other) = (Pressed::new(&classic, &tissue), Pressed::new(&calibrated, &tissue));
    let mut random = Random(3);
    for _ in 0..100 {
        let at = random.surface_point(classic.mesh());
        let press = press(classic.mesh(), at, 0.005);
        let (one, other) = (one.by(&[press]), other.by(&[press]));
        for (one, other) in one.iter().zip(&other) {
            let across = *other - press.normal * other.dot(press.normal);
            assert!(across.length() < 1e-9, "{across}");
            // Arcs that are interpolated between the corners of the face.
            let difference = (one - other).dot(press.normal).abs();
            assert!(difference < 0.03 * 0.005, "{difference} m");
        }
    }
}

#[test]
fn the_contact_moves_by_exactly_its_depth() {
    let tissue = tissue();
    let mesh = mesh(bumpy(4));
    let body = calibrated(mesh.clone(), turned(&mesh, DMat3::IDENTITY));
    let mut pressed = Pressed::new(&body, &tissue);
    for face in (0..mesh.triangles().len() as u32).step_by(97) {
        let at = SurfacePoint { face, barycentric: DVec3::Y };
        let vertex = mesh.triangles()[face as usize][1] as usize;
        for depth_m in [0.005, -0.003] {
            let press = press(&mesh, at, depth_m);
            let moved = pressed.by(&[press])[vertex];
            assert!(moved.distance(press.normal * -depth_m) < 1e-9, "{moved} at {face}");
        }
    }
}

#[test]
fn a_body_that_is_turned_moves_as_before_turned() {
    let tissue = tissue();
    let (vertices, triangles) = bumpy(3);
    let straight = mesh((vertices.clone(), triangles.clone()));
    let rest = calibrated(straight.clone(), turned(&straight, DMat3::IDENTITY));
    // Onto the axes too, where a frame made from an axis has to look elsewhere.
    for (axis, angle) in
        [(DVec3::Z, 1.1), (DVec3::Y, std::f64::consts::FRAC_PI_2), (DVec3::new(0.6, 0.0, 0.8), 2.0)]
    {
        let rotation = DMat3::from_axis_angle(axis, angle);
        let mesh = mesh((vertices.iter().map(|v| rotation * *v).collect(), triangles.clone()));
        let body = calibrated(mesh.clone(), turned(&mesh, rotation));
        let (mut one, mut other) = (Pressed::new(&rest, &tissue), Pressed::new(&body, &tissue));
        let mut random = Random(5);
        for _ in 0..100 {
            let at = random.surface_point(&mesh);
            let one = one.by(&[press(&straight, at, 0.005)]);
            let other = other.by(&[press(&mesh, at, 0.005)]);
            for (one, other) in one.iter().zip(&other) {
                assert!((rotation * *one).distance(*other) < 1e-7, "{one} and {other}");
            }
        }
    }
}

#[test]
fn where_the_normal_is_an_axis_nothing_is_special() {
    // The top, bottom and sides of a sphere: contacts that move over them by little move the field by little.
    let tissue = tissue();
    let mesh = mesh(icosphere(0.06, 4));
    let body = calibrated(mesh.clone(), turned(&mesh, DMat3::IDENTITY));
    let mut pressed = Pressed::new(&body, &tissue);
    for axis in [DVec3::X, -DVec3::X, DVec3::Y, DVec3::Z, -DVec3::Z] {
        let [first, second] = tangent_frame(axis);
        let mut before: Option<(DVec3, Vec<DVec3>)> = None;
        for step in 0..400 {
            let turn = f64::from(step) * 0.05;
            let aim = axis + (first * libm::cos(turn) + second * libm::sin(turn)) * 1e-4 * f64::from(step);
            let at = body.index().closest(&mesh, aim * 0.06, f64::INFINITY).expect("a place").0;
            let press = press(&mesh, at, 0.005);
            let now = pressed.by(&[press]);
            if let Some((place, before)) = &before {
                let moved = place.distance(press.position);
                let most = now.iter().zip(before).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
                assert!(most <= 6.0 * moved * 0.005 / 0.004 + 1e-8, "{most} m for {moved} m at {axis}");
            }
            before = Some((press.position, now));
        }
    }
}

#[test]
fn a_contact_that_crosses_edges_and_vertices_moves_the_field_by_little() {
    let tissue = tissue();
    let mesh = mesh(bumpy(4));
    let body = calibrated(mesh.clone(), turned(&mesh, DMat3::IDENTITY));
    let mut pressed = Pressed::new(&body, &tissue);
    let mut random = Random(8);
    for _ in 0..20 {
        let (from, to) =
            (mesh.position(random.surface_point(&mesh)), mesh.position(random.surface_point(&mesh)));
        let way = (to - from).normalize_or_zero();
        let mut before: Option<(DVec3, Vec<DVec3>)> = None;
        for step in 0..400 {
            let aim = from + way * (1e-4 * f64::from(step));
            let at = body.index().closest(&mesh, aim, f64::INFINITY).expect("a place").0;
            let press = press(&mesh, at, 0.005);
            let now = pressed.by(&[press]);
            if let Some((place, before)) = &before {
                let moved = place.distance(press.position);
                if moved < 5e-4 {
                    let most = now.iter().zip(before).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
                    assert!(most <= 10.0 * moved * 0.005 / 0.004 + 1e-8, "{most} m for {moved} m");
                }
            }
            before = Some((press.position, now));
        }
    }
}

#[test]
fn twice_the_amplitudes_are_twice_the_modes_and_displacements_of_two_contacts_add() {
    let tissue = tissue();
    let mesh = mesh(bumpy(3));
    let with = |amplitude: f32| {
        let mut parts = turned(&mesh, DMat3::IDENTITY);
        parts.amplitudes.iter_mut().for_each(|z| *z *= amplitude);
        calibrated(mesh.clone(), parts)
    };
    let mut random = Random(4);
    let presses = [0.004, 0.006].map(|depth_m| press(&mesh, random.surface_point(&mesh), depth_m));
    let [none, once, twice] =
        [0.0, 1.0, 2.0].map(|amplitude| Pressed::new(&with(amplitude), &tissue).by(&presses[..1]));
    for ((none, once), twice) in none.iter().zip(&once).zip(&twice) {
        assert!(((twice - none) - (once - none) * 2.0).length() < 1e-9);
    }
    let body = with(1.0);
    let mut pressed = Pressed::new(&body, &tissue);
    let (both, other) = (pressed.by(&presses), pressed.by(&presses[1..]));
    for ((both, once), other) in both.iter().zip(&once).zip(&other) {
        assert_eq!(*both, *once + *other);
    }
}

#[test]
fn numbers_that_fit_no_body_are_refused_with_their_place() {
    let mesh = mesh(bumpy(2));
    let refused = |change: &dyn Fn(&mut ResponseParts)| {
        let mut parts = turned(&mesh, DMat3::IDENTITY);
        change(&mut parts);
        Response::new(parts, &mesh).expect_err("refused").to_string()
    };
    assert!(refused(&|parts| parts.chains = 0).starts_with("0 chains; accepted: 1 to 8"));
    assert!(refused(&|parts| parts.harmonics = 3).contains("3 harmonics"));
    assert!(refused(&|parts| parts.coefficients.truncate(5)).contains("coefficients; accepted"));
    assert!(refused(&|parts| parts.modes = 1).contains("amplitudes"));
    assert!(refused(&|parts| parts.mode_fields.clear()).contains("body modes"));
    assert!(refused(&|parts| parts.amplitudes[5] = f32::NAN).contains("amplitudes of vertex 2"));
    assert!(refused(&|parts| parts.coefficients[0] = 1e5).contains("vertex 0"));
    assert!(refused(&|parts| parts.coefficients[0] += 0.01).contains("add up to"));
    let other = common::body(bumpy(3));
    let response = Response::new(plain(&mesh, 1), &mesh).expect("accepted");
    assert!(matches!(other.with_response(response), Err(ResponseError::OtherMesh { .. })));
}

#[test]
fn a_scene_with_other_chains_than_the_response_moves_as_without_one() {
    let mesh = mesh(bumpy(3));
    let body = calibrated(mesh.clone(), plain(&mesh, 1));
    let two = tissue_with(2, surface(0.0, Spread::Geodesic));
    let press = press(&mesh, SurfacePoint { face: 7, barycentric: DVec3::splat(1.0 / 3.0) }, 0.004);
    let without = Body::new(mesh);
    assert_eq!(Pressed::new(&body, &two).by(&[press]), Pressed::new(&without, &two).by(&[press]));
}
