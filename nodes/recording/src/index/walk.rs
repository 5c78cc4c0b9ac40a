//! The walk through a file from its front: where each record begins, and what is taken from it.

use std::collections::BTreeMap;

use mcap::records::op;

use crate::block::{Block, FileIndex, MAX_BLOCK_BYTES, Place};
use crate::described::{Definition, Definitions};
use crate::error::Error;
use crate::file::{HEAD, MESSAGE_HEAD, McapFile, MessageHead};
use crate::fit::{ChannelSet, Fit, View};
use crate::summary::Summary;

/// Messages outside of chunks are taken together up to this many bytes.
const ROW_BYTES: u64 = 1 << 20;
/// Broken places that are told one by one.
const TOLD: usize = 1000;

/// A walk through a file.
pub(super) struct Walk<'a> {
    pub(super) file: &'a McapFile,
    /// What the file says about itself, as long as it is believed.
    pub(super) summary: Option<&'a Summary>,
    /// Bytes that chunks may still decompress to, and what they decompress to so far.
    pub(super) allowance: u64,
    pub(super) decompressed: u64,
    pub(super) definitions: Definitions,
    /// From chunks that are not what was written: what is nowhere else.
    pub(super) doubtful: Definitions,
    /// The channels heard of so far.
    pub(super) channels: ChannelSet,
    pub(super) counts: BTreeMap<u16, u64>,
    /// Something is broken, and behind it a channel is described: its messages before may have been passed over.
    pub(super) is_described_late: bool,
    pub(super) has_gap: bool,
    /// Where the last chunk begins, and those of its channels of which no message index came yet.
    pub(super) unseen: Option<(u64, Vec<u32>)>,
    /// The first chunk of which the summary lists other channels than the message indexes behind it.
    pub(super) lie: Option<u64>,
    pub(super) blocks: Vec<Block>,
    pub(super) chunks: u64,
    pub(super) loose_messages: u64,
    pub(super) damage: Vec<Error>,
    pub(super) untold: u64,
    pub(super) is_closed: bool,
}

impl<'a> Walk<'a> {
    pub(super) fn new(file: &'a McapFile, allowance: u64, summary: Option<&'a Summary>) -> Self {
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

    pub(super) fn go(&mut self, view: &mut View<'_>) -> Result<(), Error> {
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
    pub(super) fn agrees_with(&self, summary: &Summary) -> bool {
        let all_messages_are_loose = summary.statistics.chunk_count == 0;
        self.damage.is_empty()
            && self.lie.is_none()
            && self.chunks == u64::from(summary.statistics.chunk_count)
            && (!all_messages_are_loose || self.loose_messages == summary.statistics.message_count)
    }

    /// Notes when other messages can be read than the summary has counted and nothing else says why.
    pub(super) fn compare_with(&mut self, summary: &Summary) {
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
    pub(super) fn note_at(&mut self, offset: u64, reason: impl FnOnce() -> String) {
        if self.damage.len() < TOLD {
            self.damage.push(self.damaged(offset, reason()));
        } else {
            self.untold += 1;
        }
    }

    pub(super) fn note(&mut self, error: Error) {
        if self.damage.len() < TOLD {
            self.damage.push(error);
        } else {
            self.untold += 1;
        }
    }

    pub(super) fn finish(mut self) -> FileIndex {
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
pub(super) fn of_kind(opcode: u8, reason: &str) -> String {
    format!("record of kind {opcode:#04x}: {reason}")
}
