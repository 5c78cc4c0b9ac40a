//! Saves from a broken recording what can be read, into a new one of which everything can be read.
//!
//! The old recording is not touched. The new one grows under a temporary name beside its place, is read back, and gets
//! its name at the very end: a full disk or an interruption leaves nothing that looks like a recording.

mod output;
mod tally;

use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::check::{Report, as_text, check_watched, most_messages, too_many};
use crate::error::Error;
use crate::reader::Recording;
use crate::writer::Writer;

pub use output::default_output;
use tally::Tally;

/// Sentences about unreadable places that are kept; more are counted only.
const MOST_SENTENCES: usize = 50;
/// Messages between two questions whether to go on.
const MESSAGES_BETWEEN_QUESTIONS: u64 = 1000;

/// Why nothing was saved. Nothing is left behind then.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RepairError {
    /// Nothing can be read.
    #[error("nothing can be read: {0}")]
    Unreadable(String),
    /// The new recording cannot be written.
    #[error(transparent)]
    Output(#[from] Error),
    /// The new recording would be inside of the old one.
    #[error("{}: is inside of {}, which is not touched; choose a place outside", output.display(), path.display())]
    Inside {
        /// The new one.
        output: PathBuf,
        /// The old one.
        path: PathBuf,
    },
    /// The old recording has more topics than the metadata of a new one can have.
    #[error("{}: has {topics} topics; accepted: {accepted}, with more of them no reader takes the metadata.yaml of a recording", path.display())]
    TooManyTopics {
        /// The old one.
        path: PathBuf,
        /// Its topics.
        topics: usize,
        /// As many of these would do.
        accepted: usize,
    },
    /// What was written does not read back.
    #[error("{}: does not read back as it was written: {reason}; the disk may be failing", output.display())]
    ReadBack {
        /// The new one.
        output: PathBuf,
        /// What differs.
        reason: String,
    },
    /// The caller wanted no more.
    #[error("interrupted; nothing is left behind")]
    Interrupted,
}

/// What became of a topic.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct SavedTopic {
    /// Absolute name.
    pub name: String,
    /// Such as `geometry_msgs/msg/PoseStamped`.
    #[serde(rename = "type")]
    pub type_name: String,
    /// Messages in the new recording.
    pub saved: u64,
    /// Messages that were recorded and are not in it; `None` where the old recording does not say how many it had.
    pub lost: Option<u64>,
}

/// What [`repair`] did.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Repaired {
    /// The old recording.
    #[serde(serialize_with = "as_text")]
    pub path: PathBuf,
    /// The new one, a directory.
    #[serde(serialize_with = "as_text")]
    pub output: PathBuf,
    /// Messages in the new recording.
    pub saved: u64,
    /// Messages known to be lost.
    pub lost: u64,
    /// Whether every message that the old recording had is in the new one, as it was recorded.
    pub all_saved: bool,
    /// What was broken, a sentence each with its place.
    pub problems: Vec<String>,
    /// Problems beyond those that are said.
    pub more_problems: u64,
    /// What a check says of the new recording, a sentence each: messages that are not what their type says, and are kept as
    /// they were recorded. Without any the new recording is whole.
    pub remaining: Vec<String>,
    /// Such problems beyond those that are said.
    pub more_remaining: u64,
    /// Messages of the new recording that are not what their type says.
    pub unlike_their_type: u64,
    /// In the order in which they came into the recording.
    pub topics: Vec<SavedTopic>,
}

