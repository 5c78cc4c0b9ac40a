//! How the surface moves: where, how far, how smoothly.
#![allow(clippy::expect_used, reason = "a helper that cannot go on stops its test")]

mod common;

use std::collections::BTreeMap;

use common::{Random, block, body, bumpy, icosphere, law, surface, tissue, tissue_with};
use glam::DVec3;
use rhombus_chain::{
    ArcLengths, Body, ContactShape, Impression, Spread, SurfaceField, SurfaceMesh, SurfacePoint, Tissue,
};

/// A press of `depth_m` at a point of the surface.
fn press(mesh: &SurfaceMesh, at: SurfacePoint, depth_m: f64) -> Impression {
    let (position, normal) = (mesh.position(at), mesh.normal(at));
    Impression { at, position, normal, depth_m, lateral_m: DVec3::ZERO }
}

fn update(
    field: &mut SurfaceField,
    body: &Body,
    tissue: &Tissue,
    impressions: &[Impression],
) -> BTreeMap<u32, DVec3> {
    field.update(body, tissue, impressions.iter().copied());
    assert!(field.vertices().is_sorted_by(|a, b| a < b), "ascending, each vertex once");
    field.vertices().iter().copied().zip(field.displacements().iter().copied()).collect()
}

fn field(body: &Body, tissue: &Tissue, impressions: &[Impression]) -> BTreeMap<u32, DVec3> {
    update(&mut SurfaceField::new(body, tissue), body, tissue, impressions)
}

/// Largest difference of two fields at any vertex.
fn largest_difference(a: &BTreeMap<u32, DVec3>, b: &BTreeMap<u32, DVec3>) -> f64 {
    let at = |field: &BTreeMap<u32, DVec3>, v: &u32| field.get(v).copied().unwrap_or_default();
    a.keys().chain(b.keys()).map(|v| at(a, v).distance(at(b, v))).fold(0.0, f64::max)
}

/// The face and weights of a vertex.
fn vertex_point(mesh: &SurfaceMesh, vertex: u32) -> SurfacePoint {
    let face = mesh.triangles().iter().position(|t| t.contains(&vertex)).expect("used");
    let weight = |v: u32| f64::from(u8::from(v == vertex));
    SurfacePoint { face: face as u32, barycentric: DVec3::from_array(mesh.triangles()[face].map(weight)) }
}

#[test]
fn the_contact_point_moves_by_exactly_the_depth_and_far_vertices_not_at_all() {
    let (body, tissue) = (body(bumpy(4)), tissue());
    let mesh = body.mesh();
    let mut arcs = ArcLengths::new(mesh);
    for (vertex, depth_m) in [(17, 0.005), (400, 0.001), (2000, -0.004)] {
        let at = vertex_point(mesh, vertex);
        let moved = field(&body, &tissue, &[press(mesh, at, depth_m)]);
        assert!(moved[&vertex].distance(mesh.normal(at) * -depth_m) < 1e-17, "{}", moved[&vertex]);

        let mut shape = ContactShape::new(tissue.law(), tissue.surface()).expect("a shape");
        shape.set_depth(tissue.law(), depth_m).expect("finite");
        arcs.solve(mesh, at, shape.reach_m());
        let near: BTreeMap<u32, f64> = arcs.iter().collect();
        assert!(moved.keys().all(|v| near.contains_key(v)), "nothing beyond the boundary moves");
        assert!((4..mesh.vertices().len() / 2).contains(&moved.len()), "{}", moved.len());
    }
}

#[test]
fn every_vertex_moves_as_the_shape_says_at_its_arc_length() {
    let (body, tissue) = (body(block(DVec3::splat(0.2), 12)), tissue());
    let mesh = body.mesh();
    let at = vertex_point(
        mesh,
        mesh.vertices().iter().position(|p| *p == DVec3::new(0.0, 0.0, 0.1)).expect("top") as u32,
    );
    let mut shape = ContactShape::new(tissue.law(), tissue.surface()).expect("a shape");
    shape.set_depth(tissue.law(), 0.004).expect("finite");
    let mut seen = 0;
    for (v, moved) in field(&body, &tissue, &[press(mesh, at, 0.004)]) {
        let p = mesh.vertices()[v as usize];
        if p.z < 0.1 {
            continue;
        }
        let arc = libm::hypot(p.x, p.y);
        assert!((moved.z - shape.normal_m(shape.s_m(arc))).abs() < 1e-12);
        let outward = moved.x * p.x + moved.y * p.y;
        assert!((outward - arc * shape.tangential_m(shape.s_m(arc), arc)).abs() < 1e-15);
        seen += 1;
    }
    assert!(seen >= 9, "{seen}");
}

