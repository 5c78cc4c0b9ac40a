//! `rhombus calibrate --table`: known parameters come back from data made with them; bad tables are refused.
#![expect(clippy::expect_used, reason = "a test may fail here")]

mod common;

use std::fmt::Write;

use common::Folder;
use rhombus_chain::{ChainParameters, ContactLaw, ContactShape, Formulation, SurfaceParameters};
use rhombus_cli::calibrate::measured::Measured;
use rhombus_cli::calibrate::table::{ProfilePoint, Table};
use rhombus_cli::calibrate::{Fitted, ForcePoint};

/// A chain of the family that is fitted: a hundred units over sixteen decay lengths of 4 mm, flat at 15 mm.
fn chain(formulation: Formulation) -> ChainParameters {
    let ratio = libm::exp(-0.16);
    let s = (1.0 - ratio.powi(100)) / (1.0 - ratio);
    let angle_rad = 0.8_f64;
    ChainParameters {
        rod_length_m: 0.015 / (2.0 * libm::sin(angle_rad) * s),
        angle_rad,
        ratio,
        units: 100,
        normal_stiffness_n_per_m: 500.0,
        tangential_stiffness_n_per_m: match formulation {
            Formulation::Energy => 1000.0,
            Formulation::Published => 400.0,
        },
        tangential_growth: 20.0,
        weight: 1.0,
        pitch_m: 0.004 * 0.16,
    }
}

fn forces(law: &ContactLaw, depths_mm: impl Iterator<Item = i32>) -> Vec<ForcePoint> {
    let point = |depth_mm: i32| {
        let depth_m = 0.25e-3 * f64::from(depth_mm);
        ForcePoint { depth_m, force_n: law.at_depth(depth_m).expect("finite").force_n }
    };
    depths_mm.map(point).collect()
}

fn surface() -> SurfaceParameters {
    SurfaceParameters { cutoff: 0.0, contact_radius_m: 0.005, ..SurfaceParameters::default() }
}

fn profile(law: &ContactLaw, depth_m: f64) -> Vec<ProfilePoint> {
    let mut shape = ContactShape::new(law, &surface()).expect("a shape");
    shape.set_depth(law, depth_m).expect("finite");
    (0..80)
        .map(|i| {
            let distance_m = 0.5e-3 * f64::from(i);
            ProfilePoint { distance_m, displacement_m: -shape.normal_m(shape.s_m(distance_m)) }
        })
        .collect()
}

fn measured(force: Vec<ForcePoint>, profile: Vec<ProfilePoint>) -> Measured {
    Measured { force, profile, profile_depth_m: None, probe_radius_m: 0.005, contact_radius_m: 0.005 }
}

fn near(found: f64, expected: f64, share: f64) {
    assert!((found / expected - 1.0).abs() < share, "{found}, expected {expected}");
}

/// Repeatable numbers of mean 0 and variance 1.
fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        let mut uniform = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..12).map(|_| uniform()).sum::<f64>() - 6.0
    }
}

#[test]
fn the_parameters_of_a_chain_come_back_from_its_force_and_surface() {
    for formulation in [Formulation::Energy, Formulation::Published] {
        let exact = chain(formulation);
        let law = ContactLaw::new(formulation, &[exact]).expect("a law");
        let measured = measured(forces(&law, -16..=48), profile(&law, 0.004));
        let found = measured.fit(formulation, 1).expect("it fits").chains[0];
        near(found.pitch_m, exact.pitch_m, 1e-4);
        near(found.ratio, exact.ratio, 1e-6);
        near(found.angle_rad, exact.angle_rad, 0.01);
        near(found.rod_length_m, exact.rod_length_m, 0.01);
        near(found.normal_stiffness_n_per_m, exact.normal_stiffness_n_per_m, 0.01);
        near(found.tangential_stiffness_n_per_m, exact.tangential_stiffness_n_per_m, 0.02);
    }
}

#[test]
fn a_percent_of_noise_leaves_the_law_within_half_a_percent() {
    for seed in 0..5 {
        let law = ContactLaw::new(Formulation::Energy, &[chain(Formulation::Energy)]).expect("a law");
        let mut points = forces(&law, -16..=48);
        let exact = points.clone();
        let largest_n = points.iter().map(|point| point.force_n.abs()).fold(0.0, f64::max);
        let mut noise = noise(seed);
        points.iter_mut().for_each(|point| point.force_n += 0.01 * largest_n * noise());
        let found =
            measured(points, Vec::new()).fit(Formulation::Energy, 1).expect("it fits").law().expect("a law");
        let error = |point: &ForcePoint| {
            ((found.at_depth(point.depth_m).expect("finite").force_n - point.force_n) / largest_n).powi(2)
        };
        let rms = (exact.iter().map(error).sum::<f64>() / exact.len() as f64).sqrt();
        assert!(rms < 0.005, "seed {seed}: {rms}");
    }
}

