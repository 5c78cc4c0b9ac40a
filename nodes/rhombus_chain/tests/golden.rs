//! The laws against numbers computed elsewhere: the table of MODEL section 2, and `reference_values.csv`, which
//! `reference_values.py` writes from the definitions with 120 digits.
#![allow(clippy::expect_used, clippy::panic, reason = "a test whose case cannot be set up fails")]

mod chains;

use chains::{TISSUE, assert_close};
use rhombus_chain::{Chain, ChainParameters, ContactLaw, ContactShape, Formulation, SurfaceParameters};

fn chain(formulation: Formulation, parameters: &ChainParameters) -> Chain {
    Chain::new(0, formulation, parameters).expect("a golden chain is accepted")
}

#[test]
fn the_golden_values_of_the_model_are_met_to_1e_12() {
    let one_unit = ChainParameters { units: 1, ..TISSUE };
    let pulled = ChainParameters {
        rod_length_m: 0.006,
        angle_rad: 0.9,
        ratio: 0.9,
        units: 30,
        normal_stiffness_n_per_m: 300.0,
        tangential_stiffness_n_per_m: 60.0,
        tangential_growth: 8.0,
        ..TISSUE
    };
    #[rustfmt::skip]
    let golden = [
        (one_unit, -0.002, [-0.002, -0.112081929530811, 0.00100979470413459, -0.941699475574164, -1.04407105398155]),
        (TISSUE, -0.006, [-0.0012885483697159, -0.0729245035346008, 0.000682564175824871, -0.604866323792783, -0.406381075179724]),
        (pulled, 0.008, [0.000835414174496438, 0.1216008449901, -0.00119530535892471, 0.160247820117076, 0.275081953369334]),
    ];
    for (parameters, elongation_m, [dl_1, d_theta, dw_1, published, energy]) in golden {
        for (formulation, force) in [(Formulation::Published, published), (Formulation::Energy, energy)] {
            let response = chain(formulation, &parameters).response(elongation_m);
            assert_close("dl_1", response.dl_1_m, dl_1, 1e-12);
            assert_close("d_theta", response.d_theta_rad, d_theta, 1e-12);
            assert_close("dw_1", response.dw_1_m, dw_1, 1e-12);
            assert_close("F", response.force_n, force, 1e-12);
            assert!(!response.saturated);
        }
    }
}

/// One row of the reference: inputs, then answers, by column name.
struct Row(Vec<(&'static str, f64)>);

impl Row {
    fn get(&self, column: &str) -> f64 {
        self.0
            .iter()
            .find(|(name, _)| *name == column)
            .map(|(_, value)| *value)
            .expect("a column of the reference")
    }

    fn parameters(&self) -> ChainParameters {
        ChainParameters {
            rod_length_m: self.get("rod_length_m"),
            angle_rad: self.get("angle_rad"),
            ratio: self.get("ratio"),
            units: self.get("units") as u32,
            normal_stiffness_n_per_m: self.get("normal_stiffness"),
            tangential_stiffness_n_per_m: self.get("tangential_stiffness"),
            tangential_growth: self.get("tangential_growth"),
            weight: 1.0,
            pitch_m: 0.013,
        }
    }

    /// `k_n / (k_n - k_t tan^2(theta))`: by how much rounding grows in the published law on the brink of acceptance.
    fn published_amplification(&self) -> f64 {
        let tangent = libm::tan(self.get("angle_rad"));
        let normal = self.get("normal_stiffness");
        normal / (normal - self.get("tangential_stiffness") * tangent * tangent)
    }
}

fn reference() -> impl Iterator<Item = Row> {
    let mut lines = include_str!("reference_values.csv").lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    lines.map(move |line| {
        let values = line.split(',').map(|word| word.parse().expect("a number"));
        Row(header.iter().copied().zip(values).collect())
    })
}

#[test]
fn kinematics_keep_14_digits_from_the_first_atom_to_the_guards() {
    for row in reference() {
        let response = chain(Formulation::Energy, &row.parameters()).response(row.get("elongation_m"));
        assert_close("dl_1", response.dl_1_m, row.get("dl_1_m"), 1e-14);
        assert_close("d_theta", response.d_theta_rad, row.get("d_theta_rad"), 1e-14);
        assert_close("dw_1", response.dw_1_m, row.get("dw_1_m"), 1e-14);
    }
}

#[test]
fn the_energy_law_keeps_13_digits_for_any_ratio_growth_and_number_of_units() {
    for row in reference() {
        let response = chain(Formulation::Energy, &row.parameters()).response(row.get("elongation_m"));
        assert!(!response.saturated);
        assert_close("F", response.force_n, row.get("energy_force_n"), 1e-13);
        assert_close("dF/dDL", response.stiffness_n_per_m, row.get("energy_stiffness"), 1e-13);
        assert_close("E", response.energy_j, row.get("energy_energy_j"), 1e-13);
    }
}

#[test]
fn the_published_law_keeps_13_digits_but_for_what_its_parameters_round_away() {
    for row in reference() {
        let response = chain(Formulation::Published, &row.parameters()).response(row.get("elongation_m"));
        assert!(!response.saturated);
        let relative = 1e-13_f64.max(1e-15 * row.published_amplification());
        assert_close("F", response.force_n, row.get("published_force_n"), relative);
        assert_close("dF/dDL", response.stiffness_n_per_m, row.get("published_stiffness"), relative);
        assert_close("E", response.energy_j, row.get("published_energy_j"), relative);
    }
}

#[test]
fn boundary_and_field_agree_with_their_definitions() {
    for row in reference() {
        let parameters = row.parameters();
        let law = ContactLaw::new(Formulation::Energy, &[parameters]).expect("a golden chain is accepted");
        let surface = SurfaceParameters { cutoff: row.get("cutoff"), ..SurfaceParameters::default() };
        let mut shape = ContactShape::new(&law, &surface).expect("a valid surface");
        shape.set_depth(&law, -row.get("elongation_m")).expect("a finite depth");
        let boundary = row.get("boundary_units");
        // m is a quotient of two logarithms: what counts is its error in q^m.
        let decay = -libm::log(parameters.ratio);
        let allowed = 1e-13 * boundary + 1e-14 / decay;
        assert!((shape.boundary_units(0) - boundary).abs() <= allowed, "m = {boundary}");
        let s_m = row.get("s_over_h") * parameters.pitch_m;
        let moved = shape.displacement(s_m, s_m);
        // An absolute tolerance in shares of the contact's motion: near its boundary the field is a small difference.
        let allowed = 1e-13 * if boundary < f64::from(parameters.units) { 10.0 } else { 1.0 };
        assert!((moved.normal_m - row.get("normal_m")).abs() <= allowed * row.get("elongation_m").abs());
        assert!((moved.tangential_m - row.get("tangential_m")).abs() <= allowed * row.get("dw_1_m").abs());
    }
}
