//! One chain: its closed form between two guards, and the straight continuation beyond them (MODEL section 2).

use crate::closed_form::{ClosedForm, Law};
use crate::parameter_error::ParameterError;
use crate::parameters::{ChainParameters, Formulation};
use crate::sums::ChainSums;
use crate::unit::{Rhombus, StretchedRhombus};

/// One validated chain. Nothing in it changes; every query is RT safe.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    parameters: ChainParameters,
    /// `S_n`.
    elongation_sum: f64,
    closed_form: ClosedForm,
    compression: Guard,
    extension: Guard,
}

/// A chain's answer to an elongation. Signs as in the paper: pulled is positive, pressed is negative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChainResponse {
    /// `F`, N.
    pub force_n: f64,
    /// `dF/dDL`, N/m; never negative.
    pub stiffness_n_per_m: f64,
    /// Work done on the chain from rest, the integral of `F`, J; under the energy law, what its springs store.
    pub energy_j: f64,
    /// `DL / S_n`, m, past a guard too.
    pub dl_1_m: f64,
    /// Turn of every rod, rad; past a guard it stays at the guard's.
    pub d_theta_rad: f64,
    /// Change of the first unit's tangential diagonal (7), m; past a guard it continues linearly.
    pub dw_1_m: f64,
    /// Whether the chain is past a guard, where the law is continued linearly.
    pub saturated: bool,
}

/// `dl_1`, `d_theta`, `dw_1` at one elongation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Kinematics {
    pub(crate) dl_1_m: f64,
    pub(crate) d_theta_rad: f64,
    pub(crate) dw_1_m: f64,
}

/// Where the closed form ends, and its values there.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Guard {
    elongation_m: f64,
    shape: StretchedRhombus,
    law: Law,
}

/// The acceptance rules hold by at least this share of the normal stiffness: with less, rounding decides the sign of the slope.
const RISE_MARGIN: f64 = 1e-12;

impl Chain {
    /// Checks the parameters (MODEL section 2). `index` is the chain's place in the scene's arrays, for messages.
    ///
    /// # Errors
    /// A parameter outside its range, tangential springs whose stiffness overflows, or a law that would not rise.
    pub fn new(
        index: usize,
        formulation: Formulation,
        parameters: &ChainParameters,
    ) -> Result<Self, ParameterError> {
        parameters.check_ranges(index)?;
        let rhombus = Rhombus::new(parameters.angle_rad);
        let sums = ChainSums::new(parameters.ratio, parameters.units, parameters.tangential_growth);
        let tangential_sum = match sums.tangential {
            _ if parameters.tangential_stiffness_n_per_m == 0.0 => 0.0,
            Some(sum) => sum,
            None => {
                return Err(ParameterError::TangentialOverflow {
                    chain: index,
                    growth: parameters.tangential_growth,
                    ratio: parameters.ratio,
                    units: parameters.units,
                });
            }
        };
        check_rise(index, formulation, parameters, &rhombus, tangential_sum / sums.normal)?;
        let s = sums.elongation;
        let (k_n, k_t) = (parameters.normal_stiffness_n_per_m, parameters.tangential_stiffness_n_per_m);
        let (normal, coupling) = match formulation {
            Formulation::Published => {
                ((k_n - k_t * rhombus.tangent * rhombus.tangent) / s, k_t * rhombus.tangent / s)
            }
            Formulation::Energy => (k_n * sums.normal / (s * s), k_t * tangential_sum / (s * s)),
        };
        let closed_form =
            ClosedForm { formulation, rhombus, span_m: 2.0 * parameters.rod_length_m * s, normal, coupling };
        Ok(Self {
            parameters: *parameters,
            elongation_sum: s,
            closed_form,
            compression: Guard::new(&closed_form, closed_form.largest_compression()),
            extension: Guard::new(&closed_form, closed_form.largest_extension()),
        })
    }

    /// The chain's answer to `DL = elongation_m`, negative when pressed. RT safe.
    ///
    /// Any finite elongation has a finite answer. `ContactLaw::at_depth` is the gate that refuses NaN and infinity;
    /// here an infinite elongation counts as the largest finite one and NaN stays NaN.
    pub fn response(&self, elongation_m: f64) -> ChainResponse {
        let elongation_m = finite(elongation_m);
        let Law { force_n, stiffness_n_per_m, energy_j } = self.law(elongation_m);
        let Kinematics { dl_1_m, d_theta_rad, dw_1_m } = self.kinematics(elongation_m);
        let saturated = self.is_saturated(elongation_m);
        ChainResponse { force_n, stiffness_n_per_m, energy_j, dl_1_m, d_theta_rad, dw_1_m, saturated }
    }

    /// The law alone. Under the energy law it needs no transcendental function; the published law's energy needs one arctangent.
    #[inline]
    pub(crate) fn law(&self, elongation_m: f64) -> Law {
        let stretch = elongation_m / self.closed_form.span_m;
        match self.passed_guard(stretch) {
            Some(guard) => guard.continued(elongation_m),
            None => self.closed_form.at(elongation_m, &self.closed_form.rhombus.stretched(stretch)),
        }
    }

