//! What a comparison found.

use std::fmt;
use std::path::PathBuf;

use super::signal::Signal;

/// What comparing computed messages with a golden recording found.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The golden recording.
    pub golden: PathBuf,
    /// Each compared topic: those that are computed in the given order, then those that only the recording has.
    pub topics: Vec<TopicOutcome>,
    /// The judgement of all topics together.
    pub verdict: Verdict,
}

/// The judgement.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// Every golden message has its computed one and the other way round, all values equal or within their tolerances.
    Same,
    /// They differ.
    Different,
    /// There is no judgement, for this reason. Differences that were found on the way are listed all the same.
    NotCompared(String),
}

/// One topic.
#[derive(Debug, Clone, PartialEq)]
pub struct TopicOutcome {
    /// Its name.
    pub name: String,
    /// Its type in the golden recording; empty where that has no such topic.
    pub type_name: String,
    /// Who has it.
    pub presence: Presence,
    /// How many messages there are, and how they belong together.
    pub counts: Counts,
    /// The first difference in the order of the messages.
    pub first: Option<Divergence>,
    /// The fields in which messages that belong together differ, also where that is tolerated.
    pub fields: Vec<FieldOutcome>,
    /// The first golden messages (up to 100) without a computed one.
    pub missing: Vec<Unpaired>,
    /// The first computed messages (up to 100) without a golden one.
    pub extra: Vec<Unpaired>,
    /// Both signals, for the topics of which something is drawn.
    pub signal: Option<Signal>,
    /// The judgement.
    pub verdict: Verdict,
}

/// Who has a topic.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Presence {
    /// It is computed and recorded.
    Both,
    /// It is recorded and not computed.
    GoldenOnly,
    /// It is computed and not recorded.
    ComputedOnly,
}

/// Numbers of messages. A golden and a computed message belong together when their stamps are equal; where stamps repeat, in
/// their order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// In the golden recording.
    pub golden: u64,
    /// Computed.
    pub computed: u64,
    /// Pairs that belong together.
    pub paired: u64,
    /// Pairs of which a value differs by more than is tolerated.
    pub differing: u64,
    /// Golden messages without a computed one.
    pub missing: u64,
    /// Computed messages without a golden one.
    pub extra: u64,
    /// Messages that are in both, at another place among the others. Their values are not compared.
    pub reordered: u64,
}

/// A message that has no counterpart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unpaired {
    /// Its number in its topic, from 0.
    pub index: u64,
    /// Its stamp, ns since 1970.
    pub stamp_ns: i64,
}

/// A place where both differ.
#[derive(Debug, Clone, PartialEq)]
pub struct Divergence {
    /// Number of the golden message in its topic, from 0; `None` when there is none.
    pub golden_index: Option<u64>,
    /// Number of the computed message.
    pub computed_index: Option<u64>,
    /// Stamp of the golden message, else of the computed one, ns since 1970.
    pub stamp_ns: i64,
    /// What is different.
    pub change: Change,
}

/// What is different.
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    /// The golden message has no computed one.
    Missing,
    /// The computed message has no golden one.
    Extra,
    /// The message is there, before or after others.
    Reordered,
    /// A value.
    Value(ValueChange),
}

/// A value that differs.
#[derive(Debug, Clone, PartialEq)]
pub struct ValueChange {
    /// Path in the message: `wrench.force.z`, `barycentric[1]`, `displacement.x of vertex 17`.
    pub field: String,
    /// Unit of the values; empty without one.
    pub unit: &'static str,
    /// In the golden message.
    pub golden: Value,
    /// In the computed message.
    pub computed: Value,
    /// Computed minus golden, where both are numbers.
    pub difference: Option<f64>,
}

/// A value as it is said.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A 64-bit number.
    Number(f64),
    /// A 32-bit number.
    Single(f32),
    /// Everything else.
    Text(String),
}

/// A field in which messages that belong together differ.
///
/// A message counts once for each field: elements of an array and displacements of vertices by the largest among them.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldOutcome {
    /// Path in the message, without places in an array.
    pub name: &'static str,
    /// Unit; empty without one.
    pub unit: &'static str,
    /// Pairs that differ by more than is tolerated.
    pub differing: u64,
    /// The first of them.
    pub first: Option<Divergence>,
    /// The largest |computed - golden|, in the unit; infinite where one of them is not a number. `None`: not a number field.
    pub worst_absolute: Option<Worst>,
    /// The largest |computed - golden| / |golden|, where golden is not zero.
    pub worst_relative: Option<Worst>,
    /// Root mean square of |computed - golden| over all pairs of the topic, in the unit.
    pub rms: Option<f64>,
}

/// The worst of something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worst {
    /// How bad.
    pub value: f64,
    /// Number of the golden message, from 0.
    pub golden_index: u64,
    /// Its stamp, ns since 1970.
    pub stamp_ns: i64,
}

impl Outcome {
    /// The topic that diverges first by stamp, and where.
    pub fn first(&self) -> Option<(&TopicOutcome, &Divergence)> {
        let firsts = self.topics.iter().filter_map(|topic| Some((topic, topic.first.as_ref()?)));
        firsts.min_by_key(|(_, first)| first.stamp_ns)
    }
}

impl Verdict {
    /// 0 same, 1 different, 2 not compared: what `rhombus replay --expect` exits with.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Same => 0,
            Self::Different => 1,
            Self::NotCompared(_) => 2,
        }
    }

    /// `same`, `different` or `not compared`.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Same => "same",
            Self::Different => "different",
            Self::NotCompared(_) => "not compared",
        }
    }
}

impl Counts {
    /// Whether every message has its counterpart with accepted values, in the same order.
    pub fn agree(&self) -> bool {
        self.differing + self.missing + self.extra + self.reordered == 0
    }
}

/// The shortest text that reads back as the same number.
impl fmt::Display for Value {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(formatter, "{number:?}"),
            Self::Single(number) => write!(formatter, "{number:?}"),
            Self::Text(text) => formatter.write_str(text),
        }
    }
}
