//! `rhombus calibrate --body`: what is refused before anything runs, interrupted runs, what is written. Python is a double:
//! the finite elements have tests of their own.
#![cfg(unix)]
#![expect(clippy::expect_used, reason = "a test may fail here")]

mod common;

use std::io::Write as _;
use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use common::{Folder, Run};
use glam::DVec3;
use scene::{BodyKind, Obj, Reader, Scene, generate, read_response};

const DOUBLE: &str = include_str!("calibrate_body/double.py");

/// A sphere of 50 mm, held at its lower cap.
const SPHERE: [&str; 14] = [
    "calibrate",
    "--body",
    "sphere.obj",
    "--young",
    "10000",
    "--poisson",
    "0.45",
    "--fixed",
    "plane:0,0,1,-0.03",
    "--sites",
    "24",
    "--python",
    "./python",
    "-o",
];

/// With the double, and a sphere of which every vertex is painted: red below, blue above.
fn folder() -> Folder {
    let folder = Folder::new().with("double.py", DOUBLE).with("sphere.obj", &sphere(1.0));
    let python = "#!/bin/sh\nexec python3 \"$(dirname \"$0\")/double.py\" \"$@\"\n";
    let folder = folder.with("python", python);
    std::fs::set_permissions(folder.path("python"), std::fs::Permissions::from_mode(0o755))
        .expect("executable");
    folder
}