#[test]
fn behind_a_thin_lobe_nothing_jumps() {
    // On the underside of a thin slab, right below the contact, "away from the contact" has no direction.
    let (body, tissue) = (body(block(DVec3::new(0.04, 0.04, 0.002), 8)), tissue());
    let below = DVec3::new(-0.015, 0.0, -0.001);
    let vertex =
        body.mesh().vertices().iter().position(|p| p.distance(below) < 1e-12).expect("a vertex") as u32;
    let pressed_at = |x: f64, y: f64| {
        let top = below + DVec3::new(x, y, 0.002);
        let (at, _) = body.index().closest(body.mesh(), top, 1.0).expect("on the surface");
        field(&body, &tissue, &[press(body.mesh(), at, 0.004)])
    };
    let middle = pressed_at(0.0, 0.0);
    assert!(middle[&vertex].length() > 1e-5, "the underside moves, too");
    for (x, y) in [(1e-7, 0.0), (-1e-7, 0.0), (0.0, 1e-7), (0.0, -1e-7)] {
        assert!(pressed_at(x, y)[&vertex].distance(middle[&vertex]) < 1e-6);
    }
}

#[test]
fn the_field_is_continuous_in_position() {
    let tissues = [tissue(), tissue_with(3, surface(0.5, Spread::Geodesic))];
    for (body, tissue) in
        [body(bumpy(3)), body(icosphere(0.05, 3))].iter().flat_map(|b| tissues.iter().map(move |t| (b, t)))
    {
        let mesh = body.mesh();
        let (mut field, mut random) = (SurfaceField::new(body, tissue), Random(4));
        for step_m in [1e-5, 1e-7] {
            for k in 0..60 {
                let mut from = random.surface_point(mesh);
                if k % 3 == 0 {
                    from.barycentric = DVec3::new(0.4, 0.6, 0.0); // across an edge
                }
                let (start, normal, direction) = (mesh.position(from), mesh.normal(from), random.direction());
                let beside =
                    start + (direction - normal * direction.dot(normal)).normalize_or_zero() * step_m;
                let (to, _) = body.index().closest(mesh, beside, 1.0).expect("on the surface");
                let first = update(&mut field, body, tissue, &[press(mesh, from, 0.005)]);
                let second = update(&mut field, body, tissue, &[press(mesh, to, 0.005)]);
                let change = largest_difference(&first, &second);
                assert!(change < 5.0 * step_m, "{change} after {step_m}");
            }
        }
    }
}

#[test]
fn the_field_is_continuous_in_depth() {
    let body = body(bumpy(4));
    for tissue in [tissue(), tissue_with(3, surface(0.5, Spread::Geodesic))] {
        let at = Random(12).surface_point(body.mesh());
        let mut field = SurfaceField::new(&body, &tissue);
        let mut last = BTreeMap::new();
        // From pulled through rest to pressed.
        for k in -300..500 {
            let now = update(&mut field, &body, &tissue, &[press(body.mesh(), at, f64::from(k) * 1e-5)]);
            if k > -300 {
                assert!(largest_difference(&last, &now) < 4e-5, "{} at {k}", largest_difference(&last, &now));
            }
            last = now;
        }
    }
}

#[test]
fn a_contact_that_stays_gives_the_same_bits_as_a_new_one() {
    let (body, tissue) = (body(bumpy(4)), tissue());
    let at = Random(13).surface_point(body.mesh());
    let mut kept = SurfaceField::new(&body, &tissue);
    for k in 0..60 {
        let impression = press(body.mesh(), at, 0.006 * f64::from(k) / 60.0);
        let again = update(&mut kept, &body, &tissue, &[impression]);
        assert_eq!(again, field(&body, &tissue, &[impression]));
    }
}

#[test]
fn two_devices_add_their_displacements() {
    let (body, tissue) = (body(bumpy(4)), tissue());
    let mesh = body.mesh();
    let (p, q) = (vertex_point(mesh, 100), vertex_point(mesh, 101));
    let far = vertex_point(mesh, 2000);
    let mut both = SurfaceField::new(&body, &tissue);
    for (a, b) in
        [(press(mesh, p, 0.004), press(mesh, q, -0.002)), (press(mesh, p, 0.004), press(mesh, far, 0.005))]
    {
        let (first, second) = (field(&body, &tissue, &[a]), field(&body, &tissue, &[b]));
        let sum = update(&mut both, &body, &tissue, &[a, b]);
        let expected: BTreeMap<u32, DVec3> = first
            .keys()
            .chain(second.keys())
            .map(|v| {
                (*v, first.get(v).copied().unwrap_or_default() + second.get(v).copied().unwrap_or_default())
            })
            .collect();
        assert_eq!(sum, expected);
        // Which device is which does not matter to what is kept of the last update.
        assert!(largest_difference(&update(&mut both, &body, &tissue, &[b, a]), &expected) < 1e-17);
    }
    assert!(update(&mut both, &body, &tissue, &[]).is_empty(), "nobody touches, nothing moves");
}

#[test]
fn a_grasp_carries_the_surface_along() {
    let (body, tissue) = (body(bumpy(4)), tissue());
    let at = vertex_point(body.mesh(), 300);
    let still = press(body.mesh(), at, -0.003);
    let lateral_m = still.normal.any_orthonormal_vector() * 0.002;
    let (before, after) =
        (field(&body, &tissue, &[still]), field(&body, &tissue, &[Impression { lateral_m, ..still }]));
    assert!((after[&300] - before[&300]).distance(lateral_m) < 1e-17);
    for (v, moved) in &after {
        let carried = *moved - before[v];
        let share = carried.dot(lateral_m) / lateral_m.length_squared();
        assert!((-1e-12..=1.0 + 1e-12).contains(&share));
        assert!(carried.distance(lateral_m * share) < 1e-15, "all in the same direction");
        // The same share of the contact's way as along the normal.
        assert!((share - before[v].dot(still.normal) / 0.003).abs() < 1e-12);
    }
}