    /// What the field needs; continuous, and finite for every finite elongation.
    #[inline]
    pub(crate) fn kinematics(&self, elongation_m: f64) -> Kinematics {
        let dl_1_m = elongation_m / self.elongation_sum;
        let stretch = elongation_m / self.closed_form.span_m;
        let Some(guard) = self.passed_guard(stretch) else {
            let shape = self.closed_form.rhombus.stretched(stretch);
            return Kinematics { dl_1_m, d_theta_rad: shape.d_theta(), dw_1_m: -shape.mean_tangent * dl_1_m };
        };
        // d(dw)/d(dl) = -tan x.
        let shape = &guard.shape;
        let at_guard_m = guard.elongation_m / self.elongation_sum;
        let dw_1_m = -shape.mean_tangent * at_guard_m - shape.tangent() * (dl_1_m - at_guard_m);
        Kinematics { dl_1_m, d_theta_rad: shape.d_theta(), dw_1_m: finite(dw_1_m) }
    }

    /// Whether an elongation is past a guard.
    #[inline]
    pub(crate) fn is_saturated(&self, elongation_m: f64) -> bool {
        self.passed_guard(elongation_m / self.closed_form.span_m).is_some()
    }

    #[inline]
    fn passed_guard(&self, stretch: f64) -> Option<&Guard> {
        if stretch < self.compression.shape.stretch {
            Some(&self.compression)
        } else if stretch > self.extension.shape.stretch {
            Some(&self.extension)
        } else {
            None
        }
    }

    /// The formulation in force.
    pub fn formulation(&self) -> Formulation {
        self.closed_form.formulation
    }

    /// The parameters the chain was made from.
    pub fn parameters(&self) -> &ChainParameters {
        &self.parameters
    }

    /// `S_n = (1 - q^n)/(1 - q)`: depth at the contact for each metre of `dl_1` (10).
    pub fn elongation_sum(&self) -> f64 {
        self.elongation_sum
    }

    /// `dF/dDL` at rest, N/m.
    pub fn rest_stiffness_n_per_m(&self) -> f64 {
        self.closed_form.stiffness(&self.closed_form.rhombus.stretched(0.0))
    }

    /// The guards, as elongations `DL` of the whole chain: (compression < 0, extension > 0), m.
    pub fn guarded_range_m(&self) -> (f64, f64) {
        (self.compression.elongation_m, self.extension.elongation_m)
    }

    /// `dF/dDL` beyond the two guards: (compression, extension), N/m.
    pub(crate) fn continued_stiffness_n_per_m(&self) -> (f64, f64) {
        (self.compression.law.stiffness_n_per_m, self.extension.law.stiffness_n_per_m)
    }
}

impl Guard {
    fn new(closed_form: &ClosedForm, stretch: f64) -> Self {
        let shape = closed_form.rhombus.stretched(stretch);
        let elongation_m = closed_form.span_m * stretch;
        Self { elongation_m, shape, law: closed_form.at(elongation_m, &shape) }
    }

    /// The law beyond the guard: force linear with the tangent stiffness at the guard, energy its integral.
    #[inline]
    fn continued(&self, elongation_m: f64) -> Law {
        let beyond_m = finite(elongation_m - self.elongation_m);
        let Law { force_n, stiffness_n_per_m, energy_j } = self.law;
        Law {
            force_n: finite(force_n + stiffness_n_per_m * beyond_m),
            stiffness_n_per_m,
            energy_j: finite(energy_j + (force_n + 0.5 * stiffness_n_per_m * beyond_m) * beyond_m),
        }
    }
}

/// Whether the law rises where MODEL section 2 asks for it. `sum_ratio`: `(T/k_t) / (K/k_n)`.
fn check_rise(
    chain: usize,
    formulation: Formulation,
    parameters: &ChainParameters,
    rhombus: &Rhombus,
    sum_ratio: f64,
) -> Result<(), ParameterError> {
    let normal = parameters.normal_stiffness_n_per_m;
    let tangential = parameters.tangential_stiffness_n_per_m;
    // Both rules are k_n > k_t factor.
    let factor = match formulation {
        Formulation::Published => rhombus.tangent * rhombus.tangent,
        // 1 - cos(theta) = sin^2(theta) / (1 + cos(theta))
        Formulation::Energy => sum_ratio * (rhombus.sine * rhombus.sine / (1.0 + rhombus.cosine)),
    };
    let least_normal = tangential * factor;
    if normal * (1.0 - RISE_MARGIN) > least_normal {
        return Ok(());
    }
    let most_tangential = normal / factor;
    Err(match formulation {
        Formulation::Published => {
            ParameterError::NotRising { chain, normal, tangential, least_normal, most_tangential }
        }
        Formulation::Energy => {
            ParameterError::SnapsThrough { chain, normal, tangential, least_normal, most_tangential }
        }
    })
}

/// The nearest finite number. Only a continuation some 300 orders of magnitude beyond any body comes here;
/// it then stays at the largest number, which is still finite and still does not fall.
#[inline]
pub(crate) fn finite(value: f64) -> f64 {
    value.clamp(-f64::MAX, f64::MAX)
}
