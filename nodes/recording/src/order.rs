//! Messages in the order of their log times, with few blocks in memory.
//!
//! Blocks are loaded when the next message could come from them. Blocks that do not overlap in time, as a recorder
//! writes them, are in memory one or two at a time, however long the recording is. Of each, only the wanted messages are
//! kept. Where so many overlap that they would still fill the memory, the largest are dropped and loaded again part by
//! part: that takes time, and loses nothing. Equal times keep the stored order.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap, VecDeque};

use crate::block::{Block, Entry, Loaded, MAX_BLOCK_BYTES};
use crate::error::Error;
use crate::storage::RecordedFile;

/// Blocks in memory besides the one being read, bytes.
const HELD_BYTES: usize = 32 << 20;

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

/// What tells a message from others: the number of its block in the recording, its topic and its log time. Of several the
/// first in stored order comes first, whatever else is wanted.
pub(crate) type Spot = (usize, usize, u64);

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
    held: BTreeMap<usize, Part>,
    held_bytes: usize,
    /// Blocks that were loaded and have messages to come.
    begun: BTreeSet<usize>,
    reading: Option<(Due, Part)>,
    damage: VecDeque<(usize, Error)>,
}

/// When a block is due, by log time and then by the stored order of the blocks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Due {
    time_ns: u64,
    block: usize,
    /// The next one of its wanted messages.
    cursor: usize,
}

/// Wanted messages of a block in memory.
#[derive(Default)]
struct Part {
    /// Number of the first of them in the block.
    first: usize,
    loaded: Loaded,
    /// The log time of the next one behind them, ns; `None` where they are the last.
    next_ns: Option<u64>,
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
            begun: BTreeSet::new(),
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
        let (due, part) = self.reading.as_ref()?;
        let entry = part.entry(due.cursor)?;
        let (topic, log_time_ns) = (entry.channel as usize, entry.log_time_ns);
        Some(Ok(Next { spot: (due.block, topic, log_time_ns), topic, log_time_ns }))
    }

    /// The message that was peeked at.
    pub(crate) fn take(&mut self) -> Option<Found<'_>> {
        let (due, part) = self.reading.as_mut()?;
        let entry = part.entry(due.cursor)?;
        due.cursor += 1;
        Some(Found { entry, data: part.loaded.data(entry) })
    }

    /// Leaves out the message that was peeked at.
    pub(crate) fn skip(&mut self) {
        if let Some((due, _)) = &mut self.reading {
            due.cursor += 1;
        }
    }

    /// Makes `reading` the block with the next message.
    fn advance(&mut self) {
        if let Some((due, part)) = self.reading.take() {
            match part.entry(due.cursor) {
                Some(entry) => {
                    let due = Due { time_ns: entry.log_time_ns, ..due };
                    if self.is_first(due) {
                        self.reading = Some((due, part));
                        return;
                    }
                    self.hold(due, part);
                }
                None => self.end_of_part(due, &part),
            }
        }
        while let Some(Reverse(mut due)) = self.queue.pop() {
            let part = match self.held.remove(&due.block) {
                Some(part) => {
                    self.held_bytes -= part.size();
                    part
                }
                None => self.load(due),
            };
            let Some(entry) = part.entry(due.cursor) else {
                self.end_of_part(due, &part);
                continue;
            };
            due.time_ns = entry.log_time_ns;
            if self.is_first(due) {
                self.reading = Some((due, part));
                return;
            }
            self.hold(due, part);
        }
    }

    fn is_first(&self, due: Due) -> bool {
        self.queue.peek().is_none_or(|Reverse(first)| due < *first)
    }

    /// A part is read: the block has another one, or is done.
    fn end_of_part(&mut self, due: Due, part: &Part) {
        match part.next_ns {
            Some(time_ns) => self.queue.push(Reverse(Due { time_ns, ..due })),
            None => {
                self.begun.remove(&due.block);
            }
        }
    }

    /// Puts a block back into the queue, in memory if there is room for it.
    fn hold(&mut self, due: Due, part: Part) {
        self.queue.push(Reverse(due));
        self.held_bytes += part.size();
        self.held.insert(due.block, part);
        // The largest goes: loaded again, it comes in parts that leave room for the others.
        while self.held_bytes > HELD_BYTES && self.held.len() > 1 {
            let largest = self.held.iter().max_by_key(|(_, part)| part.size()).map(|(block, _)| *block);
            let Some(dropped) = largest.and_then(|block| self.held.remove(&block)) else { return };
            self.held_bytes -= dropped.size();
        }
    }

    /// Loads what is wanted of a block: all of it the first time, and the next part of it when it had to be dropped. What
    /// cannot be loaded is damage, told the first time only.
    fn load(&mut self, due: Due) -> Part {
        let Some(located) = self.blocks.get(due.block) else { return Part::default() };
        let Some(file) = self.files.get(located.file) else { return Part::default() };
        let is_first = self.begun.insert(due.block);
        match file.load(&located.block) {
            Ok(mut loaded) => {
                let damage = std::mem::take(&mut loaded.damage);
                if is_first {
                    self.damage.extend(damage.into_iter().map(|error| (due.block, error)));
                }
                self.keep_wanted(located.file, &mut loaded.entries);
                let share = if is_first { usize::MAX } else { HELD_BYTES / self.begun.len().max(1) };
                Part::of(loaded, due.cursor, share)
            }
            Err(error) => {
                if is_first {
                    self.damage.push_back((due.block, error));
                }
                Part::default()
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

impl Part {
    /// The wanted messages of a block from number `first` on, as many as have `most` bytes, at least one.
    fn of(mut loaded: Loaded, first: usize, most: usize) -> Self {
        let mut wanted = 0;
        let of_entry = |entry: &Entry| entry.data.len() + size_of::<Entry>();
        let rest = loaded.entries.get(first..).unwrap_or_default();
        let fitting = rest.iter().take_while(|entry| {
            wanted += of_entry(entry);
            wanted <= most
        });
        let end = first + fitting.count().max(1);
        let next_ns = loaded.entries.get(end).map(|entry| entry.log_time_ns);
        loaded.entries.truncate(end);
        loaded.entries.drain(..first.min(loaded.entries.len()));
        // Messages of other topics, or of other parts, can be most of a block.
        let wanted: usize = loaded.entries.iter().map(|entry| entry.data.len()).sum();
        if wanted < loaded.bytes.len() / 2 {
            loaded = together(&loaded, wanted);
        }
        Self { first, loaded, next_ns }
    }

    /// The message with a number in the block.
    fn entry(&self, cursor: usize) -> Option<&Entry> {
        self.loaded.entries.get(cursor.checked_sub(self.first)?)
    }

    fn size(&self) -> usize {
        self.loaded.bytes.capacity() + self.loaded.entries.capacity() * size_of::<Entry>()
    }
}

/// A copy with the bytes of its messages alone, which are `wanted`.
fn together(loaded: &Loaded, wanted: usize) -> Loaded {
    let mut bytes = Vec::with_capacity(wanted);
    let mut entries = Vec::with_capacity(loaded.entries.len());
    for entry in &loaded.entries {
        // Fewer than in the block, which is far smaller than 4 GiB.
        let begin = bytes.len() as u32;
        bytes.extend_from_slice(loaded.data(entry));
        entries.push(Entry { data: begin..bytes.len() as u32, ..entry.clone() });
    }
    Loaded { bytes, entries, damage: Vec::new() }
}

const _: () = assert!(HELD_BYTES as u64 <= MAX_BLOCK_BYTES);
