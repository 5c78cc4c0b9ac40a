//! `rhombus explain` and `rhombus parameters`, the real executable.
#![expect(clippy::expect_used, reason = "a test may fail here")]

mod common;

use std::collections::BTreeSet;
use std::io::Read;
use std::path::Path;
use std::process::Stdio;

use common::{Folder, PAPER};

fn names(list: &serde_json::Value) -> BTreeSet<String> {
    let items = list.as_array().expect("an array");
    items.iter().map(|item| item["part"].as_str().expect("text").to_owned()).collect()
}

#[test]
fn a_scene_is_built_as_its_parameters_say_and_no_part_is_on_both_lists() {
    let bare =
        Folder::new().with("a.yaml", &format!("{PAPER}    surface.rate: 0.0\n    visualization.rate: 0.0\n"));
    let full = Folder::new()
        .with("a.yaml", &format!("{PAPER}    surface.expansion: 0.5\n    clutch.button: \"0\"\n"));
    let (bare, full) =
        (bare.json(&["explain", "a.yaml", "--json"]), full.json(&["explain", "a.yaml", "--json"]));
    for explanation in [&bare, &full] {
        assert!(names(&explanation["built"]).is_disjoint(&names(&explanation["left_out"])));
    }
    for part in ["surface", "boundary", "expansion", "clutch", "viewer", "drawn chains"] {
        assert!(names(&bare["left_out"]).contains(part), "{part}");
        assert!(names(&full["built"]).contains(part), "{part}");
    }
    assert!(bare["bytes"].as_u64() < full["bytes"].as_u64());
}

#[test]
fn the_text_lists_chains_topics_threads_and_memory() {
    let folder = Folder::new().with("a.yaml", PAPER);
    let text = folder.success(&["explain", "a.yaml"]);
    for part in [
        "contact law     published, one chain of 12 units",
        "body            liver, generated: 3116 vertices, 6228 triangles",
        "expansion       surface.expansion is 0",
        "measured_cp           geometry_msgs/PoseStamped",
        "haptic_device   node, motor_loop, publisher",
        "memory of the model: ",
    ] {
        assert!(text.contains(part), "{part} in\n{text}");
    }
}

#[test]
fn a_scene_that_could_not_start_is_refused_with_code_2() {
    let folder = Folder::new()
        .with("a.yaml", "/**: {ros__parameters: {surface.rate: 10.0}}")
        .with("b.yaml", &format!("{PAPER}    body.mesh: organ.obj\n"));
    assert!(
        folder
            .refusal(&["explain", "a.yaml"])
            .starts_with("rhombus: a.yaml: chains: missing; it has no default")
    );
    assert_eq!(
        folder.refusal(&["explain", "b.yaml"]),
        "rhombus: organ.obj: cannot be read: No such file or directory (os error 2)\n"
    );
}

#[test]
fn a_warning_goes_to_stderr_and_into_the_json() {
    let folder = Folder::new().with("a.yaml", &format!("{PAPER}    body.scale: 1000.0\n"));
    let run = folder.run(&["explain", "a.yaml", "--json"]);
    assert_eq!(run.code, 0);
    assert!(run.stderr.starts_with("rhombus: warning: liver: the body is 199."), "{}", run.stderr);
    let explanation: serde_json::Value = serde_json::from_str(&run.stdout).expect("JSON and nothing else");
    assert_eq!(explanation["warnings"].as_array().map(Vec::len), Some(1));
}

#[test]
fn every_topic_of_the_nodes_is_explained_with_its_type_and_no_other() {
    // The nodes' table needs ROS to compile, so it is read as text: `pub const X: Topic<Type> = Topic::new("name", ..)`, or with
    // `topic::NAME` in the place of the name, which is the scene's.
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../node_kit/src/topics.rs");
    let source = std::fs::read_to_string(path).expect("node_kit's topics");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scene/src/topic.rs");
    let names = std::fs::read_to_string(path).expect("the scene's names");
    let name_of = |constant: &str| {
        let (_, value) =
            names.split_once(&format!("pub const {constant}: &str = \"")).expect("a name of the scene");
        value.split_once('"').expect("a text").0.to_owned()
    };
    let nodes: BTreeSet<(String, String)> = source
        .split("pub const ")
        .filter_map(|item| {
            let message = item.split_once(": Topic<")?.1.split_once('>')?.0;
            let name = item.split_once("Topic::new(")?.1.trim_start();
            let name = match name.strip_prefix("topic::") {
                Some(constant) => name_of(constant.split_once(',')?.0),
                None => name.strip_prefix('"')?.split_once('"')?.0.to_owned(),
            };
            Some((name, message.to_owned()))
        })
        .collect();
    assert!(nodes.len() > 10, "{nodes:?}");
    let folder = Folder::new().with("a.yaml", PAPER);
    let explanation = folder.json(&["explain", "a.yaml", "--json"]);
    let explained: BTreeSet<(String, String)> = explanation["topics"]
        .as_array()
        .expect("an array")
        .iter()
        .map(|topic| {
            let text = |key: &str| topic[key].as_str().expect("text").to_owned();
            (text("name"), text("message").rsplit('/').next().expect("a type").to_owned())
        })
        .collect();
    assert_eq!(explained, nodes);
}

