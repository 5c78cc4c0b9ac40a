//! What may be chosen: the parameters of a chain and of the surface around a contact.

use std::fmt;
use std::str::FromStr;

use crate::parameter_error::ParameterError;

/// Which of the two force laws holds (MODEL: "One rhombus unit").
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Formulation {
    /// Equations (3) and (8) as printed: `F = (k_n - k_t t tan(theta)) dl`. Falls off when pulled.
    Published,
    /// `F = dE/dDL` of what the springs store. The default.
    #[default]
    Energy,
}

/// How the field of a contact spreads over a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Spread {
    /// By arc length along the rest surface. The default.
    #[default]
    Geodesic,
    /// By the mesh ring index instead of `s/h`: discrete and mesh-dependent, for comparison only.
    Rings,
}

/// One chain of rhombi, before it is checked. Scene names are `chains.<name>`, arrays with one entry per chain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChainParameters {
    /// `a`, length of a rod of the first unit, m (`chains.rod_length`).
    pub rod_length_m: f64,
    /// `theta`, rest angle between a rod and the tangential diagonal, rad, in (0, pi/2) (`chains.angle`).
    pub angle_rad: f64,
    /// `q`, length of a unit's rods over those of the unit before, in (0, 1) (`chains.ratio`).
    pub ratio: f64,
    /// `n`, number of units, 1..=1 000 000 (`chains.units`).
    pub units: u32,
    /// `k_n`, stiffness of every normal spring, N/m (`chains.normal_stiffness`).
    pub normal_stiffness_n_per_m: f64,
    /// `k_t`, stiffness of the first unit's tangential spring, N/m, 0 for none (`chains.tangential_stiffness`).
    pub tangential_stiffness_n_per_m: f64,
    /// `beta` > 0: each tangential spring is `e^(1/beta)` times as stiff as the one before (`chains.tangential_growth`).
    pub tangential_growth: f64,
    /// `w_p` > 0, share of this chain in the surface shape; all chains together 1 (`chains.weight`).
    pub weight: f64,
    /// `h`, length of a unit along the surface, m, `2 a cos(theta)` by default (`chains.pitch`).
    pub pitch_m: f64,
}

/// The surface around a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceParameters {
    /// Units that turn by this share of `theta` or less are not moved, in [0, 1) (`surface.cutoff`).
    pub cutoff: f64,
    /// `kappa`, share of the displaced volume that bulges beyond the boundary, in [0, 1] (`surface.expansion`).
    pub expansion: f64,
    /// Arc length or mesh rings (`surface.spread`).
    pub spread: Spread,
    /// `r_c`, radius of the contact, which moves by the full depth, m, >= 0 (`probe.contact_radius`).
    pub contact_radius_m: f64,
}

impl Default for SurfaceParameters {
    fn default() -> Self {
        Self { cutoff: 0.05, expansion: 0.0, spread: Spread::Geodesic, contact_radius_m: 0.0 }
    }
}

impl ChainParameters {
    /// Checks every parameter by itself; `chain` is the index that an error names. The bounds far from any tissue
    /// (1e-12 and 1e12 m, 1e-12 and 1e18 N/m, 1e-6 rad) are there so that no product of them overflows.
    pub(crate) fn check_ranges(&self, chain: usize) -> Result<(), ParameterError> {
        const ANGLE_MARGIN_RAD: f64 = 1e-6;
        let length = 1e-12..=1e12;
        let stiffness = 1e-12..=1e18;
        let angle = ANGLE_MARGIN_RAD..=std::f64::consts::FRAC_PI_2 - ANGLE_MARGIN_RAD;
        let tangential = self.tangential_stiffness_n_per_m;
        let open_unit = |value: f64| value > 0.0 && value < 1.0;
        let positive = |value: f64| value > 0.0 && value.is_finite();
        let checks = [
            ("rod_length", self.rod_length_m, length.contains(&self.rod_length_m), "1e-12 to 1e12 m"),
            (
                "angle",
                self.angle_rad,
                angle.contains(&self.angle_rad),
                "between 0 and pi/2 = 1.5707963 rad, at least 1e-6 from both",
            ),
            ("ratio", self.ratio, open_unit(self.ratio), "greater than 0 and less than 1"),
            (
                "normal_stiffness",
                self.normal_stiffness_n_per_m,
                stiffness.contains(&self.normal_stiffness_n_per_m),
                "1e-12 to 1e18 N/m",
            ),
            (
                "tangential_stiffness",
                tangential,
                (0.0..=*stiffness.end()).contains(&tangential),
                "0 (no spring) to 1e18 N/m",
            ),
            (
                "tangential_growth",
                self.tangential_growth,
                positive(self.tangential_growth),
                "a finite number greater than 0",
            ),
            (
                "weight",
                self.weight,
                self.weight > 0.0 && self.weight <= 1.0 + WEIGHT_TOLERANCE,
                "greater than 0, all weights together 1",
            ),
            ("pitch", self.pitch_m, length.contains(&self.pitch_m), "1e-12 to 1e12 m"),
        ];
        match checks.into_iter().find(|(_, _, accepted, _)| !accepted) {
            Some((name, value, _, accepted)) => {
                Err(ParameterError::ChainOutOfRange { chain, name, value, accepted })
            }
            None if !(1..=1_000_000).contains(&self.units) => {
                Err(ParameterError::UnitsOutOfRange { chain, value: self.units })
            }
            None => Ok(()),
        }
    }
}

/// How far the sum of the weights may be from 1.
pub(crate) const WEIGHT_TOLERANCE: f64 = 1e-9;

impl SurfaceParameters {
    /// Checks every parameter.
    ///
    /// # Errors
    /// The first parameter that is outside its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        let checks = [
            ("surface.cutoff", self.cutoff, (0.0..1.0).contains(&self.cutoff), "0 or more and less than 1"),
            ("surface.expansion", self.expansion, (0.0..=1.0).contains(&self.expansion), "0 to 1"),
            (
                "probe.contact_radius",
                self.contact_radius_m,
                (0.0..=1e12).contains(&self.contact_radius_m),
                "0 to 1e12 m",
            ),
        ];
        match checks.into_iter().find(|(_, _, accepted, _)| !accepted) {
            Some((name, value, _, accepted)) => {
                Err(ParameterError::SurfaceOutOfRange { name, value, accepted })
            }
            None => Ok(()),
        }
    }
}

impl fmt::Display for Formulation {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Published => "published",
            Self::Energy => "energy",
        })
    }
}

impl FromStr for Formulation {
    type Err = ParameterError;

    fn from_str(word: &str) -> Result<Self, ParameterError> {
        match word {
            "published" => Ok(Self::Published),
            "energy" => Ok(Self::Energy),
            _ => Err(ParameterError::UnknownWord {
                name: "chains.formulation",
                value: word.to_owned(),
                accepted: "energy or published",
            }),
        }
    }
}

impl fmt::Display for Spread {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Geodesic => "geodesic",
            Self::Rings => "rings",
        })
    }
}

impl FromStr for Spread {
    type Err = ParameterError;

    fn from_str(word: &str) -> Result<Self, ParameterError> {
        match word {
            "geodesic" => Ok(Self::Geodesic),
            "rings" => Ok(Self::Rings),
            _ => Err(ParameterError::UnknownWord {
                name: "surface.spread",
                value: word.to_owned(),
                accepted: "geodesic or rings",
            }),
        }
    }
}
