//! Moving least squares functions on spheres, with first and second derivatives.
//!
//! S. De and K. J. Bathe, "The method of finite spheres", Computational Mechanics 25, 2000, 329-345: sphere J of radius R
//! around x_J carries the weight `W_J = 1 - 6 s^2 + 8 s^3 - 3 s^4`, `s = |x - x_J|/R <= 1`, and
//!
//! ```text
//! H_J(x) = W_J(x) p(x)^T A(x)^-1 p(x_J),   A(x) = sum_K W_K(x) p(x_K) p(x_K)^T
//! ```
//!
//! reproduces every polynomial in p. Derivatives are those of the full expression. p holds all polynomials of second order:
//! the equations of equilibrium have second derivatives.

use glam::DVec3;

/// Number of polynomials.
const TERMS: usize = 10;
/// Which derivatives the six entries of a second derivative are.
pub(super) const PAIRS: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [1, 2], [2, 0], [0, 1]];
/// A pivot of A below this share of the weights' sum: too few spheres meet here, or they lie in a plane.
const SMALLEST_PIVOT: f64 = 1e-7;

type Terms = [f64; TERMS];

/// Spheres of one radius.
#[derive(Clone, Debug, Default)]
pub(super) struct Spheres {
    pub(super) centres: Vec<DVec3>,
    pub(super) radius_m: f64,
}

/// One sphere's function at a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Function {
    /// Which sphere.
    pub(super) sphere: usize,
    pub(super) value: f64,
    /// 1/m.
    pub(super) gradient: DVec3,
    /// In the order of [`PAIRS`], 1/m^2.
    pub(super) second: [f64; 6],
}

fn dot(a: &Terms, b: &Terms) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Cholesky factor of a symmetric matrix (lower triangle), or nothing when it is close to singular.
fn factor(mut a: [Terms; TERMS], smallest: f64) -> Option<[Terms; TERMS]> {
    for column in 0..TERMS {
        let pivot = a[column][column] - a[column][..column].iter().map(|l| l * l).sum::<f64>();
        if pivot.is_nan() || pivot <= smallest {
            return None;
        }
        let root = pivot.sqrt();
        a[column][column] = root;
        for row in column + 1..TERMS {
            let sum: f64 = (0..column).map(|k| a[row][k] * a[column][k]).sum();
            a[row][column] = (a[row][column] - sum) / root;
        }
    }
    Some(a)
}

/// Solves with a factor.
fn solve(l: &[Terms; TERMS], mut x: Terms) -> Terms {
    for row in 0..TERMS {
        let sum: f64 = (0..row).map(|k| l[row][k] * x[k]).sum();
        x[row] = (x[row] - sum) / l[row][row];
    }
    for row in (0..TERMS).rev() {
        let sum: f64 = (row + 1..TERMS).map(|k| l[k][row] * x[k]).sum();
        x[row] = (x[row] - sum) / l[row][row];
    }
    x
}

/// A sphere that reaches a point: its polynomials and its weight's derivatives, lengths in radii.
struct Near {
    sphere: usize,
    terms: Terms,
    weight: f64,
    first: DVec3,
    second: [f64; 6],
}

impl Spheres {
    fn near(&self, at: DVec3) -> Vec<Near> {
        let one = |(sphere, &centre): (usize, &DVec3)| {
            // Polynomials are taken around the point and in radii: H does not depend on it, rounding does.
            let from = (centre - at) / self.radius_m;
            let s = from.length();
            if s >= 1.0 {
                return None;
            }
            let [x, y, z] = from.to_array();
            let left = 1.0 - s;
            let slope = -12.0 * left * left;
            let bend = if s > 0.0 { 24.0 * left / s } else { 0.0 };
            let second = PAIRS.map(|[i, j]| bend * from[i] * from[j] + if i == j { slope } else { 0.0 });
            Some(Near {
                sphere,
                terms: [1.0, x, y, z, x * x, y * y, z * z, y * z, z * x, x * y],
                weight: 1.0 + s * s * (-6.0 + s * (8.0 - 3.0 * s)),
                first: -slope * from,
                second,
            })
        };
        self.centres.iter().enumerate().filter_map(one).collect()
    }

