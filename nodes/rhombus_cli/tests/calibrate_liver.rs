//! The liver, calibrated on the committed finite-element references and judged at sites that were never used.
#![expect(clippy::expect_used, reason = "a test may fail here")]

use std::path::PathBuf;

use rhombus_cli::calibrate::errors::{SiteError, median};
use rhombus_cli::calibrate::sites;
use rhombus_cli::reference::Reference;
use scene::{Origin, Scene, Value};

fn reference() -> Reference {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tests/reference/results/liver_r5.npz");
    Reference::read(&file).expect("the committed references")
}

fn force(errors: &[SiteError]) -> Vec<f64> {
    errors.iter().map(|error| error.force_rel).collect()
}

#[test]
fn the_map_gives_the_force_at_held_out_sites_to_2_5_percent_and_better_than_a_constant() {
    let reference = reference();
    let found = sites::fit(&reference, 1, true).expect("it fits");
    let constant = sites::fit(&reference, 1, false).expect("it fits");
    let (mapped, plain) = (force(&found.held_out), force(&constant.held_out));
    let worst = |errors: &[f64]| errors.iter().copied().fold(0.0, f64::max);
    assert!(median(mapped.clone()) <= 0.025 && worst(&mapped) <= 0.13, "{mapped:?}");
    assert!(
        median(mapped.clone()) < median(plain.clone()) && worst(&mapped) < worst(&plain),
        "{mapped:?} {plain:?}"
    );
}

/// One shape for every site and direction cannot follow an organ closer than `least_near`; three chains come that near.
#[test]
fn three_chains_leave_hardly_more_near_the_contact_than_any_single_shape_must() {
    let found = sites::fit(&reference(), 3, false).expect("it fits");
    let square: f64 = found.used.iter().map(|error| error.near_rel_l2 * error.near_rel_l2).sum();
    let rms = (square / found.used.len() as f64).sqrt();
    assert!(rms >= 0.99 * found.least_near && rms < 1.05 * found.least_near, "{rms}, {}", found.least_near);
}

/// What a reach leaves out is far away: the surface near the contact is followed as well as before.
#[test]
fn a_reach_ends_the_surface_and_costs_little_near_the_contact() {
    let reference = reference();
    let near = |errors: &[SiteError]| median(errors.iter().map(|error| error.near_rel_l2).collect());
    let whole = sites::fit(&reference, 3, false).expect("it fits");
    let within = sites::fit_within(&reference, 3, false, 0.060).expect("it fits");
    for chain in &within.chains {
        let reach_m = chain.pitch_m * f64::from(chain.units);
        assert!(reach_m <= 0.060 * (1.0 + 1e-12), "{reach_m} m");
    }
    assert!(whole.chains.iter().any(|chain| chain.pitch_m * f64::from(chain.units) > 0.060));
    assert!(near(&within.used) < 1.05 * near(&whole.used));
    let refused = sites::fit_within(&reference, 3, false, 0.0).expect_err("no reach");
    assert_eq!(refused.to_string(), "reach = 0; accepted: greater than 0, m");
}

#[test]
fn the_references_are_of_the_liver_that_a_scene_names() {
    let liver = [("body.mesh".to_owned(), Value::String("liver".to_owned()))];
    let scene = Scene::from_values(liver, Origin::named("liver")).expect("a scene");
    let body = scene.load_body().expect("a body").body;
    reference().check_mesh(body.mesh()).expect("the same mesh");
}
