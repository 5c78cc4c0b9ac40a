//! One chain: its contact law in closed form, under either formulation, with guards (MODEL section 2).
//!
//! With `e = dl_1 / (2 a)` the stretch all units share, `x = theta + d_theta` and `t = tan(theta + d_theta/2)`:
//!
//! ```text
//! DL = S dl_1
//! published:  F = (k_n - k_t t tan(theta)) dl_1          dF/dDL = (k_n - k_t tan(theta) tan(x)) / S
//! energy:     F = (K + T t tan(x)) dl_1 / S              dF/dDL = (K - T + T cos(theta)/cos^3(x)) / S^2
//! ```

use crate::parameters::{ChainParameters, Formulation, ParameterError};
use crate::sums::ChainSums;
use crate::unit::{Rhombus, StretchedRhombus};

/// One validated chain. Nothing in it changes; every query is RT safe.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    formulation: Formulation,
    parameters: ChainParameters,
    rhombus: Rhombus,
    /// `S_n`.
    elongation_sum: f64,
    /// Published: `k_n`. Energy: `K`. N/m.
    normal: f64,
    /// Published: `k_t`. Energy: `T`. N/m.
    tangential: f64,
    rest_stiffness: f64,
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

/// Force, stiffness and energy at one elongation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Law {
    pub(crate) force_n: f64,
    pub(crate) stiffness_n_per_m: f64,
    pub(crate) energy_j: f64,
    pub(crate) saturated: bool,
}

/// Where the closed form ends, and its values there.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Guard {
    shape: StretchedRhombus,
    elongation_m: f64,
    d_theta_rad: f64,
    law: Law,
}

