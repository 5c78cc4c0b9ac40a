//! Between ROS messages and the model's types: the one boundary.
//!
//! r2r makes a fixed-size array a `Vec` and panics while publishing one of another length, so such arrays are only
//! built here.

use glam::{DQuat, DVec3};
use r2r::builtin_interfaces::msg::{Duration as DurationMessage, Time};
use r2r::geometry_msgs::msg::{Point, Pose as PoseMessage, Quaternion, Transform, Vector3};
use r2r::shape_msgs::msg::{Mesh, MeshTriangle};
use rhombus_chain::Pose;

const NS_PER_S: i64 = 1_000_000_000;

/// A stamp in nanoseconds.
pub fn stamp_ns(stamp: &Time) -> i64 {
    i64::from(stamp.sec) * NS_PER_S + i64::from(stamp.nanosec)
}

/// A stamp from nanoseconds; outside the range of the message (years 1901 to 2038) the nearest end of it.
pub fn stamp(ns: i64) -> Time {
    let (sec, nanosec) = split(ns);
    Time { sec, nanosec }
}

/// A duration from nanoseconds.
pub fn duration(ns: i64) -> DurationMessage {
    let (sec, nanosec) = split(ns);
    DurationMessage { sec, nanosec }
}

fn split(ns: i64) -> (i32, u32) {
    let limited = ns.clamp(i64::from(i32::MIN) * NS_PER_S, (i64::from(i32::MAX) + 1) * NS_PER_S - 1);
    // Both parts fit: the whole seconds were limited above, the remainder is below 1e9.
    (limited.div_euclid(NS_PER_S) as i32, limited.rem_euclid(NS_PER_S) as u32)
}

/// A position.
pub fn point(p: DVec3) -> Point {
    Point { x: p.x, y: p.y, z: p.z }
}

/// A direction, force or displacement.
pub fn vector(v: DVec3) -> Vector3 {
    Vector3 { x: v.x, y: v.y, z: v.z }
}

/// A position as the model's vector.
pub fn dvec3(p: &Point) -> DVec3 {
    DVec3::new(p.x, p.y, p.z)
}

/// A direction, force or displacement as the model's vector.
pub fn dvec3_of_vector(v: &Vector3) -> DVec3 {
    DVec3::new(v.x, v.y, v.z)
}

/// An orientation.
pub fn quaternion(q: DQuat) -> Quaternion {
    Quaternion { x: q.x, y: q.y, z: q.z, w: q.w }
}

/// A pose.
pub fn pose(pose: &Pose) -> PoseMessage {
    PoseMessage { position: point(pose.translation), orientation: quaternion(pose.rotation) }
}

/// A pose as a transform of tf.
pub fn transform(pose: &Pose) -> Transform {
    Transform { translation: vector(pose.translation), rotation: quaternion(pose.rotation) }
}

/// `[x, y, z, qx, qy, qz, qw]` of a pose message, unchecked: `Pose::from_array` judges it.
pub fn pose_array(pose: &PoseMessage) -> [f64; 7] {
    let (p, q) = (&pose.position, &pose.orientation);
    [p.x, p.y, p.z, q.x, q.y, q.z, q.w]
}

/// `[x, y, z, qx, qy, qz, qw]` of a transform, unchecked.
pub fn transform_array(transform: &Transform) -> [f64; 7] {
    let (t, q) = (&transform.translation, &transform.rotation);
    [t.x, t.y, t.z, q.x, q.y, q.z, q.w]
}

/// A fixed-size array of three numbers.
pub fn three(v: DVec3) -> Vec<f64> {
    v.to_array().to_vec()
}

/// A surface as a mesh message.
pub fn mesh(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Mesh {
    Mesh {
        vertices: vertices.iter().copied().map(point).collect(),
        triangles: triangles
            .iter()
            .map(|corners| MeshTriangle { vertex_indices: corners.to_vec() })
            .collect(),
    }
}

/// What ties a surface displacement to a mesh; see [`scene::topology_version`].
pub fn topology_version(mesh: &Mesh) -> u32 {
    scene::topology_version(
        mesh.vertices.iter().map(|vertex| [vertex.x, vertex.y, vertex.z]),
        mesh.triangles.iter().flat_map(|triangle| triangle.vertex_indices.iter().copied()),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stamps_survive_the_round_trip_and_never_wrap() {
        for ns in [0, 1, 999_999_999, 1_700_000_000_123_456_789, -1, -1_500_000_000] {
            assert_eq!(stamp_ns(&stamp(ns)), ns);
        }
        assert_eq!(stamp(i64::MAX).sec, i32::MAX);
        assert_eq!(stamp(i64::MIN).sec, i32::MIN);
    }

    #[test]
    fn fixed_size_arrays_have_their_size() {
        let mesh = mesh(&[DVec3::ZERO; 3], &[[0, 1, 2]]);
        assert_eq!(mesh.triangles[0].vertex_indices, [0, 1, 2]);
        assert_eq!(three(DVec3::new(1.0, 2.0, 3.0)), [1.0, 2.0, 3.0]);
    }
}
