//! Where everything is in an MCAP file: topics, counts, and the blocks that hold the messages.
//!
//! A closed file says its topics and counts in a summary at its end. A file whose recorder was killed has none; then the
//! blocks themselves are read once. Either way the file is walked from the front, head by head, so that what an index
//! fails to mention is found as well.

use std::collections::BTreeMap;
use std::ops::Range;

use mcap::records::{self, Record, op};

use crate::error::Error;
use crate::file::{
    FOOTER_AND_MAGIC, HEAD, MESSAGE_HEAD, McapFile, MessageHead, Place, records as records_in,
};

/// Messages outside of chunks are taken together up to this many bytes.
const LOOSE_BLOCK_BYTES: u64 = 1 << 20;
/// Start, end, size, CRC and the length of the compression's name: the head of a chunk up to that name.
const CHUNK_HEAD: usize = 8 + 8 + 8 + 4 + 4;

/// A piece of a file that holds records: the inside of a chunk, or a row of messages outside of chunks.
#[derive(Debug, Clone)]
pub(crate) struct Block {
    /// Earliest log time in it, ns.
    pub(crate) start_ns: u64,
    /// Latest log time in it, ns.
    pub(crate) end_ns: u64,
    /// The records.
    pub(crate) records: Range<u64>,
    /// CRC-32 of the records; 0 where the writer computed none.
    pub(crate) crc: u32,
    /// Not a chunk: more messages may join it.
    is_row: bool,
}

/// The text of a type as the file has it.
#[derive(Debug, Clone)]
pub(crate) struct Schema {
    pub(crate) name: String,
    pub(crate) encoding: String,
    pub(crate) text: String,
}

/// What is in one file.
#[derive(Debug, Default)]
pub(crate) struct FileIndex {
    pub(crate) schemas: BTreeMap<u16, Schema>,
    pub(crate) channels: BTreeMap<u16, records::Channel>,
    /// Messages of each channel.
    pub(crate) counts: BTreeMap<u16, u64>,
    /// In the order of the file.
    pub(crate) blocks: Vec<Block>,
    /// What had to be left out, and why.
    pub(crate) damage: Vec<Error>,
}

impl FileIndex {
    /// Walks through `file`.
    ///
    /// # Errors
    /// For a compressed file or one the system does not let us read. Damage is noted in the index instead.
    pub(crate) fn of(file: &McapFile) -> Result<Self, Error> {
        let mut index = Self::default();
        let has_summary = index.read_summary(file).unwrap_or(false);
        if !has_summary {
            index = Self::default();
        }
        let mut offset = mcap::MAGIC.len() as u64;
        loop {
            if offset == file.len() {
                let reason = "the file ends without its closing records: its recorder was stopped hard";
                index.damage.push(Error::damaged(file.path(), offset, reason));
                break;
            }
            let place = match file.record(offset) {
                Ok(place) => place,
                Err(error @ Error::Damaged { .. }) => {
                    index.damage.push(error);
                    break;
                }
                Err(error) => return Err(error),
            };
            let end = place.content.end;
            match place.opcode {
                op::DATA_END | op::FOOTER => break,
                op::CHUNK => index.add_chunk(file, &place, has_summary)?,
                op::MESSAGE => index.add_loose_message(file, offset, &place, has_summary)?,
                op::SCHEMA | op::CHANNEL if !has_summary => {
                    let content = file.read(place.content)?;
                    let parsed = file.parse(place.opcode, &content, offset);
                    index.note(parsed.map(|record| index_definition(record)));
                }
                _ => {}
            }
            offset = end;
        }
        Ok(index)
    }

    /// Takes topics and counts from the summary at the end; `false` when there is none that can be trusted.
    fn read_summary(&mut self, file: &McapFile) -> Result<bool, Error> {
        let Some(footer_offset) = file.len().checked_sub(FOOTER_AND_MAGIC) else { return Ok(false) };
        let place = file.record(footer_offset)?;
        if place.opcode != op::FOOTER {
            return Ok(false);
        }
        let Record::Footer(footer) = file.parse(op::FOOTER, &file.read(place.content)?, footer_offset)?
        else {
            return Ok(false);
        };
        // The CRC covers the summary and the footer up to the CRC itself.
        let covered = file.read(footer.summary_start..footer_offset + HEAD + 16)?;
        let damaged = footer.summary_crc != 0 && footer.summary_crc != crc32fast::hash(&covered);
        if footer.summary_start == 0 || damaged {
            return Ok(false);
        }
        let mut statistics = None;
        for record in records_in(&covered[..covered.len() - (HEAD as usize + 16)]) {
            let Ok(record) = record else { return Ok(false) };
            match record.opcode {
                op::SCHEMA | op::CHANNEL | op::STATISTICS => {
                    match file.parse(
                        record.opcode,
                        record.content,
                        footer.summary_start + record.offset as u64,
                    )? {
                        Record::Statistics(found) => statistics = Some(found),
                        definition => self.add(index_definition(definition)),
                    }
                }
                _ => {}
            }
        }
        let Some(statistics) = statistics else { return Ok(false) };
        let complete = statistics.channel_count as usize == self.channels.len()
            && usize::from(statistics.schema_count) == self.schemas.len();
        self.counts = statistics.channel_message_counts;
        Ok(complete)
    }

