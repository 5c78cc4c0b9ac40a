//! What our OBJ reader accepts, tobj reads as the same surface.
#![expect(clippy::expect_used, reason = "a test may fail here")]

use glam::DVec3;
use scene::{BodyKind, MeshFile, Obj, generate};

type Corners = Vec<[DVec3; 3]>;

fn ours(text: &str) -> Corners {
    let mesh = MeshFile::parse("mesh.obj", text.as_bytes()).expect("accepted");
    mesh.triangles.iter().map(|corners| corners.map(|v| mesh.vertices[v as usize])).collect()
}

/// Corner by corner: tobj numbers the vertices of every group anew.
fn as_tobj_reads(text: &str) -> Corners {
    let options = tobj::LoadOptions { triangulate: true, ..tobj::LoadOptions::default() };
    let no_materials = |_: &std::path::Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, no_materials).expect("read by tobj");
    let mut corners = Vec::new();
    for model in &models {
        let at = |index: u32| DVec3::from_slice(&model.mesh.positions[3 * index as usize..]);
        corners.extend(model.mesh.indices.chunks(3).map(|c| [at(c[0]), at(c[1]), at(c[2])]));
    }
    corners
}

#[test]
fn a_generated_body_is_read_as_tobj_reads_it() {
    for kind in BodyKind::ALL {
        let shape = generate::body(kind, 400);
        let obj = Obj { comment: "a body", vertices: &shape.vertices, triangles: &shape.triangles };
        let text = obj.to_string();
        assert_eq!(ours(&text), as_tobj_reads(&text), "{kind:?}");
    }
}

#[test]
fn groups_texture_coordinates_negative_indices_and_quads_are_read_as_tobj_reads_them() {
    let text = "# two groups that share vertices\no part\nv 0 0 0\nv 1e-1 0 0\nv 0.1 0.1 0\nv 0 .1 0\nv 0 0 0.1\n\
                vt 0 0\nvn 0 0 1\ng one\nusemtl none\nf 1/1/1 2/1/1 3/1/1 4/1/1\ng two\ns off\nf -1 1//1 2/1\nf 5 2 3\n";
    assert_eq!(ours(text), as_tobj_reads(text));
    assert_eq!(ours(text).len(), 4);
}
