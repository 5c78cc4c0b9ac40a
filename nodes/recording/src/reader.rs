//! Reads recordings: rosbag2 directories of MCAP files, whole or left behind by a killed recorder, and bare MCAP files.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::MessageDefinition;
use crate::error::Error;
use crate::file::McapFile;
use crate::index::FileIndex;
use crate::metadata::Metadata;
use crate::order::{Located, Merge};
use crate::qos;
use crate::topic::{RecordedTopic, Topic};

/// An opened recording. Opening reads heads and summaries; messages are read when they are asked for.
#[derive(Debug)]
pub struct Recording {
    path: PathBuf,
    topics: Vec<RecordedTopic>,
    files: Vec<McapFile>,
    /// For each file, which topic a channel belongs to.
    topic_of_channel: Vec<BTreeMap<u16, usize>>,
    blocks: Vec<Located>,
    damage: Vec<Error>,
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

impl Recording {
    /// Opens a rosbag2 directory or a bare `.mcap` file.
    ///
    /// Where `metadata.yaml` and the files disagree, the files are right; without it all `.mcap` files of the directory are
    /// taken.
    ///
    /// # Errors
    /// When nothing can be read from it: no recording, SQLite storage, a compressed file. A file that is cut or partly
    /// broken opens; [`Recording::damage`] says what is missing.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let (file_paths, metadata) = files_of(path)?;
        let mut recording = Self {
            path: path.to_owned(),
            topics: Vec::new(),
            files: Vec::new(),
            topic_of_channel: Vec::new(),
            blocks: Vec::new(),
            damage: Vec::new(),
        };
        for file_path in file_paths {
            let file = McapFile::open(&file_path)?;
            let index = FileIndex::of(&file)?;
            recording.add(file, index);
        }
        if let Some(metadata) = metadata {
            recording.complete_from(&metadata);
        }
        Ok(recording)
    }

    /// What was opened.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The topics, in the order in which they came into the recording.
    pub fn topics(&self) -> &[RecordedTopic] {
        &self.topics
    }

    /// What was found broken on opening and is left out of everything else. Empty for a whole recording.
    pub fn damage(&self) -> &[Error] {
        &self.damage
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
        Messages { recording: self, merge: Merge::new(&self.files, &self.blocks) }
    }

    fn add(&mut self, file: McapFile, index: FileIndex) {
        let mut topic_of_channel = BTreeMap::new();
        for (id, channel) in &index.channels {
            let schema = index.schemas.get(&channel.schema_id);
            let text_of = |key: &str| channel.metadata.get(key).cloned().unwrap_or_default();
            let topic = Topic {
                name: channel.topic.clone(),
                type_name: schema.map(|schema| schema.name.clone()).unwrap_or_default(),
                serialization_format: channel.message_encoding.clone(),
                // A QoS nobody can read is one that is not known.
                offered_qos: qos::from_yaml(&text_of("offered_qos_profiles")).unwrap_or_default(),
                definition: MessageDefinition {
                    encoding: schema.map(|schema| schema.encoding.clone()).unwrap_or_default(),
                    text: schema.map(|schema| schema.text.clone()).unwrap_or_default(),
                    type_hash: text_of("topic_type_hash"),
                },
            };
            let message_count = index.counts.get(id).copied().unwrap_or(0);
            topic_of_channel.insert(*id, self.add_topic(topic, message_count));
        }
        let number = self.files.len();
        self.blocks.extend(index.blocks.into_iter().map(|block| Located { file: number, block }));
        self.damage.extend(index.damage);
        self.topic_of_channel.push(topic_of_channel);
        self.files.push(file);
    }

