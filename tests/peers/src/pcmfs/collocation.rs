//! Conditions at the spheres' centres, and the displacements that meet them best.
//!
//! S. De, J. Kim, Y.-J. Lim and M. A. Srinivasan (2005): `u(x) = sum_J H_J(x) u_J` is put into the equations themselves, point by
//! point, without integrals: equilibrium inside, `(lambda + mu) grad div u + mu laplace u = 0`; the given traction
//! `lambda div u n + mu (grad u + grad u^T) n` on the free surface; the given displacement where the body is held.
//!
//! With one condition for each centre the matrix is square, as published, and on scattered centres of a curved surface the
//! answer oscillates (on the test bodies it was wrong by a factor of ten and more). So equilibrium is asked for on the surface too, and
//! the conditions are met in the sense of least squares: a field that can meet them all still does.

use faer::linalg::solvers::Solve;
use faer::{Mat, Side};
use glam::{DMat3, DVec3};

use super::shape::{Function, PAIRS, Spheres};

/// What holds at a centre.
#[derive(Clone, Copy, Debug)]
pub(super) enum Condition {
    /// Equilibrium without body forces.
    Inside,
    /// Displacement in m.
    Moved(DVec3),
    /// The traction in Pa on the surface with this outward normal.
    Loaded { normal: DVec3, traction_pa: DVec3 },
    /// A disc with normal `disc` presses without friction: displacement along it in m, no traction across it.
    Pressed { normal: DVec3, disc: DVec3, along_m: f64 },
}

/// Lame's constants, Pa.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lame {
    pub(super) lambda_pa: f64,
    pub(super) mu_pa: f64,
}

impl Lame {
    /// What a function contributes to the equations of equilibrium, for each component of its sphere's displacement
    /// (columns), Pa/m^2.
    fn equilibrium(self, function: &Function) -> DMat3 {
        let laplace = function.second[0] + function.second[1] + function.second[2];
        let mut sum = DMat3::from_diagonal(DVec3::splat(self.mu_pa * laplace));
        for ([i, j], second) in PAIRS.into_iter().zip(function.second) {
            sum.col_mut(j)[i] += (self.lambda_pa + self.mu_pa) * second;
            if i != j {
                sum.col_mut(i)[j] += (self.lambda_pa + self.mu_pa) * second;
            }
        }
        sum
    }

    /// The same for the traction on a surface with normal n, Pa/m.
    pub(super) fn traction(self, function: &Function, normal: DVec3) -> DMat3 {
        let g = function.gradient;
        let column = |k: usize| {
            let mut sum = normal * (self.lambda_pa * g[k]) + g * (self.mu_pa * normal[k]);
            sum[k] += self.mu_pa * normal.dot(g);
            sum
        };
        DMat3::from_cols(column(0), column(1), column(2))
    }
}

/// Weight of given displacements against the other conditions, once all are scaled to displacements.
const GIVEN: f64 = 20.0;

/// Normal equations, filled row by row: a row touches few spheres.
struct LeastSquares {
    matrix: Mat<f64>,
    right: Mat<f64>,
}

impl LeastSquares {
    fn new(size: usize) -> Self {
        Self { matrix: Mat::zeros(size, size), right: Mat::zeros(size, 1) }
    }

    /// Three conditions: for each function what it contributes (columns: its sphere's displacement), and what is known.
    fn add(&mut self, blocks: &[(usize, DMat3)], known: DVec3) {
        for &(column, right) in blocks {
            // The lower triangle is enough.
            for &(row, left) in blocks.iter().filter(|(row, _)| *row >= column) {
                let product = left.transpose() * right;
                for j in 0..3 {
                    for i in 0..3 {
                        self.matrix[(3 * row + i, 3 * column + j)] += product.col(j)[i];
                    }
                }
            }
            let product = right.transpose() * known;
            for i in 0..3 {
                self.right[(3 * column + i, 0)] += product[i];
            }
        }
    }
}

