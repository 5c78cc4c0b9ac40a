//! What lies beside a database: the log of a recorder that still runs, or that was stopped before it tidied up.
//!
//! With a write-ahead log (`NAME.db3-wal`) part of the recording is in the log alone. Reading it in place would make
//! files in the recording's directory, so that database and log are copied to a temporary directory and joined there.

use std::ffi::OsString;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use rusqlite::{Connection, OpenFlags};
use tempfile::TempDir;

use crate::error::Error;

/// Head of a write-ahead log; shorter ones hold nothing.
const LOG_HEAD: usize = 32;
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
    if size(&log) > LOG_HEAD as u64 {
        return match joined(path, &log)? {
            Ok((copy, joined)) => Ok(Source { path: joined, _copy: Some(copy), damage: None }),
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

/// Copies database and log and writes the log into the copy. The inner error says why the log is of no use.
fn joined(path: &Path, log: &Path) -> Result<Result<(TempDir, PathBuf), String>, Error> {
    let directory = TempDir::new().map_err(Error::io(&std::env::temp_dir(), "make a directory in"))?;
    let copy = directory.path().join("copy.db3");
    for _ in 0..ATTEMPTS {
        let before = state(path, log)?;
        std::fs::copy(path, &copy).map_err(Error::io(path, "copy to the temporary directory"))?;
        std::fs::copy(log, beside(&copy, "-wal"))
            .map_err(Error::io(log, "copy to the temporary directory"))?;
        // A log that only grew is whole up to some transaction; a database that changed belongs to another log.
        if state(path, log)? == before {
            // A log can claim pages far behind its end, which would make a file of terabytes.
            let most = size(path) + size(log);
            return Ok(match write_log_into(&copy) {
                Ok(()) if size(&copy) <= most => Ok((directory, copy)),
                Ok(()) => {
                    Err("the log speaks of pages that are neither in it nor in the database".to_owned())
                }
                Err(error) => Err(format!("the log cannot be joined with the database: {error}")),
            });
        }
    }
    Ok(Err(
        "the recorder writes faster than it can be copied; read the recording when it is closed".to_owned()
    ))
}

/// What changes when the log is written into the database.
fn state(path: &Path, log: &Path) -> Result<(u64, Option<SystemTime>, Vec<u8>), Error> {
    let metadata = path.metadata().map_err(Error::io(path, "read"))?;
    let mut head = Vec::new();
    let file = File::open(log).map_err(Error::io(log, "open"))?;
    file.take(LOG_HEAD as u64).read_to_end(&mut head).map_err(Error::io(log, "read"))?;
    Ok((metadata.len(), metadata.modified().ok(), head))
}

fn write_log_into(copy: &Path) -> rusqlite::Result<()> {
    let connection = Connection::open_with_flags(copy, OpenFlags::SQLITE_OPEN_READ_WRITE)?;
    let is_busy: i64 = connection.query_row("PRAGMA wal_checkpoint(TRUNCATE)", [], |row| row.get(0))?;
    // Also clears the mark in the head of the file that says there is a log.
    connection.query_row("PRAGMA journal_mode = DELETE", [], |_| Ok(()))?;
    if is_busy == 0 { Ok(()) } else { Err(rusqlite::Error::InvalidQuery) }
}
