//! Which chains are tried: decay lengths from the contact's size to the body's, how many, and how many harmonics.

use glam::DVec3;
use rhombus_chain::ChainParameters;

use super::sites;
use crate::calibrate::fitted::{self, ANGLE_RAD, Member, Spring};

/// Chains of one set, and its harmonics.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Candidate {
    /// `l_p`, m, ascending.
    pub(super) decays_m: Vec<f64>,
    /// `n_p`.
    pub(super) units: Vec<u32>,
    /// `h`, m.
    pub(super) pitch_m: f64,
    /// H.
    pub(super) harmonics: usize,
}

/// What of it was asked for; `None` is chosen by the error at sites that were not used.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Wanted {
    pub(super) chains: Option<usize>,
    pub(super) harmonics: Option<usize>,
    pub(super) modes: Option<usize>,
}

/// Chains that are tried.
const CHAINS: std::ops::RangeInclusive<usize> = 3..=6;
/// Body modes that are tried.
const MODES: [usize; 9] = [0, 8, 16, 24, 32, 48, 64, 96, 128];
/// Most harmonics.
const HARMONICS: usize = rhombus_chain::MOST_HARMONICS;
/// The shortest decay length in contact radii, the longest in diagonals of the body's box.
const SHORTEST: f64 = 0.5;
const LONGEST: f64 = 0.31;
/// A chain's shape ends after this many decay lengths: `e^-14 = 1e-6`.
const REACH: f64 = 14.0;
/// Whole units that rounding makes a little more than whole stay so.
const ROUNDING: f64 = 1e-9;

/// The pitch of all chains: the contact radius, so that what has a direction rises over just that (MODEL section 4).
pub(super) fn pitch_m(contact_radius_m: f64) -> f64 {
    contact_radius_m
}

/// All sets that are tried: every number of chains with the most harmonics, and fewer harmonics with the most chains.
pub(super) fn candidates(
    wanted: &Wanted,
    sites: usize,
    contact_radius_m: f64,
    size: DVec3,
) -> Vec<Candidate> {
    let chains: Vec<usize> = wanted.chains.map_or_else(|| CHAINS.collect(), |chains| vec![chains]);
    let harmonics: Vec<usize> = match wanted.harmonics {
        Some(harmonics) => vec![harmonics],
        None => (0..=HARMONICS).filter(|harmonics| sites >= sites::fewest(*harmonics, 0)).collect(),
    };
    let (most_chains, most_harmonics) = (chains.last().copied(), harmonics.last().copied());
    let mut candidates = Vec::new();
    for harmonics in harmonics {
        for chains in &chains {
            if Some(harmonics) == most_harmonics || Some(*chains) == most_chains {
                candidates.push(Candidate::new(*chains, harmonics, contact_radius_m, size));
            }
        }
    }
    candidates
}

/// Numbers of body modes that are tried.
pub(super) fn modes(wanted: &Wanted, sites: usize) -> Vec<usize> {
    match wanted.modes {
        Some(modes) => vec![modes],
        None => MODES.into_iter().filter(|modes| sites >= sites::fewest(0, *modes)).collect(),
    }
}

impl Candidate {
    fn new(chains: usize, harmonics: usize, contact_radius_m: f64, size: DVec3) -> Self {
        let (shortest_m, longest_m) = (SHORTEST * contact_radius_m, LONGEST * size.length());
        let pitch_m = pitch_m(contact_radius_m);
        let decay = |p: usize| {
            // One chain alone is in the middle.
            let along = if chains > 1 { p as f64 / (chains - 1) as f64 } else { 0.5 };
            shortest_m * libm::exp(along * libm::log(longest_m / shortest_m))
        };
        let decays_m: Vec<f64> = (0..chains).map(decay).collect();
        // At least one; a body of 2 m with contacts of 1 mm has some 30 000.
        let units = decays_m
            .iter()
            .map(|decay_m| (REACH * decay_m / pitch_m - ROUNDING).ceil().max(1.0) as u32)
            .collect();
        Self { decays_m, units, pitch_m, harmonics }
    }

