//! The pages of a database file, read without SQLite: what it takes to find rows where SQLite gives up.
//!
//! A table is a tree of pages. Leaves hold rows, each with its number and a list of values; a row too long for its page goes
//! on in a chain of overflow pages. Everything here follows the published file format (sqlite.org/fileformat2.html),
//! sections 1.3, 1.6 and 2.1.

use std::fs::File;
use std::ops::Range;
use std::os::unix::fs::FileExt;
use std::path::Path;

/// First bytes of every database.
pub(super) const MAGIC: &[u8; 16] = b"SQLite format 3\0";
/// Head of the file, in front of the first page's own head.
const FILE_HEAD: usize = 100;
/// What SQLite and rosbag2 use unless told otherwise, bytes.
const USUAL_PAGE: usize = 4096;
/// Trees are never deeper.
const DEEPEST: usize = 20;
const INNER: u8 = 0x05;
const LEAF: u8 = 0x0d;

/// Whether pages can have this size, bytes.
pub(super) fn is_page_size(size: u32) -> bool {
    (512..=1 << 16).contains(&size) && size.is_power_of_two()
}

/// The size of the pages that a database says it has; the usual one where it says nothing.
pub(super) fn size_in(path: &Path) -> std::io::Result<usize> {
    let mut head = [0; FILE_HEAD];
    match File::open(path)?.read_exact_at(&mut head, 0) {
        Err(error) if error.kind() != std::io::ErrorKind::UnexpectedEof => Err(error),
        _ => Ok(page_size(&head).unwrap_or(USUAL_PAGE)),
    }
}

fn page_size(head: &[u8; FILE_HEAD]) -> Option<usize> {
    let size = match u16::from_be_bytes([head[16], head[17]]) {
        1 => 1 << 16,
        size => u32::from(size),
    };
    (head.starts_with(MAGIC) && is_page_size(size)).then_some(size as usize)
}

/// A file of pages.
pub(super) struct PageFile {
    file: File,
    page_size: usize,
    /// Without what is reserved at the end of each page.
    usable: usize,
    /// Number of pages that are there, the last one possibly cut.
    pub(super) count: u32,
    /// Size of the file, bytes.
    pub(super) len: u64,
    /// Number of pages that should be there; 0 where the file does not say.
    promised: u32,
    has_magic: bool,
}

/// A page in memory.
pub(super) struct Page {
    bytes: Vec<u8>,
    /// Where its head begins.
    head: usize,
}

/// A row in a leaf.
pub(super) struct Cell {
    pub(super) id: i64,
    /// Of the whole row in bytes, wherever they are.
    size: u64,
    /// What of the row is in the leaf itself.
    local: Range<usize>,
    /// First page of the rest; 0 for none.
    overflow: u32,
}

/// A value of a row, as the row's head announces it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Value {
    Null,
    Integer(i64),
    Real,
    /// Size and place in the row.
    Text(u64, u64),
    /// Size and place in the row.
    Blob(u64, u64),
}

impl PageFile {
    pub(super) fn open(path: &Path) -> std::io::Result<Self> {
        let file = File::open(path)?;
        let len = file.metadata()?.len();
        let mut head = [0; FILE_HEAD];
        let has_head = file.read_exact_at(&mut head, 0).is_ok() && head.starts_with(MAGIC);
        let (page_size, reserved) = match page_size(&head) {
            Some(size) => (size, head[20]),
            None => (USUAL_PAGE, 0),
        };
        let usable = page_size - usize::from(reserved);
        // The format allows no less.
        let usable = if usable < 480 { page_size } else { usable };
        let count = u32::try_from(len.div_ceil(page_size as u64)).unwrap_or(u32::MAX);
        let number = |at: usize| {
            head.get(at..).and_then(|rest| rest.first_chunk()).copied().map_or(0, u32::from_be_bytes)
        };
        // The number of pages holds only when the change counter agrees with its copy.
        let promised = if has_head && number(24) == number(92) { number(28) } else { 0 };
        Ok(Self { file, page_size, usable, count, len, promised, has_magic: has_head })
    }

