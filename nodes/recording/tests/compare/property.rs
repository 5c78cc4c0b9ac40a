//! Facts that hold for any session.

use proptest::prelude::*;
use recording::messages::WrenchStamped;
use recording::{Unpaired, Verdict};

use super::session::{FORCE, Session, against, force, of};

fn of_forces(forces: Vec<WrenchStamped>) -> Session {
    Session { forces, contacts: Vec::new(), surfaces: Vec::new() }
}

/// Stamps that repeat and jump, and few values, so that equal ones are frequent.
fn any_session() -> impl Strategy<Value = Session> {
    let message =
        (0_i64..12, prop_oneof![Just(0.0), Just(-0.0), Just(f64::NAN), Just(1.0), Just(1.0 + 1e-15)]);
    prop::collection::vec(message, 1..30)
        .prop_map(|messages| of_forces(messages.into_iter().map(|(ns, z)| force(ns, z)).collect()))
}

/// The same with most messages equal.
fn two_sessions() -> impl Strategy<Value = (Session, Session)> {
    (any_session(), prop::collection::vec((any::<prop::sample::Index>(), 0_u8..4, 0_i64..12), 0..4)).prop_map(
        |(golden, edits)| {
            let mut computed = golden.clone();
            for (place, edit, ns) in edits {
                let forces = &mut computed.forces;
                let Some(last) = forces.len().checked_sub(1) else { continue };
                let place = place.index(forces.len());
                match edit {
                    0 => drop(forces.remove(place)),
                    1 => forces.insert(place, force(ns, 1.0)),
                    2 => forces.swap(place, last),
                    _ => forces[place].header.stamp.nanosec = ns as u32,
                }
            }
            (golden, computed)
        },
    )
}

/// A session to keep and which of its messages to drop.
fn drops() -> impl Strategy<Value = (Vec<WrenchStamped>, Vec<bool>)> {
    prop::collection::vec((1_i64..3_000_000, any::<bool>()), 2..150).prop_map(|steps| {
        let mut ns = 0;
        let forces = steps.iter().enumerate().map(|(place, (step, _))| {
            ns += step;
            force(ns, place as f64)
        });
        (forces.collect(), steps.iter().map(|(_, dropped)| *dropped).collect())
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn the_verdict_is_the_same_whichever_side_is_golden((one, other) in two_sessions()) {
        prop_assume!(!other.forces.is_empty());
        let there = against(&one, &other, &[]);
        let back = against(&other, &one, &[]);
        prop_assert_eq!(of(&there, FORCE).verdict.clone(), of(&back, FORCE).verdict.clone());
    }

    #[test]
    fn every_message_is_counted_once((one, other) in two_sessions()) {
        let outcome = against(&one, &other, &[]);
        let counts = of(&outcome, FORCE).counts;
        prop_assert_eq!(counts.golden, one.forces.len() as u64);
        prop_assert_eq!(counts.computed, other.forces.len() as u64);
        prop_assert_eq!(counts.paired + counts.missing + counts.reordered, counts.golden);
        prop_assert_eq!(counts.paired + counts.extra + counts.reordered, counts.computed);
        let is_same = counts.agree();
        prop_assert_eq!(of(&outcome, FORCE).verdict.clone(), if is_same { Verdict::Same } else { Verdict::Different });
    }

    #[test]
    fn a_session_is_the_same_as_itself(session in any_session()) {
        prop_assert_eq!(against(&session, &session, &[]).verdict, Verdict::Same);
    }

    #[test]
    fn dropped_messages_are_reported_and_nothing_else((forces, dropped) in drops()) {
        prop_assume!(dropped.iter().filter(|dropped| **dropped).count() <= 100);
        prop_assume!(dropped.contains(&false));
        let whole = of_forces(forces.clone());
        let (gone, kept): (Vec<_>, Vec<_>) =
            forces.into_iter().zip(&dropped).enumerate().partition(|(_, (_, dropped))| **dropped);
        let stamp_ns = |force: &WrenchStamped| {
            let stamp = &force.header.stamp;
            i64::from(stamp.sec) * 1_000_000_000 + i64::from(stamp.nanosec)
        };
        let listed: Vec<Unpaired> = gone
            .iter()
            .map(|(index, (force, _))| Unpaired { index: *index as u64, stamp_ns: stamp_ns(force) })
            .collect();
        let kept = of_forces(kept.into_iter().map(|(_, (force, _))| force).collect());

        let outcome = against(&whole, &kept, &[]);
        let topic = of(&outcome, FORCE);
        prop_assert_eq!(&topic.missing, &listed);
        prop_assert_eq!(topic.counts.differing + topic.counts.extra + topic.counts.reordered, 0);

        let outcome = against(&kept, &whole, &[]);
        let topic = of(&outcome, FORCE);
        prop_assert_eq!(&topic.extra, &listed);
        prop_assert_eq!(topic.counts.differing + topic.counts.missing + topic.counts.reordered, 0);
    }
}
