//! Reads recordings: rosbag2 directories and bare files, whole, damaged, or left behind by a killed recorder.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::block::{Entry, FileIndex, Loaded};
use crate::compression::Allowance;
use crate::directory::Directory;
use crate::error::Error;
use crate::metadata::Metadata;
use crate::order::{Found, Located, Merge, Selection};
use crate::storage::RecordedFile;
use crate::topic::RecordedTopic;
use crate::variants::Variants;

/// An opened recording. Opening reads heads and summaries; messages are read when they are asked for.
#[derive(Debug)]
pub struct Recording {
    path: PathBuf,
    topics: Vec<RecordedTopic>,
    files: Vec<RecordedFile>,
    /// For each file, which topic a channel belongs to.
    topic_of_channel: Vec<BTreeMap<u32, usize>>,
    blocks: Vec<Located>,
    damage: Vec<Error>,
    disagreements: Vec<String>,
    /// Files whose recorder did not say how many messages they have.
    uncounted: usize,
    /// Of a directory; see [`Directory`].
    has_unlisted_parts: bool,
    has_missing_parts: bool,
}

/// A recorded message.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Message {
    /// Index into [`Recording::topics`].
    pub topic: usize,
    /// When the recorder received it, ns since 1970.
    pub log_time_ns: u64,
    /// When it was published, as far as the recorder knew, ns since 1970.
    pub publish_time_ns: u64,
    /// Counts the messages of a topic, where the recorder did; 0 otherwise.
    pub sequence: u32,
    /// The message as it was on the wire: CDR with its header.
    pub data: Vec<u8>,
}

/// A recorded message, still where it was read into memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MessageRef<'a> {
    /// Index into [`Recording::topics`].
    pub topic: usize,
    /// When the recorder received it, ns since 1970.
    pub log_time_ns: u64,
    /// When it was published, as far as the recorder knew, ns since 1970.
    pub publish_time_ns: u64,
    /// Counts the messages of a topic, where the recorder did; 0 otherwise.
    pub sequence: u32,
    /// The message as it was on the wire: CDR with its header.
    pub data: &'a [u8],
}

