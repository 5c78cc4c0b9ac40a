//! `rhombus evaluate`, the real executable.
#![expect(clippy::expect_used, reason = "a test may fail here")]

mod common;

use common::{Folder, PAPER};
use serde_json::Value;

fn close(found: &Value, expected: f64) {
    let found = found.as_f64().expect("a number");
    assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{found:e}, expected {expected:e}");
}

/// a, theta, k_n, k_t, q, n, beta, DL -> dl_1, d_theta, dw_1, F published, F energy: 50-digit evaluation.
const GOLDEN: [([f64; 8], [f64; 5]); 3] = [
    (
        [0.01, 0.5235987755982988, 500.0, 100.0, 0.5, 1.0, 1.0, -0.002],
        [-0.002, -0.112081929530811, 0.00100979470413459, -0.941699475574164, -1.04407105398155],
    ),
    (
        [0.01, 0.5235987755982988, 500.0, 100.0, 0.8, 12.0, 10.0, -0.006],
        [
            -0.0012885483697159,
            -0.0729245035346008,
            0.000682564175824871,
            -0.604866323792783,
            -0.406381075179724,
        ],
    ),
    (
        [0.006, 0.9, 300.0, 60.0, 0.9, 30.0, 8.0, 0.008],
        [0.000835414174496438, 0.1216008449901, -0.00119530535892471, 0.160247820117076, 0.275081953369334],
    ),
];

#[test]
fn the_golden_values_of_the_model_to_1e_12() {
    for ([a, theta, k_n, k_t, q, n, beta, elongation_m], [dl_1, d_theta, dw_1, published, energy]) in GOLDEN {
        for (formulation, force) in [("published", published), ("energy", energy)] {
            let text = format!(
                "/**: {{ros__parameters: {{chains: {{formulation: {formulation}, rod_length: [{a:?}], angle: [{theta:?}], \
                 ratio: [{q:?}], units: [{n}], normal_stiffness: [{k_n:?}], tangential_stiffness: [{k_t:?}], \
                 tangential_growth: [{beta:?}]}}}}}}"
            );
            let folder = Folder::new().with("golden.yaml", &text);
            let depth = format!("{:?}", -elongation_m);
            let answer = folder.json(&["evaluate", "golden.yaml", "--depth", &depth, "--json"]);
            close(&answer["force_n"], -force);
            let chain = &answer["chains"][0];
            close(&chain["force_n"], -force);
            close(&chain["dl_1_m"], dl_1);
            close(&chain["d_theta_rad"], d_theta);
            close(&chain["dw_1_m"], dw_1);
            assert_eq!(answer["formulation"], formulation);
            assert_eq!(answer["saturated"], false);
        }
    }
}

#[test]
fn the_keys_come_in_the_documented_order() {
    let folder = Folder::new().with("a.yaml", PAPER);
    let text = folder.success(&["evaluate", "a.yaml", "--depth", "0.003", "--profile", "0,0.01", "--json"]);
    let keys: Vec<&str> = text
        .lines()
        .filter_map(|line| line.trim().strip_prefix('"'))
        .filter_map(|l| l.split('"').next())
        .collect();
    let chain = ["force_n", "dl_1_m", "d_theta_rad", "dw_1_m", "boundary_units"];
    let point = ["s_m", "normal_m", "tangential_m"];
    let mut expected = vec!["depth_m", "force_n", "stiffness_n_per_m", "saturated", "formulation", "chains"];
    expected.extend(chain);
    expected.push("profile");
    expected.extend(point);
    expected.extend(point);
    assert_eq!(keys, expected);
}

#[test]
fn the_force_of_a_depth_gives_the_depth_back() {
    let folder = Folder::new().with("a.yaml", PAPER);
    for depth in [0.004, -0.002] {
        let there = folder.json(&["evaluate", "a.yaml", "--depth", &depth.to_string(), "--json"]);
        let force = there["force_n"].as_f64().expect("a number");
        assert!(force * depth > 0.0, "pressing pushes out, pulling pulls in");
        let back = folder.json(&["evaluate", "a.yaml", "--force", &format!("{force:?}"), "--json"]);
        close(&back["depth_m"], depth);
        close(&back["force_n"], force);
    }
}

#[test]
fn numbers_read_back_to_the_bits_the_library_gives() {
    let folder = Folder::new().with("a.yaml", PAPER);
    let answer = folder.json(&["evaluate", "a.yaml", "--depth", "0.0031", "--json"]);
    let scene = scene::Scene::from_file(&folder.path("a.yaml"), scene::Reader::Everything).expect("accepted");
    let response = scene.law().expect("a law").at_depth(0.0031).expect("finite");
    assert_eq!(answer["force_n"].as_f64().map(f64::to_bits), Some(response.force_n.to_bits()));
    assert_eq!(
        answer["stiffness_n_per_m"].as_f64().map(f64::to_bits),
        Some(response.stiffness_n_per_m.to_bits())
    );
}

