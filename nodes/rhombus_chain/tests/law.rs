//! What the contact law is, whatever the parameters: conservative, rising, smooth at its guards, additive, and total.
#![allow(clippy::expect_used, clippy::panic, reason = "a test whose case cannot be set up fails")]

mod chains;

use chains::{TISSUE, accepted, accepted_law, assert_close, decades, formulations, outermost_guards};
use proptest::prelude::*;
use rhombus_chain::{Chain, ChainParameters, ContactLaw, ForceError, Formulation};

fn any_chain() -> impl Strategy<Value = Chain> {
    formulations().prop_flat_map(|formulation| {
        accepted(formulation).prop_map(move |parameters| {
            Chain::new(0, formulation, &parameters).expect("accepted by construction")
        })
    })
}

/// An elongation from far past one guard to far past the other: `share` of -3 .. 3 in units of the guards.
fn elongation(chain: &Chain, share: f64) -> f64 {
    let (compression, extension) = chain.guarded_range_m();
    if share < 0.0 { -share * compression } else { share * extension }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn force_is_the_derivative_of_energy(chain in any_chain(), share in -3.0..3.0_f64) {
        let at = elongation(&chain, share);
        let here = chain.response(at);
        let step = 1e-4 * at.abs();
        let slope = (chain.response(at + step).energy_j - chain.response(at - step).energy_j) / (2.0 * step);
        // The central difference errs by the third derivative of E times step^2 / 6, and by the rounding of E.
        let curvature = (chain.response(at + step).stiffness_n_per_m - chain.response(at - step).stiffness_n_per_m).abs();
        let allowed = 1e-9 * here.force_n.abs() + curvature * step + 1e-15 * here.energy_j / step;
        prop_assert!((slope - here.force_n).abs() <= allowed, "dE/dDL = {slope:e}, F = {:e}", here.force_n);
    }

    #[test]
    fn stiffness_is_the_derivative_of_force(chain in any_chain(), share in -3.0..3.0_f64) {
        let at = elongation(&chain, share);
        let here = chain.response(at);
        let step = 1e-4 * at.abs();
        let (before, after) = (chain.response(at - step), chain.response(at + step));
        let slope = (after.force_n - before.force_n) / (2.0 * step);
        let spread = (after.stiffness_n_per_m - before.stiffness_n_per_m).abs();
        let allowed = 1e-9 * here.stiffness_n_per_m.abs() + spread + 1e-15 * here.force_n.abs() / step;
        prop_assert!((slope - here.stiffness_n_per_m).abs() <= allowed, "{slope:e}, {:e}", here.stiffness_n_per_m);
    }

    #[test]
    fn energy_is_the_work_done_from_rest(chain in any_chain(), share in -3.0..3.0_f64) {
        let at = elongation(&chain, share);
        // Gauss-Legendre, five points on each of 64 pieces; the guards lie on piece boundaries only by chance.
        let nodes = [(0.0, 128.0 / 225.0), (0.538_469_310_105_683, 0.478_628_670_499_366_5), (0.906_179_845_938_664, 0.236_926_885_056_189_1)];
        let pieces = 64;
        let half = 0.5 * at / f64::from(pieces);
        let mut work = 0.0;
        for piece in 0..pieces {
            let middle = half * (2.0 * f64::from(piece) + 1.0);
            for (node, weight) in nodes {
                let pair = chain.response(middle + node * half).force_n + chain.response(middle - node * half).force_n;
                work += weight * half * if node == 0.0 { 0.5 * pair } else { pair };
            }
        }
        let energy = chain.response(at).energy_j;
        prop_assert!((work - energy).abs() <= 2e-4 * energy, "work {work:e}, energy {energy:e}");
    }

    #[test]
    fn what_the_energy_law_stores_is_in_its_springs(parameters in accepted(Formulation::Energy), share in -1.0..1.0_f64) {
        let parameters = ChainParameters { units: parameters.units.min(1000), ..parameters };
        let chain = Chain::new(0, Formulation::Energy, &parameters).expect("accepted by construction");
        let response = chain.response(elongation(&chain, share));
        let (mut dl, mut dw, mut k_t) = (response.dl_1_m, response.dw_1_m, parameters.tangential_stiffness_n_per_m);
        let mut stored = 0.0;
        for _ in 0..parameters.units {
            stored += 0.5 * (parameters.normal_stiffness_n_per_m * dl * dl + k_t * dw * dw);
            dl *= parameters.ratio;
            dw *= parameters.ratio;
            k_t *= libm::exp(1.0 / parameters.tangential_growth);
        }
        assert_close("stored energy", response.energy_j, stored, 1e-10);
    }

    #[test]
    fn an_accepted_law_rises_over_the_whole_range_and_past_its_guards(chain in any_chain(), from in -3.0..3.0_f64, rise in decades(-6.0, 1.0)) {
        let at = elongation(&chain, from);
        let further = at + rise * (at.abs() + chain.guarded_range_m().1);
        let (low, high) = (chain.response(at), chain.response(further));
        prop_assert!(high.force_n > low.force_n, "F({at:e}) = {:e}, F({further:e}) = {:e}", low.force_n, high.force_n);
        prop_assert!(low.stiffness_n_per_m > 0.0);
    }

    #[test]
    fn the_law_is_c1_at_both_guards(chain in any_chain()) {
        let (compression, extension) = chain.guarded_range_m();
        for guard in [compression, extension] {
            let (inside, outside) = (chain.response(guard * (1.0 - 1e-10)), chain.response(guard * (1.0 + 1e-10)));
            prop_assert!(!inside.saturated && outside.saturated);
            assert_close("F", outside.force_n, inside.force_n, 1e-8);
            assert_close("dF/dDL", outside.stiffness_n_per_m, inside.stiffness_n_per_m, 1e-6);
            assert_close("E", outside.energy_j, inside.energy_j, 1e-8);
            assert_close("d_theta", outside.d_theta_rad, inside.d_theta_rad, 1e-6);
            assert_close("dw_1", outside.dw_1_m, inside.dw_1_m, 1e-8);
        }
    }

    #[test]
    fn past_a_guard_the_tangential_motion_continues_along_its_tangent(chain in any_chain(), beyond in 1.0..3.0_f64, pull in any::<bool>()) {
        let (compression, extension) = chain.guarded_range_m();
        let guard = chain.response(if pull { extension } else { compression });
        let past = chain.response(beyond * if pull { extension } else { compression });
        let tangent = libm::tan(chain.parameters().angle_rad + guard.d_theta_rad);
        let expected = guard.dw_1_m - tangent * (past.dl_1_m - guard.dl_1_m);
        assert_close("d_theta", past.d_theta_rad, guard.d_theta_rad, 1e-12);
        let allowed = 1e-9 * (expected.abs() + guard.dw_1_m.abs());
        prop_assert!((past.dw_1_m - expected).abs() <= allowed, "{:e}, expected {expected:e}", past.dw_1_m);
    }

    #[test]
    fn guards_stand_at_98_percent_or_where_the_stiffness_has_changed_ten_times(chain in any_chain()) {
        let parameters = chain.parameters();
        let span = 2.0 * parameters.rod_length_m * chain.elongation_sum();
        let sine = libm::sin(parameters.angle_rad);
        let (compression, extension) = chain.guarded_range_m();
        assert_close("compression guard", compression, -0.98 * sine * span, 1e-14);
        let possible = libm::cos(parameters.angle_rad) * libm::cos(parameters.angle_rad) / (1.0 + sine) * span;
        let ratio = chain.response(extension).stiffness_n_per_m / chain.rest_stiffness_n_per_m();
        let limit = match chain.formulation() {
            Formulation::Energy => 10.0,
            Formulation::Published => 0.1,
        };
        if extension < 0.98 * possible * (1.0 - 1e-12) {
            assert_close("stiffness at the guard over that at rest", ratio, limit, 1e-9);
        } else {
            assert_close("extension guard", extension, 0.98 * possible, 1e-12);
            let before = if limit > 1.0 { ratio / limit } else { limit / ratio };
            prop_assert!(before <= 1.0 + 1e-9);
        }
    }

    #[test]
    fn the_published_law_is_its_printed_formula_up_to_the_guard(parameters in accepted(Formulation::Published), share in -1.0..1.0_f64) {
        let chain = Chain::new(0, Formulation::Published, &parameters).expect("accepted by construction");
        let response = chain.response(elongation(&chain, share));
        let tangent = libm::tan(parameters.angle_rad);
        let mean_tangent = libm::tan(parameters.angle_rad + 0.5 * response.d_theta_rad);
        let coupling = parameters.tangential_stiffness_n_per_m * mean_tangent * tangent;
        let printed = (parameters.normal_stiffness_n_per_m - coupling) * response.dl_1_m;
        let rounding = 1e-13 * (parameters.normal_stiffness_n_per_m + coupling) / libm::cos(parameters.angle_rad);
        prop_assert!((response.force_n - printed).abs() <= rounding * response.dl_1_m.abs());
    }

    #[test]
    fn parallel_chains_share_the_depth_and_add_their_forces(law in accepted_law(), share in -3.0..3.0_f64) {
        let (deepest, furthest) = outermost_guards(&law);
        let depth_m = if share > 0.0 { share * deepest } else { share * furthest };
        let together = law.at_depth(depth_m).expect("a finite depth");
        let alone: Vec<_> = law.chains().iter().map(|chain| chain.response(-depth_m)).collect();
        let force = -alone.iter().map(|chain| chain.force_n).sum::<f64>();
        let stiffness = alone.iter().map(|chain| chain.stiffness_n_per_m).sum();
        let energy = alone.iter().map(|chain| chain.energy_j).sum();
        assert_close("force", together.force_n, force, 1e-15);
        assert_close("stiffness", together.stiffness_n_per_m, stiffness, 1e-15);
        assert_close("energy", together.energy_j, energy, 1e-15);
        prop_assert_eq!(together.saturated, alone.iter().any(|chain| chain.saturated));
    }

    #[test]
    fn the_depth_for_a_force_gives_that_force(law in accepted_law(), share in decades(-14.0, 4.0), pull in any::<bool>()) {
        let (deepest, furthest) = outermost_guards(&law);
        let depth_m = if pull { -share * furthest } else { share * deepest };
        let force_n = law.at_depth(depth_m).expect("a finite depth").force_n;
        let found_m = law.depth_for_force(force_n).expect("a force in reach");
        let answer_n = law.at_depth(found_m).expect("a finite depth").force_n;
        let tolerance = 1e-12 * force_n.abs().max(1e-9 * law.rest_stiffness_n_per_m());
        prop_assert!((answer_n - force_n).abs() <= tolerance, "{force_n:e} N asked, {answer_n:e} N at {found_m:e} m");
    }

    #[test]
    fn any_finite_depth_has_a_finite_answer_that_pushes_back(law in accepted_law(), exponent in -320.0..308.0_f64, pull in any::<bool>()) {
        let size = libm::pow(10.0, exponent);
        let depth_m = if pull { -size } else { size };
        let response = law.at_depth(depth_m).expect("a finite depth");
        prop_assert!(response.force_n.is_finite() && response.force_n * depth_m >= 0.0);
        prop_assert!(response.stiffness_n_per_m.is_finite() && response.stiffness_n_per_m > 0.0);
        prop_assert!(response.energy_j.is_finite() && response.energy_j >= 0.0);
        let further = law.at_depth(1.5 * depth_m).expect("a finite depth");
        prop_assert!(further.force_n.abs() >= response.force_n.abs());
        for chain in law.chains() {
            let answer = chain.response(-depth_m);
            prop_assert!([answer.dl_1_m, answer.d_theta_rad, answer.dw_1_m].into_iter().all(f64::is_finite));
        }
    }

    #[test]
    fn the_law_is_continuous_in_every_parameter(parameters in accepted(Formulation::Energy), share in -2.0..2.0_f64, which in 0..7_usize) {
        let chain = Chain::new(0, Formulation::Energy, &parameters).expect("accepted by construction");
        let mut nudged = parameters;
        let nudge = 1.0 + 1e-11;
        let field = [
            &mut nudged.rod_length_m,
            &mut nudged.angle_rad,
            &mut nudged.ratio,
            &mut nudged.normal_stiffness_n_per_m,
            &mut nudged.tangential_stiffness_n_per_m,
            &mut nudged.tangential_growth,
            &mut nudged.pitch_m,
        ];
        *field.into_iter().nth(which).expect("seven fields") *= nudge;
        prop_assume!(nudged.ratio < 1.0);
        let Ok(other) = Chain::new(0, Formulation::Energy, &nudged) else { return Ok(()) };
        let at = elongation(&chain, share);
        let (here, there) = (chain.response(at), other.response(at));
        // A million units amplify a change of the ratio or the growth by as much; near 90 degrees the room left
        // for a pull changes that much faster than the angle.
        let amplification = (1.0 + 0.03 * f64::from(parameters.units)) / libm::cos(parameters.angle_rad);
        let allowed = 1e-8 * amplification;
        prop_assert!((here.force_n - there.force_n).abs() <= allowed * here.force_n.abs());
    }
}

