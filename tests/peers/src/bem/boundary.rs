//! The boundary integrals: H u = G t on the vertices of a closed surface.

use glam::DMat3;
use rayon::prelude::*;
use rhombus_chain::SurfaceMesh;

use super::kelvin::Kelvin;
use super::quadrature::{Point, in_corner, off};

/// H and G, each a square of 3 V numbers row by row. `t` is the traction divided by the shear modulus.
pub(super) struct Boundary {
    pub(super) h: Vec<f64>,
    pub(super) g: Vec<f64>,
}

impl Boundary {
    /// Integrates for all sources on all triangles, on all cores.
    ///
    /// The traction of a held vertex acts on the held faces around it (three held vertices) alone, if there are any: beyond them the
    /// surface is free, and the traction jumps.
    ///
    /// The source's own block of H (free term and principal value) is minus the sum of the others: a rigid translation
    /// needs no traction.
    pub(super) fn new(surface: &SurfaceMesh, fixed: &[bool], poisson: f64) -> Self {
        let size = 3 * surface.vertices().len();
        let (mut h, mut g) = (vec![0.0; size * size], vec![0.0; size * size]);
        let kelvin = Kelvin::new(poisson);
        let held = |face: &&[u32; 3]| face.iter().all(|&vertex| fixed[vertex as usize]);
        let mut of_held_faces = vec![false; surface.vertices().len()];
        for &vertex in surface.triangles().iter().filter(held).flatten() {
            of_held_faces[vertex as usize] = true;
        }
        (
            h.par_chunks_exact_mut(3 * size),
            g.par_chunks_exact_mut(3 * size),
            0u32..surface.vertices().len() as u32,
        )
            .into_par_iter()
            .for_each(|(h, g, source)| integrate(surface, kelvin, &of_held_faces, source, h, g));
        Self { h, g }
    }
}

/// The three rows of one source.
fn integrate(
    surface: &SurfaceMesh,
    kelvin: Kelvin,
    of_held_faces: &[bool],
    source: u32,
    h: &mut [f64],
    g: &mut [f64],
) {
    let at = surface.vertices()[source as usize];
    let mut own = DMat3::ZERO;
    for (face, &vertices) in (0u32..).zip(surface.triangles()) {
        let corners = surface.corners(face);
        let cross = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let (area, normal) = (0.5 * cross.length(), cross.normalize_or_zero());
        let (mut by_u, mut by_t) = ([DMat3::ZERO; 3], [DMat3::ZERO; 3]);
        let mut add = |(weights, share): Point| {
            let r = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2] - at;
            let displacement = kelvin.displacement(r) * (share * area);
            let traction = kelvin.traction(r, normal) * (share * area);
            for corner in 0..3 {
                by_t[corner] += displacement * weights[corner];
                by_u[corner] += traction * weights[corner];
            }
        };
        match vertices.iter().position(|&vertex| vertex == source) {
            Some(corner) => in_corner(corner, &mut add),
            None => off(corners, at, &mut add),
        }
        let of_held = vertices.map(|vertex| of_held_faces[vertex as usize]);
        let held_face = of_held.iter().all(|&held| held);
        for (corner, &vertex) in vertices.iter().enumerate() {
            if vertex != source {
                add_block(h, vertex, by_u[corner]);
                own -= by_u[corner];
            }
            if held_face || !of_held[corner] {
                add_block(g, vertex, by_t[corner]);
            }
        }
    }
    add_block(h, source, own);
}

/// Adds a block to three rows.
fn add_block(rows: &mut [f64], vertex: u32, block: DMat3) {
    let size = rows.len() / 3;
    for i in 0..3 {
        for j in 0..3 {
            rows[i * size + 3 * vertex as usize + j] += block.col(j)[i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Boundary;
    use faer::linalg::solvers::{PartialPivLu, Solve};
    use faer::{Mat, MatRef};
    use glam::DVec3;
    use rhombus_chain::SurfaceMesh;

    /// An octahedron divided `times` times, on the sphere of radius 1.
    fn sphere(times: usize) -> SurfaceMesh {
        let mut vertices = vec![DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
        let mut faces: Vec<[u32; 3]> =
            vec![[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
        for _ in 0..times {
            let mut finer = Vec::new();
            for [a, b, c] in faces {
                let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|[from, to]| {
                    let middle = (vertices[from as usize] + vertices[to as usize]).normalize_or_zero();
                    let known = vertices.iter().position(|at| at.distance(middle) < 1e-9);
                    known.unwrap_or_else(|| {
                        vertices.push(middle);
                        vertices.len() - 1
                    }) as u32
                });
                finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
            }
            faces = finer;
        }
        SurfaceMesh::new(vertices, faces).unwrap()
    }

    /// Largest error of the displacement of a sphere under unit pressure, relative to the exact one, p R / 3K inwards.
    /// The rigid motions, which no traction fixes, are set to zero.
    fn sphere_under_pressure(times: usize, poisson: f64) -> f64 {
        let surface = sphere(times);
        let Boundary { h, g } = Boundary::new(&surface, &vec![false; surface.vertices().len()], poisson);
        let size = 3 * surface.vertices().len();
        let rigid = Mat::from_fn(size, 6, |row, mode| {
            let [vertex, axis] = [row / 3, row % 3];
            let at = surface.vertices()[vertex];
            let motion = if mode < 3 { DVec3::AXES[mode] } else { DVec3::AXES[mode - 3].cross(at) };
            motion[axis]
        });
        let weight = 1.0 / size as f64;
        let held =
            MatRef::from_row_major_slice(&h, size, size) + &rigid * rigid.transpose() * faer::Scale(weight);
        let traction = Mat::from_fn(size, 1, |row, _| -surface.vertices()[row / 3][row % 3]);
        let side = MatRef::from_row_major_slice(&g, size, size) * &traction;
        let u = PartialPivLu::new(held.as_ref()).solve(&side);
        let bulk_over_shear = 2.0 * (1.0 + poisson) / (3.0 * (1.0 - 2.0 * poisson));
        let exact = 1.0 / (3.0 * bulk_over_shear);
        surface
            .vertices()
            .iter()
            .enumerate()
            .map(|(k, &at)| {
                (DVec3::from_array([0, 1, 2].map(|i| u[(3 * k + i, 0)])) + at * exact).length() / exact
            })
            .fold(0.0, f64::max)
    }

    #[test]
    fn a_sphere_under_pressure_shrinks_as_it_should_and_better_with_more_triangles() {
        for poisson in [0.0, 0.3, 0.45] {
            let [coarse, fine] = [2, 3].map(|times| sphere_under_pressure(times, poisson));
            assert!(fine < 0.07 && fine < 0.5 * coarse, "nu {poisson}: {coarse} {fine}");
        }
    }

    #[test]
    fn a_rigid_rotation_needs_no_traction() {
        let surface = sphere(2);
        let Boundary { h, g } = Boundary::new(&surface, &vec![false; surface.vertices().len()], 0.3);
        let size = 3 * surface.vertices().len();
        let turn = |row: usize| DVec3::new(0.3, -1.0, 0.7).cross(surface.vertices()[row / 3])[row % 3];
        let largest = |matrix: &[f64]| {
            let rows = matrix.chunks_exact(size);
            rows.map(|row| row.iter().enumerate().map(|(k, number)| number * turn(k)).sum::<f64>().abs())
                .fold(0.0, f64::max)
        };
        // Any other motion of this size would give about one half: the free term.
        assert!(largest(&h) < 1e-3, "{}", largest(&h));
        assert!(largest(&g) > 0.1);
    }
}