#[test]
fn two_shapes_come_back_from_their_sum() {
    let base = chain(Formulation::Energy);
    let steep = ChainParameters { pitch_m: 0.002 * 0.16, weight: 0.7, ..base };
    let wide = ChainParameters { pitch_m: 0.012 * 0.16, weight: 0.3, ..base };
    let law = ContactLaw::new(Formulation::Energy, &[steep, wide]).expect("a law");
    let fitted = measured(Vec::new(), profile(&law, 0.003)).fit(Formulation::Energy, 2).expect("it fits");
    for (found, exact) in fitted.chains.iter().zip([steep, wide]) {
        near(found.pitch_m, exact.pitch_m, 1e-3);
        near(found.weight, exact.weight, 1e-3);
    }
    let noted = |name: &str| fitted.notes.iter().any(|note| note.contains(name));
    assert!(noted("chains.normal_stiffness"), "a surface alone tells no force: {:?}", fitted.notes);
}

#[test]
fn what_the_data_do_not_tell_is_named_and_has_its_default() {
    let straight = |depths_mm: std::ops::RangeInclusive<i32>| -> Fitted {
        let force = |mm: i32| ForcePoint { depth_m: 1e-3 * f64::from(mm), force_n: 0.3 * f64::from(mm) };
        measured(depths_mm.map(force).collect(), Vec::new()).fit(Formulation::Energy, 2).expect("it fits")
    };
    let noted = |fitted: &Fitted, name: &str| fitted.notes.iter().any(|note| note.contains(name));
    let pressed = straight(0..=8);
    for name in
        ["chains.tangential_stiffness", "chains.tangential_growth", "chains.angle", "chains.rod_length"]
    {
        assert!(noted(&pressed, name), "{name}: {:?}", pressed.notes);
    }
    assert!(noted(&pressed, "no point is pulled") && noted(&pressed, "chains.weight"));
    assert!(pressed.chains.iter().all(|chain| chain.tangential_stiffness_n_per_m == 0.0));
    near(pressed.law().expect("a law").rest_stiffness_n_per_m(), 300.0, 1e-6);
    assert!(!noted(&straight(-4..=8), "no point is pulled"));

    let law = ContactLaw::new(Formulation::Energy, &[chain(Formulation::Energy)]).expect("a law");
    let curved = measured(forces(&law, -16..=48), Vec::new()).fit(Formulation::Energy, 1).expect("it fits");
    assert!(
        !noted(&curved, "chains.angle") && !noted(&curved, "chains.tangential_stiffness"),
        "{:?}",
        curved.notes
    );
    // One exponential does not tell two.
    let surface = measured(Vec::new(), profile(&law, 0.004)).fit(Formulation::Energy, 2).expect("it fits");
    assert!(
        surface.notes.iter().any(|note| note.contains("the data do not tell 1 of 2")),
        "{:?}",
        surface.notes
    );
}

#[test]
fn every_law_that_is_fitted_to_whatever_was_measured_is_acceptable() {
    for seed in 0..40 {
        let mut noise = noise(seed);
        let force = |i: i32| ForcePoint {
            depth_m: 1e-3 * f64::from(i),
            force_n: f64::from(i) * (1.0 + 0.5 * noise()) + noise(),
        };
        let points: Vec<ForcePoint> = (-5..=10).map(force).collect();
        for formulation in [Formulation::Energy, Formulation::Published] {
            if let Ok(fitted) = measured(points.clone(), Vec::new()).fit(formulation, 1 + seed as usize % 4) {
                fitted.tissue().expect("the model accepts it");
            }
        }
    }
}

#[test]
fn a_table_in_millimetres_is_read_and_its_law_written() {
    let law = ContactLaw::new(Formulation::Energy, &[chain(Formulation::Energy)]).expect("a law");
    let mut table = "# a bench\n\ndepth [mm], force [mN],distance [cm],displacement [um]\n".to_owned();
    let (forces, profile) = (forces(&law, 0..=40), profile(&law, 0.004));
    for (i, point) in profile.iter().enumerate() {
        let surface = format!("{:?},{:?}", 1e2 * point.distance_m, 1e6 * point.displacement_m);
        match forces.get(i) {
            Some(force) => {
                writeln!(table, "{:?},{:?},{surface}", 1e3 * force.depth_m, 1e3 * force.force_n)
                    .expect("a row");
            }
            None => writeln!(table, ",,{surface}").expect("a row"),
        }
    }
    let folder = Folder::new().with("data.csv", &table);
    let said =
        folder.json(&["calibrate", "--table", "data.csv", "--chains", "1", "-o", "out.yaml", "--json"]);
    for reached in said["reached"].as_array().expect("errors") {
        assert!(reached["relative"].as_f64().expect("a number") < 1e-3, "{said}");
    }
    let at = folder.json(&["evaluate", "out.yaml", "--depth", "0.006", "--profile", "0.004", "--json"]);
    near(at["force_n"].as_f64().expect("a number"), law.at_depth(0.006).expect("finite").force_n, 2e-3);
    near(at["profile"][0]["normal_m"].as_f64().expect("a number"), -0.006 * libm::exp(-1.0), 1e-3);
}

