//! The contact law of one chain in closed form, without guards: equation (10) and MODEL section 2.
//!
//! All units share the stretch `e = dl_i / (2 a_i)`, hence `DL = span e` with `span = 2 a S_n`. With `x = theta + d_theta` and
//! `t = tan(theta + d_theta/2)` both formulations have the same shape in `DL`:
//!
//! ```text
//! published   F = (k - c (t - tan(theta))) DL     dF/dDL = k - c (tan(x) - tan(theta))
//!             k = (k_n - k_t tan^2(theta))/S,     c = k_t tan(theta)/S
//! energy      F = (k + c t tan(x)) DL             dF/dDL = k + c (cos(theta) - cos^3(x))/cos^3(x)
//!             k = K/S^2,                          c = T/S^2
//! ```

use crate::parameters::Formulation;
use crate::unit::{Rhombus, StretchedRhombus};

/// One chain's law inside its guards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ClosedForm {
    pub(crate) formulation: Formulation,
    pub(crate) rhombus: Rhombus,
    /// Elongation of the chain for a stretch of 1, m.
    pub(crate) span_m: f64,
    /// `k`, N/m.
    pub(crate) normal: f64,
    /// `c`, N/m.
    pub(crate) coupling: f64,
}

/// Force, stiffness and energy of a chain at one elongation, in the paper's signs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Law {
    pub(crate) force_n: f64,
    pub(crate) stiffness_n_per_m: f64,
    pub(crate) energy_j: f64,
}

/// Share of the geometrically possible range that is used.
const USED_RANGE: f64 = 0.98;
/// Energy law, pulled: guarded where the tangent stiffness is this multiple of its rest value.
const STIFFENING: f64 = 10.0;
/// Published law, pulled: guarded where the tangent stiffness has lost this share of its rest value.
const SOFTENING: f64 = 0.9;

impl ClosedForm {
    /// The law at an elongation and the shape that goes with it.
    ///
    /// The energy is the integral of the force. Under the energy law that is what the springs store, `(k + c t^2) DL^2 / 2`;
    /// under the published law, whose force no spring stores, `(F DL - c span^2 (sin(d_theta) - d_theta)) / 2`.
    #[inline]
    pub(crate) fn at(&self, elongation_m: f64, shape: &StretchedRhombus) -> Law {
        let (force_n, energy_j) = match self.formulation {
            Formulation::Published => {
                // t - tan(theta), which the difference would round away next to a small k.
                let rise = shape.turn_sine() / (self.rhombus.cosine * shape.cosines);
                let force_n = (self.normal - self.coupling * rise) * elongation_m;
                let excess = self.coupling * self.span_m * self.span_m * shape.sine_excess();
                (force_n, 0.5 * (force_n * elongation_m - excess))
            }
            Formulation::Energy => {
                let t = shape.mean_tangent;
                let force_n = (self.normal + self.coupling * t * shape.tangent()) * elongation_m;
                (force_n, 0.5 * (self.normal + self.coupling * t * t) * elongation_m * elongation_m)
            }
        };
        Law { force_n, stiffness_n_per_m: self.stiffness(shape), energy_j }
    }

    /// `dF/dDL`, N/m.
    #[inline]
    pub(crate) fn stiffness(&self, shape: &StretchedRhombus) -> f64 {
        match self.formulation {
            Formulation::Published => {
                self.normal - self.coupling * shape.turn_sine() / (self.rhombus.cosine * shape.cosine)
            }
            Formulation::Energy => {
                let (sine, cosine) = (shape.sine, shape.cosine);
                // cos(theta) - cos^3(x), with the digits that a small angle would lose.
                let difference = shape.mean_tangent * shape.stretch + cosine * sine * sine;
                self.normal + self.coupling * difference / (cosine * cosine * cosine)
            }
        }
    }

    /// The stretch of the compression guard: 98 % of what geometry allows.
    pub(crate) fn largest_compression(&self) -> f64 {
        -USED_RANGE * self.rhombus.sine
    }

    /// The stretch of the extension guard: 98 % of what geometry allows, or where the tangent stiffness has changed too far.
    pub(crate) fn largest_extension(&self) -> f64 {
        let by_geometry = USED_RANGE * self.rhombus.largest_stretch;
        if self.coupling == 0.0 {
            return by_geometry; // a straight line
        }
        let by_stiffness = match self.formulation {
            Formulation::Published => self.softened_stretch(),
            Formulation::Energy => self.stiffened_stretch(),
        };
        by_stiffness.clamp(0.0, by_geometry)
    }

    /// Where `k - c (tan(x) - tan(theta)) = (1 - 0.9) k`.
    fn softened_stretch(&self) -> f64 {
        let Rhombus { sine, cosine, tangent, .. } = self.rhombus;
        let rise = SOFTENING * self.normal / self.coupling;
        // tan(d_theta) = rise / (1 + tan(theta) tan(x)), in a form that holds for a rise of 0 and of infinity.
        let d_theta = libm::atan(1.0 / ((1.0 + tangent * tangent) / rise + tangent));
        let half_sine = libm::sin(0.5 * d_theta);
        cosine * libm::sin(d_theta) - 2.0 * sine * half_sine * half_sine
    }

    /// Where `k + c (cos(theta)/cos^3(x) - 1) = 10 (k + c tan^2(theta))`, that is
    /// `cos^3(x) = c cos(theta) / (9 k + c + 10 c tan^2(theta))`.
    fn stiffened_stretch(&self) -> f64 {
        let Rhombus { sine, cosine, tangent, .. } = self.rhombus;
        let excess = (STIFFENING - 1.0) * self.normal + STIFFENING * self.coupling * tangent * tangent;
        let cosine_at_guard = libm::cbrt(self.coupling * cosine / (excess + self.coupling));
        // 1 - cos(x) from 1 - cos^3(x), where nothing cancels.
        let versine = (excess + self.coupling * sine * sine / (1.0 + cosine))
            / (excess + self.coupling)
            / (1.0 + cosine_at_guard * (1.0 + cosine_at_guard));
        self.rhombus.stretch_at(cosine_at_guard, versine)
    }
}
