//! Which bytes of an MCAP file can be a record, and where the next record is when something is broken.
//!
//! A head says kind and length, and either may be broken. A record whose inner lengths add up to that length is one
//! for sure. A message has no inner lengths: it is one when a record follows it, and where the file is in doubt, when no
//! row of messages begins inside of it.

use std::ops::{Range, RangeInclusive};

use mcap::records::op;

use crate::block::MAX_BLOCK_BYTES;
use crate::chunk::{self, ChunkHead, LONGEST_HEAD};
use crate::described::Definition;
use crate::error::Error;
use crate::file::{HEAD, MESSAGE_HEAD, McapFile, split_record};

/// Files up to this size are looked at in memory as a whole.
const WHOLE_BYTES: u64 = 16 << 20;
/// Bytes read at once when going from head to head ...
const NEAR_BYTES: u64 = 16 << 10;
/// ... and when searching.
const SEARCH_BYTES: u64 = 1 << 20;
/// A definition, an index or metadata larger than this is only looked at from outside.
const LARGEST_LOOK: u64 = 1 << 20;
/// Looks of this size cost about what finding their place costs.
const SMALL_LOOK: u64 = 256;
/// Bytes that may be looked at in larger ones, whatever the size of the file, and for each of its bytes. A file that is
/// read record by record needs two; one made of the beginnings of large records would take hours without a bound.
const LOOKS_OF_ANY_FILE: u64 = 64 << 20;
const LOOKS_PER_BYTE: u64 = 4;
/// So many messages in a row are no accident.
const ROW: usize = 3;

/// Whether bytes can be a record, and where it would end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fit {
    /// Its inner lengths add up.
    Sure(u64),
    /// Nothing speaks against it.
    Maybe(u64),
    /// It is none.
    No,
}

/// Looks at places of a file.
pub(crate) struct View<'a> {
    file: &'a McapFile,
    near: Window,
    search: Window,
    /// Bytes that may still be looked at inside of records.
    looks_left: u64,
}

/// Bytes of a file in memory.
#[derive(Default)]
struct Window {
    start: u64,
    bytes: Vec<u8>,
}

impl Window {
    /// Up to `length` bytes at `offset`: fewer at the end of the file. Reads at least `ahead` bytes when it reads.
    fn get(&mut self, file: &McapFile, offset: u64, length: u64, ahead: u64) -> Result<&[u8], Error> {
        let end = offset.saturating_add(length).min(file.len());
        let begin = offset.min(end);
        if begin < self.start || end > self.start + self.bytes.len() as u64 {
            // A small file is read once.
            let small = file.len() <= WHOLE_BYTES;
            let start = if small { 0 } else { begin };
            let until = if small { file.len() } else { end.max(begin.saturating_add(ahead).min(file.len())) };
            // A failed read must not leave a window that says it is there.
            self.bytes.clear();
            self.start = start;
            file.read_into(start..until, &mut self.bytes)?;
        }
        let range = (begin - self.start) as usize..(end - self.start) as usize;
        Ok(self.bytes.get(range).unwrap_or_default())
    }

    /// What is in memory from `offset` on: `least` bytes, and what was read ahead.
    fn rest(&mut self, file: &McapFile, offset: u64, least: u64, ahead: u64) -> Result<&[u8], Error> {
        self.get(file, offset, least, ahead)?;
        let begin = offset.saturating_sub(self.start) as usize;
        Ok(self.bytes.get(begin..).unwrap_or_default())
    }
}

impl<'a> View<'a> {
    pub(crate) fn new(file: &'a McapFile) -> Self {
        let looks_left = LOOKS_OF_ANY_FILE.saturating_add(file.len().saturating_mul(LOOKS_PER_BYTE));
        Self { file, near: Window::default(), search: Window::default(), looks_left }
    }

    /// Up to `length` bytes at `offset`.
    pub(crate) fn bytes(&mut self, offset: u64, length: u64) -> Result<&[u8], Error> {
        self.near.get(self.file, offset, length, NEAR_BYTES)
    }

    /// Kind and length of the record at `offset`; `None` where the file ends before.
    pub(crate) fn head(&mut self, offset: u64) -> Result<Option<(u8, u64)>, Error> {
        Ok(split_record(self.bytes(offset, HEAD)?))
    }

