//! Messages in the order of their log times, with few blocks in memory.
//!
//! Blocks are loaded when the next message could come from them. Blocks that do not overlap in time, as a recorder
//! writes them, are in memory one or two at a time, however long the recording is. Where so many overlap that they
//! would fill the memory, those that are needed last are dropped and loaded again. Equal times keep the stored order.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap, VecDeque};

use crate::block::{Block, Entry, Loaded, MAX_BLOCK_BYTES};
use crate::error::Error;
use crate::storage::RecordedFile;

/// Blocks in memory besides the one being read, bytes.
const HELD_BYTES: usize = 32 << 20;
/// A block is loaded this often and no more: a file of thousands of large blocks that all span the same time would
/// otherwise be read for days.
const MOST_LOADS: u32 = 100;

/// A block and the file it is in (index into the recording's files).
#[derive(Debug, Clone)]
pub(crate) struct Located {
    pub(crate) file: usize,
    pub(crate) block: Block,
}

/// What is wanted of a recording.
#[derive(Debug, Clone)]
pub(crate) struct Selection {
    /// By the number of the topic.
    pub(crate) topics: Vec<bool>,
    /// From the first of these log times up to the last, ns.
    pub(crate) from_ns: u64,
    pub(crate) to_ns: u64,
}

/// Where a message is: the number of its block in the recording, and where its bytes begin in the block.
pub(crate) type Spot = (usize, u32);

/// A message to come.
pub(crate) struct Next {
    pub(crate) spot: Spot,
    /// Number of the topic in the recording.
    pub(crate) topic: usize,
    pub(crate) log_time_ns: u64,
}

/// A message still in its block.
pub(crate) struct Found<'a> {
    /// Its `channel` is the number of the topic in the recording.
    pub(crate) entry: &'a Entry,
    pub(crate) data: &'a [u8],
}

/// Merges the blocks of a recording.
pub(crate) struct Merge<'a> {
    files: &'a [RecordedFile],
    blocks: &'a [Located],
    topic_of_channel: &'a [BTreeMap<u32, usize>],
    selection: Selection,
    /// All blocks that have a message to come, the one being read apart.
    queue: BinaryHeap<Reverse<Due>>,
    /// Loaded blocks of the queue.
    held: BTreeMap<usize, Loaded>,
    held_bytes: usize,
    /// How often a block was loaded, of those that were dropped once.
    loads: BTreeMap<usize, u32>,
    reading: Option<(Due, Loaded)>,
    damage: VecDeque<(usize, Error)>,
}

/// When a block is due, by log time and then by the stored order of the blocks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Due {
    time_ns: u64,
    block: usize,
    /// The next entry.
    cursor: usize,
}

impl<'a> Merge<'a> {
    pub(crate) fn new(
        files: &'a [RecordedFile],
        blocks: &'a [Located],
        topic_of_channel: &'a [BTreeMap<u32, usize>],
        selection: Selection,
    ) -> Self {
        let mut merge = Self {
            files,
            blocks,
            topic_of_channel,
            selection,
            queue: BinaryHeap::new(),
            held: BTreeMap::new(),
            held_bytes: 0,
            loads: BTreeMap::new(),
            reading: None,
            damage: VecDeque::new(),
        };
        let due = blocks.iter().enumerate().filter(|(_, located)| merge.is_wanted(located));
        merge.queue = due
            .map(|(block, located)| Reverse(Due { time_ns: located.block.start_ns, block, cursor: 0 }))
            .collect();
        merge
    }

    /// What comes next; `None` at the end. An error comes with the number of its block, and once: the next call goes on
    /// behind the damage.
    pub(crate) fn peek(&mut self) -> Option<Result<Next, (usize, Error)>> {
        self.advance();
        if let Some(error) = self.damage.pop_front() {
            return Some(Err(error));
        }
        let (due, loaded) = self.reading.as_ref()?;
        let entry = loaded.entries.get(due.cursor)?;
        let spot = (due.block, entry.data.start);
        Some(Ok(Next { spot, topic: entry.channel as usize, log_time_ns: entry.log_time_ns }))
    }

