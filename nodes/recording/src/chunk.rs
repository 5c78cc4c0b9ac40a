//! The heads of MCAP chunks, and blocks of MCAP records loaded into memory.

use mcap::records::op;

use crate::block::{Block, Chunk, Entry, Loaded, MAX_BLOCK_BYTES, Place};
use crate::compression::{self, messages};
use crate::error::Error;
use crate::file::{HEAD, McapFile, MessageHead};
use crate::records::{Piece, Pieces};

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

/// Start and end of a chunk without messages: of the format, of a recorder that begins with the earliest and latest times
/// it has not seen, and of `rosbags`, which says what rosbag2 does of a recording without messages.
const NO_TIMES_NS: [(u64, u64); 3] = [(0, 0), (u64::MAX, 0), (i64::MAX as u64, 0)];

impl ChunkHead {
    /// Whether its times are those of messages.
    pub(crate) fn has_times(&self) -> bool {
        self.start_ns <= self.end_ns && !self.is_without_messages()
    }

    /// Whether they can be those of a chunk.
    pub(crate) fn has_possible_times(&self) -> bool {
        self.start_ns <= self.end_ns || self.is_without_messages()
    }

    fn is_without_messages(&self) -> bool {
        NO_TIMES_NS.contains(&(self.start_ns, self.end_ns))
    }
}

/// Reads the head of a chunk whose record begins at `offset` of the file, from the bytes there. `None` when they are none.
/// The length in front of the record is not looked at.
pub(crate) fn head_of(bytes: &[u8], offset: u64) -> Option<ChunkHead> {
    head_in(bytes.get(HEAD as usize..)?, offset.checked_add(HEAD)?)
}

