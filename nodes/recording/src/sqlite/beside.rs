//! What lies beside a database: the log of a recorder that still runs, or that was stopped before it tidied up.
//!
//! With a write-ahead log (`NAME.db3-wal`) part of the recording is in the log alone. Reading it in place would make
//! files in the recording's directory, so that database and log are copied to a temporary directory and joined there: by
//! SQLite where the log is whole, else without it, so that what is broken costs itself and nothing behind it.

use std::ffi::OsString;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use rusqlite::{Connection, OpenFlags};
use tempfile::TempDir;

use super::log::{self, Log};
use crate::error::Error;

/// How often copying begins again when the recorder wrote in between.
const ATTEMPTS: usize = 5;

/// The file to read: the recording's own or a joined copy.
pub(super) struct Source {
    pub(super) path: PathBuf,
    /// Removed with it.
    _copy: Option<TempDir>,
    /// What of the log could not be used.
    pub(super) damage: Option<Error>,
}

/// Finds out from where `path` is to be read.
pub(super) fn source(path: &Path) -> Result<Source, Error> {
    let as_it_is = |damage| Source { path: path.to_owned(), _copy: None, damage };
    let log = beside(path, "-wal");
    // Shorter ones hold nothing.
    if size(&log) > log::HEAD {
        return match joined(path, &log)? {
            Ok((copy, joined, loss)) => {
                let damage = loss.map(|loss| Error::damaged(&log, 0, loss));
                Ok(Source { path: joined, _copy: Some(copy), damage })
            }
            Err(reason) => Ok(as_it_is(Some(Error::damaged(&log, 0, reason)))),
        };
    }
    let journal = beside(path, "-journal");
    if is_hot(&journal) {
        let reason =
            "the recorder was stopped while it wrote to the database; its last messages may be incomplete";
        return Ok(as_it_is(Some(Error::damaged(&journal, 0, reason))));
    }
    Ok(as_it_is(None))
}

fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = OsString::from(path);
    name.push(ending);
    PathBuf::from(name)
}

fn size(path: &Path) -> u64 {
    path.metadata().map_or(0, |metadata| if metadata.is_file() { metadata.len() } else { 0 })
}

/// Whether a rollback journal has something to roll back. It is never done: a journal may name other files to delete.
fn is_hot(journal: &Path) -> bool {
    let mut magic = [0; 8];
    size(journal) > 0
        && File::open(journal).and_then(|mut file| file.read_exact(&mut magic)).is_ok()
        && magic != [0; 8]
}

/// A joined copy, and what of the log is not in it.
type Joined = (TempDir, PathBuf, Option<String>);

/// Copies database and log and writes the log into the copy. The inner error says why the log is of no use.
fn joined(path: &Path, log: &Path) -> Result<Result<Joined, String>, Error> {
    let directory = TempDir::new().map_err(Error::io(&std::env::temp_dir(), "make a directory in"))?;
    let copy = directory.path().join("copy.db3");
    let log_copy = beside(&copy, "-wal");
    for _ in 0..ATTEMPTS {
        let before = state(path, log)?;
        std::fs::copy(path, &copy).map_err(Error::io(path, "copy to the temporary directory"))?;
        std::fs::copy(log, &log_copy).map_err(Error::io(log, "copy to the temporary directory"))?;
        // A log that only grew is whole up to some transaction; a database that changed belongs to another log.
        if state(path, log)? == before {
            return Ok(match join(&copy, &log_copy).map_err(Error::io(log, "read"))? {
                Ok(loss) => Ok((directory, copy, loss)),
                Err(reason) => Err(reason),
            });
        }
    }
    Ok(Err(
        "the recorder writes faster than it can be copied; read the recording when it is closed".to_owned()
    ))
}

/// Writes a log into its database. What of it is not used comes back; the inner error says why nothing is.
fn join(copy: &Path, log_path: &Path) -> std::io::Result<Result<Option<String>, String>> {
    let log = Log::read(log_path, copy)?;
    let len = size(log_path);
    let loss = log.loss(len);
    if !log.has_pages() {
        return Ok(loss.map_or(Ok(None), Err));
    }
    // A log can claim pages far behind its end, which would make a file of terabytes.
    if log.size_after() > size(copy) + len {
        return Ok(Err("the log speaks of pages that are neither in it nor in the database".to_owned()));
    }
    if !log.is_whole() {
        log.write_into(log_path, copy)?;
        return Ok(Ok(loss));
    }
    let written = write_log_into(copy);
    Ok(written.map(|()| loss).map_err(|error| format!("the log cannot be joined with the database: {error}")))
}

/// What changes when the log is written into the database.
fn state(path: &Path, log: &Path) -> Result<(u64, Option<SystemTime>, Vec<u8>), Error> {
    let metadata = path.metadata().map_err(Error::io(path, "read"))?;
    let mut head = Vec::new();
    let file = File::open(log).map_err(Error::io(log, "open"))?;
    file.take(log::HEAD).read_to_end(&mut head).map_err(Error::io(log, "read"))?;
    Ok((metadata.len(), metadata.modified().ok(), head))
}

fn write_log_into(copy: &Path) -> rusqlite::Result<()> {
    let connection = Connection::open_with_flags(copy, OpenFlags::SQLITE_OPEN_READ_WRITE)?;
    let is_busy: i64 = connection.query_row("PRAGMA wal_checkpoint(TRUNCATE)", [], |row| row.get(0))?;
    // Also clears the mark in the head of the file that says there is a log.
    connection.query_row("PRAGMA journal_mode = DELETE", [], |_| Ok(()))?;
    if is_busy == 0 { Ok(()) } else { Err(rusqlite::Error::InvalidQuery) }
}