/// OBJ text of a sphere of 50 mm times `scale`.
fn sphere(scale: f64) -> String {
    let shape = generate::body(BodyKind::Sphere, 400);
    let radius = shape.vertices[0].length();
    let lines = shape.vertices.iter().map(|v| {
        let DVec3 { x, y, z } = *v / radius * 0.05 * scale;
        let colour = if z < -0.03 * scale { "1 0 0" } else { "0 0 1" };
        format!("v {x:?} {y:?} {z:?} {colour}\n")
    });
    let faces = shape.triangles.iter().map(|[a, b, c]| format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    lines.chain(faces).collect()
}

/// `SPHERE` with other words in the places of some, and more behind.
fn changed(changes: &[(&str, &str)], more: &[&str]) -> Vec<String> {
    let mut words: Vec<String> =
        SPHERE.iter().chain(&["out.body"]).chain(more).map(ToString::to_string).collect();
    for (option, value) in changes {
        let place = words.iter().position(|word| word == option).expect("an option of SPHERE");
        words[place + 1] = (*value).to_string();
    }
    words
}

fn command(folder: &Folder, words: &[String]) -> Command {
    let mut command = folder.command(&words.iter().map(String::as_str).collect::<Vec<_>>());
    command.env("DOUBLE_RUNS", folder.path("runs"));
    command
}

fn run(command: &mut Command) -> Run {
    let output = command.output().expect("it starts");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    Run {
        code: output.status.code().expect("no signal"),
        stdout: text(output.stdout),
        stderr: text(output.stderr),
    }
}

fn success(command: &mut Command) -> String {
    let run = run(command);
    assert_eq!(run.code, 0, "{}", run.stderr);
    run.stdout
}

fn refusal(command: &mut Command) -> String {
    let run = run(command);
    assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{}", run.stderr);
    run.stderr
}

/// What the double was started for, and which batches it pressed.
fn runs(folder: &Folder) -> Vec<String> {
    let text = std::fs::read_to_string(folder.path("runs")).unwrap_or_default();
    text.lines().filter_map(|line| line.rsplit_once(' ')).map(|(what, _)| what.to_owned()).collect()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

fn written(folder: &Folder) -> [Vec<u8>; 3] {
    ["out.body", "out.yaml", "out.svg"].map(|name| std::fs::read(folder.path(name)).expect("a file"))
}

/// Refused before Python runs and before anything is written.
fn refused_at_once(folder: &Folder, changes: &[(&str, &str)], more: &[&str], words: &[&str]) {
    let before = names(&folder.path("."));
    let said = refusal(&mut command(folder, &changed(changes, more)));
    for word in words {
        assert!(said.contains(word), "{changes:?} {more:?}: {said}");
    }
    assert_eq!(said.lines().count(), 1, "one sentence: {said}");
    assert_eq!(names(&folder.path(".")), before, "{changes:?} {more:?}: nothing is written or run");
}

// ---- what is written

#[test]
fn the_body_a_scene_that_uses_it_and_a_picture_are_written() {
    let folder = folder();
    let said = success(&mut command(&folder, &changed(&[], &[])));
    assert!(
        said.starts_with("out.body written\n") && said.contains("6 chains, 1 harmonics, 8 body modes"),
        "{said}"
    );
    assert!(!folder.path("out.body.work").exists());
    let file = read_response(&folder.path("out.body")).expect("a body");
    assert_eq!((file.parts.chains, file.parts.harmonics, file.parts.modes), (6, 1, 8));
    assert_eq!(file.header.contact_radius_m, 0.005);
    let all = file.header.errors.iter().find(|region| region.region == "all").expect("all");
    assert_eq!((all.sites, all.field), (24, [0.125, 0.24]));
    assert!(all.force[1] < 0.01, "a smooth stiffness is predicted: {:?}", all.force);
    let parts: usize =
        file.header.errors.iter().filter(|region| region.region != "all").map(|region| region.sites).sum();
    assert_eq!(parts, 24);
    let made = file.header.made.join("\n");
    for words in [
        "rhombus calibrate --body sphere.obj --young 10000.0 --poisson 0.45 --fixed plane:0,0,1,-0.03 --sites 24 --contact-radius 0.005",
        "material: E = 10000.0 Pa, nu = 0.45",
        "chosen P 6 H 1 J 8: whole field 10.0 % median, 20.0 % worst, near field 5.00 % median",
    ] {
        assert!(made.contains(words), "{made}");
    }
    // The scene is whole, and gives the stiffness of the presses at their sites.
    let scene = Scene::from_file(&folder.path("out.yaml"), Reader::Everything).expect("a scene");
    let body = scene.load_body().expect("a body").body;
    assert!(body.response().is_some());
    let rest = scene.law().expect("a law").rest_stiffness_n_per_m();
    for (vertex, factor) in file.factors.iter().enumerate() {
        let exact = 100.0 * libm::exp(2.0 * body.mesh().vertices()[vertex].x);
        assert!((rest * f64::from(*factor) / exact - 1.0).abs() < 0.02, "vertex {vertex}");
    }
    let picture = std::fs::read_to_string(folder.path("out.svg")).expect("a picture");
    assert!(picture.starts_with("<svg ") && picture.ends_with("</svg>\n") && picture.contains("out.body"));
}

#[test]
fn the_same_input_gives_the_same_bytes_and_json_says_the_same() {
    let (first, second) = (folder(), folder());
    success(&mut command(&first, &changed(&[], &[])));
    let said = success(&mut command(&second, &changed(&[], &["--json"])));
    assert!(written(&first) == written(&second));
    let said: serde_json::Value = serde_json::from_str(&said).expect("JSON and nothing else");
    assert_eq!(
        (&said["chains"], &said["sites"], &said["written"][0]),
        (&6.into(), &24.into(), &"out.body".into())
    );
    assert!(
        said["errors"].as_array().is_some_and(|errors| errors.iter().any(|region| region["region"] == "all"))
    );
}

#[test]
fn a_region_is_given_by_a_plane_a_box_a_colour_a_list_or_a_direction() {
    let folder = folder();
    let mesh =
        scene::MeshFile::read(&folder.path("sphere.obj")).expect("a mesh").surface(1.0).expect("closed");
    let below = |limit: f64| {
        (0..mesh.vertices().len()).filter(|v| mesh.vertices()[*v].z <= limit).collect::<Vec<_>>()
    };
    let list: Vec<String> = below(-0.03).iter().map(ToString::to_string).collect();
    std::fs::write(folder.path("held.txt"), format!("# the lower cap\n{}\n", list.join(",\n")))
        .expect("a file");
    let facing = mesh.vertex_normals().iter().filter(|n| n.z <= -0.8).count();
    for (region, held) in [
        ("plane:0,0,1,-0.03", list.len()),
        ("box:-1,-1,-1,1,1,-0.03", list.len()),
        ("colour:#ff0000", list.len()),
        ("vertices:held.txt", list.len()),
        ("facing:0,0,-2,0.8", facing),
    ] {
        success(&mut command(&folder, &changed(&[("--fixed", region)], &["--force"])));
        let made = read_response(&folder.path("out.body")).expect("a body").header.made.join("\n");
        assert!(made.contains(&format!("held: {held} of 400 vertices, {region}")), "{made}");
    }
}

#[test]
fn a_second_material_and_a_scale_reach_the_programs_and_the_scene() {
    let folder = folder().with("mm.obj", &sphere(1000.0));
    let more =
        ["--scale", "0.001", "--second-young", "5e4", "--second-region", "ball:0,0,0.02,0.01", "--keep-work"];
    success(&mut command(&folder, &changed(&[("--body", "mm.obj")], &more)));
    let job = std::fs::read(folder.path("out.body.work/job.json")).expect("a job");
    let job: serde_json::Value = serde_json::from_slice(&job).expect("JSON");
    assert_eq!(
        job["second"],
        serde_json::json!({"young_pa": 5e4, "region": {"ball": [0.0, 0.0, 0.02, 0.01]}})
    );
    let scene = Scene::from_file(&folder.path("out.yaml"), Reader::Everything).expect("a scene");
    let [low, high] = scene.load_body().expect("a body").body.mesh().extents();
    assert!((high - low - 0.1).abs().max_element() < 0.002);
}

// ---- what is refused

#[test]
fn a_surface_that_tetrahedra_cannot_fill_is_refused_with_the_place() {
    let folder = folder();
    let whole = sphere(1.0);
    let broken = |name: &str, text: &str, words: &[&str]| {
        std::fs::write(folder.path(name), text).expect("a file");
        refused_at_once(&folder, &[("--body", name)], &[], words);
    };
    let without_last_face = whole.trim_end().rsplit_once('\n').expect("lines").0;
    broken(
        "open.obj",
        without_last_face,
        &["open.obj:", "the surface is open: the edge between vertices", " is at ["],
    );
    broken(
        "flap.obj",
        &format!("{whole}v 0 0 1\nf 1 2 401\nf 2 1 401\n"),
        &["not manifold: the edge", " is at ["],
    );
    let top = (0..400).max_by(|a, b| z(&whole, *a).total_cmp(&z(&whole, *b))).expect("vertices");
    let mut lines: Vec<String> = whole.lines().map(str::to_owned).collect();
    lines[top] = "v 0 0 -0.06 0 0 1".to_owned();
    broken("through.obj", &lines.join("\n"), &["crosses itself: triangles", "meet near ["]);
    let moved = moved(&whole, 0.2, 400);
    broken(
        "two.obj",
        &format!("{whole}{moved}"),
        &["2 separate surfaces (vertex 400", "accepted: one closed surface"],
    );
    broken("text.obj", "nothing\n", &["text.obj:1", "no OBJ statement"]);
    refused_at_once(&folder, &[("--body", "none.obj")], &[], &["none.obj: cannot be read"]);
}

fn z(text: &str, vertex: usize) -> f64 {
    text.lines()
        .nth(vertex)
        .and_then(|line| line.split(' ').nth(3))
        .and_then(|z| z.parse().ok())
        .expect("a vertex")
}

/// The same surface along x, its vertices counted from another number.
fn moved(text: &str, along: f64, from: usize) -> String {
    let line = |line: &str| {
        let words: Vec<&str> = line.split(' ').collect();
        match words[0] {
            "v" => format!("v {:?} {} {}\n", words[1].parse::<f64>().expect("x") + along, words[2], words[3]),
            _ => {
                let corner = |k: usize| words[k].parse::<usize>().expect("a corner") + from;
                format!("f {} {} {}\n", corner(1), corner(2), corner(3))
            }
        }
    };
    text.lines().map(line).collect()
}

/// Changed options, further ones, and what has to be said.
type Case<'a> = (&'a [(&'a str, &'a str)], &'a [&'a str], &'a [&'a str]);