    /// All functions that are not zero at a point; nothing where too few spheres meet.
    pub(super) fn at(&self, at: DVec3) -> Option<Vec<Function>> {
        let near = self.near(at);
        let mut a = [[0.0; TERMS]; TERMS];
        for one in &near {
            for (row, term) in a.iter_mut().zip(one.terms) {
                for (entry, other) in row.iter_mut().zip(one.terms) {
                    *entry += one.weight * term * other;
                }
            }
        }
        let l = factor(a, SMALLEST_PIVOT * near.iter().map(|one| one.weight).sum::<f64>())?;
        // g = A^-1 p and its derivatives: A g_i = p_i - A_i g, A g_ij = p_ij - A_i g_j - A_j g_i - A_ij g.
        let unit = |term: usize, value: f64| {
            let mut terms = [0.0; TERMS];
            terms[term] = value;
            terms
        };
        let less = |mut right: Terms, share: &dyn Fn(&Near) -> f64| {
            for one in &near {
                let part = share(one);
                for (right, term) in right.iter_mut().zip(one.terms) {
                    *right -= part * term;
                }
            }
            solve(&l, right)
        };
        let g = solve(&l, unit(0, 1.0));
        let g_first = [0, 1, 2].map(|i| less(unit(1 + i, 1.0), &|one| one.first[i] * dot(&one.terms, &g)));
        let g_second = [0, 1, 2, 3, 4, 5].map(|pair| {
            let [i, j] = PAIRS[pair];
            less(unit(4 + pair, if i == j { 2.0 } else { 1.0 }), &|one| {
                one.first[i] * dot(&one.terms, &g_first[j])
                    + one.first[j] * dot(&one.terms, &g_first[i])
                    + one.second[pair] * dot(&one.terms, &g)
            })
        });
        let scale = 1.0 / self.radius_m;
        let function = |one: &Near| {
            let q = dot(&one.terms, &g);
            let q_first = DVec3::from_array([0, 1, 2].map(|i| dot(&one.terms, &g_first[i])));
            let gradient = one.first * q + q_first * one.weight;
            let mut second = [0.0; 6];
            for (pair, entry) in second.iter_mut().enumerate() {
                let [i, j] = PAIRS[pair];
                let crossed = one.first[i] * q_first[j] + one.first[j] * q_first[i];
                let bent = one.second[pair] * q + one.weight * dot(&one.terms, &g_second[pair]);
                *entry = (crossed + bent) * scale * scale;
            }
            Function { sphere: one.sphere, value: one.weight * q, gradient: gradient * scale, second }
        };
        Some(near.iter().map(function).collect())
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::Spheres;
    use glam::DVec3;

    /// A cube's lattice, shaken by up to a fifth of its pitch, the same in every run.
    pub(crate) fn shaken_cube(side: u32, pitch: f64) -> Spheres {
        let mut seed = 7u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            0.4 * (f64::from((seed >> 33) as u32) / f64::from(1u32 << 31) - 0.5)
        };
        let mut centres = Vec::new();
        for cell in 0..side.pow(3) {
            let place = [cell % side, cell / side % side, cell / (side * side)];
            // The rim stays where it is, so that the body is a cube.
            let shaken = place.map(|k| f64::from(k) + if k == 0 || k == side - 1 { 0.0 } else { random() });
            centres.push(DVec3::from(shaken) * pitch);
        }
        Spheres { centres, radius_m: 2.6 * pitch }
    }

    #[test]
    fn polynomials_of_second_order_are_reproduced_with_their_derivatives() {
        let spheres = shaken_cube(6, 0.005);
        let field = |x: DVec3| 2.0 + x.x - 3.0 * x.y + 40.0 * x.z * x.x - 70.0 * x.y * x.y;
        for at in [DVec3::splat(0.0121), DVec3::new(0.0, 0.007, 0.025), DVec3::ZERO, spheres.centres[87]] {
            let (mut value, mut gradient, mut second) = (0.0, DVec3::ZERO, [0.0; 6]);
            for one in spheres.at(at).unwrap() {
                let known = field(spheres.centres[one.sphere]);
                value += known * one.value;
                gradient += known * one.gradient;
                for (sum, part) in second.iter_mut().zip(one.second) {
                    *sum += known * part;
                }
            }
            assert!((value - field(at)).abs() < 1e-9, "{value}");
            let expected = DVec3::new(1.0 + 40.0 * at.z, -3.0 - 140.0 * at.y, 40.0 * at.x);
            assert!(gradient.distance(expected) < 1e-6, "{gradient} {expected}");
            for (found, expected) in second.iter().zip([0.0, -140.0, 0.0, 0.0, 40.0, 0.0]) {
                assert!((found - expected).abs() < 1e-3, "{second:?}");
            }
        }
    }

    #[test]
    fn derivatives_are_those_of_the_functions() {
        let spheres = shaken_cube(5, 1.0);
        let at = DVec3::new(1.7, 2.2, 1.9);
        let step = 1e-4;
        let here = spheres.at(at).unwrap();
        let value = |at: DVec3, sphere: usize| {
            spheres.at(at).unwrap().iter().find(|one| one.sphere == sphere).map_or(0.0, |one| one.value)
        };
        for one in here.iter().step_by(7) {
            let [ahead, behind] = [1.0, -1.0].map(|sign| value(at + DVec3::X * (sign * step), one.sphere));
            assert!((one.gradient.x - (ahead - behind) / (2.0 * step)).abs() < 1e-6);
            assert!((one.second[0] - (ahead - 2.0 * one.value + behind) / (step * step)).abs() < 1e-4);
        }
    }

    #[test]
    fn too_few_spheres_give_nothing() {
        let mut spheres = shaken_cube(3, 1.0);
        spheres.centres.truncate(9);
        assert!(spheres.at(DVec3::splat(0.5)).is_none(), "a plane");
        assert!(spheres.at(DVec3::splat(100.0)).is_none());
    }
}
