//! What counts as a body's surface, and what is measured on it.
#![allow(clippy::expect_used, reason = "a helper that cannot go on stops its test")]

mod common;

use common::{block, icosphere};
use glam::DVec3;
use rhombus_chain::{MeshError, SurfaceMesh, SurfacePoint, inspect};

type Triangles = (Vec<DVec3>, Vec<[u32; 3]>);

fn cube() -> Triangles {
    block(DVec3::ONE, 1)
}

fn refusal((vertices, triangles): Triangles) -> MeshError {
    SurfaceMesh::new(vertices, triangles).expect_err("not a surface")
}

/// Two surfaces in one list.
fn together((mut vertices, mut triangles): Triangles, (others, more): Triangles) -> Triangles {
    let first = vertices.len() as u32;
    vertices.extend(others);
    triangles.extend(more.into_iter().map(|t| t.map(|v| v + first)));
    (vertices, triangles)
}

fn moved((vertices, triangles): Triangles, by: DVec3) -> Triangles {
    (vertices.into_iter().map(|p| p + by).collect(), triangles)
}

fn flipped((vertices, triangles): Triangles) -> Triangles {
    (vertices, triangles.into_iter().map(|[a, b, c]| [a, c, b]).collect())
}

#[test]
fn a_cube_has_the_volume_area_and_extents_of_a_cube() {
    let (vertices, triangles) = block(DVec3::new(1.0, 2.0, 3.0), 4);
    let mesh = SurfaceMesh::new(vertices, triangles).expect("a surface");
    assert!((mesh.volume_m3() - 6.0).abs() < 1e-12);
    assert!((mesh.vertex_areas().iter().sum::<f64>() - 22.0).abs() < 1e-12);
    assert_eq!(mesh.extents(), [DVec3::new(-0.5, -1.0, -1.5), DVec3::new(0.5, 1.0, 1.5)]);
    assert!(mesh.memory_bytes() > 0);
}

#[test]
fn vertex_normals_are_unit_and_do_not_depend_on_how_a_flat_side_is_divided() {
    for n in [1, 2, 5] {
        let (vertices, triangles) = block(DVec3::ONE, n);
        let mesh = SurfaceMesh::new(vertices, triangles).expect("a surface");
        for (&p, &normal) in mesh.vertices().iter().zip(mesh.vertex_normals()) {
            // Angle weights make the corner of a cube point along the diagonal however its sides are cut.
            let outward = p.to_array().map(|x| if x.abs() > 0.49 { x.signum() } else { 0.0 });
            let expected = DVec3::from_array(outward).normalize_or_zero();
            assert!((normal.length() - 1.0).abs() < 1e-14);
            assert!(normal.distance(expected) < 1e-12, "{p}: {normal}, expected {expected}");
        }
    }
}

#[test]
fn the_interpolated_normal_is_the_same_seen_from_both_faces_of_an_edge() {
    let (vertices, triangles) = icosphere(0.1, 1);
    let mesh = SurfaceMesh::new(vertices, triangles).expect("a surface");
    let at = |face: usize, a: u32, b: u32| {
        let weight = |v: u32| {
            if v == a {
                0.3
            } else if v == b {
                0.7
            } else {
                0.0
            }
        };
        let barycentric = DVec3::from_array(mesh.triangles()[face].map(weight));
        SurfacePoint { face: face as u32, barycentric }
    };
    let mut edges = 0;
    for (face, &[a, b, _]) in mesh.triangles().iter().enumerate() {
        let holds = |t: &[u32; 3]| t.contains(&a) && t.contains(&b);
        let other =
            (0..mesh.triangles().len()).find(|&t| t != face && holds(&mesh.triangles()[t])).expect("closed");
        let (here, there) = (at(face, a, b), at(other, a, b));
        assert!(mesh.normal(here).distance(mesh.normal(there)) < 1e-15);
        assert!(mesh.position(here).distance(mesh.position(there)) < 1e-15);
        assert!(mesh.neighbours(a).any(|v| v == b) && mesh.neighbours(b).any(|v| v == a));
        edges += 1;
    }
    assert_eq!(edges, 80);
}