/// Share of the geometrically possible range that is used.
const USED_RANGE: f64 = 0.98;
/// Energy law, pulled: guarded where the tangent stiffness is this multiple of its rest value.
const STIFFENING: f64 = 10.0;
/// Published law, pulled: guarded where the tangent stiffness has lost this share of its rest value.
const SOFTENING: f64 = 0.9;
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
        check_rise(index, formulation, parameters, &rhombus, sums.normal, tangential_sum)?;
        let (normal_sum, tangential_sum) = match formulation {
            Formulation::Published => (1.0, 1.0),
            Formulation::Energy => (sums.normal, tangential_sum),
        };
        let mut chain = Self {
            formulation,
            parameters: *parameters,
            rhombus,
            elongation_sum: sums.elongation,
            normal: parameters.normal_stiffness_n_per_m * normal_sum,
            tangential: parameters.tangential_stiffness_n_per_m * tangential_sum,
            rest_stiffness: 0.0,
            compression: Guard::UNSET,
            extension: Guard::UNSET,
        };
        chain.rest_stiffness = chain.stiffness(&rhombus.stretched(0.0));
        chain.compression = chain.guard(-USED_RANGE * rhombus.sine);
        chain.extension = chain.guard(chain.extension_limit());
        Ok(chain)
    }

    /// The chain's answer to `DL = elongation_m`, negative when pressed. RT safe.
    ///
    /// Any finite elongation has a finite answer. `ContactLaw::at_depth` is the gate that refuses NaN and infinity;
    /// here an infinite elongation counts as the largest finite one and NaN stays NaN.
    pub fn response(&self, elongation_m: f64) -> ChainResponse {
        let elongation_m = finite(elongation_m);
        let law = self.law(elongation_m);
        let kinematics = self.kinematics(elongation_m);
        ChainResponse {
            force_n: law.force_n,
            stiffness_n_per_m: law.stiffness_n_per_m,
            energy_j: law.energy_j,
            dl_1_m: kinematics.dl_1_m,
            d_theta_rad: kinematics.d_theta_rad,
            dw_1_m: kinematics.dw_1_m,
            saturated: law.saturated,
        }
    }

    /// The law alone: no transcendental function for the energy law, one arctangent for the published law's energy.
    #[inline]
    pub(crate) fn law(&self, elongation_m: f64) -> Law {
        let dl_1_m = elongation_m / self.elongation_sum;
        let stretch = dl_1_m / (2.0 * self.parameters.rod_length_m);
        if stretch < self.compression.shape.stretch {
            return self.compression.continued(elongation_m);
        }
        if stretch > self.extension.shape.stretch {
            return self.extension.continued(elongation_m);
        }
        self.closed_form(elongation_m, dl_1_m, &self.rhombus.stretched(stretch))
    }

    #[inline]
    fn closed_form(&self, elongation_m: f64, dl_1_m: f64, shape: &StretchedRhombus) -> Law {
        let (force_n, energy_j) = match self.formulation {
            Formulation::Published => {
                let coupling = self.tangential * self.rhombus.tangent;
                let force_n = (self.normal - coupling * shape.mean_tangent) * dl_1_m;
                // The integral of t dl is (t dl^2 + 4 a^2 (sin d_theta - d_theta)) / 2.
                let width = 2.0 * self.parameters.rod_length_m;
                let correction = coupling * width * width * shape.sine_excess() * self.elongation_sum;
                (force_n, 0.5 * (force_n * elongation_m - correction))
            }
            Formulation::Energy => {
                let t = shape.mean_tangent;
                let secant = self.normal + self.tangential * t * shape.tangent();
                let stored = self.normal + self.tangential * t * t;
                (secant * dl_1_m / self.elongation_sum, 0.5 * stored * dl_1_m * dl_1_m)
            }
        };
        Law { force_n, stiffness_n_per_m: self.stiffness(shape), energy_j, saturated: false }
    }

    /// `dF/dDL`, N/m. In the energy law `cos(theta) - cos^3(x)` is taken as `t e + cos(x) sin^2(x)`, which
    /// keeps the digits that a small angle would lose.
    #[inline]
    fn stiffness(&self, shape: &StretchedRhombus) -> f64 {
        let (sine, cosine) = (shape.sine, shape.cosine);
        match self.formulation {
            Formulation::Published => {
                (self.normal - self.tangential * self.rhombus.tangent * shape.tangent()) / self.elongation_sum
            }
            Formulation::Energy => {
                let cosines = shape.mean_tangent * shape.stretch + cosine * sine * sine;
                let tangential = self.tangential * cosines / (cosine * cosine * cosine);
                (self.normal + tangential) / (self.elongation_sum * self.elongation_sum)
            }
        }
    }

    /// The stretch at which the extension guard stands.
    fn extension_limit(&self) -> f64 {
        let by_geometry = USED_RANGE * self.rhombus.largest_stretch;
        if self.tangential == 0.0 {
            return by_geometry; // a linear law
        }
        let tangent = self.rhombus.tangent;
        let cosine = match self.formulation {
            // k_n - k_t tan(theta) tan(x) = (1 - 0.9) (k_n - k_t tan^2(theta))
            Formulation::Published => {
                let tangent_at_zero = self.normal / (self.tangential * tangent);
                let tangent_at_guard = tangent + SOFTENING * (tangent_at_zero - tangent);
                1.0 / (1.0 + tangent_at_guard * tangent_at_guard).sqrt()
            }
            // K - T + T cos(theta)/cos^3(x) = 10 (K + T tan^2(theta))
            //   =>  cos^3(x) = T cos(theta) / (9 K + T + 10 T tan^2(theta))
            Formulation::Energy => {
                let divisor = (STIFFENING - 1.0) * self.normal
                    + self.tangential * (1.0 + STIFFENING * tangent * tangent);
                libm::cbrt(self.tangential * self.rhombus.cosine / divisor)
            }
        };
        self.rhombus.stretch_at_cosine(cosine).clamp(0.0, by_geometry)
    }

    fn guard(&self, stretch: f64) -> Guard {
        let shape = self.rhombus.stretched(stretch);
        let dl_1_m = 2.0 * self.parameters.rod_length_m * stretch;
        let elongation_m = dl_1_m * self.elongation_sum;
        let law = self.closed_form(elongation_m, dl_1_m, &shape);
        Guard { shape, elongation_m, d_theta_rad: shape.d_theta(), law: Law { saturated: true, ..law } }
    }

    /// `dl_1`, `d_theta`, `dw_1`: continuous, and finite for every finite elongation.
    #[inline]
    pub(crate) fn kinematics(&self, elongation_m: f64) -> Kinematics {
        let dl_1_m = elongation_m / self.elongation_sum;
        let width = 2.0 * self.parameters.rod_length_m;
        let stretch = dl_1_m / width;
        let guard = if stretch < self.compression.shape.stretch {
            &self.compression
        } else if stretch > self.extension.shape.stretch {
            &self.extension
        } else {
            let shape = self.rhombus.stretched(stretch);
            let dw_1_m = -shape.mean_tangent * dl_1_m;
            return Kinematics { dl_1_m, d_theta_rad: shape.d_theta(), dw_1_m };
        };
        // d(dw)/d(dl) = -tan x.
        let shape = &guard.shape;
        let at_guard_m = width * shape.stretch;
        let dw_1_m = finite(-shape.mean_tangent * at_guard_m - shape.tangent() * (dl_1_m - at_guard_m));
        Kinematics { dl_1_m, d_theta_rad: guard.d_theta_rad, dw_1_m }
    }

    /// The formulation in force.
    pub fn formulation(&self) -> Formulation {
        self.formulation
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
        self.rest_stiffness
    }

    /// The guards, as elongations `DL` of the whole chain: (compression < 0, extension > 0), m.
    pub fn guarded_range_m(&self) -> (f64, f64) {
        (self.compression.elongation_m, self.extension.elongation_m)
    }
}

