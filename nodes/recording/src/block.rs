//! What a recorded file is to the reader, whatever its storage: topics, and blocks of messages that are loaded one by one.
//!
//! MCAP files have chunks and rows of messages, SQLite files have ranges of rows. Both give a [`FileIndex`] on opening and
//! a [`Loaded`] for each [`Block`]; everything behind that (order, topics, playback) knows no storage.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::error::Error;
use crate::topic::RecordedTopic;

/// The most a block may take in memory, bytes: larger ones are split where the storage allows it and damage where not.
/// One message is at most as large.
pub(crate) const MAX_BLOCK_BYTES: u64 = 64 << 20;

/// What is in one file.
#[derive(Debug, Default)]
pub(crate) struct FileIndex {
    /// Topics with their counts. The number is the storage's own: the channel of an MCAP file, the topic id of a database.
    pub(crate) topics: BTreeMap<u32, RecordedTopic>,
    /// In stored order: of two messages with equal times the one in the earlier block was stored first.
    pub(crate) blocks: Vec<Block>,
    /// What had to be left out, and why.
    pub(crate) damage: Vec<Error>,
    /// What its chunks or messages decompress to, as far as that counts.
    pub(crate) decompressed_bytes: u64,
    /// The counts are those that its recorder wrote, and not of what is found.
    pub(crate) is_counted: bool,
}

/// A piece of a file that is loaded at once. Pieces may overlap in time.
#[derive(Debug, Clone)]
pub(crate) struct Block {
    /// Earliest log time in it, ns.
    pub(crate) start_ns: u64,
    /// Latest log time in it, ns.
    pub(crate) end_ns: u64,
    /// The numbers of the topics that have messages in it, ascending; `None` where only loading would tell.
    pub(crate) channels: Option<Box<[u32]>>,
    /// Where it is.
    pub(crate) place: Place,
}

/// Where a block lies in its file.
#[derive(Debug, Clone)]
pub(crate) enum Place {
    /// The inside of an MCAP chunk.
    Chunk(Chunk),
    /// Records of an MCAP file outside of chunks, or in an uncompressed chunk too large for one block.
    Row {
        /// Bytes of the file.
        records: Range<u64>,
    },
    /// Rows of a database; its file knows which from the number.
    #[cfg(feature = "sqlite")]
    Sqlite {
        /// Counts the blocks of the file.
        part: usize,
    },
}

/// The inside of an MCAP chunk.
#[derive(Debug, Clone)]
pub(crate) struct Chunk {
    /// The records as stored: bytes of the file.
    pub(crate) records: Range<u64>,
    /// Name of the compression; empty for none.
    pub(crate) compression: String,
    /// Size of the records without compression, as the file has it.
    pub(crate) size: u64,
    /// CRC-32 of the records without compression; 0 where the writer computed none.
    pub(crate) crc: u32,
}

/// A message of a loaded block.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Entry {
    /// When it was received, ns.
    pub(crate) log_time_ns: u64,
    /// When it was published, ns; the log time where the storage does not say.
    pub(crate) publish_time_ns: u64,
    /// Of the topic, where the storage has it; 0 otherwise.
    pub(crate) sequence: u32,
    /// The topic's number in [`FileIndex::topics`].
    pub(crate) channel: u32,
    /// Where the message lies in [`Loaded::bytes`]. Blocks are far smaller than 4 GiB.
    pub(crate) data: Range<u32>,
}

/// A block in memory.
#[derive(Debug, Default)]
pub(crate) struct Loaded {
    pub(crate) bytes: Vec<u8>,
    /// By log time; equal times in stored order.
    pub(crate) entries: Vec<Entry>,
    /// What of the block could not be read.
    pub(crate) damage: Vec<Error>,
}

impl Loaded {
    /// With entries in stored order.
    pub(crate) fn new(bytes: Vec<u8>, mut entries: Vec<Entry>, damage: Vec<Error>) -> Self {
        // Stable: equal times stay in stored order.
        entries.sort_by_key(|entry| entry.log_time_ns);
        Self { bytes, entries, damage }
    }

    /// The bytes of a message. Empty for an entry of another block.
    pub(crate) fn data(&self, entry: &Entry) -> &[u8] {
        self.bytes.get(entry.data.start as usize..entry.data.end as usize).unwrap_or_default()
    }
}
