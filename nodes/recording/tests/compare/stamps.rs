//! Messages that are missing, too many, at another place or of another stamp are one difference each.

use recording::messages::WrenchStamped;
use recording::{Change, Counts, Divergence, Outcome, TopicOutcome, Unpaired, Verdict};

use super::session::{FORCE, Session, against, force, ns, of, stamp, value};

fn forces(forces: Vec<WrenchStamped>) -> Session {
    Session { forces, contacts: Vec::new(), surfaces: Vec::new() }
}

/// Forces of these stamps, in ms; the value follows from the stamp.
fn at(stamps_ms: &[i64]) -> Session {
    forces(stamps_ms.iter().map(|ms| force(ms * 1_000_000, *ms as f64)).collect())
}

fn changed(count: usize, change: impl Fn(&mut Vec<WrenchStamped>)) -> Outcome {
    let golden = forces(Session::new(count).forces);
    let mut computed = golden.clone();
    change(&mut computed.forces);
    against(&golden, &computed, &[])
}

fn first(topic: &TopicOutcome) -> (&Change, Option<u64>, Option<u64>, i64) {
    let Divergence { golden_index, computed_index, stamp_ns, change } = topic.first.as_ref().unwrap();
    (change, *golden_index, *computed_index, *stamp_ns)
}

#[test]
fn a_missing_message_is_one_difference() {
    for place in [0, 1, 77, 198, 199] {
        let outcome = changed(200, |forces| drop(forces.remove(place)));
        let topic = of(&outcome, FORCE);
        assert_eq!(topic.verdict, Verdict::Different);
        assert_eq!(
            topic.counts,
            Counts { golden: 200, computed: 199, paired: 199, missing: 1, ..Counts::default() }
        );
        assert_eq!(first(topic), (&Change::Missing, Some(place as u64), None, ns(place)));
        assert_eq!(topic.missing, [Unpaired { index: place as u64, stamp_ns: ns(place) }]);
        assert!(topic.fields.is_empty(), "nothing behind it differs");
    }
}

#[test]
fn an_extra_message_is_one_difference() {
    for place in [0, 1, 77, 199, 200] {
        let between = ns(place) - 500_000;
        let outcome = changed(200, |forces| forces.insert(place, force(between, 1.0)));
        let topic = of(&outcome, FORCE);
        assert_eq!(
            topic.counts,
            Counts { golden: 200, computed: 201, paired: 200, extra: 1, ..Counts::default() }
        );
        assert_eq!(first(topic), (&Change::Extra, None, Some(place as u64), between));
        assert_eq!(topic.extra, [Unpaired { index: place as u64, stamp_ns: between }]);
    }
}

#[test]
fn a_duplicated_message_is_one_extra_message() {
    for place in [0, 77, 199] {
        let outcome = changed(200, |forces| forces.insert(place, forces[place].clone()));
        let topic = of(&outcome, FORCE);
        assert_eq!(
            topic.counts,
            Counts { golden: 200, computed: 201, paired: 200, extra: 1, ..Counts::default() }
        );
        assert_eq!(first(topic), (&Change::Extra, None, Some(place as u64 + 1), ns(place)));
    }
}

#[test]
fn two_messages_in_the_other_order_are_one_difference() {
    for place in [0, 77, 198] {
        let outcome = changed(200, |forces| forces.swap(place, place + 1));
        let topic = of(&outcome, FORCE);
        assert_eq!(topic.verdict, Verdict::Different);
        assert_eq!(
            topic.counts,
            Counts { golden: 200, computed: 200, paired: 199, reordered: 1, ..Counts::default() }
        );
        assert_eq!(first(topic).0, &Change::Reordered);
        assert!(topic.missing.is_empty() && topic.extra.is_empty());
    }
}

#[test]
fn another_stamp_is_a_difference_of_the_stamp_alone() {
    for place in [0, 77, 199] {
        let outcome = changed(200, |forces| forces[place].header.stamp = stamp(ns(place) + 1));
        let topic = of(&outcome, FORCE);
        assert_eq!(
            topic.counts,
            Counts { golden: 200, computed: 200, paired: 200, differing: 1, ..Counts::default() }
        );
        let first = topic.first.as_ref().unwrap();
        assert_eq!(
            (first.golden_index, first.computed_index, first.stamp_ns),
            (Some(place as u64), Some(place as u64), ns(place))
        );
        let change = value(first);
        assert_eq!(
            (change.field.as_str(), change.unit, change.difference),
            ("header.stamp", "s", Some(1e-9))
        );
        assert_eq!(change.golden.to_string(), format!("10.{:09}", place * 1_000_000));
        let [field] = &topic.fields[..] else { panic!("{:?}", topic.fields) };
        assert_eq!((field.name, field.worst_absolute.unwrap().value), ("header.stamp", 1e-9));
    }
}

