//! What is judged as a whole, and what cannot be judged.

use recording::cdr::encode;
use recording::messages::{Header, SurfaceDisplacement};
use recording::{Comparison, Presence, Recording, Tolerances, Verdict, Writer};

use super::session::{
    CONTACT, FORCE, SURFACE, Session, compared, force, ns, of, outputs, recorded, topic, value_of,
};

fn reason(verdict: &Verdict) -> &str {
    assert_eq!(verdict.exit_code(), 2);
    match verdict {
        Verdict::NotCompared(reason) => reason,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_topic_that_only_one_side_has_is_different() {
    let session = Session::new(50);
    let golden = session.recorded();
    let outcome = compared(&golden, &session.messages(), &[FORCE, "/left/servo_cf"], &[]);
    assert_eq!(outcome.verdict, Verdict::Different);
    let names: Vec<_> = outcome.topics.iter().map(|topic| (topic.name.as_str(), topic.presence)).collect();
    assert_eq!(
        names,
        [
            (FORCE, Presence::Both),
            ("/left/servo_cf", Presence::ComputedOnly),
            (CONTACT, Presence::GoldenOnly),
            (SURFACE, Presence::GoldenOnly),
        ]
    );
    assert_eq!(
        (of(&outcome, FORCE).verdict.clone(), of(&outcome, CONTACT).counts.golden),
        (Verdict::Same, 50)
    );
    assert_eq!(of(&outcome, CONTACT).verdict, Verdict::Different);
}

#[test]
fn computed_messages_the_recording_has_no_topic_for_are_extra() {
    let session = Session::new(5);
    let forces: Vec<_> = session.messages().into_iter().filter(|(topic, _)| *topic == FORCE).collect();
    let golden = recorded(&forces);
    let outcome = compared(&golden, &session.messages(), &[FORCE, CONTACT], &[]);
    assert_eq!(outcome.verdict, Verdict::Different);
    assert_eq!(
        (of(&outcome, CONTACT).counts.extra, of(&outcome, CONTACT).verdict.clone()),
        (5, Verdict::Different)
    );
}

#[test]
fn without_a_topic_or_a_message_in_common_nothing_is_judged() {
    let session = Session::new(5);
    let golden = recorded(&[("/other", vec![0, 1, 0, 0, 1])]);
    let outcome = compared(&golden, &session.messages(), &[FORCE, CONTACT], &[]);
    assert_eq!(
        reason(&outcome.verdict),
        "the golden recording has none of the computed topics; computed: /servo_cf, /contact_state"
    );
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("silent");
    let mut writer = Writer::create(&path, "").unwrap();
    writer.add_topic(topic(FORCE, "geometry_msgs/msg/WrenchStamped")).unwrap();
    writer.close().unwrap();
    let silent = Recording::open(&path).unwrap();
    let outcome = Comparison::new(&silent, Tolerances::default(), &outputs(&[FORCE])).unwrap().finish();
    assert_eq!(reason(&outcome.verdict), "neither side has a message on the compared topics");
}

#[test]
fn a_golden_message_that_cannot_be_decoded_is_not_compared_and_says_why() {
    let session = Session::new(20);
    let mut messages = session.messages();
    let (_, data) = messages.iter_mut().filter(|(topic, _)| *topic == FORCE).nth(7).unwrap();
    data.truncate(40);
    let outcome = compared(&recorded(&messages), &session.messages(), &[FORCE, CONTACT, SURFACE], &[]);
    let reason = reason(&outcome.verdict).to_owned();
    assert!(
        reason.starts_with(
            "/servo_cf: messages cannot be compared: golden message #7 and computed message #7: golden: "
        ),
        "{reason}"
    );
    assert!(reason.contains("geometry_msgs/msg/WrenchStamped: byte 36"), "{reason}");
    assert_eq!(of(&outcome, CONTACT).verdict, Verdict::Same);

    let (_, data) = messages.iter_mut().filter(|(topic, _)| *topic == FORCE).nth(9).unwrap();
    data.truncate(3);
    let outcome = compared(&recorded(&messages), &session.messages(), &[FORCE, CONTACT, SURFACE], &[]);
    let reason = self::reason(&of(&outcome, FORCE).verdict);
    assert!(reason.contains("not readable in the golden recording: message #9 "), "{reason}");
}

#[test]
fn a_list_of_vertices_that_does_not_ascend_is_not_compared() {
    let header = Header::default();
    let good =
        SurfaceDisplacement { header, topology_version: 1, vertex: vec![2, 5], displacement: vec![1.0; 6] };
    let bad = [
        (SurfaceDisplacement { vertex: vec![5, 2], ..good.clone() }, "vertex[1] is not above vertex[0]"),
        (SurfaceDisplacement { vertex: vec![2, 2], ..good.clone() }, "vertex[1] is not above vertex[0]"),
        (
            SurfaceDisplacement { displacement: vec![1.0; 5], ..good.clone() },
            "5 components of displacement for 2 vertices",
        ),
    ];
    for (bad, why) in bad {
        let golden = recorded(&[(SURFACE, encode(&bad))]);
        let outcome = compared(&golden, &[(SURFACE, encode(&good))], &[SURFACE], &[]);
        assert!(reason(&outcome.verdict).contains(&format!("golden: {why}")), "{}", reason(&outcome.verdict));
        let outcome = compared(&golden, &[(SURFACE, encode(&bad))], &[SURFACE], &[]);
        assert_eq!(outcome.verdict, Verdict::Same, "equal bytes are equal");
    }
}

#[test]
fn a_damaged_golden_recording_is_not_a_judge() {
    let session = Session::new(4000);
    let golden = session.recorded();
    let file = golden.path.join("golden_0.mcap");
    let bytes = std::fs::read(&file).unwrap();
    std::fs::write(&file, &bytes[..bytes.len() / 2]).unwrap();
    let cut = Recording::open(&golden.path).unwrap();
    let mut comparison =
        Comparison::new(&cut, Tolerances::default(), &outputs(&[FORCE, CONTACT, SURFACE])).unwrap();
    session.messages().iter().for_each(|(topic, data)| comparison.take(topic, data));
    let outcome = comparison.finish();
    assert!(
        reason(&outcome.verdict).starts_with("the golden recording is damaged: "),
        "{:?}",
        outcome.verdict
    );
}

#[test]
fn a_type_that_is_not_compared_or_another_definition_is_refused() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("golden");
    let mut writer = Writer::create(&path, "").unwrap();
    let id = writer.add_topic(topic(FORCE, "geometry_msgs/msg/PointStamped")).unwrap();
    writer.write(id, 1, &encode(&force(ns(0), 1.0))).unwrap();
    let mut redefined = topic(CONTACT, "rhombus_haptics_msgs/msg/ContactState");
    redefined.definition.text = "std_msgs/Header header\nfloat32 depth\n".to_owned();
    writer.add_topic(redefined).unwrap();
    writer.close().unwrap();
    let golden = Recording::open(&path).unwrap();
    let outcome =
        Comparison::new(&golden, Tolerances::default(), &outputs(&[FORCE, CONTACT])).unwrap().finish();
    let [force, contact] = &outcome.topics[..] else { panic!("{:?}", outcome.topics) };
    assert!(
        reason(&force.verdict)
            .contains("\"geometry_msgs/msg/PointStamped\"; compared are geometry_msgs/msg/WrenchStamped, ")
    );
    assert_eq!(force.counts.golden, 1);
    assert!(reason(&contact.verdict).contains("ContactState"), "{:?}", contact.verdict);
}

#[test]
fn a_tolerance_for_a_topic_or_field_that_is_not_compared_is_refused() {
    let golden = Session::new(5).recorded();
    let refused = |text: &str| {
        let tolerances = Tolerances::parse(&[text]).unwrap();
        let comparison = Comparison::new(&golden.recording, tolerances, &outputs(&[FORCE]));
        comparison.err().unwrap().to_string()
    };
    assert!(
        refused("measured_cf=1,0").contains("accepted: /servo_cf, /contact_state, /surface_displacement")
    );
    assert!(refused("servo_cf.depth=1,0").contains("accepted: wrench.force.x, "));
}

#[test]
fn both_signals_and_their_difference_are_drawn() {
    let golden = Session::new(100);
    let mut computed = golden.clone();
    computed.forces[40].wrench.force.z = 12.0;
    let outcome = super::session::against(&golden, &computed, &[]);
    let signal = of(&outcome, FORCE).signal.as_ref().unwrap();
    assert_eq!((signal.quantity, signal.unit, signal.bins.len()), ("|force|", "N", 100));
    let norm = |z: f64| (0.1 * 0.1 + z * z).sqrt();
    let bin = signal.bins.iter().find(|bin| (bin.start_ns..bin.end_ns).contains(&ns(40))).unwrap();
    let before = norm(value_of(40));
    assert_eq!(bin.golden, Some((before, before)));
    assert_eq!(bin.computed, Some((norm(12.0), norm(12.0))));
    assert_eq!(bin.difference, Some((norm(12.0) - before, norm(12.0) - before)));
    let quiet = of(&outcome, CONTACT).signal.as_ref().unwrap();
    assert!(quiet.bins.iter().all(|bin| bin.golden == bin.computed && bin.difference == Some((0.0, 0.0))));
}
