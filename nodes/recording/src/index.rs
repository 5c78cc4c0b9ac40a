//! Where everything is in an MCAP file: topics, counts, and the blocks that hold the messages.
//!
//! A closed file says its topics and counts in a summary at its end. Where there is none, it does not count by channel, or
//! it does not agree with what is there, the blocks themselves are read once. Either way the file is walked from the front, head by head, so that what
//! an index fails to mention is found as well; and behind a broken place the walk goes on with the next record there is.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;

use mcap::records::op;

use crate::block::{Block, Chunk, FileIndex, MAX_BLOCK_BYTES, Place};
use crate::chunk::{self, ChunkHead, Inside, Strange};
use crate::compression;
use crate::described::{Definition, Definitions};
use crate::error::Error;
use crate::file::{HEAD, MESSAGE_HEAD, McapFile, MessageHead};
use crate::fit::{ChannelSet, Fit, View};
use crate::records::{Piece, Pieces};
use crate::summary::{self, Ending, Summary};

/// Messages outside of chunks are taken together up to this many bytes.
const ROW_BYTES: u64 = 1 << 20;
/// Broken places that are told one by one.
const TOLD: usize = 1000;

/// Finds what is in `file`. Its chunks may decompress to `allowance` bytes altogether.
///
/// # Errors
/// When it has nothing of an MCAP file, or the system does not let us read. Damage is noted in the index instead.
pub(crate) fn of(file: &McapFile, allowance: u64) -> Result<FileIndex, Error> {
    let mut view = View::new(file);
    let ending = summary::read(file)?;
    let mut lie = None;
    if let Ending::Whole(summary) = &ending
        && summary.counts_channels()
    {
        let mut walk = Walk::new(file, allowance, Some(summary));
        walk.go(&mut view)?;
        if walk.agrees_with(summary) {
            walk.definitions = summary.definitions.clone();
            walk.counts.clone_from(&summary.statistics.channel_message_counts);
            return Ok(FileIndex { is_counted: true, ..walk.finish() });
        }
        lie = walk.lie;
    }
    let mut walk = Walk::new(file, allowance, None);
    if let Ending::Whole(summary) = &ending
        && summary.is_checked
    {
        walk.definitions = summary.definitions.clone();
        for id in summary.definitions.channels() {
            walk.channels.insert(id);
        }
    }
    walk.go(&mut view)?;
    if walk.is_described_late {
        let mut again = Walk::new(file, allowance, None);
        again.channels = walk.channels;
        again.go(&mut View::new(file))?;
        walk = again;
    }
    match ending {
        Ending::Whole(summary) => {
            walk.definitions.complete_from(&summary.definitions);
            if let Some(offset) = lie {
                walk.note_at(offset, || {
                    "a chunk of which the summary lists other channels than the indexes behind it; the file is read \
                     without its summary"
                        .to_owned()
                });
            }
            walk.compare_with(&summary);
        }
        Ending::Broken(error) if walk.is_closed => walk.note(error),
        Ending::Broken(_) | Ending::Without => {}
    }
    let index = walk.finish();
    let begins_well = view.bytes(0, mcap::MAGIC.len() as u64)? == mcap::MAGIC;
    if !begins_well && index.blocks.is_empty() {
        let reason = "the file does not begin with the MCAP magic bytes".to_owned();
        return Err(Error::NotARecording { path: file.path().to_owned(), reason });
    }
    Ok(index)
}

/// A walk through a file.
struct Walk<'a> {
    file: &'a McapFile,
    /// What the file says about itself, as long as it is believed.
    summary: Option<&'a Summary>,
    /// Bytes that chunks may still decompress to, and what they decompress to so far.
    allowance: u64,
    decompressed: u64,
    definitions: Definitions,
    /// From chunks that are not what was written: what is nowhere else.
    doubtful: Definitions,
    /// The channels heard of so far.
    channels: ChannelSet,
    counts: BTreeMap<u16, u64>,
    /// Something is broken, and behind it a channel is described: its messages before may have been passed over.
    is_described_late: bool,
    has_gap: bool,
    /// Where the last chunk begins, and those of its channels of which no message index came yet.
    unseen: Option<(u64, Vec<u32>)>,
    /// The first chunk of which the summary lists other channels than the message indexes behind it.
    lie: Option<u64>,
    blocks: Vec<Block>,
    chunks: u64,
    loose_messages: u64,
    damage: Vec<Error>,
    untold: u64,
    is_closed: bool,
}