    /// What is wrong with the file as a whole.
    pub(super) fn fault(&self) -> Option<String> {
        if !self.has_magic {
            return Some("the file does not begin with the SQLite magic bytes".to_owned());
        }
        let (there, promised) = (self.count, self.promised);
        let is_cut = promised > there || !self.len.is_multiple_of(self.page_size as u64);
        is_cut.then(|| format!("the file is cut: {there} of {} pages are there", promised.max(there)))
    }

    /// First byte of a page.
    pub(super) fn offset(&self, number: u32) -> u64 {
        u64::from(number.saturating_sub(1)) * self.page_size as u64
    }

    /// The page with this number, counted from 1; what a cut file lacks of it is 0.
    pub(super) fn page(&self, number: u32) -> Option<Page> {
        let offset = self.offset(number);
        if number == 0 || offset >= self.len {
            return None;
        }
        let mut bytes = vec![0; self.page_size];
        let there = usize::try_from(self.len - offset).unwrap_or(usize::MAX).min(self.page_size);
        self.file.read_exact_at(bytes.get_mut(..there)?, offset).ok()?;
        Some(Page { bytes, head: if number == 1 { FILE_HEAD } else { 0 } })
    }

    /// The rows of a leaf in the order of their numbers; `None` for any other page. A row that cannot be one is left out.
    pub(super) fn cells(&self, page: &Page) -> Option<Vec<Cell>> {
        if page.byte(0)? != LEAF {
            return None;
        }
        let count = usize::from(page.short(3)?);
        let mut cells: Vec<_> = (0..count).filter_map(|place| self.cell(page, place)).collect();
        // A bit flipped in a number puts a row where it does not belong: those that go on are right.
        cells.sort_by_key(|cell| cell.id);
        cells.dedup_by_key(|cell| cell.id);
        Some(cells)
    }

    fn cell(&self, page: &Page, place: usize) -> Option<Cell> {
        let begin = usize::from(page.short(8 + 2 * place)?);
        let rest = page.bytes.get(begin..self.usable)?;
        let (size, size_length) = varint(rest)?;
        let (id, id_length) = varint(rest.get(size_length..)?)?;
        let content = begin + size_length + id_length;
        let (local, is_whole) = self.local(size);
        let end = content.checked_add(local).filter(|end| *end <= self.usable)?;
        let overflow = if is_whole { 0 } else { u32::from_be_bytes(*page.bytes.get(end..)?.first_chunk()?) };
        let is_possible = size <= self.len && (is_whole || (overflow > 1 && overflow <= self.count));
        is_possible.then_some(Cell { id: id.cast_signed(), size, local: content..end, overflow })
    }

    /// How much of a row of `size` bytes is in the leaf, and whether that is all.
    fn local(&self, size: u64) -> (usize, bool) {
        let most = self.usable - 35;
        match usize::try_from(size) {
            Ok(size) if size <= most => (size, true),
            _ => {
                let least = (self.usable - 12) * 32 / 255 - 23;
                let rest = (size - least as u64) % (self.usable as u64 - 4);
                let local = least + usize::try_from(rest).unwrap_or(usize::MAX - least);
                (if local <= most { local } else { least }, false)
            }
        }
    }

    /// Reads `range` of a row. The error says where the chain of overflow pages ends too early.
    pub(super) fn read(&self, page: &Page, cell: &Cell, range: Range<u64>) -> Result<Vec<u8>, u32> {
        let mut bytes = page.bytes.get(cell.local.clone()).unwrap_or_default().to_vec();
        let end = range.end.min(cell.size);
        let mut next = cell.overflow;
        while (bytes.len() as u64) < end {
            let link = self.page(next).filter(|_| next > 1).ok_or(next)?;
            let (following, content) = link.bytes.split_first_chunk().ok_or(next)?;
            let content = content.get(..self.usable - 4).unwrap_or(content);
            let missing = usize::try_from(end - bytes.len() as u64).unwrap_or(usize::MAX);
            bytes.extend_from_slice(content.get(..missing).unwrap_or(content));
            next = u32::from_be_bytes(*following);
            if (bytes.len() as u64) < cell.size && (next < 2 || next > self.count) {
                return Err(next);
            }
        }
        let begin = usize::try_from(range.start).unwrap_or(usize::MAX).min(bytes.len());
        bytes.truncate(usize::try_from(end).unwrap_or(usize::MAX));
        bytes.drain(..begin.min(bytes.len()));
        Ok(bytes)
    }

