//! What was saved of each topic, and what was lost.

use super::SavedTopic;
use crate::check::Announced;
use crate::error::Error;
use crate::metadata::Metadata;
use crate::reader::{MessageRef, Recording};

/// Counts messages topic by topic.
pub(super) struct Tally<'a> {
    recording: &'a Recording,
    topics: Vec<Counts>,
    saved: u64,
    /// `metadata.yaml` says how many messages there were altogether.
    announced: bool,
    /// There are places that cannot be read and may have held messages.
    unreadable: bool,
    /// There are messages that may not be what was recorded.
    altered: bool,
}

#[derive(Debug, Clone, Copy)]
struct Counts {
    /// How many there were, as far as the recording says.
    recorded: u64,
    saved: u64,
    /// Over all messages, whatever their order: what was written and what is read back must have the same.
    checksum: u64,
}

impl<'a> Tally<'a> {
    pub(super) fn new(recording: &'a Recording, metadata: Option<&Metadata>) -> Self {
        let counted = Announced::by(metadata, recording);
        let counts = recording.topics().iter().map(|found| {
            let announced = counted.of(&found.topic);
            Counts { recorded: found.message_count.max(announced), saved: 0, checksum: 0 }
        });
        let counts_all = !recording.has_unlisted_parts();
        let announced = metadata.is_some_and(|metadata| metadata.message_count > 0) && counts_all;
        let mut tally = Self {
            recording,
            topics: counts.collect(),
            saved: 0,
            announced,
            unreadable: false,
            altered: false,
        };
        recording.damage().iter().for_each(|damage| tally.damage(damage));
        tally
    }

    pub(super) fn take(&mut self, message: &MessageRef<'_>) {
        if let Some(topic) = self.topics.get_mut(message.topic) {
            topic.saved += 1;
            self.saved += 1;
            let times = message.log_time_ns.rotate_left(13) ^ message.publish_time_ns;
            let data = u64::from(crc32fast::hash(message.data)) << 32 | u64::from(message.sequence);
            topic.checksum = topic.checksum.wrapping_add((times ^ data).wrapping_mul(0x9e37_79b9_7f4a_7c15));
        }
    }

    /// Missing closing records say nothing that the messages do not.
    pub(super) fn damage(&mut self, damage: &Error) {
        self.unreadable |= !matches!(damage, Error::NotClosed { .. });
        self.altered |= matches!(damage, Error::Altered { .. });
    }

    pub(super) fn unreadable_place(&mut self) {
        self.unreadable = true;
    }

    pub(super) fn saved(&self) -> u64 {
        self.saved
    }

    /// As far as it is known.
    pub(super) fn lost(&self) -> u64 {
        self.topics.iter().map(Counts::lost).sum()
    }

    /// Whether nothing is missing and nothing could be missing or be another thing than what was recorded.
    pub(super) fn all_saved(&self) -> bool {
        let nothing_missing = self.lost() == 0 && !self.recording.has_missing_parts();
        nothing_missing && !self.altered && (self.announced || !self.unreadable)
    }

    pub(super) fn topics(&self) -> Vec<SavedTopic> {
        // A count above what was saved can only be one that the recording stored.
        let known = self.announced || !self.unreadable || self.lost() > 0 || self.recording.is_counted();
        let known = known && !self.recording.has_missing_parts();
        let names = self.recording.topics().iter().zip(&self.topics);
        let saved = names.map(|(found, counts)| SavedTopic {
            name: found.topic.name.clone(),
            type_name: found.topic.type_name.clone(),
            saved: counts.saved,
            lost: known.then(|| counts.lost()),
        });
        saved.collect()
    }

    /// Whether `read` has the same messages, topic by topic; otherwise which topic has not.
    pub(super) fn compare(&self, read: &Self) -> Result<(), String> {
        let written = self.recording.topics().iter().zip(&self.topics);
        for (found, counts) in written {
            let name = &found.topic.name;
            let of_read = read.recording.topics().iter().zip(&read.topics);
            let again = of_read.filter(|(other, _)| {
                let (other, topic) = (&other.topic, &found.topic);
                other.name == *name
                    && other.type_name == topic.type_name
                    && other.serialization_format == topic.serialization_format
                    && other.definition == topic.definition
            });
            let again = again.map(|(_, counts)| *counts).next().unwrap_or(Counts::NONE);
            if again.saved != counts.saved {
                return Err(format!("{name}: {} messages written, {} read", counts.saved, again.saved));
            }
            if again.checksum != counts.checksum {
                return Err(format!("{name}: the messages are not the same"));
            }
        }
        Ok(())
    }
}

impl Counts {
    const NONE: Self = Self { recorded: 0, saved: 0, checksum: 0 };

    fn lost(&self) -> u64 {
        self.recorded.saturating_sub(self.saved)
    }
}
