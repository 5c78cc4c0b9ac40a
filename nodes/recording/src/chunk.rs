//! The heads of MCAP chunks, and blocks of MCAP records loaded into memory.

use std::collections::BTreeMap;

use mcap::records::op;

use crate::block::{Block, Chunk, Entry, Loaded, MAX_BLOCK_BYTES, Place};
use crate::compression;
use crate::error::Error;
use crate::file::{HEAD, McapFile, MessageHead, records};

/// Start, end, size, CRC and the length of the compression's name: the head of a chunk up to that name.
const FIXED: usize = 8 + 8 + 8 + 4 + 4;
/// Longest name of a compression. Those there are have four letters.
const NAME: usize = 32;
/// Bytes from the first one of a chunk's record to its first stored byte, at most.
pub(crate) const LONGEST_HEAD: usize = HEAD as usize + FIXED + NAME + 8;

/// The head of a chunk.
#[derive(Debug, Clone)]
pub(crate) struct ChunkHead {
    pub(crate) start_ns: u64,
    pub(crate) end_ns: u64,
    pub(crate) chunk: Chunk,
}

/// Reads the head of a chunk whose record begins at `offset` of the file, from the bytes there. `None` when they are none.
/// The length in front of the record is not looked at.
pub(crate) fn head_of(bytes: &[u8], offset: u64) -> Option<ChunkHead> {
    let content = bytes.get(HEAD as usize..)?;
    let (start_ns, rest) = content.split_first_chunk()?;
    let (end_ns, rest) = rest.split_first_chunk()?;
    let (size, rest) = rest.split_first_chunk()?;
    let (crc, rest) = rest.split_first_chunk()?;
    let (name_length, rest) = rest.split_first_chunk()?;
    let name_length =
        usize::try_from(u32::from_le_bytes(*name_length)).ok().filter(|length| *length <= NAME)?;
    let (name, rest) = rest.split_at_checked(name_length)?;
    let stored = u64::from_le_bytes(*rest.first_chunk()?);
    let begin = offset + HEAD + (FIXED + name_length + 8) as u64;
    let compression =
        std::str::from_utf8(name).ok().filter(|name| name.bytes().all(|byte| byte.is_ascii_graphic()))?;
    let chunk = Chunk {
        records: begin..begin.checked_add(stored)?,
        compression: compression.to_owned(),
        size: u64::from_le_bytes(*size),
        crc: u32::from_le_bytes(*crc),
    };
    Some(ChunkHead { start_ns: u64::from_le_bytes(*start_ns), end_ns: u64::from_le_bytes(*end_ns), chunk })
}

/// The records of a chunk, decompressed and checked.
pub(crate) fn bytes_of(file: &McapFile, chunk: &Chunk) -> Result<Vec<u8>, Error> {
    let damaged = |reason: String| Error::damaged(file.path(), chunk.records.start, reason);
    let stored = chunk.records.end.saturating_sub(chunk.records.start);
    if stored > MAX_BLOCK_BYTES || (chunk.size > MAX_BLOCK_BYTES && !chunk.compression.is_empty()) {
        let size = chunk.size;
        return Err(damaged(format!(
            "a chunk of {stored} bytes that says it decompresses to {size} bytes; accepted: {MAX_BLOCK_BYTES}"
        )));
    }
    let bytes = compression::decompress(&chunk.compression, file.read(chunk.records.clone())?, chunk.size);
    let bytes = bytes.map_err(damaged)?;
    let found = if chunk.crc == 0 { 0 } else { crc32fast::hash(&bytes) };
    if found != chunk.crc {
        let size = bytes.len();
        let reason =
            format!("a chunk of {size} bytes with checksum {found:08x} instead of {:08x}", chunk.crc);
        return Err(damaged(reason));
    }
    Ok(bytes)
}

/// Loads a block. What follows a broken record in it is lost, and its damage says where. Messages of channels that
/// `is_described` does not know are left out.
pub(crate) fn load(
    file: &McapFile,
    block: &Block,
    is_described: impl Fn(u32) -> bool,
) -> Result<Loaded, Error> {
    let (bytes, offset, what) = match &block.place {
        Place::Chunk(chunk) => {
            let what = if chunk.compression.is_empty() { "" } else { " of the decompressed chunk" };
            (bytes_of(file, chunk)?, chunk.records.start, what)
        }
        Place::Row { records } => (file.read(records.clone())?, records.start, ""),
        Place::Sqlite { .. } => return Ok(Loaded::default()),
    };
    let damaged = |at: usize, reason: &str| match what {
        "" => Error::damaged(file.path(), offset + at as u64, reason),
        _ => Error::damaged(file.path(), offset, format!("{reason}, at byte {at}{what}")),
    };
    let mut damage = Vec::new();
    let mut undescribed = BTreeMap::<u16, u64>::new();
    let mut short = Strange::default();
    let mut unknown = Strange::default();
    // A pose with its head has some 160 bytes.
    let mut entries = Vec::with_capacity(bytes.len() / 128);
    for record in records(&bytes) {
        match record {
            Ok(record) if record.opcode == op::MESSAGE => match MessageHead::split(record.content) {
                Some((head, data)) if is_described(head.channel.into()) => {
                    let end = record.offset + HEAD as usize + record.content.len();
                    entries.push(Entry {
                        log_time_ns: head.log_time_ns,
                        publish_time_ns: head.publish_time_ns,
                        sequence: head.sequence,
                        channel: head.channel.into(),
                        // Blocks are smaller than 4 GiB.
                        data: (end - data.len()) as u32..end as u32,
                    });
                }
                Some((head, _)) => *undescribed.entry(head.channel).or_default() += 1,
                None => short.add(record.offset),
            },
            // Records of applications begin at 0x80; between them and those of the format there are none yet.
            Ok(record) if !(op::HEADER..=op::DATA_END).contains(&record.opcode) && record.opcode < 0x80 => {
                unknown.add(record.offset);
            }
            Ok(_) => {}
            Err(at) => damage.push(damaged(at, "a record is longer than the chunk it is in")),
        }
    }
    for (strange, what) in [(short, "messages shorter than their head"), (unknown, "records of unknown kind")]
    {
        if let Some(first) = strange.first {
            damage.push(damaged(first, &format!("{} {what}, the first one here", strange.count)));
        }
    }
    for (channel, count) in undescribed {
        let reason = format!("{count} messages of channel {channel}, which is nowhere described");
        damage.push(damaged(0, &reason));
    }
    Ok(Loaded::new(bytes, entries, damage))
}

/// Records that are left out: a block can have millions of them, and they get one sentence.
#[derive(Default)]
struct Strange {
    count: u64,
    first: Option<usize>,
}

impl Strange {
    fn add(&mut self, offset: usize) {
        self.count += 1;
        self.first.get_or_insert(offset);
    }
}
