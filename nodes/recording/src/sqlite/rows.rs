//! What counts as a message, and how messages are put together to blocks: the same for a whole and a broken database.

use std::collections::{BTreeMap, BTreeSet};

use crate::block::{Block, FileIndex, MAX_BLOCK_BYTES, Place};

/// A block is closed when it has this many bytes in memory,
const BLOCK_BYTES: u64 = 1 << 20;
/// or this many messages.
const BLOCK_ROWS: usize = 1 << 13;
/// How often the bytes of a file may be claimed by its rows. In a whole file it is once; broken rows claim at random, and
/// a hostile file has thousands of rows that share the same pages.
const CLAIMS: u64 = 16;

/// A row of the table `messages` without its data.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    pub(super) id: i64,
    /// `None` where no integer is stored.
    pub(super) topic_id: Option<i64>,
    /// ns since 1970; `None` where no integer is stored.
    pub(super) timestamp: Option<i64>,
    /// `None` where no blob is stored.
    pub(super) data: Option<Size>,
}

/// How large the data of a message are, bytes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Size {
    pub(super) stored: u64,
    /// `None` where it has not been measured, or the file has more to measure than is accepted.
    pub(super) in_memory: Option<u64>,
}

/// A row that is a message.
#[derive(Debug, Clone, Copy)]
pub(super) struct Accepted {
    pub(super) channel: u32,
    pub(super) log_time_ns: u64,
}

/// Why a row is none.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Refusal {
    Topic,
    Time,
    Data,
    Size,
    /// Larger than the file, or behind rows that are so together.
    Claim,
    /// Behind rows that decompress to too much together.
    Bomb,
}

impl Refusal {
    fn sentence(self) -> &'static str {
        match self {
            Self::Topic => "belong to a topic that is nowhere described",
            Self::Time => "have a negative time or none",
            Self::Data => "have something else than bytes as their data",
            Self::Size => "are larger than the accepted 67108864 bytes",
            Self::Claim => "claim more bytes than the file has",
            Self::Bomb => "decompress to more than is accepted of a recording of this size",
        }
    }
}

/// The topics by their ids in the database; the number in a recording is their place in this order.
#[derive(Debug, Default)]
pub(super) struct Topics {
    numbers: BTreeMap<i64, u32>,
}

impl Topics {
    pub(super) fn new(ids: impl Iterator<Item = i64>) -> Self {
        Self { numbers: (0..).zip(ids).map(|(number, id)| (id, number)).collect() }
    }

    pub(super) fn accept(&self, row: &Row) -> Result<Accepted, Refusal> {
        let channel = row.topic_id.and_then(|id| self.numbers.get(&id)).copied().ok_or(Refusal::Topic)?;
        let log_time_ns = row.timestamp.and_then(|time| u64::try_from(time).ok()).ok_or(Refusal::Time)?;
        let size = row.data.ok_or(Refusal::Data)?;
        if size.in_memory.ok_or(Refusal::Bomb)? > MAX_BLOCK_BYTES || size.stored > MAX_BLOCK_BYTES {
            return Err(Refusal::Size);
        }
        Ok(Accepted { channel, log_time_ns })
    }
}

/// Collects the rows of a file in stored order.
pub(super) struct Collector<'a> {
    topics: &'a Topics,
    index: &'a mut FileIndex,
    len: u64,
    /// Bytes that the rows to come may claim.
    unclaimed: u64,
    /// Bytes that they may take in memory.
    allowance: u64,
    /// Why no row is taken any more.
    spent: Option<Refusal>,
    block: Unfinished,
    refused: BTreeMap<Refusal, Refused>,
}

#[derive(Default)]
struct Unfinished {
    start_ns: u64,
    end_ns: u64,
    bytes: u64,
    rows: usize,
    channels: BTreeSet<u32>,
}

struct Refused {
    count: u64,
    first: Row,
}

/// What became of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Taken {
    /// It is no message.
    No,
    /// It is in the block before or the first one.
    Same,
    /// It begins a block.
    Next,
}

impl<'a> Collector<'a> {
    /// For a file of `len` bytes, whose messages may take `allowance` bytes in memory altogether.
    pub(super) fn new(topics: &'a Topics, index: &'a mut FileIndex, len: u64, allowance: u64) -> Self {
        Self {
            topics,
            index,
            len,
            unclaimed: len.saturating_mul(CLAIMS),
            allowance,
            spent: None,
            block: Unfinished::default(),
            refused: BTreeMap::new(),
        }
    }

    /// Whether nothing but its size in memory is missing to take a row.
    pub(super) fn lacks_size(&self, row: &Row) -> bool {
        self.spent.is_none() && matches!(self.topics.accept(row), Err(Refusal::Bomb))
    }

    /// Takes the next row.
    pub(super) fn take(&mut self, row: &Row) -> Taken {
        let accepted = match self.spent {
            Some(refusal) => Err(refusal),
            None => self.topics.accept(row).and_then(|accepted| self.afford(row).map(|()| accepted)),
        };
        let accepted = match accepted {
            Ok(accepted) => accepted,
            Err(refusal) => {
                // What could not be measured was too much: nothing behind it is measured either.
                self.spent = self.spent.or((refusal == Refusal::Bomb).then_some(refusal));
                self.refused.entry(refusal).or_insert(Refused { count: 0, first: *row }).count += 1;
                return Taken::No;
            }
        };
        let bytes = row.data.and_then(|size| size.in_memory).unwrap_or(0);
        let block = &self.block;
        let is_full = block.rows == BLOCK_ROWS || (block.rows > 0 && block.bytes + bytes > BLOCK_BYTES);
        if is_full {
            self.close();
        }
        let block = &mut self.block;
        if block.rows == 0 {
            (block.start_ns, block.end_ns) = (accepted.log_time_ns, accepted.log_time_ns);
        }
        block.start_ns = block.start_ns.min(accepted.log_time_ns);
        block.end_ns = block.end_ns.max(accepted.log_time_ns);
        block.bytes += bytes;
        block.rows += 1;
        block.channels.insert(accepted.channel);
        if let Some(topic) = self.index.topics.get_mut(&accepted.channel) {
            topic.message_count += 1;
        }
        if is_full { Taken::Next } else { Taken::Same }
    }

