//! The contact law of a body: parallel chains on one contact point (MODEL section 3). Same depth, forces add.

use crate::chain::{Chain, finite};
use crate::closed_form::Law;
use crate::parameter_error::ParameterError;
use crate::parameters::{ChainParameters, Formulation, WEIGHT_TOLERANCE};

/// One or more validated chains in parallel. Nothing in it changes; every query is RT safe.
///
/// ```
/// use rhombus_chain::{ChainParameters, ContactLaw, Formulation};
///
/// let chain = ChainParameters {
///     rod_length_m: 0.01,
///     angle_rad: 0.5236,
///     ratio: 0.8,
///     units: 12,
///     normal_stiffness_n_per_m: 500.0,
///     tangential_stiffness_n_per_m: 100.0,
///     tangential_growth: 10.0,
///     weight: 1.0,
///     pitch_m: 0.0173,
/// };
/// let law = ContactLaw::new(Formulation::Energy, &[chain])?;
/// let pressed = law.at_depth(0.006)?;
/// assert!((pressed.force_n - 0.406_38).abs() < 1e-5, "6 mm push out with 0.4 N");
/// assert!((law.depth_for_force(pressed.force_n)? - 0.006).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ContactLaw {
    formulation: Formulation,
    chains: Vec<Chain>,
    rest_stiffness_n_per_m: f64,
    /// Past the outermost compression guard and past the outermost extension guard every chain is continued.
    below: StraightLine,
    above: StraightLine,
}

/// The whole law past an outermost guard, in the paper's signs.
#[derive(Debug, Clone, Copy, PartialEq)]
struct StraightLine {
    from_m: f64,
    force_n: f64,
    slope_n_per_m: f64,
}

/// Answer of a contact law to a depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawResponse {
    /// Force on the hand along the outward normal, N; positive pushes out.
    pub force_n: f64,
    /// Its derivative with respect to depth, N/m; never negative.
    pub stiffness_n_per_m: f64,
    /// Work done on the body from rest, J.
    pub energy_j: f64,
    /// Whether any chain is past its guard.
    pub saturated: bool,
}

/// A NaN or an infinity where a number was needed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("{quantity} is {value}; it must be a finite number")]
pub struct NonFinite {
    /// What was asked for, with its unit.
    pub quantity: &'static str,
    /// The value received.
    pub value: f64,
}

/// Why no depth answers a force.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ForceError {
    /// A NaN or infinite force.
    #[error(transparent)]
    NonFinite(#[from] NonFinite),
    /// A force that no depth an f64 can hold gives.
    #[error("no depth gives a force of {force_n} N; accepted is up to {largest_n} N in this direction")]
    OutOfReach {
        /// The force asked for, N.
        force_n: f64,
        /// The largest force in its direction, N.
        largest_n: f64,
    },
}

impl ContactLaw {
    /// Checks the chains, each by itself, and their weights.
    ///
    /// # Errors
    /// No chain, a chain that is refused, or weights whose sum is not 1 within 1e-9.
    pub fn new(formulation: Formulation, parameters: &[ChainParameters]) -> Result<Self, ParameterError> {
        if parameters.is_empty() {
            return Err(ParameterError::NoChain);
        }
        let mut chains = Vec::with_capacity(parameters.len());
        for (index, parameters) in parameters.iter().enumerate() {
            chains.push(Chain::new(index, formulation, parameters)?);
        }
        let sum: f64 = parameters.iter().map(|chain| chain.weight).sum();
        if (sum - 1.0).abs() > WEIGHT_TOLERANCE {
            return Err(ParameterError::WeightSum { chains: chains.len(), sum });
        }
        let rest_stiffness_n_per_m = chains.iter().map(Chain::rest_stiffness_n_per_m).sum();
        Ok(Self {
            formulation,
            rest_stiffness_n_per_m,
            below: StraightLine::below(&chains),
            above: StraightLine::above(&chains),
            chains,
        })
    }

    /// The force on the hand at a depth, positive into the body. RT safe, closed form.
    ///
    /// Every finite depth has a finite answer: past a guard a chain's law continues linearly.
    ///
    /// # Errors
    /// A NaN or infinite depth.
    pub fn at_depth(&self, depth_m: f64) -> Result<LawResponse, NonFinite> {
        if !depth_m.is_finite() {
            return Err(NonFinite { quantity: "depth_m", value: depth_m });
        }
        let elongation_m = elongation_m(depth_m);
        let Law { force_n, stiffness_n_per_m, energy_j } = sum_of_laws(&self.chains, elongation_m);
        let saturated = self.chains.iter().any(|chain| chain.is_saturated(elongation_m));
        Ok(LawResponse { force_n: 0.0 - force_n, stiffness_n_per_m, energy_j, saturated })
    }

