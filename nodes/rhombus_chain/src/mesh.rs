//! A body's rest surface: triangles that have been checked to enclose a volume.

mod error;
mod inspection;
mod measures;
mod topology;

use glam::DVec3;

pub use error::MeshError;
pub use inspection::{Inspection, inspect};

pub(crate) use measures::{is_usable, length, unit};
use topology::{HalfEdges, NONE, Topology};
pub(crate) use topology::{destination, next, previous};

/// Largest coordinate that is taken seriously, in metres. Products of three of them stay far from overflow.
pub(crate) const COORDINATE_LIMIT_M: f64 = 1e6;

/// A triangle has to be higher than this fraction of its longest edge. Its square is what closest points are
/// divided by: far below 1e-8 that would be all rounding.
pub(crate) const DEGENERATE_HEIGHT: f64 = 1e-6;

/// Half-edge numbers are 32 bits wide.
pub(crate) const TRIANGLE_LIMIT: usize = (u32::MAX / 3) as usize - 1;

/// A point of the surface.
///
/// Plain data: equal points are equal in every bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The triangle.
    pub face: u32,
    /// Weights of the triangle's corners: none negative, sum 1.
    pub barycentric: DVec3,
}

/// A closed, manifold, outward oriented triangle surface of one or more parts, in metres.
///
/// Immutable. Half-edge `3 t + k` runs from corner `k` of triangle `t` to its next corner.
#[derive(Clone, Debug)]
pub struct SurfaceMesh {
    vertices: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    twins: Vec<u32>,
    vertex_half_edges: Vec<u32>,
    vertex_normals: Vec<DVec3>,
    vertex_areas: Vec<f64>,
    volume_m3: f64,
    extents: [DVec3; 2],
}

impl SurfaceMesh {
    /// Checks the triangle list and prepares normals, areas and neighbours.
    ///
    /// # Errors
    /// The first fault found, in the order of [`MeshError`]'s variants. A closed part inside another part may
    /// be oriented inward (a cavity); one that lies beside the others may not.
    pub fn new(vertices: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        check_entries(&vertices, &triangles)?;
        let half_edges = HalfEdges::new(vertices.len(), &triangles, |_| false);
        let topology = half_edges.pair();
        check_edges(&topology)?;
        let vertex_half_edges = check_vertices(&half_edges, &topology.twins, vertices.len())?;
        drop(half_edges);
        let (volume_m3, area_m2) = measures::volume_and_area(&vertices, &triangles);
        if volume_m3.abs() <= measures::flat_volume(&vertices, area_m2) {
            return Err(MeshError::NoVolume { volume_m3, area_m2 });
        }
        measures::check_outward(&vertices, &triangles, &topology.twins)?;
        Ok(Self {
            vertex_normals: measures::vertex_normals(&vertices, &triangles),
            vertex_areas: measures::vertex_areas(&vertices, &triangles),
            extents: measures::extents(&vertices),
            volume_m3,
            twins: topology.twins,
            vertex_half_edges,
            vertices,
            triangles,
        })
    }

    /// Rest positions of the vertices, in metres.
    #[must_use]
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// Corner vertices of the triangles, counter-clockwise seen from outside.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Unit outward normals of the vertices: the normals of the adjoining faces, weighted by their angles.
    #[must_use]
    pub fn vertex_normals(&self) -> &[DVec3] {
        &self.vertex_normals
    }

    /// A third of the area of the adjoining faces for each vertex, in m²; the sum is the surface area.
    #[must_use]
    pub fn vertex_areas(&self) -> &[f64] {
        &self.vertex_areas
    }

    /// Enclosed volume in m³.
    #[must_use]
    pub fn volume_m3(&self) -> f64 {
        self.volume_m3
    }

    /// Smallest and largest coordinates.
    #[must_use]
    pub fn extents(&self) -> [DVec3; 2] {
        self.extents
    }

    /// Corner positions of a face.
    ///
    /// # Panics
    /// When there is no such face, as with an index into a slice.
    #[must_use]
    #[inline]
    pub fn corners(&self, face: u32) -> [DVec3; 3] {
        self.triangles[face as usize].map(|v| self.vertices[v as usize])
    }

    /// The half-edge that runs the other way through the same edge.
    #[inline]
    pub(crate) fn twin(&self, half_edge: u32) -> u32 {
        self.twins[half_edge as usize]
    }

    /// The vertex half-edge `half_edge` starts from.
    #[inline]
    pub(crate) fn origin(&self, half_edge: u32) -> u32 {
        topology::origin(&self.triangles, half_edge)
    }

    /// Half-edges that leave a vertex, clockwise seen from outside, beginning with an arbitrary fixed one.
    #[inline]
    pub(crate) fn fan(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        let first = self.vertex_half_edges[vertex as usize];
        std::iter::successors(Some(first), move |&h| {
            let next = next(self.twin(h));
            (next != first).then_some(next)
        })
    }

