//! A write-ahead log, read without SQLite: which of its frames are whole, and what they make of a database.
//!
//! Each frame holds a page. SQLite uses the frames up to the first one that is broken; everything behind it is left out
//! without a word. Here a broken frame costs itself: the checksum of each one goes on from that of the frame before it, and is
//! checked by itself from there. Everything follows the published file format (sqlite.org/fileformat2.html), section 4.

use std::fs::File;
use std::io::{self, BufReader, Read};
use std::os::unix::fs::FileExt;
use std::path::Path;

use super::pages;

/// Head of a log, bytes.
pub(super) const HEAD: u64 = 32;
/// Head of a frame, in front of its page, bytes.
const FRAME_HEAD: usize = 24;
/// The first number of every log. Its last bit says in which order the bytes of the checksums' words are.
const MAGIC: u32 = 0x377f_0682;
const VERSION: u32 = 3_007_000;

/// What is in a log.
#[derive(Debug, Default, PartialEq, Eq)]
pub(super) struct Log {
    page_size: usize,
    /// Heads, of the log or of its frames, that are not what was written.
    broken_heads: u64,
    /// The whole frames of this log in their order, without those behind the last transaction that was completed.
    pages: Vec<LoggedPage>,
    /// Pages of the database after the last transaction.
    pages_after: u32,
    /// Frames of this log that are not what was written.
    broken: u64,
    /// Bytes behind the last transaction that was completed; what is left of an older log does not count.
    unfinished_bytes: u64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct LoggedPage {
    number: u32,
    /// Of its first byte in the log.
    offset: u64,
}

/// A checksum as far as it has come.
type Sum = [u32; 2];

struct Frame {
    page: u32,
    /// Pages of the database, in the last frame of a transaction; 0 in the others.
    pages_after: u32,
    salts: [u8; 8],
    stored: Sum,
    bytes: Vec<u8>,
}

impl Log {
    /// Reads the log at `path`, which belongs to the database at `database`.
    pub(super) fn read(path: &Path, database: &Path) -> io::Result<Self> {
        let mut file = BufReader::with_capacity(1 << 20, File::open(path)?);
        let mut head = [0; HEAD as usize];
        file.read_exact(&mut head)?;
        let is_log = number(&head, 0) & !1 == MAGIC && number(&head, 4) == VERSION;
        let start = [number(&head, 24), number(&head, 28)];
        let sums = |is_big: bool| sum([0; 2], head.get(..24).unwrap_or_default(), is_big) == start;
        let has_broken_head = !(is_log && sums(number(&head, 0) & 1 == 1));
        let page_size = match number(&head, 8) {
            size if !has_broken_head && pages::is_page_size(size) => size as usize,
            _ => pages::size_in(database)?,
        };
        let mut log = Self { page_size, broken_heads: u64::from(has_broken_head), ..Self::default() };
        let mut walk = Walk { is_big: number(&head, 0) & 1 == 1, starts: vec![start], salts: None };
        if !has_broken_head {
            walk.salts = head.get(16..24).and_then(|salts| salts.try_into().ok());
        }
        let mut offset = HEAD;
        // Whether those in doubt are of this log is known when another one of it follows.
        let mut in_doubt = 0;
        let mut completed = 0;
        loop {
            let frame = Frame::read(&mut file, page_size)?;
            let length = frame.bytes.len() as u64;
            if frame.bytes.len() < FRAME_HEAD + page_size {
                let is_begun = walk.salts == Some(frame.salts) || completed < log.pages.len();
                log.unfinished_bytes += if is_begun { length } else { 0 };
                break;
            }
            if offset == HEAD && has_broken_head {
                walk.guess(&frame);
            }
            match walk.take(&frame) {
                Kind::Whole => {
                    log.broken += std::mem::take(&mut in_doubt);
                    log.broken_heads += u64::from(walk.salts != Some(frame.salts));
                    log.unfinished_bytes += length;
                    log.pages.push(LoggedPage { number: frame.page, offset: offset + FRAME_HEAD as u64 });
                    if frame.pages_after > 0 {
                        completed = log.pages.len();
                        (log.pages_after, log.unfinished_bytes) = (frame.pages_after, 0);
                    }
                }
                Kind::Broken => log.broken += std::mem::take(&mut in_doubt) + 1,
                Kind::Unknown => in_doubt += 1,
            }
            offset += length;
        }
        log.pages.truncate(completed);
        Ok(log)
    }

    /// Whether there is a page in it that can be used.
    pub(super) fn has_pages(&self) -> bool {
        !self.pages.is_empty()
    }

    /// Whether SQLite uses all of it.
    pub(super) fn is_whole(&self) -> bool {
        self.broken_heads == 0 && self.broken == 0
    }

