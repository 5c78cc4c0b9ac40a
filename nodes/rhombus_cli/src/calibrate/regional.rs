//! The regional stiffness map: factors known at some sites, interpolated over the whole surface.
//!
//! Kriging of the logarithms with a trend (a Gaussian process whose mean is `b_0 + b_1 h`, b unknown). A site tells about a
//! place as much as the two are alike in position and outward normal; the normals keep the two sides of a thin lobe apart:
//!
//! ```text
//! k(v, w) = exp(-|x_v - x_w|^2 / 2 l^2 - |n_v - n_w|^2 / 2 m^2),      K = k + noise I,      H = [1 h]
//! b = (H^T K^-1 H)^-1 H^T K^-1 y,      y* = H* b + k*^T K^-1 (y - H b)
//! ```
//!
//! The trend says what position alone cannot: tissue is stiffer over a base that is held. A layer of thickness d on a rigid
//! base is stiffer than a half-space by a share of order r_c/d; the integral over the held surface that is `pi r_c/d` for it,
//!
//! ```text
//! h(x) = r_c sum_held A_v max(n.(x - x_v), 0) / |x - x_v|^4,
//! ```
//!
//! varies smoothly over any body. It is left out where that predicts better. `l`, `m`, the noise and the trend are those with
//! the least squared error when each site is predicted from the others (leave one out, in closed form:
//! `e_i = (P y)_i / P_ii` with `P = K^-1 - K^-1 H (H^T K^-1 H)^-1 H^T K^-1`; Dubrule, Mathematical Geology 15, 1983).

use glam::DVec3;
use nalgebra::{DMatrix, DVector};
use rhombus_chain::SurfaceMesh;

/// A place on a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    position: DVec3,
    normal: DVec3,
    /// `h`.
    held: f64,
}

/// What makes places alike, and whether there is a trend.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Choice {
    length_m: f64,
    normal: f64,
    noise: f64,
    trend: bool,
}

/// Predicts the logarithm of a factor at any place.
pub(super) struct Interpolation {
    sites: Vec<Place>,
    choice: Choice,
    /// `b`.
    trend: DVector<f64>,
    /// `K^-1 (y - H b)`.
    weights: DVector<f64>,
    /// Root of the mean squared error of each site's logarithm, predicted from the others.
    pub(super) leave_one_out: f64,
    /// Each site's logarithm less what the others predict.
    pub(super) errors: Vec<f64>,
}

/// Fewest sites that say something about places between them.
pub(super) const FEWEST_SITES: usize = 8;

/// Reaches in position, as a share of the largest distance between sites, and in the unit normal.
const LENGTHS: [f64; 10] = [0.05, 0.07, 0.1, 0.14, 0.2, 0.28, 0.4, 0.56, 0.8, 1.1];
const NORMALS: [f64; 7] = [0.3, 0.5, 0.7, 1.0, 1.4, 2.0, 4.0];
/// What a factor of a map may be.
const FACTORS: (f64, f64) = (1e-3, 1e3);
const NOISES: [f64; 5] = [1e-6, 1e-4, 1e-3, 1e-2, 1e-1];

impl Place {
    /// A vertex of `mesh`, which is held at the vertices where `fixed` says so.
    fn new(mesh: &SurfaceMesh, fixed: &[bool], vertex: usize, contact_radius_m: f64) -> Self {
        let (position, normal) = (mesh.vertices()[vertex], mesh.vertex_normals()[vertex]);
        let held_vertices = fixed.iter().enumerate().filter(|(_, fixed)| **fixed).map(|(held, _)| held);
        let part = |held: usize| {
            let offset = position - mesh.vertices()[held];
            // Not nearer than the contact is wide: on the base itself the integral has no end.
            let distance_squared = offset.length_squared().max(contact_radius_m * contact_radius_m);
            mesh.vertex_areas()[held] * normal.dot(offset).max(0.0) / (distance_squared * distance_squared)
        };
        Self { position, normal, held: contact_radius_m * held_vertices.map(part).sum::<f64>() }
    }

    fn trend(&self, choice: &Choice) -> DVector<f64> {
        DVector::from_vec(if choice.trend { vec![1.0, self.held] } else { vec![1.0] })
    }
}

impl Interpolation {
    /// From the logarithms at some places. `None` where the places are so alike that nothing tells them apart.
    fn new(sites: &[Place], logarithms: &[f64]) -> Option<Self> {
        let size_m = sites
            .iter()
            .flat_map(|a| sites.iter().map(|b| a.position.distance(b.position)))
            .fold(0.0, f64::max);
        let y = DVector::from_column_slice(logarithms);
        let mut best: Option<Self> = None;
        for length in LENGTHS {
            for normal in NORMALS {
                for noise in NOISES {
                    for trend in [false, true] {
                        let choice = Choice { length_m: length * size_m, normal, noise, trend };
                        let Some(found) = Self::with(sites, &y, choice) else { continue };
                        if best.as_ref().is_none_or(|best| found.leave_one_out < best.leave_one_out) {
                            best = Some(found);
                        }
                    }
                }
            }
        }
        best
    }

