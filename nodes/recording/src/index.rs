//! Where everything is in an MCAP file: topics, counts, and the blocks that hold the messages.
//!
//! A closed file says its topics and counts in a summary at its end. Where there is none, or it does not agree with what is
//! there, the blocks themselves are read once. Either way the file is walked from the front, head by head, so that what
//! an index fails to mention is found as well; and behind a broken place the walk goes on with the next record there is.

use std::collections::{BTreeMap, BTreeSet};

use mcap::records::op;

use crate::MessageDefinition;
use crate::block::{Block, Chunk, FileIndex, MAX_BLOCK_BYTES, Place};
use crate::chunk::{self, ChunkHead};
use crate::compression;
use crate::error::Error;
use crate::file::{HEAD, MESSAGE_HEAD, McapFile, MessageHead, records as records_in};
use crate::fit::{Fit, View};
use crate::qos;
use crate::summary::{self, Definitions, Ending, Summary};
use crate::topic::{RecordedTopic, Topic};

/// Messages outside of chunks are taken together up to this many bytes.
const ROW_BYTES: u64 = 1 << 20;
/// Broken places that are told one by one.
const TOLD: usize = 1000;
/// Longest text of a quality of service. One publisher has 300 bytes, and reading YAML takes fifty times its size.
const QOS_BYTES: usize = 1 << 18;
/// What the definitions of all topics may take. A type has a few kB, and each of its topics has its own copy.
const DEFINITIONS_BYTES: usize = 32 << 20;

