//! The regional stiffness map: factors measured at some sites, interpolated over the whole surface.
//!
//! Ordinary kriging of the logarithms (Gaussian process with an unknown constant mean): a site tells about a vertex as
//! much as the two are alike in position and outward normal,
//!
//! ```text
//! k(v, w) = exp(-|x_v - x_w|^2 / 2 l^2 - |n_v - n_w|^2 / 2 m^2),      K = k + noise I
//! y* = mean + k*^T K^-1 (y - mean 1),     mean = 1^T K^-1 y / 1^T K^-1 1
//! ```
//!
//! The normals keep the two sides of a thin lobe apart. `l`, `m` and the noise are those with the least squared error when
//! each site is predicted from the others (leave one out, in closed form: `e_i = (P y)_i / P_ii` with
//! `P = K^-1 - K^-1 1 1^T K^-1 / 1^T K^-1 1`; Dubrule 1983).

use glam::DVec3;
use nalgebra::{DMatrix, DVector};

/// A place on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) position: DVec3,
    pub(super) normal: DVec3,
}

/// How far alikeness reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Reach {
    length_m: f64,
    normal: f64,
    noise: f64,
}

/// Predicts the logarithm of a factor at any place.
pub(super) struct Interpolation {
    sites: Vec<Place>,
    reach: Reach,
    mean: f64,
    weights: DVector<f64>,
    /// Root of the mean squared error of each site's logarithm, predicted from the others.
    pub(super) leave_one_out: f64,
}

/// Fewest sites that say something about places between them.
pub(super) const FEWEST_SITES: usize = 8;

impl Interpolation {
    /// From the logarithms at some places. `None` where the places are so alike that no reach tells them apart.
    pub(super) fn new(sites: &[Place], logarithms: &[f64]) -> Option<Self> {
        let size_m = sites
            .iter()
            .flat_map(|a| sites.iter().map(|b| a.position.distance(b.position)))
            .fold(0.0, f64::max);
        let y = DVector::from_column_slice(logarithms);
        let mut best: Option<(f64, Reach)> = None;
        for length in [0.05, 0.07, 0.1, 0.14, 0.2, 0.28, 0.4, 0.56, 0.8, 1.1] {
            for normal in [0.3, 0.5, 0.7, 1.0, 1.4, 2.0, 4.0] {
                for noise in [1e-6, 1e-4, 1e-3, 1e-2, 1e-1] {
                    let reach = Reach { length_m: length * size_m, normal, noise };
                    let error = leave_one_out(sites, &y, reach);
                    if error.is_some_and(|error| best.is_none_or(|(least, _)| error < least)) {
                        best = error.map(|error| (error, reach));
                    }
                }
            }
        }
        let (leave_one_out, reach) = best?;
        let inverse = reach.covariance(sites).cholesky()?.inverse();
        let ones = DVector::from_element(sites.len(), 1.0);
        let mean = ones.dot(&(&inverse * &y)) / ones.dot(&(&inverse * &ones));
        let weights = &inverse * (y - ones * mean);
        Some(Self { sites: sites.to_vec(), reach, mean, weights, leave_one_out })
    }

    /// The logarithm at a place.
    pub(super) fn at(&self, place: &Place) -> f64 {
        let likeness = self.sites.iter().map(|site| self.reach.likeness(site, place));
        self.mean + likeness.zip(self.weights.iter()).map(|(k, weight)| k * weight).sum::<f64>()
    }
}

impl Reach {
    fn likeness(&self, a: &Place, b: &Place) -> f64 {
        let position = a.position.distance_squared(b.position) / (self.length_m * self.length_m);
        let normal = a.normal.distance_squared(b.normal) / (self.normal * self.normal);
        libm::exp(-0.5 * (position + normal))
    }

    fn covariance(&self, sites: &[Place]) -> DMatrix<f64> {
        DMatrix::from_fn(sites.len(), sites.len(), |i, j| {
            self.likeness(&sites[i], &sites[j]) + if i == j { self.noise } else { 0.0 }
        })
    }
}

/// Root of the mean squared error of leaving each site out.
fn leave_one_out(sites: &[Place], y: &DVector<f64>, reach: Reach) -> Option<f64> {
    let inverse = reach.covariance(sites).cholesky()?.inverse();
    let row_sums = &inverse * DVector::from_element(sites.len(), 1.0);
    let p = &inverse - &row_sums * row_sums.transpose() / row_sums.sum();
    let p_y = &p * y;
    let squares: f64 = (0..sites.len()).map(|i| (p_y[i] / p[(i, i)]).powi(2)).sum();
    let error = (squares / sites.len() as f64).sqrt();
    error.is_finite().then_some(error)
}
