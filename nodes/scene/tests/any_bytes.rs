//! Whatever bytes a file holds, reading it ends with a result or an error: never a panic, never without end.
#![expect(clippy::expect_used, reason = "a test may fail here")]

use std::path::Path;

use proptest::prelude::*;
use scene::{MeshFile, Reader, Scene, schema};

fn read_yaml(bytes: &[u8]) {
    let file = tempfile::NamedTempFile::new().expect("a file");
    std::fs::write(file.path(), bytes).expect("written");
    for reader in [Reader::Everything, Reader::Node("/left/deformation")] {
        match Scene::from_file(file.path(), reader) {
            Ok(scene) => drop(scene.law()),
            Err(error) => assert!(error.to_string().starts_with(&file.path().display().to_string())),
        }
    }
}

/// Pieces that parameter files are made of, whole and broken.
fn yaml_pieces() -> impl Strategy<Value = String> {
    let names: Vec<String> = schema().map(|spec| spec.name.to_owned()).collect();
    let piece = prop_oneof![
        proptest::sample::select(names).prop_map(|name| format!("    {name}: ")),
        proptest::sample::select(vec![
            "/**:\n",
            "  ros__parameters:\n",
            "deformation:\n",
            "\n",
            "[",
            "]",
            "{",
            "}",
            ", ",
            "0.5",
            "1",
            "-3",
            ".nan",
            ".inf",
            "1e400",
            "99999999999999999999",
            "true",
            "yes",
            "\"text\"",
            "'",
            "\"",
            "&a ",
            "*a",
            "<<: ",
            "!!str ",
            "!x ",
            "? ",
            ": ",
            "- ",
            "# ",
            "|\n",
            ">\n",
            "---\n",
            "...\n",
            "\t",
            "%YAML 1.1\n",
            "\u{feff}",
            "~",
            "null",
        ])
        .prop_map(str::to_owned),
        "[ -~]{0,6}",
    ];
    proptest::collection::vec(piece, 0..40).prop_map(|pieces| pieces.concat())
}

fn obj_pieces() -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        proptest::sample::select(vec![
            "v ",
            "f ",
            "vn ",
            "o x",
            "\n",
            "\n",
            " 1",
            " 2",
            " 3",
            " 4",
            " -1",
            " 0",
            " 1/2",
            " 1//3",
            " nan",
            " 1e999",
            " 0.5",
            "#",
            "\\\n",
            "\r\n",
            " 99999999999999999999",
            " -9223372036854775808",
            "é",
            "\u{0}",
        ])
        .prop_map(str::to_owned),
        "v [0-9] [0-9] [0-9]\n",
        "f [1-6] [1-6] [1-6]\n",
    ];
    proptest::collection::vec(piece, 0..80).prop_map(|pieces| pieces.concat())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes_are_a_scene_or_an_error(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        read_yaml(&bytes);
    }

    #[test]
    fn any_pieces_of_yaml_are_a_scene_or_an_error(text in yaml_pieces()) {
        read_yaml(text.as_bytes());
        read_yaml(format!("/**:\n  ros__parameters:\n{text}").as_bytes());
    }

    #[test]
    fn any_bytes_are_a_mesh_or_an_error(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        if let Ok(mesh) = MeshFile::parse("any.obj", &bytes) {
            let _ = mesh.inspect();
            let _ = mesh.surface(1.0);
        }
    }

    #[test]
    fn any_pieces_of_obj_are_a_mesh_or_an_error(text in obj_pieces()) {
        if let Ok(mesh) = MeshFile::parse("any.obj", text.as_bytes()) {
            let _ = mesh.inspect();
            let _ = mesh.surface(1e-3);
        }
    }
}

#[test]
fn yaml_that_unfolds_without_end_is_an_error() {
    let mut text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n".to_owned();
    for i in 1..12 {
        let alias = format!("*a{}", i - 1);
        text.push_str(&format!("a{i}: &a{i} [{}]\n", [alias.as_str(); 10].join(", ")));
    }
    read_yaml(text.as_bytes());
    for deep in ["[", "{a: ", "- ", "? ", "a:\n "] {
        read_yaml(deep.repeat(100_000).as_bytes());
    }
}

#[test]
fn a_folder_is_no_file() {
    assert!(Scene::from_file(Path::new("/"), Reader::Everything).is_err());
    assert!(MeshFile::read(Path::new("/")).is_err());
}