impl Recording {
    /// Opens a rosbag2 directory, or one file of one: `.mcap` or `.db3`, or these compressed as a whole (`.mcap.zstd`), which
    /// are decompressed to the directory for temporary files as long as the recording is open.
    ///
    /// Where `metadata.yaml` and the files disagree, the files are right; see [`Recording::metadata_disagreements`].
    ///
    /// # Errors
    /// When nothing can be read from it, or it is a directory of several recordings without metadata. A recording that is cut or partly broken opens; [`Recording::damage`] says what is
    /// missing.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let directory = Directory::of(path)?;
        let mut recording = Self {
            path: path.to_owned(),
            topics: Vec::new(),
            files: Vec::new(),
            topic_of_channel: Vec::new(),
            blocks: Vec::new(),
            damage: Vec::new(),
            disagreements: directory.disagreements,
            uncounted: 0,
            has_unlisted_parts: directory.has_unlisted_parts,
            has_missing_parts: directory.has_missing_parts,
        };
        let mut variants = Variants::default();
        let mut allowance = Allowance::new(directory.files.len());
        for file_path in directory.files {
            match RecordedFile::open(&file_path, &mut allowance) {
                Ok((file, index)) => recording.add(&mut variants, file, index),
                Err(error) => recording.damage.push(error),
            }
        }
        if recording.files.is_empty() && !recording.damage.is_empty() {
            return Err(recording.damage.swap_remove(0));
        }
        if let Some(metadata) = directory.metadata {
            recording.complete_from(&metadata);
            recording.disagreements.extend(metadata.disagreements(&recording));
        }
        Ok(recording)
    }

    /// What was opened.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The topics, in the order in which they came into the recording. One that was recorded with several types,
    /// definitions or encodings is there several times: what is true of one is not true of the others.
    pub fn topics(&self) -> &[RecordedTopic] {
        &self.topics
    }

    /// Whether a bare file says itself how many messages it has; of a directory a whole file may be missing.
    pub(crate) fn is_counted(&self) -> bool {
        self.uncounted == 0 && self.path.is_file()
    }

    /// Whether `metadata.yaml` is older than the last parts and does not count what is in them.
    pub(crate) fn has_unlisted_parts(&self) -> bool {
        self.has_unlisted_parts
    }

    /// Whether the numbers of the parts have holes, so that nobody knows how many messages there were.
    pub(crate) fn has_missing_parts(&self) -> bool {
        self.has_missing_parts
    }

    /// What was found broken on opening and is left out of everything else. Empty for a whole recording.
    pub fn damage(&self) -> &[Error] {
        &self.damage
    }

    /// What `metadata.yaml` says other than the files, and holes in the numbers of parts that it does not name, a sentence
    /// each.
    pub fn metadata_disagreements(&self) -> &[String] {
        &self.disagreements
    }

    /// First and last log time in ns since 1970; `None` without messages.
    pub fn log_time_bounds_ns(&self) -> Option<(u64, u64)> {
        let start = self.blocks.iter().map(|located| located.block.start_ns).min()?;
        let end = self.blocks.iter().map(|located| located.block.end_ns).max()?;
        Some((start, end))
    }

    /// All messages by log time; equal times in the order in which they were stored.
    ///
    /// An item is an error where stored messages cannot be read; the iterator then goes on behind them.
    pub fn messages(&self) -> Messages<'_> {
        let all: Vec<usize> = (0..self.topics.len()).collect();
        self.messages_of(&all)
    }

    /// As [`Recording::messages`], of these topics (numbers in [`Recording::topics`]) alone. What has no message of them is
    /// not read where the file says so.
    pub fn messages_of(&self, topics: &[usize]) -> Messages<'_> {
        Messages { merge: self.merge(topics, 0, u64::MAX) }
    }

    /// All messages in the order in which they were stored, whatever their times: each part of the recording is read once
    /// and one is in memory at a time, however the times lie.
    pub fn stored_messages(&self) -> StoredMessages<'_> {
        StoredMessages {
            recording: self,
            blocks: 0,
            loaded: Loaded::default(),
            cursor: 0,
            file: 0,
            damage: Vec::new(),
        }
    }

    /// The messages of some topics in a span of log times.
    pub(crate) fn merge(&self, topics: &[usize], from_ns: u64, to_ns: u64) -> Merge<'_> {
        let mut wanted = vec![false; self.topics.len()];
        for topic in topics {
            if let Some(wanted) = wanted.get_mut(*topic) {
                *wanted = true;
            }
        }
        let selection = Selection { topics: wanted, from_ns, to_ns };
        Merge::new(&self.files, &self.blocks, &self.topic_of_channel, selection)
    }

    /// Whether all of a block was logged before a time.
    pub(crate) fn ends_before(&self, block: usize, time_ns: u64) -> bool {
        self.blocks.get(block).is_some_and(|located| located.block.end_ns < time_ns)
    }

    fn add(&mut self, variants: &mut Variants, file: RecordedFile, index: FileIndex) {
        let mut topic_of_channel = BTreeMap::new();
        for (channel, topic) in index.topics {
            topic_of_channel.insert(channel, variants.add(&mut self.topics, topic));
        }
        let number = self.files.len();
        self.blocks.extend(index.blocks.into_iter().map(|block| Located { file: number, block }));
        self.damage.extend(index.damage);
        self.uncounted += usize::from(!index.is_counted);
        self.topic_of_channel.push(topic_of_channel);
        self.files.push(file);
    }

    /// Some writers give hash and QoS in `metadata.yaml` alone.
    fn complete_from(&mut self, metadata: &Metadata) {
        let mut by_topic: BTreeMap<_, Vec<_>> = BTreeMap::new();
        for entry in metadata.topics_with_message_count.iter().map(|entry| &entry.topic_metadata) {
            by_topic.entry((&entry.name, &entry.type_name)).or_default().push(entry);
        }
        for RecordedTopic { topic, .. } in &mut self.topics {
            for entry in by_topic.get(&(&topic.name, &topic.type_name)).into_iter().flatten() {
                if topic.definition.type_hash.is_empty() {
                    topic.definition.type_hash.clone_from(&entry.type_description_hash);
                }
                if topic.offered_qos.is_empty() {
                    topic.offered_qos.clone_from(&entry.offered_qos_profiles);
                }
            }
        }
    }
}