#[test]
fn expansion_gives_back_its_share_of_the_displaced_volume() {
    let body = body(bumpy(4));
    let mesh = body.mesh();
    let at = Random(14).surface_point(mesh);
    let without = field(&body, &tissue_with(2, surface(0.0, Spread::Geodesic)), &[press(mesh, at, 0.005)]);
    for kappa in [0.3, 1.0] {
        let with = field(&body, &tissue_with(2, surface(kappa, Spread::Geodesic)), &[press(mesh, at, 0.005)]);
        let area = |v: u32| mesh.vertex_areas()[v as usize];
        let displaced: f64 = without.iter().map(|(v, u)| area(*v) * u.dot(mesh.normal(at))).sum();
        let mut given_back = 0.0;
        for (v, moved) in &with {
            let bulge = *moved - without.get(v).copied().unwrap_or_default();
            let normal = mesh.vertex_normals()[*v as usize];
            given_back += area(*v) * bulge.dot(normal);
            assert!(bulge.distance(normal * bulge.dot(normal)) < 1e-17, "along the vertex normal");
            assert!(bulge.dot(normal) > -1e-18, "outward");
            assert!(
                bulge.length() < 1e-17 || without.get(v).is_none_or(|u| u.length() < 1e-6),
                "outside the boundary"
            );
        }
        assert!((given_back + kappa * displaced).abs() < 1e-12 * displaced.abs(), "{given_back} {displaced}");
        assert!(with.len() > without.len());
    }
}

#[test]
fn what_is_not_asked_for_is_not_there() {
    let body = body(bumpy(4));
    let size = |tissue: &Tissue| SurfaceField::new(&body, tissue).memory_bytes();
    let plain = size(&tissue_with(2, surface(0.0, Spread::Geodesic)));
    let vertices = body.mesh().vertices().len();
    assert_eq!(
        size(&tissue_with(2, surface(0.1, Spread::Geodesic))),
        plain + 8 * vertices,
        "one bump for each vertex"
    );
    assert!(size(&tissue_with(2, surface(0.0, Spread::Rings))) < plain / 2, "no tables of angles");
}

#[test]
fn rings_move_by_their_number() {
    let body = body(icosphere(0.05, 3));
    let mesh = body.mesh();
    let tissue = tissue_with(1, surface(0.0, Spread::Rings));
    let at = Random(15).surface_point(mesh);
    let mut shape = ContactShape::new(tissue.law(), tissue.surface()).expect("a shape");
    shape.set_depth(tissue.law(), 0.004).expect("finite");
    let moved = field(&body, &tissue, &[press(mesh, at, 0.004)]);

    let mut ring: Vec<u32> = mesh.triangles()[at.face as usize].to_vec();
    let mut numbers: BTreeMap<u32, u32> = ring.iter().map(|v| (*v, 0)).collect();
    for number in 1..20 {
        let mut next: Vec<u32> = ring.iter().flat_map(|v| mesh.neighbours(*v)).collect();
        next.retain(|v| !numbers.contains_key(v));
        numbers.extend(next.iter().map(|v| (*v, number)));
        ring = next;
    }
    for (v, number) in numbers {
        let expected = shape.displacement_at_ring(f64::from(number)).normal_m;
        let normal = moved.get(&v).map_or(0.0, |u| u.dot(mesh.normal(at)));
        assert!((normal - expected).abs() < 1e-15, "ring {number}: {normal} {expected}");
    }
}

#[test]
fn a_change_of_tissue_is_taken_over() {
    let body = body(bumpy(3));
    let at = Random(16).surface_point(body.mesh());
    let impression = press(body.mesh(), at, 0.004);
    let mut kept = SurfaceField::new(&body, &tissue());
    for tissue in [
        tissue_with(3, surface(0.0, Spread::Geodesic)),
        tissue_with(3, surface(0.4, Spread::Geodesic)),
        tissue_with(1, surface(0.4, Spread::Rings)),
        tissue(),
    ] {
        assert_eq!(update(&mut kept, &body, &tissue, &[impression]), field(&body, &tissue, &[impression]));
    }
    assert_eq!(law(2).chains().len(), 2);
}

#[test]
fn an_impression_that_is_no_number_is_left_out() {
    let (body, tissue) = (body(bumpy(3)), tissue());
    let at = Random(18).surface_point(body.mesh());
    let (bad, good) = (press(body.mesh(), at, f64::NAN), press(body.mesh(), at, 0.003));
    assert!(field(&body, &tissue, &[bad]).is_empty());
    assert_eq!(field(&body, &tissue, &[bad, good]), field(&body, &tissue, &[good]));
}
