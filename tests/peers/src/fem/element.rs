//! Stiffness of one tetrahedron with straight edges, of first or second order.

use glam::{DMat3, DVec3};

use crate::Material;

/// Polynomial degree of the displacement in a tetrahedron.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Order {
    /// Linear: constant strain, nodes at the corners.
    First,
    /// Quadratic: linear strain, nodes at the corners and in the middles of the edges.
    Second,
}

/// Corners at the ends of the six edges; node `4 + e` of a second-order tetrahedron lies in the middle of edge `e`.
pub(super) const EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// The four points of the quadrature exact for quadratic integrands (the product of two linear strains): one barycentric
/// weight is `NEAR`, the others `FAR`.
const NEAR: f64 = 0.585_410_196_624_968_5;
const FAR: f64 = 0.138_196_601_125_010_5;

/// Gradients of the barycentric coordinates, 1/m, and the volume, m³.
fn gradients(corners: [DVec3; 4]) -> ([DVec3; 4], f64) {
    let [a, b, c, d] = corners;
    let inverse = DMat3::from_cols(b - a, c - a, d - a).inverse().transpose();
    let [gb, gc, gd] = [inverse.x_axis, inverse.y_axis, inverse.z_axis];
    ([-(gb + gc + gd), gb, gc, gd], (b - a).cross(c - a).dot(d - a) / 6.0)
}

/// Adds `weight` times (lambda g_i g_jᵀ + mu g_j g_iᵀ + mu (g_i . g_j) 1), the stiffness between nodes i and j whose shape
/// functions have the gradients g, to every block.
fn add_blocks(gradients: &[DVec3], weight: f64, (lambda, mu): (f64, f64), blocks: &mut [DMat3]) {
    let outer = |a: DVec3, b: DVec3| DMat3::from_cols(a * b.x, a * b.y, a * b.z);
    let mut block = blocks.iter_mut();
    for &gi in gradients {
        for &gj in gradients {
            if let Some(sum) = block.next() {
                let shear = outer(gj, gi) + DMat3::from_diagonal(DVec3::splat(gi.dot(gj)));
                *sum += (outer(gi, gj) * lambda + shear * mu) * weight;
            }
        }
    }
}

/// The stiffness in N/m between all nodes of a tetrahedron: blocks row by row, 4 x 4 or 10 x 10 of them.
pub(super) fn stiffness(order: Order, corners: [DVec3; 4], material: Material, blocks: &mut Vec<DMat3>) {
    let (g, volume) = gradients(corners);
    let lame = material.lame_pa();
    blocks.clear();
    match order {
        Order::First => {
            blocks.resize(16, DMat3::ZERO);
            add_blocks(&g, volume, lame, blocks);
        }
        Order::Second => {
            blocks.resize(100, DMat3::ZERO);
            for point in 0..4 {
                let mut at = [FAR; 4];
                at[point] = NEAR;
                let mut shape = [DVec3::ZERO; 10];
                for corner in 0..4 {
                    shape[corner] = g[corner] * (4.0 * at[corner] - 1.0);
                }
                for (middle, [a, b]) in shape[4..].iter_mut().zip(EDGES) {
                    *middle = (g[b] * at[a] + g[a] * at[b]) * 4.0;
                }
                add_blocks(&shape, volume / 4.0, lame, blocks);
            }
        }
    }
}
