//! What the labelling needs to know of the triangles around each vertex.

use std::ops::Range;

use crate::mesh::{SurfaceMesh, destination, length};

/// One edge seen from its start, with the angle to the next edge around that vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    /// The edge's other end.
    pub(super) to: u32,
    /// Length of the edge in metres.
    pub(super) length: f64,
    /// Angle from this edge to the next one of the fan.
    pub(super) cos: f64,
    pub(super) sin: f64,
}

/// Fans of all vertices, one after another.
#[derive(Clone, Debug)]
pub(super) struct Table {
    starts: Vec<u32>,
    edges: Vec<Edge>,
    /// What decides how far behind the limit a vertex still matters to vertices before it, see [`reach`].
    reach: Vec<[f64; 2]>,
}

impl Table {
    pub(super) fn new(mesh: &SurfaceMesh) -> Self {
        let vertices = mesh.vertices();
        let mut starts = Vec::with_capacity(vertices.len() + 1);
        let mut edges = Vec::with_capacity(3 * mesh.triangles().len());
        starts.push(0);
        for (vertex, &position) in (0u32..).zip(vertices) {
            let first = edges.len();
            let way = |h| vertices[destination(mesh.triangles(), h) as usize] - position;
            for h in mesh.fan(vertex) {
                let to = destination(mesh.triangles(), h);
                edges.push(Edge { to, length: length(way(h)), cos: 0.0, sin: 0.0 });
            }
            let count = edges.len() - first;
            for (k, h) in mesh.fan(vertex).enumerate() {
                let next = edges[first + (k + 1) % count];
                let (u, v) = (way(h), vertices[next.to as usize] - position);
                let edge = &mut edges[first + k];
                let product = edge.length * next.length;
                (edge.cos, edge.sin) = (u.dot(v) / product, length(u.cross(v)) / product);
            }
            starts.push(edges.len() as u32);
        }
        let reach = reach(&starts, &edges);
        Self { starts, edges, reach }
    }

    /// Places of a vertex's fan.
    #[inline]
    pub(super) fn fan(&self, vertex: u32) -> Range<usize> {
        self.starts[vertex as usize] as usize..self.starts[vertex as usize + 1] as usize
    }

    #[inline]
    pub(super) fn edge(&self, place: usize) -> Edge {
        self.edges[place]
    }

    /// Arc length up to which `vertex` can matter to arcs below `limit_m`.
    #[inline]
    pub(super) fn horizon(&self, vertex: u32, limit_m: f64) -> f64 {
        let [l, obtuse] = self.reach[vertex as usize];
        let behind = (limit_m * limit_m + l * (l + 2.0 * limit_m * obtuse)).sqrt() - limit_m;
        limit_m + 2.0 * behind
    }

    pub(super) fn memory_bytes(&self) -> usize {
        self.starts.capacity() * size_of::<u32>()
            + self.edges.capacity() * size_of::<Edge>()
            + self.reach.capacity() * size_of::<[f64; 2]>()
    }
}

/// How far behind a vertex c the vertex b can be and still shorten the way to c through the triangle a b c.
///
/// With the source at distance D from c, at an angle phi from the edge c b, of length l, b is at
/// `sqrt(D^2 + l^2 - 2 D l cos phi)`. The way crosses the edge a b, so phi is at most the angle at c: only an obtuse one leaves
/// a distance behind c that does not shrink with D. For each vertex b the largest l and the largest `-cos phi`, 0 at least.
fn reach(starts: &[u32], edges: &[Edge]) -> Vec<[f64; 2]> {
    let mut reach = vec![[0.0f64; 2]; starts.len() - 1];
    for fan in starts.windows(2) {
        let fan = &edges[fan[0] as usize..fan[1] as usize];
        for (k, edge) in fan.iter().enumerate() {
            let next = fan[(k + 1) % fan.len()];
            for (to, length) in [(edge.to, edge.length), (next.to, next.length)] {
                let [l, obtuse] = &mut reach[to as usize];
                *l = l.max(length);
                *obtuse = obtuse.max(-edge.cos);
            }
        }
    }
    reach
}
