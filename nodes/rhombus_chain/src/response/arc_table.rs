//! Arc lengths from every vertex to every other one, worked out in advance: a contact that moves has no time for them.
//!
//! From a point inside a face they are those from its corners, linear in between; near the contact, where an arc is no
//! linear function of its source, they are solved as they are elsewhere, and the two fade into one another. The table's
//! memory grows with the square of the vertices, so a large body does without.

use glam::DVec3;

use crate::arc_length::ArcLengths;
use crate::mesh::{SurfaceMesh, SurfacePoint, length};

use super::lanes::BLOCK;

/// Vertices up to which there is a table: 64 MB.
const TABLE_UP_TO: usize = 4000;
/// Longest edges of the contact's face within which arcs are solved, and from which on they are interpolated.
const SOLVED: f64 = 1.5;
const INTERPOLATED: f64 = 3.0;
/// Longest edges by which a solved arc may be longer than the interpolated one: 8 % of what counts, and labels are off by 5 %.
const MARGIN: f64 = 0.25;
/// Nothing leads there.
const FAR: f32 = 1e9;

/// Each vertex as a point of one of its faces.
fn corners_of_vertices(mesh: &SurfaceMesh) -> Vec<SurfacePoint> {
    let mut places = vec![SurfacePoint { face: 0, barycentric: DVec3::X }; mesh.vertices().len()];
    for (face, corners) in mesh.triangles().iter().enumerate() {
        for (vertex, barycentric) in corners.iter().zip([DVec3::X, DVec3::Y, DVec3::Z]) {
            places[*vertex as usize] = SurfacePoint { face: face as u32, barycentric };
        }
    }
    places
}

/// Arc lengths from any point of one surface to its vertices, m.
#[derive(Clone, Debug)]
pub(crate) struct ArcTable {
    solver: ArcLengths,
    vertices: usize,
    /// V x V, or nothing.
    rows: Vec<f32>,
    /// What was solved last, in whole blocks.
    arcs: Vec<[f32; BLOCK]>,
    /// From where and up to what limit: a contact that stays is not solved again.
    solved: Option<(SurfacePoint, f64)>,
    longest_m: f64,
}

impl ArcTable {
    /// Works the table out for `mesh`.
    pub(crate) fn new(mesh: &SurfaceMesh) -> Self {
        let vertices = mesh.vertices().len();
        let mut solver = ArcLengths::new(mesh);
        let mut rows = Vec::new();
        if vertices <= TABLE_UP_TO {
            rows.resize(vertices * vertices, FAR);
            for (place, row) in corners_of_vertices(mesh).into_iter().zip(rows.chunks_exact_mut(vertices)) {
                solver.solve(mesh, place, f64::INFINITY);
                for (other, arc_m) in solver.iter() {
                    row[other as usize] = arc_m as f32;
                }
            }
        }
        let longest_m = if rows.is_empty() {
            // No more than twice around the box.
            let (low, high) =
                mesh.vertices().iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), vertex| {
                    (low.min(*vertex), high.max(*vertex))
                });
            8.0 * length(high - low)
        } else {
            rows.iter().filter(|arc| **arc < FAR).fold(0.0, |most: f32, arc| most.max(*arc)).into()
        };
        let arcs = vec![[FAR; BLOCK]; vertices.div_ceil(BLOCK)];
        Self { solver, vertices, rows, arcs, solved: None, longest_m }
    }

    /// Finds the arcs from `source` to all vertices; those not below `limit_m` may be anything not below it.
    pub(crate) fn solve(&mut self, mesh: &SurfaceMesh, source: SurfacePoint, limit_m: f64) {
        // The table does not depend on the limit.
        let wanted = Some((source, if self.rows.is_empty() { limit_m } else { f64::INFINITY }));
        if self.solved == wanted {
            return;
        }
        self.solved = wanted;
        let arcs = self.arcs.as_flattened_mut();
        if self.rows.is_empty() {
            self.solver.solve(mesh, source, limit_m);
            arcs.fill(FAR);
            for (vertex, arc_m) in self.solver.iter() {
                arcs[vertex as usize] = arc_m as f32;
            }
            return;
        }
        let [a, b, c] = mesh.triangles()[source.face as usize].map(|corner| {
            let begin = corner as usize * self.vertices;
            &self.rows[begin..begin + self.vertices]
        });
        let [x, y, z] = source.barycentric.to_array().map(|share| share as f32);
        for (((arc, a), b), c) in arcs.iter_mut().zip(a).zip(b).zip(c) {
            *arc = x * a + y * b + z * c;
        }
        let corners = mesh.corners(source.face);
        let edge = (0..3).map(|k| length(corners[k] - corners[(k + 1) % 3])).fold(0.0, f64::max);
        let (solved, interpolated) = (SOLVED * edge, INTERPOLATED * edge);
        // Solved arcs count where the interpolated ones are short, and then they are no longer, but for what labels are off.
        self.solver.solve(mesh, source, interpolated + MARGIN * edge);
        for (vertex, arc_m) in self.solver.iter() {
            let arc = &mut arcs[vertex as usize];
            let between = ((f64::from(*arc) - solved) / (interpolated - solved)).clamp(0.0, 1.0);
            let fade = between * between * (3.0 - 2.0 * between);
            *arc = (arc_m + (f64::from(*arc) - arc_m) * fade) as f32;
        }
    }

    /// What was solved last: the arc to each vertex, m; what is left of the last block is far.
    pub(crate) fn blocks(&self) -> &[[f32; BLOCK]] {
        &self.arcs
    }

    /// Number of vertices.
    pub(crate) fn vertices(&self) -> usize {
        self.vertices
    }

    /// The longest arc that there can be, m.
    pub(crate) fn longest_m(&self) -> f64 {
        self.longest_m
    }

    /// Bytes of memory it occupies.
    pub(crate) fn memory_bytes(&self) -> usize {
        self.solver.memory_bytes() + size_of_val(self.rows.as_slice()) + size_of_val(self.arcs.as_slice())
    }
}
