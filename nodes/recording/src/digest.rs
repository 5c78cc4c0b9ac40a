//! One number for all forces and displacements of a session: equal digests, equal bits.

use std::collections::BTreeMap;
use std::fmt;

use sha2::{Digest as _, Sha256};

use crate::Recording;
use crate::cdr::{CdrError, decode};
use crate::messages::{SurfaceDisplacement, Time, WrenchStamped};

/// SHA-256 of the forces (`servo_cf`) and displacements (`surface_displacement`) of a session.
///
/// What counts is the messages' stamps and values and the order within each topic; when a message was recorded, how topics
/// interleave, padding and frame names do not. Every NaN is the same NaN, and a vertex listed without displacement counts
/// as not listed, as when [comparing](crate::Comparison) without tolerance.
///
/// For each topic SHA-256 runs over its messages, numbers little-endian: stamp (i32 s, u32 ns), then for a force x, y, z
/// of force and torque (f64), for a surface the `topology_version` (u32), the number of displaced vertices (u32), and for each
/// vertex its number (u32) and x, y, z (f32). The digest of the session is SHA-256 over, for each topic with a message in
/// the order of their names, the length of the name (u32), the name and the topic's digest.
#[derive(Debug, Default, Clone)]
pub struct Digest {
    topics: BTreeMap<String, Sha256>,
}

/// A finished [`Digest`]; displayed as 64 hexadecimal digits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct DigestValue(pub [u8; 32]);

/// Why there is no digest.
#[derive(Debug, thiserror::Error)]
pub enum DigestError {
    /// The recording cannot be read whole; a digest of the rest would look like one of the whole.
    #[error("no digest of a damaged recording: {0}")]
    Damaged(String),
    /// A message is not what its topic's name says.
    #[error("{topic}: message #{index}: {source}")]
    Message {
        /// The topic.
        topic: String,
        /// Number of the message in its topic, from 0.
        index: u64,
        /// What is wrong.
        source: CdrError,
    },
    /// A topic is not in the recording, or is not one of forces or displacements.
    #[error(
        "topic {topic:?} is not in a digest; accepted are topics of the recording that end with servo_cf or surface_displacement: {accepted}"
    )]
    Topic {
        /// What was asked for.
        topic: String,
        /// What there is.
        accepted: String,
    },
}

#[derive(Debug, Clone, Copy)]
enum Content {
    Force,
    Surface,
}

/// A message that counts.
enum Judged {
    Force(WrenchStamped),
    Surface(SurfaceDisplacement),
}

impl Content {
    fn of(topic: &str) -> Option<Self> {
        match topic.rsplit('/').next() {
            Some("servo_cf") => Some(Self::Force),
            Some("surface_displacement") => Some(Self::Surface),
            _ => None,
        }
    }
}

impl Digest {
    /// Of nothing yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// The next message of a topic, in CDR. Topics that are neither forces nor displacements do not count.
    ///
    /// # Errors
    /// When the bytes are not such a message.
    pub fn take(&mut self, topic: &str, data: &[u8]) -> Result<(), CdrError> {
        let Some(content) = Content::of(topic) else { return Ok(()) };
        let message = match content {
            Content::Force => Judged::Force(decode(data)?),
            Content::Surface => Judged::Surface(decode(data)?),
        };
        if !self.topics.contains_key(topic) {
            self.topics.insert(topic.to_owned(), Sha256::new());
        }
        if let Some(hash) = self.topics.get_mut(topic) {
            match message {
                Judged::Force(message) => force(hash, &message),
                Judged::Surface(message) => surface(hash, &message),
            }
        }
        Ok(())
    }

    /// The digest of what was taken.
    pub fn finish(self) -> DigestValue {
        let mut all = Sha256::new();
        for (name, topic) in self.topics {
            // A name has far fewer than 2^32 bytes.
            all.update((name.len() as u32).to_le_bytes());
            all.update(name.as_bytes());
            all.update(topic.finalize());
        }
        DigestValue(all.finalize().into())
    }
}

/// The digest of some topics of a recording; of all that are forces or displacements when `topics` is empty.
///
/// # Errors
/// When a topic cannot be in a digest, or a message cannot be read.
pub fn digest_of(recording: &Recording, topics: &[&str]) -> Result<DigestValue, DigestError> {
    let names = || recording.topics().iter().map(|recorded| recorded.topic.name.as_str());
    let known: Vec<&str> = names().filter(|name| Content::of(name).is_some()).collect();
    if let Some(unknown) = topics.iter().find(|topic| !known.contains(topic)) {
        let accepted = known.join(", ");
        return Err(DigestError::Topic { topic: (*unknown).to_owned(), accepted });
    }
    if let Some(error) = recording.damage().first() {
        return Err(DigestError::Damaged(error.to_string()));
    }
    let is_asked = |name: &str| known.contains(&name) && (topics.is_empty() || topics.contains(&name));
    let asked: Vec<usize> =
        names().enumerate().filter(|(_, name)| is_asked(name)).map(|(place, _)| place).collect();
    let mut digest = Digest::new();
    let mut counts = vec![0_u64; recording.topics().len()];
    for message in recording.messages_of(&asked) {
        let message = message.map_err(|error| DigestError::Damaged(error.to_string()))?;
        let Some(index) = counts.get_mut(message.topic) else { continue };
        let Some(topic) = recording.topics().get(message.topic) else { continue };
        let name = &topic.topic.name;
        digest.take(name, &message.data).map_err(|source| DigestError::Message {
            topic: name.clone(),
            index: *index,
            source,
        })?;
        *index += 1;
    }
    Ok(digest.finish())
}

fn force(hash: &mut Sha256, message: &WrenchStamped) {
    stamp(hash, &message.header.stamp);
    let (force, torque) = (&message.wrench.force, &message.wrench.torque);
    for number in [force.x, force.y, force.z, torque.x, torque.y, torque.z] {
        let number = if number.is_nan() { f64::NAN } else { number };
        hash.update(number.to_le_bytes());
    }
}

fn surface(hash: &mut Sha256, message: &SurfaceDisplacement) {
    stamp(hash, &message.header.stamp);
    hash.update(message.topology_version.to_le_bytes());
    let (displacements, _) = message.displacement.as_chunks::<3>();
    let listed = || message.vertex.iter().zip(displacements);
    let displaced =
        || listed().filter(|(_, displacement)| displacement.iter().any(|component| *component != 0.0));
    // As many as a message can list.
    hash.update((displaced().count() as u32).to_le_bytes());
    for (vertex, displacement) in displaced() {
        hash.update(vertex.to_le_bytes());
        for component in displacement {
            let component = if component.is_nan() { f32::NAN } else { *component };
            hash.update(component.to_le_bytes());
        }
    }
}

fn stamp(hash: &mut Sha256, stamp: &Time) {
    hash.update(stamp.sec.to_le_bytes());
    hash.update(stamp.nanosec.to_le_bytes());
}

impl fmt::Display for DigestValue {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(formatter, "{byte:02x}"))
    }
}
