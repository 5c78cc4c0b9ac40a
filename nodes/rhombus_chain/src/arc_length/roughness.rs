//! Whether a mesh is smooth enough for labelling.

use crate::mesh::{SurfaceMesh, destination, length};

/// Curvature around a vertex up to which labelling is used, in radians: 75 degrees. A cube's corner has 90.
///
/// Labelling takes the labels at an edge's two ends for one wave. Behind a sharp corner they belong to two
/// waves that came round it from either side, and the label is too short by an amount that grows with the
/// corner's curvature. Measured against exact shortest ways: at most 4.9 % on livers, ellipsoids and tori
/// below this bound (32 to 53 degrees), up to 13 % on cubes, bars and cylinders above it.
const SMOOTH_UP_TO: f64 = 75.0 * std::f64::consts::PI / 180.0;

/// Whether nowhere on the surface the curvature of a vertex and of its neighbours adds up to more than the
/// bound.
pub(super) fn is_smooth(mesh: &SurfaceMesh) -> bool {
    let curvatures = curvatures(mesh);
    (0u32..).zip(&curvatures).all(|(vertex, own)| {
        own + mesh.neighbours(vertex).map(|v| curvatures[v as usize]).sum::<f64>() <= SMOOTH_UP_TO
    })
}

/// For each vertex, how far the angles around it are from a full turn, in radians.
fn curvatures(mesh: &SurfaceMesh) -> Vec<f64> {
    let turn = 2.0 * std::f64::consts::PI;
    (0..mesh.vertices().len() as u32).map(|vertex| (turn - total_angle(mesh, vertex)).abs()).collect()
}

/// Sum of the angles of the faces around a vertex, in radians.
pub(super) fn total_angle(mesh: &SurfaceMesh, vertex: u32) -> f64 {
    mesh.fan(vertex).map(|half_edge| corner_angle(mesh, half_edge)).sum()
}

/// Angle of a face at the vertex a half-edge starts from, in radians.
pub(super) fn corner_angle(mesh: &SurfaceMesh, half_edge: u32) -> f64 {
    let vertices = mesh.vertices();
    let position = |v: u32| vertices[v as usize];
    let origin = position(mesh.origin(half_edge));
    let next = position(destination(mesh.triangles(), half_edge)) - origin;
    let last = position(mesh.origin(crate::mesh::previous(half_edge))) - origin;
    libm::atan2(length(next.cross(last)), next.dot(last))
}
