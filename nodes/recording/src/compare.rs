//! Compares computed messages with a golden recording, message by message, in bounded memory.
//!
//! Only stamps say which messages belong together; when a message was recorded does not matter.

mod golden;
mod judge;
mod kind;
mod outcome;
mod pairing;
mod peek;
mod signal;
mod surface;
mod tolerance;
mod topic;

pub use outcome::{
    Change, Counts, Divergence, FieldOutcome, Outcome, Presence, TopicOutcome, Unpaired, Value, ValueChange,
    Verdict, Worst,
};
pub use signal::{Bin, Signal};
pub use tolerance::{ToleranceError, Tolerances};

use std::path::PathBuf;

use golden::Golden;
use kind::Kind;
use topic::{Recorded, TopicComparison};

use crate::Recording;
use crate::messages::is_same;

/// Topics that a golden recording has because they were computed once: they must be computed again.
const JUDGED: [&str; 3] = ["servo_cf", "contact_state", "surface_displacement"];

/// A comparison under way.
pub struct Comparison<'a> {
    path: PathBuf,
    golden: Golden<'a>,
    topics: Vec<TopicComparison>,
}

impl<'a> Comparison<'a> {
    /// Compares what is going to be computed on the topics `outputs` with the messages of `golden` on these topics.
    ///
    /// Topics of other names are left alone, except that every `servo_cf`, `contact_state` and `surface_displacement` of the
    /// recording has to be computed.
    ///
    /// # Errors
    /// When a tolerance names no topic or no number of it.
    pub fn new(
        golden: &'a Recording,
        tolerances: Tolerances,
        outputs: &[String],
    ) -> Result<Self, ToleranceError> {
        let recorded = || golden.topics().iter().map(|recorded| &recorded.topic.name);
        let mut names: Vec<&String> = Vec::new();
        let is_judged = |name: &&String| name.rsplit('/').next().is_some_and(|last| JUDGED.contains(&last));
        for name in outputs.iter().chain(recorded().filter(is_judged)) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        let mut topics = Vec::new();
        let mut slots = Vec::new();
        for name in names {
            let (places, recorded) = recorded_as(golden, name, outputs.contains(name));
            let own = |kind| tolerances.of(name, kind);
            topics.push(TopicComparison::new(name.clone(), slots.len(), recorded, own));
            slots.push(places);
        }
        let known: Vec<(&str, Option<Kind>)> =
            topics.iter().map(|topic| (topic.name.as_str(), topic.kind())).collect();
        tolerances.check(&known)?;
        Ok(Self { path: golden.path().to_owned(), golden: Golden::new(golden, slots), topics })
    }

    /// A computed message: its bytes in CDR, each topic in its order. Topics that were not announced are not compared.
    pub fn take(&mut self, topic: &str, data: &[u8]) {
        if let Some(topic) = self.topics.iter_mut().find(|own| own.name == topic) {
            topic.take(&mut self.golden, data);
        }
    }

    /// After the last computed message.
    pub fn finish(self) -> Outcome {
        let Self { path, mut golden, topics } = self;
        let topics: Vec<TopicOutcome> = topics.into_iter().map(|topic| topic.finish(&mut golden)).collect();
        let damage = golden.damage.said("the golden recording is damaged");
        let verdict = judged(&topics, damage);
        Outcome { golden: path, topics, verdict }
    }
}

/// The places of a topic in the recording, and what it says about it.
fn recorded_as(golden: &Recording, name: &str, is_computed: bool) -> (Vec<usize>, Recorded) {
    let of_name = golden.topics().iter().enumerate().filter(|(_, recorded)| recorded.topic.name == *name);
    let (places, found): (Vec<usize>, Vec<_>) =
        of_name.map(|(place, recorded)| (place, &recorded.topic)).unzip();
    let Some(topic) = found.first() else {
        let presence = Presence::ComputedOnly;
        return (places, Recorded { type_name: String::new(), presence, refused: None });
    };
    let type_name = topic.type_name.clone();
    let refused = if found.len() > 1 {
        let types: Vec<&str> = found.iter().map(|topic| topic.type_name.as_str()).collect();
        Some(format!(
            "the golden recording has it with several types, definitions or encodings: {}",
            types.join(", ")
        ))
    } else if Kind::of(&type_name).is_none() {
        let accepted: Vec<&str> = Kind::ALL.iter().map(|kind| kind.type_name()).collect();
        Some(format!("the golden recording has it as {type_name:?}; compared are {}", accepted.join(", ")))
    } else if topic.serialization_format != "cdr" {
        Some(format!("the golden recording has it in {:?}; compared is \"cdr\"", topic.serialization_format))
    } else {
        is_same(&type_name, &topic.definition).err()
    };
    let presence = if is_computed { Presence::Both } else { Presence::GoldenOnly };
    (places, Recorded { type_name, presence, refused })
}

/// What cannot be judged outweighs what differs: the difference may come from the damage.
fn judged(topics: &[TopicOutcome], damage: Option<String>) -> Verdict {
    let unjudged = topics.iter().find_map(|topic| match &topic.verdict {
        Verdict::NotCompared(reason) => Some(format!("{}: {reason}", topic.name)),
        Verdict::Same | Verdict::Different => None,
    });
    if let Some(reason) = damage.or(unjudged) {
        return Verdict::NotCompared(reason);
    }
    if topics.iter().all(|topic| topic.presence != Presence::Both) {
        let computed: Vec<&str> = topics
            .iter()
            .filter(|topic| topic.presence == Presence::ComputedOnly)
            .map(|topic| topic.name.as_str())
            .collect();
        return Verdict::NotCompared(format!(
            "the golden recording has none of the computed topics; computed: {}",
            if computed.is_empty() { "nothing".to_owned() } else { computed.join(", ") }
        ));
    }
    if topics.iter().all(|topic| topic.counts.golden + topic.counts.computed == 0) {
        return Verdict::NotCompared("neither side has a message on the compared topics".to_owned());
    }
    if topics.iter().all(|topic| topic.verdict == Verdict::Same) { Verdict::Same } else { Verdict::Different }
}
