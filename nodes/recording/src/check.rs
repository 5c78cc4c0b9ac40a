//! Whether a recording is whole, and what is in it: everything is read once, nothing is changed.
//!
//! Damage is what costs messages or makes them mean something else: places that cannot be read, counts that disagree,
//! messages that are not what their type says, a definition with other fields, a recorder that was stopped hard.
//! What is merely odd (stamps that jump, poses that are none, a topic without messages) is a remark: the recording has
//! what was sent.

mod periods;
mod sentences;
mod stamps;
mod topic;
mod values;

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::metadata::{self, Metadata, TopicMetadata};
use crate::reader::{MessageRef, Recording};
use crate::topic::Topic;

pub use periods::{Gap, Periods};
pub use stamps::StampOrder;
use topic::TopicCheck;
pub use topic::{DefinitionState, Failures, TopicReport};

/// Messages that any recording may have; a byte of its files may hold one more. A message has its own log time, which no
/// compression says in less: more messages are a bomb.
const MESSAGES_FOR_ANY_FILE: u64 = 1_000_000;
/// Sentences about unreadable places that are kept; more are counted only.
const MOST_SENTENCES: usize = 50;

/// How much of a recording can be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// Everything that was recorded is there.
    Whole,
    /// Some of it is.
    Damaged,
    /// Nothing of it is, or it is several recordings and not one.
    Unreadable,
}

/// A file of a recording.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FileReport {
    /// Its path.
    #[serde(serialize_with = "as_text")]
    pub path: PathBuf,
    /// `mcap`, `sqlite3`, `metadata` or `other`.
    pub storage: &'static str,
    /// Size on the disk.
    pub bytes: u64,
}

/// A path need not be text; JSON must be.
pub(crate) fn as_text<S: serde::Serializer>(path: &Path, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&path.display())
}

/// What [`check`] found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// What was checked.
    #[serde(serialize_with = "as_text")]
    pub path: PathBuf,
    /// How much of it can be used.
    pub verdict: Verdict,
    /// What is broken, a sentence each with its place.
    pub problems: Vec<String>,
    /// Problems beyond those that are said.
    pub more_problems: u64,
    /// Whether a recording that [`repair`](crate::repair::repair) makes of it has fewer problems: not where they are in the
    /// messages, which stay as they were recorded.
    pub repairable: bool,
    /// Messages that can be read and are not what their type says here: their values mean nothing.
    pub unlike_their_type: u64,
    /// What is odd and harms nothing, a sentence each.
    pub remarks: Vec<String>,
    /// Its files.
    pub files: Vec<FileReport>,
    /// Version of `metadata.yaml`; `None` without one.
    pub metadata_version: Option<u32>,
    /// The ROS distribution that recorded it; empty where it is not known.
    pub ros_distro: String,
    /// Messages that can be read.
    pub message_count: u64,
    /// Earliest log time, ns since 1970; `None` without messages.
    pub start_ns: Option<u64>,
    /// From the earliest to the latest log time, ns.
    pub duration_ns: u64,
    /// By name.
    pub topics: Vec<TopicReport>,
}

/// Reads all of a recording and says what is in it and what is wrong with it.
///
/// A recording that cannot be opened is a report too, with [`Verdict::Unreadable`] and the reason. Takes 8 bytes of memory
/// for each message beside what reading takes.
pub fn check(path: impl AsRef<Path>) -> Report {
    let path = path.as_ref();
    let mut report = Report::new(path);
    match Recording::open(path) {
        Ok(recording) => report.fill(&recording, &mut |_| true),
        Err(error) => report.problem(error.to_string()),
    }
    report.conclude();
    report
}

