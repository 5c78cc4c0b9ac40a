//! Arc lengths against closed forms and against every straight way over the triangles there is.
#![allow(clippy::expect_used, reason = "a helper that cannot go on stops its test")]

mod common;

use std::collections::BTreeMap;

use common::{Random, block, body, bumpy, icosphere};
use glam::{DVec2, DVec3};
use rhombus_chain::{ArcLengths, SurfaceMesh, SurfacePoint};

fn mesh((vertices, triangles): (Vec<DVec3>, Vec<[u32; 3]>)) -> SurfaceMesh {
    SurfaceMesh::new(vertices, triangles).expect("a surface")
}

fn arcs(solver: &mut ArcLengths, mesh: &SurfaceMesh, from: SurfacePoint, limit_m: f64) -> BTreeMap<u32, f64> {
    solver.solve(mesh, from, limit_m);
    solver.iter().collect()
}

/// A prism of `n` sides with long thin triangles.
fn prism(n: u32, radius: f64, height: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let corner = |k: u32, z: f64| {
        let angle = f64::from(k) / f64::from(n) * std::f64::consts::TAU;
        DVec3::new(radius * libm::cos(angle), radius * libm::sin(angle), z)
    };
    let mut vertices: Vec<DVec3> = (0..n).flat_map(|k| [corner(k, 0.0), corner(k, height)]).collect();
    vertices.extend([DVec3::ZERO, DVec3::Z * height]);
    let sides = |k: u32| {
        let (a, b) = (2 * k, 2 * ((k + 1) % n));
        [[a, b, b + 1], [a, b + 1, a + 1], [2 * n, b, a], [2 * n + 1, a + 1, b + 1]]
    };
    (vertices, (0..n).flat_map(sides).collect())
}

/// A bumpy body whose vertices have been shaken by up to `by_m`.
fn shaken(subdivisions: u32, by_m: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let (mut vertices, triangles) = bumpy(subdivisions);
    let mut random = Random(17);
    vertices.iter_mut().for_each(|p| *p += random.direction() * by_m);
    (vertices, triangles)
}

/// The shortest ways over the triangles, the slow and sure way: from the source and from every vertex, all
/// straight ways through all sequences of triangles, none left out but those that are longer than `limit_m`.
struct EveryWay<'a> {
    mesh: &'a SurfaceMesh,
    /// The face to the right of each directed edge, with its third vertex.
    faces: BTreeMap<(u32, u32), u32>,
    limit_m: f64,
}

impl<'a> EveryWay<'a> {
    fn new(mesh: &'a SurfaceMesh, limit_m: f64) -> Self {
        let corners = |&[a, b, c]: &[u32; 3]| [((a, b), c), ((b, c), a), ((c, a), b)];
        Self { mesh, faces: mesh.triangles().iter().flat_map(corners).collect(), limit_m }
    }

    fn position(&self, v: u32) -> DVec3 {
        self.mesh.vertices()[v as usize]
    }

    fn arcs(&self, from: SurfacePoint) -> Vec<f64> {
        let source = self.mesh.position(from);
        let mut arcs = vec![f64::INFINITY; self.mesh.vertices().len()];
        let [a, b, c] = self.mesh.triangles()[from.face as usize];
        for (u, v) in [(a, b), (b, c), (c, a)] {
            arcs[u as usize] = self.position(u).distance(source);
            self.send(&mut arcs, (u, v), source, 0.0);
        }
        // Dijkstra over the vertices; a shortest way bends only there.
        let mut open: Vec<u32> = (0..arcs.len() as u32).collect();
        while let Some(nearest) =
            (0..open.len()).min_by(|&i, &j| arcs[open[i] as usize].total_cmp(&arcs[open[j] as usize]))
        {
            let vertex = open.swap_remove(nearest);
            let arc = arcs[vertex as usize];
            if arc > self.limit_m {
                break;
            }
            for (&(u, v), _) in self.faces.iter().filter(|&(_, &apex)| apex == vertex) {
                let along = arc + self.position(u).distance(self.position(vertex));
                arcs[u as usize] = arcs[u as usize].min(along);
                self.send(&mut arcs, (u, v), self.position(vertex), arc);
            }
        }
        arcs
    }