impl<'a> Walk<'a> {
    fn new(file: &'a McapFile, allowance: u64, summary: Option<&'a Summary>) -> Self {
        let mut channels = ChannelSet::default();
        for id in summary.iter().flat_map(|summary| summary.definitions.channels()) {
            channels.insert(id);
        }
        Self {
            file,
            summary,
            allowance,
            decompressed: 0,
            definitions: Definitions::default(),
            doubtful: Definitions::default(),
            channels,
            is_described_late: false,
            has_gap: false,
            unseen: None,
            lie: None,
            counts: BTreeMap::new(),
            blocks: Vec::new(),
            chunks: 0,
            loose_messages: 0,
            damage: Vec::new(),
            untold: 0,
            is_closed: false,
        }
    }

    fn go(&mut self, view: &mut View<'_>) -> Result<(), Error> {
        let magic = mcap::MAGIC.len() as u64;
        let mut offset = magic;
        if view.bytes(0, magic)? != mcap::MAGIC {
            self.note_at(0, || "the file does not begin with the MCAP magic bytes".to_owned());
            self.has_gap = true;
            // Bytes may be missing or too many here.
            let is_whole_behind = matches!(view.fit(magic)?, Fit::Sure(_));
            match if is_whole_behind { Some(magic) } else { view.search(0, &self.channels)? } {
                Some(found) => offset = found,
                None => return Ok(()),
            }
        }
        while !self.is_closed && offset < self.file.len() {
            offset = self.step(view, offset)?;
        }
        if !self.is_closed {
            self.note(Error::NotClosed { path: self.file.path().to_owned(), offset: self.file.len() });
        }
        self.end_of_indexes();
        Ok(())
    }

    /// Takes the record at `offset`, or what is broken there, and says where to go on.
    fn step(&mut self, view: &mut View<'_>, offset: u64) -> Result<u64, Error> {
        let fit = view.fit(offset)?;
        if let Some(next) = self.covered(view, offset, fit)? {
            return Ok(next);
        }
        if let Fit::Sure(end) | Fit::Maybe(end) = fit
            && (fit == Fit::Sure(end) || view.goes_on(end)?)
        {
            return self.take(view, offset, end);
        }
        if let Some((head, end)) = view.chunk(offset)?
            && end < self.file.len()
            && view.goes_on(end)?
        {
            self.note_at(offset, || "a chunk whose record has a wrong kind or length".to_owned());
            return self.take_chunk(offset, end, head);
        }
        self.has_gap = true;
        let next = view.search(offset + 1, &self.channels)?;
        let end_of_damage = next.unwrap_or(self.file.len());
        if let Fit::Maybe(end) = fit
            && end <= end_of_damage
        {
            // What follows is broken, not this.
            return self.take(view, offset, end);
        }
        let lost = end_of_damage - offset;
        let left = (self.file.len() - offset).saturating_sub(HEAD);
        let head = view.head(offset)?;
        self.note_at(offset, || match head {
            Some((kind, length)) => format!(
                "a broken record (kind {kind:#04x}, {length} bytes, and {left} bytes are left in the file); {lost} bytes are left out"
            ),
            None => format!("the file ends inside a record, after {lost} bytes of it"),
        });
        // Of a compressed chunk that is cut, some decompresses.
        if let Some((op::CHUNK, _)) = head
            && let Some(mut cut) = view.beginning_of_chunk(offset)?
            && !cut.chunk.compression.is_empty()
            && (cut.chunk.records.start..cut.chunk.records.end).contains(&end_of_damage)
        {
            cut.chunk.records.end = end_of_damage;
            return self.take_chunk(offset, end_of_damage, cut);
        }
        Ok(end_of_damage)
    }

