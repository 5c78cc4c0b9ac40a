//! Arc lengths by labelling vertices outward from the source.
//!
//! Two labelled vertices of a triangle place the source in the triangle's plane, on the far side of their
//! edge; the straight line from there to the third vertex is its label if it crosses the edge, else the way
//! leads through the nearer end. Where a way turns out shorter afterwards (behind obtuse angles) vertices are
//! labelled again.

use super::labels::Labels;
use super::shelves::Shelves;
use super::table::Table;
use crate::mesh::{SurfaceMesh, SurfacePoint, length};

/// A label only counts as shorter when it is shorter by this factor: rounding must not keep labels falling
/// for ever.
const SHORTER: f64 = 1.0 - 1e-12;

/// Depth of a shelf of the queue in mean edge lengths. Deeper ones label more vertices twice, shallower ones
/// take longer to look through.
const SHELF_DEPTH: f64 = 0.12;

#[derive(Clone, Debug)]
pub(super) struct Labelling {
    table: Table,
    labels: Labels,
}

impl Labelling {
    pub(super) fn new(mesh: &SurfaceMesh) -> Self {
        let table = Table::new(mesh);
        let [mean_edge_m, longest_edge_m] = table.mean_and_longest_edge_m();
        let queue = Shelves::new(SHELF_DEPTH * mean_edge_m, longest_edge_m);
        Self { labels: Labels::new(mesh.vertices().len(), queue), table }
    }

    pub(super) fn solve(&mut self, mesh: &SurfaceMesh, source: SurfacePoint, limit_m: f64) {
        self.labels.clear();
        if limit_m.is_nan() || limit_m <= 0.0 {
            return;
        }
        let position = mesh.position(source);
        for vertex in mesh.triangles()[source.face as usize] {
            self.labels.shorten(vertex, length(mesh.vertices()[vertex as usize] - position));
        }
        while let Some((vertex, arc_m)) = self.labels.settle_next() {
            self.relax(vertex, arc_m, limit_m);
        }
        self.labels.trim(limit_m);
    }

    pub(super) fn known(&self) -> &[u32] {
        self.labels.known()
    }

    pub(super) fn arc_m(&self, vertex: u32) -> f64 {
        self.labels.read(vertex).arc_m
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.table.memory_bytes() + self.labels.memory_bytes()
    }

    /// Carries the label of `vertex` to the vertices around it: along the edges, and across the edges to
    /// settled ones.
    fn relax(&mut self, vertex: u32, arc_m: f64, limit_m: f64) {
        let Self { table, labels } = self;
        let fan = table.fan(vertex);
        let [first, .., last, _] = fan else { return };
        let (mut before, mut before_label) = (last, labels.read(last.to));
        let (mut edge, mut label) = (first, labels.read(first.to));
        for after in &fan[1..] {
            let after_label = labels.read(after.to);
            let known = label.arc_m;
            // Most of the vertices that are nearer can be told at once to stay as they are.
            if known > arc_m || edge.may_shorten(known, arc_m) {
                let mut best = (arc_m + edge.length_m).min(known);
                if before_label.is_settled {
                    let lengths = [before.length_m, edge.length_m];
                    best = across([arc_m, before_label.arc_m], lengths, before.angle, best);
                }
                if after_label.is_settled {
                    let lengths = [after.length_m, edge.length_m];
                    best = across([arc_m, after_label.arc_m], lengths, edge.angle, best);
                }
                let is_new = known == f64::INFINITY;
                if best < known * SHORTER && !(is_new && best >= table.horizon_m(edge.to, limit_m)) {
                    labels.shorten(edge.to, best);
                }
            }
            (before, before_label) = (edge, label);
            (edge, label) = (after, after_label);
        }
    }
}

/// Length of the straight way to a triangle's third vertex across the edge between the two others, where it
/// crosses that edge and is shorter than `known`; else `known`.
///
/// In the plane of the triangle, with the edge from the origin along x: the source is below the edge, `arcs`
/// away from its ends; the third vertex is above it. `lengths` of the edge and of the side from the origin to
/// the third vertex, with cosine and sine of the angle between them.
#[inline]
fn across([start, end]: [f64; 2], [edge, side]: [f64; 2], [cos, sin]: [f64; 2], known: f64) -> f64 {
    let (x, y) = (side * cos, side * sin);
    // Everything times twice the edge: a square root is enough to know whether there is anything to divide.
    let twice = 2.0 * edge;
    let along = (start - end) * (start + end) + edge * edge;
    let below = ((twice * start - along) * (twice * start + along)).max(0.0).sqrt();
    let crossing = along * y + x * below;
    if crossing < 0.0 || crossing > edge * (below + twice * y) {
        return known;
    }
    let (dx, dy) = (twice * x - along, twice * y + below);
    let squared = dx * dx + dy * dy;
    if squared < (twice * known) * (twice * known) { squared.sqrt() / twice } else { known }
}