/// Finds what is in `file`. Its chunks may decompress to `allowance` bytes altogether.
///
/// # Errors
/// When it has nothing of an MCAP file, or the system does not let us read. Damage is noted in the index instead.
pub(crate) fn of(file: &McapFile, allowance: u64) -> Result<FileIndex, Error> {
    let mut view = View::new(file);
    let ending = summary::read(file)?;
    if let Ending::Whole(summary) = &ending {
        let mut walk = Walk::new(file, allowance, Some(summary));
        walk.go(&mut view)?;
        if walk.agrees_with(summary) {
            walk.definitions = summary.definitions.clone();
            walk.counts.clone_from(&summary.statistics.channel_message_counts);
            return Ok(walk.finish());
        }
    }
    let mut walk = Walk::new(file, allowance, None);
    if let Ending::Whole(summary) = &ending
        && summary.is_checked
    {
        walk.definitions = summary.definitions.clone();
    }
    walk.go(&mut view)?;
    match ending {
        Ending::Whole(summary) => {
            walk.definitions.complete_from(&summary.definitions);
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
    /// Bytes that chunks may still decompress to.
    allowance: u64,
    definitions: Definitions,
    counts: BTreeMap<u16, u64>,
    blocks: Vec<Block>,
    chunks: u64,
    loose_messages: u64,
    damage: Vec<Error>,
    untold: u64,
    is_closed: bool,
}

impl<'a> Walk<'a> {
    fn new(file: &'a McapFile, allowance: u64, summary: Option<&'a Summary>) -> Self {
        Self {
            file,
            summary,
            allowance,
            definitions: Definitions::default(),
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
            self.note(self.damaged(0, "the file does not begin with the MCAP magic bytes"));
            // Bytes may be missing or too many here.
            let is_whole_behind = matches!(view.fit(magic)?, Fit::Sure(_));
            match if is_whole_behind { Some(magic) } else { view.search(0, &self.channels())? } {
                Some(found) => offset = found,
                None => return Ok(()),
            }
        }
        while !self.is_closed && offset < self.file.len() {
            offset = self.step(view, offset)?;
        }
        if !self.is_closed {
            let reason = "the file ends without its closing records: its recorder was stopped hard";
            self.note(self.damaged(self.file.len(), reason));
        }
        Ok(())
    }

    /// Takes the record at `offset`, or what is broken there, and says where to go on.
    fn step(&mut self, view: &mut View<'_>, offset: u64) -> Result<u64, Error> {
        let fit = view.fit(offset)?;
        if let Fit::Sure(end) | Fit::Maybe(end) = fit
            && (fit == Fit::Sure(end) || view.goes_on(end)?)
        {
            return self.take(view, offset, end);
        }
        if let Some((head, end)) = view.chunk(offset)?
            && end < self.file.len()
            && view.goes_on(end)?
        {
            self.note(self.damaged(offset, "a chunk whose record has a wrong kind or length"));
            return self.take_chunk(offset, end, head);
        }
        let next = view.search(offset + 1, &self.channels())?;
        let end_of_damage = next.unwrap_or(self.file.len());
        if let Fit::Maybe(end) = fit
            && end <= end_of_damage
        {
            // What follows is broken, not this.
            return self.take(view, offset, end);
        }
        let lost = end_of_damage - offset;
        let reason = match view.head(offset)? {
            Some((kind, length)) => {
                let left = self.file.len() - offset - HEAD;
                format!(
                    "a broken record (kind {kind:#04x}, {length} bytes, and {left} bytes are left in the file); {lost} bytes are left out"
                )
            }
            None => format!("the file ends inside a record, after {lost} bytes of it"),
        };
        self.note(self.damaged(offset, reason));
        Ok(end_of_damage)
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
                let content = self.file.read(offset + HEAD..end)?;
                match self.file.parse(opcode, &content, offset) {
                    Ok(definition) => self.definitions.add(definition),
                    Err(error) => self.note(error),
                }
            }
            // Records of applications begin at 0x80; between them and those of the format there are none yet.
            _ if !(op::HEADER..=op::DATA_END).contains(&opcode) && opcode < 0x80 => {
                let reason =
                    format!("a record of unknown kind {opcode:#04x}; {} bytes are left out", end - offset);
                self.note(self.damaged(offset, reason));
            }
            _ => {}
        }
        Ok(end)
    }

    fn take_chunk(&mut self, offset: u64, end: u64, head: ChunkHead) -> Result<u64, Error> {
        let ChunkHead { start_ns, end_ns, chunk } = head;
        self.chunks += 1;
        if !compression::KNOWN.contains(&chunk.compression.as_str()) {
            self.note(self.damaged(offset, compression::unknown(&chunk.compression)));
            return Ok(end);
        }
        let is_plain = chunk.compression.is_empty();
        let stored = chunk.records.end - chunk.records.start;
        if is_plain && chunk.size != stored {
            let reason =
                format!("a chunk of {stored} bytes without compression that says it has {}", chunk.size);
            self.note(self.damaged(offset, reason));
        }
        if is_plain && stored > MAX_BLOCK_BYTES {
            // Too large for one block: its records are taken one by one as if there were no chunk.
            return Ok(chunk.records.start);
        }
        if !is_plain {
            let Some(left) = self.allowance.checked_sub(chunk.size.min(MAX_BLOCK_BYTES)) else {
                let reason =
                    "a chunk behind others that decompress to more than is accepted of a file of this size";
                self.note(self.damaged(offset, reason));
                return Ok(end);
            };
            self.allowance = left;
        }
        let indexed = self.summary.and_then(|summary| summary.chunks.get(&offset));
        // Times that are zero are those of a chunk without messages, as in a recording that has none.
        let has_times = (start_ns, end_ns) != (0, 0) && !is_empty(&chunk);
        let is_as_indexed = indexed.is_some_and(|index| {
            index.message_start_time == start_ns && index.message_end_time == end_ns && has_times
        });
        match indexed {
            Some(index) if is_as_indexed => {
                let channels: Box<[u32]> =
                    index.message_index_offsets.keys().map(|id| u32::from(*id)).collect();
                // Without message indexes the chunk may still have messages.
                let channels = (!channels.is_empty()).then_some(channels);
                self.blocks.push(Block { start_ns, end_ns, channels, place: Place::Chunk(chunk) });
            }
            _ => self.read_chunk(chunk),
        }
        Ok(end)
    }

    /// Counts what is in a chunk of which no summary tells.
    fn read_chunk(&mut self, chunk: Chunk) {
        let bytes = match chunk::bytes_of(self.file, &chunk) {
            Ok(bytes) => bytes,
            Err(error) => return self.note(error),
        };
        let mut bounds: Option<(u64, u64)> = None;
        let mut channels = BTreeSet::new();
        // What is broken in it is told when it is read.
        for record in records_in(&bytes).map_while(Result::ok) {
            match record.opcode {
                op::SCHEMA | op::CHANNEL => {
                    match self.file.parse(record.opcode, record.content, chunk.records.start) {
                        Ok(definition) => self.definitions.add(definition),
                        Err(error) => self.note(error),
                    }
                }
                op::MESSAGE => {
                    if let Some((head, _)) = MessageHead::split(record.content) {
                        let time = head.log_time_ns;
                        let (start, end) = bounds.unwrap_or((time, time));
                        bounds = Some((start.min(time), end.max(time)));
                        channels.insert(u32::from(head.channel));
                        *self.counts.entry(head.channel).or_default() += 1;
                    }
                }
                _ => {}
            }
        }
        // A chunk of definitions alone has nothing to load, unless it is broken.
        let (start_ns, end_ns) = match bounds {
            Some(bounds) => bounds,
            None if records_in(&bytes).all(|record| record.is_ok()) => return,
            None => (0, 0),
        };
        let channels = bounds.map(|_| channels.into_iter().collect());
        self.blocks.push(Block { start_ns, end_ns, channels, place: Place::Chunk(chunk) });
    }

    fn take_message(&mut self, offset: u64, end: u64, head: MessageHead) {
        if end - offset > MAX_BLOCK_BYTES {
            let reason = format!("a message of {} bytes; accepted: {MAX_BLOCK_BYTES}", end - offset);
            return self.note(self.damaged(offset, reason));
        }
        self.loose_messages += 1;
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

    /// The channels known so far.
    fn channels(&self) -> BTreeSet<u16> {
        let indexed = self.summary.map(|summary| &summary.definitions.channels);
        let seen = self.counts.keys();
        self.definitions
            .channels
            .keys()
            .chain(indexed.into_iter().flat_map(BTreeMap::keys))
            .chain(seen)
            .copied()
            .collect()
    }

    /// Whether the summary can stand for the file: everything in it is there, and nothing is broken.
    fn agrees_with(&self, summary: &Summary) -> bool {
        let all_messages_are_loose = summary.statistics.chunk_count == 0;
        self.damage.is_empty()
            && self.chunks == u64::from(summary.statistics.chunk_count)
            && (!all_messages_are_loose || self.loose_messages == summary.statistics.message_count)
    }

    /// Notes when other messages can be read than the summary has counted and nothing else says why.
    fn compare_with(&mut self, summary: &Summary) {
        let found: u64 = self.counts.values().sum();
        let announced = summary.statistics.message_count;
        if self.damage.is_empty() && found != announced {
            let reason = format!("the summary counts {announced} messages, and there are {found}");
            self.note(self.damaged(self.file.len(), reason));
        }
    }

    fn damaged(&self, offset: u64, reason: impl Into<String>) -> Error {
        Error::damaged(self.file.path(), offset, reason)
    }

    fn note(&mut self, error: Error) {
        if self.damage.len() < TOLD {
            self.damage.push(error);
        } else {
            self.untold += 1;
        }
    }

    fn finish(mut self) -> FileIndex {
        if self.untold > 0 {
            let more =
                self.damaged(self.file.len(), format!("{} more broken places in the file", self.untold));
            self.damage.push(more);
        }
        let Definitions { schemas, channels } = &self.definitions;
        let mut left = DEFINITIONS_BYTES;
        let mut too_long = 0_u64;
        let topics = channels.iter().map(|(id, channel)| {
            let schema = schemas.get(&channel.schema_id);
            let text_of = |key: &str| channel.metadata.get(key).map_or("", String::as_str);
            let text = schema.map_or("", |schema| &schema.text);
            let fits = left.checked_sub(text.len());
            left = fits.unwrap_or(left);
            too_long += u64::from(fits.is_none());
            let qos_text = text_of("offered_qos_profiles");
            let topic = Topic {
                name: channel.topic.clone(),
                type_name: schema.map(|schema| schema.name.clone()).unwrap_or_default(),
                serialization_format: channel.message_encoding.clone(),
                // A QoS nobody can read is one that is not known.
                offered_qos: match qos_text.len() <= QOS_BYTES {
                    true => qos::from_yaml(qos_text).unwrap_or_default(),
                    false => Vec::new(),
                },
                definition: MessageDefinition {
                    encoding: schema.map(|schema| schema.encoding.clone()).unwrap_or_default(),
                    text: fits.map(|_| text.to_owned()).unwrap_or_default(),
                    type_hash: text_of("topic_type_hash").to_owned(),
                },
            };
            let message_count = self.counts.get(id).copied().unwrap_or(0);
            (u32::from(*id), RecordedTopic { topic, message_count })
        });
        let topics = topics.collect();
        if too_long > 0 {
            let reason = format!(
                "definitions of more than {DEFINITIONS_BYTES} bytes altogether; those of {too_long} topics are left out"
            );
            self.damage.push(Error::damaged(self.file.path(), self.file.len(), reason));
        }
        FileIndex { topics, blocks: self.blocks, damage: self.damage }
    }
}

fn is_empty(chunk: &Chunk) -> bool {
    chunk.records.is_empty()
}