    /// Where the messages begin that a record at `offset` only covers because its length is broken. A whole file is not
    /// asked: its summary counts what is there. Nor are chunks and attachments, whose inner lengths tell.
    fn covered(&mut self, view: &mut View<'_>, offset: u64, fit: Fit) -> Result<Option<u64>, Error> {
        let Fit::Maybe(end) = fit else { return Ok(None) };
        let Some((kind, length)) = view.head(offset)? else { return Ok(None) };
        if self.summary.is_some() || kind != op::MESSAGE && kind <= op::DATA_END {
            return Ok(None);
        }
        let next = view.row_within(offset + HEAD..end, &self.channels)?;
        if let Some(next) = next {
            self.note_at(offset, || {
                let lost = next - offset;
                format!(
                    "a record (kind {kind:#04x}) of {length} bytes inside of which messages begin; {lost} bytes are left out"
                )
            });
        }
        Ok(next)
    }

    /// Takes the record between two places.
    fn take(&mut self, view: &mut View<'_>, offset: u64, end: u64) -> Result<u64, Error> {
        let Some((opcode, _)) = view.head(offset)? else { return Ok(end) };
        match opcode {
            op::FOOTER => self.is_closed = true,
            op::CHUNK => {
                if let Some((head, _)) = view.chunk(offset)? {
                    return self.take_chunk(offset, end, head);
                }
            }
            op::MESSAGE => {
                let record = view.bytes(offset, HEAD + MESSAGE_HEAD as u64)?;
                if let Some((head, _)) = record.get(HEAD as usize..).and_then(MessageHead::split) {
                    self.take_message(offset, end, head);
                }
            }
            op::SCHEMA | op::CHANNEL if self.summary.is_none() && end - offset <= MAX_BLOCK_BYTES => {
                let record = view.bytes(offset, end - offset)?;
                let definition = Definition::parse(opcode, record.get(HEAD as usize..).unwrap_or_default());
                match definition {
                    Ok(definition) => {
                        self.hear_of(&definition);
                        self.definitions.add(definition);
                    }
                    Err(reason) => self.note_at(offset, || of_kind(opcode, reason)),
                }
            }
            op::MESSAGE_INDEX if self.summary.is_some() => {
                let channel = view.bytes(offset + HEAD, 2)?.first_chunk().copied().map(u16::from_le_bytes);
                self.take_message_index(channel);
            }
            // Records of applications begin at 0x80; between them and those of the format there are none yet.
            _ if !(op::HEADER..=op::DATA_END).contains(&opcode) && opcode < 0x80 => {
                self.note_at(offset, || {
                    format!("a record of unknown kind {opcode:#04x}; {} bytes are left out", end - offset)
                });
            }
            _ => {}
        }
        Ok(end)
    }

    fn take_chunk(&mut self, offset: u64, end: u64, head: ChunkHead) -> Result<u64, Error> {
        // Those of a chunk without messages can be anything, also where there are messages.
        let has_times = head.has_times() && !head.chunk.records.is_empty();
        let ChunkHead { start_ns, end_ns, chunk } = head;
        self.chunks += 1;
        self.end_of_indexes();
        if !compression::KNOWN.contains(&chunk.compression.as_str()) {
            self.note_at(offset, || compression::unknown(&chunk.compression));
            return Ok(end);
        }
        let is_plain = chunk.compression.is_empty();
        let stored = chunk::stored(&chunk);
        if is_plain && chunk.size != stored {
            self.note_at(offset, || {
                format!("a chunk of {stored} bytes without compression that says it has {}", chunk.size)
            });
        }
        if is_plain && stored > MAX_BLOCK_BYTES {
            // Too large for one block: its records are taken one by one as if there were no chunk.
            return Ok(chunk.records.start);
        }
        if !is_plain {
            let size = chunk.size.min(MAX_BLOCK_BYTES);
            let Some(left) = self.allowance.checked_sub(size) else {
                self.note_at(offset, || {
                    "a chunk behind others that decompress to more than is accepted of a recording of this size"
                        .to_owned()
                });
                return Ok(end);
            };
            self.allowance = left;
            self.decompressed = self.decompressed.saturating_add(size);
        }
        let indexed = self.summary.and_then(|summary| Some((summary, summary.chunks.get(&offset)?)));
        let is_as_indexed = indexed.is_some_and(|(_, index)| {
            index.message_start_time == start_ns && index.message_end_time == end_ns && has_times
        });
        match indexed {
            Some((summary, index)) if is_as_indexed => {
                let channels: Vec<u32> = index.message_index_offsets.keys().copied().map(u32::from).collect();
                self.unseen = Some((offset, channels.clone()));
                // Without message indexes the chunk may still have messages, and without a checksum any others.
                let channels = (summary.is_checked && !channels.is_empty()).then(|| channels.into());
                self.blocks.push(Block { start_ns, end_ns, channels, place: Place::Chunk(chunk) });
            }
            _ => self.read_chunk(chunk, start_ns..=end_ns),
        }
        Ok(end)
    }