    /// Vertices joined to `vertex` by an edge.
    pub fn neighbours(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        self.fan(vertex).map(|h| topology::destination(&self.triangles, h))
    }

    /// Where a surface point lies, in metres.
    #[must_use]
    #[inline]
    pub fn position(&self, at: SurfacePoint) -> DVec3 {
        let [a, b, c] = self.corners(at.face);
        a * at.barycentric.x + b * at.barycentric.y + c * at.barycentric.z
    }

    /// Corner normals of a face.
    #[inline]
    pub(crate) fn corner_normals(&self, face: u32) -> [DVec3; 3] {
        self.triangles[face as usize].map(|v| self.vertex_normals[v as usize])
    }

    /// The surface normal at a surface point: vertex normals interpolated over the face, made a unit vector.
    /// Continuous over edges and vertices.
    #[must_use]
    #[inline]
    pub fn normal(&self, at: SurfacePoint) -> DVec3 {
        let [a, b, c] = self.corner_normals(at.face);
        let interpolated = a * at.barycentric.x + b * at.barycentric.y + c * at.barycentric.z;
        measures::unit(interpolated).unwrap_or_else(|| self.face_normal(at.face))
    }

    /// Unit normal of a face's plane.
    #[must_use]
    #[inline]
    pub fn face_normal(&self, face: u32) -> DVec3 {
        measures::face_normal(self.corners(face))
    }

    /// Bytes of memory the surface occupies.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        size_of_val(self.vertices.as_slice())
            + size_of_val(self.triangles.as_slice())
            + size_of_val(self.twins.as_slice())
            + size_of_val(self.vertex_half_edges.as_slice())
            + size_of_val(self.vertex_normals.as_slice())
            + size_of_val(self.vertex_areas.as_slice())
    }
}

/// Checks each vertex and each triangle by itself.
fn check_entries(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    if vertices.is_empty() || triangles.is_empty() {
        return Err(MeshError::Empty { vertices: vertices.len(), triangles: triangles.len() });
    }
    if triangles.len() > TRIANGLE_LIMIT {
        return Err(MeshError::TooManyTriangles { triangles: triangles.len() });
    }
    if let Some(vertex) = vertices.iter().position(|p| !measures::is_usable(*p)) {
        return Err(MeshError::Coordinate { vertex, position: vertices[vertex] });
    }
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&index) = corners.iter().find(|&&v| v as usize >= vertices.len()) {
            return Err(MeshError::IndexOutOfRange { triangle, index, vertices: vertices.len() });
        }
        let [a, b, c] = *corners;
        if a == b || b == c || c == a {
            return Err(MeshError::RepeatedCorner { triangle, corners: *corners });
        }
        let (longest_edge_m, height_m) =
            measures::longest_edge_and_height(corners.map(|v| vertices[v as usize]));
        if measures::is_degenerate(longest_edge_m, height_m) {
            return Err(MeshError::Degenerate { triangle, corners: *corners, longest_edge_m, height_m });
        }
    }
    Ok(())
}

/// Checks that two triangles meet in opposite senses at every edge.
fn check_edges(topology: &Topology) -> Result<(), MeshError> {
    if let Some(fault) = topology.open.first {
        let count = topology.open.count;
        return Err(MeshError::OpenEdge { edge: fault.edge, triangle: fault.triangles[0], count });
    }
    if let Some(fault) = topology.crowded.first {
        return Err(MeshError::NonManifoldEdge {
            edge: fault.edge,
            triangle: fault.triangles[0],
            triangles: fault.uses,
            count: topology.crowded.count,
        });
    }
    if let Some(fault) = topology.misoriented.first {
        let count = topology.misoriented.count;
        return Err(MeshError::InconsistentOrientation {
            edge: fault.edge,
            triangles: fault.triangles,
            count,
        });
    }
    Ok(())
}

/// Checks that every vertex has exactly one fan of triangles; returns one half-edge that leaves each vertex.
fn check_vertices(half_edges: &HalfEdges<'_>, twins: &[u32], vertices: usize) -> Result<Vec<u32>, MeshError> {
    let mut visited = vec![false; twins.len()];
    let mut leaving = vec![NONE; vertices];
    let mut pinched = topology::Fault::default();
    let mut unreferenced = topology::Fault::default();
    for (vertex, first) in leaving.iter_mut().enumerate() {
        let fan = half_edges.leaving(vertex);
        match topology::fans(fan, twins, &mut visited) {
            0 => unreferenced.note(|| vertex),
            1 => *first = fan[0],
            fans => pinched.note(|| (vertex, fans)),
        }
    }
    if let Some((vertex, fans)) = pinched.first {
        return Err(MeshError::NonManifoldVertex { vertex, fans, count: pinched.count });
    }
    if let Some(vertex) = unreferenced.first {
        return Err(MeshError::Unreferenced { vertex, count: unreferenced.count });
    }
    Ok(leaving)
}