#[test]
fn a_law_without_tangential_springs_is_a_straight_line() {
    for formulation in [Formulation::Published, Formulation::Energy] {
        let linear = ChainParameters { tangential_stiffness_n_per_m: 0.0, ..TISSUE };
        let law = ContactLaw::new(formulation, &[linear]).expect("accepted");
        let stiffness = law.rest_stiffness_n_per_m();
        for depth_m in [1e-18, 0.003, 1.0, -0.003, -1.0] {
            let response = law.at_depth(depth_m).expect("a finite depth");
            assert_close("force", response.force_n, stiffness * depth_m, 1e-14);
            assert_close("stiffness", response.stiffness_n_per_m, stiffness, 1e-14);
        }
    }
}

#[test]
fn the_largest_numbers_have_finite_answers_too() {
    let stiff = ChainParameters { normal_stiffness_n_per_m: 1e9, weight: 0.5, ..TISSUE };
    for formulation in [Formulation::Published, Formulation::Energy] {
        let law = ContactLaw::new(formulation, &[stiff, stiff]).expect("accepted");
        for depth_m in [f64::MAX, -f64::MAX, 1e300, -1e300] {
            let together = law.at_depth(depth_m).expect("a finite depth");
            assert!(together.saturated && together.force_n.is_finite() && together.force_n * depth_m > 0.0);
            assert_eq!(together.energy_j, f64::MAX);
            let alone = law.chains()[0].response(depth_m);
            let answers = [alone.force_n, alone.energy_j, alone.dl_1_m, alone.d_theta_rad, alone.dw_1_m];
            assert!(answers.into_iter().all(f64::is_finite), "{alone:?}");
        }
        let beyond = law.chains()[0].response(f64::INFINITY);
        assert_eq!(beyond, law.chains()[0].response(f64::MAX));
    }
}

