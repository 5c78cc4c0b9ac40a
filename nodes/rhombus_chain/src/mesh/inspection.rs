//! What a mesh file holds, faults and all.

use glam::DVec3;

use super::topology::{self, HalfEdges, NONE};
use super::{TRIANGLE_LIMIT, measures};

/// Counts of everything [`SurfaceMesh::new`](super::SurfaceMesh::new) looks at, without stopping at the first
/// fault.
#[derive(Clone, Debug, PartialEq)]
pub struct Inspection {
    /// Number of vertices.
    pub vertices: usize,
    /// Number of triangles.
    pub triangles: usize,
    /// Vertices with a NaN, infinite or absurdly large coordinate.
    pub unusable_vertices: usize,
    /// Triangles that name a vertex that does not exist or is not usable. They are left out of what follows.
    pub unusable_triangles: usize,
    /// Triangles that use a vertex twice or have no area.
    pub degenerate_triangles: usize,
    /// Edges that belong to one triangle only.
    pub open_edges: usize,
    /// Edges that belong to more than two triangles.
    pub non_manifold_edges: usize,
    /// Edges that two triangles run through in the same direction.
    pub misoriented_edges: usize,
    /// Vertices where several fans of triangles meet, not counting vertices of the edges above.
    pub non_manifold_vertices: usize,
    /// Vertices that belong to no triangle.
    pub unreferenced_vertices: usize,
    /// Connected parts.
    pub parts: usize,
    /// Signed volume in m³, negative when the triangles are flipped; `None` when the surface does not enclose
    /// one.
    pub volume_m3: Option<f64>,
    /// Surface area in m².
    pub area_m2: f64,
    /// Smallest and largest coordinates of the usable vertices; `None` when there is none.
    pub extents: Option<[DVec3; 2]>,
}

impl Inspection {
    /// Every edge belongs to two triangles, or more.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.open_edges == 0 && self.triangles > self.unusable_triangles
    }

    /// No edge belongs to more than two triangles, and every vertex has one fan of triangles.
    #[must_use]
    pub fn is_manifold(&self) -> bool {
        self.non_manifold_edges == 0 && self.non_manifold_vertices == 0
    }

    /// Neighbouring triangles turn in the same sense.
    #[must_use]
    pub fn is_oriented(&self) -> bool {
        self.misoriented_edges == 0
    }
}

/// Looks at a triangle list whatever is wrong with it.
#[must_use]
pub fn inspect(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Inspection {
    let total = triangles.len();
    let triangles = &triangles[..total.min(TRIANGLE_LIMIT)];
    let usable: Vec<bool> = vertices.iter().map(|&p| measures::is_usable(p)).collect();
    let is_usable = |t: &[u32; 3]| t.iter().all(|&v| usable.get(v as usize) == Some(&true));
    let sound: Vec<[u32; 3]> = triangles.iter().copied().filter(is_usable).collect();
    let points: Vec<DVec3> = vertices.iter().copied().filter(|&p| measures::is_usable(p)).collect();

    let repeats = |t: usize| {
        let [a, b, c] = sound[t];
        a == b || b == c || c == a
    };
    let is_degenerate = |t: &usize| {
        let (edge, height) = measures::longest_edge_and_height(sound[*t].map(|v| vertices[v as usize]));
        repeats(*t) || measures::is_degenerate(edge, height)
    };
    let half_edges = HalfEdges::new(vertices.len(), &sound, repeats);
    let pairing = half_edges.pair();
    let is_whole = |v: usize| {
        half_edges.leaving(v).iter().all(|&h| {
            pairing.twins[h as usize] != NONE && pairing.twins[topology::previous(h) as usize] != NONE
        })
    };
    let mut visited = vec![false; pairing.twins.len()];
    let non_manifold_vertices = (0..vertices.len())
        .filter(|&v| is_whole(v) && topology::fans(half_edges.leaving(v), &pairing.twins, &mut visited) > 1)
        .count();

    let (volume_m3, area_m2) = measures::volume_and_area(vertices, &sound);
    let encloses =
        !sound.is_empty() && pairing.open.count + pairing.crowded.count + pairing.misoriented.count == 0;
    Inspection {
        vertices: vertices.len(),
        triangles: total,
        unusable_vertices: vertices.len() - points.len(),
        unusable_triangles: total - sound.len(),
        degenerate_triangles: (0..sound.len()).filter(is_degenerate).count(),
        open_edges: pairing.open.count,
        non_manifold_edges: pairing.crowded.count,
        misoriented_edges: pairing.misoriented.count,
        non_manifold_vertices,
        unreferenced_vertices: measures::unreferenced(&half_edges, vertices.len()),
        parts: measures::parts(&pairing.twins).into_iter().max().map_or(0, |last| last as usize + 1),
        volume_m3: encloses.then_some(volume_m3),
        area_m2,
        extents: (!points.is_empty()).then(|| measures::extents(&points)),
    }
}
