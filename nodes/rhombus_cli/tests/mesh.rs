//! `rhombus mesh`, the real executable.

mod common;

use common::Folder;

#[test]
fn the_default_liver_goes_through_a_file_and_is_accepted() {
    let folder = Folder::new();
    assert_eq!(
        folder.success(&["mesh", "make", "liver", "-o", "liver.obj"]),
        "liver.obj: 3116 vertices, 6228 triangles\n"
    );
    let info = folder.json(&["mesh", "info", "liver.obj", "--json"]);
    assert_eq!((&info["vertices"], &info["triangles"]), (&3116.into(), &6228.into()));
    for key in ["closed", "manifold", "oriented", "accepted"] {
        assert_eq!(info[key], true, "{key}");
    }
    assert_eq!(info["parts"], 1);
    let size = info["extents_m"]["size"][0].as_f64().expect("a number");
    assert!((0.195..0.205).contains(&size), "{size}");
    assert!(info["volume_m3"].as_f64().expect("a number") > 5e-4);
    let built_in = folder.json(&["mesh", "info", "liver", "--json"]);
    assert_eq!(info["volume_m3"], built_in["volume_m3"], "the file has every bit");
}

#[test]
fn any_number_of_vertices_can_be_asked_for() {
    let folder = Folder::new();
    for vertices in ["100", "777", "5001"] {
        let text = folder.success(&["mesh", "make", "liver", "--vertices", vertices, "-o", "a.obj"]);
        assert!(text.starts_with(&format!("a.obj: {vertices} vertices, ")), "{text}");
    }
    assert_eq!(
        folder.success(&["mesh", "make", "block", "--vertices", "501", "-o", "b.obj"]),
        "b.obj: 500 vertices, the nearest to what was asked for, 996 triangles\n"
    );
    assert_eq!(
        folder.refusal(&["mesh", "make", "liver", "--vertices", "50", "-o", "c.obj"]),
        "rhombus: --vertices 50 is not accepted for a liver; accepted: 100 to 4000000\n"
    );
    assert!(!folder.path("c.obj").exists());
}

#[test]
fn info_says_what_is_wrong_with_a_mesh_and_where() {
    let open = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n";
    let folder = Folder::new().with("open.obj", open);
    let info = folder.json(&["mesh", "info", "open.obj", "--json"]);
    assert_eq!(
        (&info["closed"], &info["accepted"], &info["open_edges"]),
        (&false.into(), &false.into(), &3.into())
    );
    assert_eq!(info["volume_m3"], serde_json::Value::Null);
    assert!(info["problem"].as_str().expect("text").starts_with("open.obj:"), "{info}");
    let text = folder.success(&["mesh", "info", "open.obj"]);
    assert!(text.contains("closed     no") && text.contains("accepted   no: open.obj:"), "{text}");
}

#[test]
fn a_file_that_is_no_mesh_is_refused() {
    let folder = Folder::new().with("a.obj", "v 1 2 nan\n");
    assert_eq!(
        folder.refusal(&["mesh", "info", "a.obj"]),
        "rhombus: a.obj:1: vertex coordinate \"nan\" is not accepted; accepted: a finite number\n"
    );
    assert!(folder.refusal(&["mesh", "sites", "b.obj"]).contains("b.obj: cannot be read"));
    assert!(
        folder
            .refusal(&["mesh", "make", "kidney", "-o", "k.obj"])
            .contains("\"liver\" or \"block\" or \"sphere\"")
    );
    assert!(
        folder.refusal(&["mesh", "info", "liver", "--scale", "0"]).contains("accepted: a finite number > 0")
    );
    assert!(
        folder
            .refusal(&["mesh", "make", "liver", "-o", "no/such/folder.obj"])
            .contains("no/such/folder.obj: cannot be written")
    );
}

#[test]
fn sites_are_points_with_outward_unit_normals() {
    let folder = Folder::new();
    let sites = folder.json(&["mesh", "sites", "liver", "--count", "4", "--json"]);
    let sites = sites.as_array().expect("an array");
    assert_eq!(sites.len(), 4);
    for site in sites {
        let normal: f64 = (0..3).map(|k| site["normal"][k].as_f64().expect("a number").powi(2)).sum();
        assert!((normal - 1.0).abs() < 1e-12);
    }
    assert_eq!(folder.success(&["mesh", "sites", "liver", "--count", "4"]).lines().count(), 5);
}
