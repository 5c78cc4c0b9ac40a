//! The table agrees with itself.

use std::collections::BTreeSet;

use scene::schema::{nearest_name, spec};
use scene::{DefaultValue, Origin, Parameters, Scene, Value, schema};

#[test]
fn every_name_is_there_once_in_lower_case_and_has_a_node_and_a_meaning() {
    let mut names = BTreeSet::new();
    for spec in schema() {
        assert!(names.insert(spec.name), "{} twice", spec.name);
        assert!(spec.name.chars().all(|c| c.is_ascii_lowercase() || matches!(c, '.' | '_')), "{}", spec.name);
        assert!(!spec.owners.is_empty(), "{}", spec.name);
        assert!(spec.help.ends_with('.'), "{}: {}", spec.name, spec.help);
    }
}

#[test]
fn every_default_is_accepted_by_its_own_row() {
    for spec in schema() {
        if let Some(value) = spec.default.value() {
            let values = [(spec.name.to_owned(), value.clone())];
            let kept = Parameters::from_values(values, Origin::named("defaults")).expect(spec.name);
            assert_eq!(
                kept.get(spec.name),
                Some(&value),
                "{}: the default has the type of the parameter",
                spec.name
            );
        }
    }
}

#[test]
fn only_the_chains_are_required() {
    for spec in schema().filter(|spec| spec.default == DefaultValue::Required) {
        assert!(spec.name.starts_with("chains."), "{}", spec.name);
    }
    assert!(Scene::from_values([], Origin::named("nothing")).is_ok());
}

#[test]
fn a_slip_of_the_keyboard_finds_the_name_that_was_meant() {
    for (written, meant) in [
        ("chains.rod_lenght", "chains.rod_length"),
        ("chain.units", "chains.units"),
        ("surface.cut_off", "surface.cutoff"),
        ("body.Mesh", "body.mesh"),
        ("probe.contact_radious", "probe.contact_radius"),
        ("device.max_froce", "device.max_force"),
    ] {
        assert_eq!(nearest_name(written), Some(meant));
    }
    assert_eq!(nearest_name("zzzz"), None);
}

#[test]
fn a_changed_value_is_checked_like_a_first_one() {
    let parameters = Parameters::defaults(Origin::named("a node"));
    let changed = parameters.with("surface.rate", Value::Integer(20)).expect("accepted");
    assert_eq!(changed.double("surface.rate").expect("there"), 20.0);
    assert_eq!(parameters.double("surface.rate").expect("there"), 60.0);
    let refused = changed.with("surface.rate", Value::Double(-1.0)).expect_err("refused").to_string();
    assert_eq!(refused, "a node: surface.rate: -1.0 is not accepted; accepted: number, 0 to 1000 [Hz]");
    assert!(changed.with("surface.rat", Value::Double(1.0)).is_err());
}

#[test]
fn messages_and_descriptors_say_the_same_range() {
    let rate = spec("surface.rate").expect("there");
    assert_eq!(rate.accepted(), "number, 0 to 1000 [Hz]");
    assert_eq!(rate.check.bounds(), Some((0.0, 1000.0)));
}