#[test]
fn numbers_that_make_no_sense_are_refused() {
    let folder = folder().with("mm.obj", &sphere(1000.0)).with("held.txt", "3\n400\n");
    let shape = generate::body(BodyKind::Sphere, 400);
    let uncoloured = Obj { comment: "", vertices: &shape.vertices, triangles: &shape.triangles };
    std::fs::write(folder.path("plain.obj"), uncoloured.to_string()).expect("a file");
    let cases: [Case<'_>; 25] = [
        (&[("--young", "0")], &[], &["--young 0; accepted: a finite number greater than 0"]),
        (&[("--young", "-5")], &[], &["--young -5; accepted"]),
        (&[("--young", "inf")], &[], &["--young inf; accepted: a finite"]),
        (&[("--poisson", "0.5")], &[], &["--poisson 0.5; accepted: 0 up to, but not including, 0.5"]),
        (&[("--poisson", "-0.1")], &[], &["--poisson -0.1; accepted"]),
        (&[("--poisson", "nan")], &[], &["--poisson NaN; accepted"]),
        (&[("--body", "mm.obj")], &[], &["is it in another unit? --scale 0.001 makes it a likely size"]),
        (&[], &["--scale", "0.01"], &["accepted: a longest side of 0.005 to 2 m"]),
        (&[("--fixed", "plane:0,0,1,-1")], &[], &["no vertex lies there, so nothing is held"]),
        (&[("--fixed", "plane:0,0,1,1")], &[], &["every vertex lies there, so nothing moves"]),
        (
            &[("--fixed", "vertices:held.txt")],
            &[],
            &["held.txt:2: \"400\"; accepted: vertex numbers from 0 to 399"],
        ),
        (&[("--fixed", "vertices:none.txt")], &[], &["none.txt: cannot be read"]),
        (&[("--fixed", "colour:#ff0000"), ("--body", "plain.obj")], &[], &["the mesh has no vertex colours"]),
        (&[("--fixed", "colour:#00ff00")], &[], &["nothing is held"]),
        (
            &[],
            &["--contact-radius", "0.03"],
            &["--contact-radius 0.03: out of proportion", "accepted: 0.00086 to 0.016"],
        ),
        (&[], &["--contact-radius", "0.0001"], &["--contact-radius 0.0001: out of proportion"]),
        (
            &[("--sites", "11")],
            &[],
            &["--sites 11: too few for 0 harmonics and 0 body modes; accepted: 12 or more"],
        ),
        (
            &[],
            &["--harmonics", "2"],
            &["--sites 24: too few for 2 harmonics", "accepted: 28 or more (12 + 8 H"],
        ),
        (&[("--sites", "241")], &[], &["--sites 241; accepted: up to 240"]),
        (&[], &["--modes", "13"], &["too few for 0 harmonics and 13 body modes; accepted: 26 or more"]),
        (
            &[("--sites", "240")],
            &["--contact-radius", "0.015"],
            &["--sites 240: ", "vertices are 2 contact radii (0.0300 m) or more from where the body is held"],
        ),
        (
            &[],
            &["--second-young", "0", "--second-region", "ball:0,0,0,0.01"],
            &["--second-young 0; accepted"],
        ),
        (&[], &["--second-young", "1", "--second-region", "ball:1,0,0,0.01"], &["no tissue lies there"]),
        (&[], &["--second-young", "1", "--second-region", "plane:0,0,1,1"], &["all of the body lies there"]),
        (
            &[],
            &["--second-young", "1", "--second-region", "colour:#ff0000"],
            &["accepted: plane:NX,NY,NZ,D, box"],
        ),
    ];
    for (changes, more, words) in cases {
        refused_at_once(&folder, changes, more, words);
    }
}

