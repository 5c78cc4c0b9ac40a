//! What the probe does in every benchmark: it stays pressed 5 mm deep (or less) and slides along the surface.

use glam::DVec3;
use rhombus_chain::SurfaceMesh;

/// Depth of the press that the figures are quoted for, m.
pub const PRESS_M: f64 = 0.005;

/// A smooth walk along the rest surface of `mesh`: `count` pairs (point, outward normal), about `step_m` apart.
///
/// Starts at the vertex that lies highest along z and goes where a fixed direction leads along the surface, so that the
/// contact crosses edges and vertices as a sliding hand does. Deterministic.
pub fn walk_on_surface(mesh: &SurfaceMesh, count: usize, step_m: f64) -> Vec<(DVec3, DVec3)> {
    let index = rhombus_chain::SurfaceIndex::new(mesh);
    let mut point =
        mesh.vertices().iter().copied().fold(DVec3::NEG_INFINITY, |top, v| if v.z > top.z { v } else { top });
    let mut heading = DVec3::new(1.0, 0.37, 0.0);
    let mut walk = Vec::with_capacity(count);
    while walk.len() < count {
        let Some((at, _)) = index.closest(mesh, point, f64::INFINITY) else { break };
        let on_surface = mesh.position(at);
        let normal = mesh.normal(at);
        walk.push((on_surface, normal));
        heading = (heading - normal * heading.dot(normal)).normalize_or(normal.any_orthonormal_vector());
        point = on_surface + heading * step_m;
    }
    walk
}

/// Probe centres that press `depth_m` below the points of a walk with a probe of radius `radius_m`.
pub fn pressed(walk: &[(DVec3, DVec3)], radius_m: f64, depth_m: impl Fn(usize) -> f64) -> Vec<DVec3> {
    walk.iter().enumerate().map(|(i, (point, normal))| *point + *normal * (radius_m - depth_m(i))).collect()
}
