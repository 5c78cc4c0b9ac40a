//! What a law asks of a device: the analysis agrees with the law itself, and the bound orders devices as physics does.
#![allow(clippy::expect_used, clippy::panic, reason = "a test whose case cannot be set up fails")]

mod chains;

use chains::{TISSUE, accepted_law, assert_close, outermost_guards};
use proptest::prelude::*;
use rhombus_chain::stability::{Bend, Cause, Demand, HapticLoop, LawAnalysis, Reach};
use rhombus_chain::{ChainParameters, ContactLaw, Formulation};

const ONE_KILOHERTZ: HapticLoop = HapticLoop {
    rate_hz: 1000.0,
    delay_s: 0.0,
    damping_n_s_per_m: Some(1.0),
    rendered_damping_n_s_per_m: 0.0,
};

fn law(formulation: Formulation) -> ContactLaw {
    ContactLaw::new(formulation, &[TISSUE]).expect("accepted")
}

fn stiffness(law: &ContactLaw, depth_m: f64) -> f64 {
    law.at_depth(depth_m).expect("a finite depth").stiffness_n_per_m
}

#[test]
fn one_golden_chain_is_possible_from_flat_to_fully_extended() {
    let analysis = LawAnalysis::new(&law(Formulation::Energy));
    // 2 a S_n = 0.02 * (1 - 0.8^12)/0.2 and sin(theta) = 1/2: half of it each way.
    let half_m = 0.01 * (1.0 - libm::pow(0.8, 12.0)) / 0.2;
    assert_close("pull", analysis.possible_m.0, -half_m, 1e-14);
    assert_close("press", analysis.possible_m.1, half_m, 1e-14);
    assert_close("guard", analysis.guarded_m.1, 0.98 * half_m, 1e-14);
    assert!(analysis.guarded_m.0 >= 0.98 * analysis.possible_m.0, "a guard is never past what is possible");
}

#[test]
fn springs_that_store_stiffen_when_pulled_and_the_printed_law_when_pressed() {
    let bends = |formulation| LawAnalysis::new(&law(formulation)).ranges.map(|range| range.bend);
    use Bend::{Softens, Stiffens, Straight};
    assert_eq!(bends(Formulation::Energy), [Straight, Stiffens, Softens, Straight]);
    assert_eq!(bends(Formulation::Published), [Straight, Softens, Stiffens, Straight]);
    let straight = ChainParameters { tangential_stiffness_n_per_m: 0.0, ..TISSUE };
    for formulation in [Formulation::Energy, Formulation::Published] {
        let law = ContactLaw::new(formulation, &[straight]).expect("accepted");
        assert_eq!(LawAnalysis::new(&law).ranges.map(|range| range.bend), [Straight; 4]);
        assert_eq!(Demand::of_law(&law, Reach::ENDLESS).cause, Cause::Rest);
    }
}

#[test]
fn the_energy_law_asks_most_when_pulled_and_nothing_more_than_rest_when_it_can_only_be_pressed() {
    let law = law(Formulation::Energy);
    let rest = law.rest_stiffness_n_per_m();
    let pulled = Demand::of_law(&law, Reach::ENDLESS);
    assert_eq!(pulled.cause, Cause::Pull);
    assert!(pulled.stiffness_n_per_m > 2.0 * rest && pulled.stiffness_n_per_m <= 10.0 * rest * (1.0 + 1e-12));
    let pressed = Demand::of_law(&law, Reach::ENDLESS.without_grasp());
    assert_eq!((pressed.cause, pressed.stiffness_n_per_m), (Cause::Rest, rest));
}

#[test]
fn the_printed_law_asks_most_when_pressed_with_a_grasp_or_without() {
    let law = law(Formulation::Published);
    let (press_m, _) = outermost_guards(&law);
    for reach in [Reach::ENDLESS, Reach::ENDLESS.without_grasp()] {
        let demand = Demand::of_law(&law, reach);
        assert_eq!(demand.cause, Cause::Press);
        assert_close("depth", demand.depth_m, press_m, 1e-14);
        assert_close("stiffness", demand.stiffness_n_per_m, stiffness(&law, press_m), 1e-14);
    }
}

