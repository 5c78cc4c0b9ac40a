//! Messages of a broken database, taken from every page that still holds some.
//!
//! Where SQLite meets a broken page it gives up what lies behind, and with a broken first page everything. So all pages
//! are looked at: a leaf whose rows have the shape of messages is one of theirs, whether a way leads there or not.
//! Stored order is the order of the row numbers; numbers that are missing are the messages that are lost.

use std::collections::BTreeMap;

use super::compression::{self, Measure};
use super::pages::{Cell, Page, PageFile, Value};
use super::rows::{Collector, Row, Size, Taken};
use super::schema::{Budget, Describer, TopicTexts, definition};
use crate::topic::Topic;

/// Rows with messages in the order of their numbers.
pub(super) struct Leaves {
    runs: Vec<Run>,
}

/// Rows of one page whose numbers have no holes.
#[derive(Debug, Clone, Copy)]
struct Run {
    page: u32,
    first: i64,
    last: i64,
}

/// The rows of a block: from a row of one run up to a row of another.
#[derive(Debug, Clone, Copy)]
pub(super) struct Span {
    runs: (usize, usize),
    ids: (i64, i64),
}

/// Row numbers that are missing, and the page behind which they are missing.
pub(super) struct Gap {
    pub(super) ids: (i64, i64),
    pub(super) page: u32,
}

impl Gap {
    pub(super) fn count(&self) -> u64 {
        self.ids.1.abs_diff(self.ids.0).saturating_add(1)
    }
}

/// What all pages together hold.
pub(super) struct Found {
    pub(super) leaves: Leaves,
    /// Topics by their ids, where a page still has them.
    pub(super) topics: BTreeMap<i64, Topic>,
    /// Rows left out because others have their numbers too.
    pub(super) repeated: u64,
    /// What is known of topics and left out, a sentence each.
    pub(super) damage: Vec<String>,
}

/// Looks at all pages.
pub(super) fn search(file: &PageFile) -> Found {
    let mut runs: Vec<Run> = Vec::new();
    let mut topics = Vec::new();
    let mut definitions = BTreeMap::new();
    let mut budget = Budget::new(file.len);
    for number in 1..=file.count {
        let Some(page) = file.page(number) else { break };
        let Some(cells) = file.cells(&page) else { continue };
        let before = runs.len();
        for cell in cells.iter().filter(|cell| message(file, &page, cell).is_some()) {
            match runs.last_mut().filter(|run| run.page == number && cell.id.checked_sub(1) == Some(run.last))
            {
                Some(run) => run.last = cell.id,
                None => runs.push(Run { page: number, first: cell.id, last: cell.id }),
            }
        }
        if runs.len() > before {
            continue;
        }
        for cell in &cells {
            match texts(file, &page, cell, &mut budget) {
                Some(texts) if texts.name.starts_with('/') => topics.push((cell.id, texts)),
                Some(TopicTexts {
                    name: type_name, type_name: encoding, format: text, qos: hash, ..
                }) => {
                    definitions.insert(type_name, definition(encoding, text, hash));
                }
                None => {}
            }
        }
    }
    let (runs, repeated) = without_repeated(runs);
    let mut describer = Describer::new(definitions);
    let topics = topics.into_iter().map(|(id, texts)| (id, describer.topic(texts))).collect();
    let damage = [describer.damage(), budget.damage()].concat();
    Found { leaves: Leaves { runs }, topics, repeated, damage }
}

/// Sorts by row number. Of runs that overlap the longest stays: the other ones are rows whose number was damaged, or old copies.
fn without_repeated(mut runs: Vec<Run>) -> (Vec<Run>, u64) {
    runs.sort_by_key(|run| (run.first, run.page));
    let mut kept: Vec<Run> = Vec::with_capacity(runs.len());
    let mut repeated = 0;
    for run in runs {
        let mut is_longest = true;
        while let Some(before) = kept.pop_if(|before| before.last >= run.first) {
            if before.rows() >= run.rows() {
                kept.push(before);
                is_longest = false;
                break;
            }
            repeated += before.rows();
        }
        if is_longest {
            kept.push(run);
        } else {
            repeated += run.rows();
        }
    }
    (kept, repeated)
}

impl Run {
    fn rows(&self) -> u64 {
        self.last.abs_diff(self.first).saturating_add(1)
    }
}

/// The page that was read last: runs that follow each other are mostly on the same one.
#[derive(Default)]
struct Leaf {
    read: Option<(u32, Page, Vec<Cell>)>,
}

impl Leaf {
    /// A page and its rows with these numbers, first and last.
    fn cells(&mut self, file: &PageFile, number: u32, ids: (i64, i64)) -> Option<(&Page, &[Cell])> {
        if self.read.as_ref().is_none_or(|(read, ..)| *read != number) {
            let page = file.page(number)?;
            let cells = file.cells(&page).unwrap_or_default();
            self.read = Some((number, page, cells));
        }
        let (_, page, cells) = self.read.as_ref()?;
        // They are sorted.
        let begin = cells.partition_point(|cell| cell.id < ids.0);
        let end = cells.partition_point(|cell| cell.id <= ids.1);
        Some((page, cells.get(begin..end).unwrap_or_default()))
    }
}