    /// Whether there is room left for a row. When it is used up, nothing behind it is taken any more: blocks are ranges of
    /// rows.
    fn afford(&mut self, row: &Row) -> Result<(), Refusal> {
        let Size { stored, in_memory } = row.data.ok_or(Refusal::Data)?;
        if stored > self.len {
            return Err(Refusal::Claim);
        }
        let unclaimed = self.unclaimed.checked_sub(stored).ok_or(Refusal::Claim);
        let allowance = self.allowance.checked_sub(in_memory.unwrap_or(u64::MAX)).ok_or(Refusal::Bomb);
        self.spent = unclaimed.and(allowance).err();
        (self.unclaimed, self.allowance) = (unclaimed?, allowance?);
        self.index.decompressed_bytes += in_memory.unwrap_or(0);
        Ok(())
    }

    fn close(&mut self) {
        let block = std::mem::take(&mut self.block);
        if block.rows > 0 {
            self.index.blocks.push(Block {
                start_ns: block.start_ns,
                end_ns: block.end_ns,
                channels: Some(block.channels.into_iter().collect()),
                place: Place::Sqlite { part: self.index.blocks.len() },
            });
        }
    }

    /// Closes the last block. The sentences say which rows were no messages, with the first of each kind.
    pub(super) fn finish(mut self) -> Vec<(i64, String)> {
        self.close();
        let sentence = |(refusal, Refused { count, first }): (&Refusal, &Refused)| {
            let value = match refusal {
                Refusal::Topic => first.topic_id.map(|id| format!(" (topic_id {id})")),
                Refusal::Time => first.timestamp.map(|time| format!(" ({time} ns)")),
                Refusal::Size => {
                    first.data.map(|size| format!(" ({} bytes)", size.in_memory.unwrap_or(size.stored)))
                }
                Refusal::Data | Refusal::Claim | Refusal::Bomb => None,
            };
            let Row { id, .. } = first;
            let sentence = refusal.sentence();
            (
                *id,
                format!(
                    "messages that {sentence}: {count}, the first with id {id}{}",
                    value.unwrap_or_default()
                ),
            )
        };
        self.refused.iter().map(sentence).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compression::Allowance;

    fn row(id: i64, stored: u64) -> Row {
        let data = Some(Size { stored, in_memory: Some(stored) });
        Row { id, topic_id: Some(7), timestamp: Some(id), data }
    }

    #[test]
    fn rows_that_share_their_pages_end_before_they_cost_more_than_their_file_can_hold() {
        let topics = Topics::new([7].into_iter());
        let mut index = FileIndex::default();
        let len = 1_000_000;
        let mut collector = Collector::new(&topics, &mut index, len, Allowance::new(1).parts.of(len));
        let taken = (0..100_000).filter(|id| collector.take(&row(*id, 900_000)) != Taken::No).count();
        assert_eq!(taken as u64, len * CLAIMS / 900_000);
        let refused = collector.finish();
        assert!(refused[0].1.contains("claim more bytes than the file has: 99983,"), "{refused:?}");
    }

    #[test]
    fn compressed_rows_end_where_they_take_more_memory_than_is_accepted_of_their_file() {
        let topics = Topics::new([7].into_iter());
        let mut index = FileIndex::default();
        let len = 10_000_000;
        let allowance = Allowance::new(1).parts.of(len);
        let mut collector = Collector::new(&topics, &mut index, len, allowance);
        let in_memory = 60 << 20;
        let bomb = |id| Row { data: Some(Size { stored: 3000, in_memory: Some(in_memory) }), ..row(id, 0) };
        let taken = (0..3000).filter(|id| collector.take(&bomb(*id)) != Taken::No).count() as u64;
        assert_eq!(taken, allowance / in_memory);
        let refused = collector.finish();
        assert!(refused[0].1.contains("decompress to more than is accepted"), "{refused:?}");

        let mut collector = Collector::new(&topics, &mut index, len, Allowance::new(1).parts.of(len));
        let unmeasured = Row { data: Some(Size { stored: 3000, in_memory: None }), ..row(0, 0) };
        assert!(collector.lacks_size(&unmeasured));
        assert_eq!(collector.take(&unmeasured), Taken::No, "there is too much to measure");
        assert!(!collector.lacks_size(&unmeasured), "nothing is measured any more");
        assert_eq!(collector.take(&row(1, 0)), Taken::No, "blocks are ranges of rows");
    }

    #[test]
    fn a_block_ends_with_a_megabyte_and_a_large_message_is_a_block_of_its_own() {
        let topics = Topics::new([7].into_iter());
        let mut index = FileIndex::default();
        let mut collector = Collector::new(&topics, &mut index, 1 << 30, u64::MAX);
        let sizes = [600_000, 400_000, 100_000, 5_000_000, 10];
        let taken: Vec<_> = (0..).zip(sizes).map(|(id, size)| collector.take(&row(id, size))).collect();
        assert_eq!(taken, [Taken::Same, Taken::Same, Taken::Next, Taken::Next, Taken::Next]);
        collector.finish();
        let bounds: Vec<_> = index.blocks.iter().map(|block| (block.start_ns, block.end_ns)).collect();
        assert_eq!(bounds, [(0, 1), (2, 2), (3, 3), (4, 4)]);
    }
}