#[test]
fn bad_tables_are_refused_with_line_value_and_what_is_accepted() {
    let rows = "0,0\n1,0.1\n2,0.2\n3,0.3\n4,0.4\n5,0.5\n";
    let with = |header: &str, rows: &str| format!("{header}\n{rows}");
    let force = "depth [mm],force [N]";
    let cases = [
        (String::new(), "data.csv: the table is empty; accepted: depth [mm],force [N]"),
        (with("depth,force [N]", rows), "data.csv:1: column \"depth\" has no unit in brackets"),
        (with("depth [inch],force [N]", rows), "data.csv:1: unit \"inch\" of depth is not known; accepted:"),
        (with("depth [mm],force [mm]", rows), "unit \"mm\" of force is not known"),
        (with("depth [mm],torque [N]", rows), "data.csv:1: column \"torque [N]\" is not known"),
        (with("depth [mm],distance [mm]", rows), "column depth without force"),
        (with("depth [mm],depth [mm],force [N]", rows), "column depth is there twice"),
        (with(force, "0,0\n1,\n2,0.2\n"), "data.csv:3: force is missing"),
        (with(force, "0,0\n,\n2,0.2\n"), "data.csv:3: depth and force are missing"),
        (with(force, "0,0\n1\n2,0.2\n"), "data.csv:3: 1 cells; accepted: 2"),
        (with(force, "0,0\n1,soft\n2,0.2\n"), "data.csv:3: force = \"soft\" is not a number"),
        (
            with(force, "0,0\n1,inf\n2,0.2\n"),
            "data.csv:3: force = \"inf\" is not a number; accepted: a finite number",
        ),
        (
            with(force, "0,0\n2,0.2\n1,0.1\n"),
            "data.csv:4: depth 0.001 m comes after 0.002 m; accepted: rows sorted",
        ),
        (
            with(force, "0,0\n1,0.1\n2,-0.2\n3,0.3\n4,0.4\n"),
            "data.csv:4: force -0.2 N at depth 0.002 m has the wrong sign",
        ),
        (with(force, "0,0\n1,0.1\n"), "data.csv: 2 measured depths and forces; accepted: 5 or more"),
        (with(force, ""), "data.csv: nothing was measured"),
        (
            with("distance [mm],displacement [mm]", "-1,3\n0,3\n"),
            "data.csv:2: distance -0.001 m; accepted: 0 or more",
        ),
        (
            with("distance [mm],displacement [mm]", "0,3\n4,3\n6,2\n5,1\n"),
            "data.csv:5: distance 0.005 m comes after",
        ),
        (
            with("distance [mm],displacement [mm]", "0,3\n6,2\n8,1\n"),
            "2 points of the surface outside the contact; accepted: 7",
        ),
        (
            with("distance [mm],displacement [mm]", "6,2\n8,1\n9,1\n10,1\n11,1\n12,1\n13,1\n"),
            "--profile-depth",
        ),
        (
            with("distance [mm],displacement [mm]", "0,-3\n6,-2\n8,-1\n"),
            "displacement is positive into the body",
        ),
    ];
    for (table, expected) in cases {
        let folder = Folder::new().with("data.csv", &table);
        let said = folder.refusal(&["calibrate", "--table", "data.csv", "-o", "out.yaml"]);
        assert!(said.contains(expected), "{table:?}\n{said}\nexpected {expected:?}");
        assert!(!folder.path("out.yaml").exists());
    }
    let folder = Folder::new().with("data.csv", &with(force, rows));
    for (option, value) in [("--probe-radius", "0"), ("--contact-radius", "nan"), ("--contact-radius", "5")] {
        let said = folder.refusal(&["calibrate", "--table", "data.csv", "-o", "out.yaml", option, value]);
        assert!(said.contains("data.csv: ") && said.contains("accepted: 1e-6 to 1, in m"), "{said}");
    }
    let said = Folder::new().refusal(&["calibrate", "--table", "none.csv", "-o", "out.yaml"]);
    assert!(said.contains("none.csv: cannot be read"), "{said}");
}

#[test]
fn a_table_is_read_in_si() {
    let table = Table::parse("t", "force [kN],depth [cm]\n0.001,2\n").expect("a table");
    assert_eq!(table.force, [ForcePoint { depth_m: 0.02, force_n: 1.0 }]);
}