/// The same, from the content of the record, which begins at `offset`.
pub(crate) fn head_in(content: &[u8], offset: u64) -> Option<ChunkHead> {
    let (start_ns, rest) = content.split_first_chunk()?;
    let (end_ns, rest) = rest.split_first_chunk()?;
    let (size, rest) = rest.split_first_chunk()?;
    let (crc, rest) = rest.split_first_chunk()?;
    let (name_length, rest) = rest.split_first_chunk()?;
    let name_length =
        usize::try_from(u32::from_le_bytes(*name_length)).ok().filter(|length| *length <= NAME)?;
    let (name, rest) = rest.split_at_checked(name_length)?;
    let stored = u64::from_le_bytes(*rest.first_chunk()?);
    let begin = offset + (FIXED + name_length + 8) as u64;
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

/// What could be had of a chunk.
pub(crate) struct Inside {
    /// Its records, decompressed.
    pub(crate) bytes: Vec<u8>,
    /// Why they are not all, or not those that were written.
    pub(crate) fault: Option<Error>,
}

/// The records of a chunk, decompressed and checked.
///
/// # Errors
/// When nothing of it can be had.
pub(crate) fn inside(file: &McapFile, chunk: &Chunk) -> Result<Inside, Error> {
    let damaged = |reason: String| Error::damaged(file.path(), chunk.records.start, reason);
    let stored = stored(chunk);
    if stored > MAX_BLOCK_BYTES || (chunk.size > MAX_BLOCK_BYTES && !chunk.compression.is_empty()) {
        let size = chunk.size;
        return Err(damaged(format!(
            "a chunk of {stored} bytes that says it decompresses to {size} bytes; accepted: {MAX_BLOCK_BYTES}"
        )));
    }
    let (bytes, broken) =
        compression::decompress(&chunk.compression, file.read(chunk.records.clone())?, chunk.size);
    if let Some(reason) = broken {
        let fault = damaged(reason);
        return if bytes.is_empty() { Err(fault) } else { Ok(Inside { bytes, fault: Some(fault) }) };
    }
    let found = if chunk.crc == 0 { 0 } else { crc32fast::hash(&bytes) };
    let fault = (found != chunk.crc).then(|| Error::Altered {
        path: file.path().to_owned(),
        offset: chunk.records.start,
        size: bytes.len(),
        found,
        recorded: chunk.crc,
    });
    Ok(Inside { bytes, fault })
}

/// Bytes of a chunk in its file.
pub(crate) fn stored(chunk: &Chunk) -> u64 {
    chunk.records.end.saturating_sub(chunk.records.start)
}

/// Loads a block. Broken records in it are left out, and its damage says where. Messages of channels that `is_described`
/// does not know are left out as well. Of a chunk that is not what was written, the messages are taken that are still
/// framed as messages; what it is, its damage says. Messages that were compressed one by one come decompressed; `share` is
/// of [`compression::share_of_block`].
pub(crate) fn load(
    file: &McapFile,
    block: &Block,
    share: u64,
    is_described: impl Fn(u32) -> bool,
) -> Result<Loaded, Error> {
    let (Inside { mut bytes, fault }, offset, stored, is_compressed) = match &block.place {
        Place::Chunk(chunk) => {
            (inside(file, chunk)?, chunk.records.start, stored(chunk), !chunk.compression.is_empty())
        }
        Place::Row { records } => {
            let bytes = file.read(records.clone())?;
            let stored = bytes.len() as u64;
            (Inside { bytes, fault: None }, records.start, stored, false)
        }
        #[cfg(feature = "sqlite")]
        Place::Sqlite { .. } => return Ok(Loaded::default()),
    };
    let standing = |channel: u16| match &block.channels {
        _ if !is_described(channel.into()) => Standing::Undescribed,
        Some(listed) if listed.binary_search(&channel.into()).is_err() => Standing::Unlisted,
        _ => Standing::Known,
    };
    let mut lost = Strange::default();
    let mut undescribed = Strange::default();
    let mut unlisted = Strange::default();
    // Messages of a channel come in rows.
    let mut last = None;
    // A pose with its head has some 160 bytes.
    let mut entries = Vec::with_capacity(bytes.len() / 128);
    let mut pieces = Pieces::new(&bytes, stored);
    while let Some(piece) = pieces.next(|channel| is_described(channel.into())) {
        let record = match piece {
            Piece::Record(record) if record.opcode == op::MESSAGE => record,
            Piece::Record(_) => continue,
            Piece::Lost(range) => {
                lost.add(range.start, range.len() as u64);
                continue;
            }
        };
        let Some((head, data)) = MessageHead::split(record.content) else { continue };
        let standing = match last {
            Some((channel, standing)) if channel == head.channel => standing,
            _ => standing(head.channel),
        };
        last = Some((head.channel, standing));
        match standing {
            Standing::Known => {}
            Standing::Unlisted => unlisted.add(usize::from(head.channel), 1),
            Standing::Undescribed => {
                undescribed.add(usize::from(head.channel), 1);
                continue;
            }
        }
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
    if fault.is_some() {
        // The block's times are those of the chunk and of its index, or were taken from these messages: what lies outside
        // has a broken time. Messages before would have to come when later ones have gone.
        entries.retain(|entry| (block.start_ns..=block.end_ns).contains(&entry.log_time_ns));
    }
    let most = compression::most_in_block(stored, share).max(bytes.len() as u64);
    let refused = messages::decompress_all(&mut bytes, &mut entries, most);
    let damaged = |at: usize, reason: String| match is_compressed {
        false => Error::damaged(file.path(), offset + at as u64, reason),
        true => {
            Error::damaged(file.path(), offset, format!("{reason}, at byte {at} of the decompressed chunk"))
        }
    };
    let mut damage: Vec<Error> = fault.into_iter().collect();
    damage.extend(lost.first.map(|at| damaged(at, lost_inside(lost.count, is_compressed))));
    damage.extend(refused.first.map(|(at, reason)| {
        damaged(
            at,
            format!("{} messages in zstd compression that are left out; the first {reason}", refused.count),
        )
    }));
    damage.extend(undescribed.first.map(|channel| {
        let count = undescribed.count;
        damaged(
            0,
            format!(
                "{count} messages of channels that are nowhere described, the first of channel {channel}"
            ),
        )
    }));
    damage.extend(unlisted.first.map(|channel| {
        let count = unlisted.count;
        let reason = format!(
            "{count} messages of channels that the index does not list for this chunk, the first of channel {channel}; \
             they are read"
        );
        damaged(0, reason)
    }));
    Ok(Loaded::new(bytes, entries, damage))
}

/// What to say of bytes in a block that are no records.
pub(crate) fn lost_inside(bytes: u64, is_compressed: bool) -> String {
    let what = if is_compressed { "decompressed bytes" } else { "bytes" };
    format!("broken records: {bytes} {what} are left out, the first ones here")
}

/// What is known of a channel.
#[derive(Clone, Copy)]
enum Standing {
    Known,
    /// Not in the index of this chunk.
    Unlisted,
    /// It has no topic.
    Undescribed,
}

/// What is not as it should be: a block can have millions of them, and they get one sentence.
#[derive(Default)]
pub(crate) struct Strange {
    pub(crate) count: u64,
    pub(crate) first: Option<usize>,
}

impl Strange {
    pub(crate) fn add(&mut self, first: usize, count: u64) {
        self.count += count;
        self.first.get_or_insert(first);
    }
}