    fn with(sites: &[Place], y: &DVector<f64>, choice: Choice) -> Option<Self> {
        let covariance = DMatrix::from_fn(sites.len(), sites.len(), |i, j| {
            choice.likeness(&sites[i], &sites[j]) + if i == j { choice.noise } else { 0.0 }
        });
        let inverse = covariance.cholesky()?.inverse();
        let rows: Vec<_> = sites.iter().map(|site| site.trend(&choice).transpose()).collect();
        let h = DMatrix::from_rows(&rows);
        let weighted = &inverse * &h;
        let normal_equations = (h.transpose() * &weighted).cholesky()?;
        let trend = normal_equations.solve(&(weighted.transpose() * y));
        let p = &inverse - &weighted * normal_equations.solve(&weighted.transpose());
        let p_y = &p * y;
        let errors: Vec<f64> = (0..sites.len()).map(|i| p_y[i] / p[(i, i)]).collect();
        let squares: f64 = errors.iter().map(|error| error.powi(2)).sum();
        let leave_one_out = (squares / sites.len() as f64).sqrt();
        let weights = inverse * (y - h * &trend);
        leave_one_out.is_finite().then(|| Self {
            sites: sites.to_vec(),
            choice,
            trend,
            weights,
            leave_one_out,
            errors,
        })
    }

    /// The logarithm at a place.
    fn at(&self, place: &Place) -> f64 {
        let likeness = self.sites.iter().map(|site| self.choice.likeness(site, place));
        let near: f64 = likeness.zip(self.weights.iter()).map(|(k, weight)| k * weight).sum();
        place.trend(&self.choice).dot(&self.trend) + near
    }
}

/// Of positive numbers.
pub(super) fn geometric_mean(numbers: &[f64]) -> f64 {
    libm::exp(mean_logarithm(numbers))
}

fn mean_logarithm(numbers: &[f64]) -> f64 {
    numbers.iter().map(|number| libm::log(*number)).sum::<f64>() / numbers.len() as f64
}

/// Factors of a whole surface.
pub(super) struct RegionalFactors {
    /// One for each vertex; their logarithms are 0 on average over the sites.
    pub(super) factors: Vec<f64>,
    /// What has the factor 1, N/m: the geometric mean of the sites.
    pub(super) stiffness: f64,
    /// How well the sites tell about each other.
    pub(super) interpolation: Interpolation,
}

impl RegionalFactors {
    /// From the stiffness, N/m, at some vertices of `mesh`, which is held where `fixed` says so. `None` where the sites are
    /// so alike that nothing tells them apart.
    pub(super) fn new(
        mesh: &SurfaceMesh,
        fixed: &[bool],
        contact_radius_m: f64,
        sites: &[usize],
        stiffnesses: &[f64],
    ) -> Option<Self> {
        let mean = mean_logarithm(stiffnesses);
        let logarithms: Vec<f64> = stiffnesses.iter().map(|stiffness| libm::log(*stiffness) - mean).collect();
        let place = |vertex: usize| Place::new(mesh, fixed, vertex, contact_radius_m);
        let places: Vec<Place> = sites.iter().map(|vertex| place(*vertex)).collect();
        let interpolation = Interpolation::new(&places, &logarithms)?;
        let factor = |vertex: usize| libm::exp(interpolation.at(&place(vertex))).clamp(FACTORS.0, FACTORS.1);
        let factors = (0..mesh.vertices().len()).map(factor).collect();
        Some(Self { factors, stiffness: libm::exp(mean), interpolation })
    }
}

impl Choice {
    fn likeness(&self, a: &Place, b: &Place) -> f64 {
        let position = a.position.distance_squared(b.position) / (self.length_m * self.length_m);
        let normal = a.normal.distance_squared(b.normal) / (self.normal * self.normal);
        libm::exp(-0.5 * (position + normal))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{BodyKind, generate};

    /// A block that is held at its underside.
    fn block() -> (SurfaceMesh, Vec<bool>) {
        let shape = generate::body(BodyKind::Block, 1500);
        let mesh = SurfaceMesh::new(shape.vertices, shape.triangles).unwrap();
        let fixed = mesh.vertex_normals().iter().map(|n| n.z < -0.7).collect();
        (mesh, fixed)
    }

    #[test]
    fn tissue_over_a_held_base_is_told_from_tissue_at_the_same_height_elsewhere() {
        let (mesh, fixed) = block();
        let place = |vertex: usize| Place::new(&mesh, &fixed, vertex, 0.005);
        let free: Vec<usize> = (0..mesh.vertices().len()).filter(|vertex| !fixed[*vertex]).collect();
        let sites: Vec<Place> = free.iter().step_by(40).map(|vertex| place(*vertex)).collect();
        let truth = |place: &Place| 0.2 + 0.5 * place.held + 1.5 * place.position.x;
        let y: Vec<f64> = sites.iter().map(truth).collect();
        let found = Interpolation::new(&sites, &y).unwrap();
        assert!(found.choice.trend && found.leave_one_out < 0.01, "{}", found.leave_one_out);
        for vertex in free {
            let place = place(vertex);
            assert!((found.at(&place) - truth(&place)).abs() < 0.03, "{place:?}");
        }
    }

    #[test]
    fn the_held_integral_is_pi_times_contact_radius_over_depth_for_a_wide_layer() {
        let (mesh, fixed) = block();
        let [low, high] = mesh.extents();
        let centre = (low + high) / 2.0;
        let top = (0..mesh.vertices().len())
            .filter(|vertex| mesh.vertex_normals()[*vertex].z > 0.99)
            .min_by(|a, b| {
                let far = |v: &usize| (mesh.vertices()[*v] - centre).truncate().length();
                far(a).total_cmp(&far(b))
            })
            .unwrap();
        let (depth_m, half_m) = (high.z - low.z, (high - low).truncate().min_element() / 2.0);
        let found = Place::new(&mesh, &fixed, top, 0.001).held;
        let endless = std::f64::consts::PI * 0.001 / depth_m;
        // What lies farther out than the nearer side is left out at most.
        let within = endless * half_m * half_m / (half_m * half_m + depth_m * depth_m);
        assert!(found > 0.95 * within && found < 1.05 * endless, "{found}, {within} to {endless}");
    }
}
