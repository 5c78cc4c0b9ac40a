//! Parameters for the tests of the contact law: plain tissues, and random chains that are accepted by construction.
#![allow(dead_code, reason = "each test file uses its part")]

use proptest::prelude::*;
use rhombus_chain::{Chain, ChainParameters, ContactLaw, Formulation, ParameterError};

/// The second golden chain of MODEL section 2.
pub(crate) const TISSUE: ChainParameters = ChainParameters {
    rod_length_m: 0.01,
    angle_rad: 0.523_598_775_598_298_8,
    ratio: 0.8,
    units: 12,
    normal_stiffness_n_per_m: 500.0,
    tangential_stiffness_n_per_m: 100.0,
    tangential_growth: 10.0,
    weight: 1.0,
    pitch_m: 0.017_320_508_075_688_77,
};

pub(crate) fn assert_close(what: &str, value: f64, expected: f64, relative: f64) {
    let allowed = relative * expected.abs();
    assert!((value - expected).abs() <= allowed, "{what}: {value:e}, expected {expected:e}");
}

pub(crate) fn formulations() -> impl Strategy<Value = Formulation> {
    prop_oneof![Just(Formulation::Published), Just(Formulation::Energy)]
}

/// `10^low .. 10^high`, evenly in the exponent.
pub(crate) fn decades(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low..high).prop_map(|exponent| libm::pow(10.0, exponent))
}

/// A chain of the given formulation that is accepted, from 0.1 to 89.9 degrees, 1 to 10^6 units, up to 99.9 % of the
/// tangential stiffness at which it would be refused.
pub(crate) fn accepted(formulation: Formulation) -> impl Strategy<Value = ChainParameters> {
    let shape = (decades(-4.0, 0.0), 0.002..1.569_f64, decades(-7.0, -0.02), decades(0.0, 6.0));
    let springs = (decades(-3.0, 9.0), 0.0..0.999_f64, decades(-1.0, 4.0));
    (shape, springs).prop_map(move |((rod_length_m, angle_rad, decay, units), (normal, share, growth))| {
        let mut parameters = ChainParameters {
            rod_length_m,
            angle_rad,
            ratio: 1.0 - decay,
            units: units as u32,
            normal_stiffness_n_per_m: normal,
            tangential_stiffness_n_per_m: 1e18,
            // Slow enough for e^(n/beta) to stay a number.
            tangential_growth: growth.max(units / 300.0),
            weight: 1.0,
            pitch_m: 2.0 * rod_length_m * libm::cos(angle_rad),
        };
        let most = match Chain::new(0, formulation, &parameters) {
            Err(
                ParameterError::SnapsThrough { most_tangential, .. }
                | ParameterError::NotRising { most_tangential, .. },
            ) => most_tangential,
            other => panic!("1e18 N/m on the tangential springs is refused, not {other:?}"),
        };
        parameters.tangential_stiffness_n_per_m = (share * most).min(1e18);
        parameters
    })
}

/// One to four accepted chains of similar size in parallel.
pub(crate) fn accepted_law() -> impl Strategy<Value = ContactLaw> {
    formulations().prop_flat_map(|formulation| {
        prop::collection::vec(accepted(formulation), 1..=4).prop_map(move |mut chains| {
            let weight = 1.0 / chains.len() as f64;
            for chain in &mut chains {
                chain.weight = weight;
            }
            ContactLaw::new(formulation, &chains).expect("accepted by construction")
        })
    })
}

/// The outermost guards of a law: (largest depth, largest pull), both > 0, m.
pub(crate) fn outermost_guards(law: &ContactLaw) -> (f64, f64) {
    law.chains()
        .iter()
        .map(Chain::guarded_range_m)
        .fold((0.0, 0.0), |(depth, pull), (low, high)| (f64::max(depth, -low), f64::max(pull, high)))
}
