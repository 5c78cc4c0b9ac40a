//! What the parameters ask of this node.

use std::path::PathBuf;
use std::time::{Duration, SystemTime};

use anyhow::{Context, bail};
use node_kit::NodeKit;
use recording::Writer;

use crate::names;

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
}

impl RecordSettings {
    /// Begins the recording.
    pub(crate) fn create_writer(&self) -> Result<Writer, recording::Error> {
        let ros_distro = std::env::var("ROS_DISTRO").unwrap_or_default();
        Writer::create(&self.directory, &ros_distro)
    }
}

/// How to play.
pub(crate) struct PlaySettings {
    /// The recording.
    pub(crate) path: PathBuf,
    /// 2 is twice as fast as recorded.
    pub(crate) rate: f64,
    /// Absolute names; empty for all topics of the recording.
    pub(crate) topics: Vec<String>,
    /// Longest wait for subscribers before the first message.
    pub(crate) wait_for_subscribers: Duration,
}

/// Reads the node's parameters.
pub(crate) fn read(kit: &NodeKit) -> anyhow::Result<Settings> {
    let parameters = kit.parameters();
    let namespace = kit.namespace();
    let topics = |key: &str| -> anyhow::Result<Vec<String>> {
        let given = parameters.texts(key)?.iter().filter(|name| !name.is_empty());
        let mut names: Vec<_> = given.map(|name| names::absolute(namespace, name)).collect();
        if let Some(wrong) = names.iter().find(|name| !names::is_topic(name)) {
            bail!(
                "{key}: {wrong:?} is not the name of a topic; accepted: letters, digits and '_' behind each '/'"
            );
        }
        names.sort();
        names.dedup();
        Ok(names)
    };
    if parameters.text("bag_replay.mode")? == "play" {
        let path = parameters.text("replay.path")?;
        if path.is_empty() {
            bail!("replay.path is empty; to play it must name a folder with metadata.yaml or an .mcap file");
        }
        let wait_s = parameters.double("replay.wait_for_subscribers")?;
        return Ok(Settings::Play(PlaySettings {
            path: PathBuf::from(path),
            rate: parameters.double("replay.rate")?,
            topics: topics("replay.topics")?,
            wait_for_subscribers: Duration::try_from_secs_f64(wait_s)
                .context("replay.wait_for_subscribers")?,
        }));
    }
    let name = match parameters.text("recording.name")? {
        "" => names::by_time(namespace, SystemTime::now()),
        name if is_name(name) => name.to_owned(),
        name => {
            bail!("recording.name is {name:?}; accepted: letters, digits, '.', '_' and '-', no '.' in front")
        }
    };
    Ok(Settings::Record(RecordSettings {
        directory: PathBuf::from(parameters.text("recording.directory")?).join(name),
        topics: topics("recording.topics")?,
        devices: parameters.texts("devices")?.to_vec(),
    }))
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
