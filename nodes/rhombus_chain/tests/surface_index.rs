//! The closest point of a surface and what is inside it, against looking at every triangle.
#![allow(clippy::expect_used, reason = "a helper that cannot go on stops its test")]

mod common;

use common::{Random, block, body, bumpy, icosphere};
use glam::DVec3;
use proptest::prelude::*;
use rhombus_chain::{Body, SurfaceMesh};

/// Distance to a triangle by trying all its features: plane, edges, corners.
fn distance([a, b, c]: [DVec3; 3], p: DVec3) -> f64 {
    let to_segment = |u: DVec3, v: DVec3| {
        let t = ((p - u).dot(v - u) / (v - u).length_squared()).clamp(0.0, 1.0);
        p.distance(u + (v - u) * t)
    };
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let foot = p - normal * (p - a).dot(normal);
    let is_over = [(a, b), (b, c), (c, a)].iter().all(|&(u, v)| (v - u).cross(foot - u).dot(normal) >= 0.0);
    let edges = to_segment(a, b).min(to_segment(b, c)).min(to_segment(c, a));
    if is_over { edges.min((p - foot).length()) } else { edges }
}

fn distance_to_all(mesh: &SurfaceMesh, p: DVec3) -> f64 {
    (0..mesh.triangles().len() as u32).map(|t| distance(mesh.corners(t), p)).fold(f64::INFINITY, f64::min)
}

/// How often the surface winds around a point: the sum of the solid angles of all triangles.
fn winding(mesh: &SurfaceMesh, p: DVec3) -> f64 {
    let solid = |t: u32| {
        let [a, b, c] = mesh.corners(t).map(|v| v - p);
        let (x, y, z) = (a.length(), b.length(), c.length());
        2.0 * libm::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y)
    };
    (0..mesh.triangles().len() as u32).map(solid).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

fn bodies() -> Vec<Body> {
    vec![body(block(DVec3::new(0.1, 0.08, 0.06), 3)), body(icosphere(0.05, 2)), body(bumpy(3))]
}

#[test]
fn no_triangle_is_closer_than_the_closest_point() {
    let mut random = Random(1);
    for body in bodies() {
        let (mesh, [low, high]) = (body.mesh(), body.mesh().extents());
        for _ in 0..300 {
            let size = high - low;
            let p = low - 0.3 * size + 1.6 * size * DVec3::new(random.unit(), random.unit(), random.unit());
            let (at, found) = body.index().closest(mesh, p, f64::INFINITY).expect("some point is closest");
            assert!((found - distance_to_all(mesh, p)).abs() < 1e-14, "{p}");
            assert!((mesh.position(at).distance(p) - found).abs() < 1e-15);
            assert!(
                at.barycentric.min_element() >= 0.0 && (at.barycentric.element_sum() - 1.0).abs() < 1e-15
            );

            assert_eq!(
                body.index().closest(mesh, p, 1.001 * found).map(|(at, _)| at),
                Some(at),
                "within reach"
            );
            assert_eq!(body.index().closest(mesh, p, 0.999 * found), None, "out of reach");
            assert!(!body.index().is_farther_than(p, found));
        }
    }
}

#[test]
fn a_vertex_an_edge_and_a_face_are_at_distance_zero_from_themselves() {
    for body in bodies() {
        let mesh = body.mesh();
        for (&p, &[a, b, c]) in mesh.vertices().iter().zip(mesh.triangles()) {
            let [a, b, c] = [a, b, c].map(|v| mesh.vertices()[v as usize]);
            for p in [p, (a + b) / 2.0, (a + b + c) / 3.0] {
                let (_, distance) = body.index().closest(mesh, p, 0.01).expect("on the surface");
                assert!(distance < 1e-16);
            }
        }
    }
}

#[test]
fn enclosed_is_where_the_surface_winds_around() {
    let mut random = Random(2);
    for body in bodies() {
        let (mesh, [low, high]) = (body.mesh(), body.mesh().extents());
        let mut inside = 0;
        for _ in 0..500 {
            let size = high - low;
            let p = low - 0.1 * size + 1.2 * size * DVec3::new(random.unit(), random.unit(), random.unit());
            let expected = winding(mesh, p) > 0.5;
            assert_eq!(body.index().encloses(mesh, p), expected, "{p}");
            inside += usize::from(expected);
        }
        assert!(inside > 100, "the test looks inside, too");
    }
}

#[test]
fn a_ray_through_edges_and_vertices_is_counted_once() {
    // The test ray runs along x: here exactly through the vertices and edges of a block's grid.
    let body = body(block(DVec3::splat(0.1), 4));
    for j in 0..=4 {
        for k in 0..=4 {
            let [y, z] = [j, k].map(|i| 0.1 * (f64::from(i) / 4.0 - 0.5));
            let is_inside = (1..4).contains(&j) && (1..4).contains(&k);
            if is_inside {
                assert!(body.index().encloses(body.mesh(), DVec3::new(0.0, y, z)));
            }
            assert!(!body.index().encloses(body.mesh(), DVec3::new(-0.06, y, z)));
            assert!(!body.index().encloses(body.mesh(), DVec3::new(0.06, y, z)));
        }
    }
}

proptest! {
    #[test]
    fn no_point_is_too_strange(x in any::<f64>(), y in any::<f64>(), z in any::<f64>()) {
        let body = body(icosphere(0.05, 1));
        let p = DVec3::new(x, y, z);
        let _ = body.index().closest(body.mesh(), p, 0.01);
        let _ = body.index().closest(body.mesh(), p, f64::INFINITY);
        prop_assert!(!body.index().encloses(body.mesh(), p) || p.length() < 0.05);
    }
}