#[test]
fn the_profile_starts_with_the_contact_and_ends_at_the_boundary() {
    let folder = Folder::new().with("a.yaml", PAPER);
    let answer = folder.json(&["evaluate", "a.yaml", "--depth", "0.006", "--profile", "0,0.02,9", "--json"]);
    let profile = answer["profile"].as_array().expect("an array");
    let of = |i: usize, key: &str| profile[i][key].as_f64().expect("a number");
    assert_eq!(of(0, "normal_m"), -0.006, "the contact moves inward by exactly the depth");
    assert!(of(1, "normal_m") < 0.0 && of(1, "normal_m") > -0.006);
    assert!(of(1, "tangential_m") > 0.0, "pressed, the surface moves away from the contact");
    assert_eq!((of(2, "normal_m"), of(2, "tangential_m")), (0.0, 0.0));
    let none = folder.json(&["evaluate", "a.yaml", "--depth", "0.006", "--json"]);
    assert_eq!(none["profile"], Value::Array(Vec::new()));
}

#[test]
fn no_mesh_is_loaded() {
    let text = format!("{PAPER}    body.mesh: there_is_no_such_file.obj\n");
    let folder = Folder::new().with("a.yaml", &text);
    folder.success(&["evaluate", "a.yaml", "--depth", "0.001"]);
}

#[test]
fn absurd_depths_are_answered_and_marked() {
    let folder = Folder::new().with("a.yaml", PAPER);
    for depth in ["1e6", "-1e6", "1e300", "-1e300"] {
        let answer = folder.json(&["evaluate", "a.yaml", "--depth", depth, "--profile", "0,1", "--json"]);
        assert_eq!(answer["saturated"], true);
        assert!(answer["force_n"].as_f64().expect("a number").is_finite());
    }
    assert_eq!(folder.json(&["evaluate", "a.yaml", "--depth", "0", "--json"])["force_n"], 0.0);
}

#[test]
fn text_for_people_says_what_the_json_says() {
    let folder = Folder::new().with("a.yaml", PAPER);
    let text = folder.success(&["evaluate", "a.yaml", "--depth", "0.006", "--profile", "0.02"]);
    assert!(text.contains("force          0.604866 N on the hand, published law"), "{text}");
    assert!(text.contains("normal mm"), "{text}");
}

#[test]
fn a_wrong_command_line_is_refused_with_code_2() {
    let folder = Folder::new().with("a.yaml", PAPER);
    let cases: [(&[&str], &str); 9] = [
        (&["evaluate", "a.yaml"], "<--depth <M>|--force <N>>"),
        (&["evaluate", "a.yaml", "--depth", "0.001", "--force", "1"], "cannot be used with"),
        (&["evaluate", "a.yaml", "--depth", "nan"], "accepted: a finite number"),
        (&["evaluate", "a.yaml", "--depth", "-inf"], "accepted: a finite number"),
        (&["evaluate", "a.yaml", "--force", "strong"], "accepted: a finite number"),
        (
            &["evaluate", "a.yaml", "--depth", "0.001", "--profile", "0,-1"],
            "accepted: a finite number >= 0, in m",
        ),
        (
            &["evaluate", "a.yaml", "--depth", "0.001", "--profile", "0,,1"],
            "accepted: a finite number >= 0, in m",
        ),
        (&["evaluate", "--depth", "0.001"], "<PARAMS.yaml>"),
        (&["evaluat", "a.yaml"], "evaluate"),
    ];
    for (arguments, part) in cases {
        let message = folder.refusal(arguments);
        assert!(message.contains(part), "{arguments:?}: {message}");
    }
}

#[test]
fn a_bad_file_is_refused_with_its_name_line_key_and_value() {
    let folder = Folder::new().with("a.yaml", &PAPER.replace("ratio: [0.8]", "ratio: [1.5]"));
    assert_eq!(
        folder.refusal(&["evaluate", "a.yaml", "--depth", "0.001", "--json"]),
        "rhombus: a.yaml:7: chains.ratio: 1.5 is not accepted (entry 0, counted from 0); accepted: array of numbers, \
         one entry for each chain, > 0 and < 1\n"
    );
    assert_eq!(
        folder.refusal(&["evaluate", "b.yaml", "--depth", "0.001"]),
        "rhombus: b.yaml: cannot be read: No such file or directory (os error 2)\n"
    );
}

#[test]
fn a_stiffness_map_is_named_and_not_read() {
    let text = format!("{PAPER}    body.stiffness_map: nodule.csv\n");
    let folder = Folder::new().with("p.yaml", &text);
    let json = folder.json(&["evaluate", "p.yaml", "--depth", "0.006", "--json"]);
    assert_eq!(json["stiffness_map"], "nodule.csv");
    let text = folder.success(&["evaluate", "p.yaml", "--depth", "0.006"]);
    assert!(
        text.ends_with(
            "all for factor 1 of nodule.csv: on the body force and stiffness are multiplied by it\n"
        ),
        "{text}"
    );
}