    /// What of a log of `len` bytes is not used, as a sentence.
    pub(super) fn loss(&self, len: u64) -> Option<String> {
        let frame = (self.page_size + FRAME_HEAD) as u64;
        if self.pages.is_empty() && !self.is_whole() {
            return Some(format!("the log is broken: nothing in it can be used, {len} bytes"));
        }
        let used = "what its whole pages hold is read";
        if self.broken > 0 {
            let (broken, bytes) = (self.broken, self.broken * frame);
            return Some(format!("broken pages in the log: {broken}, {bytes} bytes are not used; {used}"));
        }
        if self.broken_heads > 0 {
            return Some(format!("broken heads in the log: {}; {used}", self.broken_heads));
        }
        (self.unfinished_bytes > 0).then(|| {
            let bytes = self.unfinished_bytes;
            format!("the recorder still writes to the log, or was stopped while it did: {bytes} bytes at its end are not used")
        })
    }

    /// Writes the pages of the log at `path` into a copy of its database.
    pub(super) fn write_into(&self, path: &Path, copy: &Path) -> io::Result<()> {
        let log = File::open(path)?;
        let copy = File::options().write(true).open(copy)?;
        let mut page = vec![0; self.page_size];
        // A frame can claim a page far behind the end, which would make a file of terabytes.
        for logged in self.pages.iter().filter(|logged| (1..=self.pages_after).contains(&logged.number)) {
            log.read_exact_at(&mut page, logged.offset)?;
            copy.write_all_at(&page, u64::from(logged.number - 1) * self.page_size as u64)?;
        }
        copy.set_len(u64::from(self.pages_after) * self.page_size as u64)
    }

    /// Size of the database after the log is written into it, bytes.
    pub(super) fn size_after(&self) -> u64 {
        u64::from(self.pages_after) * self.page_size as u64
    }
}

enum Kind {
    Whole,
    Broken,
    /// Of an older log, which was written over up to here, or broken so that nothing says which.
    Unknown,
}

struct Walk {
    is_big: bool,
    /// From where the checksum of the next frame may go on.
    starts: Vec<Sum>,
    /// What all frames of this log have in them.
    salts: Option<[u8; 8]>,
}

impl Walk {
    /// Finds out from the first frame what a broken head does not say.
    fn guess(&mut self, frame: &Frame) {
        self.salts = Some(frame.salts);
        let goes_on =
            |is_big: &bool| self.starts.iter().any(|start| frame.sum(*start, *is_big) == frame.stored);
        self.is_big = [self.is_big, !self.is_big].into_iter().find(goes_on).unwrap_or(self.is_big);
    }

    fn take(&mut self, frame: &Frame) -> Kind {
        let is_whole = self.starts.iter().any(|start| frame.sum(*start, self.is_big) == frame.stored);
        if !is_whole && self.salts != Some(frame.salts) {
            return Kind::Unknown;
        }
        // What is broken may be the checksum alone: then the next one goes on from what it should be.
        let computed = self.starts.iter().map(|start| frame.sum(*start, self.is_big)).next();
        self.starts = [Some(frame.stored), computed.filter(|_| !is_whole)].into_iter().flatten().collect();
        if is_whole { Kind::Whole } else { Kind::Broken }
    }
}

impl Frame {
    /// The next frame, or as much of it as is there.
    fn read(file: &mut impl Read, page_size: usize) -> io::Result<Self> {
        let mut bytes = Vec::with_capacity(FRAME_HEAD + page_size);
        file.take((FRAME_HEAD + page_size) as u64).read_to_end(&mut bytes)?;
        let salts = bytes.get(8..16).and_then(|salts| salts.try_into().ok()).unwrap_or_default();
        let stored = [number(&bytes, 16), number(&bytes, 20)];
        Ok(Self { page: number(&bytes, 0), pages_after: number(&bytes, 4), salts, stored, bytes })
    }

    /// The checksum up to here, when it goes on from `start`.
    fn sum(&self, start: Sum, is_big: bool) -> Sum {
        let (head, page) = self.bytes.split_at_checked(FRAME_HEAD).unwrap_or_default();
        sum(sum(start, head.get(..8).unwrap_or_default(), is_big), page, is_big)
    }
}

/// Goes on with a checksum over bytes, of which there are a multiple of eight.
fn sum(start: Sum, bytes: &[u8], is_big: bool) -> Sum {
    let word = |word: [u8; 4]| if is_big { u32::from_be_bytes(word) } else { u32::from_le_bytes(word) };
    bytes.as_chunks::<8>().0.iter().fold(start, |[one, two], &[a, b, c, d, e, f, g, h]| {
        let one = one.wrapping_add(word([a, b, c, d])).wrapping_add(two);
        [one, two.wrapping_add(word([e, f, g, h])).wrapping_add(one)]
    })
}

/// The number at a place; 0 behind the end.
fn number(bytes: &[u8], at: usize) -> u32 {
    bytes.get(at..).and_then(|rest| rest.first_chunk()).copied().map_or(0, u32::from_be_bytes)
}
