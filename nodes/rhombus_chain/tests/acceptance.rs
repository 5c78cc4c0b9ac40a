//! Which parameters are accepted, and what a refusal says.
#![allow(clippy::expect_used, clippy::panic, reason = "a test whose case cannot be set up fails")]

mod chains;

use chains::{TISSUE, decades, formulations};
use proptest::prelude::*;
use rhombus_chain::{
    Chain, ChainParameters, ContactLaw, Formulation, ParameterError, Spread, SurfaceParameters,
};

fn refusal(formulation: Formulation, parameters: &ChainParameters) -> String {
    Chain::new(2, formulation, parameters).expect_err("refused").to_string()
}

/// Scene name, values that are refused, and how to set one.
type Case<P> = (&'static str, &'static [f64], fn(&mut P, f64));

#[test]
fn a_value_out_of_range_is_refused_by_its_scene_name_with_what_is_accepted() {
    const HALF_PI: f64 = std::f64::consts::FRAC_PI_2;
    let cases: [Case<ChainParameters>; 8] = [
        ("rod_length", &[0.0, -0.01, 1e13], |chain, value| chain.rod_length_m = value),
        ("angle", &[0.0, -0.5, HALF_PI, 2.0], |chain, value| chain.angle_rad = value),
        ("ratio", &[0.0, 1.0, -0.5, 1.5], |chain, value| chain.ratio = value),
        ("normal_stiffness", &[0.0, -1.0, 1e19], |chain, value| chain.normal_stiffness_n_per_m = value),
        ("tangential_stiffness", &[-1.0, -1e-300, 1e19], |chain, value| {
            chain.tangential_stiffness_n_per_m = value
        }),
        ("tangential_growth", &[0.0, -8.0], |chain, value| chain.tangential_growth = value),
        ("weight", &[0.0, -0.5, 1.1], |chain, value| chain.weight = value),
        ("pitch", &[0.0, -0.01], |chain, value| chain.pitch_m = value),
    ];
    for (name, values, set) in cases {
        for &value in values.iter().chain(&[f64::NAN, f64::INFINITY, f64::NEG_INFINITY]) {
            let mut parameters = TISSUE;
            set(&mut parameters, value);
            let message = refusal(Formulation::Energy, &parameters);
            assert!(message.starts_with(&format!("chains.{name}[2] = {value:?}: accepted is ")), "{message}");
        }
    }
}

#[test]
fn units_go_from_one_to_a_million() {
    for (units, accepted) in [(0, false), (1, true), (1_000_000, true), (1_000_001, false)] {
        let parameters = ChainParameters { units, tangential_growth: 1e6, ..TISSUE };
        let result = Chain::new(2, Formulation::Energy, &parameters);
        assert_eq!(result.is_ok(), accepted, "{units} units");
        if let Err(error) = result {
            assert_eq!(error.to_string(), format!("chains.units[2] = {units}: accepted is 1 to 1000000"));
        }
    }
}

#[test]
fn a_ratio_is_checked_even_where_one_unit_does_not_use_it() {
    let parameters = ChainParameters { units: 1, ratio: 1.0, ..TISSUE };
    assert!(refusal(Formulation::Energy, &parameters).starts_with("chains.ratio[2]"));
}

