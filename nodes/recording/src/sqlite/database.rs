//! A database opened so that nothing in it or beside it is changed, and nothing in it is executed.
//!
//! The file is opened as immutable: no lock, no `-wal`, no `-shm`, also in a directory that cannot be written. What a
//! stranger's file may contain beyond tables (views, triggers, virtual tables, computed columns) is refused by name, and
//! every statement has a number of steps that a whole file of its size cannot need.

use std::os::unix::ffi::OsStrExt;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicI64, Ordering};

use rusqlite::config::DbConfig;
use rusqlite::limits::Limit;
use rusqlite::types::ValueRef;
use rusqlite::{Connection, OpenFlags, Statement};

use crate::block::MAX_BLOCK_BYTES;

/// Steps between two looks at the allowance.
const STEPS_AT_ONCE: i32 = 1 << 12;
/// What opening, the schema and short tables need, steps.
const STEPS_FOR_ANY_FILE: i64 = 1 << 22;
/// A row needs at least eight bytes of the file and far less than a hundred steps.
const STEPS_PER_BYTE: i64 = 16;

/// An open database.
pub(super) struct Database {
    connection: Connection,
    /// Steps the running statement may still take.
    steps: Arc<AtomicI64>,
    allowance: i64,
}

/// A column of a table.
#[derive(Debug)]
struct Column {
    name: String,
    is_integer: bool,
    is_key: bool,
    is_computed: bool,
}

/// Why a table is not read.
#[derive(Debug)]
pub(super) enum Unfit {
    /// It is not there, or not all of it.
    Missing(String),
    /// It is something else than rows on pages, or not what rosbag2 makes.
    Refused(String),
}

/// A table of which it is known that reading it reads rows and does nothing else.
#[derive(Debug)]
pub(super) struct Table {
    /// Number of its first page.
    pub(super) root: u32,
    columns: Vec<Column>,
}

impl Table {
    pub(super) fn has(&self, column: &str) -> bool {
        self.columns.iter().any(|known| known.name == column)
    }
}

impl Database {
    /// Opens the file at `path`, which has `len` bytes.
    pub(super) fn open(path: &Path, len: u64) -> rusqlite::Result<Self> {
        let flags =
            OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_URI | OpenFlags::SQLITE_OPEN_NO_MUTEX;
        let mut connection = Connection::open_with_flags(immutable(path), flags)?;
        connection.set_db_config(DbConfig::SQLITE_DBCONFIG_DEFENSIVE, true)?;
        connection.set_db_config(DbConfig::SQLITE_DBCONFIG_TRUSTED_SCHEMA, false)?;
        connection.set_db_config(DbConfig::SQLITE_DBCONFIG_ENABLE_VIEW, false)?;
        connection.set_db_config(DbConfig::SQLITE_DBCONFIG_ENABLE_TRIGGER, false)?;
        // A row is little more than the message in it.
        let row = i32::try_from(MAX_BLOCK_BYTES + (1 << 16)).unwrap_or(i32::MAX);
        connection.set_limit(Limit::SQLITE_LIMIT_LENGTH, row)?;
        let allowance = STEPS_FOR_ANY_FILE
            .saturating_add(i64::try_from(len).unwrap_or(i64::MAX).saturating_mul(STEPS_PER_BYTE));
        let steps = Arc::new(AtomicI64::new(allowance));
        let left = Arc::clone(&steps);
        let is_too_much =
            move || left.fetch_sub(i64::from(STEPS_AT_ONCE), Ordering::Relaxed) < i64::from(STEPS_AT_ONCE);
        connection.progress_handler(STEPS_AT_ONCE, Some(is_too_much))?;
        let database = Self { connection, steps, allowance };
        // Reads the first page, so that a file that is no database says so here.
        database.prepare("PRAGMA cell_size_check = ON")?.query([])?.next()?;
        database.prepare("SELECT count(*) FROM sqlite_schema")?.query_row([], |_| Ok(()))?;
        Ok(database)
    }