    /// All straight ways out of a face through its edge u v, from a point in it that is already `arc` away.
    fn send(&self, arcs: &mut [f64], (u, v): (u32, u32), from: DVec3, arc: f64) {
        let (p, q) = (self.position(u), self.position(v));
        let along = (q - p).normalize_or_zero();
        let x = (from - p).dot(along);
        let source = DVec2::new(x, (from - p - along * x).length());
        if source.y > 1e-12 {
            let ends = [DVec2::ZERO, DVec2::new(p.distance(q), 0.0)];
            self.go_on(arcs, (u, v), ends, source, ends, arc);
        }
    }

    /// Ways from `source` between the directions to `cone`, over the edge u v that lies at `ends`. The source
    /// is to its left.
    fn go_on(
        &self,
        arcs: &mut [f64],
        (u, v): (u32, u32),
        ends: [DVec2; 2],
        source: DVec2,
        cone: [DVec2; 2],
        arc: f64,
    ) {
        let apex = self.faces[&(v, u)];
        let [p, q] = ends;
        let (a, b) =
            (self.position(apex).distance(self.position(u)), self.position(apex).distance(self.position(v)));
        let edge = p.distance(q);
        let (x, along) = ((a * a - b * b + edge * edge) / (2.0 * edge), (q - p) / edge);
        let here = p + along * x - along.perp() * (a * a - x * x).max(0.0).sqrt();
        let side = |ray: DVec2| (ray - source).perp_dot(here - source);
        // Seen from the source the cone's first direction is to the left of the second.
        let (first, second) = (side(cone[0]), side(cone[1]));
        let scale = 1e-9 * edge * edge;
        if first >= -scale && second <= scale {
            arcs[apex as usize] = arcs[apex as usize].min(arc + here.distance(source));
        }
        let nearest = |[c, d]: [DVec2; 2]| {
            let t = ((source - c).dot(d - c) / (d - c).length_squared()).clamp(0.0, 1.0);
            arc + source.distance(c + (d - c) * t)
        };
        if first > scale && nearest([p, here]) < self.limit_m {
            let cone = [cone[0], if second > 0.0 { cone[1] } else { here }];
            self.go_on(arcs, (u, apex), [p, here], source, cone, arc);
        }
        if second < -scale && nearest([here, q]) < self.limit_m {
            let cone = [if first < 0.0 { cone[0] } else { here }, cone[1]];
            self.go_on(arcs, (apex, v), [here, q], source, cone, arc);
        }
    }
}

/// Largest relative differences to the exact arcs, downwards and upwards, over random sources.
fn worst_errors(mesh: &SurfaceMesh, sources: usize, limit_m: f64) -> [f64; 2] {
    let (mut solver, exact) = (ArcLengths::new(mesh), EveryWay::new(mesh, limit_m));
    let (mut random, mut worst) = (Random(3), [0.0f64; 2]);
    for _ in 0..sources {
        let from = random.surface_point(mesh);
        let found = arcs(&mut solver, mesh, from, limit_m);
        for (v, exact) in
            exact.arcs(from).into_iter().enumerate().filter(|(_, exact)| *exact < 0.95 * limit_m)
        {
            let error = found[&(v as u32)] / exact - 1.0;
            worst = [worst[0].min(error), worst[1].max(error)];
        }
    }
    worst
}

#[test]
fn on_a_flat_side_arcs_are_straight_lines() {
    let mesh = mesh(block(DVec3::new(0.2, 0.2, 0.2), 8));
    let mut solver = ArcLengths::new(&mesh);
    let mut random = Random(1);
    for _ in 0..50 {
        let from = random.surface_point(&mesh);
        let (source, normal) = (mesh.position(from), mesh.face_normal(from.face));
        for (v, arc) in arcs(&mut solver, &mesh, from, 0.15) {
            let to = mesh.vertices()[v as usize];
            if (to - source).dot(normal).abs() < 1e-12 {
                assert!((arc - to.distance(source)).abs() < 1e-12, "{arc} {}", to.distance(source));
            }
        }
    }
}

