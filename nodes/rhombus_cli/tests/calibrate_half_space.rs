//! `rhombus calibrate --young`: an elastic half-space, whose answer is known in closed form.
#![expect(clippy::expect_used, reason = "a test may fail here")]

mod common;

use common::Folder;
use rhombus_chain::{ContactShape, Formulation};
use rhombus_cli::calibrate::Fitted;
use rhombus_cli::calibrate::half_space::{self, Contact, HalfSpace};
use scene::{Reader, Scene};

const YOUNG: [&str; 7] = ["calibrate", "--young", "10000", "--poisson", "0.45", "--probe-radius", "0.005"];

fn fitted(half_space: &HalfSpace, formulation: Formulation, chains: usize) -> Fitted {
    half_space::fit(half_space, formulation, chains).expect("it fits")
}

#[test]
fn the_flat_punch_to_27_7_2_and_1_percent_with_1_to_4_chains() {
    let punch = HalfSpace::flat(10e3, 0.45, 0.005);
    for (chains, most) in [(1, 0.27), (2, 0.07), (3, 0.02), (4, 0.01)] {
        let fitted = fitted(&punch, Formulation::Energy, chains);
        // By the model and the closed form alone, without the calibration's own error.
        let law = fitted.law().expect("a law");
        let mut shape = ContactShape::new(&law, &fitted.surface).expect("a shape");
        shape.set_depth(&law, 0.002).expect("finite");
        let (mut error, mut all) = (0.0, 0.0);
        for i in 0..400 {
            let r = 0.1 * f64::from(i) / 399.0;
            let exact = if r <= 0.005 { 1.0 } else { 2.0 / std::f64::consts::PI * (0.005 / r).asin() };
            error += (-shape.normal_m(shape.s_m(r)) / 0.002 - exact).powi(2);
            all += exact * exact;
        }
        let error = (error / all).sqrt();
        assert!(error <= most, "{chains} chains leave {error}");
        let said = half_space::profile_error(&punch, &fitted).expect("a law");
        assert!((said - error).abs() < 1e-9, "it says {said}, it is {error}");
    }
}

#[test]
fn more_chains_never_fit_worse() {
    let punch = HalfSpace::flat(1e3, 0.3, 0.002);
    let errors: Vec<f64> = (1..=5)
        .map(|chains| {
            half_space::profile_error(&punch, &fitted(&punch, Formulation::Energy, chains)).expect("a law")
        })
        .collect();
    assert!(errors.windows(2).all(|pair| pair[1] <= pair[0] * 1.001), "{errors:?}");
}

#[test]
fn the_force_of_the_flat_punch_is_exact_at_every_depth_under_both_laws() {
    let punch = HalfSpace::flat(25e3, 0.3, 0.003);
    for formulation in [Formulation::Energy, Formulation::Published] {
        let law = fitted(&punch, formulation, 3).law().expect("a law");
        for depth_m in [-0.004, 0.001, 0.003, 0.02] {
            let exact_n = 2.0 * 25e3 / (1.0 - 0.09) * 0.003 * depth_m;
            let force_n = law.at_depth(depth_m).expect("finite").force_n;
            assert!((force_n - exact_n).abs() < 1e-9 * exact_n.abs(), "{force_n} N, exact {exact_n} N");
        }
    }
}

#[test]
fn hertz_is_followed_by_the_published_law_and_by_the_energy_law_as_a_straight_line_only() {
    let sphere = HalfSpace { contact: Contact::Sphere, ..HalfSpace::flat(10e3, 0.45, 0.005) };
    let force = |fitted: Fitted| fitted.reached.last().expect("the force").relative;
    assert!(force(fitted(&sphere, Formulation::Published, 2)) < 0.005);
    let energy = fitted(&sphere, Formulation::Energy, 2);
    assert!(energy.chains.iter().all(|chain| chain.tangential_stiffness_n_per_m == 0.0));
    // The best straight line through 0 under d^1.5 leaves 1/7 (integrals of d^3, d^2.5, d^2).
    assert!((force(energy) - 1.0 / 7.0).abs() < 0.002);
}

