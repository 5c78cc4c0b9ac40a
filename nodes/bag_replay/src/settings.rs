//! What the parameters ask of this node.

use std::path::PathBuf;
use std::time::SystemTime;

use anyhow::bail;
use node_kit::NodeKit;
use recording::{Writer, WriterOptions};

use crate::names;
use crate::play::PlaySettings;

/// One of the two things the node does.
pub(crate) enum Settings {
    /// Write a recording.
    Record(RecordSettings),
    /// Play one.
    Play(PlaySettings),
}

/// How to record.
pub(crate) struct RecordSettings {
    /// The directory the recording becomes.
    pub(crate) directory: PathBuf,
    /// Absolute names; empty for all topics of the session.
    pub(crate) topics: Vec<String>,
    /// Sub-namespaces of the session's devices.
    pub(crate) devices: Vec<String>,
    /// Of `metadata.yaml`.
    metadata_version: u32,
}

impl RecordSettings {
    fn read(kit: &NodeKit) -> anyhow::Result<Self> {
        let parameters = kit.parameters();
        let name = match parameters.text("recording.name")? {
            "" => names::by_time(kit.namespace(), SystemTime::now()),
            name if is_name(name) => name.to_owned(),
            name => bail!(
                "recording.name is {name:?}; accepted: letters, digits, '.', '_' and '-', no '.' in front"
            ),
        };
        Ok(Self {
            directory: PathBuf::from(parameters.text("recording.directory")?).join(name),
            topics: topics(kit, "recording.topics")?,
            devices: parameters.texts("devices")?.to_vec(),
            metadata_version: parameters.integer("recording.metadata_version")?.try_into()?,
        })
    }

    /// Begins the recording.
    pub(crate) fn create_writer(&self) -> Result<Writer, recording::Error> {
        let options = WriterOptions {
            metadata_version: self.metadata_version,
            ros_distro: std::env::var("ROS_DISTRO").unwrap_or_default(),
        };
        Writer::create_with(&self.directory, options)
    }
}

/// Reads the node's parameters.
pub(crate) fn read(kit: &NodeKit) -> anyhow::Result<Settings> {
    match kit.parameters().text("bag_replay.mode")? {
        "play" => PlaySettings::read(kit).map(Settings::Play),
        _ => RecordSettings::read(kit).map(Settings::Record),
    }
}

/// The topics that a parameter names, absolute, each once.
pub(crate) fn topics(kit: &NodeKit, key: &str) -> anyhow::Result<Vec<String>> {
    let given = kit.parameters().texts(key)?.iter().filter(|name| !name.is_empty());
    let mut names: Vec<String> =
        given.map(|name| names::topic(kit.namespace(), name, key)).collect::<Result<_, _>>()?;
    names.sort();
    names.dedup();
    Ok(names)
}

/// A file name that cannot lead anywhere else and is not hidden.
fn is_name(name: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '_' | '-');
    !name.is_empty() && !name.starts_with('.') && name.chars().all(plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_cannot_leave_the_folder_of_recordings() {
        assert!(is_name("session_2026-11-22.b"));
        for name in ["", ".", "..", "a/b", "/a", ".hidden", "a b"] {
            assert!(!is_name(name), "{name:?}");
        }
    }
}
