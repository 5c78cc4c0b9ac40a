//! What a press site promises.
#![expect(clippy::expect_used, reason = "a test may fail here")]

use rhombus_chain::{Body, SurfaceMesh};
use scene::generate::body;
use scene::{BodyKind, sites};

fn generated(kind: BodyKind, vertices: usize) -> Body {
    let shape = body(kind, vertices);
    Body::new(SurfaceMesh::new(shape.vertices, shape.triangles).expect("a body"))
}

#[test]
fn the_first_site_of_the_liver_is_on_the_broad_upper_lobe() {
    let first = sites(&generated(BodyKind::Liver, 3116), 1)[0];
    println!("{first:?}");
    // The right lobe is at x < 0, up is +z.
    assert!((-0.08..0.0).contains(&first.point.x), "{first:?}");
    assert!(first.normal.z > 0.8, "{first:?}");
}

#[test]
fn sites_are_on_the_surface_with_unit_normals_and_well_apart() {
    let liver = generated(BodyKind::Liver, 3116);
    let found = sites(&liver, 6);
    assert_eq!(found.len(), 6);
    for (i, site) in found.iter().enumerate() {
        println!("{site:?}");
        assert_eq!(site.point, liver.mesh().vertices()[site.vertex as usize]);
        assert!((site.normal.length() - 1.0).abs() < 1e-12);
        for other in &found[..i] {
            assert!(site.point.distance(other.point) > 0.03, "{site:?} {other:?}");
        }
    }
}

#[test]
fn sites_keep_away_from_thin_lobes_and_sharp_edges() {
    let liver = generated(BodyKind::Liver, 3116);
    for site in sites(&liver, 8) {
        let below = site.point - site.normal * 0.010;
        let (_, distance) = liver.index().closest(liver.mesh(), below, 1.0).expect("within a metre");
        assert!(distance > 0.008, "no ball of tissue of 10 mm radius fits under {site:?}: {distance} m");
    }
    let block = generated(BodyKind::Block, 2000);
    for site in sites(&block, 6) {
        let sides = site.normal.abs();
        assert!(sides.max_element() > 0.999, "on an edge: {site:?}");
    }
}

#[test]
fn a_sheet_is_not_mistaken_for_thick_because_the_other_side_is_far() {
    let mut shape = body(BodyKind::Liver, 1500);
    for vertex in &mut shape.vertices {
        // The left half becomes a sheet of a millimetre or two.
        vertex.z *= if vertex.x > 0.0 { 0.03 } else { 1.0 };
    }
    let liver = Body::new(SurfaceMesh::new(shape.vertices, shape.triangles).expect("a body"));
    for site in sites(&liver, 6) {
        assert!(site.point.x < 0.01, "{site:?}");
    }
}

#[test]
fn sites_are_the_same_every_time_and_never_more_than_there_are_vertices() {
    let small = generated(BodyKind::Sphere, 20);
    assert_eq!(sites(&small, 3), sites(&small, 3));
    assert_eq!(sites(&small, 500).len(), 20);
    assert!(sites(&small, 0).is_empty());
}
