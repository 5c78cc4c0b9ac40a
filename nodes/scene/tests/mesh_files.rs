//! OBJ files: what is read, what is refused and where, and the warning about a likely wrong unit.
#![expect(clippy::expect_used, reason = "a test may fail here")]

use scene::{MeshFile, Obj, Origin, Scene, Value, generate};

/// A tetrahedron, outward.
const TETRAHEDRON: &str = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

fn surface(text: &str) -> Result<rhombus_chain::SurfaceMesh, String> {
    MeshFile::parse("organ.obj", text.as_bytes())
        .and_then(|mesh| mesh.surface(1.0))
        .map_err(|error| error.to_string())
}

fn error(text: &str) -> String {
    surface(text).expect_err("should be refused")
}

// ---- what is read

#[test]
fn what_other_programs_write_is_read() {
    let text = "# exported\r\nmtllib a.mtl\r\no organ\r\nv 0 0 0 1.0\r\nv 0.1 0 0\r\nv 0 0.1 0 0.5 0.5 0.5\r\nv 0 0 1e-1\r\n\
                vn 0 0 1\r\nvt 0 0\r\ns off\r\nusemtl red\r\nf 1/1/1 3//1 2/1\r\ng left part\r\nf -4 -3 -1 # relative\r\n\
                f 2 3 \\\r\n4\r\nf 3 1 4\r\n";
    let mesh = surface(text).expect("accepted");
    assert_eq!(mesh.triangles(), [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
    assert!((mesh.volume_m3() - 1e-3 / 6.0).abs() < 1e-18);
}

#[test]
fn a_face_with_more_corners_becomes_a_fan() {
    let cube = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
                f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    let mesh = surface(cube).expect("accepted");
    assert_eq!(mesh.triangles().len(), 12);
    assert!((mesh.volume_m3() - 1.0).abs() < 1e-15);
}

#[test]
fn vertices_keep_their_numbers_and_every_bit() {
    let shape = generate::body(scene::BodyKind::Liver, 300);
    let text = Obj { comment: "a liver", vertices: &shape.vertices, triangles: &shape.triangles }.to_string();
    let mesh = MeshFile::parse("liver.obj", text.as_bytes()).expect("accepted");
    assert_eq!((mesh.vertices, mesh.triangles), (shape.vertices, shape.triangles));
}

// ---- what is refused

#[test]
fn a_missing_mesh_file() {
    let error = MeshFile::read(std::path::Path::new("nowhere/organ.obj")).expect_err("missing").to_string();
    assert_eq!(error, "nowhere/organ.obj: cannot be read: No such file or directory (os error 2)");
}

#[test]
fn lines_that_are_not_accepted() {
    let cases = [
        ("", "organ.obj: the file is empty; accepted: OBJ text with lines \"v x y z\" and \"f i j k\""),
        (
            "# nothing\n",
            "organ.obj: the file has no vertices; accepted: OBJ text with lines \"v x y z\" and \"f i j k\"",
        ),
        (
            "v 0 0 0\n",
            "organ.obj: the file has no faces; accepted: OBJ text with lines \"v x y z\" and \"f i j k\"",
        ),
        (
            "solid organ\n",
            "organ.obj:1: \"solid\" is no OBJ statement; accepted: OBJ text with lines \"v x y z\" and \"f i j k\"",
        ),
        (
            "v 0 0 0\nv 1 zero 0\n",
            "organ.obj:2: vertex coordinate \"zero\" is not accepted; accepted: a finite number",
        ),
        (
            "v 0 0 0\nv 1 nan 0\n",
            "organ.obj:2: vertex coordinate \"nan\" is not accepted; accepted: a finite number",
        ),
        (
            "v 0 0 0\nv 1 1e999 0\n",
            "organ.obj:2: vertex coordinate \"1e999\" is not accepted; accepted: a finite number",
        ),
        ("v 0 0\n", "organ.obj:1: a vertex with 2 coordinates; accepted: v x y z"),
        ("v 0 0 0\nf 1 1\n", "organ.obj:2: a face with 2 corners; accepted: three or more"),
        (
            "v 0 0 0\nf 1 a 1\n",
            "organ.obj:2: face corner \"a\" is not accepted; accepted: a vertex number counted from 1",
        ),
        ("v 0 0 0\n\nf 1 0 1\n", "organ.obj:3: face index 0 names no vertex; accepted: 1 to 1"),
        ("v 0 0 0\nf 1 2 1\n", "organ.obj:2: face index 2 names no vertex; accepted: 1 to 1"),
        ("v 0 0 0\nf 1 -2 1\n", "organ.obj:2: face index -2 names no vertex; accepted: 1 to 1"),
    ];
    for (text, message) in cases {
        assert_eq!(error(text), message);
    }
}

#[test]
fn surfaces_that_enclose_nothing_name_the_line_of_the_fault() {
    let open = TETRAHEDRON.replace("f 3 1 4\n", "");
    let message = error(&open);
    assert!(message.starts_with("organ.obj:"), "{message}");
    assert!(
        message.contains("the surface is open: ") && message.contains("accepted: a closed surface"),
        "{message}"
    );
    assert!(
        message.contains("; vertex 0 is at [0, 0, 0]; vertex 2 is at [0, 0.1, 0]; vertices and triangles"),
        "{message}"
    );

    let non_manifold = format!("{TETRAHEDRON}v 0.2 0.2 0.2\nf 1 2 5\nf 2 1 5\n");
    let message = error(&non_manifold);
    assert!(message.contains("the surface is not manifold: "), "{message}");
    assert!(message.contains("accepted: two triangles at every edge"), "{message}");

    let degenerate = TETRAHEDRON.replace("v 0 0 0.1", "v 0.05 0 0");
    let message = error(&degenerate);
    assert!(
        message.starts_with("organ.obj:6: triangle 1 with the corners [0, 1, 3] is degenerate"),
        "{message}"
    );

    let repeated = TETRAHEDRON.replace("f 1 2 4", "f 1 2 2");
    let message = error(&repeated);
    assert!(message.starts_with("organ.obj:6: triangle 1 has the corners [0, 1, 1]"), "{message}");

    let flipped = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n";
    let message = error(flipped);
    assert!(message.starts_with("organ.obj:5: the surface is flipped: "), "{message}");

    let one_flipped = TETRAHEDRON.replace("f 2 3 4", "f 2 4 3");
    let message = error(&one_flipped);
    assert!(message.contains("in the same direction") && message.starts_with("organ.obj:"), "{message}");

    let unused = format!("{TETRAHEDRON}v 9 9 9\n");
    let message = error(&unused);
    assert!(message.starts_with("organ.obj:9: vertex 4 belongs to no triangle"), "{message}");
    assert!(message.ends_with("; vertices and triangles are counted from 0"), "{message}");
}

#[test]
fn double_vertices_are_not_merged_in_silence_but_pointed_out() {
    // Every face with its own three vertices, as programs write flat shading.
    let corners = ["0 0 0", "0.1 0 0", "0 0.1 0", "0 0 0.1"];
    let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let mut text = String::new();
    for face in faces {
        face.iter().for_each(|corner| text.push_str(&format!("v {}\n", corners[*corner])));
        text.push_str("f -3 -2 -1\n");
    }
    let message = error(&text);
    assert!(message.contains("the surface is open"), "{message}");
    assert!(message.ends_with("8 vertices lie exactly on another one: merge vertices by distance in the program that made the mesh"), "{message}");
}

// ---- the whole body

fn body(mesh: &str, scale: f64) -> Result<Vec<String>, String> {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("organ.obj"), mesh).expect("a file");
    let values = [
        ("body.mesh".to_owned(), Value::String(folder.path().join("organ.obj").display().to_string())),
        ("body.scale".to_owned(), Value::Double(scale)),
    ];
    let scene = Scene::from_values(values, Origin::named("a test")).expect("accepted");
    let shortened = |text: String| text.replace(&format!("{}/", folder.path().display()), "");
    let loaded = scene.load_body().map_err(|error| shortened(error.to_string()))?;
    Ok(loaded.warnings.iter().map(|warning| shortened(warning.to_string())).collect())
}

#[test]
fn a_mesh_in_another_unit_is_a_warning_with_extents_and_a_way_out() {
    assert_eq!(body(TETRAHEDRON, 1.0), Ok(Vec::new()));
    assert_eq!(
        body(TETRAHEDRON, 1000.0),
        Ok(vec![
            "organ.obj: the body is 100.0000 x 100.0000 x 100.0000 m, expected is 0.005 to 2 m; is the mesh in another \
             unit? body.scale: 1.0 would make it a likely size"
                .to_owned()
        ])
    );
    assert_eq!(
        body(TETRAHEDRON, 0.001),
        Ok(vec![
            "organ.obj: the body is 0.0001 x 0.0001 x 0.0001 m, expected is 0.005 to 2 m; is the mesh in another unit? \
             body.scale: 1.0 would make it a likely size"
                .to_owned()
        ])
    );
}

#[test]
fn the_scale_reaches_the_body() {
    let values = [("body.scale".to_owned(), Value::Double(0.5))];
    let scene = Scene::from_values(values, Origin::named("a test")).expect("accepted");
    let loaded = scene.load_body().expect("a liver");
    let [low, high] = loaded.body.mesh().extents();
    assert!(((high - low).x - 0.1).abs() < 0.003, "{}", high - low);
}
