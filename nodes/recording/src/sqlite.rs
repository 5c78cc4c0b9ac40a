//! SQLite storage of rosbag2 (`.db3`): the default of ROS 2 up to Iron.
//!
//! A whole database is asked through SQLite, a broken one page by page: then every message is found whose page is left,
//! and what is lost is known by the row numbers that are missing. Either way the file is never changed, nothing is made
//! beside it, and opening reads the heads of the messages only.

mod beside;
mod compression;
mod database;
mod log;
mod pages;
mod query;
mod rows;
mod salvage;
mod schema;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use beside::Source;
use compression::Measure;
use database::{Database, Unfit};
use pages::PageFile;
use query::{Ids, Stop};
use rows::{Collector, Row, Topics};
use salvage::{Gap, Leaves, Span};

use crate::block::{Block, Entry, FileIndex, Loaded, MAX_BLOCK_BYTES, Place};
use crate::compression::messages;
use crate::error::Error;
use crate::topic::{RecordedTopic, Topic};

/// Places with lost messages that get a sentence each; what is lost elsewhere is said in one.
const MOST_GAPS: usize = 50;

/// An open database file.
pub(crate) struct SqliteFile {
    path: PathBuf,
    topics: Topics,
    pages: PageFile,
    storage: Storage,
    /// Holds the copy that is read, where there is one.
    _source: Source,
}

enum Storage {
    Whole { database: Mutex<Database>, root: u32, parts: Vec<Ids> },
    Broken { leaves: Leaves, parts: Vec<Span> },
}

/// What opening gives.
type Opened = (Topics, Storage, FileIndex);

/// Why SQLite did not give all messages.
enum Failure {
    /// It is a database, but none of rosbag2, or not one to be trusted.
    NotOurs(String),
    Broken(Broken),
}

/// How far SQLite came.
struct Broken {
    reason: String,
    topics: BTreeMap<i64, Topic>,
    /// First page of the messages, and the number of the first one that could not be read.
    place: Option<(u32, i64)>,
}

impl SqliteFile {
    /// Opens the database at `readable` and finds out where its messages are. `path` is its name in what is said about it.
    /// The messages may take `allowance` bytes in memory altogether.
    ///
    /// # Errors
    /// When nothing can be read from it: the system refuses, it is no database, or one without messages as rosbag2 stores
    /// them. Damage is noted in the index instead.
    pub(crate) fn open(readable: &Path, path: &Path, allowance: u64) -> Result<(Self, FileIndex), Error> {
        let not_a_recording = |reason: String| Error::NotARecording { path: path.to_owned(), reason };
        let metadata = readable.metadata().map_err(Error::io(path, "open"))?;
        if !metadata.is_file() {
            return Err(not_a_recording("it is not a file".to_owned()));
        }
        if metadata.len() == 0 {
            return Err(not_a_recording("the file is empty".to_owned()));
        }
        let mut source = beside::source(readable)?;
        let pages = PageFile::open(&source.path).map_err(Error::io(path, "open"))?;
        let opened = match whole(path, &source.path, &pages, allowance) {
            Ok(opened) => Ok(opened),
            Err(Failure::NotOurs(reason)) => Err(reason),
            Err(Failure::Broken(broken)) => salvaged(path, &pages, allowance, broken),
        };
        let (topics, storage, mut index) = opened.map_err(not_a_recording)?;
        index.damage.extend(source.damage.take());
        Ok((Self { path: path.to_owned(), topics, pages, storage, _source: source }, index))
    }

    /// Reads a block. What of it cannot be read is said in [`Loaded::damage`].
    pub(crate) fn load(&self, block: &Block) -> Loaded {
        let Place::Sqlite { part } = block.place else { return Loaded::default() };
        let mut bytes = Vec::new();
        let mut entries = Vec::new();
        let mut damage: Vec<Error> = Vec::new();
        let mut unusable = Vec::new();
        let take = |row: &Row, data: &[u8]| {
            // What is refused was said when the file was opened.
            let Ok(accepted) = self.topics.accept(row) else { return };
            let begin = bytes.len();
            match messages::append(data, &mut bytes, MAX_BLOCK_BYTES) {
                Ok(()) => entries.push(Entry {
                    log_time_ns: accepted.log_time_ns,
                    publish_time_ns: accepted.log_time_ns,
                    sequence: 0,
                    channel: accepted.channel,
                    data: place(begin)..place(bytes.len()),
                }),
                Err(reason) => unusable.push((row.id, format!("message {} {reason}", row.id))),
            }
        };
        match &self.storage {
            Storage::Whole { database, root, parts } => {
                let Some(ids) = parts.get(part).copied() else { return Loaded::default() };
                let damaged = |id, reason| {
                    let offset = self.pages.offset(self.pages.page_of(*root, id));
                    Error::damaged(&self.path, offset, reason)
                };
                let lost = |id, error: &rusqlite::Error| {
                    damage.push(damaged(id, format!("message {id} cannot be read: {error}")));
                };
                // A thread that panicked while it read leaves the database as it was.
                let database = database.lock().unwrap_or_else(PoisonError::into_inner);
                if let Err(error) = query::load(&database, ids, take, lost) {
                    let reason = format!("messages {} to {} cannot all be read: {error}", ids.0, ids.1);
                    damage.push(damaged(ids.0, reason));
                }
                damage.extend(unusable.into_iter().map(|(id, reason)| damaged(id, reason)));
            }
            Storage::Broken { leaves, parts } => {
                let Some(span) = parts.get(part).copied() else { return Loaded::default() };
                let damaged = |page, reason| Error::damaged(&self.path, self.pages.offset(page), reason);
                let lost = |id, page| {
                    let reason =
                        format!("message {id} cannot be read: the pages on which it continues are broken");
                    damage.push(damaged(page, reason));
                };
                leaves.load(&self.pages, span, take, lost);
                damage.extend(unusable.into_iter().map(|(id, reason)| damaged(leaves.page_of(id), reason)));
            }
        }
        Loaded::new(bytes, entries, damage)
    }
}