#[test]
fn a_device_that_gives_less_force_meets_less_of_the_stiffness() {
    let law = law(Formulation::Energy);
    let strong = Demand::of_law(&law, Reach::of_force(&law, 1e3));
    let weak_reach = Reach::of_force(&law, 0.5);
    let weak = Demand::of_law(&law, weak_reach);
    assert_eq!(strong, Demand::of_law(&law, Reach::ENDLESS));
    assert!(weak.stiffness_n_per_m < 0.9 * strong.stiffness_n_per_m);
    let force_n = law.at_depth(weak.depth_m).expect("finite").force_n;
    assert_close("force where the reach ends", force_n, -0.5, 1e-11);
}

#[test]
fn a_grasp_that_is_stiffer_across_than_along_decides() {
    let along = Demand::of_law(&law(Formulation::Published), Reach::ENDLESS);
    assert_eq!(along.or_lateral(0.5 * along.stiffness_n_per_m), along);
    let across = along.or_lateral(2.0 * along.stiffness_n_per_m);
    assert_eq!((across.cause, across.stiffness_n_per_m), (Cause::Lateral, 2.0 * along.stiffness_n_per_m));
}

#[test]
fn two_thousand_newton_per_metre_need_one_newton_second_per_metre_at_one_kilohertz() {
    // Minsky, and Colgate and Brown: K T < 2 b.
    assert_close("b", ONE_KILOHERTZ.needed_damping_n_s_per_m(2000.0), 1.0, 1e-15);
    assert_close("K", ONE_KILOHERTZ.largest_passive_stiffness_n_per_m(1.0), 2000.0, 1e-15);
    let late = HapticLoop { delay_s: 0.3e-3, ..ONE_KILOHERTZ };
    assert_close("K with 0.3 ms of delay", late.largest_passive_stiffness_n_per_m(1.0), 1250.0, 1e-15);
}

