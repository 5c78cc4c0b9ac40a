//! What the walk takes from a chunk: as the summary tells it, or read.

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use mcap::records::op;

use super::walk::{Walk, of_kind};
use crate::block::{Block, Chunk, MAX_BLOCK_BYTES, Place};
use crate::chunk::{self, ChunkHead, Inside, Strange};
use crate::compression;
use crate::described::Definition;
use crate::error::Error;
use crate::file::MessageHead;
use crate::records::{Piece, Pieces};

impl Walk<'_> {
    pub(super) fn take_chunk(&mut self, offset: u64, end: u64, head: ChunkHead) -> Result<u64, Error> {
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

    pub(super) fn hear_of(&mut self, definition: &Definition<'_>) {
        let is_new = self.channels.insert_described(definition);
        self.is_described_late |= is_new && self.has_gap;
    }

    /// Takes the message index of a channel, which stands behind its chunk.
    pub(super) fn take_message_index(&mut self, channel: Option<u16>) {
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
    pub(super) fn end_of_indexes(&mut self) {
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
}