#[test]
fn an_empty_mesh_is_refused() {
    assert_eq!(refusal((vec![], vec![])), MeshError::Empty { vertices: 0, triangles: 0 });
    assert_eq!(refusal((vec![DVec3::ZERO], vec![])), MeshError::Empty { vertices: 1, triangles: 0 });
}

#[test]
fn a_coordinate_that_cannot_be_computed_with_is_refused_by_number() {
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        let (mut vertices, triangles) = cube();
        vertices[5].y = bad;
        let error = refusal((vertices, triangles));
        assert!(matches!(error, MeshError::Coordinate { vertex: 5, .. }), "{error:?}");
        assert!(error.to_string().contains("vertex 5"), "{error}");
    }
}

#[test]
fn a_vertex_number_that_does_not_exist_is_refused() {
    let (vertices, mut triangles) = cube();
    triangles[3][1] = 8;
    let error = refusal((vertices, triangles));
    assert_eq!(error, MeshError::IndexOutOfRange { triangle: 3, index: 8, vertices: 8 });
    assert!(error.to_string().contains("accepted: 0 to 7"), "{error}");
}

#[test]
fn a_triangle_without_area_is_refused_whatever_its_size() {
    let (vertices, mut triangles) = cube();
    triangles[2][1] = triangles[2][0];
    assert!(matches!(refusal((vertices, triangles)), MeshError::RepeatedCorner { triangle: 2, .. }));

    for size in [1e-9, 1.0, 1e5] {
        let mut vertices = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z, DVec3::new(0.5, 1e-12, 0.0)];
        vertices.iter_mut().for_each(|p| *p *= size);
        let triangles = vec![[0, 4, 1], [0, 2, 4], [4, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let error = refusal((vertices, triangles));
        assert!(matches!(error, MeshError::Degenerate { triangle: 0, .. }), "{error:?}");
    }
    // A small one with area is fine.
    assert!(SurfaceMesh::new(cube().0.into_iter().map(|p| p * 1e-9).collect(), cube().1).is_ok());
}

#[test]
fn a_hole_is_refused_with_the_edge_and_the_number_of_open_edges() {
    let (vertices, mut triangles) = cube();
    triangles.remove(4);
    let error = refusal((vertices, triangles));
    assert!(matches!(error, MeshError::OpenEdge { count: 3, .. }), "{error:?}");
    assert!(error.to_string().contains("3 edges") && error.to_string().contains("closed"), "{error}");
}

#[test]
fn an_edge_of_more_than_two_triangles_is_refused() {
    // Two tetrahedra that share an edge.
    let vertices = vec![DVec3::ZERO, DVec3::Z, DVec3::X, DVec3::Y, -DVec3::X, -DVec3::Y];
    let mut triangles = vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    triangles.extend([[0, 1, 4], [0, 5, 1], [0, 4, 5], [1, 5, 4]]);
    let error = refusal((vertices, triangles));
    assert!(
        matches!(error, MeshError::NonManifoldEdge { edge: [0, 1], triangles: 4, count: 1, .. }),
        "{error:?}"
    );
}

#[test]
fn parts_that_meet_in_one_vertex_are_refused() {
    let (mut vertices, mut triangles) = together(cube(), moved(cube(), DVec3::ONE));
    // The corner at (0.5, 0.5, 0.5) of the first is the corner at (-0.5, -0.5, -0.5) of the second.
    let at = |p: f64, from: usize| vertices[from..from + 8].iter().position(|v| *v == DVec3::splat(p));
    let (kept, double) = (at(0.5, 0).expect("corner") as u32, at(0.5, 8).expect("corner") as u32 + 8);
    triangles.iter_mut().flatten().filter(|v| **v == double).for_each(|v| *v = kept);
    vertices.remove(double as usize);
    triangles.iter_mut().flatten().filter(|v| **v > double).for_each(|v| *v -= 1);
    let error = refusal((vertices, triangles));
    assert_eq!(error, MeshError::NonManifoldVertex { vertex: kept as usize, fans: 2, count: 1 });
}

#[test]
fn a_triangle_turned_against_its_neighbours_is_refused() {
    let (vertices, mut triangles) = cube();
    triangles[7].swap(0, 1);
    let error = refusal((vertices, triangles));
    assert!(matches!(error, MeshError::InconsistentOrientation { count: 3, .. }), "{error:?}");
}

#[test]
fn a_surface_turned_inside_out_is_refused_with_the_cure() {
    let error = refusal(flipped(cube()));
    assert!(matches!(error, MeshError::Flipped { triangles: 12, .. }), "{error:?}");
    assert!(
        error.to_string().contains("flipped") && error.to_string().contains("swap two corners"),
        "{error}"
    );
}

#[test]
fn a_flipped_part_beside_another_is_refused_and_a_cavity_inside_is_not() {
    let small = || (cube().0.into_iter().map(|p| p * 0.3).collect(), cube().1);
    let beside = together(cube(), moved(flipped(small()), DVec3::X * 2.0));
    let error = refusal(beside);
    assert!(matches!(error, MeshError::Flipped { triangle: 12, triangles: 12, .. }), "{error:?}");

    let (vertices, triangles) = together(cube(), flipped(small()));
    let hollow = SurfaceMesh::new(vertices, triangles).expect("a body with a cavity");
    assert!((hollow.volume_m3() - (1.0 - 0.027)).abs() < 1e-12);

    let (vertices, triangles) = together(cube(), moved(small(), DVec3::X * 2.0));
    assert!(SurfaceMesh::new(vertices, triangles).is_ok(), "two parts");
}

#[test]
fn a_folded_sheet_is_refused() {
    let vertices = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
    assert!(matches!(refusal((vertices, vec![[0, 1, 2], [0, 2, 1]])), MeshError::NoVolume { .. }));
}

#[test]
fn a_vertex_without_triangle_is_refused() {
    let (mut vertices, triangles) = cube();
    vertices.push(DVec3::ONE);
    assert_eq!(refusal((vertices, triangles)), MeshError::Unreferenced { vertex: 8, count: 1 });
}

#[test]
fn inspection_does_not_stop_at_the_first_fault() {
    let (mut vertices, mut triangles) = together(cube(), moved(cube(), DVec3::X * 3.0));
    triangles.remove(0); // a hole
    triangles[4].swap(0, 1); // against its neighbours
    triangles.push([0, 1, 99]); // no such vertex
    triangles.push([9, 9, 10]); // no area
    vertices.push(DVec3::NAN);
    let found = inspect(&vertices, &triangles);
    assert_eq!((found.vertices, found.triangles), (17, 25));
    assert_eq!((found.unusable_vertices, found.unusable_triangles, found.degenerate_triangles), (1, 1, 1));
    assert_eq!(found.open_edges, 3);
    assert!(found.misoriented_edges >= 2);
    assert_eq!(found.unreferenced_vertices, 1);
    assert!(!found.is_closed() && !found.is_oriented());
    assert_eq!(found.volume_m3, None);
    assert!(found.extents.is_some());

    let (vertices, triangles) = cube();
    let sound = inspect(&vertices, &triangles);
    assert!(sound.is_closed() && sound.is_manifold() && sound.is_oriented());
    assert_eq!(sound.parts, 1);
    assert!((sound.volume_m3.expect("closed") - 1.0).abs() < 1e-12);
    assert!(
        (inspect(&vertices, &flipped((vertices.clone(), triangles)).1).volume_m3.expect("closed") + 1.0)
            .abs()
            < 1e-12
    );
    assert_eq!(inspect(&[], &[]).extents, None);
}

#[test]
fn a_fan_of_a_hundred_thousand_triangles_is_no_trouble() {
    // A cone: quadratic work in the size of a fan would take minutes.
    let n = 100_000u32;
    let angle = |k: u32| f64::from(k) / f64::from(n) * std::f64::consts::TAU;
    let mut vertices: Vec<DVec3> =
        (0..n).map(|k| DVec3::new(libm::cos(angle(k)), libm::sin(angle(k)), 0.0)).collect();
    vertices.extend([DVec3::Z, -DVec3::Z]);
    let triangles = (0..n).flat_map(|k| [[k, (k + 1) % n, n], [(k + 1) % n, k, n + 1]]).collect();
    let mesh = SurfaceMesh::new(vertices, triangles).expect("a double cone");
    assert!((mesh.volume_m3() - std::f64::consts::TAU / 3.0).abs() < 1e-6);
}