#[test]
fn the_verdict_is_one_sentence_with_its_numbers() {
    let demand = Demand { stiffness_n_per_m: 1999.0, depth_m: -0.0131, cause: Cause::Pull };
    let sentence = |haptic_loop: HapticLoop| haptic_loop.judge(demand).to_string();
    assert_eq!(
        sentence(ONE_KILOHERTZ),
        "stable: the device's damping of 1 N s/m exceeds the 0.9995 N s/m that a stiffness of 1999 N/m (pulled 13.1 mm) needs at \
         1000 Hz without delay"
    );
    let late = HapticLoop { delay_s: 2e-3, ..ONE_KILOHERTZ };
    assert_eq!(
        sentence(late),
        "may become unstable: the device's damping of 1 N s/m does not exceed the 4.998 N s/m that a stiffness of 1999 N/m \
         (pulled 13.1 mm) needs at 1000 Hz with 2 ms of delay; raise the rate, shorten the delay, soften the body or take a \
         device with more damping"
    );
    let unknown = HapticLoop { damping_n_s_per_m: None, ..ONE_KILOHERTZ };
    assert!(
        sentence(unknown)
            .starts_with("cannot be judged, because the device's damping is not known: it has to exceed")
    );
    assert_eq!(unknown.judge(demand).is_passive(), None);
    assert!(unknown.judge(demand).is_warning() && late.judge(demand).is_warning());
    assert!(!ONE_KILOHERTZ.judge(demand).is_warning());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn no_depth_within_the_reach_is_stiffer_than_the_demand(
        law in accepted_law(), share in -3.0..3.0_f64, press in 0.0..3.0_f64, pull in 0.0..3.0_f64,
    ) {
        let (deepest_m, longest_m) = outermost_guards(&law);
        let reach = Reach { press_m: press * deepest_m, pull_m: pull * longest_m };
        let demand = Demand::of_law(&law, reach);
        let depth_m = if share > 0.0 { share / 3.0 * reach.press_m } else { share / 3.0 * reach.pull_m };
        prop_assert!(stiffness(&law, depth_m) <= demand.stiffness_n_per_m * (1.0 + 1e-12));
        prop_assert!(demand.depth_m <= reach.press_m && demand.depth_m >= -reach.pull_m);
        prop_assert!((stiffness(&law, demand.depth_m) - demand.stiffness_n_per_m).abs() <= 1e-12 * demand.stiffness_n_per_m);
    }

    #[test]
    fn the_tangent_stiffness_does_within_a_range_what_the_analysis_says(
        law in accepted_law(), index in 0..4_usize, a in 0.0..1.0_f64, b in 0.0..1.0_f64,
    ) {
        let range = LawAnalysis::new(&law).ranges[index];
        let (from_m, to_m) = match (range.from_m, range.to_m) {
            (Some(from_m), Some(to_m)) => (from_m, to_m),
            (None, Some(to_m)) => (10.0 * to_m, to_m),
            (Some(from_m), None) => (from_m, 10.0 * from_m),
            (None, None) => panic!("a law bends somewhere"),
        };
        let at = |share: f64| from_m + share * (to_m - from_m);
        let sizes = |share: f64| (at(share).abs(), stiffness(&law, at(share)));
        let (near, far) = if at(a).abs() <= at(b).abs() { (sizes(a), sizes(b)) } else { (sizes(b), sizes(a)) };
        let slack = 1e-9 * near.1.max(far.1);
        match range.bend {
            Bend::Stiffens => prop_assert!(far.1 >= near.1 - slack),
            Bend::Softens => prop_assert!(far.1 <= near.1 + slack),
            Bend::Straight => prop_assert!((far.1 - near.1).abs() <= slack),
        }
        let ends = [(from_m, range.from_n_per_m), (to_m, range.to_n_per_m)];
        for (depth_m, expected) in ends {
            prop_assert!((stiffness(&law, depth_m) - expected).abs() <= 1e-9 * expected, "at {depth_m}");
        }
    }

    #[test]
    fn guarded_depths_are_inside_the_possible_ones_and_nothing_there_is_saturated(law in accepted_law(), share in 0.0..1.0_f64) {
        let LawAnalysis { possible_m, guarded_m, bent_m, chains, .. } = LawAnalysis::new(&law);
        prop_assert!(possible_m.0 < guarded_m.0 && guarded_m.0 <= 0.0 && 0.0 < guarded_m.1 && guarded_m.1 < possible_m.1);
        prop_assert!(bent_m.0 <= guarded_m.0 && guarded_m.1 <= bent_m.1);
        prop_assert_eq!(chains.len(), law.chains().len());
        let depth_m = guarded_m.0 + share * (1.0 - 1e-12) * (guarded_m.1 - guarded_m.0);
        prop_assert!(!law.at_depth(depth_m).expect("finite").saturated);
        for outside_m in [1.001 * guarded_m.0, 1.001 * guarded_m.1] {
            prop_assert!(outside_m == 0.0 || law.at_depth(outside_m).expect("finite").saturated);
        }
    }

    #[test]
    fn more_rate_never_needs_more_damping_and_more_delay_never_less(
        stiffness in 0.0..1e6_f64, rate in 10.0..4000.0_f64, more_rate in 0.0..4000.0_f64,
        delay in 0.0..0.02_f64, more_delay in 0.0..0.02_f64, rendered in -10.0..10.0_f64,
    ) {
        let needed = |rate_hz, delay_s| {
            HapticLoop { rate_hz, delay_s, damping_n_s_per_m: None, rendered_damping_n_s_per_m: rendered }
                .needed_damping_n_s_per_m(stiffness)
        };
        prop_assert!(needed(rate + more_rate, delay) <= needed(rate, delay));
        prop_assert!(needed(rate, delay + more_delay) >= needed(rate, delay));
        prop_assert!(needed(rate, delay) >= rendered.abs());
    }
}
