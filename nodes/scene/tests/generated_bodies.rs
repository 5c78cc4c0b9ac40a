//! What every generated body promises: the number of vertices, a closed outward surface, well-shaped triangles.
#![expect(clippy::expect_used, reason = "a test may fail here")]

use std::collections::BTreeMap;

use glam::DVec3;
use rhombus_chain::SurfaceMesh;
use scene::BodyKind;
use scene::generate::{Shape, body};

fn surface(shape: &Shape) -> SurfaceMesh {
    SurfaceMesh::new(shape.vertices.clone(), shape.triangles.clone()).expect("closed, manifold, outward")
}

fn edge_lengths(shape: &Shape) -> BTreeMap<[u32; 2], f64> {
    shape
        .triangles
        .iter()
        .flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]])
        .map(|[a, b]| ([a.min(b), a.max(b)], shape.vertices[a as usize].distance(shape.vertices[b as usize])))
        .collect()
}

fn smallest_angle_deg(shape: &Shape) -> f64 {
    let angle = |tip: DVec3, a: DVec3, b: DVec3| (a - tip).angle_between(b - tip).to_degrees();
    shape
        .triangles
        .iter()
        .map(|t| t.map(|v| shape.vertices[v as usize]))
        .map(|[a, b, c]| angle(a, b, c).min(angle(b, c, a)).min(angle(c, a, b)))
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn the_default_liver_has_the_size_of_the_papers_experiment() {
    let shape = body(BodyKind::Liver, BodyKind::Liver.default_vertices());
    assert_eq!((shape.vertices.len(), shape.triangles.len()), (3116, 6228));
    let mesh = surface(&shape);
    let [low, high] = mesh.extents();
    let extents = high - low;
    assert!((0.195..0.205).contains(&extents.x), "{extents}");
    assert!((0.0008..0.0020).contains(&mesh.volume_m3()), "{} m3", mesh.volume_m3());
}

#[test]
fn round_bodies_have_exactly_the_vertices_asked_for_and_the_topology_of_a_sphere() {
    for kind in [BodyKind::Liver, BodyKind::Sphere] {
        for vertices in [100, 101, 127, 250, 999, 3116, 10_000] {
            let shape = body(kind, vertices);
            assert_eq!(shape.vertices.len(), vertices, "{kind:?}");
            assert_eq!(shape.triangles.len(), 2 * vertices - 4, "{kind:?}");
            let edges = edge_lengths(&shape).len();
            assert_eq!(vertices + shape.triangles.len() - edges, 2, "Euler characteristic");
            assert!(surface(&shape).volume_m3() > 0.0);
        }
    }
}

#[test]
fn triangles_are_well_shaped_and_edges_of_similar_length() {
    // Kind, vertices, then shortest and longest edge over the mean, and the smallest angle in degrees.
    let cases = [
        (BodyKind::Liver, 3116, 0.4, 1.7, 30.0),
        (BodyKind::Liver, 400, 0.3, 2.0, 18.0),
        (BodyKind::Sphere, 1002, 0.5, 1.4, 35.0),
    ];
    for (kind, vertices, shortest_over_mean, longest_over_mean, least_angle_deg) in cases {
        let shape = body(kind, vertices);
        let lengths: Vec<f64> = edge_lengths(&shape).into_values().collect();
        let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
        let longest = lengths.iter().copied().fold(0.0, f64::max) / mean;
        let shortest = lengths.iter().copied().fold(f64::INFINITY, f64::min) / mean;
        let angle = smallest_angle_deg(&shape);
        println!(
            "{kind:?} {vertices}: edges {mean:.5} m times {shortest:.2} to {longest:.2}, from {angle:.1} deg"
        );
        assert!(longest < longest_over_mean, "{kind:?} {vertices}: longest {longest}");
        assert!(shortest > shortest_over_mean, "{kind:?} {vertices}: shortest {shortest}");
        assert!(angle > least_angle_deg, "{kind:?} {vertices}: smallest angle {angle} degrees");
    }
}

#[test]
fn a_block_is_a_box_of_the_nearest_possible_number_of_vertices() {
    for vertices in [8, 9, 100, 1002, 5000] {
        let shape = body(BodyKind::Block, vertices);
        let mesh = surface(&shape);
        assert_eq!(shape.triangles.len(), 2 * shape.vertices.len() - 4);
        assert!((mesh.volume_m3() - 0.1 * 0.08 * 0.05).abs() < 1e-15, "{}", mesh.volume_m3());
        let off = shape.vertices.len().abs_diff(vertices) as f64;
        assert!(off <= 0.12 * vertices as f64, "{} for {vertices}", shape.vertices.len());
    }
    assert_eq!(body(BodyKind::Block, 8).vertices.len(), 8);
}

#[test]
fn the_same_request_gives_the_same_bits() {
    assert_eq!(body(BodyKind::Liver, 777), body(BodyKind::Liver, 777));
}

#[test]
fn a_number_of_vertices_that_cannot_show_the_shape_is_raised() {
    assert_eq!(body(BodyKind::Liver, 0).vertices.len(), BodyKind::Liver.fewest_vertices());
    assert_eq!(body(BodyKind::Sphere, 3).vertices.len(), BodyKind::Sphere.fewest_vertices());
}

#[test]
fn the_livers_surface_does_not_meet_itself() {
    for vertices in [100, 600] {
        let shape = body(BodyKind::Liver, vertices);
        let corners = |t: usize| shape.triangles[t].map(|v| shape.vertices[v as usize]);
        for t in 0..shape.triangles.len() {
            for u in t + 1..shape.triangles.len() {
                let shared = shape.triangles[t].iter().any(|v| shape.triangles[u].contains(v));
                if !shared {
                    assert!(!triangles_cross(corners(t), corners(u)), "triangles {t} and {u}");
                }
            }
        }
    }
}

/// Two triangles without a common corner cross exactly when an edge of one pierces the other.
fn triangles_cross(a: [DVec3; 3], b: [DVec3; 3]) -> bool {
    let pierced = |t: [DVec3; 3], p: DVec3, q: DVec3| {
        let volume = |a: DVec3, b: DVec3, c: DVec3, d: DVec3| (b - a).cross(c - a).dot(d - a);
        let (from, to) = (volume(t[0], t[1], t[2], p), volume(t[0], t[1], t[2], q));
        let around = [volume(p, q, t[0], t[1]), volume(p, q, t[1], t[2]), volume(p, q, t[2], t[0])];
        from * to < 0.0 && (around.iter().all(|v| *v > 0.0) || around.iter().all(|v| *v < 0.0))
    };
    (0..3).any(|k| pierced(a, b[k], b[(k + 1) % 3]) || pierced(b, a[k], a[(k + 1) % 3]))
}
