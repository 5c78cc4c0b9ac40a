//! 10^5 random cases of what has to hold for every chain and body. `PROPTEST_CASES=10000000` asks for more.
//!
//! The residual of closed paths is a statistic of seeded paths, so that halving the step can be seen to quarter it.
#![allow(clippy::expect_used, clippy::panic, reason = "a test whose case cannot be set up fails")]
#![allow(clippy::print_stdout, reason = "what was measured")]

mod common;

use common::{Random, block, body, icosphere, tissue};
use glam::DVec3;
use proptest::prelude::*;
use rhombus_chain::checks::{ClosedPath, Extreme, Outcome, Work, outcome, work};
use rhombus_chain::{Body, StiffnessMap};

const RADIUS_M: f64 = 0.005;

fn cases() -> u32 {
    std::env::var("PROPTEST_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(100_000)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases()))]

    #[test]
    fn a_chain_is_accepted_and_total_or_refused_with_the_right_reason(
        numbers in prop::array::uniform10(0.0..1.0_f64)
    ) {
        let found = outcome(&Extreme::from_unit(numbers));
        prop_assert!(found.is_ok(), "{}", found.expect_err("a third outcome"));
    }
}

#[test]
fn the_random_chains_meet_every_outcome() {
    let mut random = Random(31);
    let mut counts = [0; 4];
    for _ in 0..2000 {
        let numbers = std::array::from_fn(|_| random.unit());
        counts[outcome(&Extreme::from_unit(numbers)).expect("no third outcome") as usize] += 1;
    }
    println!("accepted, snaps through, not rising, overflow: {counts:?} of 2000");
    assert!(counts.iter().all(|count| *count > 40), "{counts:?}");
    assert_eq!(Outcome::TangentialOverflow as usize, 3);
}

/// A build with debug assertions takes a tenth of the paths over mapped bodies; `tests/run` has both builds.
fn mapped_cases() -> u32 {
    if cfg!(debug_assertions) { cases().div_ceil(10) } else { cases() }
}

/// Root mean square of the net work as a share of what was exchanged.
fn residual(paths: u32, mut run: impl FnMut(&mut Random) -> Work) -> f64 {
    let mut squares = 0.0;
    for path in 0..paths {
        let Work { net_j, exchanged_j } = run(&mut Random(u64::from(path)));
        assert!(exchanged_j > 0.0 && net_j.is_finite(), "path {path} touches nothing");
        squares += (net_j / exchanged_j).powi(2);
    }
    (squares / f64::from(paths)).sqrt()
}

fn path(random: &mut Random, centre: DVec3, radius: DVec3) -> ClosedPath {
    ClosedPath::from_unit(std::array::from_fn(|_| random.unit()), centre, radius)
}

/// Over 30 mm of the block's top, up to 4.6 mm deep and now and then off the surface.
fn residual_on_the_block(paths: u32, body: &Body, steps: u32) -> f64 {
    let tissue = tissue();
    residual(paths, |random| {
        let (x, y) = (0.02 * random.unit() - 0.01, 0.02 * random.unit() - 0.01);
        let path = path(random, DVec3::new(x, y, 0.05 + RADIUS_M - 0.002), DVec3::new(0.015, 0.015, 0.0026));
        work(body, &tissue, steps, |share| path.at(share)).expect("accepted")
    })
}

/// Over a part of the sphere 25 degrees wide, as deep as on the block.
fn residual_on_the_sphere(paths: u32, body: &Body, steps: u32) -> f64 {
    let tissue = tissue();
    residual(paths, |random| {
        let towards = random.direction();
        let (u, v) = towards.any_orthonormal_pair();
        let path = path(random, DVec3::ZERO, DVec3::new(0.22, 0.22, 0.0026));
        let probe_at = |share| {
            let DVec3 { x, y, z } = path.at(share);
            (towards + u * x + v * y).normalize_or_zero() * (0.05 + RADIUS_M - 0.002 + z)
        };
        work(body, &tissue, steps, probe_at).expect("accepted")
    })
}

fn mapped(body: Body, mut factor: impl FnMut(DVec3) -> f64) -> Body {
    let factors = body.mesh().vertices().iter().map(|p| factor(*p)).collect();
    let map = StiffnessMap::new(factors, body.mesh()).expect("accepted factors");
    body.with_stiffness(map).expect("its own map")
}

/// Halving the step divides the error by four or more, and there is little of it.
fn assert_only_integration_error(what: &str, coarse: f64, fine: f64, little: f64) {
    println!("{what}: net work {coarse:.2e} of the exchanged, half the step {fine:.2e}");
    assert!(fine < 0.25 * coarse && fine < little, "{what}: {coarse:e}, then {fine:e}");
}

#[test]
fn on_a_flat_side_no_closed_path_of_depth_and_position_gives_or_takes_work() {
    let body = body(block(DVec3::splat(0.1), 5));
    let [coarse, fine] = [12, 24].map(|steps| residual_on_the_block(cases(), &body, steps));
    assert_only_integration_error("flat", coarse, fine, 1e-6);
}

#[test]
fn nor_does_it_where_every_vertex_has_its_own_stiffness() {
    let mut random = Random(77);
    let body = mapped(body(block(DVec3::splat(0.1), 5)), |_| 0.5 + 4.0 * random.unit());
    let [coarse, fine] = [12, 24].map(|steps| residual_on_the_block(mapped_cases(), &body, steps));
    assert_only_integration_error("flat with a map", coarse, fine, 1e-5);
}

/// A sphere of triangles: what is left is the interpolated normal's, which its facets do not have. With half the step and half
/// the edge it is a quarter.
#[test]
fn on_a_sphere_neither_but_for_its_facets() {
    let [coarse, fine] = [(3, 24), (4, 48)].map(|(subdivisions, steps)| {
        residual_on_the_sphere(cases(), &body(icosphere(0.05, subdivisions)), steps)
    });
    assert_only_integration_error("sphere", coarse, fine, 2e-3);
}

#[test]
fn on_a_sphere_that_is_stiffer_on_one_side_neither() {
    let [coarse, fine] = [(3, 12), (4, 24)].map(|(subdivisions, steps)| {
        let sphere = mapped(body(icosphere(0.05, subdivisions)), |p| 5.0 + 60.0 * p.x + 50.0 * p.y);
        residual_on_the_sphere(mapped_cases(), &sphere, steps)
    });
    assert_only_integration_error("sphere with a map", coarse, fine, 2e-3);
}
