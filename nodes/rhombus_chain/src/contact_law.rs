//! The contact law of a body: parallel chains on one contact point (MODEL section 3). Same depth, forces add.

use crate::chain::{Chain, finite};
use crate::parameters::{ChainParameters, Formulation, ParameterError, WEIGHT_TOLERANCE};

/// One or more validated chains in parallel. Nothing in it changes; every query is RT safe.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactLaw {
    formulation: Formulation,
    chains: Vec<Chain>,
    rest_stiffness_n_per_m: f64,
    /// Elongations outside of which every chain is past its guard, so that the law is a straight line.
    straight_below_m: f64,
    straight_above_m: f64,
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
        let straight_below_m = chains.iter().map(|chain| chain.guarded_range_m().0).fold(0.0, f64::min);
        let straight_above_m = chains.iter().map(|chain| chain.guarded_range_m().1).fold(0.0, f64::max);
        Ok(Self { formulation, chains, rest_stiffness_n_per_m, straight_below_m, straight_above_m })
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
        let mut response = self.at_elongation(elongation_m(depth_m));
        response.force_n = 0.0 - response.force_n;
        Ok(response)
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
        let below = self.at_elongation(self.straight_below_m);
        let above = self.at_elongation(self.straight_above_m);
        let elongation_m = if target_n <= below.force_n {
            self.straight_below_m
                + (target_n - below.force_n) / self.slope_beyond(self.straight_below_m, -1.0)
        } else if target_n >= above.force_n {
            self.straight_above_m + (target_n - above.force_n) / self.slope_beyond(self.straight_above_m, 1.0)
        } else {
            self.elongation_between(target_n)
        };
        if elongation_m.is_finite() {
            return Ok(0.0 - elongation_m);
        }
        let largest_n = finite(self.at_elongation(finite(elongation_m)).force_n);
        Err(ForceError::OutOfReach { force_n, largest_n: 0.0 - largest_n })
    }

    /// The slope of the straight line that begins at an outermost guard, N/m.
    fn slope_beyond(&self, guard_m: f64, direction: f64) -> f64 {
        self.at_elongation(guard_m + direction * guard_m.abs()).stiffness_n_per_m
    }

    /// Newton's method from the rest stiffness, inside a bracket that every step narrows; a step that leaves the bracket is
    /// replaced by its middle. The law rises, so there is one root.
    fn elongation_between(&self, target_n: f64) -> f64 {
        /// Newton needs under ten; halving alone ends within the digits of f64 after about a hundred for any tissue.
        const MOST_STEPS: usize = 2200;
        let tolerance_n = 1e-13 * target_n.abs().max(1e-9 * self.rest_stiffness_n_per_m);
        let (mut low_m, mut high_m) = (self.straight_below_m, self.straight_above_m);
        let mut elongation_m = (target_n / self.rest_stiffness_n_per_m).clamp(low_m, high_m);
        for _ in 0..MOST_STEPS {
            let response = self.at_elongation(elongation_m);
            let error_n = response.force_n - target_n;
            if error_n.abs() <= tolerance_n {
                break;
            }
            if error_n < 0.0 {
                low_m = elongation_m;
            } else {
                high_m = elongation_m;
            }
            let newton_m = elongation_m - error_n / response.stiffness_n_per_m;
            let next_m =
                if newton_m > low_m && newton_m < high_m { newton_m } else { 0.5 * (low_m + high_m) };
            if next_m == elongation_m {
                break;
            }
            elongation_m = next_m;
        }
        elongation_m
    }

    /// In the paper's sign: `F(DL)`.
    #[inline]
    fn at_elongation(&self, elongation_m: f64) -> LawResponse {
        let mut sum = LawResponse { force_n: 0.0, stiffness_n_per_m: 0.0, energy_j: 0.0, saturated: false };
        for chain in &self.chains {
            let law = chain.law(elongation_m);
            sum.force_n += law.force_n;
            sum.stiffness_n_per_m += law.stiffness_n_per_m;
            sum.energy_j += law.energy_j;
            sum.saturated |= law.saturated;
        }
        sum.force_n = finite(sum.force_n);
        sum.energy_j = finite(sum.energy_j);
        sum
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

/// `DL` of a depth; a zero depth is the positive zero.
#[inline]
pub(crate) fn elongation_m(depth_m: f64) -> f64 {
    0.0 - depth_m
}