#[test]
fn command_lines_that_do_not_say_enough_or_too_much_are_refused() {
    let folder = folder();
    let refuse = |words: &[&str], said: &str| {
        let words: Vec<String> = words.iter().map(ToString::to_string).collect();
        let found = refusal(&mut command(&folder, &words));
        assert!(found.contains(said), "{words:?}: {found}");
    };
    let start = ["calibrate", "-o", "out.body", "--python", "./python", "--body", "sphere.obj"];
    let with = |more: &[&'static str]| [&start[..], more].concat();
    refuse(&with(&[]), "--young");
    refuse(&with(&["--young", "1e4"]), "--poisson");
    refuse(&with(&["--young", "1e4", "--poisson", "0.4"]), "--body needs --fixed REGION");
    refuse(&with(&["--young", "1e4", "--poisson", "0.4", "--fixed", "floor"]), "accepted: plane:NX,NY,NZ,D");
    refuse(&with(&["--young", "1e4", "--poisson", "0.4", "--table", "a.csv"]), "cannot be used with");
    refuse(&with(&["--young", "1e4", "--poisson", "0.4", "--depth", "0.1"]), "cannot be used with");
    refuse(
        &["calibrate", "--young", "1e4", "--poisson", "0.4", "--fixed", "plane:0,0,1,0", "-o", "o"],
        "--body",
    );
    refuse(
        &[
            "calibrate",
            "--young",
            "1e4",
            "--poisson",
            "0.4",
            "--probe-radius",
            "0.005",
            "--contact-radius",
            "1",
            "-o",
            "o",
        ],
        "and no --contact-radius",
    );
    let mut yaml = changed(&[("-o", "out.yaml")], &[]);
    assert!(refusal(&mut command(&folder, &yaml)).contains("not ending in .yaml, .svg or .work"));
    yaml = changed(&[], &[]);
    for name in ["out.body", "out.yaml", "out.svg"] {
        std::fs::write(folder.path(name), "mine").expect("a file");
        let said = refusal(&mut command(&folder, &yaml));
        assert!(said.contains(&format!("{name} exists; --force replaces it")), "{said}");
        assert_eq!(std::fs::read_to_string(folder.path(name)).expect("a file"), "mine");
        std::fs::remove_file(folder.path(name)).expect("a file");
    }
    assert!(runs(&folder).is_empty());
}

#[test]
fn a_python_without_the_packages_is_refused_with_the_commands_that_make_one() {
    let folder = folder();
    let commands = "python3 -m venv venv && venv/bin/pip install -r tests/reference/requirements.txt";
    let said = refusal(command(&folder, &changed(&[], &[])).env("DOUBLE_WITHOUT", "skfem"));
    assert!(
        said.contains("--python ./python: ")
            && said.contains("No module named 'skfem'")
            && said.contains(commands),
        "{said}"
    );
    let said = refusal(&mut command(&folder, &changed(&[("--python", "./snake")], &[])));
    assert!(said.contains("--python ./snake: cannot be started") && said.contains(commands), "{said}");
    assert!(!folder.path("out.body.work").exists());
}

#[test]
fn what_the_programs_refuse_is_said_and_nothing_is_written() {
    let folder = folder();
    for (fault, words) in [
        ("site", "no mesh around a disc at vertex 7"),
        (
            "killed",
            "press.py: ended by signal 9 (the system may have run out of memory); what it said is in ",
        ),
        ("open", "the model does not accept what was fitted: the shares of the chains at vertex 0"),
    ] {
        let said = refusal(command(&folder, &changed(&[], &[])).env("DOUBLE_FAULT", fault));
        assert!(said.contains(words), "{fault}: {said}");
        assert!(
            !["out.body", "out.yaml", "out.svg"].iter().any(|name| folder.path(name).exists()),
            "{fault}"
        );
        if folder.path("out.body.work").exists() {
            std::fs::remove_dir_all(folder.path("out.body.work")).expect("a folder");
        }
    }
}

// ---- interruptions

#[test]
fn an_interrupted_run_goes_on_with_the_same_command_and_gives_the_same_bytes() {
    let (whole, folder) = (folder(), folder());
    success(&mut command(&whole, &changed(&[], &[])));
    refusal(command(&folder, &changed(&[], &[])).env("DOUBLE_FAULT", "killed"));
    assert_eq!(runs(&folder), ["press.py", "batch 0"]);
    assert!(!folder.path("out.body").exists() && folder.path("out.body.work/press_0.npz").exists());
    success(&mut command(&folder, &changed(&[], &[])));
    let pressed = runs(&folder);
    assert_eq!(pressed.iter().filter(|what| *what == "batch 0").count(), 1, "{pressed:?}");
    assert!(pressed.iter().any(|what| what == "batch 1"), "{pressed:?}");
    assert!(written(&whole) == written(&folder));
}

#[test]
fn an_interrupt_ends_the_program_too_and_the_work_stays() {
    let folder = folder();
    let mut first = command(&folder, &changed(&[], &[]));
    first.env("DOUBLE_FAULT", "slow").stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = first.spawn().expect("it starts");
    let begun = Instant::now();
    while runs(&folder).is_empty() {
        assert!(begun.elapsed() < Duration::from_secs(60), "the double does not start");
        std::thread::sleep(Duration::from_millis(20));
    }
    let signal = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill");
    assert!(signal.success());
    let output = child.wait_with_output().expect("an end");
    let said = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("interrupted; the same command goes on where it was (out.body.work)"), "{said}");
    let runs = std::fs::read_to_string(folder.path("runs")).expect("runs");
    let double = runs.trim().rsplit_once(' ').expect("a process").1;
    assert!(!Path::new("/proc").join(double).exists(), "the double still runs");
    success(&mut command(&folder, &changed(&[], &[])));
    assert!(folder.path("out.body").exists() && !folder.path("out.body.work").exists());
}