/// What the field needs of a chain at one elongation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Kinematics {
    pub(crate) dl_1_m: f64,
    pub(crate) d_theta_rad: f64,
    pub(crate) dw_1_m: f64,
}

impl Guard {
    const UNSET: Self = Self {
        shape: StretchedRhombus::UNSET,
        elongation_m: 0.0,
        d_theta_rad: 0.0,
        law: Law { force_n: 0.0, stiffness_n_per_m: 0.0, energy_j: 0.0, saturated: true },
    };

    /// The law beyond the guard: force linear with the tangent stiffness at the guard, energy its integral.
    #[inline]
    fn continued(&self, elongation_m: f64) -> Law {
        let beyond_m = elongation_m - self.elongation_m;
        let Law { force_n, stiffness_n_per_m, energy_j, saturated } = self.law;
        Law {
            force_n: finite(force_n + stiffness_n_per_m * beyond_m),
            stiffness_n_per_m,
            energy_j: finite(energy_j + (force_n + 0.5 * stiffness_n_per_m * beyond_m) * beyond_m),
            saturated,
        }
    }
}

/// Whether the law rises where MODEL section 2 asks for it.
fn check_rise(
    chain: usize,
    formulation: Formulation,
    parameters: &ChainParameters,
    rhombus: &Rhombus,
    normal_sum: f64,
    tangential_sum: f64,
) -> Result<(), ParameterError> {
    let normal = parameters.normal_stiffness_n_per_m;
    let tangential = parameters.tangential_stiffness_n_per_m;
    // The rule, for both laws: k_n > k_t * factor.
    let factor = match formulation {
        Formulation::Published => rhombus.tangent * rhombus.tangent,
        Formulation::Energy => {
            let half_sine = libm::sin(0.5 * parameters.angle_rad);
            tangential_sum * (2.0 * half_sine * half_sine) / normal_sum
        }
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

/// The nearest finite number: a linear continuation far beyond every length in the universe still answers, and still rises.
#[inline]
pub(crate) fn finite(value: f64) -> f64 {
    value.clamp(-f64::MAX, f64::MAX)
}