impl<'a> MessageRef<'a> {
    pub(crate) fn of(found: &Found<'a>) -> Self {
        Self::new(found.entry.channel as usize, found.entry, found.data)
    }

    fn new(topic: usize, entry: &Entry, data: &'a [u8]) -> Self {
        Self {
            topic,
            log_time_ns: entry.log_time_ns,
            publish_time_ns: entry.publish_time_ns,
            sequence: entry.sequence,
            data,
        }
    }

    /// With its own copy of the data.
    pub fn to_message(self) -> Message {
        Message {
            topic: self.topic,
            log_time_ns: self.log_time_ns,
            publish_time_ns: self.publish_time_ns,
            sequence: self.sequence,
            data: self.data.to_vec(),
        }
    }
}

/// The messages of a recording; see [`Recording::messages`].
pub struct Messages<'a> {
    merge: Merge<'a>,
}

impl Messages<'_> {
    /// The next message, still in its place: for whoever only looks at it.
    pub fn next_ref(&mut self) -> Option<Result<MessageRef<'_>, Error>> {
        match self.merge.peek()? {
            Ok(_) => self.merge.take().map(|found| Ok(MessageRef::of(&found))),
            Err((_, error)) => Some(Err(error)),
        }
    }
}

impl Iterator for Messages<'_> {
    type Item = Result<Message, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        Some(self.next_ref()?.map(MessageRef::to_message))
    }
}

/// The messages of a recording as they lie there; see [`Recording::stored_messages`].
pub struct StoredMessages<'a> {
    recording: &'a Recording,
    /// How many blocks were loaded.
    blocks: usize,
    loaded: Loaded,
    cursor: usize,
    file: usize,
    damage: Vec<Error>,
}

impl StoredMessages<'_> {
    /// The next message, still in its place: for whoever only looks at it.
    pub fn next_ref(&mut self) -> Option<Result<MessageRef<'_>, Error>> {
        loop {
            if let Some(error) = self.damage.pop() {
                return Some(Err(error));
            }
            let topics = self.recording.topic_of_channel.get(self.file);
            let channel = self.loaded.entries.get(self.cursor).map(|entry| entry.channel);
            match channel.map(|channel| topics.and_then(|topics| topics.get(&channel))) {
                Some(Some(topic)) => {
                    let entry = self.loaded.entries.get(self.cursor)?;
                    self.cursor += 1;
                    return Some(Ok(MessageRef::new(*topic, entry, self.loaded.data(entry))));
                }
                // Files leave out what they have no topic for.
                Some(None) => self.cursor += 1,
                None => self.load_next()?,
            }
        }
    }

    fn load_next(&mut self) -> Option<()> {
        let located = self.recording.blocks.get(self.blocks)?;
        self.blocks += 1;
        self.cursor = 0;
        self.file = located.file;
        // Not two at a time.
        self.loaded = Loaded::default();
        match self.recording.files.get(located.file)?.load(&located.block) {
            Ok(loaded) => self.loaded = loaded,
            Err(error) => self.damage.push(error),
        }
        self.loaded.entries.sort_by_key(|entry| entry.data.start);
        self.damage.append(&mut self.loaded.damage);
        self.damage.reverse();
        Some(())
    }
}

impl Iterator for StoredMessages<'_> {
    type Item = Result<Message, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        Some(self.next_ref()?.map(MessageRef::to_message))
    }
}