    /// A statement with the full allowance of steps; one at a time.
    pub(super) fn prepare(&self, sql: &str) -> rusqlite::Result<Statement<'_>> {
        self.renew();
        self.connection.prepare(sql)
    }

    /// Gives the statement that runs next the full allowance again.
    pub(super) fn renew(&self) {
        self.steps.store(self.allowance, Ordering::Relaxed);
    }

    /// The table of this name, which must have these columns, and `id` as the number of its rows.
    ///
    /// # Errors
    /// The outer error is the database's, the inner one says why the table is not read.
    pub(super) fn table_with(&self, name: &str, needed: &[&str]) -> rusqlite::Result<Result<Table, Unfit>> {
        let refused = |reason: String| Ok(Err(Unfit::Refused(reason)));
        let missing = |reason: String| Ok(Err(Unfit::Missing(reason)));
        match self.kind(name)? {
            None => return missing(format!("it has no table {name:?}")),
            Some((kind, false)) if kind == "table" => {}
            Some((kind, true)) if kind == "table" => {
                return refused(format!("its table {name:?} has no row numbers"));
            }
            Some((kind, _)) => {
                return refused(format!("its {name:?} is of the kind {kind:?} and no plain table"));
            }
        }
        let columns = self.columns(name)?;
        if let Some(column) = columns.iter().find(|column| column.is_computed) {
            return refused(format!("column {:?} of its table {name:?} is computed", column.name));
        }
        if let Some(column) =
            needed.iter().find(|needed| !columns.iter().any(|column| column.name == **needed))
        {
            return missing(format!("its table {name:?} has no column {column:?}"));
        }
        let mut keys = columns.iter().filter(|column| column.is_key);
        let is_id = |column: &Column| column.name == "id" && column.is_integer;
        if !keys.next().is_some_and(is_id) || keys.next().is_some() {
            return refused(format!("column \"id\" of its table {name:?} is not its integer primary key"));
        }
        let root = "SELECT rootpage FROM sqlite_schema WHERE type = 'table' AND name = ?1 COLLATE NOCASE";
        let root = self.prepare(root)?.query_row([name], |row| row.get(0))?;
        Ok(Ok(Table { root, columns }))
    }

    /// What a name stands for, and whether it is a table without row numbers.
    fn kind(&self, name: &str) -> rusqlite::Result<Option<(String, bool)>> {
        let sql = "SELECT type, wr FROM pragma_table_list(?1) WHERE schema = 'main'";
        let mut statement = self.prepare(sql)?;
        let mut rows = statement.query([name])?;
        rows.next()?.map(|row| Ok((text(row.get_ref(0)?), row.get(1)?))).transpose()
    }

    fn columns(&self, name: &str) -> rusqlite::Result<Vec<Column>> {
        let sql = "SELECT name, type, pk, hidden FROM pragma_table_xinfo(?1, 'main')";
        let mut statement = self.prepare(sql)?;
        let column = |row: &rusqlite::Row<'_>| {
            Ok(Column {
                name: text(row.get_ref(0)?),
                is_integer: text(row.get_ref(1)?).eq_ignore_ascii_case("integer"),
                is_key: row.get::<_, i64>(2)? != 0,
                is_computed: row.get::<_, i64>(3)? != 0,
            })
        };
        statement.query_map([name], column)?.collect()
    }
}

/// The text of a value, whatever bytes it has; empty for anything but text.
pub(super) fn text(value: ValueRef<'_>) -> String {
    match value {
        ValueRef::Text(bytes) => String::from_utf8_lossy(bytes).into_owned(),
        _ => String::new(),
    }
}

/// The address under which SQLite opens a file and neither looks for nor makes anything beside it.
fn immutable(path: &Path) -> String {
    let mut address = String::from("file:");
    // "file:" takes two slashes for the beginning of a host's name.
    if path.is_absolute() {
        address.push_str("//");
    }
    for byte in path.as_os_str().as_bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'.' | b'-' | b'_' => {
                address.push(char::from(*byte))
            }
            _ => address.push_str(&format!("%{byte:02X}")),
        }
    }
    address.push_str("?immutable=1");
    address
}
