//! Messages in the order of their log times, with few blocks in memory.
//!
//! Blocks are loaded when the next message could come from them. Blocks that do not overlap in time, as a recorder
//! writes them, are in memory one or two at a time, however long the recording is. Equal times keep the order of the file.

use std::cmp::Ordering;
use std::collections::{BinaryHeap, VecDeque, binary_heap::PeekMut};

use mcap::records::op;

use crate::error::Error;
use crate::file::{McapFile, MessageHead, records};
use crate::index::Block;

/// A block and the file it is in (index into the recording's files).
#[derive(Debug, Clone)]
pub(crate) struct Located {
    pub(crate) file: usize,
    pub(crate) block: Block,
}

/// A message still in its block.
pub(crate) struct Found<'a> {
    pub(crate) file: usize,
    pub(crate) head: MessageHead,
    pub(crate) data: &'a [u8],
}

/// Merges the blocks of a recording.
pub(crate) struct Merge<'a> {
    files: &'a [McapFile],
    /// Not loaded yet, by start time.
    waiting: VecDeque<&'a Located>,
    loaded: BinaryHeap<Loaded>,
    damage: VecDeque<Error>,
}

impl<'a> Merge<'a> {
    pub(crate) fn new(files: &'a [McapFile], blocks: &'a [Located]) -> Self {
        let mut waiting: Vec<_> = blocks.iter().collect();
        // Stable: blocks that begin at the same time stay in the order of the files.
        waiting.sort_by_key(|located| located.block.start_ns);
        Self { files, waiting: waiting.into(), loaded: BinaryHeap::new(), damage: VecDeque::new() }
    }

    /// Hands the next message to `take`; `None` at the end. After an error the next call goes on behind the damage.
    pub(crate) fn next<T>(&mut self, take: impl FnOnce(Found<'_>) -> T) -> Option<Result<T, Error>> {
        self.load_due();
        if let Some(error) = self.damage.pop_front() {
            return Some(Err(error));
        }
        let mut first = self.loaded.peek_mut()?;
        let taken = first.current().map(take);
        first.cursor += 1;
        if first.cursor == first.entries.len() {
            PeekMut::pop(first);
        }
        // The entry was checked when the block was loaded, so it is there.
        taken.map(Ok)
    }

    /// Loads every block that may hold the next message.
    fn load_due(&mut self) {
        while let Some(located) = self.waiting.front() {
            let is_due = self.loaded.peek().is_none_or(|first| located.block.start_ns <= first.time_ns());
            if !is_due {
                return;
            }
            let Some(file) = self.files.get(located.file) else { return };
            match Loaded::read(file, located) {
                Ok((block, cut)) => {
                    self.damage.extend(cut);
                    if !block.entries.is_empty() {
                        self.loaded.push(block);
                    }
                }
                Err(error) => self.damage.push_back(error),
            }
            self.waiting.pop_front();
        }
    }
}

/// A block in memory with the places of its messages, by time.
struct Loaded {
    file: usize,
    /// Of the first byte in the file.
    offset: u64,
    bytes: Vec<u8>,
    /// Log time, and where the content of the message lies in `bytes`.
    entries: Vec<(u64, std::ops::Range<usize>)>,
    cursor: usize,
}

impl Loaded {
    /// Reads a block. What follows a broken record in it is lost; the second value then says where.
    fn read(file: &McapFile, located: &Located) -> Result<(Self, Option<Error>), Error> {
        let offset = located.block.records.start;
        let bytes = file.read(located.block.records.clone())?;
        if let Some(error) = located.block.checksum_error(file, &bytes) {
            return Err(error);
        }
        let mut entries = Vec::new();
        let mut cut = None;
        for record in records(&bytes) {
            match record {
                Ok(record) if record.opcode == op::MESSAGE => {
                    let begin = record.content.as_ptr() as usize - bytes.as_ptr() as usize;
                    match MessageHead::split(record.content) {
                        Some((head, _)) => {
                            entries.push((head.log_time_ns, begin..begin + record.content.len()))
                        }
                        None => {
                            let reason = "a message shorter than its head";
                            cut = Some(Error::damaged(file.path(), offset + record.offset as u64, reason));
                        }
                    }
                }
                Ok(_) => {}
                Err(at) => {
                    let reason = "a record is longer than the chunk it is in";
                    cut = Some(Error::damaged(file.path(), offset + at as u64, reason));
                }
            }
        }
        // Stable: equal times stay in the order of the file.
        entries.sort_by_key(|(time, _)| *time);
        Ok((Self { file: located.file, offset, bytes, entries, cursor: 0 }, cut))
    }

    fn time_ns(&self) -> u64 {
        self.entries.get(self.cursor).map_or(u64::MAX, |(time, _)| *time)
    }

    fn current(&self) -> Option<Found<'_>> {
        let (_, place) = self.entries.get(self.cursor)?;
        let (head, data) = MessageHead::split(self.bytes.get(place.clone())?)?;
        Some(Found { file: self.file, head, data })
    }

    fn key(&self) -> (u64, usize, u64) {
        (self.time_ns(), self.file, self.offset)
    }
}

impl Ord for Loaded {
    /// Turned round: the heap hands out the greatest, and the earliest is wanted.
    fn cmp(&self, other: &Self) -> Ordering {
        other.key().cmp(&self.key())
    }
}

impl PartialOrd for Loaded {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Loaded {
    fn eq(&self, other: &Self) -> bool {
        self.key() == other.key()
    }
}

impl Eq for Loaded {}
