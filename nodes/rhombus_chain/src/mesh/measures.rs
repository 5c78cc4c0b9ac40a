//! Lengths, areas, normals and volumes of a triangle list.

use glam::DVec3;

use super::topology::{HalfEdges, NONE};
use super::{COORDINATE_LIMIT_M, DEGENERATE_HEIGHT, MeshError};

/// Volume of a body below this fraction of (surface area x extent) is rounding: the surface is a folded
/// sheet.
const FLAT_VOLUME: f64 = 1e-12;

/// Whether a position can be computed with.
pub(crate) fn is_usable(position: DVec3) -> bool {
    // False for NaN as well.
    position.abs().max_element() <= COORDINATE_LIMIT_M && position.is_finite()
}

/// Length by the hardware's square root, which is exact in every environment.
#[inline]
pub(crate) fn length(v: DVec3) -> f64 {
    v.length_squared().sqrt()
}

/// Unit vector, or `None` where the length is zero or not finite.
#[inline]
pub(crate) fn unit(v: DVec3) -> Option<DVec3> {
    let length = length(v);
    (length > 0.0 && length.is_finite()).then(|| v / length)
}

/// Unit normal of a triangle that is not degenerate.
#[inline]
pub(crate) fn face_normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    // Scaled by its longest edge first: the square of a tiny area would underflow.
    let (ab, ac) = (b - a, c - a);
    let scale = ab.abs().max_element().max(ac.abs().max_element());
    unit((ab / scale).cross(ac / scale)).unwrap_or(DVec3::Z)
}

/// Longest edge of a triangle and its height over that edge, both in metres.
pub(crate) fn longest_edge_and_height([a, b, c]: [DVec3; 3]) -> (f64, f64) {
    let edges = [b - a, c - b, a - c];
    let longest = edges.map(length).into_iter().fold(0.0, f64::max);
    if longest == 0.0 {
        return (0.0, 0.0);
    }
    (longest, length((edges[0] / longest).cross(edges[2] / longest)) * longest)
}

/// Whether a triangle has no area to speak of.
pub(crate) fn is_degenerate(longest_edge_m: f64, height_m: f64) -> bool {
    height_m <= DEGENERATE_HEIGHT * longest_edge_m
}

/// Smallest and largest coordinates.
pub(crate) fn extents(vertices: &[DVec3]) -> [DVec3; 2] {
    vertices.iter().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], &p| [low.min(p), high.max(p)])
}

/// A point of the surface, from which volumes are summed: a far origin would cost digits.
fn reference(vertices: &[DVec3], triangles: &[[u32; 3]]) -> DVec3 {
    triangles.first().map_or(DVec3::ZERO, |corners| vertices[corners[0] as usize])
}

/// Signed volume (m³, positive when normals point outward) and surface area (m²).
pub(crate) fn volume_and_area(vertices: &[DVec3], triangles: &[[u32; 3]]) -> (f64, f64) {
    let origin = reference(vertices, triangles);
    triangles.iter().fold((0.0, 0.0), |(volume, area), corners| {
        let [a, b, c] = corners.map(|v| vertices[v as usize] - origin);
        (volume + a.dot(b.cross(c)) / 6.0, area + 0.5 * length((b - a).cross(c - a)))
    })
}

/// Volume at or below which a surface of this area encloses nothing.
pub(crate) fn flat_volume(vertices: &[DVec3], area_m2: f64) -> f64 {
    let [low, high] = extents(vertices);
    FLAT_VOLUME * area_m2 * (high - low).max_element()
}

