//! The bytes of an MCAP file and the records in a buffer, never beyond the end.
//!
//! An MCAP file is a row of records: one byte that says the kind, eight that say the length, and the content. Lengths are
//! checked against what is there before anything is read, so that a broken file costs an error and no memory.

use std::fs::File;
use std::ops::Range;
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use mcap::records::Record;

use crate::error::Error;
use crate::fit::size_of_content;

/// Kind and length in front of every record.
pub(crate) const HEAD: u64 = 9;
/// Channel, sequence, log time and publish time in front of the data of a message.
pub(crate) const MESSAGE_HEAD: usize = 22;

/// Files that stay open between reads, of all recordings of a process. A system lets a process have 1024 or so, and a
/// recording can have more parts than that: the others are opened for each read.
const MOST_KEPT_OPEN: usize = 64;
static KEPT_OPEN: AtomicUsize = AtomicUsize::new(0);

/// An MCAP file.
#[derive(Debug)]
pub(crate) struct McapFile {
    /// As it is called.
    path: PathBuf,
    /// Where its bytes are: a decompressed copy, or the same.
    readable: PathBuf,
    kept: Option<KeptOpen>,
    len: u64,
}

/// One of the files that stay open.
#[derive(Debug)]
struct KeptOpen(File);

impl KeptOpen {
    /// `None` where there are enough of them.
    fn new(file: File) -> Option<Self> {
        let one_more = |kept| (kept < MOST_KEPT_OPEN).then_some(kept + 1);
        let has_room = KEPT_OPEN.fetch_update(Ordering::Relaxed, Ordering::Relaxed, one_more).is_ok();
        // Made only then: dropping one counts it off.
        has_room.then(|| Self(file))
    }
}

impl Drop for KeptOpen {
    fn drop(&mut self) {
        KEPT_OPEN.fetch_sub(1, Ordering::Relaxed);
    }
}

impl McapFile {
    /// Opens the file at `readable`, which is called `path` in every error.
    pub(crate) fn open(readable: &Path, path: &Path) -> Result<Self, Error> {
        let file = File::open(readable).map_err(Error::io(path, "open"))?;
        let len = file.metadata().map_err(Error::io(path, "open"))?.len();
        if len == 0 {
            let reason = "the file is empty".to_owned();
            return Err(Error::NotARecording { path: path.to_owned(), reason });
        }
        Ok(Self { path: path.to_owned(), readable: readable.to_owned(), kept: KeptOpen::new(file), len })
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    pub(crate) fn len(&self) -> u64 {
        self.len
    }

    /// The bytes of a range, which must lie in the file.
    pub(crate) fn read(&self, range: Range<u64>) -> Result<Vec<u8>, Error> {
        let mut bytes = Vec::new();
        self.read_into(range, &mut bytes)?;
        Ok(bytes)
    }

    /// The same, in place of what `bytes` held.
    pub(crate) fn read_into(&self, range: Range<u64>, bytes: &mut Vec<u8>) -> Result<(), Error> {
        let size = range.end.checked_sub(range.start).filter(|_| range.end <= self.len);
        let size = size
            .and_then(|size| usize::try_from(size).ok())
            .ok_or_else(|| Error::damaged(&self.path, range.start, "the file ends inside a record"))?;
        bytes.clear();
        bytes.resize(size, 0);
        match &self.kept {
            Some(KeptOpen(file)) => file.read_exact_at(bytes, range.start),
            None => File::open(&self.readable)
                .map_err(Error::io(&self.path, "open"))?
                .read_exact_at(bytes, range.start),
        }
        .map_err(Error::io(&self.path, "read"))
    }

    /// The content of a record, parsed. Its lengths are checked before: the parser allocates what they say.
    pub(crate) fn parse<'a>(&self, opcode: u8, content: &'a [u8], offset: u64) -> Result<Record<'a>, Error> {
        let damaged = |reason: &dyn std::fmt::Display| {
            Error::damaged(&self.path, offset, format!("record of kind {opcode:#04x}: {reason}"))
        };
        if size_of_content(opcode, content).is_none_or(|size| size > content.len() as u64) {
            return Err(damaged(&"a field is longer than the record"));
        }
        mcap::parse_record(opcode, content).map_err(|error| damaged(&error))
    }
}

/// Kind and length of a record from its first nine bytes.
pub(crate) fn split_record(head: &[u8]) -> Option<(u8, u64)> {
    let (opcode, rest) = head.split_first()?;
    Some((*opcode, u64::from_le_bytes(*rest.first_chunk()?)))
}

/// A record inside a buffer.
pub(crate) struct InBuffer<'a> {
    pub(crate) opcode: u8,
    pub(crate) content: &'a [u8],
    /// Where its first byte is in the buffer.
    pub(crate) offset: usize,
}

/// Goes through the records in a buffer; one that does not fit ends it with its offset as the error.
pub(crate) fn records(buffer: &[u8]) -> impl Iterator<Item = Result<InBuffer<'_>, usize>> {
    let mut offset = 0;
    let mut failed = false;
    std::iter::from_fn(move || {
        let rest = buffer.get(offset..).filter(|rest| !rest.is_empty() && !failed)?;
        let record = split_record(rest).and_then(|(opcode, length)| {
            let end = usize::try_from(length).ok()?.checked_add(HEAD as usize)?;
            let content = rest.get(HEAD as usize..end)?;
            Some((InBuffer { opcode, content, offset }, end))
        });
        Some(match record {
            Some((record, length)) => {
                offset += length;
                Ok(record)
            }
            None => {
                failed = true;
                Err(offset)
            }
        })
    })
}

/// The fixed fields in front of the data of a message.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MessageHead {
    pub(crate) channel: u16,
    pub(crate) sequence: u32,
    pub(crate) log_time_ns: u64,
    pub(crate) publish_time_ns: u64,
}

impl MessageHead {
    /// Splits the content of a message record into these fields and the data.
    pub(crate) fn split(content: &[u8]) -> Option<(Self, &[u8])> {
        let (channel, rest) = content.split_first_chunk()?;
        let (sequence, rest) = rest.split_first_chunk()?;
        let (log_time, rest) = rest.split_first_chunk()?;
        let (publish_time, data) = rest.split_first_chunk()?;
        let head = Self {
            channel: u16::from_le_bytes(*channel),
            sequence: u32::from_le_bytes(*sequence),
            log_time_ns: u64::from_le_bytes(*log_time),
            publish_time_ns: u64::from_le_bytes(*publish_time),
        };
        Some((head, data))
    }
}