    /// The place of a topic: channels of the same name and type, in any of the files, are one topic.
    fn add_topic(&mut self, topic: Topic, message_count: u64) -> usize {
        let same = |known: &RecordedTopic| {
            known.topic.name == topic.name && known.topic.type_name == topic.type_name
        };
        match self.topics.iter().position(same) {
            Some(place) => {
                if let Some(known) = self.topics.get_mut(place) {
                    known.message_count += message_count;
                }
                place
            }
            None => {
                self.topics.push(RecordedTopic { topic, message_count });
                self.topics.len() - 1
            }
        }
    }

    /// Some writers give hash and QoS in `metadata.yaml` alone.
    fn complete_from(&mut self, metadata: &Metadata) {
        for RecordedTopic { topic, .. } in &mut self.topics {
            let same = metadata.topics_with_message_count.iter().map(|entry| &entry.topic_metadata);
            for entry in same.filter(|entry| entry.name == topic.name && entry.type_name == topic.type_name) {
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

/// The messages of a recording; see [`Recording::messages`].
pub struct Messages<'a> {
    recording: &'a Recording,
    merge: Merge<'a>,
}

impl Iterator for Messages<'_> {
    type Item = Result<Message, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        let recording = self.recording;
        let next = self.merge.next(|found| {
            let topics = recording.topic_of_channel.get(found.file);
            let topic = topics.and_then(|topics| topics.get(&found.head.channel)).copied();
            topic.ok_or((found.file, found.head.channel)).map(|topic| Message {
                topic,
                log_time_ns: found.head.log_time_ns,
                publish_time_ns: found.head.publish_time_ns,
                sequence: found.head.sequence,
                data: found.data.to_vec(),
            })
        })?;
        Some(next.and_then(|message| {
            message.map_err(|(file, channel)| {
                let path = recording.files.get(file).map_or(recording.path(), McapFile::path);
                Error::damaged(path, 0, format!("a message of channel {channel}, which is nowhere described"))
            })
        }))
    }
}

/// The files of a recording in their order, and its `metadata.yaml` if it has one.
fn files_of(path: &Path) -> Result<(Vec<PathBuf>, Option<Metadata>), Error> {
    let unsupported = |what: String| Err(Error::Unsupported { path: path.to_owned(), what });
    if !path.is_dir() {
        return match path.extension() {
            Some(extension) if extension == "db3" => unsupported("SQLite storage".to_owned()),
            _ => Ok((vec![path.to_owned()], None)),
        };
    }
    let Some(metadata) = Metadata::load(path)? else { return Ok((mcap_files_in(path)?, None)) };
    if metadata.storage_identifier != "mcap" {
        return unsupported(format!("storage {:?}", metadata.storage_identifier));
    }
    if !["", "none"].contains(&metadata.compression_mode.to_ascii_lowercase().as_str()) {
        let Metadata { compression_mode, compression_format, .. } = &metadata;
        return unsupported(format!("compression by {compression_mode} ({compression_format})"));
    }
    // Old versions wrote the directory in front of the name; and a recording has no business outside of its directory.
    let names = metadata.relative_file_paths.iter().filter_map(|name| Path::new(name).file_name());
    let files: Vec<_> = names.map(|name| path.join(name)).collect();
    if files.is_empty() {
        return Ok((mcap_files_in(path)?, Some(metadata)));
    }
    Ok((files, Some(metadata)))
}

/// The `.mcap` files of a directory in the order of their numbers.
fn mcap_files_in(directory: &Path) -> Result<Vec<PathBuf>, Error> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(directory).map_err(Error::io(directory, "read"))? {
        let file = entry.map_err(Error::io(directory, "read"))?.path();
        if file.extension().is_some_and(|extension| extension == "mcap") {
            files.push(file);
        }
    }
    if files.is_empty() {
        let reason = "the directory has neither metadata.yaml nor .mcap files".to_owned();
        return Err(Error::NotARecording { path: directory.to_owned(), reason });
    }
    // NAME_10 comes behind NAME_9: shorter names first.
    files.sort_by_key(|file| (file.as_os_str().len(), file.clone()));
    Ok(files)
}
