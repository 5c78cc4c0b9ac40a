//! Which topics are played, under which names and types, with which quality of service.

use std::collections::BTreeMap;

use anyhow::{Context, anyhow, bail};
use node_kit::{NodeKit, topics};
use r2r::PublisherUntyped;
use r2r::qos::ReliabilityPolicy;
use recording::messages::is_same;
use recording::{RecordedTopic, Recording, Topic, remapped};

use super::content::Content;
use super::settings::PlaySettings;
use crate::{graph, names, session};

/// A topic of the recording and its publisher.
#[derive(Clone)]
pub(crate) struct Outlet {
    /// Number in the recording.
    pub(crate) topic: usize,
    /// Name in the graph, before remappings of the command line.
    pub(crate) target: String,
    /// How its messages are treated.
    pub(crate) content: Content,
    /// Whether it sends again what subscribers missed.
    pub(crate) is_reliable: bool,
    /// A publisher may move to another thread, but two threads may not share one.
    pub(crate) publisher: PublisherUntyped,
}

/// A publisher for each topic that is played.
///
/// # Errors
/// Nothing is left to be played; a topic cannot be played as it is meant: its encoding, type, definition or name.
pub(crate) fn open(
    kit: &mut NodeKit,
    recording: &Recording,
    settings: &PlaySettings,
) -> anyhow::Result<Vec<Outlet>> {
    let selected = selected(kit, recording, settings)?;
    if let Some(rule) =
        settings.qos.iter().find(|rule| selected.iter().all(|(_, target)| *target != rule.topic))
    {
        let played: Vec<_> = selected.iter().map(|(_, target)| target).collect();
        bail!("replay.qos: {} is not among the played topics {played:?}", rule.topic);
    }
    let known: BTreeMap<_, _> = session::session_topics(kit.namespace(), &settings.devices)
        .into_iter()
        .map(|topic| (topic.name, topic.type_name))
        .collect();
    let mut outlets = Vec::new();
    for (number, target) in selected {
        let Some(RecordedTopic { topic, .. }) = recording.topics().get(number) else { continue };
        let content = Content::of(&topic.type_name, &target);
        let type_name = content.played_type(&topic.type_name);
        check(topic, type_name, &target, known.get(&target))?;
        let qos = graph::replayed(&topic.offered_qos);
        let qos =
            settings.qos.iter().filter(|rule| rule.topic == target).fold(qos, |qos, rule| rule.apply(qos));
        let is_reliable = qos.reliability != ReliabilityPolicy::BestEffort;
        let publisher = kit
            .publish_raw(&target, type_name, qos)
            .with_context(|| format!("type {type_name} of {}", topic.name))?;
        outlets.push(Outlet { topic: number, target, content, is_reliable, publisher });
    }
    Ok(outlets)
}

/// The numbers of the topics that are played, with the names under which they are.
fn selected(
    kit: &NodeKit,
    recording: &Recording,
    settings: &PlaySettings,
) -> anyhow::Result<Vec<(usize, String)>> {
    let names: Vec<&str> = recording.topics().iter().map(|topic| topic.topic.name.as_str()).collect();
    for missing in settings.topics.iter().filter(|name| !names.contains(&name.as_str())) {
        kit.log().info(&format!("replay.topics: {missing} is not in the recording"));
    }
    let is_named = |name: &str| settings.topics.iter().any(|topic| topic == name);
    let wanted: Vec<(usize, &str)> = names
        .iter()
        .copied()
        .enumerate()
        .filter(|(_, name)| settings.topics.is_empty() || is_named(name))
        .collect();
    let recorded: Vec<&str> = wanted.iter().map(|(_, name)| *name).collect();
    if let Some((_, name)) = recorded
        .iter()
        .enumerate()
        .find(|(number, name)| recorded.iter().take(*number).any(|other| other == *name))
    {
        bail!("{name} is recorded with two types, and a topic has one; replay.topics has to leave it out");
    }
    let targets = remapped(&recorded, &settings.remappings).context("replay.remap")?;
    let answers = if settings.lockstep.is_some() { answers(kit, &settings.devices) } else { Vec::new() };
    let mut selected = Vec::new();
    for ((number, name), target) in wanted.into_iter().zip(targets) {
        let reason = if settings.clock_period.is_some() && target == topics::CLOCK.name() {
            "replay.clock says what time it is"
        } else if answers.contains(&target) {
            "in lockstep it comes from the model"
        } else {
            selected.push((number, target));
            continue;
        };
        if is_named(name) {
            bail!("replay.topics: {name} cannot be played: {reason}");
        }
        kit.log().info(&format!("{name} is not played: {reason}"));
    }
    if selected.is_empty() {
        bail!("nothing to play: {} has the topics {names:?}", recording.path().display());
    }
    Ok(selected)
}

/// What the model publishes: in lockstep a recorded answer would pass for one of its own.
fn answers(kit: &NodeKit, devices: &[String]) -> Vec<String> {
    let of_device = |device: &String| {
        [
            topics::SERVO_CF.name_in(device),
            topics::CONTACT_LAW.name_in(device),
            topics::CONTACT_STATE.name_in(device),
        ]
    };
    let of_session = [
        topics::SURFACE_DISPLACEMENT.name_in(""),
        topics::BODY_MESH.name_in(""),
        topics::BUTTONS_HEARD.name_in(""),
        topics::TRANSFORMS_HEARD.name_in(""),
    ];
    let names = devices.iter().flat_map(of_device).chain(of_session);
    names.map(|name| names::absolute(kit.namespace(), &name)).collect()
}

/// Whether messages of a recorded topic can be sent as `type_name` on `target`, which a session knows as `expected`.
fn check(topic: &Topic, type_name: &str, target: &str, expected: Option<&String>) -> anyhow::Result<()> {
    let Topic { name, type_name: recorded, serialization_format, definition, .. } = topic;
    if serialization_format != "cdr" {
        bail!("{name}: encoding {serialization_format:?} cannot be played; accepted: cdr");
    }
    if let Some(expected) = expected.filter(|expected| *expected != type_name) {
        bail!(
            "{name} is recorded as {recorded}, but {target} of a session is {expected}; leave it out with \
             replay.topics or give it another name with replay.remap"
        );
    }
    is_same(recorded, definition).map(drop).map_err(|reason| anyhow!("{name} cannot be played: {reason}"))
}