#[test]
fn a_work_folder_of_another_calibration_is_left_alone() {
    let folder = folder();
    refusal(command(&folder, &changed(&[], &[])).env("DOUBLE_FAULT", "killed"));
    let before = names(&folder.path("out.body.work"));
    for (changes, key) in [
        (&[("--young", "20000")], "young_pa"),
        (&[("--fixed", "plane:0,0,1,-0.02")], "sites"),
        (&[("--sites", "25")], "batches"),
    ] {
        let said = refusal(&mut command(&folder, &changed(changes, &[])));
        assert!(said.contains("out.body.work: holds the work of another calibration ("), "{key}: {said}");
        assert!(said.contains("differs); accepted: the work folder of this very calibration"), "{said}");
        assert_eq!(names(&folder.path("out.body.work")), before);
    }
    std::fs::remove_dir_all(folder.path("out.body.work")).expect("a folder");
    std::fs::create_dir(folder.path("out.body.work")).expect("a folder");
    std::fs::write(folder.path("out.body.work/thesis.tex"), "mine").expect("a file");
    let said = refusal(&mut command(&folder, &changed(&[], &[])));
    assert!(said.contains("holds thesis.tex, which is no part of a calibration"), "{said}");
    assert_eq!(names(&folder.path("out.body.work")), ["thesis.tex"]);
}

