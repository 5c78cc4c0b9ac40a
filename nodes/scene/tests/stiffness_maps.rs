//! `body.stiffness_map`: what is read, what is refused and where; colours of painted meshes.
#![expect(clippy::expect_used, reason = "a test may fail here")]

use rhombus_chain::SurfacePoint;
use scene::{LoadedBody, MeshFile, Reader, Scene, StiffnessFile};

/// A tetrahedron, outward.
const TETRAHEDRON: &str = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
const SCENE: &str = "/**: {ros__parameters: {body.mesh: organ.obj, body.stiffness_map: map.csv}}\n";

/// What a scene with this map loads, messages without the folder's name.
fn load(map: Option<&[u8]>) -> Result<LoadedBody, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    std::fs::write(path("organ.obj"), TETRAHEDRON).expect("a file");
    std::fs::write(path("scene.yaml"), SCENE).expect("a file");
    if let Some(map) = map {
        std::fs::write(path("map.csv"), map).expect("a file");
    }
    let scene = Scene::from_file(&path("scene.yaml"), Reader::Everything).expect("accepted");
    scene.load_body().map_err(|error| error.to_string().replace(&format!("{}/", folder.path().display()), ""))
}

#[test]
fn one_number_for_each_vertex_in_their_order_beside_the_parameter_file() {
    let loaded =
        load(Some(b"# painted by hand\r\n\r\nfactor\r\n1\r\n0.5\r\n# the tip\r\n 2.5e0 \r\n1000.0\r\n"));
    let body = loaded.expect("accepted").body;
    let map = body.stiffness().expect("a map");
    assert_eq!(map.range(), (0.5, 1000.0));
    for (corner, factor) in [(glam::DVec3::X, 1.0), (glam::DVec3::Y, 2.5), (glam::DVec3::Z, 0.5)] {
        assert_eq!(map.at(&SurfacePoint { face: 0, barycentric: corner }), factor);
    }
}

#[test]
fn without_the_key_there_is_no_map() {
    let scene = Scene::from_values([], scene::Origin::named("a test")).expect("accepted");
    assert_eq!(scene.body.stiffness_map, None);
    assert_eq!(scene.load_body().expect("a liver").body.stiffness(), None);
}

#[test]
fn what_is_written_reads_back_to_the_same_bits() {
    let factors = [1.0 / 3.0, 0.001, 1e3, std::f64::consts::E];
    let text = StiffnessFile { comment: "two\nlines", factors: &factors }.to_string();
    assert!(text.starts_with("# two\n# lines\nfactor\n"), "{text}");
    let body = load(Some(text.as_bytes())).expect("accepted").body;
    let map = body.stiffness().expect("a map");
    // The first corners of faces 0, 2 and 3.
    let at_first_corner = |face| map.at(&SurfacePoint { face, barycentric: glam::DVec3::X });
    assert_eq!([0, 2, 3].map(at_first_corner), [factors[0], factors[1], factors[2]]);
}

#[test]
fn what_is_no_map_of_the_mesh_is_refused_with_file_line_value_and_what_is_accepted() {
    let whole = "accepted: a line \"factor\", then one number from 0.001 to 1000 for each vertex of the mesh, in its order";
    let cases: [(Option<&str>, String); 11] = [
        (None, "map.csv: body.stiffness_map: cannot be read: No such file or directory (os error 2)".to_owned()),
        (Some(""), format!("map.csv: body.stiffness_map: the file is empty; {whole}")),
        (Some("# nothing\n\n"), format!("map.csv: body.stiffness_map: the file is empty; {whole}")),
        (
            Some("1\n1\n1\n1\n"),
            format!("map.csv:1: body.stiffness_map: header \"1\" is not accepted; {whole}"),
        ),
        (
            Some("# c\nfactor,x\n1\n"),
            format!("map.csv:2: body.stiffness_map: header \"factor,x\" is not accepted; {whole}"),
        ),
        (
            Some("factor\n1\n\nstiff\n1\n"),
            "map.csv:4: body.stiffness_map: factor \"stiff\" is not accepted; accepted: a number from 0.001 to 1000"
                .to_owned(),
        ),
        (
            Some("factor\n1\n1,2\n"),
            "map.csv:3: body.stiffness_map: factor \"1,2\" is not accepted; accepted: a number from 0.001 to 1000"
                .to_owned(),
        ),
        (
            Some("factor\n1\n1\n1\n"),
            "map.csv: body.stiffness_map: 3 stiffness factors; accepted: one for each of the mesh's 4 vertices, in their \
             order"
                .to_owned(),
        ),
        (
            Some("factor\n1\n1\n1\n1\n1\n"),
            "map.csv: body.stiffness_map: 5 stiffness factors; accepted: one for each of the mesh's 4 vertices, in their \
             order"
                .to_owned(),
        ),
        (
            Some("factor\n1\n1\n0\n1\n"),
            "map.csv:4: body.stiffness_map: stiffness factor 0 of vertex 2 (counted from 0); accepted: a number from 0.001 \
             to 1000"
                .to_owned(),
        ),
        (
            Some("factor\nnan\n1\n1\n1\n"),
            "map.csv:2: body.stiffness_map: stiffness factor NaN of vertex 0 (counted from 0); accepted: a number from \
             0.001 to 1000"
                .to_owned(),
        ),
    ];
    for (map, message) in cases {
        assert_eq!(load(map.map(str::as_bytes)).expect_err("refused"), message);
    }
    for factor in ["-1", "1001", "0.0009", "inf", "1e999"] {
        let map = format!("factor\n1\n{factor}\n1\n1\n");
        let message = load(Some(map.as_bytes())).expect_err("refused");
        assert!(
            message.starts_with("map.csv:3: body.stiffness_map: ") && message.contains("0.001 to 1000"),
            "{message}"
        );
    }
    assert!(load(Some(b"factor\n1\n\xff\xfe\n1\n1\n")).expect_err("no text").starts_with("map.csv:3: "));
}

#[test]
fn painted_vertices_are_as_light_as_their_colours() {
    let painted = "v 0 0 0 0 0 0\nv 0.1 0 0 1 1 1\nv 0 0.1 0 1 0 0\nv 0 0 0.1 0.5 0.5 0.5\n";
    let faces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    let parse = |vertices: &str| {
        let text = format!("{vertices}{faces}");
        MeshFile::parse("painted.obj", text.as_bytes()).expect("accepted")
    };
    let mesh = parse(painted);
    let luminances = mesh.luminances().expect("painted");
    for (found, expected) in luminances.iter().zip([0.0, 1.0, 0.2126, 0.5]) {
        assert!((found - expected).abs() < 1e-15, "{luminances:?}");
    }
    assert_eq!(mesh.surface(1.0).expect("a surface").vertices()[1], glam::DVec3::X * 0.1);
    let cases = [
        (
            painted.replace(" 1 0 0\n", "\n"),
            "painted.obj:3: vertex 2 (counted from 0) has no colour; accepted: ",
        ),
        (
            painted.replace(" 1 0 0\n", " 1\n"),
            "painted.obj:3: vertex 2 (counted from 0) has no colour; accepted: ",
        ),
        (
            painted.replace("1 1 1", "255 255 255"),
            "painted.obj:2: vertex 1 (counted from 0) has the colour 255 255 255; accepted: v x y z r g b with colours from \
             0 to 1 for every vertex",
        ),
    ];
    for (vertices, message) in cases {
        let error = parse(&vertices).luminances().expect_err("refused").to_string();
        assert!(error.starts_with(message), "{error}");
    }
    assert!(MeshFile::generated(scene::BodyKind::Liver).luminances().is_err());
}
