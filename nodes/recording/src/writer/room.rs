//! How much of `metadata.yaml` the topics of a recording take: there is a size beyond which no reader takes it.

use crate::error::Error;
use crate::metadata::{LARGEST_BYTES, Metadata, TopicMetadata, TopicWithCount};
use crate::topic::Topic;

/// Counts and times that get longer until the recording is closed, and what a list of topics has around it.
const MARGIN_BYTES: u64 = 200;

/// Digits that the count of a topic gets beyond its first one.
const MORE_DIGITS: u64 = 19;

/// What is left for topics.
pub(super) struct Room {
    version: u32,
    /// Of a file without topics.
    empty_bytes: u64,
    left_bytes: u64,
}

impl Room {
    /// In the metadata of a recording without topics.
    pub(super) fn of(empty: &Metadata) -> Result<Self, Error> {
        let empty_bytes = size(empty)?;
        let left_bytes = LARGEST_BYTES.saturating_sub(empty_bytes + MARGIN_BYTES);
        let without_names = Metadata::of_one_file("", None, Vec::new(), "", empty.version);
        Ok(Self { version: empty.version, empty_bytes: size(&without_names)?, left_bytes })
    }

    /// Whether there is room for one more topic, which is taken then.
    pub(super) fn take(&mut self, topic: &Topic) -> Result<bool, Error> {
        let topic = entry(topic, 0);
        let with_it = size(&Metadata::of_one_file("", None, vec![topic], "", self.version))?;
        // Without topics there is "[]" in place of a line break and the entry.
        let bytes = (with_it + 3 + MORE_DIGITS).saturating_sub(self.empty_bytes);
        let left = self.left_bytes.checked_sub(bytes);
        self.left_bytes = left.unwrap_or(self.left_bytes);
        Ok(left.is_some())
    }
}

/// What `metadata.yaml` says of a topic.
pub(super) fn entry(topic: &Topic, message_count: u64) -> TopicWithCount {
    let topic_metadata = TopicMetadata {
        name: topic.name.clone(),
        type_name: topic.type_name.clone(),
        serialization_format: topic.serialization_format.clone(),
        offered_qos_profiles: topic.offered_qos.clone(),
        type_description_hash: topic.definition.type_hash.clone(),
    };
    TopicWithCount { topic_metadata, message_count }
}

/// Bytes of the file, in which everything stands two blanks deeper.
fn size(metadata: &Metadata) -> Result<u64, Error> {
    let yaml = metadata.to_yaml(crate::metadata::FILE_NAME.as_ref())?;
    Ok((yaml.len() + 2 * yaml.lines().count()) as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_size_of_a_file_with_topics_is_known_before_it_is_written() {
        for version in [crate::metadata::NEWEST, crate::metadata::HUMBLE] {
            let mut topic = Topic {
                name: String::new(),
                type_name: "std_msgs/msg/Bool".to_owned(),
                serialization_format: "cdr".to_owned(),
                offered_qos: vec![crate::Qos::default(); 2],
                definition: crate::MessageDefinition::default(),
            };
            let of = |topics: Vec<TopicWithCount>| {
                let bounds_ns = Some((u64::MAX / 2, u64::MAX));
                Metadata::of_one_file("session_0.mcap", bounds_ns, topics, "jazzy", version)
            };
            let mut room = Room::of(&of(Vec::new())).unwrap();
            let mut entries = Vec::new();
            for number in 0..50 {
                topic.name = format!("/robot_{number}/is \"enabled\"\nor not");
                assert!(room.take(&topic).unwrap());
                entries.push(entry(&topic, u64::MAX / 50));
            }
            let directory = tempfile::tempdir().unwrap();
            of(entries).save(directory.path()).unwrap();
            let path = directory.path().join(crate::metadata::FILE_NAME);
            let written = std::fs::metadata(path).unwrap().len();
            let counted = LARGEST_BYTES - room.left_bytes;
            assert!(
                written <= counted && counted < written + 2000,
                "{version}: {written}, counted {counted}"
            );
        }
    }
}
