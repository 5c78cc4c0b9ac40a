//! Writes recordings as rosbag2 does: uncompressed MCAP in chunks, `metadata.yaml` of version 9 or 5.

mod room;

use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use mcap::records::MessageHeader;
use mcap::write::NoSeek;

use crate::error::Error;
use crate::metadata::{self, Metadata};
use crate::qos;
use crate::reader::MessageRef;
use crate::topic::Topic;
use room::{Room, entry};

/// A chunk goes to the file when it is this large (the encoder sees to that) ...
const CHUNK_BYTES: u64 = 1 << 20;
/// ... or its messages span this long: what a killed recorder loses.
const CHUNK_SPAN_NS: u64 = 500_000_000;

/// A recording being written.
///
/// Chunks are handed to the system whole, at least each half second of log time, so that a killed recorder leaves a file
/// that reads up to its last chunk. A power cut may lose what the system had not written yet.
pub struct Writer {
    mcap: mcap::Writer<NoSeek<BufWriter<File>>>,
    directory: PathBuf,
    file_path: PathBuf,
    file_name: String,
    ros_distro: String,
    metadata_version: u32,
    topics: Vec<Channel>,
    /// For more topics in `metadata.yaml`.
    room: Room,
    /// First and last log time, ns.
    bounds_ns: Option<(u64, u64)>,
    /// Log time of the first message since the last flush.
    unflushed_since_ns: Option<u64>,
}

/// How a recording is written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WriterOptions {
    /// Noted in the metadata; empty: not known.
    pub ros_distro: String,
    /// Version of `metadata.yaml`: 9 (ROS 2 Jazzy) or 5 (Humble, which reads nothing newer).
    pub metadata_version: u32,
}

impl Default for WriterOptions {
    fn default() -> Self {
        Self { ros_distro: String::new(), metadata_version: metadata::NEWEST }
    }
}

/// A topic of a [`Writer`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TopicId(usize);

struct Channel {
    id: u16,
    topic: Topic,
    message_count: u64,
}

/// What a finished recording contains.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Written {
    /// The directory.
    pub directory: PathBuf,
    /// Messages of each topic, in the order in which the topics were added.
    pub message_counts: Vec<(String, u64)>,
}

impl Writer {
    /// Begins a recording in `directory`, which must not exist; directories above it are made. `ros_distro` is noted in the
    /// metadata (empty: not known).
    ///
    /// # Errors
    /// When the directory exists or cannot be made.
    pub fn create(directory: impl AsRef<Path>, ros_distro: &str) -> Result<Self, Error> {
        let options = WriterOptions { ros_distro: ros_distro.to_owned(), ..WriterOptions::default() };
        Self::create_with(directory, options)
    }

    /// The same with all options.
    ///
    /// # Errors
    /// When the directory exists or cannot be made, or an option has another value than those that are accepted.
    pub fn create_with(directory: impl AsRef<Path>, options: WriterOptions) -> Result<Self, Error> {
        let WriterOptions { ros_distro, metadata_version } = options;
        let directory = directory.as_ref();
        if ![metadata::NEWEST, metadata::HUMBLE].contains(&metadata_version) {
            let reason = format!("version {metadata_version} is not written, accepted: 9, 5");
            return Err(Error::Metadata { path: directory.join(metadata::FILE_NAME), reason });
        }
        let name = directory.file_name().ok_or_else(|| Error::NotARecording {
            path: directory.to_owned(),
            reason: "the path has no name at its end".to_owned(),
        })?;
        if let Some(parent) = directory.parent() {
            std::fs::create_dir_all(parent).map_err(Error::io(parent, "make"))?;
        }
        std::fs::create_dir(directory).map_err(|error| match error.kind() {
            std::io::ErrorKind::AlreadyExists => Error::Exists { path: directory.to_owned() },
            _ => Error::io(directory, "make")(error),
        })?;
        let file_name = format!("{}_0.mcap", name.to_string_lossy());
        let file_path = directory.join(&file_name);
        let file = File::create_new(&file_path).map_err(Error::io(&file_path, "make"))?;
        let options = mcap::WriteOptions::new()
            .profile("ros2")
            .library(concat!("rhombus_haptics ", env!("CARGO_PKG_VERSION")))
            .chunk_size(Some(CHUNK_BYTES))
            // What mcap compresses with by default depends on how it was built.
            .compression(None)
            // A chunk is built in memory and written in one go: a cut can only fall between chunks or into the last one.
            .disable_seeking(true);
        let empty = Metadata::of_one_file(&file_name, None, Vec::new(), &ros_distro, metadata_version);
        let room = Room::of(&empty)?;
        let mcap = options.create(NoSeek::new(BufWriter::new(file))).map_err(Error::write(&file_path))?;
        let mut writer = Self {
            mcap,
            directory: directory.to_owned(),
            file_path,
            file_name,
            ros_distro,
            metadata_version,
            topics: Vec::new(),
            room,
            bounds_ns: None,
            unflushed_since_ns: None,
        };
        writer.flush()?;
        empty.save(&writer.directory)?;
        Ok(writer)
    }

    /// The directory of the recording.
    pub fn directory(&self) -> &Path {
        &self.directory
    }

