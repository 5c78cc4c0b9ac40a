//! The body's surface as last heard: the rest mesh and the newest displacement, checked at the door.

use glam::DVec3;
use thiserror::Error;

use crate::drawing::is_drawable;

/// A rest surface and how far it is from rest now.
#[derive(Debug)]
pub(crate) struct BodySurface {
    rest_m: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    topology_version: u32,
    /// For each vertex.
    displacement_m: Vec<DVec3>,
    /// The newest message, for telling a changed surface from a repeated one.
    moved: Vec<u32>,
    moved_by_m: Vec<f32>,
}

/// Why a mesh is not drawn.
#[derive(Debug, Error, PartialEq)]
pub(crate) enum MeshError {
    #[error("a mesh of {vertices} vertices and {triangles} triangles is no surface")]
    Empty { vertices: usize, triangles: usize },
    #[error("vertex {vertex} is {position}; finite numbers, and not beyond 1000 km, are accepted")]
    NotFinite { vertex: usize, position: DVec3 },
    #[error("triangle {triangle} names vertex {vertex}; the mesh has {vertices}")]
    NoSuchVertex { triangle: usize, vertex: u32, vertices: usize },
}

/// Why a displacement is not drawn. The surface stays as it was.
#[derive(Debug, Error, PartialEq)]
pub(crate) enum DisplacementError {
    #[error("it belongs to mesh {found:08x}; the mesh here is {expected:08x}")]
    OtherMesh { found: u32, expected: u32 },
    #[error("{numbers} numbers for {vertices} vertices; three for each are accepted")]
    Lengths { vertices: usize, numbers: usize },
    #[error("vertex {vertex} is listed; the mesh has {vertices}")]
    NoSuchVertex { vertex: u32, vertices: usize },
    #[error("vertex {vertex} moves by {displacement}; finite numbers are accepted")]
    NotFinite { vertex: u32, displacement: DVec3 },
}

impl BodySurface {
    /// A surface at rest. Positions in metres, body frame; `topology_version` is the CRC-32 of the mesh message.
    pub(crate) fn new(
        rest_m: Vec<DVec3>,
        triangles: Vec<[u32; 3]>,
        topology_version: u32,
    ) -> Result<BodySurface, MeshError> {
        let vertices = rest_m.len();
        if vertices == 0 || triangles.is_empty() {
            return Err(MeshError::Empty { vertices, triangles: triangles.len() });
        }
        if let Some((vertex, position)) =
            rest_m.iter().enumerate().find(|(_, position)| !is_drawable(**position))
        {
            return Err(MeshError::NotFinite { vertex, position: *position });
        }
        for (triangle, corners) in triangles.iter().enumerate() {
            if let Some(vertex) = corners.iter().find(|corner| **corner as usize >= vertices) {
                return Err(MeshError::NoSuchVertex { triangle, vertex: *vertex, vertices });
            }
        }
        Ok(BodySurface {
            displacement_m: vec![DVec3::ZERO; vertices],
            rest_m,
            triangles,
            topology_version,
            moved: Vec::new(),
            moved_by_m: Vec::new(),
        })
    }

    /// Take over a displacement: x, y and z for each listed vertex; the others are at rest. True when it differs from
    /// the one before.
    pub(crate) fn displace(
        &mut self,
        topology_version: u32,
        vertex: Vec<u32>,
        displacement_m: Vec<f32>,
    ) -> Result<bool, DisplacementError> {
        if topology_version != self.topology_version {
            return Err(DisplacementError::OtherMesh {
                found: topology_version,
                expected: self.topology_version,
            });
        }
        if displacement_m.len() != 3 * vertex.len() {
            return Err(DisplacementError::Lengths { vertices: vertex.len(), numbers: displacement_m.len() });
        }
        for (vertex, displacement) in each(&vertex, &displacement_m) {
            if vertex as usize >= self.rest_m.len() {
                return Err(DisplacementError::NoSuchVertex { vertex, vertices: self.rest_m.len() });
            }
            if !displacement.is_finite() {
                return Err(DisplacementError::NotFinite { vertex, displacement });
            }
        }
        if vertex == self.moved && displacement_m == self.moved_by_m {
            return Ok(false);
        }
        for vertex in &self.moved {
            self.displacement_m[*vertex as usize] = DVec3::ZERO;
        }
        for (vertex, displacement) in each(&vertex, &displacement_m) {
            self.displacement_m[vertex as usize] = displacement;
        }
        (self.moved, self.moved_by_m) = (vertex, displacement_m);
        Ok(true)
    }

    /// Corners of the triangles, in order; each indexes what [`BodySurface::vertices`] gives.
    pub(crate) fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// For each vertex its position with the displacement drawn `scale` times as large, and the true size of its
    /// displacement, both in metres.
    pub(crate) fn vertices(&self, scale: f64) -> impl Iterator<Item = (DVec3, f64)> {
        self.rest_m
            .iter()
            .zip(&self.displacement_m)
            .map(move |(rest, displacement)| (*rest + *displacement * scale, displacement.length()))
    }

