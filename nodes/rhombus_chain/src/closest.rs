//! Closest point of a triangle.

use glam::DVec3;

/// Barycentric coordinates of the point of triangle `corners` closest to `point`, and the squared distance.
///
/// Coordinates of corners that do not take part are exactly zero, so a caller can tell face, edge and corner
/// apart. Real-time safe. The regions are those of Ericson, *Real-Time Collision Detection* (2005), section
/// 5.1.5.
#[inline]
pub(crate) fn closest_on_triangle(corners: [DVec3; 3], point: DVec3) -> (DVec3, f64) {
    let barycentric = closest_barycentric(corners, point);
    let [a, b, c] = corners;
    // From corner a, so that a point on the triangle keeps all digits of its distance.
    let offset = (a - point) + (b - a) * barycentric.y + (c - a) * barycentric.z;
    (barycentric, offset.length_squared())
}

#[inline]
fn closest_barycentric([a, b, c]: [DVec3; 3], point: DVec3) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    let ap = point - a;
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return DVec3::X;
    }
    let bp = point - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return DVec3::Y;
    }
    let cp = point - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return DVec3::Z;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let t = d1 / (d1 - d3);
        return DVec3::new(1.0 - t, t, 0.0);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let t = d2 / (d2 - d6);
        return DVec3::new(1.0 - t, 0.0, t);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return DVec3::new(0.0, 1.0 - t, t);
    }
    let sum = va + vb + vc;
    let (v, w) = (vb / sum, vc / sum);
    DVec3::new(1.0 - v - w, v, w)
}
