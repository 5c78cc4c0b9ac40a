//! What a closed MCAP file says about itself at its end.

use std::collections::BTreeMap;

use mcap::records::{self, Record, op};

use crate::block::MAX_BLOCK_BYTES;
use crate::described::{Definition, Definitions};
use crate::error::Error;
use crate::file::{HEAD, McapFile, records as records_in};

/// The footer's content.
const FOOTER: u64 = 20;
/// Behind the last record: the footer with its head, and the magic bytes.
const FOOTER_AND_MAGIC: u64 = HEAD + FOOTER + mcap::MAGIC.len() as u64;
/// The footer up to its own checksum, which covers that.
const CHECKED: u64 = HEAD + FOOTER - 4;

/// A summary that is whole.
#[derive(Debug)]
pub(crate) struct Summary {
    pub(crate) definitions: Definitions,
    pub(crate) statistics: records::Statistics,
    /// By where the record of the chunk begins.
    pub(crate) chunks: BTreeMap<u64, records::ChunkIndex>,
    /// Its checksum is there and right.
    pub(crate) is_checked: bool,
}

impl Summary {
    /// Whether it says of each channel how many messages it has; writers may leave that out.
    pub(crate) fn counts_channels(&self) -> bool {
        let counts = self.statistics.channel_message_counts.values();
        counts.fold(0, |sum: u64, count| sum.saturating_add(*count)) == self.statistics.message_count
    }
}

/// What is found at the end of a file.
pub(crate) enum Ending {
    Whole(Box<Summary>),
    /// Closed, but by a writer that made no summary.
    Without,
    /// There is one, and it is broken.
    Broken(Error),
}

/// Reads the summary of `file`.
///
/// # Errors
/// When the system does not let us read.
pub(crate) fn read(file: &McapFile) -> Result<Ending, Error> {
    match summary(file) {
        Ok(Some(summary)) => Ok(Ending::Whole(Box::new(summary))),
        Ok(None) => Ok(Ending::Without),
        Err(error @ Error::Damaged { .. }) => Ok(Ending::Broken(error)),
        Err(error) => Err(error),
    }
}

fn summary(file: &McapFile) -> Result<Option<Summary>, Error> {
    let broken = |offset: u64, what: &str| {
        Error::damaged(file.path(), offset, format!("{what}; the file is read without its summary"))
    };
    let Some(footer_offset) = file.len().checked_sub(FOOTER_AND_MAGIC) else {
        return Err(broken(0, "the file ends before its closing records"));
    };
    let ending = file.read(footer_offset..file.len())?;
    let (footer, magic) = ending.split_at((HEAD + FOOTER) as usize);
    if magic != mcap::MAGIC {
        return Err(broken(footer_offset, "the file does not end with the MCAP magic bytes"));
    }
    let footer = match records_in(footer).next() {
        Some(Ok(record)) if record.opcode == op::FOOTER => {
            file.parse(op::FOOTER, record.content, footer_offset)?
        }
        _ => return Err(broken(footer_offset, "the last record is no footer")),
    };
    let Record::Footer(footer) = footer else { return Ok(None) };
    if footer.summary_start == 0 {
        return Ok(None);
    }
    let size = footer_offset.checked_sub(footer.summary_start).filter(|size| *size <= MAX_BLOCK_BYTES);
    let Some(size) = size else { return Err(broken(footer_offset, "the footer points nowhere")) };
    // The checksum covers the summary and the footer up to the checksum itself.
    let covered = file.read(footer.summary_start..footer_offset + CHECKED)?;
    let is_checked = footer.summary_crc != 0;
    if is_checked && footer.summary_crc != crc32fast::hash(&covered) {
        return Err(broken(footer.summary_start, "the summary has a wrong checksum"));
    }
    let mut definitions = Definitions::default();
    let mut statistics = None;
    let mut chunks = BTreeMap::new();
    for record in records_in(covered.get(..size as usize).unwrap_or_default()) {
        let record = record.map_err(|at| {
            broken(footer.summary_start + at as u64, "a record of the summary is longer than the summary")
        })?;
        let offset = footer.summary_start + record.offset as u64;
        match record.opcode {
            op::SCHEMA | op::CHANNEL => {
                let definition = Definition::parse(record.opcode, record.content);
                definitions.add(definition.map_err(|reason| broken(offset, reason))?);
            }
            op::STATISTICS | op::CHUNK_INDEX => match file.parse(record.opcode, record.content, offset)? {
                Record::Statistics(found) => statistics = Some(found),
                Record::ChunkIndex(chunk) => {
                    chunks.insert(chunk.chunk_start_offset, chunk);
                }
                _ => {}
            },
            _ => {}
        }
    }
    // Writers may leave each of these out; then the summary is not of much use.
    let Some(statistics) = statistics else { return Ok(None) };
    let counted = (usize::from(statistics.schema_count), statistics.channel_count as usize);
    let is_complete = definitions.counts() == counted && statistics.chunk_count as usize == chunks.len();
    if !is_complete {
        return Ok(None);
    }
    Ok(Some(Summary { definitions, statistics, chunks, is_checked }))
}