    /// Positions at rest, m.
    #[cfg(feature = "viewer")]
    pub(crate) fn rest_m(&self) -> &[DVec3] {
        &self.rest_m
    }

    /// CRC-32 of the mesh message.
    #[cfg(feature = "viewer")]
    pub(crate) fn topology_version(&self) -> u32 {
        self.topology_version
    }

    /// The vertices that are not at rest, and x, y and z of the displacement of each, m.
    #[cfg(feature = "viewer")]
    pub(crate) fn displaced(&self) -> (&[u32], &[f32]) {
        (&self.moved, &self.moved_by_m)
    }

    /// Number of vertices that are not at rest.
    pub(crate) fn moved(&self) -> usize {
        self.moved.len()
    }
}

fn each(vertex: &[u32], displacement_m: &[f32]) -> impl Iterator<Item = (u32, DVec3)> {
    vertex
        .iter()
        .zip(displacement_m.chunks_exact(3))
        .map(|(vertex, xyz)| (*vertex, DVec3::new(f64::from(xyz[0]), f64::from(xyz[1]), f64::from(xyz[2]))))
}

#[cfg(test)]
mod tests {
    use super::*;

    const VERSION: u32 = 7;

    fn tetrahedron() -> BodySurface {
        let vertices = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        BodySurface::new(vertices, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], VERSION).unwrap()
    }

    fn positions(surface: &BodySurface, scale: f64) -> Vec<DVec3> {
        surface.vertices(scale).map(|(position, _)| position).collect()
    }

    #[test]
    fn a_vertex_that_is_no_longer_listed_is_back_at_rest() {
        let mut surface = tetrahedron();
        assert_eq!(surface.displace(VERSION, vec![1, 2], vec![0.5, 0.0, 0.0, 0.0, -0.5, 0.0]), Ok(true));
        assert_eq!(positions(&surface, 1.0)[1], DVec3::new(1.5, 0.0, 0.0));
        assert_eq!(surface.displace(VERSION, vec![2], vec![0.0, -0.5, 0.0]), Ok(true));
        assert_eq!(positions(&surface, 1.0), [DVec3::ZERO, DVec3::X, DVec3::new(0.0, 0.5, 0.0), DVec3::Z]);
        assert_eq!(surface.moved(), 1);
    }

    #[test]
    fn a_repeated_displacement_changes_nothing() {
        let mut surface = tetrahedron();
        assert_eq!(surface.displace(VERSION, Vec::new(), Vec::new()), Ok(false));
        assert_eq!(surface.displace(VERSION, vec![3], vec![0.0, 0.0, 0.1]), Ok(true));
        assert_eq!(surface.displace(VERSION, vec![3], vec![0.0, 0.0, 0.1]), Ok(false));
    }

    #[test]
    fn the_scale_enlarges_what_is_drawn_and_not_the_size_that_is_coloured() {
        let mut surface = tetrahedron();
        surface.displace(VERSION, vec![3], vec![0.0, 0.0, 0.25]).unwrap();
        assert_eq!(surface.vertices(4.0).last(), Some((DVec3::new(0.0, 0.0, 2.0), 0.25)));
    }

    #[test]
    fn a_displacement_that_cannot_be_drawn_leaves_the_surface_as_it_was() {
        let mut surface = tetrahedron();
        surface.displace(VERSION, vec![3], vec![0.0, 0.0, 0.1]).unwrap();
        let before = positions(&surface, 1.0);
        let refused = [
            surface.displace(VERSION + 1, vec![3], vec![0.0; 3]),
            surface.displace(VERSION, vec![3], vec![0.0; 2]),
            surface.displace(VERSION, vec![0, 4], vec![0.0; 6]),
            surface.displace(VERSION, vec![0, 1], vec![1.0, 1.0, 1.0, 0.0, f32::NAN, 0.0]),
            surface.displace(VERSION, vec![0], vec![f32::INFINITY, 0.0, 0.0]),
        ];
        assert!(refused.iter().all(Result::is_err), "{refused:?}");
        assert_eq!(positions(&surface, 1.0), before);
    }

    #[test]
    fn a_mesh_that_cannot_be_drawn_is_refused() {
        let corners = vec![[0, 1, 2]];
        let missing = BodySurface::new(vec![DVec3::ZERO; 2], corners.clone(), 0).unwrap_err();
        assert_eq!(missing, MeshError::NoSuchVertex { triangle: 0, vertex: 2, vertices: 2 });
        let nan = BodySurface::new(vec![DVec3::ZERO, DVec3::NAN, DVec3::Y], corners, 0).unwrap_err();
        assert!(matches!(nan, MeshError::NotFinite { vertex: 1, .. }));
        assert!(matches!(BodySurface::new(Vec::new(), Vec::new(), 0), Err(MeshError::Empty { .. })));
    }
}