/// A third of the area of the adjoining faces for each vertex.
pub(crate) fn vertex_areas(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Vec<f64> {
    let mut areas = vec![0.0; vertices.len()];
    for corners in triangles {
        let [a, b, c] = corners.map(|v| vertices[v as usize]);
        let third = length((b - a).cross(c - a)) / 6.0;
        for &v in corners {
            areas[v as usize] += third;
        }
    }
    areas
}

/// Normals of the adjoining faces weighted by the angle at the vertex: independent of how a flat region is
/// divided.
pub(crate) fn vertex_normals(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let mut normals = vec![DVec3::ZERO; vertices.len()];
    for corners in triangles {
        let positions = corners.map(|v| vertices[v as usize]);
        let normal = face_normal(positions);
        for k in 0..3 {
            let (here, next, last) = (positions[k], positions[(k + 1) % 3], positions[(k + 2) % 3]);
            normals[corners[k] as usize] += normal * angle(next - here, last - here);
        }
    }
    // The normals of a closed fan can cancel only on a spike without thickness; any face then serves.
    for (corners, t) in triangles.iter().zip(0usize..) {
        for &v in corners {
            if unit(normals[v as usize]).is_none() {
                normals[v as usize] = face_normal(triangles[t].map(|v| vertices[v as usize]));
            }
        }
    }
    normals.into_iter().map(|n| unit(n).unwrap_or(DVec3::Z)).collect()
}

/// Angle between two vectors in radians.
fn angle(u: DVec3, v: DVec3) -> f64 {
    libm::atan2(length(u.cross(v)), u.dot(v))
}

/// Checks that every closed part has its normals pointing out of the body.
///
/// A part with negative volume is right only as a cavity: inside the others, where their winding number is 1.
pub(crate) fn check_outward(
    vertices: &[DVec3],
    triangles: &[[u32; 3]],
    twins: &[u32],
) -> Result<(), MeshError> {
    let parts = parts(twins);
    let count = parts.iter().max().map_or(0, |&last| last as usize + 1);
    let mut volumes = vec![0.0; count];
    let mut sizes = vec![0usize; count];
    let mut firsts = vec![0usize; count];
    let origin = reference(vertices, triangles);
    for (t, corners) in triangles.iter().enumerate() {
        let part = parts[t] as usize;
        let [a, b, c] = corners.map(|v| vertices[v as usize] - origin);
        volumes[part] += a.dot(b.cross(c)) / 6.0;
        if sizes[part] == 0 {
            firsts[part] = t;
        }
        sizes[part] += 1;
    }
    for part in (0..count).filter(|&part| volumes[part] < 0.0) {
        let [a, b, c] = triangles[firsts[part]];
        let inside = [a, b, c].map(|v| vertices[v as usize]).into_iter().sum::<DVec3>() / 3.0;
        let others = triangles.iter().zip(&parts).filter(|&(_, &p)| p as usize != part);
        let winding: f64 = others
            .map(|(corners, _)| solid_angle(corners.map(|v| vertices[v as usize] - inside)))
            .sum::<f64>()
            / (4.0 * std::f64::consts::PI);
        if winding < 0.5 {
            let (triangle, triangles) = (firsts[part], sizes[part]);
            return Err(MeshError::Flipped { triangle, triangles, volume_m3: volumes[part] });
        }
    }
    Ok(())
}

/// Number of the connected part each triangle belongs to, counted from 0 in the order of first triangles.
pub(crate) fn parts(twins: &[u32]) -> Vec<u32> {
    let triangles = twins.len() / 3;
    let mut parts = vec![NONE; triangles];
    let mut stack = Vec::new();
    let mut count = 0;
    for first in 0..triangles {
        if parts[first] != NONE {
            continue;
        }
        parts[first] = count;
        stack.push(first);
        while let Some(t) = stack.pop() {
            for twin in &twins[3 * t..3 * t + 3] {
                let neighbour = (*twin / 3) as usize;
                if *twin != NONE && parts[neighbour] == NONE {
                    parts[neighbour] = count;
                    stack.push(neighbour);
                }
            }
        }
        count += 1;
    }
    parts
}

/// Signed solid angle of a triangle seen from the origin, positive when it is seen from behind
/// (van Oosterom and Strackee 1983).
fn solid_angle([a, b, c]: [DVec3; 3]) -> f64 {
    let (la, lb, lc) = (length(a), length(b), length(c));
    let numerator = a.dot(b.cross(c));
    let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * libm::atan2(numerator, denominator)
}

/// Vertices that no triangle uses.
pub(crate) fn unreferenced(half_edges: &HalfEdges<'_>, vertices: usize) -> usize {
    (0..vertices).filter(|&v| half_edges.leaving(v).is_empty()).count()
}