    /// Adds a topic. Topics can be added at any time. Two may have the same name with different types, definitions
    /// or encodings.
    ///
    /// # Errors
    /// When the topic is there already, there are more than `metadata.yaml` can have (thousands), or the file cannot be written.
    pub fn add_topic(&mut self, topic: Topic) -> Result<TopicId, Error> {
        let is_same = |known: &Topic| {
            known.name == topic.name
                && known.type_name == topic.type_name
                && known.serialization_format == topic.serialization_format
                && known.definition == topic.definition
        };
        if self.topics.iter().any(|known| is_same(&known.topic)) {
            return Err(Error::TopicTwice { topic: topic.name });
        }
        if !self.room.take(&topic)? {
            return Err(Error::TooManyTopics { path: self.directory.clone(), accepted: self.topics.len() });
        }
        let definition = &topic.definition;
        let failed = Error::write(&self.file_path);
        let to_yaml =
            if self.metadata_version >= metadata::NEWEST { qos::to_yaml } else { qos::to_yaml_of_numbers };
        let qos_text = to_yaml(&topic.offered_qos)
            .map_err(|error| Error::Metadata { path: self.file_path.clone(), reason: error.to_string() })?;
        let metadata = BTreeMap::from([
            ("offered_qos_profiles".to_owned(), qos_text),
            ("topic_type_hash".to_owned(), definition.type_hash.clone()),
        ]);
        let id = self
            .mcap
            .add_schema(&topic.type_name, &definition.encoding, definition.text.as_bytes())
            .and_then(|schema| {
                self.mcap.add_channel(schema, &topic.name, &topic.serialization_format, &metadata)
            })
            .map_err(failed)?;
        self.topics.push(Channel { id, topic, message_count: 0 });
        Ok(TopicId(self.topics.len() - 1))
    }

    /// Appends a message of `topic`: its bytes as they were on the wire, received at `log_time_ns` since 1970.
    ///
    /// # Errors
    /// When the file cannot be written; nothing more can then be recorded.
    pub fn write(&mut self, topic: TopicId, log_time_ns: u64, data: &[u8]) -> Result<(), Error> {
        let written = self.topics.get(topic.0).map_or(0, |channel| channel.message_count);
        // The sequence is 32 bits and starts again after that.
        self.put(topic, (written + 1) as u32, log_time_ns, log_time_ns, data)
    }

    /// Appends a message of another recording as a message of `topic`, with its sequence and times.
    ///
    /// # Errors
    /// When the file cannot be written; nothing more can then be recorded.
    pub fn copy(&mut self, topic: TopicId, message: &MessageRef<'_>) -> Result<(), Error> {
        let MessageRef { sequence, log_time_ns, publish_time_ns, data, .. } = *message;
        self.put(topic, sequence, log_time_ns, publish_time_ns, data)
    }

    fn put(
        &mut self,
        topic: TopicId,
        sequence: u32,
        log_time_ns: u64,
        publish_time_ns: u64,
        data: &[u8],
    ) -> Result<(), Error> {
        if self.unflushed_since_ns.is_some_and(|first_ns| log_time_ns.abs_diff(first_ns) >= CHUNK_SPAN_NS) {
            self.flush()?;
        }
        // A `TopicId` comes from `add_topic` alone, so that only one of another writer could miss.
        let Some(channel) = self.topics.get_mut(topic.0) else {
            let unknown = mcap::McapError::UnknownChannel(0, u16::MAX);
            return Err(Error::write(&self.file_path)(unknown));
        };
        let header = MessageHeader {
            channel_id: channel.id,
            sequence,
            log_time: log_time_ns,
            publish_time: publish_time_ns,
        };
        self.mcap.write_to_known_channel(&header, data).map_err(Error::write(&self.file_path))?;
        channel.message_count += 1;
        self.unflushed_since_ns.get_or_insert(log_time_ns);
        let (start, end) = self.bounds_ns.unwrap_or((log_time_ns, log_time_ns));
        self.bounds_ns = Some((start.min(log_time_ns), end.max(log_time_ns)));
        Ok(())
    }

    /// Hands everything written so far to the system. For recorders that wait for messages: call it now and then.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn flush(&mut self) -> Result<(), Error> {
        self.unflushed_since_ns = None;
        self.mcap.flush().map_err(Error::write(&self.file_path))
    }

    /// Ends the recording: the index goes to the file, `metadata.yaml` gets its counts.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn close(mut self) -> Result<Written, Error> {
        let metadata = self.metadata();
        let serialized = metadata.to_yaml(&self.file_path)?;
        let record = mcap::records::Metadata {
            name: "rosbag2".to_owned(),
            metadata: BTreeMap::from([("serialized_metadata".to_owned(), serialized)]),
        };
        self.mcap
            .write_metadata(&record)
            .and_then(|()| self.mcap.finish())
            .map_err(Error::write(&self.file_path))?;
        let file = self.mcap.into_inner().into_inner();
        // Here the last bytes leave the buffer: a full disk must not go unnoticed.
        file.into_inner().map_err(|error| Error::io(&self.file_path, "write")(error.into_error()))?;
        metadata.save(&self.directory)?;
        let message_counts =
            self.topics.into_iter().map(|channel| (channel.topic.name, channel.message_count)).collect();
        Ok(Written { directory: self.directory, message_counts })
    }

    fn metadata(&self) -> Metadata {
        let topics =
            self.topics.iter().map(|Channel { topic, message_count, .. }| entry(topic, *message_count));
        Metadata::of_one_file(
            &self.file_name,
            self.bounds_ns,
            topics.collect(),
            &self.ros_distro,
            self.metadata_version,
        )
    }
}
