//! What a calibration finds, and how it turns lengths, shares and stiffnesses into the model's parameters.

use rhombus_chain::{
    ChainParameters, ContactLaw, Formulation, ParameterError, SurfaceParameters, Tissue, TissueError,
};
use thiserror::Error;

/// Parallel chains found by a calibration, with the error they reach.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// Force law of all chains.
    pub formulation: Formulation,
    /// One or more chains, steepest shape first.
    pub chains: Vec<ChainParameters>,
    /// The surface around a contact.
    pub surface: SurfaceParameters,
    /// Radius of the spherical probe, m.
    pub probe_radius_m: f64,
    /// What was fitted, and how well.
    pub reached: Vec<Reached>,
    /// What the data cannot tell, and what was put in its place.
    pub notes: Vec<String>,
}

/// An error that was reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Reached {
    /// What was compared with what.
    pub what: String,
    /// The error as a share: 0.02 is 2 %.
    pub relative: f64,
}

/// Why nothing could be fitted.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum FitError {
    /// An input number outside its range.
    #[error("{name} = {value}; accepted: {accepted}")]
    Input {
        /// What was given.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What is accepted.
        accepted: &'static str,
    },
    /// Less data than unknowns.
    #[error("{found} {what}; accepted: {needed} or more for {chains} chains")]
    TooFew {
        /// What there is too little of.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many it takes.
        needed: usize,
        /// Parallel chains asked for.
        chains: usize,
    },
    /// The solver ended without a number.
    #[error(
        "the fit of the {0} has no solution; are all numbers of the data in the units their header says?"
    )]
    NoSolution(&'static str),
    /// The model refuses what was found.
    #[error("the model does not accept what was fitted: {0}")]
    Refused(#[from] ParameterError),
    /// The model refuses what was found.
    #[error("the model does not accept what was fitted: {0}")]
    RefusedTissue(#[from] TissueError),
    /// Anything else about the data, with what is accepted.
    #[error("{0}")]
    Data(String),
}

/// Largest number of parallel chains that is fitted. More than five never helped on any reference.
pub const MOST_CHAINS: usize = 8;

/// Units of a fitted chain. The shape depends on `q^(s/h)`, so their number is free; a hundred are many.
const UNITS: u32 = 100;

/// `beta` of a fitted chain: no data tell it apart from `k_t`.
pub(super) const GROWTH: f64 = 20.0;

/// `theta` where no data tell it, rad.
pub(super) const ANGLE_RAD: f64 = 0.3;

/// A chain's shape is over after this many decay lengths where nothing ends it earlier: `e^-16 = 1e-7`.
pub(super) const LONG: f64 = 16.0;

/// Data are never taken to be better than this share of the depth or force.
pub(super) const BEST_DATA: f64 = 1e-3;

impl Fitted {
    /// The contact law.
    ///
    /// # Errors
    /// The model does not accept the chains.
    pub fn law(&self) -> Result<ContactLaw, ParameterError> {
        ContactLaw::new(self.formulation, &self.chains)
    }

    /// The validated settings of the model. The lateral stiffness of a grasp is the scene's default.
    ///
    /// # Errors
    /// The model does not accept the settings.
    pub fn tissue(&self) -> Result<Tissue, FitError> {
        const LATERAL: f64 = 0.5;
        Ok(Tissue::new(self.law()?, self.surface, self.probe_radius_m, LATERAL)?)
    }
}

/// One chain as a calibration thinks of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Member {
    /// Share of the surface's shape; of the force too.
    pub(super) weight: f64,
    /// `h / -ln q`, m.
    pub(super) decay_m: f64,
    /// `n h`, m: where the shape ends.
    pub(super) extent_m: f64,
    /// `theta`, rad.
    pub(super) angle_rad: f64,
}

/// The force law that all chains share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Spring {
    pub(super) formulation: Formulation,
    /// Stiffness at rest of all chains together, N/m.
    pub(super) rest_n_per_m: f64,
    /// How much of the largest acceptable tangential stiffness there is, 0 to less than 1.
    pub(super) tangential: f64,
    /// Depth at which every unit would be flat, m.
    pub(super) range_m: f64,
}

/// The model's parameters. With every share of `tangential` below 1 the law is acceptable (MODEL section 2):
///
/// ```text
/// energy     K > T (1 - cos(theta))      T = tangential K / (1 - cos(theta))
/// published  k_n > k_t tan^2(theta)      k_t = tangential k_n / tan^2(theta)
/// ```
pub(super) fn chains(spring: &Spring, members: &[Member]) -> Vec<ChainParameters> {
    let with_units: Vec<(Member, u32)> = members.iter().map(|member| (*member, UNITS)).collect();
    chains_of(spring, &with_units)
}

/// As [`chains`], each with its own number of units.
pub(super) fn chains_of(spring: &Spring, members: &[(Member, u32)]) -> Vec<ChainParameters> {
    let weights: f64 = members.iter().map(|(member, _)| member.weight).sum();
    members.iter().map(|(member, units)| chain(spring, member, *units, member.weight / weights)).collect()
}

fn chain(spring: &Spring, member: &Member, units: u32, weight: f64) -> ChainParameters {
    let n = f64::from(units);
    let ratio = libm::exp(-member.extent_m / (n * member.decay_m));
    let sum = |r: f64| (0..units).rev().fold(0.0, |sum, _| 1.0 + r * sum);
    let (s, normal, tangential) =
        (sum(ratio), sum(ratio * ratio), sum(ratio * ratio * libm::exp(1.0 / GROWTH)));
    let (sine, cosine) = (libm::sin(member.angle_rad), libm::cos(member.angle_rad));
    let tangent = sine / cosine;
    // 1 - cos(theta)
    let versine = sine * sine / (1.0 + cosine);
    let rest = weight * spring.rest_n_per_m;
    let share = spring.tangential;
    let (k_n, k_t) = match spring.formulation {
        Formulation::Energy => {
            let k = rest / (1.0 + share * tangent * tangent / versine);
            (k * s * s / normal, share * k / versine * s * s / tangential)
        }
        Formulation::Published => {
            let k_n = rest * s / (1.0 - share);
            (k_n, share * k_n / (tangent * tangent))
        }
    };
    ChainParameters {
        rod_length_m: spring.range_m / (2.0 * sine * s),
        angle_rad: member.angle_rad,
        ratio,
        units,
        normal_stiffness_n_per_m: k_n,
        tangential_stiffness_n_per_m: k_t,
        tangential_growth: GROWTH,
        weight,
        pitch_m: member.extent_m / n,
    }
}
