//! `rhombus stability`, the real executable.
#![expect(clippy::expect_used, reason = "a test may fail here")]

mod common;

use common::{Folder, PAPER};

fn number(value: &serde_json::Value) -> f64 {
    value.as_f64().expect("a number")
}

fn energy() -> Folder {
    Folder::new().with("a.yaml", &PAPER.replace("published", "energy"))
}

#[test]
fn without_a_device_the_damping_that_one_needs_at_the_scenes_rate_is_stated() {
    let folder = energy();
    let at =
        |rate: &str| folder.json(&["stability", "a.yaml", "--json", "--set", &format!("device.rate={rate}")]);
    let (slow, fast) = (at("1000.0"), at("2000.0"));
    let stiffness = number(&slow["with_grasp"]["stiffness_n_per_m"]);
    let needed = number(&slow["needed_damping_n_s_per_m"]);
    assert!((needed - stiffness * 0.5e-3).abs() <= 1e-12 * needed);
    assert!((number(&fast["needed_damping_n_s_per_m"]) - 0.5 * needed).abs() <= 1e-12 * needed);
    assert_eq!(slow["passive"], serde_json::Value::Null);
    assert!(slow["verdict"].as_str().expect("text").starts_with("cannot be judged"), "{slow}");
}

#[test]
fn a_pull_asks_more_of_a_device_than_a_press_under_the_energy_law_only() {
    let folder = energy().with("b.yaml", PAPER);
    let asked = |file: &str| {
        let report = folder.json(&["stability", file, "--json"]);
        let stiffness = |how: &str| number(&report[how]["stiffness_n_per_m"]);
        (stiffness("pressed_only"), stiffness("with_grasp"), report["with_grasp"]["at"].clone())
    };
    let (pressed, grasped, at) = asked("a.yaml");
    assert!(grasped > 2.0 * pressed && at == "pull", "{pressed} {grasped} {at}");
    let (pressed, grasped, at) = asked("b.yaml");
    assert!(grasped == pressed && at == "press", "{pressed} {grasped} {at}");
}

#[test]
fn a_calibrated_body_asks_for_what_its_stiffest_place_needs() {
    let folder = energy();
    let organ = concat!(env!("CARGO_MANIFEST_DIR"), "/../../config/organ.yaml");
    let stiffness = |more: &[&str]| {
        let report = folder.json(&[&["stability", organ, "--json"], more].concat());
        number(&report["pressed_only"]["stiffness_n_per_m"])
    };
    let (calibrated, even) = (stiffness(&[]), stiffness(&["--set", "body.response=\"\""]));
    assert!((1.3..1.6).contains(&(calibrated / even)), "{calibrated} {even} N/m");
}

#[test]
fn the_rate_the_delay_and_the_device_decide() {
    let folder = energy();
    let passive = |more: &[&str]| {
        let arguments = [&["stability", "a.yaml", "--json", "--device"], more].concat();
        folder.json(&arguments)["passive"].clone()
    };
    assert_eq!(passive(&["simulated"]), true, "20 N s/m");
    assert_eq!(passive(&["simulated", "--delay", "0.1"]), false);
    assert_eq!(passive(&["simulated", "--rate", "10"]), false);
    assert_eq!(passive(&["simulated", "--set", "simulated.damping=0.01"]), false);
    assert_eq!(passive(&["delta.3"]), true);
    assert_eq!(passive(&["touch"]), false);
}

#[test]
fn motors_that_follow_servo_cf_are_a_period_late() {
    let report = energy().json(&[
        "stability",
        "a.yaml",
        "--json",
        "--set",
        "device.force_source=servo_cf",
        "--rate",
        "500",
    ]);
    assert_eq!(number(&report["delay_s"]), 0.002);
    let stiffness = number(&report["with_grasp"]["stiffness_n_per_m"]);
    let needed = number(&report["needed_damping_n_s_per_m"]);
    assert!((needed - stiffness * 1.5 * 0.002).abs() <= 1e-12 * needed);
}

#[test]
fn a_stiffness_map_counts_with_its_largest_factor_and_a_motion_scale_with_itself() {
    let mut factors = "factor\n".to_owned();
    (0..3116).for_each(|vertex| factors.push_str(if vertex == 1234 { "2.5\n" } else { "0.5\n" }));
    let folder = energy().with("map.csv", &factors).with(
        "mapped.yaml",
        &format!("{}    body.stiffness_map: map.csv\n", PAPER.replace("published", "energy")),
    );
    let needed = |arguments: &[&str]| {
        number(&folder.json(&[&["stability", "--json"], arguments].concat())["needed_damping_n_s_per_m"])
    };
    let plain = needed(&["a.yaml"]);
    assert!((needed(&["mapped.yaml"]) - 2.5 * plain).abs() <= 1e-12 * plain);
    assert!((needed(&["a.yaml", "--set", "device.motion_scale=3.0"]) - 3.0 * plain).abs() <= 1e-12 * plain);
}

#[test]
fn the_text_says_depths_bends_damping_and_the_verdict_of_the_json() {
    let folder = energy();
    let text = folder.success(&["stability", "a.yaml", "--device", "falcon"]);
    let json = folder.json(&["stability", "a.yaml", "--device", "falcon", "--json"]);
    for part in [
        "contact law      energy, 1 chain\n",
        "stiffens from",
        "softens from",
        "damping needed   more than",
        "device           falcon: 1.5000 N s/m",
        "Novint",
    ] {
        assert!(text.contains(part), "{part} in\n{text}");
    }
    let verdict = json["verdict"].as_str().expect("text");
    assert!(text.ends_with(&format!("verdict          {verdict}\n")), "{text}");
}

#[test]
fn what_is_not_accepted_is_refused_with_what_is() {
    let folder = energy();
    let error = folder.refusal(&["stability", "a.yaml", "--device", "omega9"]);
    assert!(error.starts_with("rhombus: --device omega9 is not known; accepted: simulated"), "{error}");
    assert!(error.contains("falcon, omega.x, delta.3"), "{error}");
    for (option, value) in
        [("--rate", "0"), ("--rate", "nan"), ("--rate", "-1"), ("--delay", "-0.1"), ("--delay", "inf")]
    {
        let error = folder.refusal(&["stability", "a.yaml", option, value]);
        assert!(error.contains("accepted: "), "{option} {value}: {error}");
    }
    let no_chains = Folder::new().with("a.yaml", "/**: {ros__parameters: {surface.rate: 10.0}}");
    assert!(no_chains.refusal(&["stability", "a.yaml"]).contains("chains: missing"));
}