#[test]
fn over_a_cube_arcs_are_straight_lines_on_its_unfolded_sides() {
    // From (x, y) on the top of a unit cube to the corners below, over one side or over two.
    let mesh = mesh(block(DVec3::ONE, 4));
    let mut solver = ArcLengths::new(&mesh);
    assert!(solver.is_exact());
    let top = (0..mesh.triangles().len() as u32).filter(|&f| mesh.face_normal(f).z > 0.99);
    for face in top {
        let from = SurfacePoint { face, barycentric: DVec3::new(0.5, 0.3, 0.2) };
        let p = mesh.position(from);
        for (v, arc) in arcs(&mut solver, &mesh, from, 10.0) {
            let q = mesh.vertices()[v as usize];
            if q.x.abs() > 0.49 && q.y.abs() > 0.49 && q.z < -0.49 {
                let (x, y) = ((p.x - q.x).abs(), (p.y - q.y).abs());
                // Down one side, or over the other side first: the three ways to unfold.
                let over_side = |along: f64, across: f64| libm::hypot(along, across + 1.0);
                let expected = over_side(x, y).min(over_side(y, x));
                assert!((arc - expected).abs() < 1e-12, "{p} to {q}: {arc}, expected {expected}");
            }
        }
    }
}

#[test]
fn around_a_prism_arcs_are_straight_lines_on_its_unrolled_side() {
    let (n, radius, height) = (24, 0.03, 0.1);
    let mesh = mesh(prism(n, radius, height));
    let side = 2.0 * radius * libm::sin(std::f64::consts::PI / f64::from(n));
    let mut solver = ArcLengths::new(&mesh);
    // In the middle of side 0, half way up.
    let from = SurfacePoint { face: 0, barycentric: DVec3::new(0.5, 0.0, 0.5) };
    let found = arcs(&mut solver, &mesh, from, 1.0);
    for k in 0..n {
        let sides = (f64::from(k) - 0.5).abs().min((f64::from(n) - f64::from(k) + 0.5).abs());
        let expected = libm::hypot(sides * side, 0.5 * height);
        if expected < 0.06 {
            // Farther round, the way over the lid is shorter.
            assert!((found[&(2 * k)] - expected).abs() < 1e-12, "{k}: {} {expected}", found[&(2 * k)]);
        }
    }
}

#[test]
fn on_a_fine_sphere_arcs_are_great_circles() {
    let mesh = mesh(icosphere(0.05, 4));
    let mut solver = ArcLengths::new(&mesh);
    assert!(!solver.is_exact(), "smooth");
    let mut random = Random(2);
    for _ in 0..20 {
        let from = random.surface_point(&mesh);
        let source = mesh.position(from);
        for (v, arc) in arcs(&mut solver, &mesh, from, 0.2) {
            let expected = 0.05 * source.angle_between(mesh.vertices()[v as usize]);
            assert!((arc - expected).abs() < 0.02 * expected + 1e-6, "{arc} {expected}");
        }
    }
}

#[test]
fn smooth_meshes_are_within_5_percent_of_the_shortest_way_over_their_triangles() {
    let lens = |subdivisions| {
        let (vertices, triangles) = icosphere(0.1, subdivisions);
        (vertices.into_iter().map(|p| p * DVec3::new(1.0, 1.0, 0.2)).collect(), triangles)
    };
    for (mesh, sources, limit_m) in
        [(mesh(icosphere(0.05, 2)), 10, 0.08), (mesh(lens(3)), 4, 0.06), (mesh(bumpy(4)), 4, 0.03)]
    {
        assert!(!ArcLengths::new(&mesh).is_exact());
        let [below, above] = worst_errors(&mesh, sources, limit_m);
        assert!(below > -0.05 && above < 0.05, "{below} {above}");
        assert!(below < -1e-6, "labelling is not exact; the test compares with something else");
    }
}

#[test]
fn rough_meshes_have_the_shortest_way_over_their_triangles() {
    for (mesh, sources, limit_m) in [
        (mesh(block(DVec3::new(0.1, 0.08, 0.06), 1)), 30, 1.0),
        (mesh(block(DVec3::new(0.1, 0.08, 0.06), 3)), 10, 0.12),
        (mesh(prism(8, 0.03, 0.1)), 20, 0.12),
        (mesh(icosphere(0.05, 0)), 20, 0.2),
        (mesh(bumpy(2)), 10, 0.1),
        (mesh(shaken(2, 0.006)), 10, 0.08),
    ] {
        assert!(ArcLengths::new(&mesh).is_exact());
        let [below, above] = worst_errors(&mesh, sources, limit_m);
        assert!(below > -1e-9 && above < 1e-9, "{below} {above}");
    }
}