/// As [`check`], of a recording that is open. `watch` sees each message and says whether to go on.
pub(crate) fn check_watched(recording: &Recording, watch: &mut dyn FnMut(&MessageRef<'_>) -> bool) -> Report {
    let mut report = Report::new(recording.path());
    report.fill(recording, watch);
    report.conclude();
    report
}

impl Report {
    fn new(path: &Path) -> Self {
        Self {
            path: path.to_owned(),
            verdict: Verdict::Unreadable,
            problems: Vec::new(),
            more_problems: 0,
            repairable: false,
            unlike_their_type: 0,
            remarks: Vec::new(),
            files: files_of(path),
            metadata_version: None,
            ros_distro: String::new(),
            message_count: 0,
            start_ns: None,
            duration_ns: 0,
            topics: Vec::new(),
        }
    }

    /// For a recording of which nothing can be read, and why.
    pub fn unreadable(path: &Path, reason: &str) -> Self {
        let mut report = Self::new(path);
        report.problem(reason.to_owned());
        report
    }

    fn fill(&mut self, recording: &Recording, watch: &mut dyn FnMut(&MessageRef<'_>) -> bool) {
        for damage in recording.damage() {
            self.problem(damage.to_string());
        }
        for disagreement in recording.metadata_disagreements() {
            self.problem(disagreement.clone());
        }
        if self.path.is_dir() && !self.path.join(metadata::FILE_NAME).exists() {
            self.problem(format!(
                "{}: there is no metadata.yaml: the recorder did not close the recording, and `ros2 bag` does not take it",
                self.path.display()
            ));
        }
        let metadata = metadata_of(&self.path);
        let announced = Announced::by(metadata.as_ref(), recording);
        let mut topics: Vec<_> = recording
            .topics()
            .iter()
            .map(|found| TopicCheck::new(found, announced.of(&found.topic)))
            .collect();
        let most = most_messages(&self.path);
        let mut stored = recording.stored_messages();
        while let Some(message) = stored.next_ref() {
            match message {
                Ok(_) if self.message_count == most => {
                    self.problem(too_many(&self.path, most));
                    break;
                }
                Ok(message) => {
                    if !watch(&message) {
                        break;
                    }
                    self.message_count += 1;
                    if let Some(topic) = topics.get_mut(message.topic) {
                        topic.take(&message);
                    }
                }
                Err(error) => self.problem(error.to_string()),
            }
        }
        let bounds = topics.iter().filter_map(TopicCheck::bounds_ns);
        let bounds = bounds.reduce(|(start, end), (first, last)| (start.min(first), end.max(last)));
        self.start_ns = bounds.map(|(start, _)| start);
        self.duration_ns = bounds.map_or(0, |(start, end)| end - start);
        // What comes now lies in the messages: a repair keeps them as they are.
        let in_the_files = self.problem_count();
        let mut missing = 0;
        for topic in topics {
            let topic = topic.finish();
            missing += u64::from(topic.recorded > topic.messages);
            self.unlike_their_type += topic.unlike_its_type();
            topic.problems().into_iter().for_each(|problem| self.problem(problem));
            self.remarks.extend(topic.remarks());
            self.topics.push(topic);
        }
        self.topics.sort_by(|a, b| (&a.name, &a.type_name).cmp(&(&b.name, &b.type_name)));
        self.remark_on_topics();
        self.repairable = in_the_files + missing > 0;
        self.metadata_version = metadata.as_ref().map(|metadata| metadata.version);
        self.ros_distro = metadata.map(|metadata| metadata.ros_distro).unwrap_or_default();
    }

    fn remark_on_topics(&mut self) {
        let mut different = Vec::new();
        for pair in self.topics.windows(2) {
            if let [first, second] = pair
                && first.name == second.name
            {
                let (name, type_name) = (&first.name, &first.type_name);
                if type_name != &second.type_name {
                    self.remarks.push(format!(
                        "{name}: messages of two types, {type_name} and {}; a replay needs one",
                        second.type_name
                    ));
                    continue;
                }
                let (one, other) = (&first.serialization_format, &second.serialization_format);
                different.push(match one == other {
                    true => format!(
                        "{name}: recorded with more than one definition of {type_name}; a replay needs one"
                    ),
                    false => {
                        format!("{name}: messages encoded as {one:?} and as {other:?}; a replay needs one")
                    }
                });
            }
        }
        different.into_iter().for_each(|problem| self.problem(problem));
        if self.message_count == 0 {
            self.remarks.push("there are no messages in it".to_owned());
        } else if !self.topics.iter().any(|topic| topic.is_pose() && topic.messages > 0) {
            let reason = "there are no poses in it (PoseStamped or TransformStamped): nothing can be replayed to a model";
            self.remarks.push(reason.to_owned());
        }
    }

    fn problem(&mut self, sentence: String) {
        if self.problems.len() < MOST_SENTENCES {
            self.problems.push(sentence);
        } else {
            self.more_problems += 1;
        }
    }

    fn problem_count(&self) -> u64 {
        self.problems.len() as u64 + self.more_problems
    }

    fn conclude(&mut self) {
        self.verdict = match (self.problems.is_empty(), self.message_count) {
            (true, _) => Verdict::Whole,
            (false, 0) => Verdict::Unreadable,
            (false, _) => Verdict::Damaged,
        };
    }
}

/// How many messages of a recording are read.
pub(crate) fn most_messages(path: &Path) -> u64 {
    files_of(path).iter().map(|file| file.bytes).fold(MESSAGES_FOR_ANY_FILE, u64::saturating_add)
}

/// What to say of one that has more.
pub(crate) fn too_many(path: &Path, most: u64) -> String {
    format!(
        "{}: more than {most} messages, which a recording of its size cannot have; the others are left out",
        path.display()
    )
}

/// `metadata.yaml`, when there is one that can be read.
pub(crate) fn metadata_of(path: &Path) -> Option<Metadata> {
    path.is_dir().then(|| Metadata::load(path).ok().flatten()).flatten()
}

/// How many messages `metadata.yaml` knows of each topic, by name and type.
pub(crate) struct Announced<'a>(BTreeMap<(&'a str, &'a str), u64>);

impl<'a> Announced<'a> {
    pub(crate) fn by(metadata: Option<&'a Metadata>, recording: &'a Recording) -> Self {
        let mut counts = BTreeMap::new();
        for entry in metadata.iter().flat_map(|metadata| &metadata.topics_with_message_count) {
            let TopicMetadata { name, type_name, .. } = &entry.topic_metadata;
            let count: &mut u64 = counts.entry((name.as_str(), type_name.as_str())).or_default();
            *count = count.saturating_add(entry.message_count);
        }
        // Of a topic with two definitions it does not say how many are of which.
        let mut seen = BTreeSet::new();
        for Topic { name, type_name, .. } in recording.topics().iter().map(|found| &found.topic) {
            if !seen.insert((name.as_str(), type_name.as_str())) {
                counts.remove(&(name.as_str(), type_name.as_str()));
            }
        }
        Self(counts)
    }

    /// 0 where it knows of none.
    pub(crate) fn of(&self, topic: &Topic) -> u64 {
        self.0.get(&(topic.name.as_str(), topic.type_name.as_str())).copied().unwrap_or(0)
    }
}

/// The files of a directory, or the file itself; what cannot be listed is told by opening it.
fn files_of(path: &Path) -> Vec<FileReport> {
    let of = |path: PathBuf| {
        let bytes = std::fs::metadata(&path).ok().filter(std::fs::Metadata::is_file)?.len();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let storage = match name.trim_end_matches(".zstd").rsplit('.').next() {
            Some("mcap") => "mcap",
            Some("db3") => "sqlite3",
            Some("yaml") => "metadata",
            _ => "other",
        };
        Some(FileReport { storage, bytes, path })
    };
    let mut files: Vec<_> = match std::fs::read_dir(path) {
        Ok(entries) => entries.filter_map(|entry| of(entry.ok()?.path())).collect(),
        Err(_) => of(path.to_owned()).into_iter().collect(),
    };
    files.sort_by_key(|file| (file.path.as_os_str().len(), file.path.clone()));
    files
}
