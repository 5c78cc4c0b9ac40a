//! The surface around a contact: exact at the contact, falling to zero at a boundary that moves with depth, and continuous
//! in everything.
#![allow(clippy::expect_used, clippy::panic, reason = "a test whose case cannot be set up fails")]

mod chains;

use chains::{TISSUE, accepted_law, assert_close, decades, outermost_guards};
use proptest::prelude::*;
use rhombus_chain::{ChainParameters, ContactLaw, ContactShape, Formulation, Spread, SurfaceParameters};

const NO_BOUNDARY: SurfaceParameters =
    SurfaceParameters { cutoff: 0.0, expansion: 0.0, spread: Spread::Geodesic, contact_radius_m: 0.0 };
const BOUNDED: SurfaceParameters = SurfaceParameters { cutoff: 0.05, ..NO_BOUNDARY };

fn law(chains: &[ChainParameters]) -> ContactLaw {
    ContactLaw::new(Formulation::Energy, chains).expect("accepted")
}

fn shape_at(law: &ContactLaw, surface: &SurfaceParameters, depth_m: f64) -> ContactShape {
    let mut shape = ContactShape::new(law, surface).expect("a valid surface");
    shape.set_depth(law, depth_m).expect("a finite depth");
    shape
}

fn surfaces() -> impl Strategy<Value = SurfaceParameters> {
    let cutoff = prop_oneof![Just(0.0), 0.0..0.999_f64, decades(-12.0, -1.0)];
    let contact_radius = prop_oneof![Just(0.0), decades(-5.0, 0.0)];
    (cutoff, 0.0..=1.0_f64, contact_radius).prop_map(|(cutoff, expansion, contact_radius_m)| {
        SurfaceParameters { cutoff, expansion, spread: Spread::Geodesic, contact_radius_m }
    })
}

