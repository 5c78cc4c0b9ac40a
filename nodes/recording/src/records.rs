//! The records inside a chunk, and how to go on behind a broken one.
//!
//! Inside a chunk there are messages, types and channels, and records of applications. One whose length leads to another
//! record or to the end of the chunk is taken as it is; where it does not, the next place is searched from which records
//! go on.

use std::ops::Range;

use mcap::records::op;

use crate::file::{HEAD, InBuffer, MESSAGE_HEAD, split_record};
use crate::fit::{least_size, size_of_content};

/// So many messages in a row are no accident.
const ROW: usize = 3;
/// Records of applications begin here.
const OF_APPLICATIONS: u8 = 0x80;
/// A chunk may be searched this much for each of its stored bytes. Broken places are short, and a bomb has few bytes.
const SEARCHED_PER_BYTE: u64 = 8;

/// A piece of a chunk.
pub(crate) enum Piece<'a> {
    Record(InBuffer<'a>),
    /// Bytes that are no records.
    Lost(Range<usize>),
}

/// Goes through a chunk.
pub(crate) struct Pieces<'a> {
    bytes: &'a [u8],
    offset: usize,
    /// Kind and end of the record at `offset`, where that was looked at.
    ahead: Option<(u8, usize)>,
    /// Bytes that may still be looked at to find the end of a broken place.
    left: u64,
}

impl<'a> Pieces<'a> {
    /// Of the decompressed `bytes` of a chunk that takes `stored` bytes in its file.
    pub(crate) fn new(bytes: &'a [u8], stored: u64) -> Self {
        Self { bytes, offset: 0, ahead: None, left: stored.saturating_mul(SEARCHED_PER_BYTE) }
    }

    /// The next piece. `is_known`: whether a channel has been heard of, asked where something is broken.
    pub(crate) fn next(&mut self, is_known: impl Fn(u16) -> bool) -> Option<Piece<'a>> {
        let begin = self.offset;
        if begin >= self.bytes.len() {
            return None;
        }
        let here = self.ahead.take().or_else(|| self.fit(begin));
        if let Some((opcode, end)) = here {
            self.ahead = self.fit(end);
            if self.ahead.is_some() || end == self.bytes.len() {
                return Some(self.take(opcode, end));
            }
        }
        let next = self.search(begin + 1, is_known);
        if let Some((opcode, end)) = here
            && end <= next
        {
            // What follows is broken, not this.
            return Some(self.take(opcode, end));
        }
        self.ahead = None;
        self.offset = next;
        Some(Piece::Lost(begin..next))
    }

    fn take(&mut self, opcode: u8, end: usize) -> Piece<'a> {
        let offset = std::mem::replace(&mut self.offset, end);
        let content = self.bytes.get(offset + HEAD as usize..end).unwrap_or_default();
        Piece::Record(InBuffer { opcode, content, offset })
    }

    /// Kind and end of what can be a record at `offset`.
    fn fit(&self, offset: usize) -> Option<(u8, usize)> {
        let rest = self.bytes.get(offset..)?;
        let (opcode, length) = split_record(rest)?;
        let is_long_enough = match opcode {
            op::MESSAGE => length >= MESSAGE_HEAD as u64,
            op::SCHEMA | op::CHANNEL => length >= least_size(opcode),
            _ => opcode >= OF_APPLICATIONS,
        };
        let fits = is_long_enough && length <= (rest.len() - HEAD as usize) as u64;
        // Added only then: a length may be anything.
        fits.then(|| (opcode, offset + HEAD as usize + length as usize))
    }

    /// The first place from `from` on where records go on for sure; the end where there is none.
    fn search(&mut self, from: usize, is_known: impl Fn(u16) -> bool) -> usize {
        let most = usize::try_from(self.left).unwrap_or(usize::MAX);
        let until = from.saturating_add(most).min(self.bytes.len());
        for offset in from..until {
            self.left = self.left.saturating_sub(1);
            let is_candidate =
                matches!(self.bytes.get(offset), Some(&(op::SCHEMA | op::CHANNEL | op::MESSAGE)));
            if is_candidate && self.is_sure(offset, &is_known) {
                return offset;
            }
            if self.left == 0 {
                break;
            }
        }
        self.bytes.len()
    }

    /// Whether a definition whose lengths add up begins here, or a row of messages.
    fn is_sure(&mut self, mut offset: usize, is_known: impl Fn(u16) -> bool) -> bool {
        for _ in 0..ROW {
            let Some((opcode, end)) = self.fit(offset) else { return false };
            let content = self.bytes.get(offset + HEAD as usize..end).unwrap_or_default();
            match opcode {
                op::SCHEMA | op::CHANNEL => {
                    self.left = self.left.saturating_sub(content.len() as u64);
                    return size_of_content(opcode, content) == Some(content.len() as u64);
                }
                op::MESSAGE => {
                    let channel = content.first_chunk().copied().map(u16::from_le_bytes);
                    if !channel.is_some_and(&is_known) {
                        return false;
                    }
                }
                _ => return false,
            }
            if end == self.bytes.len() {
                return true;
            }
            offset = end;
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_length_of_all_bits_fits_nowhere() {
        let mut bytes = vec![op::MESSAGE];
        bytes.extend([0xff; 8]);
        bytes.extend([0; 40]);
        let mut pieces = Pieces::new(&bytes, bytes.len() as u64);
        assert!(matches!(pieces.next(|_| true), Some(Piece::Lost(range)) if range == (0..bytes.len())));
        assert!(pieces.next(|_| true).is_none());
    }
}
