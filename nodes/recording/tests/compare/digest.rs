//! The digest changes with every force and displacement, and with nothing else.

use recording::cdr::encode;
use recording::{Digest, DigestError, Recording, digest_of};

use super::session::{CONTACT, FORCE, SURFACE, Session, recorded};

fn digest(session: &Session) -> String {
    let mut digest = Digest::new();
    session.messages().iter().for_each(|(topic, data)| digest.take(topic, data).unwrap());
    digest.finish().to_string()
}

#[test]
fn a_digest_is_64_digits_and_the_same_from_a_recording() {
    let session = Session::new(100);
    let own = digest(&session);
    assert!(own.len() == 64 && own.bytes().all(|digit| digit.is_ascii_hexdigit()));
    let golden = session.recorded();
    assert_eq!(digest_of(&golden.recording, &[]).unwrap().to_string(), own);
    assert_eq!(digest_of(&golden.recording, &[FORCE, SURFACE]).unwrap().to_string(), own);
    assert_ne!(digest_of(&golden.recording, &[FORCE]).unwrap().to_string(), own);
}

#[test]
fn every_value_and_stamp_of_forces_and_surfaces_counts() {
    type Change = fn(&mut Session);
    let changes: [Change; 9] = [
        |session| session.forces[9].wrench.force.x += 1e-16,
        |session| session.forces[9].wrench.torque.z = -0.0,
        |session| session.forces[9].header.stamp.nanosec += 1,
        |session| session.forces.swap(3, 4),
        |session| drop(session.forces.pop()),
        |session| session.surfaces[2].displacement[8] += 1e-9,
        |session| session.surfaces[2].vertex[2] += 1,
        |session| session.surfaces[2].topology_version += 1,
        |session| session.surfaces.clear(),
    ];
    let same = digest(&Session::new(100));
    for (place, change) in changes.into_iter().enumerate() {
        let mut session = Session::new(100);
        change(&mut session);
        assert_ne!(digest(&session), same, "change {place}");
    }
}

#[test]
fn frames_contacts_interleaving_and_vertices_at_rest_do_not_count() {
    let same = digest(&Session::new(100));
    let mut session = Session::new(100);
    session.forces[5].header.frame_id = "another".to_owned();
    session.contacts.clear();
    session.surfaces[1].vertex.push(50);
    session.surfaces[1].displacement.extend([0.0, -0.0, 0.0]);
    assert_eq!(digest(&session), same);
    let mut messages = session.messages();
    messages.sort_by_key(|(topic, _)| *topic);
    assert_eq!(digest_of(&recorded(&messages).recording, &[]).unwrap().to_string(), same);
}

#[test]
fn topics_of_two_devices_are_not_mixed_up() {
    let of = |names: [&str; 2]| {
        let mut digest = Digest::new();
        let forces = Session::new(2).forces;
        for (name, force) in names.iter().zip(&forces) {
            digest.take(name, &encode(force)).unwrap();
        }
        digest.finish()
    };
    assert_ne!(of(["/left/servo_cf", "/right/servo_cf"]), of(["/right/servo_cf", "/left/servo_cf"]));
}

#[test]
fn what_cannot_be_read_has_no_digest() {
    let session = Session::new(4000);
    let golden = session.recorded();
    let error = digest_of(&golden.recording, &[CONTACT]).unwrap_err();
    assert!(matches!(error, DigestError::Topic { .. }));
    assert!(error.to_string().ends_with("surface_displacement: /servo_cf, /surface_displacement"), "{error}");

    let mut messages = session.messages();
    messages[0].1.truncate(30);
    let error = digest_of(&recorded(&messages).recording, &[]).unwrap_err();
    assert!(
        error.to_string().starts_with("/servo_cf: message #0: not a geometry_msgs/msg/WrenchStamped: "),
        "{error}"
    );

    let file = golden.path.join("golden_0.mcap");
    let bytes = std::fs::read(&file).unwrap();
    std::fs::write(&file, &bytes[..bytes.len() / 2]).unwrap();
    let error = digest_of(&Recording::open(&golden.path).unwrap(), &[]).unwrap_err();
    assert!(matches!(error, DigestError::Damaged(_)), "{error}");
}