#[test]
fn pressing_pushes_out_and_pulling_pulls_back() {
    for formulation in [Formulation::Published, Formulation::Energy] {
        let law = ContactLaw::new(formulation, &[TISSUE]).expect("accepted");
        assert!(law.at_depth(0.005).expect("a finite depth").force_n > 0.0);
        assert!(law.at_depth(-0.005).expect("a finite depth").force_n < 0.0);
        let at_rest = law.at_depth(0.0).expect("a finite depth");
        assert_eq!((at_rest.force_n, at_rest.energy_j, at_rest.saturated), (0.0, 0.0, false));
        assert!(at_rest.force_n.is_sign_positive(), "no -0 in reports");
    }
}

#[test]
fn nan_and_infinity_are_errors_that_name_the_input() {
    let law = ContactLaw::new(Formulation::Energy, &[TISSUE]).expect("accepted");
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let refused = law.at_depth(value).expect_err("no answer").to_string();
        assert!(refused.contains("depth_m") && refused.contains("finite"), "{refused}");
        let refused = law.depth_for_force(value).expect_err("no answer").to_string();
        assert!(refused.contains("force_n") && refused.contains("finite"), "{refused}");
    }
}

#[test]
fn a_force_beyond_every_depth_is_refused_with_the_largest_there_is() {
    let soft =
        ChainParameters { normal_stiffness_n_per_m: 1e-3, tangential_stiffness_n_per_m: 0.0, ..TISSUE };
    let law = ContactLaw::new(Formulation::Energy, &[soft]).expect("accepted");
    let Err(ForceError::OutOfReach { largest_n, .. }) = law.depth_for_force(1e308) else {
        panic!("1e308 N needs more than 1e308 m");
    };
    assert!(largest_n > 1e300 && largest_n < 1e308);
    assert!(law.depth_for_force(0.999 * largest_n).is_ok());
}