#[test]
fn the_shape_scales_with_the_probe_and_does_not_depend_on_the_material() {
    let small = fitted(&HalfSpace::flat(1e3, 0.2, 0.001), Formulation::Energy, 3);
    let large = fitted(&HalfSpace::flat(1e6, 0.49, 0.02), Formulation::Energy, 3);
    for (a, b) in small.chains.iter().zip(&large.chains) {
        assert!((b.pitch_m / a.pitch_m / 20.0 - 1.0).abs() < 1e-3, "{} {}", a.pitch_m, b.pitch_m);
        assert!((b.weight / a.weight - 1.0).abs() < 1e-3);
    }
}

#[test]
fn the_written_file_is_a_scene_with_the_fitted_chains_and_the_error_at_its_top() {
    let folder = Folder::new();
    let said = folder.success(&[&YOUNG[..], &["--chains", "4", "-o", "out.yaml"]].concat());
    assert!(said.contains("out.yaml written"), "{said}");
    let text = std::fs::read_to_string(folder.path("out.yaml")).expect("a file");
    let header: Vec<&str> = text.lines().take_while(|line| line.starts_with('#')).collect();
    assert!(header.iter().any(|line| line.contains("0.6") && line.contains("flat punch")), "{text}");
    assert!(header.iter().any(|line| line.contains("chains.tangential_growth")), "{text}");

    let scene = Scene::from_file(&folder.path("out.yaml"), Reader::Everything).expect("a scene");
    let punch = HalfSpace::flat(10e3, 0.45, 0.005);
    let fitted = fitted(&punch, Formulation::Energy, 4);
    assert_eq!(scene.chains.as_ref().expect("chains").chains, fitted.chains, "in every bit");
    assert_eq!(scene.surface_parameters(), fitted.surface);
    assert_eq!(scene.probe.radius_m, 0.005);

    let force = folder.json(&["evaluate", "out.yaml", "--depth", "0.003", "--json"]);
    let exact_n = 2.0 * 10e3 / (1.0 - 0.45 * 0.45) * 0.005 * 0.003;
    assert!((force["force_n"].as_f64().expect("a number") - exact_n).abs() < 1e-9);
    folder.success(&["explain", "out.yaml"]);
}

#[test]
fn a_file_that_exists_is_replaced_only_when_asked_and_nothing_else_is_left() {
    let folder = Folder::new().with("out.yaml", "mine\n");
    let said = folder.refusal(&[&YOUNG[..], &["-o", "out.yaml"]].concat());
    assert!(said.contains("out.yaml exists; --force replaces it"), "{said}");
    assert_eq!(std::fs::read_to_string(folder.path("out.yaml")).expect("a file"), "mine\n");
    folder.success(&[&YOUNG[..], &["-o", "out.yaml", "--force"]].concat());
    assert!(std::fs::read_to_string(folder.path("out.yaml")).expect("a file").contains("normal_stiffness"));
    let left: Vec<_> = std::fs::read_dir(folder.path(".")).expect("a folder").collect();
    assert_eq!(left.len(), 1, "{left:?}");
}

#[test]
fn what_makes_no_sense_is_refused_with_what_is_accepted() {
    let folder = Folder::new();
    let cases: [(&[&str], &str); 6] = [
        (&["--young", "-1", "--poisson", "0.3", "--probe-radius", "0.005"], "young = -1; accepted"),
        (&["--young", "0", "--poisson", "0.3", "--probe-radius", "0.005"], "young = 0"),
        (&["--young", "1e4", "--poisson", "0.6", "--probe-radius", "0.005"], "greater than -1, up to 0.5"),
        (&["--young", "1e4", "--poisson", "0.3"], "--probe-radius"),
        (&["--young", "1e4", "--poisson", "0.3", "--probe-radius", "nan"], "probe-radius = NaN"),
        (
            &["--young", "1e4", "--poisson", "0.3", "--probe-radius", "0.005", "--chains", "9"],
            "accepted: 1 to 8",
        ),
    ];
    for (arguments, expected) in cases {
        let said = folder.refusal(&[&["calibrate", "-o", "out.yaml"], arguments].concat());
        assert!(said.contains(expected), "{arguments:?}: {said}");
        assert!(!folder.path("out.yaml").exists());
    }
    let said = folder.refusal(&["calibrate", "-o", "out.yaml"]);
    assert!(said.contains("--young") && said.contains("--reference"), "{said}");
}
