//! Mesh rings around a point: discrete, for comparison with the literature only (`surface.spread: rings`).

use crate::mesh::{SurfaceMesh, SurfacePoint};

/// Ring numbers of vertices, with the scratch memory to find them. Ring 0 are the corners of the point's
/// face, ring 1 their other neighbours, and so on.
#[derive(Clone, Debug)]
pub(crate) struct Rings {
    /// The query that last reached each vertex.
    reached: Vec<u32>,
    query: u32,
}

impl Rings {
    pub(crate) fn new(mesh: &SurfaceMesh) -> Self {
        Self { reached: vec![0; mesh.vertices().len()], query: 0 }
    }

    /// Appends the vertices of all rings below `limit` to `found`, with their ring numbers.
    pub(crate) fn solve(
        &mut self,
        mesh: &SurfaceMesh,
        source: SurfacePoint,
        limit: f64,
        found: &mut Vec<(u32, f64)>,
    ) {
        self.query = self.query.wrapping_add(1);
        if self.query == 0 {
            // After 2^32 queries old marks would look new.
            self.reached.fill(0);
            self.query = 1;
        }
        if limit.is_nan() || limit <= 0.0 {
            return;
        }
        for vertex in mesh.triangles()[source.face as usize] {
            self.reached[vertex as usize] = self.query;
            found.push((vertex, 0.0));
        }
        let mut next = 0;
        while let Some(&(vertex, ring)) = found.get(next) {
            next += 1;
            if ring + 1.0 >= limit {
                break;
            }
            for neighbour in mesh.neighbours(vertex) {
                let reached = &mut self.reached[neighbour as usize];
                if *reached != self.query {
                    *reached = self.query;
                    found.push((neighbour, ring + 1.0));
                }
            }
        }
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        self.reached.capacity() * size_of::<u32>()
    }
}