/// A law, a surface, and a depth from far past one guard to far past the other.
fn contacts() -> impl Strategy<Value = (ContactLaw, SurfaceParameters, f64)> {
    (accepted_law(), surfaces(), -2.0..2.0_f64, decades(-12.0, 0.0)).prop_map(
        |(law, surface, share, scale)| {
            let (deepest, furthest) = outermost_guards(&law);
            let depth_m = share * scale * if share > 0.0 { deepest } else { furthest };
            (law, surface, depth_m)
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn the_contact_moves_by_exactly_its_depth((law, surface, depth_m) in contacts()) {
        let shape = shape_at(&law, &surface, depth_m);
        let at_contact = shape.displacement(shape.s_m(0.0), 0.0);
        prop_assert_eq!(shape.normal_m(0.0), -depth_m);
        prop_assert_eq!(at_contact.normal_m, -depth_m);
        prop_assert_eq!(at_contact.tangential_m, 0.0);
        prop_assert_eq!(shape.displacement_at_ring(0.0), at_contact);
        let smallest_pitch = law.chains().iter().map(|chain| chain.parameters().pitch_m).fold(f64::MAX, f64::min);
        let just_off = shape.normal_m(1e-14 * smallest_pitch);
        prop_assert!((just_off + depth_m).abs() <= 1e-12 * depth_m.abs(), "{just_off:e}");
    }

    #[test]
    fn nothing_moves_at_the_boundary_or_beyond((law, surface, depth_m) in contacts(), beyond in 0.0..10.0_f64) {
        let shape = shape_at(&law, &surface, depth_m);
        let reach_m = shape.reach_m();
        let outside = shape.s_m(reach_m) * (1.0 + 1e-12) + beyond * reach_m;
        prop_assert_eq!(shape.displacement(outside, outside).normal_m, 0.0);
        prop_assert_eq!(shape.tangential_m(outside, outside), 0.0);
        prop_assert_eq!(shape.bump(outside), 0.0);
        // And it gets there without a jump.
        let inside = shape.boundary_m() * (1.0 - 1e-9);
        prop_assert!(shape.share(inside) <= 1e-6, "{:e}", shape.share(inside));
    }

    #[test]
    fn the_share_falls_from_one_to_zero((law, surface, depth_m) in contacts(), at in 0.0..1.1_f64, step in decades(-6.0, 0.0)) {
        let shape = shape_at(&law, &surface, depth_m);
        let (near, far) = (at * shape.boundary_m(), (at + step) * shape.boundary_m());
        let (high, low) = (shape.share(near), shape.share(far));
        prop_assert!((0.0..=1.0 + 1e-12).contains(&high));
        prop_assert!(low <= high + 1e-15, "{low:e} further out than {high:e}");
        prop_assert_eq!(shape.normal_m(near), -depth_m * high);
    }

    #[test]
    fn the_field_is_continuous_in_position((law, surface, depth_m) in contacts(), at in 0.0..1.1_f64) {
        let shape = shape_at(&law, &surface, depth_m);
        // The steepest chain falls by |ln q| / (1 - q) within its first unit.
        let steepest = law.chains().iter().map(|chain| {
            let (q, h) = (chain.parameters().ratio, chain.parameters().pitch_m);
            -libm::log(q) / (1.0 - q) / h
        }).fold(0.0, f64::max);
        let (arc, step) = (at * shape.reach_m(), 1e-9 / steepest);
        let (here, there) = (shape.displacement(shape.s_m(arc), arc), shape.displacement(shape.s_m(arc + step), arc + step));
        let largest = law.chains().iter().map(|chain| chain.response(-depth_m).dw_1_m.abs()).fold(0.0, f64::max);
        prop_assert!((here.normal_m - there.normal_m).abs() <= 1.1e-9 * depth_m.abs());
        prop_assert!((here.tangential_m - there.tangential_m).abs() <= 3e-9 * largest);
    }

    #[test]
    fn the_field_is_continuous_in_depth((law, surface, depth_m) in contacts(), at in 0.0..1.1_f64) {
        let further_m = depth_m * (1.0 + 1e-9);
        let (here, there) = (shape_at(&law, &surface, depth_m), shape_at(&law, &surface, further_m));
        let arc = at * here.reach_m();
        let (before, after) = (here.displacement(here.s_m(arc), arc), there.displacement(there.s_m(arc), arc));
        let largest = law.chains().iter().map(|chain| chain.response(-depth_m).dw_1_m.abs()).fold(0.0, f64::max);
        // m changes by 1e-9 / |ln q| units; dw_1 by up to tan(x) / t as much as dl_1.
        let slowest = law.chains().iter().map(|chain| -libm::log(chain.parameters().ratio)).fold(1.0, f64::min);
        prop_assert!((before.normal_m - after.normal_m).abs() <= 3e-9 / slowest * depth_m.abs());
        prop_assert!((before.tangential_m - after.tangential_m).abs() <= 1e-7 / slowest * largest);
        for chain in 0..law.chains().len() {
            let allowed = 3e-9 / -libm::log(law.chains()[chain].parameters().ratio) + 1e-12 * here.boundary_units(chain);
            prop_assert!((here.boundary_units(chain) - there.boundary_units(chain)).abs() <= allowed);
        }
    }

    #[test]
    fn the_boundary_grows_with_depth_and_stays_between_one_and_all_units((law, surface, depth_m) in contacts(), more in 1.0..3.0_f64) {
        let (here, deeper) = (shape_at(&law, &surface, depth_m), shape_at(&law, &surface, more * depth_m));
        for (index, chain) in law.chains().iter().enumerate() {
            let units = here.boundary_units(index);
            prop_assert!((1.0..=f64::from(chain.parameters().units)).contains(&units));
            prop_assert!(deeper.boundary_units(index) >= units);
        }
    }

    #[test]
    fn units_beyond_the_boundary_turn_less_than_the_cutoff((law, surface, depth_m) in contacts()) {
        let shape = shape_at(&law, &surface, depth_m);
        for (index, chain) in law.chains().iter().enumerate() {
            let parameters = chain.parameters();
            let boundary = shape.boundary_units(index);
            if surface.cutoff == 0.0 || boundary >= f64::from(parameters.units) || chain.response(-depth_m).saturated {
                continue;
            }
            // lambda of the unit that would stand on the boundary, measured against the first unit's rod.
            let dl = chain.response(-depth_m).dl_1_m * libm::pow(parameters.ratio, boundary - 1.0);
            let sine = libm::sin(parameters.angle_rad) + 0.5 * dl / parameters.rod_length_m;
            let lambda = (libm::asin(sine.min(1.0)) - parameters.angle_rad).abs() / parameters.angle_rad;
            let rounding = 1e-14 / libm::cos(parameters.angle_rad);
            prop_assert!(lambda <= surface.cutoff * (1.0 + 1e-9) + rounding, "{lambda:e}");
            if boundary > 1.0 {
                prop_assert!(lambda >= surface.cutoff * (1.0 - 1e-9) - rounding, "{lambda:e}");
            }
        }
    }

    #[test]
    fn parallel_chains_add_by_weight(weights in prop::collection::vec(0.1..1.0_f64, 2..=4), ratios in prop::collection::vec(0.3..0.99_f64, 4), depth_m in -0.02..0.02_f64, arc in 0.0..0.2_f64) {
        let sum: f64 = weights.iter().sum();
        let chains: Vec<_> = weights.iter().zip(&ratios).map(|(weight, &ratio)| {
            ChainParameters { ratio, weight: weight / sum, pitch_m: 0.01 + 0.01 * ratio, ..TISSUE }
        }).collect();
        let surface = SurfaceParameters { contact_radius_m: 0.004, ..BOUNDED };
        let together = shape_at(&law(&chains), &surface, depth_m);
        let moved = together.displacement(together.s_m(arc), arc);
        let (mut normal_m, mut tangential_m) = (0.0, 0.0);
        for chain in &chains {
            let alone = shape_at(&law(&[ChainParameters { weight: 1.0, ..*chain }]), &surface, depth_m);
            let part = alone.displacement(alone.s_m(arc), arc);
            normal_m += chain.weight * part.normal_m;
            tangential_m += chain.weight * part.tangential_m;
        }
        prop_assert!((moved.normal_m - normal_m).abs() <= 1e-15 * depth_m.abs());
        prop_assert!((moved.tangential_m - tangential_m).abs() <= 1e-15);
    }

    #[test]
    fn rings_stand_for_pitches((law, surface, depth_m) in contacts(), ring in 0.0..60.0_f64) {
        let surface = SurfaceParameters { contact_radius_m: 0.0, ..surface };
        let shape = shape_at(&law, &surface, depth_m);
        let alone: Vec<_> = law.chains().iter().map(|chain| {
            let parameters = ChainParameters { weight: 1.0, ..*chain.parameters() };
            let law = ContactLaw::new(law.formulation(), &[parameters]).expect("accepted");
            let s_m = ring * parameters.pitch_m;
            shape_at(&law, &surface, depth_m).displacement(s_m, s_m)
        }).collect();
        let moved = shape.displacement_at_ring(ring);
        let share = 1.0 / alone.len() as f64;
        let normal_m: f64 = alone.iter().map(|part| share * part.normal_m).sum();
        let tangential_m: f64 = alone.iter().map(|part| share * part.tangential_m).sum();
        let size: f64 = alone.iter().map(|part| part.tangential_m.abs()).sum();
        prop_assert!((moved.normal_m - normal_m).abs() <= 1e-9 * depth_m.abs());
        prop_assert!((moved.tangential_m - tangential_m).abs() <= 1e-9 * size + 1e-9 * depth_m.abs());
        prop_assert_eq!(shape.share_at_ring(ring) * -depth_m, moved.normal_m);
    }

    #[test]
    fn the_field_is_continuous_in_every_parameter(
        depth_m in -0.02..0.02_f64,
        arc in 0.0..0.1_f64,
        cutoff in prop_oneof![Just(0.0), Just(0.05), 0.0..0.9_f64],
        which in 0..8_usize,
    ) {
        let surface = SurfaceParameters { cutoff, contact_radius_m: 0.003, ..NO_BOUNDARY };
        let base = shape_at(&law(&[TISSUE]), &surface, depth_m);
        let (mut chain, mut nudged) = (TISSUE, surface);
        let fields = [
            &mut chain.rod_length_m,
            &mut chain.angle_rad,
            &mut chain.ratio,
            &mut chain.normal_stiffness_n_per_m,
            &mut chain.tangential_stiffness_n_per_m,
            &mut chain.pitch_m,
            &mut nudged.cutoff,
            &mut nudged.contact_radius_m,
        ];
        *fields.into_iter().nth(which).expect("eight fields") += 1e-12;
        let other = shape_at(&law(&[chain]), &nudged, depth_m);
        let (here, there) = (base.displacement(base.s_m(arc), arc), other.displacement(other.s_m(arc), arc));
        prop_assert!((here.normal_m - there.normal_m).abs() <= 1e-8 * depth_m.abs());
        prop_assert!((here.tangential_m - there.tangential_m).abs() <= 1e-8 * depth_m.abs());
    }
}

#[test]
fn pressing_moves_the_surface_inwards_and_away_and_pulling_does_the_reverse() {
    let law = law(&[TISSUE]);
    let pressed = shape_at(&law, &NO_BOUNDARY, 0.005).displacement(0.02, 0.02);
    assert!(pressed.normal_m < 0.0 && pressed.tangential_m > 0.0);
    let pulled = shape_at(&law, &NO_BOUNDARY, -0.005).displacement(0.02, 0.02);
    assert!(pulled.normal_m > 0.0 && pulled.tangential_m < 0.0);
}

#[test]
fn without_a_cutoff_every_unit_takes_part_at_any_depth() {
    let law = law(&[TISSUE]);
    for depth_m in [0.0, 1e-300, 0.001, 1e300, -0.001, -1e300] {
        let shape = shape_at(&law, &NO_BOUNDARY, depth_m);
        assert_eq!(shape.boundary_units(0), 12.0);
        assert_close("reach", shape.reach_m(), 12.0 * TISSUE.pitch_m, 1e-15);
    }
}

#[test]
fn at_rest_and_where_no_pull_can_turn_a_unit_that_far_only_the_first_unit_remains() {
    let law = law(&[TISSUE]);
    assert_eq!(shape_at(&law, &BOUNDED, 0.0).boundary_units(0), 1.0);
    // 30 degrees times 1 + cutoff is 90 degrees at a cutoff of 2, out of range; a steep unit gets there.
    let steep_law =
        self::law(&[ChainParameters { angle_rad: 1.5, tangential_stiffness_n_per_m: 1.0, ..TISSUE }]);
    assert_eq!(shape_at(&steep_law, &BOUNDED, -0.0001).boundary_units(0), 1.0);
    assert_eq!(shape_at(&steep_law, &BOUNDED, -1.0).boundary_units(0), 1.0);
    assert!(shape_at(&steep_law, &BOUNDED, 0.03).boundary_units(0) > 5.0);
}

#[test]
fn expansion_bulges_between_one_and_two_boundaries_only() {
    let law = law(&[TISSUE, TISSUE].map(|chain| ChainParameters { weight: 0.5, ..chain }));
    let surface = SurfaceParameters { expansion: 0.4, contact_radius_m: 0.003, ..BOUNDED };
    let shape = shape_at(&law, &surface, 0.006);
    let boundary_m = shape.boundary_m();
    assert_close("reach", shape.reach_m(), 0.003 + 2.0 * boundary_m, 1e-15);
    assert_close("the top of the bump", shape.bump(1.5 * boundary_m), 1.0, 1e-14);
    assert_close("a quarter of the way", shape.bump(1.25 * boundary_m), 16.0 * 0.0625 * 0.5625, 1e-13);
    for s_m in [0.0, 0.5 * boundary_m, boundary_m, 2.0 * boundary_m, 3.0 * boundary_m] {
        assert!(shape.bump(s_m) < 1e-30);
    }
    assert_close("reach in rings", shape.reach_rings(), 2.0 * shape.boundary_units(0), 1e-15);
    assert_close("by rings", shape.bump_at_ring(1.5 * shape.boundary_units(0)), 1.0, 1e-14);
    let flat = shape_at(&law, &SurfaceParameters { expansion: 0.0, ..surface }, 0.006);
    assert_close("reach without expansion", flat.reach_m(), 0.003 + boundary_m, 1e-15);
}

#[test]
fn a_contact_of_some_radius_moves_as_one_and_slides_nothing_at_its_centre() {
    let law = law(&[TISSUE]);
    let surface = SurfaceParameters { contact_radius_m: 0.05, ..NO_BOUNDARY };
    let shape = shape_at(&law, &surface, 0.006);
    for arc_m in [0.0, 0.01, 0.05] {
        assert_eq!(shape.normal_m(shape.s_m(arc_m)), -0.006);
    }
    let half_dw_m = 0.5 * law.chains()[0].response(-0.006).dw_1_m;
    assert_close("at half the radius", shape.tangential_m(0.0, 0.025), 0.5 * half_dw_m, 1e-14);
    assert_close("at the rim", shape.tangential_m(0.0, 0.05), half_dw_m, 1e-14);
}

#[test]
fn a_refused_depth_changes_nothing() {
    let law = law(&[TISSUE]);
    let mut shape = shape_at(&law, &BOUNDED, 0.006);
    let before = shape.clone();
    for depth_m in [f64::NAN, f64::INFINITY] {
        assert!(shape.set_depth(&law, depth_m).is_err());
        assert_eq!(shape, before);
    }
    assert!(ContactShape::new(&law, &SurfaceParameters { cutoff: 1.0, ..BOUNDED }).is_err());
}