#[test]
fn a_gap_longer_than_the_look_ahead_is_that_many_missing_messages() {
    let outcome = changed(6000, |forces| drop(forces.drain(1000..4500)));
    let topic = of(&outcome, FORCE);
    assert_eq!(
        topic.counts,
        Counts { golden: 6000, computed: 2500, paired: 2500, missing: 3500, ..Counts::default() }
    );
    assert_eq!(first(topic).1, Some(1000));
    assert_eq!(topic.missing.len(), 100, "a list, not a copy of the recording");
    let filled = at(&(0..6000).collect::<Vec<_>>());
    let gaping = at(&(0..1000).chain(4500..6000).collect::<Vec<_>>());
    let outcome = against(&gaping, &filled, &[]);
    assert_eq!((of(&outcome, FORCE).counts.extra, of(&outcome, FORCE).counts.paired), (3500, 2500));
}

#[test]
fn stamps_that_jump_back_are_compared_in_their_order() {
    let jumps: Vec<i64> = (0..500).chain(200..700).chain(0..50).collect();
    assert_eq!(against(&at(&jumps), &at(&jumps), &[]).verdict, Verdict::Same);
    let mut dropped = jumps.clone();
    dropped.remove(710);
    let outcome = against(&at(&jumps), &at(&dropped), &[]);
    let topic = of(&outcome, FORCE);
    assert_eq!(topic.counts.missing, 1);
    assert_eq!(topic.missing, [Unpaired { index: 710, stamp_ns: 410_000_000 }]);
    assert!(topic.counts.differing + topic.counts.extra + topic.counts.reordered == 0);
}

#[test]
fn stamps_that_repeat_or_are_all_zero_pair_in_order() {
    let zeros = |values: &[f64]| forces(values.iter().map(|value| force(0, *value)).collect());
    let outcome = against(&zeros(&[1.0, 2.0, 3.0]), &zeros(&[1.0, 2.5, 3.0]), &[]);
    let topic = of(&outcome, FORCE);
    assert_eq!((topic.counts.paired, topic.counts.differing), (3, 1));
    assert_eq!(topic.first.as_ref().unwrap().golden_index, Some(1));
    let outcome = against(&zeros(&[1.0, 2.0, 3.0]), &zeros(&[1.0, 2.0]), &[]);
    assert_eq!(of(&outcome, FORCE).missing, [Unpaired { index: 2, stamp_ns: 0 }]);
}

#[test]
fn stamps_with_nothing_in_common_are_compared_in_order() {
    let even: Vec<i64> = (0..3000).map(|ms| 2 * ms).collect();
    let odd: Vec<i64> = even.iter().map(|ms| ms + 1).collect();
    let outcome = against(&at(&even), &at(&odd), &[]);
    let topic = of(&outcome, FORCE);
    assert_eq!((topic.counts.paired, topic.counts.differing), (3000, 3000));
    assert_eq!(value(topic.first.as_ref().unwrap()).field, "header.stamp");
    assert_eq!(topic.fields[0].worst_absolute.unwrap().value, 1e-3);
}

#[test]
fn a_topic_that_stops_early_leaves_the_others_alone() {
    let golden = Session::new(3000);
    let mut computed = golden.clone();
    computed.contacts.truncate(5);
    computed.surfaces.clear();
    let outcome = against(&golden, &computed, &[]);
    assert_eq!(of(&outcome, FORCE).verdict, Verdict::Same);
    assert_eq!(of(&outcome, "/contact_state").counts.missing, 2995);
    assert_eq!(of(&outcome, "/surface_displacement").counts.missing, 188);
}

#[test]
fn topics_that_are_computed_one_after_the_other_are_compared_in_bounded_memory() {
    // More bytes than a topic may have waiting: the contacts are read twice, once for each topic.
    let golden = Session::new(60_000);
    let mut messages = golden.messages();
    messages.sort_by_key(|(topic, _)| *topic != FORCE);
    let outcome = super::session::compared(
        &golden.recorded(),
        &messages,
        &["/servo_cf", "/contact_state", "/surface_displacement"],
        &[],
    );
    assert_eq!(outcome.verdict, Verdict::Same);
    assert_eq!(of(&outcome, "/contact_state").counts.paired, 60_000);
}