    /// Whether there can be a record at `offset`.
    pub(crate) fn fit(&mut self, offset: u64) -> Result<Fit, Error> {
        let file_len = self.file.len();
        let Some((opcode, length)) = self.head(offset)? else { return Ok(Fit::No) };
        let end = (offset + HEAD).checked_add(length).filter(|end| *end <= file_len);
        let Some(end) = end else { return Ok(Fit::No) };
        let look = match opcode {
            0 => return Ok(Fit::No),
            op::MESSAGE if length < MESSAGE_HEAD as u64 => return Ok(Fit::No),
            op::MESSAGE => return Ok(Fit::Maybe(end)),
            // The footer is the last record, behind it are the magic bytes.
            op::FOOTER if end + mcap::MAGIC.len() as u64 == file_len => length,
            op::FOOTER => return Ok(Fit::No),
            op::CHUNK => length.min(LONGEST_HEAD as u64),
            op::ATTACHMENT => length.min(NEAR_BYTES / 2),
            op::HEADER..=op::DATA_END if length > LARGEST_LOOK => return Ok(Fit::Maybe(end)),
            op::HEADER..=op::DATA_END => length,
            _ => return Ok(Fit::Maybe(end)),
        };
        if look > SMALL_LOOK {
            match self.looks_left.checked_sub(look) {
                Some(left) => self.looks_left = left,
                None => return Ok(Fit::Maybe(end)),
            }
        }
        if look < least_size(opcode) {
            return Ok(Fit::No);
        }
        let content = self.bytes(offset, HEAD + look)?.get(HEAD as usize..).unwrap_or_default();
        Ok(match size_of_content(opcode, content) {
            Some(size) if size == length => Fit::Sure(end),
            // Later versions of the format may append fields.
            Some(size) if size < length => Fit::Maybe(end),
            _ => Fit::No,
        })
    }

    /// Whether the file ends at `offset` or goes on with what can be a record.
    pub(crate) fn goes_on(&mut self, offset: u64) -> Result<bool, Error> {
        Ok(offset == self.file.len() || self.fit(offset)? != Fit::No)
    }

    /// The chunk at `offset` by what is inside of it, whatever kind and length its head says, and where it ends.
    pub(crate) fn chunk(&mut self, offset: u64) -> Result<Option<(ChunkHead, u64)>, Error> {
        let file_len = self.file.len();
        let head = self.beginning_of_chunk(offset)?;
        Ok(head.and_then(|head| {
            let end = head.chunk.records.end;
            (end <= file_len && head.has_possible_times()).then_some((head, end))
        }))
    }

    /// The same, wherever it ends.
    pub(crate) fn beginning_of_chunk(&mut self, offset: u64) -> Result<Option<ChunkHead>, Error> {
        Ok(chunk::head_of(self.bytes(offset, LONGEST_HEAD as u64)?, offset))
    }

    /// The first place from `from` on where records go on; messages count when their channel is one of `channels`.
    pub(crate) fn search(&mut self, from: u64, channels: &ChannelSet) -> Result<Option<u64>, Error> {
        self.find(op::HEADER..=op::DATA_END, from..self.file.len(), channels)
    }

    /// The first message of a row that begins in `range`, which a longer record may cover by its length.
    pub(crate) fn row_within(
        &mut self,
        range: Range<u64>,
        channels: &ChannelSet,
    ) -> Result<Option<u64>, Error> {
        self.find(op::MESSAGE..=op::MESSAGE, range, channels)
    }

    /// The first record of one of `kinds` that begins in `range` and from which records go on.
    fn find(
        &mut self,
        kinds: RangeInclusive<u8>,
        range: Range<u64>,
        channels: &ChannelSet,
    ) -> Result<Option<u64>, Error> {
        let mut offset = range.start;
        let until = range.end.min((self.file.len() + 1).saturating_sub(HEAD));
        while offset < until {
            let bytes = self.search.rest(self.file, offset, HEAD, SEARCH_BYTES)?;
            let heads = bytes.windows(HEAD as usize);
            // Lengths are below 2^40.
            let candidate =
                heads.clone().position(|head| matches!(head, [kind, .., 0, 0, 0] if kinds.contains(kind)));
            let Some(candidate) = candidate else {
                offset += heads.len() as u64;
                continue;
            };
            offset += candidate as u64;
            if offset < until && self.is_row(offset, channels)? {
                return Ok(Some(offset));
            }
            offset += 1;
        }
        Ok(None)
    }

    /// Whether a sure record begins at `offset`, or a row of messages.
    fn is_row(&mut self, mut offset: u64, channels: &ChannelSet) -> Result<bool, Error> {
        for _ in 0..ROW {
            let end = match self.fit(offset)? {
                Fit::Sure(_) => return Ok(true),
                Fit::No => return Ok(false),
                Fit::Maybe(end) => end,
            };
            let head = self.bytes(offset, HEAD + 2)?;
            let [op::MESSAGE, .., low, high] = *head else { return Ok(false) };
            if !channels.contains(u16::from_le_bytes([low, high])) || end - offset > MAX_BLOCK_BYTES {
                return Ok(false);
            }
            if end == self.file.len() {
                return Ok(true);
            }
            offset = end;
        }
        Ok(true)
    }
}

/// The numbers of channels.
#[derive(Debug, Clone)]
pub(crate) struct ChannelSet(Vec<bool>);

impl Default for ChannelSet {
    fn default() -> Self {
        Self(vec![false; usize::from(u16::MAX) + 1])
    }
}