#[test]
fn moving_the_contact_moves_no_arc_by_much_more() {
    let mut random = Random(11);
    for body in [body(bumpy(3)), body(bumpy(4)), body(icosphere(0.05, 3)), body(block(DVec3::splat(0.1), 6))]
    {
        let mesh = body.mesh();
        let mut solver = ArcLengths::new(mesh);
        for k in 0..200 {
            // Inside a face, on an edge, on a vertex, and a little beside an edge.
            let mut from = random.surface_point(mesh);
            let t = random.unit();
            from.barycentric = match k % 4 {
                0 => from.barycentric,
                1 => DVec3::new(t, 1.0 - t, 0.0),
                2 => DVec3::Y,
                _ => DVec3::new(t * (1.0 - 1e-6), (1.0 - t) * (1.0 - 1e-6), 1e-6),
            };
            let way = [1e-4, 1e-5, 1e-6][k % 3];
            let (start, normal, direction) = (mesh.position(from), mesh.normal(from), random.direction());
            let beside = start + (direction - normal * direction.dot(normal)).normalize_or_zero() * way;
            let (to, _) = body.index().closest(mesh, beside, 1.0).expect("on the surface");
            // At least this long over the surface.
            let moved = mesh.position(to).distance(start);
            let (before, after) = (arcs(&mut solver, mesh, from, 0.06), arcs(&mut solver, mesh, to, 0.06));
            for (v, arc) in after {
                if let Some(other) = before.get(&v) {
                    assert!((arc - other).abs() <= 1.5 * moved + 1e-13, "{arc} {other} after {moved}");
                }
            }
        }
    }
}

#[test]
fn the_limit_only_leaves_out_what_is_beyond() {
    for mesh in [mesh(bumpy(3)), mesh(bumpy(4))] {
        let (mut solver, mut random) = (ArcLengths::new(&mesh), Random(7));
        for _ in 0..100 {
            let (from, limit_m) = (random.surface_point(&mesh), 0.005 + 0.04 * random.unit());
            let near = arcs(&mut solver, &mesh, from, limit_m);
            let far = arcs(&mut solver, &mesh, from, 3.0 * limit_m);
            assert!(near.values().all(|arc| *arc < limit_m));
            assert_eq!(near.len(), far.values().filter(|arc| **arc < limit_m).count());
            for (v, arc) in near {
                assert!((arc - far[&v]).abs() < 5e-3 * arc);
            }
        }
    }
}

#[test]
fn nothing_is_left_of_the_query_before() {
    for mesh in [mesh(bumpy(3)), mesh(bumpy(4))] {
        let (mut used, mut random) = (ArcLengths::new(&mesh), Random(9));
        for _ in 0..50 {
            let (from, limit_m) = (random.surface_point(&mesh), 0.08 * random.unit());
            let fresh = arcs(&mut ArcLengths::new(&mesh), &mesh, from, limit_m);
            assert_eq!(arcs(&mut used, &mesh, from, limit_m), fresh);
        }
        for limit_m in [0.0, -1.0, f64::NAN] {
            assert!(arcs(&mut used, &mesh, random.surface_point(&mesh), limit_m).is_empty());
        }
    }
}

#[test]
fn every_part_of_a_body_keeps_to_itself() {
    let (mut vertices, mut triangles) = icosphere(0.05, 2);
    let (others, more) = icosphere(0.05, 2);
    let first = vertices.len() as u32;
    vertices.extend(others.into_iter().map(|p| p + DVec3::X));
    triangles.extend(more.into_iter().map(|t| t.map(|v| v + first)));
    let mesh = mesh((vertices, triangles));
    let from = SurfacePoint { face: 0, barycentric: DVec3::X };
    let found = arcs(&mut ArcLengths::new(&mesh), &mesh, from, 1e9);
    assert_eq!(found.len(), first as usize);
    assert!(found.keys().all(|v| *v < first));
}
