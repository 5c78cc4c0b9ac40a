//! rosbag2 recordings without ROS: written, read, and their messages decoded.
//!
//! A recording is what rosbag2 calls a bag: a directory `NAME/` with `metadata.yaml` and `NAME_0.mcap`. [`Writer`] makes
//! one, [`Recording`] reads one (or a bare `.mcap`), [`cdr`] and [`messages`] turn the bytes of a message into values
//! and back, and [`MessageDefinitions`] finds the texts and hashes that make a recording readable without ROS.
//!
//! Times are nanoseconds since 1970 as rosbag2 stores them: `log_time_ns` is when the recorder received a message. The
//! stamp inside a message is another matter and is never looked at here.

mod block;
pub mod cdr;
pub mod check;
mod chunk;
mod compare;
mod compression;
mod definitions;
mod described;
mod digest;
mod directory;
mod error;
mod file;
mod fit;
mod index;
pub mod messages;
mod metadata;
mod order;
mod parts;
mod place;
mod playback;
mod qos;
mod reader;
mod records;
mod remap;
pub mod repair;
#[cfg(feature = "sqlite")]
mod sqlite;
mod storage;
mod summary;
mod topic;
mod variants;
mod writer;
mod yaml;

pub use compare::{
    Bin, Change, Comparison, Counts, Divergence, FieldOutcome, Outcome, Presence, Signal, ToleranceError,
    Tolerances, TopicOutcome, Unpaired, Value, ValueChange, Verdict, Worst,
};
pub use definitions::{DefinitionError, MessageDefinition, MessageDefinitions};
pub use digest::{Digest, DigestError, DigestValue, digest_of};
pub use error::Error;
pub use place::Place;
pub use playback::{Playback, PlaybackMessages};
pub use qos::{Durability, History, Liveliness, Qos, QosTime, Reliability};
pub use reader::{Message, MessageRef, Messages, Recording, StoredMessages};
pub use remap::{RemapError, remapped};
pub use topic::{RecordedTopic, Topic};
pub use writer::{TopicId, Writer, WriterOptions, Written};
