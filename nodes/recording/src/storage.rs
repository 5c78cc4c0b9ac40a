//! A file of a recording, whatever its storage and whether compressed as a whole or not.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use tempfile::TempPath;

use crate::block::{Block, FileIndex, Loaded};
use crate::chunk;
use crate::compression::{self, Allowance};
use crate::error::Error;
use crate::file::McapFile;
use crate::index;
#[cfg(feature = "sqlite")]
use crate::sqlite::SqliteFile;

/// Ending of files that rosbag2 compressed as a whole.
pub(crate) const COMPRESSED: &str = "zstd";
/// Endings of the storages.
pub(crate) const MCAP: &str = "mcap";
pub(crate) const SQLITE: &str = "db3";

/// First bytes of a database, whatever its name.
const SQLITE_MAGIC: &[u8] = b"SQLite format 3\0";

/// An open file of a recording.
pub(crate) struct RecordedFile {
    path: PathBuf,
    storage: Storage,
    /// The decompressed content, removed with this value.
    _decompressed: Option<TempPath>,
}

enum Storage {
    Mcap {
        file: McapFile,
        /// Numbers of the channels that have a topic, ascending.
        channels: Vec<u32>,
        /// Bytes that compressed messages of a block may have, see [`crate::compression::most_in_block`].
        share: u64,
    },
    #[cfg(feature = "sqlite")]
    Sqlite(Box<SqliteFile>),
}

impl RecordedFile {
    /// Opens a file and finds what is in it.
    pub(crate) fn open(path: &Path, allowance: &mut Allowance) -> Result<(Self, FileIndex), Error> {
        let metadata = std::fs::metadata(path).map_err(Error::io(path, "open"))?;
        // Opening a pipe waits for whoever writes into it, and a device never ends.
        if !metadata.is_file() {
            let reason = "it is no regular file".to_owned();
            return Err(Error::NotARecording { path: path.to_owned(), reason });
        }
        let stored = metadata.len();
        let (decompressed, damage) = match path.extension() {
            Some(extension) if extension == COMPRESSED => {
                let (file, damage) = compression::whole_file(path, &mut allowance.whole_files)?;
                (Some(file), damage)
            }
            _ => (None, None),
        };
        let readable = decompressed.as_deref().unwrap_or(path);
        let name = if decompressed.is_some() { path.with_extension("") } else { path.to_owned() };
        let is_database = name.extension().is_some_and(|extension| extension == SQLITE)
            || begins_with(readable, SQLITE_MAGIC).map_err(Error::io(path, "open"))?;
        let may_decompress = allowance.parts.of(stored);
        let (storage, mut index) = if is_database {
            open_database(readable, path, may_decompress)?
        } else {
            let file = McapFile::open(readable, path)?;
            let index = index::of(&file, may_decompress)?;
            let channels = index.topics.keys().copied().collect();
            let share = allowance.share_of_block(index.blocks.len());
            (Storage::Mcap { file, channels, share }, index)
        };
        allowance.parts.pay(stored, index.decompressed_bytes);
        index.damage.extend(damage);
        Ok((Self { path: path.to_owned(), storage, _decompressed: decompressed }, index))
    }

    /// Loads a block of this file.
    pub(crate) fn load(&self, block: &Block) -> Result<Loaded, Error> {
        match &self.storage {
            Storage::Mcap { file, channels, share } => {
                chunk::load(file, block, *share, |channel| channels.binary_search(&channel).is_ok())
            }
            #[cfg(feature = "sqlite")]
            Storage::Sqlite(file) => Ok(file.load(block)),
        }
    }
}

impl std::fmt::Debug for RecordedFile {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("RecordedFile").field("path", &self.path).finish_non_exhaustive()
    }
}

/// Opens the database at `readable`; `path` is its name in what is said about it. Its messages may take `may_decompress`
/// bytes altogether.
#[cfg(feature = "sqlite")]
fn open_database(readable: &Path, path: &Path, may_decompress: u64) -> Result<(Storage, FileIndex), Error> {
    let (file, index) = SqliteFile::open(readable, path, may_decompress)?;
    Ok((Storage::Sqlite(Box::new(file)), index))
}

/// Says that databases were left out when this program was built.
#[cfg(not(feature = "sqlite"))]
fn open_database(_: &Path, path: &Path, _: u64) -> Result<(Storage, FileIndex), Error> {
    let what = "SQLite storage (this program was built without the feature `sqlite`)".to_owned();
    Err(Error::Unsupported { path: path.to_owned(), what })
}

fn begins_with(path: &Path, magic: &[u8]) -> std::io::Result<bool> {
    let mut bytes = Vec::new();
    File::open(path)?.take(magic.len() as u64).read_to_end(&mut bytes)?;
    Ok(bytes == magic)
}