impl ChannelSet {
    /// Whether it was not in it.
    pub(crate) fn insert(&mut self, channel: u16) -> bool {
        self.0.get_mut(usize::from(channel)).is_some_and(|is_in| !std::mem::replace(is_in, true))
    }

    /// The channel that is described, if it is one; whether it was not in it.
    pub(crate) fn insert_described(&mut self, definition: &Definition<'_>) -> bool {
        matches!(definition, Definition::Channel { id, .. } if self.insert(*id))
    }

    pub(crate) fn contains(&self, channel: u16) -> bool {
        self.0.get(usize::from(channel)) == Some(&true)
    }
}

/// The least a record of a kind has: its fields with empty texts and lists.
pub(crate) fn least_size(opcode: u8) -> u64 {
    match opcode {
        op::HEADER => 4 + 4,
        op::SCHEMA => 2 + 3 * 4,
        op::CHANNEL => 2 + 2 + 3 * 4,
        op::CHUNK => 8 + 8 + 8 + 4 + 4 + 8,
        op::CHUNK_INDEX => 4 * 8 + 4 + 8 + 4 + 8 + 8,
        op::ATTACHMENT => 8 + 8 + 4 + 4 + 8,
        _ => 0,
    }
}

/// How long the content of a record is by its own lengths; `None` when it is shorter than its fields. Of a chunk and an
/// attachment the beginning is enough.
pub(crate) fn size_of_content(opcode: u8, content: &[u8]) -> Option<u64> {
    let mut fields = Fields::new(content);
    match opcode {
        op::HEADER => fields.blocks(2)?,
        op::FOOTER => fields.skip(8 + 8 + 4)?,
        op::SCHEMA => {
            fields.skip(2)?;
            fields.blocks(3)?;
        }
        op::CHANNEL => {
            fields.skip(2 + 2)?;
            fields.blocks(2)?;
            fields.map()?;
        }
        op::CHUNK => {
            let chunk = chunk::head_in(content, 0)?;
            return chunk.has_possible_times().then_some(chunk.chunk.records.end);
        }
        op::MESSAGE_INDEX => {
            fields.skip(2)?;
            fields.block_of(16)?;
        }
        op::CHUNK_INDEX => {
            fields.skip(4 * 8)?;
            fields.block_of(10)?;
            fields.skip(8)?;
            fields.blocks(1)?;
            fields.skip(8 + 8)?;
        }
        op::ATTACHMENT => {
            fields.skip(8 + 8)?;
            fields.blocks(2)?;
            let data = u64::from_le_bytes(*content.get(fields.at..)?.first_chunk()?);
            return (fields.at as u64 + 8 + 4).checked_add(data);
        }
        op::ATTACHMENT_INDEX => {
            fields.skip(5 * 8)?;
            fields.blocks(2)?;
        }
        op::STATISTICS => {
            fields.skip(8 + 2 + 4 * 4 + 8 + 8)?;
            fields.block_of(10)?;
        }
        op::METADATA => {
            fields.blocks(1)?;
            fields.map()?;
        }
        op::METADATA_INDEX => {
            fields.skip(8 + 8)?;
            fields.blocks(1)?;
        }
        op::SUMMARY_OFFSET => fields.skip(1 + 8 + 8)?,
        op::DATA_END => fields.skip(4)?,
        _ => return None,
    }
    Some(fields.at as u64)
}

/// Goes through the fields of a record.
pub(crate) struct Fields<'a> {
    content: &'a [u8],
    at: usize,
}

impl<'a> Fields<'a> {
    pub(crate) fn new(content: &'a [u8]) -> Self {
        Self { content, at: 0 }
    }

    /// Two bytes.
    pub(crate) fn number(&mut self) -> Option<u16> {
        let begin = self.at;
        self.skip(2)?;
        self.content.get(begin..)?.first_chunk().copied().map(u16::from_le_bytes)
    }

    /// A text, map or list without its length.
    pub(crate) fn block(&mut self) -> Option<&'a [u8]> {
        let begin = self.at.checked_add(4)?;
        self.blocks(1)?;
        self.content.get(begin..self.at)
    }

    fn skip(&mut self, length: usize) -> Option<()> {
        self.at = self.at.checked_add(length).filter(|at| *at <= self.content.len())?;
        Some(())
    }

    /// Texts, maps and lists have their length in bytes in front.
    fn blocks(&mut self, count: usize) -> Option<()> {
        (0..count).try_for_each(|_| self.block_of(1))
    }

    /// Pairs of texts.
    fn map(&mut self) -> Option<()> {
        let mut pairs = Fields::new(self.block()?);
        while pairs.at < pairs.content.len() {
            pairs.blocks(2)?;
        }
        Some(())
    }

    /// A list of elements of this many bytes.
    fn block_of(&mut self, each: usize) -> Option<()> {
        let length = u32::from_le_bytes(*self.content.get(self.at..)?.first_chunk()?) as usize;
        length.is_multiple_of(each).then_some(())?;
        self.skip(4)?;
        self.skip(length)
    }
}