    /// The message that was peeked at.
    pub(crate) fn take(&mut self) -> Option<Found<'_>> {
        let (due, loaded) = self.reading.as_mut()?;
        let entry = loaded.entries.get(due.cursor)?;
        due.cursor += 1;
        Some(Found { entry, data: loaded.data(entry) })
    }

    /// Leaves out the message that was peeked at.
    pub(crate) fn skip(&mut self) {
        if let Some((due, _)) = &mut self.reading {
            due.cursor += 1;
        }
    }

    /// Makes `reading` the block with the next message.
    fn advance(&mut self) {
        if let Some((due, loaded)) = &mut self.reading {
            if let Some(entry) = loaded.entries.get(due.cursor) {
                due.time_ns = entry.log_time_ns;
                if self.queue.peek().is_none_or(|Reverse(first)| *due < *first) {
                    return;
                }
                let (due, loaded) = (*due, std::mem::take(loaded));
                self.hold(due, loaded);
            }
            self.reading = None;
        }
        while let Some(Reverse(mut due)) = self.queue.pop() {
            let loaded = match self.held.remove(&due.block) {
                Some(loaded) => {
                    self.held_bytes -= size_of_loaded(&loaded);
                    loaded
                }
                None => self.load(due),
            };
            let Some(entry) = loaded.entries.get(due.cursor) else { continue };
            due.time_ns = entry.log_time_ns;
            if self.queue.peek().is_none_or(|Reverse(first)| due < *first) {
                self.reading = Some((due, loaded));
                return;
            }
            self.hold(due, loaded);
        }
    }

    /// Puts a block back into the queue, in memory if there is room for it.
    fn hold(&mut self, due: Due, loaded: Loaded) {
        self.queue.push(Reverse(due));
        self.held_bytes += size_of_loaded(&loaded);
        self.held.insert(due.block, loaded);
        while self.held_bytes > HELD_BYTES && self.held.len() > 1 {
            let in_memory = self.queue.iter().filter(|Reverse(due)| self.held.contains_key(&due.block));
            let Some(Reverse(last)) = in_memory.min() else { return };
            let last = last.block;
            if let Some(dropped) = self.held.remove(&last) {
                self.held_bytes -= size_of_loaded(&dropped);
                self.loads.entry(last).or_insert(1);
            }
        }
    }

    /// Loads what is wanted of a block. What cannot be loaded is damage, told the first time only.
    fn load(&mut self, due: Due) -> Loaded {
        let Some(located) = self.blocks.get(due.block) else { return Loaded::default() };
        let Some(file) = self.files.get(located.file) else { return Loaded::default() };
        let is_first = match self.loads.get_mut(&due.block) {
            Some(loads) => {
                *loads += 1;
                if *loads > MOST_LOADS {
                    let reason =
                        "the rest of a block of messages that spans the same time as too many others";
                    self.damage.push_back((due.block, Error::damaged(file.path(), 0, reason)));
                    return Loaded::default();
                }
                false
            }
            None => true,
        };
        match file.load(&located.block) {
            Ok(mut loaded) => {
                let damage = std::mem::take(&mut loaded.damage);
                if is_first {
                    self.damage.extend(damage.into_iter().map(|error| (due.block, error)));
                }
                self.keep_wanted(located.file, &mut loaded.entries);
                loaded
            }
            Err(error) => {
                if is_first {
                    self.damage.push_back((due.block, error));
                }
                Loaded::default()
            }
        }
    }

    /// Leaves the wanted entries and turns their channels into topics of the recording.
    fn keep_wanted(&self, file: usize, entries: &mut Vec<Entry>) {
        let Selection { topics, from_ns, to_ns } = &self.selection;
        let topic_of_channel = self.topic_of_channel.get(file);
        let mut last = None;
        entries.retain_mut(|entry| {
            // Messages of a topic come in rows.
            let topic = match last {
                Some((channel, topic)) if channel == entry.channel => topic,
                _ => {
                    let topic = topic_of_channel.and_then(|topics| topics.get(&entry.channel)).copied();
                    topic.filter(|topic| topics.get(*topic) == Some(&true))
                }
            };
            last = Some((entry.channel, topic));
            let Some(topic) = topic else { return false };
            // A recording has fewer topics than channels, and channels have 32 bits.
            entry.channel = topic as u32;
            (*from_ns..=*to_ns).contains(&entry.log_time_ns)
        });
    }

    fn is_wanted(&self, located: &Located) -> bool {
        let Block { start_ns, end_ns, channels, .. } = &located.block;
        let in_time = *start_ns <= self.selection.to_ns && *end_ns >= self.selection.from_ns;
        let topics = self.topic_of_channel.get(located.file);
        let is_wanted = |channel: &u32| {
            let topic = topics.and_then(|topics| topics.get(channel));
            topic.is_some_and(|topic| self.selection.topics.get(*topic) == Some(&true))
        };
        in_time && channels.as_ref().is_none_or(|channels| channels.iter().any(is_wanted))
    }
}

fn size_of_loaded(loaded: &Loaded) -> usize {
    loaded.bytes.capacity() + loaded.entries.capacity() * size_of::<Entry>()
}

const _: () = assert!(HELD_BYTES as u64 <= MAX_BLOCK_BYTES);
