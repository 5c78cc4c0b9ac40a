//! Where the probe touches: the contact's point on the rest surface, its normal and the probe's distance along it.
//!
//! Two steps (MODEL section 5). A *walk* over the surface from the last contact goes to the local minimum of distance: it
//! stays on its side of a thin lobe. Closest points of a faceted surface jump, though: from inside at every convex edge, from
//! outside at every concave one. So the walk's end is only where the *projection along interpolated normals* starts. It
//! looks for the face, the weights b and the height t with
//!
//! ```text
//! probe = sum_i b_i (p_i + t n_i),      p_i, n_i: corners of the face and their vertex normals
//! ```
//!
//! Neighbouring faces share p_i, n_i of their edge, so the solution crosses edges and vertices without a jump. Deeper
//! than the surface's radius of curvature normals cross and there may be no solution; then the walk's end counts.

use glam::DVec3;

use crate::closest::closest_on_triangle;
use crate::mesh::{SurfaceMesh, SurfacePoint, length, unit};

/// Triangles one walk may look at. A probe that moves 1 mm between two poses passes a few; the rest of an absurd leap
/// is walked with the next poses.
const WALK_LIMIT: usize = 512;

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
}

/// The proxy of a probe at `probe` that was last at `from`. Real-time safe: bounded work for any position.
pub(crate) fn follow(mesh: &SurfaceMesh, from: SurfacePoint, probe: DVec3) -> Proxy {
    let near = walk(mesh, from, probe);
    project(mesh, near.face, probe).unwrap_or_else(|| {
        let normal = mesh.normal(near);
        let offset = probe - mesh.position(near);
        let distance = length(offset);
        let distance_m = if offset.dot(normal) < 0.0 { -distance } else { distance };
        Proxy { at: near, normal, distance_m }
    })
}

/// Goes downhill in distance from face to face, over edges and around vertices, until no neighbour is closer.
fn walk(mesh: &SurfaceMesh, from: SurfacePoint, probe: DVec3) -> SurfacePoint {
    let mut face = from.face;
    let (mut barycentric, mut squared) = closest_on_triangle(mesh.corners(face), probe);
    let mut budget = WALK_LIMIT;
    loop {
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
                for half_edge in mesh.fan(vertex).take(budget) {
                    budget -= 1;
                    try_face(half_edge / 3);
                }
            }
        }
        match best {
            Some(closer) => (face, barycentric) = closer,
            None => break,
        }
        budget = budget.saturating_sub(1);
        if budget == 0 {
            break;
        }
    }
    SurfacePoint { face, barycentric }
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
    Some(Proxy { at, normal, distance_m: (probe - mesh.position(at)).dot(normal) })
}

/// Weights of the corners at which `probe` lies on the triangle moved along its corner normals by some height t.
///
/// With `P_i(t) = p_i + t n_i - probe` the three are coplanar where the cubic `P_0 . (P_1 x P_2)` vanishes. The solution that
/// belongs to the surface is the first one on the way from t = 0 towards the probe. `None` when there is none before the moved
/// triangle turns over.
fn weights_at_height(corners: [DVec3; 3], normals: [DVec3; 3], probe: DVec3) -> Option<DVec3> {
    let a = corners.map(|p| p - probe);
    let plane = (a[1] - a[0]).cross(a[2] - a[0]);
    let t = first_root(a, normals)?;
    let p = [a[0] + normals[0] * t, a[1] + normals[1] * t, a[2] + normals[2] * t];
    let areas = [p[1].cross(p[2]), p[2].cross(p[0]), p[0].cross(p[1])];
    let area = (p[1] - p[0]).cross(p[2] - p[0]);
    if area.dot(plane) <= 0.0 {
        return None;
    }
    let weights = DVec3::new(areas[0].dot(area), areas[1].dot(area), areas[2].dot(area));
    let sum = weights.x + weights.y + weights.z;
    let weights = weights / sum;
    weights.is_finite().then_some(weights)
}

/// The root of `det(a_0 + t n_0, a_1 + t n_1, a_2 + t n_2)` that is reached first from t = 0.
fn first_root(a: [DVec3; 3], n: [DVec3; 3]) -> Option<f64> {
    let det = |x: DVec3, y: DVec3, z: DVec3| x.dot(y.cross(z));
    let c0 = det(a[0], a[1], a[2]);
    let c1 = det(n[0], a[1], a[2]) + det(a[0], n[1], a[2]) + det(a[0], a[1], n[2]);
    let c2 = det(a[0], n[1], n[2]) + det(n[0], a[1], n[2]) + det(n[0], n[1], a[2]);
    let c3 = det(n[0], n[1], n[2]);
    let mut t = 0.0;
    let slope = c1;
    for _ in 0..NEWTON_LIMIT {
        let value = ((c3 * t + c2) * t + c1) * t + c0;
        let derivative = (3.0 * c3 * t + 2.0 * c2) * t + c1;
        // The triangle turns over where the derivative changes its sign.
        if derivative * slope <= 0.0 {
            return None;
        }
        let step = value / derivative;
        t -= step;
        if step.abs() <= 1e-14 * t.abs() {
            return t.is_finite().then_some(t);
        }
    }
    None
}

/// Newton doubles the digits with every step; from a start of no digits, more are never needed on a surface that does
/// not fold.
const NEWTON_LIMIT: usize = 24;
