//! Values that differ are found at their message, field and element.

use recording::{Outcome, TopicOutcome, Value, Verdict};

use super::session::{CONTACT, FORCE, SURFACE, Session, against, ns, of, value, value_of};

const COUNT: usize = 200;

/// Compares a session with one that was changed.
fn changed(change: impl Fn(&mut Session), tolerances: &[&str]) -> Outcome {
    let golden = Session::new(COUNT);
    let mut computed = golden.clone();
    change(&mut computed);
    against(&golden, &computed, tolerances)
}

/// Place, field and both values of the first difference.
fn first(topic: &TopicOutcome) -> (u64, i64, &str, String, String) {
    let first = topic.first.as_ref().unwrap();
    assert_eq!(first.golden_index, first.computed_index);
    let change = value(first);
    (
        first.golden_index.unwrap(),
        first.stamp_ns,
        &change.field,
        change.golden.to_string(),
        change.computed.to_string(),
    )
}

#[test]
fn the_same_session_is_the_same() {
    let outcome = changed(|_| {}, &[]);
    assert_eq!(outcome.verdict, Verdict::Same);
    assert_eq!(outcome.verdict.exit_code(), 0);
    for (name, count) in [(FORCE, 200), (CONTACT, 200), (SURFACE, 13)] {
        let topic = of(&outcome, name);
        assert_eq!((topic.counts.golden, topic.counts.computed, topic.counts.paired), (count, count, count));
        assert!(topic.counts.agree() && topic.fields.is_empty() && topic.first.is_none());
    }
    assert!(outcome.first().is_none());
}

#[test]
fn a_change_in_the_sixth_digit_is_found_at_its_message_and_field() {
    let outcome = changed(|session| session.forces[50].wrench.force.z *= 1.000_001, &[]);
    assert_eq!(outcome.verdict, Verdict::Different);
    assert_eq!(outcome.verdict.exit_code(), 1);
    let topic = of(&outcome, FORCE);
    assert_eq!((topic.counts.paired, topic.counts.differing), (200, 1));
    let golden = value_of(50);
    let computed = golden * 1.000_001;
    assert_eq!(first(topic), (50, ns(50), "wrench.force.z", format!("{golden:?}"), format!("{computed:?}")));
    assert_eq!(value(topic.first.as_ref().unwrap()).difference, Some(computed - golden));
    let [field] = &topic.fields[..] else { panic!("{:?}", topic.fields) };
    assert_eq!((field.name, field.unit, field.differing), ("wrench.force.z", "N", 1));
    let (absolute, relative) = (field.worst_absolute.unwrap(), field.worst_relative.unwrap());
    assert_eq!(
        (absolute.value, absolute.golden_index, absolute.stamp_ns),
        ((computed - golden).abs(), 50, ns(50))
    );
    assert!((relative.value - 1e-6).abs() < 1e-12);
    assert!((field.rms.unwrap() - absolute.value / 200_f64.sqrt()).abs() < 1e-18, "one of 200 pairs");
    assert_eq!(
        (&of(&outcome, CONTACT).verdict, &of(&outcome, SURFACE).verdict),
        (&Verdict::Same, &Verdict::Same)
    );
    assert_eq!(outcome.first().unwrap().0.name, FORCE);
}

#[test]
fn the_first_the_worst_and_the_mean_are_of_different_messages() {
    let change = |session: &mut Session| {
        for (place, difference) in [(10, 3.0), (20, -4.0), (30, 1.0)] {
            session.contacts[place].depth += difference;
        }
    };
    let outcome = changed(change, &[]);
    let field = &of(&outcome, CONTACT).fields[0];
    assert_eq!(field.differing, 3);
    assert_eq!(field.first.as_ref().unwrap().golden_index, Some(10));
    assert_eq!(field.worst_absolute.unwrap().golden_index, 20);
    assert!((field.rms.unwrap() - (26.0 / 200.0_f64).sqrt()).abs() < 1e-12);
}

#[test]
fn contact_memory_flags_and_frames_have_to_be_equal_whatever_is_tolerated() {
    type Change = fn(&mut Session);
    let cases: [(Change, &str, &str, &str, &str); 7] = [
        (|session| session.contacts[9].face = 8, CONTACT, "face", "7", "8"),
        (|session| session.contacts[9].mode = 2, CONTACT, "mode", "1", "2"),
        (|session| session.contacts[9].saturated = true, CONTACT, "saturated", "false", "true"),
        (
            |session| session.forces[9].header.frame_id = "tool".into(),
            FORCE,
            "header.frame_id",
            "\"base\"",
            "\"tool\"",
        ),
        (|session| session.surfaces[9].topology_version = 98, SURFACE, "topology_version", "99", "98"),
        (
            |session| session.surfaces[9].header.frame_id.clear(),
            SURFACE,
            "header.frame_id",
            "\"base\"",
            "\"\"",
        ),
        (|session| session.contacts[9].barycentric[1] = 90.5, CONTACT, "barycentric[1]", "0.5", "90.5"),
    ];
    for (change, topic, field, golden, computed) in cases {
        let outcome = changed(change, &["servo_cf=9,9", "contact_state=9,9", "surface_displacement=9,9"]);
        assert_eq!(outcome.verdict, Verdict::Different, "{field}");
        let found = first(of(&outcome, topic));
        assert_eq!((found.0, found.2, found.3.as_str(), found.4.as_str()), (9, field, golden, computed));
    }
}

