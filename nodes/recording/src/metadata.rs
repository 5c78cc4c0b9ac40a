//! `metadata.yaml` of a rosbag2 directory: versions 1 to 9 are read, 9 and 5 are written.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_yaml::Value;

use crate::error::Error;
use crate::qos::{self, Qos};
use crate::reader::Recording;
use crate::yaml;

/// The file's name in the directory of a recording.
pub(crate) const FILE_NAME: &str = "metadata.yaml";
/// ROS 2 Jazzy and later.
pub(crate) const NEWEST: u32 = 9;
/// ROS 2 Humble.
pub(crate) const HUMBLE: u32 = 5;
/// A file with a thousand topics has a megabyte. Reading YAML can take a hundred times its size.
pub(crate) const LARGEST_BYTES: u64 = 4_000_000;
/// What rosbag2 writes as the start of a recording without messages.
const NO_START_NS: u64 = i64::MAX as u64;

#[derive(Debug, Deserialize)]
struct Root {
    rosbag2_bagfile_information: Metadata,
}

/// The content, in the order rosbag2 writes it.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Metadata {
    pub(crate) version: u32,
    pub(crate) storage_identifier: String,
    pub(crate) duration: Nanoseconds,
    pub(crate) starting_time: SinceEpoch,
    pub(crate) message_count: u64,
    pub(crate) topics_with_message_count: Vec<TopicWithCount>,
    #[serde(default)]
    pub(crate) compression_format: String,
    #[serde(default)]
    pub(crate) compression_mode: String,
    pub(crate) relative_file_paths: Vec<String>,
    #[serde(default)]
    pub(crate) files: Vec<FileInformation>,
    /// Whatever the recorder was told; nothing here reads it.
    #[serde(default, skip_deserializing)]
    pub(crate) custom_data: (),
    #[serde(default)]
    pub(crate) ros_distro: String,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Nanoseconds {
    pub(crate) nanoseconds: u64,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct SinceEpoch {
    pub(crate) nanoseconds_since_epoch: u64,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct TopicWithCount {
    pub(crate) topic_metadata: TopicMetadata,
    pub(crate) message_count: u64,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct TopicMetadata {
    pub(crate) name: String,
    #[serde(rename = "type")]
    pub(crate) type_name: String,
    pub(crate) serialization_format: String,
    #[serde(default, deserialize_with = "qos::list_or_text")]
    pub(crate) offered_qos_profiles: Vec<Qos>,
    #[serde(default)]
    pub(crate) type_description_hash: String,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct FileInformation {
    pub(crate) path: String,
    pub(crate) starting_time: SinceEpoch,
    pub(crate) duration: Nanoseconds,
    pub(crate) message_count: u64,
}

impl Metadata {
    /// For an MCAP recording in one file. `bounds_ns` are the first and last log time, `None` without messages.
    pub(crate) fn of_one_file(
        file_name: &str,
        bounds_ns: Option<(u64, u64)>,
        topics: Vec<TopicWithCount>,
        ros_distro: &str,
        version: u32,
    ) -> Self {
        let (start, end) = bounds_ns.unwrap_or((NO_START_NS, NO_START_NS));
        let duration = Nanoseconds { nanoseconds: end.saturating_sub(start) };
        let starting_time = SinceEpoch { nanoseconds_since_epoch: start };
        let message_count = topics.iter().map(|topic| topic.message_count).sum();
        Self {
            version,
            storage_identifier: "mcap".to_owned(),
            duration: duration.clone(),
            starting_time: starting_time.clone(),
            message_count,
            topics_with_message_count: topics,
            compression_format: String::new(),
            compression_mode: String::new(),
            relative_file_paths: vec![file_name.to_owned()],
            files: vec![FileInformation {
                path: file_name.to_owned(),
                starting_time,
                duration,
                message_count,
            }],
            custom_data: (),
            ros_distro: ros_distro.to_owned(),
        }
    }

    /// The YAML without the outermost key, as the MCAP metadata record `rosbag2` carries it.
    pub(crate) fn to_yaml(&self, path: &Path) -> Result<String, Error> {
        self.to_value().and_then(|value| serde_yaml::to_string(&value)).map_err(invalid(path))
    }

    /// The keys of its version.
    fn to_value(&self) -> Result<Value, serde_yaml::Error> {
        let mut value = serde_yaml::to_value(self)?;
        if self.version >= NEWEST {
            return Ok(value);
        }
        let Some(keys) = value.as_mapping_mut() else { return Ok(value) };
        keys.remove("custom_data");
        keys.remove("ros_distro");
        let topics = keys.get_mut("topics_with_message_count").and_then(Value::as_sequence_mut);
        for (written, topic) in topics.into_iter().flatten().zip(&self.topics_with_message_count) {
            if let Some(keys) = written.get_mut("topic_metadata").and_then(Value::as_mapping_mut) {
                keys.remove("type_description_hash");
                let text = qos::to_yaml_of_numbers(&topic.topic_metadata.offered_qos_profiles)?;
                keys.insert("offered_qos_profiles".into(), text.into());
            }
        }
        Ok(value)
    }

    /// Writes the file in one step: a reader finds the old one or the new one, never a part.
    pub(crate) fn save(&self, directory: &Path) -> Result<(), Error> {
        let path = directory.join(FILE_NAME);
        let root = self.to_value().and_then(|value| {
            serde_yaml::to_string(&BTreeMap::from([("rosbag2_bagfile_information", value)]))
        });
        let text = root.map_err(invalid(&path))?;
        let unfinished = directory.join(".metadata.yaml.part");
        std::fs::write(&unfinished, text).map_err(Error::io(&unfinished, "write"))?;
        std::fs::rename(&unfinished, &path).map_err(Error::io(&path, "write"))
    }

    /// Reads `metadata.yaml` of `directory`; `None` when there is none.
    pub(crate) fn load(directory: &Path) -> Result<Option<Self>, Error> {
        let path = directory.join(FILE_NAME);
        match std::fs::metadata(&path) {
            // Opening a pipe waits for whoever writes into it, and a device never ends.
            Ok(metadata) if !metadata.is_file() => {
                return Err(Error::Metadata { path, reason: "it is no regular file".to_owned() });
            }
            Ok(_) => {}
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(Error::io(&path, "open")(error)),
        }
        let file = std::fs::File::open(&path).map_err(Error::io(&path, "open"))?;
        let mut bytes = Vec::new();
        file.take(LARGEST_BYTES + 1).read_to_end(&mut bytes).map_err(Error::io(&path, "read"))?;
        if bytes.len() as u64 > LARGEST_BYTES {
            let reason = format!("more than {LARGEST_BYTES} bytes, which no metadata has");
            return Err(Error::Metadata { path, reason });
        }
        Self::parse(&bytes, &path).map(Some)
    }

    /// The content of a `metadata.yaml` that lies at `path`.
    pub(crate) fn parse(bytes: &[u8], path: &Path) -> Result<Self, Error> {
        let text = std::str::from_utf8(bytes).map_err(invalid(path))?;
        let root: Root = yaml::from_str(text).map_err(invalid(path))?;
        let metadata = root.rosbag2_bagfile_information;
        if (1..=NEWEST).contains(&metadata.version) {
            Ok(metadata)
        } else {
            let reason = format!("version is {}, accepted: 1 to {NEWEST}", metadata.version);
            Err(Error::Metadata { path: path.to_owned(), reason })
        }
    }

    /// What this says other than the files of `recording`, a sentence each.
    pub(crate) fn disagreements(&self, recording: &Recording) -> Vec<String> {
        let mut sentences = Vec::new();
        // A topic recorded with two definitions is there twice.
        let announced = counted(self.topics_with_message_count.iter().map(|entry| {
            let TopicMetadata { name, type_name, .. } = &entry.topic_metadata;
            (name, type_name, entry.message_count)
        }));
        let found = counted(
            recording
                .topics()
                .iter()
                .map(|found| (&found.topic.name, &found.topic.type_name, found.message_count)),
        );
        for ((name, type_name), count) in &announced {
            match found.get(&(name, type_name)) {
                Some(found) if found == count => {}
                Some(found) => {
                    sentences.push(format!("metadata.yaml counts {count} messages of {name}, and there are {found}"));
                }
                None => sentences.push(format!(
                    "metadata.yaml has the topic {name} of type {type_name} with {count} messages, which is in no file"
                )),
            }
        }
        for (name, type_name) in found.keys().filter(|topic| !announced.contains_key(topic)) {
            sentences.push(format!("metadata.yaml does not have the topic {name} of type {type_name}"));
        }
        let found = found.values().fold(0, |sum: u64, count| sum.saturating_add(*count));
        if found != self.message_count {
            let announced = self.message_count;
            sentences
                .push(format!("metadata.yaml counts {announced} messages altogether, and there are {found}"));
        }
        let span = recording.log_time_bounds_ns().map(|(start, end)| (start, end - start));
        let announced = (self.starting_time.nanoseconds_since_epoch, self.duration.nanoseconds);
        if let Some(found) = span
            && found != announced
        {
            sentences.push(format!(
                "metadata.yaml has a recording of {} ns from {}, and it is one of {} ns from {}",
                announced.1, announced.0, found.1, found.0
            ));
        }
        sentences
    }
}

/// Messages by the name and type of their topic.
fn counted<'a>(
    topics: impl Iterator<Item = (&'a String, &'a String, u64)>,
) -> BTreeMap<(&'a str, &'a str), u64> {
    let mut counts = BTreeMap::new();
    for (name, type_name, count) in topics {
        let sum: &mut u64 = counts.entry((name.as_str(), type_name.as_str())).or_default();
        *sum = sum.saturating_add(count);
    }
    counts
}

fn invalid<E: std::fmt::Display>(path: &Path) -> impl FnOnce(E) -> Error {
    move |error| Error::Metadata { path: path.to_owned(), reason: error.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn version_5_is_written_with_the_keys_of_humble() {
        let metadata = Metadata::parse(HUMBLE.as_bytes(), Path::new("metadata.yaml")).unwrap();
        let directory = tempfile::tempdir().unwrap();
        metadata.save(directory.path()).unwrap();
        let text = std::fs::read_to_string(directory.path().join(FILE_NAME)).unwrap();
        let (again, before): (Value, Value) =
            (serde_yaml::from_str(&text).unwrap(), serde_yaml::from_str(HUMBLE).unwrap());
        assert_eq!(again, before, "{text}");
    }

    /// Humble: version 5, QoS as a text with numbers, no hash, no custom data, no distribution.
    const HUMBLE: &str = r#"rosbag2_bagfile_information:
  version: 5
  storage_identifier: mcap
  duration:
    nanoseconds: 9000000
  starting_time:
    nanoseconds_since_epoch: 1700000000000000000
  message_count: 10
  topics_with_message_count:
    - topic_metadata:
        name: /measured_cp
        type: geometry_msgs/msg/PoseStamped
        serialization_format: cdr
        offered_qos_profiles: "- history: 3\n  depth: 0\n  reliability: 1\n  durability: 2\n  deadline:\n    sec: 9223372036\n    nsec: 854775807\n  lifespan:\n    sec: 9223372036\n    nsec: 854775807\n  liveliness: 1\n  liveliness_lease_duration:\n    sec: 9223372036\n    nsec: 854775807\n  avoid_ros_namespace_conventions: false"
      message_count: 10
  compression_format: ""
  compression_mode: ""
  relative_file_paths:
    - session_0.mcap
  files:
    - path: session_0.mcap
      starting_time:
        nanoseconds_since_epoch: 1700000000000000000
      duration:
        nanoseconds: 9000000
      message_count: 10
"#;

    fn loaded(text: &str) -> Result<Option<Metadata>, Error> {
        let directory = tempfile::tempdir().unwrap();
        std::fs::write(directory.path().join(FILE_NAME), text).unwrap();
        Metadata::load(directory.path())
    }

    #[test]
    fn version_5_reads_with_its_qos() {
        let metadata = loaded(HUMBLE).unwrap().unwrap();
        let topic = &metadata.topics_with_message_count[0].topic_metadata;
        assert_eq!(topic.offered_qos_profiles.len(), 1);
        assert_eq!(topic.offered_qos_profiles[0].reliability, crate::Reliability::Reliable);
        assert_eq!(metadata.relative_file_paths, ["session_0.mcap"]);
    }

    #[test]
    fn what_is_saved_reads_back_and_leaves_no_other_file() {
        let directory = tempfile::tempdir().unwrap();
        let metadata = Metadata::of_one_file("a_0.mcap", Some((5, 9)), Vec::new(), "jazzy", NEWEST);
        metadata.save(directory.path()).unwrap();
        let again = Metadata::load(directory.path()).unwrap().unwrap();
        assert_eq!((again.version, again.duration.nanoseconds, again.ros_distro.as_str()), (9, 4, "jazzy"));
        assert_eq!(std::fs::read_dir(directory.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_version_to_come_and_a_missing_key_are_named() {
        let newer = loaded(&HUMBLE.replace("version: 5", "version: 10")).unwrap_err().to_string();
        assert!(newer.contains("metadata.yaml") && newer.contains("version is 10"), "{newer}");
        let cut = loaded(&HUMBLE.replace("  storage_identifier: mcap\n", "")).unwrap_err().to_string();
        assert!(cut.contains("metadata.yaml") && cut.contains("storage_identifier"), "{cut}");
        assert!(loaded("just a word").is_err());
    }
}
