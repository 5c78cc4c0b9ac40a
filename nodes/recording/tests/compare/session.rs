//! A session of forces, contacts and surfaces as a model computes it, recorded and compared.

use std::path::PathBuf;

use recording::cdr::{Message as CdrMessage, encode};
use recording::messages::{ContactState, Header, SurfaceDisplacement, Time, Vector3, Wrench, WrenchStamped};
use recording::{
    Change, Comparison, Divergence, Outcome, Recording, Tolerances, Topic, TopicOutcome, ValueChange, Writer,
};
use tempfile::TempDir;

pub(crate) const FORCE: &str = "/servo_cf";
pub(crate) const CONTACT: &str = "/contact_state";
pub(crate) const SURFACE: &str = "/surface_displacement";

/// Everything that is computed in a session.
#[derive(Debug, Clone)]
pub(crate) struct Session {
    pub(crate) forces: Vec<WrenchStamped>,
    pub(crate) contacts: Vec<ContactState>,
    pub(crate) surfaces: Vec<SurfaceDisplacement>,
}

pub(crate) fn stamp(ns: i64) -> Time {
    Time { sec: ns.div_euclid(1_000_000_000) as i32, nanosec: ns.rem_euclid(1_000_000_000) as u32 }
}

pub(crate) fn header(ns: i64) -> Header {
    Header { stamp: stamp(ns), frame_id: "base".to_owned() }
}

pub(crate) fn force(ns: i64, z: f64) -> WrenchStamped {
    let wrench = Wrench { force: Vector3 { x: 0.1, y: 0.0, z }, torque: Vector3::default() };
    WrenchStamped { header: header(ns), wrench }
}

/// Message `number` of a 1 kHz session.
pub(crate) fn ns(number: usize) -> i64 {
    10_000_000_000 + number as i64 * 1_000_000
}

/// A force in N that changes sign now and then.
pub(crate) fn value_of(number: usize) -> f64 {
    number as f64 * 0.37 % 1.7 - 0.4
}

impl Session {
    /// `count` poses at 1 kHz, a surface for every sixteenth.
    pub(crate) fn new(count: usize) -> Self {
        let contact = |number: usize| ContactState {
            header: header(ns(number)),
            mode: 1,
            face: 7,
            barycentric: [0.25, 0.5, 0.25],
            depth: 1e-3 * value_of(number),
            force: value_of(number),
            ..ContactState::default()
        };
        let surface = |number: usize| SurfaceDisplacement {
            header: header(ns(number)),
            topology_version: 99,
            vertex: vec![3, 17, 40],
            displacement: (0..9).map(|component| (number + component) as f32 * 1e-4).collect(),
        };
        Self {
            forces: (0..count).map(|number| force(ns(number), value_of(number))).collect(),
            contacts: (0..count).map(contact).collect(),
            surfaces: (0..count).step_by(16).map(surface).collect(),
        }
    }

    /// All messages by topic, as they would be computed: by stamp as long as stamps are in order.
    pub(crate) fn messages(&self) -> Vec<(&'static str, Vec<u8>)> {
        let mut messages = Vec::new();
        let mut surfaces = self.surfaces.iter();
        for place in 0..self.forces.len().max(self.contacts.len()) {
            messages.extend(self.forces.get(place).map(|message| (FORCE, encode(message))));
            messages.extend(self.contacts.get(place).map(|message| (CONTACT, encode(message))));
            if place % 16 == 0 {
                messages.extend(surfaces.next().map(|message| (SURFACE, encode(message))));
            }
        }
        messages.extend(surfaces.map(|message| (SURFACE, encode(message))));
        messages
    }

    /// The session as a golden recording.
    pub(crate) fn recorded(&self) -> Golden {
        recorded(&self.messages())
    }
}

/// A recording and the directory it lives in.
pub(crate) struct Golden {
    pub(crate) recording: Recording,
    pub(crate) path: PathBuf,
    _directory: TempDir,
}

pub(crate) fn topic(name: &str, type_name: &str) -> Topic {
    Topic {
        name: name.to_owned(),
        type_name: type_name.to_owned(),
        serialization_format: "cdr".to_owned(),
        offered_qos: Vec::new(),
        definition: recording::MessageDefinition {
            encoding: "ros2msg".to_owned(),
            text: String::new(),
            type_hash: String::new(),
        },
    }
}

pub(crate) fn type_of(topic: &str) -> &'static str {
    match topic.rsplit('/').next() {
        Some("servo_cf") => WrenchStamped::TYPE_NAME,
        Some("contact_state") => ContactState::TYPE_NAME,
        Some("surface_displacement") => SurfaceDisplacement::TYPE_NAME,
        _ => "std_msgs/msg/Bool",
    }
}

/// Records messages 1 us apart, whatever their stamps.
pub(crate) fn recorded<N: AsRef<str>>(messages: &[(N, Vec<u8>)]) -> Golden {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("golden");
    let mut writer = Writer::create(&path, "jazzy").unwrap();
    let mut topics = Vec::new();
    for (place, (name, data)) in messages.iter().enumerate() {
        let name = name.as_ref();
        let id = match topics.iter().find(|(known, _)| known == name) {
            Some((_, id)) => *id,
            None => {
                let id = writer.add_topic(topic(name, type_of(name))).unwrap();
                topics.push((name.to_owned(), id));
                id
            }
        };
        writer.write(id, 1_000_000 + place as u64 * 1000, data).unwrap();
    }
    writer.close().unwrap();
    Golden { recording: Recording::open(&path).unwrap(), path, _directory: directory }
}

pub(crate) fn outputs(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

/// Compares messages with a golden recording.
pub(crate) fn compared<N: AsRef<str>>(
    golden: &Golden,
    computed: &[(N, Vec<u8>)],
    names: &[&str],
    tolerances: &[&str],
) -> Outcome {
    let tolerances = Tolerances::parse(tolerances).unwrap();
    let mut comparison = Comparison::new(&golden.recording, tolerances, &outputs(names)).unwrap();
    for (topic, data) in computed {
        comparison.take(topic.as_ref(), data);
    }
    comparison.finish()
}

/// Compares a session without or with tolerances.
pub(crate) fn against(golden: &Session, computed: &Session, tolerances: &[&str]) -> Outcome {
    compared(&golden.recorded(), &computed.messages(), &[FORCE, CONTACT, SURFACE], tolerances)
}

pub(crate) fn of<'a>(outcome: &'a Outcome, topic: &str) -> &'a TopicOutcome {
    outcome.topics.iter().find(|own| own.name == topic).unwrap()
}

pub(crate) fn value(divergence: &Divergence) -> &ValueChange {
    match &divergence.change {
        Change::Value(change) => change,
        other => panic!("{other:?} is not a value"),
    }
}
