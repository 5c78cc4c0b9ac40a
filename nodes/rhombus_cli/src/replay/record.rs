//! Computed messages as a recording of their own.

use std::path::Path;

use anyhow::Context;
use recording::{MessageDefinition, MessageDefinitions, Place, Recording, Topic, TopicId, Writer, messages};

use super::answers::OutputTopic;
use super::model::Output;

/// A recording of the outputs that is being written. It has its name when it is closed; without that nothing is left of it.
pub(super) struct Record {
    writer: Writer,
    ids: Vec<TopicId>,
    place: Place,
}

impl Record {
    /// Begins it; `directory` must not exist, and those above it are made. Definitions come from an installed ROS 2 where one is sourced, else from the
    /// replayed recording, else they are this program's own.
    pub(super) fn create(
        directory: &Path,
        topics: &[OutputTopic],
        replayed: &Recording,
    ) -> anyhow::Result<Self> {
        let installed = MessageDefinitions::from_environment();
        if let Some(parent) = directory.parent() {
            std::fs::create_dir_all(parent).with_context(|| format!("{}: cannot make", parent.display()))?;
        }
        let place = Place::beside(directory)?;
        let mut writer = Writer::create(place.unfinished(), "")?;
        let mut ids = Vec::new();
        for topic in topics {
            ids.push(writer.add_topic(Topic {
                name: topic.name.clone(),
                type_name: topic.type_name.to_owned(),
                serialization_format: "cdr".to_owned(),
                offered_qos: vec![topic.qos],
                definition: definition(topic.type_name, &installed, replayed),
            })?);
        }
        Ok(Self { writer, ids, place })
    }

    pub(super) fn take(&mut self, output: &Output<'_>) -> anyhow::Result<()> {
        let id = self.ids.get(output.topic).context("a message on a topic that was not announced")?;
        Ok(self.writer.write(*id, output.log_time_ns, output.data)?)
    }

    pub(super) fn close(self) -> anyhow::Result<()> {
        self.writer.close()?;
        Ok(self.place.finish()?)
    }
}

fn definition(type_name: &str, installed: &MessageDefinitions, replayed: &Recording) -> MessageDefinition {
    if let Ok(definition) = installed.get(type_name) {
        return definition;
    }
    let recorded = replayed.topics().iter().map(|recorded| &recorded.topic);
    let known = recorded
        .filter(|topic| topic.type_name == type_name && !topic.definition.text.is_empty())
        .map(|topic| topic.definition.clone())
        .next();
    known.or_else(|| messages::own_definition(type_name)).unwrap_or_default()
}
