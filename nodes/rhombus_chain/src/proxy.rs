//! Where the probe touches: the contact's point on the rest surface, its normal and the probe's distance
//! along it.
//!
//! Two steps (MODEL section 5). A *walk* over the surface from the last contact goes to the local minimum of
//! distance: it stays on its side of a thin lobe. Closest points of a faceted surface jump, though: from
//! inside at every convex edge, from outside at every concave one. So the walk's end is only where the
//! *projection along interpolated normals* starts. It looks for the face, the weights b and the height t with
//!
//! ```text
//! probe = sum_i b_i (p_i + t n_i),      p_i, n_i: corners of the face and their vertex normals
//! ```
//!
//! Neighbouring faces share p_i, n_i of their edge, so the solution crosses edges and vertices without a
//! jump. Deeper than the surface's radius of curvature normals cross and there may be no solution; then the
//! walk's end counts.

use glam::DVec3;

use crate::closest::closest_on_triangle;
use crate::mesh::{SurfaceMesh, SurfacePoint, length, unit};

/// Steps one walk may take. A probe that moves 1 mm between two poses passes a few triangles; a leap that needs
/// more is no sliding, and the contact is lost.
const WALK_LIMIT: usize = 512;

/// Faces around one vertex a walk looks at. Only the tip of a very fine cone has more.
const FAN_LIMIT: usize = 4096;

/// Faces one projection may pass through.
const PROJECTION_LIMIT: usize = 32;

/// Weights below zero by less than this are on the edge.
const EDGE_TOLERANCE: f64 = 1e-12;

/// The point of the rest surface a probe is in contact with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Proxy {
    pub(crate) at: SurfacePoint,
    /// Unit outward normal, continuous while the probe slides.
    pub(crate) normal: DVec3,
    /// Distance of the probe's centre from the surface, negative inside.
    pub(crate) distance_m: f64,
    /// Found along interpolated normals; otherwise it is the walk's end.
    pub(crate) is_projection: bool,
}

/// The proxy of a probe at `probe` that was last at `from`; `None` when the probe has leapt too far to be
/// followed. Real-time safe: bounded work for any position.
pub(crate) fn follow(mesh: &SurfaceMesh, from: SurfacePoint, probe: DVec3) -> Option<Proxy> {
    let near = walk(mesh, from, probe)?;
    let projected = project(mesh, near.face, probe);
    Some(projected.unwrap_or_else(|| {
        let normal = mesh.normal(near);
        let offset = probe - mesh.position(near);
        let distance = length(offset);
        let distance_m = if offset.dot(normal) < 0.0 { -distance } else { distance };
        Proxy { at: near, normal, distance_m, is_projection: false }
    }))
}

/// Goes downhill in distance from face to face, over edges and around vertices, until no neighbour is closer;
/// `None` when that is farther than the limit.
fn walk(mesh: &SurfaceMesh, from: SurfacePoint, probe: DVec3) -> Option<SurfacePoint> {
    let mut face = from.face;
    let (mut barycentric, mut squared) = closest_on_triangle(mesh.corners(face), probe);
    for _ in 0..WALK_LIMIT {
        let mut best = None;
        let mut try_face = |candidate: u32| {
            let (weights, distance) = closest_on_triangle(mesh.corners(candidate), probe);
            if distance < squared {
                squared = distance;
                best = Some((candidate, weights));
            }
        };
        let inside = barycentric.cmpgt(DVec3::ZERO);
        match (inside.x, inside.y, inside.z) {
            // On the edge opposite to the corner without weight.
            (true, true, false) => try_face(mesh.twin(3 * face) / 3),
            (false, true, true) => try_face(mesh.twin(3 * face + 1) / 3),
            (true, false, true) => try_face(mesh.twin(3 * face + 2) / 3),
            (true, true, true) | (false, false, false) => {}
            (x, y, _) => {
                let corner = if x { 0 } else { 2 - u32::from(y) };
                let vertex = mesh.origin(3 * face + corner);
                mesh.fan(vertex).take(FAN_LIMIT).for_each(|half_edge| try_face(half_edge / 3));
            }
        }
        match best {
            Some(closer) => (face, barycentric) = closer,
            None => return Some(SurfacePoint { face, barycentric }),
        }
    }
    None
}

/// Projection along interpolated normals, starting from `face`. `None` where it does not arrive.
fn project(mesh: &SurfaceMesh, mut face: u32, probe: DVec3) -> Option<Proxy> {
    for _ in 0..PROJECTION_LIMIT {
        let corners = mesh.corners(face);
        let normals = mesh.corner_normals(face);
        let weights = weights_at_height(corners, normals, probe)?;
        let smallest = weights.min_element();
        if smallest >= -EDGE_TOLERANCE {
            let barycentric = weights.max(DVec3::ZERO);
            let barycentric = barycentric / (barycentric.x + barycentric.y + barycentric.z);
            return proxy(mesh, SurfacePoint { face, barycentric }, probe);
        }
        // Leave over the edge opposite to the most negative corner.
        let edge = if weights.x == smallest {
            1
        } else if weights.y == smallest {
            2
        } else {
            0
        };
        face = mesh.twin(3 * face + edge) / 3;
    }
    None
}

fn proxy(mesh: &SurfaceMesh, at: SurfacePoint, probe: DVec3) -> Option<Proxy> {
    let [a, b, c] = mesh.corner_normals(at.face);
    let normal = unit(a * at.barycentric.x + b * at.barycentric.y + c * at.barycentric.z)?;
    let distance_m = (probe - mesh.position(at)).dot(normal);
    Some(Proxy { at, normal, distance_m, is_projection: true })
}

/// Weights of the corners at which `probe` lies on the triangle moved along its corner normals by some height
/// t.
///
/// Newton's method for the height at which the moved triangle's plane passes through the probe. The plane's
/// point next to the probe, with the weights b, moves with `sum b_i n_i`; so the distance changes with t by
/// that velocity along the plane's normal. `None` where the triangle turns over on the way: normals have
/// crossed.
fn weights_at_height(corners: [DVec3; 3], normals: [DVec3; 3], probe: DVec3) -> Option<DVec3> {
    let from_probe = corners.map(|p| p - probe);
    let rest_area = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    let mut t = 0.0;
    for _ in 0..NEWTON_LIMIT {
        let p: [DVec3; 3] = std::array::from_fn(|k| from_probe[k] + normals[k] * t);
        let area = (p[1] - p[0]).cross(p[2] - p[0]);
        let square = area.length_squared();
        if area.dot(rest_area) <= 0.0 || square == 0.0 {
            return None;
        }
        let part = |u: DVec3, v: DVec3| u.cross(v).dot(area) / square;
        let weights = DVec3::new(part(p[1], p[2]), part(p[2], p[0]), part(p[0], p[1]));
        // Both times the length of `area`.
        let distance = -p[0].dot(area);
        let velocity = (normals[0] * weights.x + normals[1] * weights.y + normals[2] * weights.z).dot(area);
        if velocity <= 0.0 {
            return None;
        }
        let step = distance / velocity;
        // As far as the digits of the positions go.
        if step.abs() <= 1e-14 * (from_probe[0].abs().max_element() + t.abs()) {
            return weights.is_finite().then_some(weights);
        }
        t += step;
    }
    None
}

/// Newton's method doubles its digits with every step once it has some; it needs three or four steps on a
/// surface that is not folded.
const NEWTON_LIMIT: usize = 20;