#[test]
fn a_sign_of_zero_is_a_difference_without_and_none_with_a_tolerance() {
    let change = |session: &mut Session| session.forces[3].wrench.torque.y = -0.0;
    let outcome = changed(change, &[]);
    let found = first(of(&outcome, FORCE));
    assert_eq!((found.0, found.2, found.3.as_str(), found.4.as_str()), (3, "wrench.torque.y", "0.0", "-0.0"));
    let outcome = changed(change, &["servo_cf=1e-300,0"]);
    assert_eq!(outcome.verdict, Verdict::Same);
    assert_eq!(of(&outcome, FORCE).fields[0].worst_absolute.unwrap().value, 0.0);
}

#[test]
fn a_nan_equals_any_nan_and_no_number() {
    let outcome = changed(|session| session.forces[3].wrench.force.x = f64::NAN, &["servo_cf=1e300,1e300"]);
    let topic = of(&outcome, FORCE);
    let found = first(topic);
    assert_eq!((found.0, found.2, found.4.as_str()), (3, "wrench.force.x", "NaN"));
    assert_eq!(topic.fields[0].worst_absolute.unwrap().value, f64::INFINITY);
    let mut golden = Session::new(COUNT);
    golden.forces[3].wrench.force.x = f64::NAN;
    golden.surfaces[1].displacement[2] = f32::NAN;
    let mut computed = golden.clone();
    computed.forces[3].wrench.force.x = f64::from_bits(0xfff8_0000_0000_0123);
    computed.surfaces[1].displacement[2] = -f32::NAN;
    assert_eq!(against(&golden, &computed, &[]).verdict, Verdict::Same);
}

#[test]
fn infinities_of_both_signs_differ_and_are_not_tolerated() {
    let mut golden = Session::new(COUNT);
    golden.contacts[5].stiffness = f64::INFINITY;
    assert_eq!(against(&golden, &golden.clone(), &["contact_state=1,1"]).verdict, Verdict::Same);
    let mut computed = golden.clone();
    computed.contacts[5].stiffness = 1.0;
    assert_eq!(against(&golden, &computed, &["contact_state=1,1"]).verdict, Verdict::Different);
}

#[test]
fn one_vertex_more_is_a_displacement_from_rest() {
    let change = |session: &mut Session| {
        session.surfaces[4].vertex.insert(2, 39);
        session.surfaces[4].displacement.splice(6..6, [0.0, -2e-3, 0.0]);
    };
    let outcome = changed(change, &[]);
    let topic = of(&outcome, SURFACE);
    let found = first(topic);
    assert_eq!(found, (4, ns(64), "displacement.y of vertex 39", "0.0".into(), "-0.002".into()));
    assert_eq!(topic.counts.differing, 1);
    let [field] = &topic.fields[..] else { panic!("{:?}", topic.fields) };
    assert_eq!((field.name, field.unit), ("displacement", "m"));
    assert!(field.worst_relative.is_none(), "there is nothing to be relative to");
    assert_eq!(changed(change, &["surface_displacement.displacement=0.0021,0"]).verdict, Verdict::Same);
}

#[test]
fn a_vertex_less_is_the_same_difference_the_other_way_round() {
    let change = |session: &mut Session| {
        session.surfaces[4].vertex.remove(1);
        session.surfaces[4].displacement.drain(3..6);
    };
    let outcome = changed(change, &[]);
    let first = of(&outcome, SURFACE).first.as_ref().unwrap();
    let change = value(first);
    assert_eq!(
        (change.field.as_str(), &change.computed),
        ("displacement.x of vertex 17", &Value::Single(0.0))
    );
}

#[test]
fn a_vertex_listed_at_rest_is_one_that_is_not_listed() {
    let change = |session: &mut Session| {
        session.surfaces[4].vertex.push(50);
        session.surfaces[4].displacement.extend([0.0, -0.0, 0.0]);
    };
    assert_eq!(changed(change, &[]).verdict, Verdict::Same);
}

#[test]
fn tolerances_are_absolute_plus_relative_of_the_golden_value() {
    let change =
        |session: &mut Session| session.forces.iter_mut().for_each(|force| force.wrench.force.x = 0.11);
    for (tolerance, verdict) in [
        ("servo_cf=0.0101,0", Verdict::Same),
        ("servo_cf=0.0099,0", Verdict::Different),
        ("servo_cf=0,0.101", Verdict::Same),
        ("servo_cf=0,0.099", Verdict::Different),
        ("servo_cf=0.005,0.051", Verdict::Same),
        ("/servo_cf.wrench.force.x=1,0", Verdict::Same),
        ("servo_cf.wrench.force=1,0", Verdict::Same),
        ("servo_cf.wrench.force.y=1,0", Verdict::Different),
        ("contact_state=1,0", Verdict::Different),
    ] {
        let outcome = changed(change, &[tolerance]);
        assert_eq!(outcome.verdict, verdict, "{tolerance}");
        let field = &of(&outcome, FORCE).fields[0];
        assert!((field.rms.unwrap() - 0.01).abs() < 1e-12, "what is tolerated is reported all the same");
        assert_eq!(field.differing, if verdict == Verdict::Same { 0 } else { 200 });
    }
}
