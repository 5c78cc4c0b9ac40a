//! What runs while a device waits for its force allocates nothing.
#![allow(clippy::expect_used, reason = "a helper that cannot go on stops its test")]

mod calibrated;
mod common;

use assert_no_alloc::{AllocDisabler, assert_no_alloc};
use calibrated::{CHAINS, calibrated, press, turned};
use common::{Random, body, bumpy, surface, tissue_with};
use glam::{DMat3, DVec3};
use rhombus_chain::{ArcLengths, Interaction, Mode, Spread, StiffnessMap, SurfaceField};

#[global_allocator]
static GUARD: AllocDisabler = AllocDisabler;

#[test]
fn no_pose_and_no_surface_allocates_after_construction() {
    let body = body(bumpy(4));
    let factors = body.mesh().vertices().iter().map(|p| 1.0 + 10.0 * p.x.abs()).collect();
    let map = StiffnessMap::new(factors, body.mesh()).expect("accepted factors");
    let body = body.with_stiffness(map).expect("its own map");
    for spread in [Spread::Geodesic, Spread::Rings] {
        for expansion in [0.0, 0.5] {
            let tissue = tissue_with(3, surface(expansion, spread));
            let (mut interaction, mut random) = (Interaction::new(), Random(1));
            let mut field = SurfaceField::new(&body, &tissue);
            let mut modes = [0; 3];
            for k in 0..3000 {
                let at = random.surface_point(body.mesh());
                // From 13 mm above the surface to 7 mm below; every now and then a leap.
                let probe =
                    body.mesh().position(at) + body.mesh().normal(at) * (0.02 * random.unit() - 0.007);
                let grasp = k % 100 > 60;
                let step = assert_no_alloc(|| {
                    let step = interaction.step(&body, &tissue, k * 1_000_000, probe, grasp);
                    let force =
                        step.map(|step| step.local_law.force_n(tissue.law(), probe)).unwrap_or_default();
                    assert!(force.is_finite());
                    step
                })
                .expect("an answer");
                modes[step.mode as usize] += 1;
                // The first impression of a kind of its own makes room for itself: a second one while a grasp
                // fades.
                if k % 20 == 0 && interaction.impressions().count() < 2 {
                    assert_no_alloc(|| field.update(&body, &tissue, interaction.impressions()));
                }
            }
            assert!(
                modes.iter().all(|count| *count > 100),
                "{modes:?} of {:?}",
                [Mode::None, Mode::Contact, Mode::Grasp]
            );
        }
    }
}

#[test]
fn no_refusal_and_no_query_of_the_index_or_the_arcs_allocates() {
    let body = body(bumpy(4));
    let tissue = tissue_with(1, surface(0.0, Spread::Geodesic));
    let mut arcs = ArcLengths::new(body.mesh());
    let mut interaction = Interaction::new();
    let mut random = Random(2);
    for _ in 0..200 {
        let at = random.surface_point(body.mesh());
        let p = body.mesh().position(at) * 0.9;
        assert_no_alloc(|| {
            assert!(body.index().closest(body.mesh(), p, f64::INFINITY).is_some());
            assert!(body.index().encloses(body.mesh(), p * 0.5));
            arcs.solve(body.mesh(), at, 1.0);
            assert_eq!(arcs.iter().len(), body.mesh().vertices().len());
            assert!(interaction.step(&body, &tissue, 0, DVec3::NAN, true).is_err());
            assert!(interaction.step(&body, &tissue, 5, p, false).is_ok());
            assert!(interaction.step(&body, &tissue, 4, p, false).is_err());
            interaction.reset();
        });
    }
}

#[test]
fn no_surface_of_a_calibrated_body_allocates_after_construction() {
    let mesh = body(bumpy(4)).mesh().clone();
    let mut without_modes = turned(&mesh, DMat3::IDENTITY);
    (without_modes.modes, without_modes.amplitudes, without_modes.mode_fields) = (0, Vec::new(), Vec::new());
    for parts in [turned(&mesh, DMat3::IDENTITY), without_modes] {
        let body = calibrated(mesh.clone(), parts);
        for expansion in [0.0, 0.5] {
            let tissue = tissue_with(CHAINS, surface(expansion, Spread::Geodesic));
            let (mut field, mut random) = (SurfaceField::new(&body, &tissue), Random(6));
            for _ in 0..200 {
                let at = random.surface_point(&mesh);
                let mut impression = press(&mesh, at, 0.01 * random.unit() - 0.003);
                impression.lateral_m = impression.normal.any_orthonormal_vector() * 1e-3;
                assert_no_alloc(|| field.update(&body, &tissue, [impression]));
                assert!(!field.vertices().is_empty());
            }
        }
    }
}