#[test]
fn other_chains_take_no_new_presses_from_work_that_was_kept() {
    let folder = folder();
    success(&mut command(&folder, &changed(&[], &["--keep-work"])));
    let batches = || runs(&folder).iter().filter(|what| what.starts_with("batch")).count();
    let pressed = batches();
    success(&mut command(
        &folder,
        &changed(&[], &["--keep-work", "--force", "--chains", "4", "--modes", "0"]),
    ));
    assert_eq!(batches(), pressed);
    let file = read_response(&folder.path("out.body")).expect("a body");
    assert_eq!((file.parts.chains, file.parts.harmonics, file.parts.modes), (4, 1, 0));
    // A fit of the same choices is there already.
    let fits = || runs(&folder).iter().filter(|what| *what == "fit.py").count();
    assert_eq!(fits(), 2);
    success(&mut command(
        &folder,
        &changed(&[], &["--keep-work", "--force", "--chains", "4", "--modes", "0"]),
    ));
    assert_eq!(fits(), 2);
}

#[test]
fn a_disk_that_fills_leaves_nothing_half_written() {
    let folder = folder();
    // No file may grow beyond so many blocks of 512 bytes; the signal of that is ignored, so writing fails as on a full disk.
    let limited = |blocks: u32| {
        let words = changed(&[], &[]).iter().map(|word| format!("'{word}'")).collect::<Vec<_>>().join(" ");
        let script =
            format!("trap '' XFSZ; ulimit -f {blocks}; exec '{}' {words}", env!("CARGO_BIN_EXE_rhombus"));
        let mut shell = Command::new("/bin/sh");
        shell.args(["-c", &script]).current_dir(folder.path("."));
        refusal(&mut shell)
    };
    // What the programs are given does not fit, then the body.
    let said = limited(20);
    assert!(said.contains("rhombus: out.body.work/") && said.contains(": cannot be written"), "{said}");
    let said = limited(90);
    assert!(
        said.contains("out.svg: cannot be written") || said.contains("out.body: cannot be written"),
        "{said}"
    );
    let left = names(&folder.path("."));
    assert_eq!(left, ["double.py", "out.body.work", "python", "sphere.obj"]);
    success(&mut command(&folder, &changed(&[], &[])));
}