impl std::fmt::Debug for SqliteFile {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("SqliteFile").field("path", &self.path).finish_non_exhaustive()
    }
}

/// A place in the bytes of a block, which is far smaller than 4 GiB.
fn place(at: usize) -> u32 {
    u32::try_from(at).unwrap_or(u32::MAX)
}

/// Opens a database of which SQLite can read everything. `path` is the recording's, `source` the file to read.
fn whole(path: &Path, source: &Path, pages: &PageFile, allowance: u64) -> Result<Opened, Failure> {
    let broken = |error: rusqlite::Error| Broken::new(error.to_string());
    let database = Database::open(source, pages.len).map_err(broken)?;
    let schema = schema::read(&database, pages.len).map_err(broken)??;
    let with_topics = |reason: String, place| Broken { reason, topics: schema.topics.clone(), place };
    let table = database.table_with("messages", &["topic_id", "timestamp", "data"]);
    let root = table.map_err(|error| with_topics(error.to_string(), None))??.root;
    let (topics, mut index) = empty_index(&schema.topics);
    index.damage.extend(schema.damage.iter().map(|reason| Error::damaged(path, 0, reason)));
    let mut collector = Collector::new(&topics, &mut index, pages.len, allowance);
    let parts = query::scan(&database, &mut collector, &mut Measure::new(allowance))
        .map_err(|Stop { id, reason }| with_topics(reason, Some((root, id))))?;
    let refused = collector.finish();
    index.damage.extend(
        refused
            .into_iter()
            .map(|(id, reason)| Error::damaged(path, pages.offset(pages.page_of(root, id)), reason)),
    );
    Ok((topics, Storage::Whole { database: Mutex::new(database), root, parts }, index))
}

/// Opens a database that SQLite gave up. The error is why nothing can be read from it.
fn salvaged(path: &Path, pages: &PageFile, allowance: u64, broken: Broken) -> Result<Opened, String> {
    let Broken { reason, topics, place } = broken;
    let reason = pages.fault().unwrap_or(reason);
    let found = salvage::search(pages);
    let topics = if topics.is_empty() { found.topics } else { topics };
    if topics.is_empty() {
        return Err(match found.leaves.count() {
            0 => reason,
            count => format!("{reason}; what is left of it has no topics, and {count} messages"),
        });
    }
    let (topics, mut index) = empty_index(&topics);
    let broken_page = |id| place.map(|(root, _)| pages.page_of(root, id));
    let offset = place.and_then(|(_, id)| broken_page(id)).map_or(0, |page| pages.offset(page));
    index.damage.push(Error::damaged(path, offset, format!("{reason}; what other pages hold is read")));
    index.damage.extend(found.damage.iter().map(|reason| Error::damaged(path, 0, reason)));
    let mut collector = Collector::new(&topics, &mut index, pages.len, allowance);
    let (parts, gaps) = found.leaves.scan(pages, &mut collector, &mut Measure::new(allowance));
    let refused = collector.finish();
    let damaged = |page, reason| Error::damaged(path, pages.offset(page), reason);
    index.damage.extend(refused.into_iter().map(|(id, reason)| damaged(found.leaves.page_of(id), reason)));
    index.damage.extend(gaps.iter().take(MOST_GAPS).map(|gap| {
        let (Gap { ids: (first, last), page }, count) = (gap, gap.count());
        let page = broken_page(*first).unwrap_or(*page);
        damaged(page, format!("messages lost: {count}, with the ids {first} to {last}"))
    }));
    if let [first, rest @ ..] = gaps.get(MOST_GAPS..).unwrap_or_default() {
        let count = rest.iter().fold(first.count(), |count, gap| count.saturating_add(gap.count()));
        let places = rest.len() + 1;
        index.damage.push(damaged(
            first.page,
            format!("messages lost: {count} in {places} more places from here on"),
        ));
    }
    if found.repeated > 0 {
        let reason = format!("messages left out because others have their ids: {}", found.repeated);
        index.damage.push(damaged(1, reason));
    }
    Ok((topics, Storage::Broken { leaves: found.leaves, parts }, index))
}

fn empty_index(topics: &BTreeMap<i64, Topic>) -> (Topics, FileIndex) {
    let recorded = topics.values().map(|topic| RecordedTopic { topic: topic.clone(), message_count: 0 });
    let index = FileIndex { topics: (0..).zip(recorded).collect(), ..FileIndex::default() };
    (Topics::new(topics.keys().copied()), index)
}

impl Broken {
    fn new(reason: String) -> Self {
        Self { reason, topics: BTreeMap::new(), place: None }
    }
}

impl From<Broken> for Failure {
    fn from(broken: Broken) -> Self {
        Self::Broken(broken)
    }
}

impl From<Unfit> for Failure {
    fn from(unfit: Unfit) -> Self {
        match unfit {
            // A broken schema can hide a table that is there.
            Unfit::Missing(reason) => Self::Broken(Broken::new(reason)),
            Unfit::Refused(reason) => Self::NotOurs(reason),
        }
    }
}