    /// The depth at which the hand feels `force_n` (positive pushes out). RT safe: bounded, no allocation.
    ///
    /// `|force(depth) - force_n| <= 1e-12 max(|force_n|, 1e-9 m * rest stiffness)`.
    ///
    /// # Errors
    /// A NaN or infinite force, or one so large that its depth is no finite number.
    pub fn depth_for_force(&self, force_n: f64) -> Result<f64, ForceError> {
        if !force_n.is_finite() {
            return Err(NonFinite { quantity: "force_n", value: force_n }.into());
        }
        let target_n = 0.0 - force_n;
        let elongation_m = if target_n <= self.below.force_n {
            self.below.elongation_m(target_n)
        } else if target_n >= self.above.force_n {
            self.above.elongation_m(target_n)
        } else {
            self.elongation_between(target_n)
        };
        if elongation_m.is_finite() {
            return Ok(0.0 - elongation_m);
        }
        let largest_n = 0.0 - sum_of_laws(&self.chains, finite(elongation_m)).force_n;
        Err(ForceError::OutOfReach { force_n, largest_n })
    }

    /// Newton's method from the rest stiffness, in a bracket that every step narrows. A step that leaves the bracket or
    /// does not halve the error is followed by a halving of the bracket. The law rises, so there is one root.
    fn elongation_between(&self, target_n: f64) -> f64 {
        /// Newton needs under ten. Halving the whole range of f64 down to neighbours takes about 2100.
        const MOST_STEPS: usize = 2200;
        let tolerance_n = 1e-13 * target_n.abs().max(1e-9 * self.rest_stiffness_n_per_m);
        let (mut low_m, mut high_m) = (self.below.from_m, self.above.from_m);
        let mut elongation_m = (target_n / self.rest_stiffness_n_per_m).clamp(low_m, high_m);
        let mut previous_error_n = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let Law { force_n, stiffness_n_per_m, .. } = sum_of_laws(&self.chains, elongation_m);
            let error_n = force_n - target_n;
            if error_n.abs() <= tolerance_n {
                break;
            }
            if error_n < 0.0 {
                low_m = elongation_m;
            } else {
                high_m = elongation_m;
            }
            let newton_m = elongation_m - error_n / stiffness_n_per_m;
            let converges = newton_m > low_m && newton_m < high_m && error_n.abs() <= 0.5 * previous_error_n;
            let next_m = if converges { newton_m } else { 0.5 * (low_m + high_m) };
            if next_m == elongation_m {
                break;
            }
            previous_error_n = error_n.abs();
            elongation_m = next_m;
        }
        elongation_m
    }

    /// The formulation of every chain.
    pub fn formulation(&self) -> Formulation {
        self.formulation
    }

    /// The chains, in the order of the parameters.
    pub fn chains(&self) -> &[Chain] {
        &self.chains
    }

    /// Tangent stiffness at rest, N/m.
    pub fn rest_stiffness_n_per_m(&self) -> f64 {
        self.rest_stiffness_n_per_m
    }
}

impl StraightLine {
    fn below(chains: &[Chain]) -> Self {
        let from_m = chains.iter().map(|chain| chain.guarded_range_m().0).fold(0.0, f64::min);
        let slope_n_per_m = chains.iter().map(|chain| chain.continued_stiffness_n_per_m().0).sum();
        Self { from_m, force_n: sum_of_laws(chains, from_m).force_n, slope_n_per_m }
    }

    fn above(chains: &[Chain]) -> Self {
        let from_m = chains.iter().map(|chain| chain.guarded_range_m().1).fold(0.0, f64::max);
        let slope_n_per_m = chains.iter().map(|chain| chain.continued_stiffness_n_per_m().1).sum();
        Self { from_m, force_n: sum_of_laws(chains, from_m).force_n, slope_n_per_m }
    }

    fn elongation_m(&self, target_n: f64) -> f64 {
        self.from_m + (target_n - self.force_n) / self.slope_n_per_m
    }
}

/// Same elongation, forces add; in the paper's signs.
#[inline]
fn sum_of_laws(chains: &[Chain], elongation_m: f64) -> Law {
    let mut sum = Law { force_n: 0.0, stiffness_n_per_m: 0.0, energy_j: 0.0 };
    for chain in chains {
        let law = chain.law(elongation_m);
        sum.force_n += law.force_n;
        sum.stiffness_n_per_m += law.stiffness_n_per_m;
        sum.energy_j += law.energy_j;
    }
    Law { force_n: finite(sum.force_n), energy_j: finite(sum.energy_j), ..sum }
}

/// `DL` of a depth; a zero depth is the positive zero.
#[inline]
pub(crate) fn elongation_m(depth_m: f64) -> f64 {
    0.0 - depth_m
}