// ---- references that judge

#[test]
fn the_sites_of_a_reference_are_not_used_and_judge_by_the_products_own_field() {
    let folder = folder();
    let mesh =
        scene::MeshFile::read(&folder.path("sphere.obj")).expect("a mesh").surface(1.0).expect("closed");
    // Two sites on the upper half; nothing moves but the site itself, so the errors are known to be large and finite.
    let judges: Vec<usize> = (0..400).filter(|v| mesh.vertices()[*v].z > 0.0).step_by(90).take(2).collect();
    reference(&folder.path("ref.npz"), &mesh, &judges, 0.005);
    success(&mut command(&folder, &changed(&[], &["--held-out", "ref.npz"])));
    let header = read_response(&folder.path("out.body")).expect("a body").header;
    let region = header.errors.iter().find(|region| region.region == "reference sites").expect("judged");
    assert_eq!(region.sites, 2);
    assert!(region.force[1] < 0.02, "its stiffness is that of the presses: {region:?}");
    assert!(region.field[0] > 1.0, "nothing but the contact moves there: {region:?}");
    let used = header.made.iter().find(|line| line.starts_with("sites (24): ")).expect("sites");
    let used: Vec<usize> =
        used["sites (24): ".len()..].split(' ').map(|v| v.parse().expect("a vertex")).collect();
    for judge in &judges {
        let apart = used.iter().map(|v| mesh.vertices()[*v].distance(mesh.vertices()[*judge]));
        assert!(apart.fold(f64::INFINITY, f64::min) > 0.015);
    }
    for (radius_m, more, words) in [
        (0.002, "--held-out", "contact_radius: 0.002 at site 0 (from 0); accepted: 0.005"),
        (0.005, "--held-out", "young: 10000 at site 0 (from 0); accepted: 20000"),
    ] {
        reference(&folder.path("ref.npz"), &mesh, &judges, radius_m);
        let young = if radius_m < 0.005 { "10000" } else { "20000" };
        let said =
            refusal(&mut command(&folder, &changed(&[("--young", young)], &["--force", more, "ref.npz"])));
        assert!(said.contains(words), "{said}");
    }
    let said = refusal(&mut command(
        &folder,
        &changed(&[("--fixed", "plane:0,0,1,-0.02")], &["--force", "--held-out", "ref.npz"]),
    ));
    assert!(
        said.contains("ref.npz: fixed: vertex ") && said.contains("accepted: the same vertices"),
        "{said}"
    );
}