#[test]
fn the_parameter_table_has_one_row_for_each_parameter() {
    let folder = Folder::new();
    let table = folder.success(&["parameters", "--markdown"]);
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows.len(), 2 + scene::schema().count());
    for (row, spec) in rows[2..].iter().zip(scene::schema()) {
        assert!(row.starts_with(&format!("| `{}` | {} |", spec.name, spec.kind.in_words())), "{row}");
        assert_eq!(row.replace("\\|", "").matches('|').count(), 9, "{row}");
    }
    let text = folder.success(&["parameters"]);
    assert!(text.contains("surface.cutoff\n    Units whose angle"), "{text}");
}

#[test]
fn a_reader_that_leaves_is_no_error() {
    let folder = Folder::new();
    let mut child = folder
        .command(&["parameters"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    drop(child.stdout.take());
    let mut stderr = String::new();
    child.stderr.take().expect("piped").read_to_string(&mut stderr).expect("UTF-8");
    assert!(child.wait().expect("it ends").success());
    assert_eq!(stderr, "");
}

#[test]
fn help_and_version_are_no_errors_and_no_command_is_one() {
    let folder = Folder::new();
    assert!(folder.success(&["--help"]).contains("evaluate"));
    assert!(folder.success(&["--version"]).starts_with("rhombus "));
    assert!(folder.refusal(&[]).contains("Usage: rhombus"));
}

#[test]
fn drivers_with_a_section_of_their_own_are_explained_each_as_it_reads_the_file() {
    let drivers = "    devices: [left, right]
/left/haptic_device:
  ros__parameters: {device.scene_from_device: [-0.2, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0], device.max_force: 3.0}
/right/haptic_device:
  ros__parameters: {device.backend: serial, device.serial: \"R 7\"}
";
    let folder = Folder::new().with("a.yaml", &format!("{PAPER}{drivers}"));
    let text = folder.success(&["explain", "a.yaml", "--set", "device.rate=500"]);
    for line in [
        "  /left/haptic_device simulated at 500 Hz, at most 3 N, base at [-0.2, 0.0, 0.0] m\n",
        "  /right/haptic_device serial R 7 at 500 Hz, at most 20 N, base at [0.0, 0.0, 0.0] m\n",
        "left/measured_cp",
        "right/servo_cf",
    ] {
        assert!(text.contains(line), "{line} in\n{text}");
    }
    let explanation = folder.json(&["explain", "a.yaml", "--json"]);
    let devices = serde_json::json!([
        {"name": "left", "backend": "simulated"},
        {"name": "right", "backend": "serial"},
    ]);
    assert_eq!(explanation["devices"], devices);
    let found = &explanation["drivers"];
    assert_eq!((&found[0]["node"], &found[0]["max_force_n"]), (&"/left/haptic_device".into(), &3.0.into()));
    assert_eq!((&found[1]["backend"], &found[1]["serial"]), (&"serial".into(), &"R 7".into()));
    let bad = Folder::new().with("a.yaml", &format!("{PAPER}{drivers}").replace("max_force", "max_forse"));
    let message = bad.refusal(&["explain", "a.yaml"]);
    assert!(message.contains("a.yaml:14: device.max_forse: unknown parameter; did you mean"), "{message}");
}

#[test]
fn a_parameter_on_the_command_line_takes_the_place_of_the_files() {
    let folder = Folder::new().with("scene.yaml", PAPER);
    let text =
        folder.success(&["explain", "scene.yaml", "--set", "body.mesh=block", "--set", "surface.rate=0"]);
    assert!(text.contains("block, generated"), "{text}");
    let law =
        folder.json(&["evaluate", "scene.yaml", "--depth", "0.001", "--json", "--set", "chains.units=[3]"]);
    assert_ne!(law, folder.json(&["evaluate", "scene.yaml", "--depth", "0.001", "--json"]));
    for (assignment, said) in [
        ("body.mesh", "KEY=VALUE"),
        ("body.mash=block", "body.mesh"),
        ("surface.cutoff=2.0", "2.0"),
        ("surface.cutoff=\"x\"", "number"),
    ] {
        let refusal = folder.refusal(&["explain", "scene.yaml", "--set", assignment]);
        assert!(refusal.contains(assignment) && refusal.contains(said), "{refusal}");
    }
}
