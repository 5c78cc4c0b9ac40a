//! A box of nearly square cells, each cut into two triangles.

use glam::DVec3;

use super::Shape;

/// Edge lengths, m. The body frame is at the middle of the underside.
const SIZE_M: DVec3 = DVec3::new(0.10, 0.08, 0.05);

/// A box with about `vertices` vertices: with `n` cells along the edges there are `2 (nx ny + ny nz + nz nx) + 2`.
pub(super) fn generate(vertices: usize) -> Shape {
    let cells = cells(vertices);
    let [nx, ny, nz] = cells;
    let grid = Grid { cells };
    let mut shape = Shape { vertices: grid.vertices(), triangles: Vec::new() };
    // Side by side so that (first, second, outward) is right-handed.
    grid.side(&mut shape, nx, ny, |i, j| [i, j, nz]);
    grid.side(&mut shape, ny, nx, |i, j| [j, i, 0]);
    grid.side(&mut shape, ny, nz, |i, j| [nx, i, j]);
    grid.side(&mut shape, nz, ny, |i, j| [0, j, i]);
    grid.side(&mut shape, nz, nx, |i, j| [j, ny, i]);
    grid.side(&mut shape, nx, nz, |i, j| [i, 0, j]);
    shape
}

fn vertex_count([nx, ny, nz]: [usize; 3]) -> usize {
    2 * (nx * ny + ny * nz + nz * nx) + 2
}

/// The cell counts nearest to `vertices` among boxes of nearly square cells.
fn cells(vertices: usize) -> [usize; 3] {
    let area = 2.0 * (SIZE_M.x * SIZE_M.y + SIZE_M.y * SIZE_M.z + SIZE_M.z * SIZE_M.x);
    let cell = (area / vertices.saturating_sub(2).max(6) as f64).sqrt();
    let options = |length: f64| {
        let low = ((length / cell) as usize).max(1);
        [low, low + 1]
    };
    let mut best = [1, 1, 1];
    for nx in options(SIZE_M.x) {
        for ny in options(SIZE_M.y) {
            for nz in options(SIZE_M.z) {
                if vertex_count([nx, ny, nz]).abs_diff(vertices) < vertex_count(best).abs_diff(vertices) {
                    best = [nx, ny, nz];
                }
            }
        }
    }
    best
}

struct Grid {
    cells: [usize; 3],
}

impl Grid {
    /// The grid points on the surface, in the order of their numbers.
    fn vertices(&self) -> Vec<DVec3> {
        let [nx, ny, nz] = self.cells;
        let mut vertices = Vec::with_capacity(vertex_count(self.cells));
        for k in 0..=nz {
            for j in 0..=ny {
                for i in 0..=nx {
                    if self.is_on_surface([i, j, k]) {
                        let fraction =
                            DVec3::new(i as f64 / nx as f64, j as f64 / ny as f64, k as f64 / nz as f64);
                        vertices.push((fraction - DVec3::new(0.5, 0.5, 0.0)) * SIZE_M);
                    }
                }
            }
        }
        vertices
    }

    fn is_on_surface(&self, at: [usize; 3]) -> bool {
        at.iter().zip(self.cells).any(|(i, n)| *i == 0 || *i == n)
    }

    /// Number of a grid point on the surface: full layers below and above, only the border between.
    fn number(&self, [i, j, k]: [usize; 3]) -> u32 {
        let [nx, ny, nz] = self.cells;
        let (layer, border) = ((nx + 1) * (ny + 1), 2 * (nx + ny));
        let below = if k == 0 { 0 } else { layer + (k - 1) * border };
        let within = if k == 0 || k == nz {
            j * (nx + 1) + i
        } else {
            match j {
                0 => i,
                _ if j == ny => (nx + 1) + 2 * (ny - 1) + i,
                _ => (nx + 1) + 2 * (j - 1) + usize::from(i == nx),
            }
        };
        (below + within) as u32
    }

    fn side(&self, shape: &mut Shape, n: usize, m: usize, at: impl Fn(usize, usize) -> [usize; 3]) {
        for i in 0..n {
            for j in 0..m {
                let [a, b, c, d] =
                    [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| self.number(at(i, j)));
                // Alternating diagonals give the surface no preferred direction.
                if (i + j) % 2 == 0 {
                    shape.triangles.extend([[a, b, c], [a, c, d]]);
                } else {
                    shape.triangles.extend([[a, b, d], [b, c, d]]);
                }
            }
        }
    }
}
