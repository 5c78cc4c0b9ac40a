//! How to play, as the parameters say it.

use std::path::PathBuf;
use std::time::Duration;

use anyhow::{Context, bail};
use node_kit::NodeKit;

use super::offer::QosRule;
use crate::{names, settings};

/// How to play.
pub(crate) struct PlaySettings {
    /// The recording.
    pub(crate) path: PathBuf,
    /// 2 is twice as fast as recorded.
    pub(crate) rate: f64,
    /// After the first message of the recording.
    pub(crate) start: Duration,
    /// In recorded time; none to the end.
    pub(crate) duration: Option<Duration>,
    /// Whether the end is followed by the beginning.
    pub(crate) loops: bool,
    /// Whether nothing is sent before somebody asks for it.
    pub(crate) paused: bool,
    /// Absolute names in the recording; empty for all.
    pub(crate) topics: Vec<String>,
    /// Other names for topics of the recording: absolute ones there, and in the graph.
    pub(crate) remappings: Vec<(String, String)>,
    /// Quality of service in place of the recorded one.
    pub(crate) qos: Vec<QosRule>,
    /// Time between two messages on `/clock`; none for no such topic.
    pub(crate) clock_period: Option<Duration>,
    /// Longest wait for an answer; none plays by the clock and not in lockstep.
    pub(crate) lockstep: Option<Duration>,
    /// Longest wait for subscribers before the first message.
    pub(crate) wait_for_subscribers: Duration,
    /// Subscriptions of a topic of poses that are waited for.
    pub(crate) pose_readers: usize,
    /// Sub-namespaces of the session's devices.
    pub(crate) devices: Vec<String>,
}

impl PlaySettings {
    /// Reads the parameters.
    pub(crate) fn read(kit: &NodeKit) -> anyhow::Result<Self> {
        let parameters = kit.parameters();
        let path = parameters.text("replay.path")?;
        if path.is_empty() {
            bail!(
                "replay.path is empty; to play it must name a folder with metadata.yaml or an .mcap or .db3 file"
            );
        }
        let seconds = |key: &'static str| -> anyhow::Result<Duration> {
            Duration::try_from_secs_f64(parameters.double(key)?).context(key)
        };
        let given = |key: &str| -> anyhow::Result<Vec<&String>> {
            Ok(parameters.texts(key)?.iter().filter(|text| !text.is_empty()).collect())
        };
        let namespace = kit.namespace();
        let clock_hz = parameters.double("replay.clock")?;
        let duration = seconds("replay.duration")?;
        Ok(Self {
            path: PathBuf::from(path),
            rate: parameters.double("replay.rate")?,
            start: seconds("replay.start")?,
            duration: (!duration.is_zero()).then_some(duration),
            loops: parameters.bool("replay.loop")?,
            paused: parameters.bool("replay.paused")?,
            topics: settings::topics(kit, "replay.topics")?,
            remappings: given("replay.remap")?
                .into_iter()
                .map(|text| remapping(text, namespace))
                .collect::<Result<_, _>>()?,
            qos: given("replay.qos")?
                .into_iter()
                .map(|text| QosRule::parse(text, namespace))
                .collect::<Result<_, _>>()?,
            clock_period: match clock_hz > 0.0 {
                true => Some(Duration::try_from_secs_f64(1.0 / clock_hz).context("replay.clock")?),
                false => None,
            },
            lockstep: match parameters.bool("replay.lockstep")? {
                true => Some(seconds("replay.lockstep_timeout")?),
                false => None,
            },
            wait_for_subscribers: seconds("replay.wait_for_subscribers")?,
            pose_readers: usize::try_from(parameters.integer("replay.wait_for_readers")?)
                .context("replay.wait_for_readers")?,
            devices: parameters.texts("devices")?.to_vec(),
        })
    }
}

/// Reads `FROM:=TO`; relative names stand in `namespace`.
fn remapping(text: &str, namespace: &str) -> anyhow::Result<(String, String)> {
    let Some((from, to)) = text.split_once(":=") else {
        bail!("replay.remap: {text:?} has no \":=\"; accepted: FROM:=TO, two names of topics");
    };
    let name = |name: &str| names::topic(namespace, name.trim(), "replay.remap");
    Ok((name(from)?, name(to)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relative_names_of_a_remapping_stand_in_the_namespace() {
        let read = |text: &str| remapping(text, "/or").unwrap();
        assert_eq!(read("a := left/a"), ("/or/a".to_owned(), "/or/left/a".to_owned()));
        assert_eq!(read("/b:=x"), ("/b".to_owned(), "/or/x".to_owned()));
        for text in ["a", "a:b", "a:=", ":=b", "a:=b c", "a:=b:=c"] {
            assert!(remapping(text, "/").is_err(), "{text}");
        }
    }
}
