//! Kelvin's solution: what a point force does in an unbounded elastic body.

use std::f64::consts::PI;

use glam::{DMat3, DVec3};

/// Kelvin's solution for one Poisson ratio; tractions are divided by the shear modulus.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kelvin {
    poisson: f64,
}

impl Kelvin {
    pub(super) fn new(poisson: f64) -> Self {
        Self { poisson }
    }

    /// Displacement times shear modulus at `r` from a unit force, 1/m: entry (i, j) is component j for a force along i.
    pub(super) fn displacement(self, r: DVec3) -> DMat3 {
        let distance = r.length();
        let d = r / distance;
        let isotropic = DMat3::from_diagonal(DVec3::splat(3.0 - 4.0 * self.poisson));
        (isotropic + outer(d, d)) * (1.0 / (16.0 * PI * (1.0 - self.poisson) * distance))
    }

    /// Traction at `r` on the plane with unit normal `n`, 1/m²: entry (i, j) is component j for a unit force along i.
    pub(super) fn traction(self, r: DVec3, n: DVec3) -> DMat3 {
        let distance = r.length();
        let d = r / distance;
        let shear = 1.0 - 2.0 * self.poisson;
        let along = DMat3::from_diagonal(DVec3::splat(shear)) + outer(d, d) * 3.0;
        let twist = (outer(n, d) - outer(d, n)) * shear;
        (along * d.dot(n) + twist) * (-1.0 / (8.0 * PI * (1.0 - self.poisson) * distance * distance))
    }
}

/// Entry (i, j) is `a_i b_j`.
fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}
