//! `rhombus mesh`, the real executable.
#![expect(clippy::expect_used, reason = "a helper that cannot go on stops its test")]

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

/// The factors of a map file.
fn factors(folder: &Folder, name: &str) -> Vec<f64> {
    let text = std::fs::read_to_string(folder.path(name)).expect("a map");
    let mut rows = text.lines().filter(|line| !line.starts_with('#'));
    assert_eq!(rows.next(), Some("factor"));
    rows.map(|row| row.parse().expect("a number")).collect()
}

#[test]
fn a_painted_mesh_becomes_a_stiffness_map() {
    let painted = "v 0 0 0 0 0 0\nv 0.1 0 0 1 1 1\nv 0 0.1 0 0.5 0.5 0.5\nv 0 0 0.1 0 1 0\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    let folder = Folder::new().with("painted.obj", painted);
    let arguments = ["mesh", "stiffness", "painted.obj", "--dark", "1", "--light", "5", "--out", "map.csv"];
    assert_eq!(folder.success(&arguments), "map.csv: 1 to 5 times the contact law\n");
    for (found, expected) in factors(&folder, "map.csv").iter().zip([1.0, 5.0, 3.0, 1.0 + 4.0 * 0.7152]) {
        assert!((found - expected).abs() < 1e-14, "{found} {expected}");
    }
    let unpainted = folder.with("bare.obj", &painted.replace(" 1 1 1\n", "\n"));
    let error = unpainted.refusal(&[
        "mesh",
        "stiffness",
        "bare.obj",
        "--dark",
        "1",
        "--light",
        "5",
        "--out",
        "b.csv",
    ]);
    assert!(
        error.starts_with("rhombus: bare.obj:2: vertex 1 (counted from 0) has no colour; accepted: "),
        "{error}"
    );
    assert!(!unpainted.path("b.csv").exists());
}

#[test]
fn a_ball_by_hand_is_stiff_inside_smooth_at_its_edge_and_1_outside() {
    let folder = Folder::new();
    folder.success(&["mesh", "make", "liver", "-o", "liver.obj"]);
    let site = folder.json(&["mesh", "sites", "liver.obj", "--count", "1", "--json"])[0].clone();
    let at: Vec<f64> = (0..3).map(|k| site["point_m"][k].as_f64().expect("a number")).collect();
    let [x, y, z] = [at[0], at[1], at[2]].map(|x| x.to_string());
    let ball = ["--ball", &x, &y, &z, "0.012", "5"];
    let text = folder.success(&[&["mesh", "stiffness", "liver.obj"][..], &ball, &["-o", "map.csv"]].concat());
    assert_eq!(text, "map.csv: 1 to 5 times the contact law\n");
    let obj = std::fs::read_to_string(folder.path("liver.obj")).expect("a mesh");
    let vertices = obj.lines().filter_map(|line| line.strip_prefix("v "));
    let distances = vertices.map(|line| {
        let p = line.split(' ').map(|word| word.parse::<f64>().expect("a number"));
        p.zip(&at).map(|(p, c)| (p - c).powi(2)).sum::<f64>().sqrt()
    });
    let factors = factors(&folder, "map.csv");
    assert_eq!(factors.len(), 3116);
    let mut between = 0;
    for (distance, factor) in distances.zip(&factors) {
        match distance {
            d if d <= 0.006 => assert!((factor - 5.0).abs() < 1e-12, "{factor} at {d} m"),
            d if d >= 0.018 => assert!((factor - 1.0).abs() < 1e-12, "{factor} at {d} m"),
            d => {
                assert_eq!(d < 0.012, *factor > 3.0, "{factor} at {d} m");
                between += 1;
            }
        }
    }
    assert!(between > 10, "{between}");
    let scene = common::PAPER.to_owned() + "    body: {mesh: liver.obj, stiffness_map: map.csv}\n";
    let folder = folder.with("scene.yaml", &scene);
    let explained = folder.success(&["explain", "scene.yaml"]);
    assert!(
        explained.contains("stiffness map   map.csv: 1 to 5 times the contact law; 149.5 kB"),
        "{explained}"
    );
}

#[test]
fn what_makes_no_stiffness_map_is_refused() {
    let folder = Folder::new();
    for (arguments, message) in [
        (&[][..], "nothing to write: accepted: --dark FACTOR --light FACTOR"),
        (&["--dark", "1", "--light", "5"], "liver: vertex 0 (counted from 0) has no colour"),
        (&["--dark", "0", "--light", "5"], "accepted: a number from 0.001 to 1000"),
        (&["--dark", "1"], "--light"),
        (&["--ball", "9", "9", "9", "0.01", "5"], "accepted: a ball that reaches a vertex"),
        (&["--ball", "0", "0", "0", "-0.01", "5"], "--ball radius -0.01: accepted: a number > 0, in m"),
        (
            &["--ball", "0", "0", "0", "0.1", "5000"],
            "--ball factor 5000: accepted: a number from 0.001 to 1000",
        ),
        (&["--ball", "0", "0", "0", "1"], "5 values"),
        (
            &["--ball", "0", "0", "0", "0.1", "500", "--ball", "0", "0", "0", "0.1", "500"],
            "accepted: a number from 0.001 to 1000",
        ),
    ] {
        let all = [&["mesh", "stiffness", "liver", "--out", "map.csv"], arguments].concat();
        let error = folder.refusal(&all);
        assert!(error.contains(message), "{error}");
        assert!(!folder.path("map.csv").exists());
    }
}
