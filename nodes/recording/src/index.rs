//! Where everything is in an MCAP file: topics, counts, and the blocks that hold the messages.
//!
//! A closed file says its topics and counts in a summary at its end. Where there is none, it does not count by channel, or
//! it does not agree with what is there, the blocks themselves are read once. Either way the file is walked from the
//! front, head by head, so that what an index fails to mention is found as well; and behind a broken place the walk goes
//! on with the next record there is.

mod chunks;
mod walk;

use crate::block::FileIndex;
use crate::error::Error;
use crate::file::McapFile;
use crate::fit::View;
use crate::summary::{self, Ending};
use walk::Walk;

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
