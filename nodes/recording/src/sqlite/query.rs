//! Messages of a whole database, asked of SQLite by row number.
//!
//! Rows are stored in the order of their numbers, and a recorder hands out numbers as messages come in. So blocks are ranges of
//! numbers, read from front to back; the index of times that rosbag2 keeps is not needed, and may be broken.

use rusqlite::types::ValueRef;
use rusqlite::{OptionalExtension, Statement, params};

use super::compression::{self, Measure};
use super::database::Database;
use super::rows::{Collector, Row, Size, Taken};

/// Numbers of the first and the last row of a block.
pub(super) type Ids = (i64, i64);

/// Why a scan stopped, and the number of the row it could not read.
pub(super) struct Stop {
    pub(super) id: i64,
    pub(super) reason: String,
}

/// Goes through all rows without reading the messages themselves, unless they are compressed: then their heads have to be
/// looked at. Returns the blocks' rows.
pub(super) fn scan(
    database: &Database,
    collector: &mut Collector<'_>,
    measure: &mut Measure,
) -> Result<Vec<Ids>, Stop> {
    let stop = |error: rusqlite::Error| Stop { id: 1, reason: error.to_string() };
    let mut with_data =
        database.prepare("SELECT data FROM messages NOT INDEXED WHERE id = ?1").map_err(stop)?;
    let mut parts: Vec<Ids> = Vec::new();
    let mut last = None;
    let each = |mut row: Row| {
        if last.replace(row.id).is_some_and(|last| last >= row.id) {
            return Some("the table of messages leads back into itself".to_owned());
        }
        if collector.lacks_size(&row)
            && let Some(size) = &mut row.data
        {
            let measured = |found: &rusqlite::Row<'_>| {
                Ok(found.get_ref(0)?.as_blob().map_or(Some(0), |data| measure.size(data)))
            };
            // What cannot be read is said when it is loaded.
            size.in_memory = with_data.query_row([row.id], measured).unwrap_or(Some(size.stored));
        }
        match (collector.take(&row), parts.last_mut()) {
            (Taken::No, _) => {}
            (Taken::Same, Some(part)) => part.1 = row.id,
            (Taken::Same, None) | (Taken::Next, _) => parts.push((row.id, row.id)),
        }
        None
    };
    let scanned = for_each_row(database, each);
    if let Some(reason) = scanned.unwrap_or_else(|error| Some(error.to_string())) {
        return Err(Stop { id: last.map_or(1, |last| last.saturating_add(1)), reason });
    }
    match not_found(database, &parts) {
        Ok(None) => Ok(parts),
        Ok(Some(id)) => Err(Stop { id, reason: format!("message {id} is not where the table says") }),
        Err(error) => Err(stop(error)),
    }
}

/// The first block whose first row is not found by its number. Going through all rows follows the links from page to page;
/// loading a block follows the numbers on the way there, which may be wrong all the same.
fn not_found(database: &Database, parts: &[Ids]) -> rusqlite::Result<Option<i64>> {
    let mut next =
        database.prepare("SELECT id FROM messages NOT INDEXED WHERE id >= ?1 ORDER BY id LIMIT 1")?;
    for (first, _) in parts {
        database.renew();
        let found: Option<i64> = next.query_row([first], |row| row.get(0)).optional()?;
        if found != Some(*first) {
            return Ok(Some(*first));
        }
    }
    Ok(None)
}

/// Hands each row to `each` until that says why not to go on.
fn for_each_row(
    database: &Database,
    mut each: impl FnMut(Row) -> Option<String>,
) -> rusqlite::Result<Option<String>> {
    let blob = "CASE typeof(data) WHEN 'blob' THEN";
    let head = match has_compressed(database) {
        true => format!("{blob} substr(data, 1, {}) END", compression::HEAD),
        false => "NULL".to_owned(),
    };
    let sql = format!(
        "SELECT id, topic_id, timestamp, {blob} octet_length(data) END, {head} FROM messages NOT INDEXED ORDER BY id"
    );
    let mut statement = database.prepare(&sql)?;
    let mut rows = statement.query([])?;
    while let Some(found) = rows.next()? {
        let size = integer(found.get_ref(3)?).and_then(|size| u64::try_from(size).ok());
        let head = match found.get_ref(4)? {
            ValueRef::Blob(head) => head,
            _ => &[],
        };
        let data = size.map(|stored| Size { stored, in_memory: compression::size_in_memory(head, stored) });
        let (topic_id, timestamp) = (integer(found.get_ref(1)?), integer(found.get_ref(2)?));
        let reason = each(Row { id: found.get(0)?, topic_id, timestamp, data });
        if reason.is_some() {
            return Ok(reason);
        }
    }
    Ok(None)
}

/// Whether the first message is compressed. A recorder compresses all or none.
fn has_compressed(database: &Database) -> bool {
    let sql = "SELECT data FROM messages NOT INDEXED ORDER BY id LIMIT 1";
    let first = |row: &rusqlite::Row<'_>| {
        Ok(matches!(row.get_ref(0)?, ValueRef::Blob(data) if compression::is_compressed(data)))
    };
    // A first message that cannot be read says nothing; the scan or the loading finds it again.
    database.prepare(sql).and_then(|mut statement| statement.query_row([], first)).unwrap_or(false)
}

/// Reads the messages of a block. `take` gets each row with its data, `lost` the number of a row that cannot be read.
pub(super) fn load(
    database: &Database,
    (first, last): Ids,
    mut take: impl FnMut(&Row, &[u8]),
    mut lost: impl FnMut(i64, &rusqlite::Error),
) -> rusqlite::Result<()> {
    let sql = "SELECT id, topic_id, timestamp, data FROM messages NOT INDEXED WHERE id BETWEEN ?1 AND ?2 ORDER BY id";
    let mut with_data = database.prepare(sql)?;
    let next = "SELECT id FROM messages NOT INDEXED WHERE id BETWEEN ?1 AND ?2 ORDER BY id LIMIT 1";
    let mut next = database.prepare(next)?;
    let mut from = first;
    loop {
        database.renew();
        let Err(error) = load_from(&mut with_data, &mut from, last, &mut take) else { return Ok(()) };
        // The row itself is there, as the scan saw; what it continues on is not.
        database.renew();
        let broken: i64 = next.query_row(params![from, last], |row| row.get(0))?;
        lost(broken, &error);
        match broken.checked_add(1).filter(|next| *next <= last) {
            Some(next) => from = next,
            None => return Ok(()),
        }
    }
}

/// Reads rows up to `last`; `from` follows the next one.
fn load_from(
    statement: &mut Statement<'_>,
    from: &mut i64,
    last: i64,
    take: &mut impl FnMut(&Row, &[u8]),
) -> rusqlite::Result<()> {
    let mut rows = statement.query(params![*from, last])?;
    while let Some(found) = rows.next()? {
        let id: i64 = found.get(0)?;
        if id < *from {
            return Ok(());
        }
        if let ValueRef::Blob(data) = found.get_ref(3)? {
            let stored = data.len() as u64;
            // One that was too large when it was measured is too large for the block as well.
            let in_memory = compression::size_in_memory(data, stored).or(Some(stored));
            let size = Size { stored, in_memory };
            let (topic_id, timestamp) = (integer(found.get_ref(1)?), integer(found.get_ref(2)?));
            take(&Row { id, topic_id, timestamp, data: Some(size) }, data);
        }
        *from = id.saturating_add(1);
    }
    Ok(())
}

fn integer(value: ValueRef<'_>) -> Option<i64> {
    match value {
        ValueRef::Integer(value) => Some(value),
        _ => None,
    }
}