/// Writes what can be read of the recording at `path` to a new recording `output`, a directory that must not exist, with
/// the topics, QoS, definitions and times as they were, and reads it back. `go_on` is asked now and then.
///
/// # Errors
/// When nothing can be read, `output` exists or cannot be written, or `go_on` said no. Nothing is left of `output` then.
pub fn repair(path: &Path, output: &Path, go_on: &dyn Fn() -> bool) -> Result<Repaired, RepairError> {
    let place = output::place(output, path)?;
    let recording = Recording::open(path).map_err(|error| RepairError::Unreadable(error.to_string()))?;
    let metadata = crate::check::metadata_of(path);
    let distro = metadata.as_ref().map_or("", |metadata| metadata.ros_distro.as_str());
    let mut tally = Tally::new(&recording, metadata.as_ref());
    let mut writer = Writer::create(place.unfinished(), distro)?;
    let mut topics = Vec::new();
    for found in recording.topics() {
        topics.push(writer.add_topic(found.topic.clone()).map_err(|error| match error {
            Error::TooManyTopics { accepted, .. } => {
                let (path, topics) = (path.to_owned(), recording.topics().len());
                RepairError::TooManyTopics { path, topics, accepted }
            }
            error => error.into(),
        })?);
    }
    let mut problems = Problems::default();
    recording.damage().iter().for_each(|damage| problems.add(damage.to_string()));
    recording.metadata_disagreements().iter().for_each(|sentence| problems.add(sentence.clone()));
    let most = most_messages(path);
    let mut stored = recording.stored_messages();
    while let Some(message) = stored.next_ref() {
        match message {
            Ok(_) if tally.saved() == most => {
                tally.unreadable_place();
                problems.add(too_many(path, most));
                break;
            }
            Ok(message) => {
                let Some(topic) = topics.get(message.topic) else { continue };
                writer.copy(*topic, &message)?;
                tally.take(&message);
                ask(&tally, go_on)?;
            }
            Err(error) => {
                tally.damage(&error);
                problems.add(error.to_string());
            }
        }
    }
    if tally.saved() == 0 && (!problems.said.is_empty() || tally.lost() > 0) {
        let reason = problems.said.into_iter().next();
        return Err(RepairError::Unreadable(reason.unwrap_or_else(|| "no message is left".to_owned())));
    }
    writer.close()?;
    let found = read_back(place.unfinished(), &tally, go_on)?;
    place.finish()?;
    Ok(Repaired {
        path: path.to_owned(),
        output: output.to_owned(),
        saved: tally.saved(),
        lost: tally.lost(),
        all_saved: tally.all_saved(),
        problems: problems.said,
        more_problems: problems.more,
        remaining: found.problems,
        more_remaining: found.more_problems,
        unlike_their_type: found.unlike_their_type,
        topics: tally.topics(),
    })
}

/// All of a new recording can be read, and it has what was written. What a check says of it can only lie in the messages.
fn read_back(written: &Path, tally: &Tally<'_>, go_on: &dyn Fn() -> bool) -> Result<Report, RepairError> {
    let differs = |reason: String| RepairError::ReadBack { output: written.to_owned(), reason };
    let recording = Recording::open(written)?;
    if let Some(damage) = recording.damage().first() {
        return Err(differs(damage.to_string()));
    }
    if let Some(disagreement) = recording.metadata_disagreements().first() {
        return Err(differs(disagreement.clone()));
    }
    let mut again = Tally::new(&recording, None);
    let mut asked = Ok(());
    let report = check_watched(&recording, &mut |message| {
        again.take(message);
        asked = ask(&again, go_on);
        asked.is_ok()
    });
    asked?;
    if report.repairable {
        let reason = report.problems.into_iter().next().unwrap_or_default();
        return Err(differs(reason));
    }
    tally.compare(&again).map_err(differs)?;
    Ok(report)
}

/// Asks now and then whether to go on.
fn ask(tally: &Tally<'_>, go_on: &dyn Fn() -> bool) -> Result<(), RepairError> {
    match tally.saved().is_multiple_of(MESSAGES_BETWEEN_QUESTIONS) && !go_on() {
        true => Err(RepairError::Interrupted),
        false => Ok(()),
    }
}

/// Sentences, the first ones kept.
#[derive(Default)]
struct Problems {
    said: Vec<String>,
    more: u64,
}

impl Problems {
    fn add(&mut self, sentence: String) {
        if self.said.len() < MOST_SENTENCES {
            self.said.push(sentence);
        } else {
            self.more += 1;
        }
    }
}