    fn hear_of(&mut self, definition: &Definition<'_>) {
        let is_new = self.channels.insert_described(definition);
        self.is_described_late |= is_new && self.has_gap;
    }

    /// Takes the message index of a channel, which stands behind its chunk.
    fn take_message_index(&mut self, channel: Option<u16>) {
        if let Some((chunk, unseen)) = &mut self.unseen {
            let place = unseen.iter().position(|id| Some(*id) == channel.map(u32::from));
            match place {
                Some(place) => {
                    unseen.swap_remove(place);
                }
                None => self.lie = self.lie.or(Some(*chunk)),
            }
        }
    }

    /// No message index of the last chunk comes any more.
    fn end_of_indexes(&mut self) {
        if let Some((chunk, unseen)) = self.unseen.take()
            && !unseen.is_empty()
        {
            self.lie = self.lie.or(Some(chunk));
        }
    }

    /// Counts what is in a chunk of which no summary tells. What is broken in it is told when it is read.
    fn read_chunk(&mut self, chunk: Chunk, times_ns: RangeInclusive<u64>) {
        let Inside { bytes, fault } = match chunk::inside(self.file, &chunk) {
            Ok(inside) => inside,
            Err(error) => return self.note(error),
        };
        let mut messages: Vec<(u64, u16)> = Vec::new();
        let mut lost = Strange::default();
        let mut unread = Strange::default();
        let mut what_is_unread = None;
        let mut pieces = Pieces::new(&bytes, chunk::stored(&chunk));
        while let Some(piece) = pieces.next(|channel| self.channels.contains(channel)) {
            match piece {
                Piece::Record(record) if record.opcode == op::MESSAGE => {
                    if let Some((head, _)) = MessageHead::split(record.content) {
                        messages.push((head.log_time_ns, head.channel));
                    }
                }
                Piece::Record(record) if matches!(record.opcode, op::SCHEMA | op::CHANNEL) => {
                    match Definition::parse(record.opcode, record.content) {
                        Ok(definition) => {
                            self.hear_of(&definition);
                            let is_sure = fault.is_none();
                            if is_sure { &mut self.definitions } else { &mut self.doubtful }.add(definition);
                        }
                        Err(reason) => {
                            unread.add(record.offset, 1);
                            what_is_unread.get_or_insert((record.opcode, reason));
                        }
                    }
                }
                Piece::Record(_) => {}
                Piece::Lost(range) => lost.add(range.start, range.len() as u64),
            }
        }
        let begin = chunk.records.start;
        if let Some((opcode, reason)) = what_is_unread {
            let count = unread.count;
            self.note_at(begin, || {
                format!("{count} definitions that cannot be read; the first: {}", of_kind(opcode, reason))
            });
        }
        if fault.is_some() {
            // A few messages far from the chunk's times have a broken time; or those times are what is broken.
            let is_inside = |(time, _): &(u64, u16)| times_ns.contains(time);
            if messages.iter().filter(|message| is_inside(message)).count() * 2 > messages.len() {
                messages.retain(is_inside);
            }
        }
        let times = || messages.iter().map(|(time, _)| *time);
        let (Some(start_ns), Some(end_ns)) = (times().min(), times().max()) else {
            // Nothing to load.
            fault.into_iter().for_each(|fault| self.note(fault));
            if lost.count > 0 {
                self.note_at(begin, || chunk::lost_inside(lost.count, !chunk.compression.is_empty()));
            }
            return;
        };
        let mut channels = BTreeSet::new();
        for (_, channel) in &messages {
            self.channels.insert(*channel);
            channels.insert(u32::from(*channel));
            *self.counts.entry(*channel).or_default() += 1;
        }
        let channels = Some(channels.into_iter().collect());
        self.blocks.push(Block { start_ns, end_ns, channels, place: Place::Chunk(chunk) });
    }