/// A reference whose sites are all held out.
fn reference(path: &Path, mesh: &rhombus_chain::SurfaceMesh, sites: &[usize], radius_m: f64) {
    let mut zip = zip::ZipWriter::new(std::fs::File::create(path).expect("a file"));
    let mut entry = |name: &str, kind: &str, shape: &str, bytes: Vec<u8>| {
        let mut header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}");
        while (10 + header.len()) % 64 != 63 {
            header.push(' ');
        }
        header.push('\n');
        zip.start_file(format!("{name}.npy"), zip::write::SimpleFileOptions::default()).expect("an entry");
        zip.write_all(b"\x93NUMPY\x01\x00").expect("bytes");
        zip.write_all(&(header.len() as u16).to_le_bytes()).expect("bytes");
        zip.write_all(header.as_bytes()).expect("bytes");
        zip.write_all(&bytes).expect("bytes");
    };
    let numbers =
        |values: &mut dyn Iterator<Item = f64>| values.flat_map(f64::to_le_bytes).collect::<Vec<u8>>();
    let (v, t, s) = (mesh.vertices().len(), mesh.triangles().len(), sites.len());
    let vectors = |values: Vec<DVec3>| numbers(&mut values.into_iter().flat_map(|v| v.to_array()));
    entry("vertices", "<f8", &format!("({v}, 3)"), vectors(mesh.vertices().to_vec()));
    let faces = mesh.triangles().iter().flatten().flat_map(|c| c.to_le_bytes()).collect();
    entry("faces", "<i4", &format!("({t}, 3)"), faces);
    let fixed = mesh.vertices().iter().map(|p| u8::from(p.z <= -0.03)).collect();
    entry("fixed", "|u1", &format!("({v},)"), fixed);
    let of_sites = format!("({s},)");
    entry("site_vertex", "<i4", &of_sites, sites.iter().flat_map(|v| (*v as i32).to_le_bytes()).collect());
    entry("point", "<f8", &format!("({s}, 3)"), vectors(sites.iter().map(|v| mesh.vertices()[*v]).collect()));
    entry(
        "normal",
        "<f8",
        &format!("({s}, 3)"),
        vectors(sites.iter().map(|v| mesh.vertex_normals()[*v]).collect()),
    );
    entry("contact_radius", "<f8", &of_sites, numbers(&mut sites.iter().map(|_| radius_m)));
    entry("young", "<f8", &of_sites, numbers(&mut sites.iter().map(|_| 1e4)));
    entry("poisson", "<f8", &of_sites, numbers(&mut sites.iter().map(|_| 0.45)));
    let stiffness = |site: &usize| 100.0 * libm::exp(2.0 * mesh.vertices()[*site].x);
    entry("stiffness", "<f8", &of_sites, numbers(&mut sites.iter().map(stiffness)));
    let moved = sites.iter().flat_map(|site| {
        (0..v).map(move |vertex| if vertex == *site { -mesh.vertex_normals()[vertex] } else { DVec3::ZERO })
    });
    entry("displacement", "<f8", &format!("({s}, {v}, 3)"), vectors(moved.collect()));
    entry("held_out", "|u1", &of_sites, vec![1; s]);
    zip.finish().expect("a whole archive");
}