/// Displacements of all spheres (the u_J, not the field at their centres); nothing where too few spheres meet or the
/// conditions do not hold the body.
///
/// Conditions are scaled to displacements with the centres' spacing h: equilibrium by h^2/mu, tractions by h/mu.
pub(super) fn solve(
    spheres: &Spheres,
    conditions: &[Condition],
    spacing_m: f64,
    lame: Lame,
) -> Option<Vec<DVec3>> {
    let count = spheres.centres.len();
    let mut squares = LeastSquares::new(3 * count);
    let per_traction = spacing_m / lame.mu_pa;
    for (condition, &centre) in conditions.iter().zip(&spheres.centres) {
        let functions = spheres.at(centre)?;
        let blocks = |one: &dyn Fn(&Function) -> DMat3| -> Vec<(usize, DMat3)> {
            functions.iter().map(|function| (function.sphere, one(function))).collect()
        };
        match *condition {
            Condition::Inside => {}
            Condition::Moved(displacement) => {
                let given = blocks(&|one| DMat3::from_diagonal(DVec3::splat(GIVEN * one.value)));
                squares.add(&given, displacement * GIVEN);
            }
            Condition::Loaded { normal, traction_pa } => {
                let loaded = blocks(&|one| lame.traction(one, normal) * per_traction);
                squares.add(&loaded, traction_pa * per_traction);
            }
            Condition::Pressed { normal, disc, along_m } => {
                let pressed = blocks(&|one| {
                    pressed(disc, lame.traction(one, normal) * per_traction, disc * (GIVEN * one.value))
                });
                squares.add(&pressed, DVec3::X * (GIVEN * along_m));
            }
        }
        if !matches!(condition, Condition::Moved(_)) {
            let per_force = spacing_m * per_traction;
            squares.add(&blocks(&|one| lame.equilibrium(one) * per_force), DVec3::ZERO);
        }
    }
    let found = squares.matrix.llt(Side::Lower).ok()?.solve(&squares.right);
    Some((0..count).map(|row| DVec3::from_array([0, 1, 2].map(|i| found[(3 * row + i, 0)]))).collect())
}

/// Rows: displacement along the disc's normal, tractions along two directions across it.
fn pressed(disc: DVec3, traction: DMat3, displacement: DVec3) -> DMat3 {
    let (first, second) = disc.any_orthonormal_pair();
    let along = |direction: DVec3| traction.transpose() * direction;
    DMat3::from_cols(displacement, along(first), along(second)).transpose()
}

#[cfg(test)]
mod tests {
    use super::super::shape::tests::shaken_cube;
    use super::{Condition, Lame, solve};
    use glam::{DMat3, DVec3};

    /// Patch test: displacements linear in position, with the tractions that go with them, on a cube of scattered spheres.
    #[test]
    fn a_linear_field_is_reproduced_from_displacements_and_tractions_on_the_surface() {
        let (side, pitch) = (5u32, 0.004);
        let lame = Lame { lambda_pa: 31e3, mu_pa: 3.4e3 };
        let spheres = shaken_cube(side, pitch);
        let strain = DMat3::from_cols_array(&[2e-3, 4e-4, -1e-3, 6e-4, -3e-3, 2e-4, 8e-4, -5e-4, 1e-3]);
        let symmetric = strain + strain.transpose();
        let trace = strain.x_axis.x + strain.y_axis.y + strain.z_axis.z;
        let stress = DMat3::from_diagonal(DVec3::splat(lame.lambda_pa * trace)) + symmetric * lame.mu_pa;
        let far = f64::from(side - 1) * pitch;
        let condition = |at: &DVec3| {
            let faces = [(at.x, DVec3::X), (at.y, DVec3::Y), (at.z, DVec3::Z)];
            let normal: DVec3 = faces
                .into_iter()
                .map(|(k, axis)| {
                    if k == 0.0 {
                        -axis
                    } else if k > far * 0.999 {
                        axis
                    } else {
                        DVec3::ZERO
                    }
                })
                .sum();
            if normal == DVec3::ZERO {
                Condition::Inside
            } else if normal == DVec3::Z {
                Condition::Loaded { normal, traction_pa: stress * normal }
            } else {
                Condition::Moved(strain * *at)
            }
        };
        let conditions: Vec<Condition> = spheres.centres.iter().map(condition).collect();
        let displacements = solve(&spheres, &conditions, pitch, lame).unwrap();
        for (at, u) in spheres.centres.iter().zip(displacements) {
            assert!(u.distance(strain * *at) < 1e-7 * far, "{at} {u}");
        }
    }

    /// A cube between a held floor and a smooth disc, its sides led so that it cannot widen: strain in one direction.
    #[test]
    fn a_confined_cube_under_a_disc_is_pressed_evenly() {
        let (side, pitch) = (5u32, 0.004);
        let lame = Lame { lambda_pa: 5e3, mu_pa: 4e3 };
        let spheres = shaken_cube(side, pitch);
        let far = f64::from(side - 1) * pitch;
        let even = |at: DVec3| DVec3::Z * (-1e-3 * at.z / far);
        let conditions: Vec<Condition> = spheres
            .centres
            .iter()
            .map(|&at| {
                let inside = |k: f64| k > 0.0 && k < far * 0.999;
                match (inside(at.x) && inside(at.y), inside(at.z)) {
                    (true, true) => Condition::Inside,
                    (true, false) if at.z > 0.0 => {
                        Condition::Pressed { normal: DVec3::Z, disc: DVec3::Z, along_m: -1e-3 }
                    }
                    _ => Condition::Moved(even(at)),
                }
            })
            .collect();
        let found = solve(&spheres, &conditions, pitch, lame).unwrap();
        assert!(spheres.centres.iter().zip(found).all(|(&at, u)| u.distance(even(at)) < 1e-9));
    }
}