    /// The values of a row, at most `most`; `None` when its head cannot be one.
    pub(super) fn values(page: &Page, cell: &Cell, most: usize) -> Option<Vec<Value>> {
        let local = page.bytes.get(cell.local.clone())?;
        let (head, mut at) = varint(local)?;
        let head_end = usize::try_from(head).ok().filter(|end| *end <= local.len())?;
        let mut place = head;
        let mut values = Vec::new();
        while at < head_end && values.len() < most {
            let (kind, length) = varint(local.get(at..head_end)?)?;
            at += length;
            let size = match kind {
                0 | 8 | 9 => 0,
                1..=4 => kind,
                5 => 6,
                6 | 7 => 8,
                10 | 11 => return None,
                _ => (kind - 12) / 2,
            };
            let end = place.checked_add(size).filter(|end| *end <= cell.size)?;
            values.push(match kind {
                0 => Value::Null,
                8 => Value::Integer(0),
                9 => Value::Integer(1),
                7 => Value::Real,
                1..=6 => {
                    let begin = usize::try_from(place).ok()?;
                    Value::Integer(integer(local.get(begin..begin + usize::try_from(size).ok()?)?))
                }
                _ if kind % 2 == 0 => Value::Blob(size, place),
                _ => Value::Text(size, place),
            });
            place = end;
        }
        // More values than asked for are somebody else's table.
        (at == head_end).then_some(values)
    }

    /// The page at which the way from page `root` to row `id` ends: its leaf, or what stands where a page should be.
    pub(super) fn page_of(&self, root: u32, id: i64) -> u32 {
        let mut number = root;
        for _ in 0..DEEPEST {
            let Some(next) = self.page(number).and_then(|page| child_for(&page, id)) else { break };
            number = next;
        }
        number
    }
}

impl Page {
    fn byte(&self, at: usize) -> Option<u8> {
        self.bytes.get(self.head + at).copied()
    }

    fn short(&self, at: usize) -> Option<u16> {
        Some(u16::from_be_bytes(*self.bytes.get(self.head + at..)?.first_chunk()?))
    }

    fn long(&self, at: usize) -> Option<u32> {
        Some(u32::from_be_bytes(*self.bytes.get(at..)?.first_chunk()?))
    }
}

/// The child of an inner page under which row `id` is.
fn child_for(page: &Page, id: i64) -> Option<u32> {
    if page.byte(0)? != INNER {
        return None;
    }
    for place in 0..usize::from(page.short(3)?) {
        let begin = usize::from(page.short(12 + 2 * place)?);
        let (key, _) = varint(page.bytes.get(begin + 4..)?)?;
        if id <= key.cast_signed() {
            return page.long(begin);
        }
    }
    page.long(page.head + 8)
}

/// A number of one to nine bytes and how many it takes.
fn varint(bytes: &[u8]) -> Option<(u64, usize)> {
    let mut value = 0;
    for (place, byte) in bytes.iter().take(8).enumerate() {
        value = value << 7 | u64::from(byte & 0x7f);
        if byte & 0x80 == 0 {
            return Some((value, place + 1));
        }
    }
    Some((value << 8 | u64::from(*bytes.get(8)?), 9))
}

/// A big-endian number of up to eight bytes with its sign.
fn integer(bytes: &[u8]) -> i64 {
    let sign = if bytes.first().is_some_and(|byte| byte & 0x80 != 0) { -1 } else { 0 };
    bytes.iter().fold(sign, |value, byte| value << 8 | i64::from(*byte))
}
