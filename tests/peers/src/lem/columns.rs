//! Where parallel lines on a square lattice run inside a closed surface.

use glam::{DVec2, DVec3};
use rhombus_chain::SurfaceMesh;

/// A lattice of parallel lines.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lattice {
    /// A point of the line of cell (0, 0).
    pub(crate) origin: DVec3,
    /// Unit vectors: along the lattice's rows, along its columns, along the lines.
    pub(crate) axes: [DVec3; 3],
    /// Distance of neighbouring lines, m.
    pub(crate) pitch_m: f64,
    /// Lines along the first and the second axis.
    pub(crate) size: [usize; 2],
}

/// One piece of a line inside the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    /// Where it begins and ends along the line, m from the origin's plane.
    pub(crate) from_to_m: [f64; 2],
    /// The triangle it ends in.
    pub(crate) end_face: u32,
}

impl Lattice {
    /// Lines along the unit vector `along` through the body's whole shadow, one of them through `through`.
    pub(crate) fn around(surface: &SurfaceMesh, through: DVec3, along: DVec3, pitch_m: f64) -> Self {
        let (x, y) = along.any_orthonormal_pair();
        let flat = |at: DVec3| DVec2::new((at - through).dot(x), (at - through).dot(y)) / pitch_m;
        let (low, high) = surface
            .vertices()
            .iter()
            .map(|&at| flat(at))
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
        let (first, last) = (low.floor(), high.ceil());
        let size = [(last.x - first.x) as usize + 1, (last.y - first.y) as usize + 1];
        let origin = through + (x * first.x + y * first.y) * pitch_m;
        Self { origin, axes: [x, y, along], pitch_m, size }
    }

    /// Coordinates of a point: in pitches along the lattice, in metres along the lines.
    pub(crate) fn local(&self, at: DVec3) -> (DVec2, f64) {
        let offset = at - self.origin;
        let [x, y, z] = self.axes.map(|axis| offset.dot(axis));
        (DVec2::new(x, y) / self.pitch_m, z)
    }

    /// For each line (first axis fastest) its pieces inside the surface, ascending.
    ///
    /// A line exactly through an edge counts the edge once (as if it ran a hair beside it, the same hair for all).
    pub(crate) fn pieces(&self, surface: &SurfaceMesh) -> Vec<Vec<Piece>> {
        let mut crossings: Vec<Vec<(f64, u32)>> = vec![Vec::new(); self.size[0] * self.size[1]];
        let local: Vec<(DVec2, f64)> = surface.vertices().iter().map(|&at| self.local(at)).collect();
        for (face, triangle) in (0u32..).zip(surface.triangles()) {
            let corners = triangle.map(|vertex| local[vertex as usize]);
            self.cross(corners, |line, height| crossings[line].push((height, face)));
        }
        crossings
            .into_iter()
            .map(|mut heights| {
                heights.sort_by(|a, b| a.0.total_cmp(&b.0));
                let piece =
                    |pair: &[(f64, u32)]| Piece { from_to_m: [pair[0].0, pair[1].0], end_face: pair[1].1 };
                heights
                    .chunks_exact(2)
                    .map(piece)
                    .filter(|piece| piece.from_to_m[1] > piece.from_to_m[0])
                    .collect()
            })
            .collect()
    }

    /// Calls `hit` with the number of each line through a triangle and the height.
    fn cross(&self, corners: [(DVec2, f64); 3], mut hit: impl FnMut(usize, f64)) {
        let flat = corners.map(|corner| corner.0);
        let low = flat[0].min(flat[1]).min(flat[2]).ceil().max(DVec2::ZERO);
        let high = flat[0].max(flat[1]).max(flat[2]).floor();
        let area = (flat[1] - flat[0]).perp_dot(flat[2] - flat[0]);
        let range =
            |low: f64, high: f64, size: usize| low as usize..((high + 1.0).max(0.0) as usize).min(size);
        for j in range(low.y, high.y, self.size[1]) {
            for i in range(low.x, high.x, self.size[0]) {
                let at = DVec2::new(i as f64, j as f64);
                let mut height = 0.0;
                let mut inside = true;
                for k in 0..3 {
                    let (from, to) = (flat[(k + 1) % 3], flat[(k + 2) % 3]);
                    // An edge is evaluated in one direction for both of its triangles, so that they agree.
                    let ordered = (from.x, from.y) < (to.x, to.y);
                    let (a, b) = if ordered { (from, to) } else { (to, from) };
                    let side = (b - a).perp_dot(at - a) * if ordered { 1.0 } else { -1.0 };
                    let left = if side == 0.0 { ordered } else { side > 0.0 };
                    inside &= left == (area > 0.0);
                    height += side / area * corners[k].1;
                }
                if inside {
                    hit(j * self.size[0] + i, height);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Lattice;
    use crate::TetMesh;
    use glam::DVec3;

    #[test]
    fn lines_through_a_block_are_as_long_as_the_block_and_fill_its_volume() {
        let (surface, _) = TetMesh::block(&[0.0, 0.05, 0.1], &[0.0, 0.04, 0.08], &[0.0, 0.03]);
        // One line lies on the diagonal edges of the top and bottom squares.
        for through in [DVec3::new(0.025, 0.02, 0.03), DVec3::new(0.0123, 0.0345, 0.03)] {
            let lattice = Lattice::around(&surface, through, DVec3::Z, 0.002);
            let pieces = lattice.pieces(&surface);
            assert!(pieces.iter().all(|line| line.len() <= 1));
            let lengths: Vec<f64> =
                pieces.iter().flatten().map(|p| p.from_to_m[1] - p.from_to_m[0]).collect();
            assert!(lengths.iter().all(|length| (length - 0.03).abs() < 1e-12));
            let volume: f64 = lengths.iter().sum::<f64>() * 0.002 * 0.002;
            assert!((volume / surface.volume_m3() - 1.0).abs() < 0.06, "{volume}");
            let top = pieces.iter().flatten().map(|piece| surface.face_normal(piece.end_face));
            assert!(top.into_iter().all(|normal| normal.distance(DVec3::Z) < 1e-12));
            let (cell, height) = lattice.local(through);
            assert!(cell.distance(cell.round()) < 1e-9 && height.abs() < 1e-12);
        }
    }
}