    fn take_message(&mut self, offset: u64, end: u64, head: MessageHead) {
        if end - offset > MAX_BLOCK_BYTES {
            return self.note_at(offset, || {
                format!("a message of {} bytes; accepted: {MAX_BLOCK_BYTES}", end - offset)
            });
        }
        self.loose_messages += 1;
        self.channels.insert(head.channel);
        *self.counts.entry(head.channel).or_default() += 1;
        let time = head.log_time_ns;
        let channel = u32::from(head.channel);
        if let Some(Block { start_ns, end_ns, channels, place: Place::Row { records } }) =
            self.blocks.last_mut()
            && records.end == offset
            && end - records.start <= ROW_BYTES
        {
            records.end = end;
            *start_ns = time.min(*start_ns);
            *end_ns = time.max(*end_ns);
            if let Some(known) = channels
                && let Err(place) = known.binary_search(&channel)
            {
                let mut more = known.to_vec();
                more.insert(place, channel);
                *channels = Some(more.into());
            }
            return;
        }
        let place = Place::Row { records: offset..end };
        self.blocks.push(Block { start_ns: time, end_ns: time, channels: Some([channel].into()), place });
    }

    /// Whether the summary can stand for the file: everything in it is there, and nothing is broken.
    fn agrees_with(&self, summary: &Summary) -> bool {
        let all_messages_are_loose = summary.statistics.chunk_count == 0;
        self.damage.is_empty()
            && self.lie.is_none()
            && self.chunks == u64::from(summary.statistics.chunk_count)
            && (!all_messages_are_loose || self.loose_messages == summary.statistics.message_count)
    }

    /// Notes when other messages can be read than the summary has counted and nothing else says why.
    fn compare_with(&mut self, summary: &Summary) {
        let found: u64 = self.counts.values().sum();
        let announced = summary.statistics.message_count;
        if self.damage.is_empty() && found != announced {
            self.note_at(self.file.len(), || {
                format!("the summary counts {announced} messages, and there are {found}")
            });
        }
    }

    fn damaged(&self, offset: u64, reason: impl Into<String>) -> Error {
        Error::damaged(self.file.path(), offset, reason)
    }

    /// As [`Walk::note`]. A file can have a million broken places, so nothing is made of those that are not told.
    fn note_at(&mut self, offset: u64, reason: impl FnOnce() -> String) {
        if self.damage.len() < TOLD {
            self.damage.push(self.damaged(offset, reason()));
        } else {
            self.untold += 1;
        }
    }

    fn note(&mut self, error: Error) {
        if self.damage.len() < TOLD {
            self.damage.push(error);
        } else {
            self.untold += 1;
        }
    }

    fn finish(mut self) -> FileIndex {
        let end = self.file.len();
        if self.untold > 0 {
            let more = self.damaged(end, format!("{} more broken places in the file", self.untold));
            self.damage.push(more);
        }
        self.definitions.complete_from(&self.doubtful);
        let (topics, left_out) = self.definitions.topics(&self.counts);
        let left_out = left_out.map(|reason| self.damaged(end, reason));
        self.damage.extend(left_out);
        FileIndex {
            topics,
            blocks: self.blocks,
            damage: self.damage,
            decompressed_bytes: self.decompressed,
            is_counted: false,
        }
    }
}

/// What is wrong with a record of a kind.
fn of_kind(opcode: u8, reason: &str) -> String {
    format!("record of kind {opcode:#04x}: {reason}")
}