#[test]
fn tangential_springs_that_overflow_are_refused_unless_they_are_not_there() {
    let steep = ChainParameters { tangential_growth: 1e-3, ..TISSUE };
    for formulation in [Formulation::Published, Formulation::Energy] {
        let message = refusal(formulation, &steep);
        for part in [
            "overflows",
            "chains.tangential_growth[2] = 0.001",
            "chains.ratio[2] = 0.8",
            "chains.units[2] = 12",
            "raise",
        ] {
            assert!(message.contains(part), "{part}: {message}");
        }
        let one_unit = ChainParameters { units: 1, ..steep };
        let no_springs = ChainParameters { tangential_stiffness_n_per_m: 0.0, ..steep };
        assert!(Chain::new(0, formulation, &one_unit).is_ok());
        assert!(Chain::new(0, formulation, &no_springs).is_ok());
    }
    // 0.98^2 e^(1/8) > 1, to the power of a million.
    let long = ChainParameters { ratio: 0.98, units: 1_000_000, tangential_growth: 8.0, ..TISSUE };
    assert!(refusal(Formulation::Energy, &long).contains("overflows"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn the_energy_law_is_accepted_exactly_when_k_exceeds_t_times_1_minus_cos_theta(
        angle_rad in 0.01..1.56_f64,
        ratio in 0.01..0.999_f64,
        units in 1..200_u32,
        tangential_growth in 1.0..100.0_f64,
        offset in decades(-9.0, -0.1),
        above in any::<bool>(),
    ) {
        let (mut normal, mut tangential, mut k_t) = (0.0, 0.0, 1.0);
        for unit in 0..units {
            let square = libm::pow(ratio, 2.0 * f64::from(unit));
            normal += square;
            tangential += square * k_t;
            k_t *= libm::exp(1.0 / tangential_growth);
        }
        let half_sine = libm::sin(0.5 * angle_rad);
        let limit = 70.0 * normal / (tangential * 2.0 * half_sine * half_sine);
        let k_t = if above { limit * (1.0 + offset) } else { limit * (1.0 - offset) };
        let parameters = ChainParameters {
            angle_rad, ratio, units, tangential_growth,
            normal_stiffness_n_per_m: 70.0,
            tangential_stiffness_n_per_m: k_t,
            ..TISSUE
        };
        match Chain::new(2, Formulation::Energy, &parameters) {
            Ok(_) => prop_assert!(!above),
            Err(ParameterError::SnapsThrough { most_tangential, least_normal, .. }) => {
                prop_assert!(above);
                prop_assert!((most_tangential / limit - 1.0).abs() < 1e-11);
                prop_assert!((least_normal / (70.0 * k_t / limit) - 1.0).abs() < 1e-11);
            }
            Err(other) => prop_assert!(false, "{other}"),
        }
    }

    #[test]
    fn the_published_law_is_accepted_exactly_when_k_n_exceeds_k_t_tan_squared_theta(
        angle_rad in 0.01..1.56_f64,
        offset in decades(-9.0, -0.1),
        above in any::<bool>(),
    ) {
        let limit = 500.0 / (libm::tan(angle_rad) * libm::tan(angle_rad));
        let k_t = if above { limit * (1.0 + offset) } else { limit * (1.0 - offset) };
        let parameters = ChainParameters { angle_rad, tangential_stiffness_n_per_m: k_t, ..TISSUE };
        match Chain::new(2, Formulation::Published, &parameters) {
            Ok(_) => prop_assert!(!above),
            Err(ParameterError::NotRising { .. }) => prop_assert!(above),
            Err(other) => prop_assert!(false, "{other}"),
        }
    }

    #[test]
    fn whatever_is_not_refused_answers_every_depth(
        formulation in formulations(),
        lengths in (decades(-14.0, 14.0), decades(-14.0, 14.0)),
        angle_rad in prop_oneof![decades(-8.0, 0.5), decades(-8.0, 0.0).prop_map(|rest| std::f64::consts::FRAC_PI_2 - rest)],
        ratio in prop_oneof![decades(-310.0, 0.1), decades(-17.0, 0.0).prop_map(|rest| 1.0 - rest)],
        units in decades(0.0, 6.1),
        stiffness in (decades(-14.0, 20.0), decades(-320.0, 20.0)),
        tangential_growth in decades(-4.0, 8.0),
        depth in -320.0..308.0_f64,
    ) {
        let parameters = ChainParameters {
            rod_length_m: lengths.0,
            angle_rad,
            ratio,
            units: units as u32,
            normal_stiffness_n_per_m: stiffness.0,
            tangential_stiffness_n_per_m: stiffness.1,
            tangential_growth,
            weight: 1.0,
            pitch_m: lengths.1,
        };
        let Ok(law) = ContactLaw::new(formulation, &[parameters]) else { return Ok(()) };
        let (compression, extension) = law.chains()[0].guarded_range_m();
        let size = libm::pow(10.0, depth);
        for depth_m in [size, -size, -0.999 * compression, -1.001 * compression, -0.999 * extension, -1.001 * extension] {
            let response = law.at_depth(depth_m).expect("a finite depth");
            prop_assert!(response.force_n.is_finite() && response.force_n * depth_m >= 0.0, "{:?} at {:e}", response, depth_m);
            prop_assert!(response.stiffness_n_per_m.is_finite() && response.stiffness_n_per_m > 0.0, "{:?} at {:e}", response, depth_m);
            prop_assert!(response.energy_j.is_finite() && response.energy_j >= 0.0, "{:?} at {:e}", response, depth_m);
            if response.force_n.abs() < 1e290 {
                let found_m = law.depth_for_force(response.force_n).expect("a force in reach");
                let answer_n = law.at_depth(found_m).expect("a finite depth").force_n;
                let tolerance = 1e-12 * response.force_n.abs().max(1e-9 * law.rest_stiffness_n_per_m());
                prop_assert!((answer_n - response.force_n).abs() <= tolerance);
            }
        }
    }
}

#[test]
fn a_law_that_would_snap_through_names_both_springs_and_the_ways_out() {
    let parameters = ChainParameters { tangential_stiffness_n_per_m: 4000.0, ..TISSUE };
    let message = refusal(Formulation::Energy, &parameters);
    for part in [
        "chains.tangential_stiffness[2] = 4000.0",
        "chains.normal_stiffness[2] = 500.0",
        "normal_stiffness > 651.88",
        "tangential_stiffness < 306",
        "smaller angle",
        "larger tangential_growth",
        "smaller ratio",
        "fewer units",
    ] {
        assert!(message.contains(part), "{part}: {message}");
    }
    let message = refusal(Formulation::Published, &parameters);
    for part in [
        "published",
        "chains.tangential_stiffness[2] = 4000.0",
        "normal_stiffness > 1333.33",
        "smaller angle",
        "energy",
    ] {
        assert!(message.contains(part), "{part}: {message}");
    }
}

#[test]
fn weights_add_up_to_one() {
    let chain = |weight| ChainParameters { weight, ..TISSUE };
    let law = |weights: &[f64]| {
        let chains: Vec<_> = weights.iter().copied().map(chain).collect();
        ContactLaw::new(Formulation::Energy, &chains)
    };
    assert!(law(&[1.0]).is_ok());
    assert!(law(&[0.1; 10]).is_ok());
    assert!(law(&[0.3, 0.7 + 9e-10]).is_ok());
    let message = law(&[0.3, 0.6]).expect_err("0.9 in all").to_string();
    assert_eq!(
        message,
        "chains.weight: the 2 weights add up to 0.8999999999999999; accepted is 1 within 1e-9"
    );
    assert_eq!(ContactLaw::new(Formulation::Energy, &[]), Err(ParameterError::NoChain));
    assert!(law(&[0.5, -0.5]).expect_err("negative").to_string().starts_with("chains.weight[1] = -0.5"));
}

#[test]
fn words_are_read_back_as_they_are_shown() {
    for formulation in [Formulation::Published, Formulation::Energy] {
        assert_eq!(formulation.to_string().parse(), Ok(formulation));
    }
    for spread in [Spread::Geodesic, Spread::Rings] {
        assert_eq!(spread.to_string().parse(), Ok(spread));
    }
    assert_eq!(
        "energetic".parse::<Formulation>().expect_err("no such law").to_string(),
        "chains.formulation = \"energetic\": accepted is energy or published"
    );
    assert_eq!(
        "".parse::<Spread>().expect_err("no such spread").to_string(),
        "surface.spread = \"\": accepted is geodesic or rings"
    );
}

#[test]
fn surface_parameters_are_checked_by_name() {
    let cases: [Case<SurfaceParameters>; 3] = [
        ("surface.cutoff", &[-0.01, 1.0, f64::NAN], |surface, value| surface.cutoff = value),
        ("surface.expansion", &[-0.01, 1.01, f64::NAN], |surface, value| surface.expansion = value),
        ("probe.contact_radius", &[-0.001, f64::INFINITY, f64::NAN], |surface, value| {
            surface.contact_radius_m = value;
        }),
    ];
    assert_eq!(SurfaceParameters::default().check(), Ok(()));
    for (name, values, set) in cases {
        for &value in values {
            let mut surface = SurfaceParameters::default();
            set(&mut surface, value);
            let message = surface.check().expect_err("refused").to_string();
            assert!(message.starts_with(&format!("{name} = {value:?}: accepted is ")), "{message}");
        }
    }
}
