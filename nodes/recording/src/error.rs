//! What can go wrong with a recording, said with the file, the place and the way out.

use std::path::{Path, PathBuf};

/// What is a recording.
#[cfg(feature = "sqlite")]
const ACCEPTED: &str =
    "a rosbag2 directory of .mcap or .db3 files, with metadata.yaml or without, or one such file";
#[cfg(not(feature = "sqlite"))]
const ACCEPTED: &str = "a rosbag2 directory of .mcap files, with metadata.yaml or without, or one such file";

/// Why a recording could not be written or read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The operating system refused.
    #[error("{}: cannot {action}: {reason}", path.display())]
    Io {
        /// File or directory.
        path: PathBuf,
        /// What was tried, as a verb.
        action: &'static str,
        /// The system's reason. It is in the sentence, and no `source` that would say it a second time.
        reason: std::io::Error,
    },
    /// A recording is never overwritten.
    #[error("{}: exists already and is not overwritten; choose another name or move it away", path.display())]
    Exists {
        /// The directory that is in the way.
        path: PathBuf,
    },
    /// The path is not a recording at all.
    #[error("{}: not a recording: {reason}; accepted: {ACCEPTED}", path.display())]
    NotARecording {
        /// What was given.
        path: PathBuf,
        /// What was found instead.
        reason: String,
    },
    /// A directory of several recordings, of which nothing says which files are one.
    #[error("{}: holds several recordings and no metadata.yaml that says which files are one: {found}; name one file", path.display())]
    SeveralRecordings {
        /// The directory.
        path: PathBuf,
        /// What is in it, in words.
        found: String,
    },
    /// A recording that another program reads, but this version does not.
    #[error("{}: {what} is not read by this version; `ros2 bag convert` to uncompressed MCAP helps", path.display())]
    Unsupported {
        /// File.
        path: PathBuf,
        /// The storage, compression or encoding.
        what: String,
    },
    /// Bytes that are not what they should be. The rest of the recording is unaffected.
    #[error("{} at byte {offset}: {reason}", path.display())]
    Damaged {
        /// File.
        path: PathBuf,
        /// Where in the file.
        offset: u64,
        /// What is wrong there.
        reason: String,
    },
    /// Bytes that can be read and are not those that were written: messages in them may have other values.
    #[error("{} at byte {offset}: a chunk of {size} bytes with checksum {found:08x} instead of {recorded:08x}", path.display())]
    Altered {
        /// File.
        path: PathBuf,
        /// Where in the file.
        offset: u64,
        /// Of the chunk, decompressed.
        size: usize,
        /// Of what is there.
        found: u32,
        /// Of what was written.
        recorded: u32,
    },
    /// The end of a file says that its recorder was stopped hard. Nothing that was stored is lost by that.
    #[error("{} at byte {offset}: the file ends without its closing records: its recorder was stopped hard", path.display())]
    NotClosed {
        /// File.
        path: PathBuf,
        /// Its size, bytes.
        offset: u64,
    },
    /// `metadata.yaml` cannot be used.
    #[error("{}: {reason}", path.display())]
    Metadata {
        /// The `metadata.yaml`.
        path: PathBuf,
        /// Which key, and why.
        reason: String,
    },
    /// The MCAP encoder refused.
    #[error("{}: cannot write: {reason}", path.display())]
    Write {
        /// The `.mcap` file.
        path: PathBuf,
        /// The encoder's reason, in the sentence.
        reason: mcap::McapError,
    },
    /// `metadata.yaml` has no room for another topic.
    #[error("{}: {accepted} topics are accepted and no more: with another one no reader takes the metadata.yaml", path.display())]
    TooManyTopics {
        /// The directory of the recording.
        path: PathBuf,
        /// Topics that it has.
        accepted: usize,
    },
    /// A topic was added twice.
    #[error("topic {topic} is in the recording already")]
    TopicTwice {
        /// Its name.
        topic: String,
    },
}

impl Error {
    /// For `map_err` on calls into the operating system.
    pub(crate) fn io(path: &Path, action: &'static str) -> impl FnOnce(std::io::Error) -> Self {
        move |reason| Self::Io { path: path.to_owned(), action, reason }
    }

    pub(crate) fn write(path: &Path) -> impl FnOnce(mcap::McapError) -> Self {
        move |error| match error {
            // mcap does not say the system's reason in its own sentence.
            mcap::McapError::Io(reason) => Self::io(path, "write")(reason),
            reason => Self::Write { path: path.to_owned(), reason },
        }
    }

    pub(crate) fn damaged(path: &Path, offset: u64, reason: impl Into<String>) -> Self {
        Self::Damaged { path: path.to_owned(), offset, reason: reason.into() }
    }
}