    fn add_chunk(&mut self, file: &McapFile, place: &Place, has_summary: bool) -> Result<(), Error> {
        let offset = place.content.start;
        let Some(block) = chunk_block(file, place)? else {
            self.damage.push(Error::damaged(file.path(), offset, "a chunk with a broken head"));
            return Ok(());
        };
        if has_summary {
            self.blocks.push(block);
            return Ok(());
        }
        let bytes = file.read(block.records.clone())?;
        if let Some(damage) = block.checksum_error(file, &bytes) {
            self.damage.push(damage);
            return Ok(());
        }
        for record in records_in(&bytes) {
            let Ok(record) = record else { break };
            match record.opcode {
                op::SCHEMA | op::CHANNEL => {
                    let parsed =
                        file.parse(record.opcode, record.content, block.records.start + record.offset as u64);
                    self.note(parsed.map(index_definition));
                }
                op::MESSAGE => {
                    if let Some((head, _)) = MessageHead::split(record.content) {
                        *self.counts.entry(head.channel).or_default() += 1;
                    }
                }
                _ => {}
            }
        }
        self.blocks.push(block);
        Ok(())
    }

    fn add_loose_message(
        &mut self,
        file: &McapFile,
        offset: u64,
        place: &Place,
        has_summary: bool,
    ) -> Result<(), Error> {
        let content = &place.content;
        let head = file.read(content.start..content.end.min(content.start + MESSAGE_HEAD as u64))?;
        let Some((head, _)) = MessageHead::split(&head) else {
            self.damage.push(Error::damaged(file.path(), offset, "a message shorter than its head"));
            return Ok(());
        };
        if !has_summary {
            *self.counts.entry(head.channel).or_default() += 1;
        }
        let time = head.log_time_ns;
        match self.blocks.last_mut() {
            Some(last)
                if last.is_row
                    && last.records.end == offset
                    && offset - last.records.start < LOOSE_BLOCK_BYTES =>
            {
                last.records.end = content.end;
                last.start_ns = last.start_ns.min(time);
                last.end_ns = last.end_ns.max(time);
            }
            _ => self.blocks.push(Block {
                start_ns: time,
                end_ns: time,
                records: offset..content.end,
                crc: 0,
                is_row: true,
            }),
        }
        Ok(())
    }

    fn note(&mut self, definition: Result<Definition, Error>) {
        match definition {
            Ok(definition) => self.add(definition),
            Err(error) => self.damage.push(error),
        }
    }

    fn add(&mut self, definition: Definition) {
        match definition {
            Definition::Schema(id, schema) => {
                self.schemas.insert(id, schema);
            }
            Definition::Channel(channel) => {
                self.channels.insert(channel.id, channel);
            }
            Definition::Other => {}
        }
    }
}

enum Definition {
    Schema(u16, Schema),
    Channel(records::Channel),
    Other,
}

fn index_definition(record: Record<'_>) -> Definition {
    match record {
        Record::Schema { header, data } => {
            let text = String::from_utf8_lossy(&data).into_owned();
            Definition::Schema(header.id, Schema { name: header.name, encoding: header.encoding, text })
        }
        Record::Channel(channel) => Definition::Channel(channel),
        _ => Definition::Other,
    }
}

/// Reads the head of a chunk; `None` when it is broken.
fn chunk_block(file: &McapFile, place: &Place) -> Result<Option<Block>, Error> {
    let content = &place.content;
    let head_end = content.start + CHUNK_HEAD as u64;
    if head_end > content.end {
        return Ok(None);
    }
    let head = file.read(content.start..head_end)?;
    let number =
        |at: usize| head.get(at..).and_then(|rest| rest.first_chunk()).copied().map(u64::from_le_bytes);
    let short =
        |at: usize| head.get(at..).and_then(|rest| rest.first_chunk()).copied().map(u32::from_le_bytes);
    let (Some(start_ns), Some(end_ns), Some(crc), Some(name_length)) =
        (number(0), number(8), short(24), short(28))
    else {
        return Ok(None);
    };
    let begin = head_end + u64::from(name_length) + 8;
    if begin > content.end {
        return Ok(None);
    }
    let name_and_size = file.read(head_end..begin)?;
    let Some((name, size)) = name_and_size.split_last_chunk() else { return Ok(None) };
    if !name.is_empty() {
        let what = format!("compression {:?}", String::from_utf8_lossy(name));
        return Err(Error::Unsupported { path: file.path().to_owned(), what });
    }
    let end = begin.checked_add(u64::from_le_bytes(*size)).filter(|end| *end <= content.end);
    Ok(end.map(|end| Block { start_ns, end_ns, records: begin..end, crc, is_row: false }))
}

impl Block {
    /// What to say when `bytes`, read from this block, are not what was written.
    pub(crate) fn checksum_error(&self, file: &McapFile, bytes: &[u8]) -> Option<Error> {
        let found = crc32fast::hash(bytes);
        (self.crc != 0 && self.crc != found).then(|| {
            let size = bytes.len();
            let reason =
                format!("a chunk of {size} bytes with checksum {found:08x} instead of {:08x}", self.crc);
            Error::damaged(file.path(), self.records.start, reason)
        })
    }
}
