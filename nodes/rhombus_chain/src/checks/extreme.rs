//! Chains and depths far beyond any tissue.

use crate::parameters::{ChainParameters, Formulation};

/// One chain and one depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extreme {
    /// The force law.
    pub formulation: Formulation,
    /// The chain.
    pub chain: ChainParameters,
    /// Depth, positive into the body, m.
    pub depth_m: f64,
}

impl Extreme {
    /// How many numbers make one.
    pub const NUMBERS: usize = 10;

    /// From numbers between 0 and 1: both formulations, a from 1e-4 to 1 m, theta from 0.1 to 89.9 degrees (densest at both
    /// ends), q from 0.02 to 1 - 1e-9, n from 1 to 10^6, k_n from 1e-3 to 1e9 N/m, k_t/k_n from 1e-6 to 1e6, beta from 1e-3 to
    /// 1e6, depths of either sign from 1e-300 to 1e300 m. What spans decades is even in the exponent.
    #[must_use]
    pub fn from_unit(numbers: [f64; Self::NUMBERS]) -> Self {
        let [formulation, rod, angle, decay, units, normal, ratio_of_springs, growth, depth, sign] = numbers;
        let decades = |low: f64, high: f64, number: f64| libm::pow(10.0, low + (high - low) * number);
        let rod_length_m = decades(-4.0, 0.0, rod);
        let angle_rad = (0.1 + 89.8 * (0.5 - 0.5 * libm::cos(std::f64::consts::PI * angle))).to_radians();
        let normal_stiffness_n_per_m = decades(-3.0, 9.0, normal);
        let size_m = decades(-300.0, 300.0, depth);
        Self {
            formulation: if formulation < 0.5 { Formulation::Published } else { Formulation::Energy },
            chain: ChainParameters {
                rod_length_m,
                angle_rad,
                ratio: 1.0 - decades(-9.0, -0.009, decay),
                // At most 1e6.
                units: decades(0.0, 6.0, units) as u32,
                normal_stiffness_n_per_m,
                tangential_stiffness_n_per_m: normal_stiffness_n_per_m * decades(-6.0, 6.0, ratio_of_springs),
                tangential_growth: decades(-3.0, 6.0, growth),
                weight: 1.0,
                pitch_m: 2.0 * rod_length_m * libm::cos(angle_rad),
            },
            depth_m: if sign < 0.5 { -size_m } else { size_m },
        }
    }
}
