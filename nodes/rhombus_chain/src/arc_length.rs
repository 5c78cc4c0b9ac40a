//! Arc lengths along the rest surface from one point to the vertices around it.

mod heap;
mod table;

use crate::mesh::{SurfaceMesh, SurfacePoint, length};
use heap::Heap;
use table::{Edge, Table};

/// A label only counts as shorter when it is shorter by this factor: rounding must not keep labels falling for ever.
const SHORTER: f64 = 1.0 - 1e-12;

/// Arc lengths from a point of one surface, with the scratch memory to compute them.
///
/// Vertices are labelled outward from the point in order of distance. Two labelled vertices of a triangle place the point in
/// the triangle's plane, on the far side of their edge; the straight line from there to the third vertex is its label
/// if it crosses the edge, else the way leads through the nearer end. Where a longer way turns out shorter afterwards (behind
/// obtuse angles) vertices are labelled again. The labels depend continuously on the point.
///
/// Made once for a surface; a query neither allocates nor looks at vertices out of reach.
#[derive(Clone, Debug)]
pub struct ArcLengths {
    table: Table,
    labels: Vec<Label>,
    heap: Heap,
    touched: Vec<u32>,
    query: u32,
}

/// What is known of one vertex. Out of date unless it belongs to the present query.
#[derive(Clone, Copy, Debug)]
struct Label {
    arc_m: f64,
    query: u32,
    is_settled: bool,
}

impl ArcLengths {
    /// Prepares the queries on `mesh`.
    #[must_use]
    pub fn new(mesh: &SurfaceMesh) -> Self {
        let vertices = mesh.vertices().len();
        Self {
            table: Table::new(mesh),
            labels: vec![Label { arc_m: 0.0, query: 0, is_settled: false }; vertices],
            heap: Heap::new(vertices),
            touched: Vec::with_capacity(vertices),
            query: 0,
        }
    }

    /// Computes the arcs from `source` to all vertices nearer than `limit_m`. `mesh` is the surface this was made for.
    ///
    /// An arc below the limit does not depend on the limit. Real-time safe.
    pub fn solve(&mut self, mesh: &SurfaceMesh, source: SurfacePoint, limit_m: f64) {
        self.begin();
        if limit_m.is_nan() || limit_m <= 0.0 {
            return;
        }
        let position = mesh.position(source);
        for vertex in mesh.triangles()[source.face as usize] {
            self.shorten(vertex, length(mesh.vertices()[vertex as usize] - position), limit_m);
        }
        while let Some((vertex, arc_m)) = self.heap.pop() {
            self.labels[vertex as usize].is_settled = true;
            self.relax(vertex, arc_m, limit_m);
        }
        let labels = &self.labels;
        self.touched.retain(|&vertex| labels[vertex as usize].arc_m < limit_m);
    }

    /// Vertices nearer than the limit of the last query, in no particular order, and their arc lengths in metres.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (u32, f64)> + '_ {
        self.touched.iter().map(|&vertex| (vertex, self.labels[vertex as usize].arc_m))
    }

    /// Bytes of memory the scratch occupies.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.table.memory_bytes()
            + self.heap.memory_bytes()
            + self.labels.capacity() * size_of::<Label>()
            + self.touched.capacity() * size_of::<u32>()
    }

    fn begin(&mut self) {
        self.touched.clear();
        self.heap.clear();
        self.query = self.query.wrapping_add(1);
        if self.query == 0 {
            // After 2^32 queries old labels would look new.
            self.labels.fill(Label { arc_m: 0.0, query: 0, is_settled: false });
            self.query = 1;
        }
    }

    /// Carries the label of `vertex` to the vertices around it.
    fn relax(&mut self, vertex: u32, arc_m: f64, limit_m: f64) {
        let fan = self.table.fan(vertex);
        for k in fan.clone() {
            let edge = self.table.edge(k);
            self.shorten(edge.to, arc_m + edge.length, limit_m);
        }
        for k in fan.clone() {
            let u = self.table.edge(k);
            let v = self.table.edge(if k + 1 == fan.end { fan.start } else { k + 1 });
            self.unfold(arc_m, u, v, u.cos, u.sin, limit_m);
            self.unfold(arc_m, v, u, u.cos, u.sin, limit_m);
        }
    }

    /// Carries the labels of a vertex and of the end of its edge `from` across that edge to the end of its edge `to`.
    #[inline]
    fn unfold(&mut self, arc_m: f64, from: Edge, to: Edge, cos: f64, sin: f64, limit_m: f64) {
        let end = self.labels[from.to as usize];
        if end.query != self.query || !end.is_settled {
            return; // its turn comes when it is settled
        }
        let target = self.labels[to.to as usize];
        let known = if target.query == self.query { target.arc_m } else { f64::INFINITY };
        let at = [to.length * cos, to.length * sin];
        if let Some(arc) = across(arc_m, end.arc_m, from.length, at, known) {
            self.shorten(to.to, arc, limit_m);
        }
    }

    /// Gives `vertex` the label `arc_m` if that is shorter than what it has.
    #[inline]
    fn shorten(&mut self, vertex: u32, arc_m: f64, limit_m: f64) {
        let label = &mut self.labels[vertex as usize];
        if label.query != self.query {
            if arc_m >= self.table.horizon(vertex, limit_m) {
                return;
            }
            *label = Label { arc_m, query: self.query, is_settled: false };
            self.touched.push(vertex);
            self.heap.push(vertex, arc_m);
        } else if arc_m < label.arc_m * SHORTER {
            label.arc_m = arc_m;
            label.is_settled = false;
            self.heap.decrease(vertex, arc_m);
        }
    }
}

/// Length of the straight way to the third vertex across an edge, if it crosses the edge and is shorter than `known`.
///
/// In the plane of the triangle, with the edge from the origin along x: the source lies below the edge, at distances
/// `start` from the origin and `end` from the edge's other end, and the third vertex at `target` above it.
#[inline]
fn across(start: f64, end: f64, edge: f64, [x, y]: [f64; 2], known: f64) -> Option<f64> {
    let along = ((start - end) * (start + end) + edge * edge) / (2.0 * edge);
    let below = (start * start - along * along).max(0.0).sqrt();
    let crossing = along * y + x * below;
    if crossing < 0.0 || crossing > edge * (below + y) {
        return None;
    }
    let (dx, dy) = (x - along, y + below);
    let arc_squared = dx * dx + dy * dy;
    (arc_squared < known * known).then(|| arc_squared.sqrt())
}