impl Leaves {
    /// How many messages there are.
    pub(super) fn count(&self) -> u64 {
        self.runs.iter().fold(0, |count, run| count.saturating_add(run.rows()))
    }

    /// The page of a message.
    pub(super) fn page_of(&self, id: i64) -> u32 {
        let behind = self.runs.partition_point(|run| run.first <= id);
        behind.checked_sub(1).and_then(|place| self.runs.get(place)).map_or(1, |run| run.page)
    }

    /// Hands all rows to the collector. Returns the rows of the blocks, and the numbers that are missing.
    pub(super) fn scan(
        &self,
        file: &PageFile,
        collector: &mut Collector<'_>,
        measure: &mut Measure,
    ) -> (Vec<Span>, Vec<Gap>) {
        let mut spans: Vec<Span> = Vec::new();
        let mut gaps = Vec::new();
        let mut expected = 1;
        let mut before = 1;
        let mut leaf = Leaf::default();
        for (place, run) in self.runs.iter().enumerate() {
            let Some((page, cells)) = leaf.cells(file, run.page, (run.first, run.last)) else { continue };
            for cell in cells {
                let Some((mut row, begin)) = message(file, page, cell) else { continue };
                if collector.lacks_size(&row)
                    && let Some(Size { stored, in_memory }) = &mut row.data
                {
                    let data = file.read(page, cell, begin..begin + *stored).unwrap_or_default();
                    *in_memory = measure.size(&data);
                }
                if row.id > expected {
                    gaps.push(Gap { ids: (expected, row.id - 1), page: before });
                }
                (expected, before) = (row.id.saturating_add(1), run.page);
                match (collector.take(&row), spans.last_mut()) {
                    (Taken::No, _) => {}
                    (Taken::Same, Some(span)) => (span.runs.1, span.ids.1) = (place, row.id),
                    (Taken::Same, None) | (Taken::Next, _) => {
                        spans.push(Span { runs: (place, place), ids: (row.id, row.id) });
                    }
                }
            }
        }
        (spans, gaps)
    }

    /// Reads the messages of a block. `take` gets each row with its data, `lost` one whose data cannot be read with its page.
    pub(super) fn load(
        &self,
        file: &PageFile,
        span: Span,
        mut take: impl FnMut(&Row, &[u8]),
        mut lost: impl FnMut(i64, u32),
    ) {
        let mut leaf = Leaf::default();
        for run in self.runs.get(span.runs.0..=span.runs.1).unwrap_or_default() {
            let ids = (span.ids.0.max(run.first), span.ids.1.min(run.last));
            let Some((page, cells)) = leaf.cells(file, run.page, ids) else { continue };
            for cell in cells {
                let Some((mut row, place)) = message(file, page, cell) else { continue };
                let size = row.data.map_or(0, |size| size.stored);
                if let Some(Size { stored, in_memory }) = &mut row.data {
                    *in_memory = in_memory.or(Some(*stored));
                }
                match file.read(page, cell, place..place + size) {
                    Ok(data) if data.len() as u64 == size => take(&row, &data),
                    _ => lost(cell.id, run.page),
                }
            }
        }
    }
}

/// The row, if it has the shape of a message: id (stored as nothing), topic, time, data. Also where the data begin.
fn message(file: &PageFile, page: &Page, cell: &Cell) -> Option<(Row, u64)> {
    let values = PageFile::values(page, cell, 4)?;
    let [Value::Null, Value::Integer(topic_id), Value::Integer(timestamp), Value::Blob(stored, place)] =
        values[..]
    else {
        return None;
    };
    let head =
        file.read(page, cell, place..place.saturating_add(compression::HEAD as u64)).unwrap_or_default();
    let data = Some(Size { stored, in_memory: compression::size_in_memory(&head, stored) });
    Some((Row { id: cell.id, topic_id: Some(topic_id), timestamp: Some(timestamp), data }, place))
}

/// The texts of a row that consists of nothing else, at least three: a topic, or a definition, whose columns come in another
/// order (type, encoding, text, hash).
fn texts(file: &PageFile, page: &Page, cell: &Cell, budget: &mut Budget) -> Option<TopicTexts> {
    let values = PageFile::values(page, cell, 6)?;
    let Some((Value::Null, texts)) = values.split_first() else { return None };
    let places: Vec<_> = texts
        .iter()
        .map(|value| match *value {
            Value::Text(size, place) => Some(place..place + size),
            _ => None,
        })
        .collect();
    let [Some(_), Some(_), Some(_), ..] = places[..] else { return None };
    let end = places.iter().flatten().map(|place| place.end).max()?;
    if !budget.take(end) {
        return None;
    }
    let row = file.read(page, cell, 0..end).ok()?;
    let mut found = places.iter().map(|place| {
        let place = place.as_ref()?;
        let bytes = row.get(usize::try_from(place.start).ok()?..usize::try_from(place.end).ok()?)?;
        Some(String::from_utf8_lossy(bytes).into_owned())
    });
    let (name, type_name, format) = (found.next()??, found.next()??, found.next()??);
    let mut or_nothing = || found.next().flatten().unwrap_or_default();
    Some(TopicTexts { name, type_name, format, qos: or_nothing(), type_hash: or_nothing() })
}