    /// `n_p h`, m.
    pub(super) fn reaches_m(&self) -> Vec<f64> {
        self.units.iter().map(|units| f64::from(*units) * self.pitch_m).collect()
    }

    /// The model's parameters, with equal shares of a linear force of `rest_n_per_m` at rest.
    pub(super) fn parameters(&self, rest_n_per_m: f64, range_m: f64) -> Vec<ChainParameters> {
        let spring = Spring {
            formulation: rhombus_chain::Formulation::Energy,
            rest_n_per_m,
            tangential: 0.0,
            range_m,
        };
        let reaches_m = self.reaches_m();
        let members: Vec<(Member, u32)> = (self.decays_m.iter().zip(&reaches_m).zip(&self.units))
            .map(|((decay_m, reach_m), units)| {
                let member =
                    Member { weight: 1.0, decay_m: *decay_m, extent_m: *reach_m, angle_rad: ANGLE_RAD };
                (member, *units)
            })
            .collect();
        let chains = fitted::chains_of(&spring, &members);
        // The very number, not its quotient.
        chains.into_iter().map(|chain| ChainParameters { pitch_m: self.pitch_m, ..chain }).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIVER: DVec3 = DVec3::new(0.200, 0.132, 0.104);

    #[test]
    fn decays_go_from_half_the_contact_to_a_third_of_the_body_and_shapes_end_in_whole_units() {
        for candidate in candidates(&Wanted::default(), 80, 0.005, LIVER) {
            let (first, last) = (candidate.decays_m[0], candidate.decays_m[candidate.decays_m.len() - 1]);
            assert!((first - 0.0025).abs() < 1e-12 && (last - 0.0809).abs() < 1e-3, "{candidate:?}");
            let ratio = candidate.decays_m[1] / first;
            for (decay, reach) in candidate.decays_m.iter().zip(candidate.reaches_m()) {
                assert!(reach > 14.0 * decay - 1e-9 && reach < 14.0 * decay + 0.005);
            }
            assert!(candidate.decays_m.windows(2).all(|pair| (pair[1] / pair[0] / ratio - 1.0).abs() < 1e-9));
        }
    }

    #[test]
    fn the_chains_are_accepted_and_have_the_shapes_and_the_stiffness_they_should() {
        for candidate in candidates(&Wanted::default(), 80, 0.002, LIVER) {
            let parameters = candidate.parameters(120.0, 0.05);
            let law =
                rhombus_chain::ContactLaw::new(rhombus_chain::Formulation::Energy, &parameters).unwrap();
            assert!((law.rest_stiffness_n_per_m() - 120.0).abs() < 1e-6);
            for ((chain, decay_m), units) in parameters.iter().zip(&candidate.decays_m).zip(&candidate.units)
            {
                assert!((-chain.pitch_m / chain.ratio.ln() / decay_m - 1.0).abs() < 1e-9);
                assert_eq!(chain.units, *units);
                assert_eq!(chain.pitch_m, candidate.pitch_m);
            }
        }
    }

    #[test]
    fn what_is_asked_for_is_tried_alone_and_few_sites_try_less() {
        let count = |wanted: Wanted, sites| candidates(&wanted, sites, 0.005, LIVER).len();
        assert_eq!(count(Wanted::default(), 80), 6);
        assert_eq!(count(Wanted { chains: Some(4), ..Wanted::default() }, 80), 3);
        assert_eq!(count(Wanted { harmonics: Some(2), ..Wanted::default() }, 80), 4);
        assert_eq!(count(Wanted { harmonics: Some(1), chains: Some(5), modes: None }, 80), 1);
        assert_eq!(count(Wanted::default(), 12), 4);
        assert_eq!(modes(&Wanted::default(), 20), [0, 8]);
        assert_eq!(modes(&Wanted { modes: Some(5), ..Wanted::default() }, 20), [5]);
    }
}
