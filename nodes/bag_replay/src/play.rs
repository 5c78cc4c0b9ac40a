//! Playing: one thread sends each message when it is due, the other keeps the node alive.

use std::collections::BTreeSet;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use anyhow::{Context, anyhow, bail};
use node_kit::{Level, Log, NodeKit, Shutdown, Status};
use r2r::PublisherUntyped;
use recording::{RecordedTopic, Recording};
use serde_json::json;

use crate::graph;
use crate::schedule::Schedule;
use crate::settings::PlaySettings;

/// Longest time between a signal and its effect.
const TURN: Duration = Duration::from_millis(50);
/// How long the publishers stay after the last message, so that reliable subscribers get what they still miss.
const LINGER: Duration = Duration::from_millis(500);
/// Broken places of a recording that are told one by one.
const TOLD: usize = 10;

/// Plays a recording once.
pub(crate) fn run(kit: &mut NodeKit, settings: &PlaySettings) -> anyhow::Result<()> {
    let recording = Recording::open(&settings.path)?;
    tell_damage(kit.log(), &recording);
    let outlets = outlets(kit, &recording, &settings.topics)?;
    let played = outlets.iter().flatten().count();
    kit.ready(&format!("playing {played} topics of {} at rate {}", settings.path.display(), settings.rate));
    wait_for_subscribers(kit, &recording, &outlets, settings.wait_for_subscribers);

    let progress = Progress::new(recording.topics().len());
    let player = Player {
        recording: &recording,
        // A publisher may move to another thread, but two threads may not share one.
        outlets: outlets.clone(),
        rate: settings.rate,
        shutdown: kit.shutdown().clone(),
        log: kit.log().clone(),
        progress: &progress,
    };
    let total: u64 = selected(&recording, &outlets).map(|(topic, _)| topic.message_count).sum();
    let result = std::thread::scope(|scope| {
        let builder = std::thread::Builder::new().name("bag_player".to_owned());
        let thread = builder.spawn_scoped(scope, move || player.play()).context("the playing thread")?;
        while !thread.is_finished() {
            kit.spin_once(TURN);
            if kit.diagnostics_due() {
                kit.publish_diagnostics(vec![progress.status(total)])?;
            }
        }
        thread.join().map_err(|_| anyhow!("the playing thread panicked"))?
    });
    let end = Instant::now() + LINGER;
    while result.is_ok() && Instant::now() < end {
        kit.spin_once(TURN);
    }
    report(kit, settings, &recording, &outlets, &progress);
    result
}

/// A publisher for each topic of the recording that is played, by the number of the topic.
fn outlets(
    kit: &mut NodeKit,
    recording: &Recording,
    wanted: &[String],
) -> anyhow::Result<Vec<Option<PublisherUntyped>>> {
    let names: BTreeSet<_> = recording.topics().iter().map(|topic| topic.topic.name.as_str()).collect();
    for missing in wanted.iter().filter(|name| !names.contains(name.as_str())) {
        kit.log().info(&format!("replay.topics: {missing} is not in the recording"));
    }
    let mut outlets = Vec::new();
    for RecordedTopic { topic, .. } in recording.topics() {
        let is_wanted = wanted.is_empty() || wanted.contains(&topic.name);
        let outlet = is_wanted.then(|| {
            if topic.serialization_format != "cdr" {
                bail!(
                    "{}: encoding {:?} cannot be played; accepted: cdr",
                    topic.name,
                    topic.serialization_format
                );
            }
            let publisher =
                kit.publish_raw(&topic.name, &topic.type_name, graph::replayed(&topic.offered_qos));
            publisher.with_context(|| format!("type {} of {}", topic.type_name, topic.name))
        });
        outlets.push(outlet.transpose()?);
    }
    if outlets.iter().all(Option::is_none) {
        let names: Vec<_> = names.into_iter().collect();
        bail!("nothing to play: {} has the topics {:?}", recording.path().display(), names);
    }
    Ok(outlets)
}

/// The topics that are played, with their publishers.
fn selected<'a>(
    recording: &'a Recording,
    outlets: &'a [Option<PublisherUntyped>],
) -> impl Iterator<Item = (&'a RecordedTopic, &'a PublisherUntyped)> {
    recording.topics().iter().zip(outlets).filter_map(|(topic, outlet)| Some((topic, outlet.as_ref()?)))
}

/// Waits until every reliable topic has a subscriber, at most for `longest`.
fn wait_for_subscribers(
    kit: &mut NodeKit,
    recording: &Recording,
    outlets: &[Option<PublisherUntyped>],
    longest: Duration,
) {
    let end = Instant::now() + longest;
    let lonely = || -> Vec<&str> {
        selected(recording, outlets)
            .filter(|(topic, _)| topic.message_count > 0 && graph::is_reliable(&topic.topic.offered_qos))
            .filter(|(_, outlet)| outlet.get_inter_process_subscription_count().unwrap_or(0) == 0)
            .map(|(topic, _)| topic.topic.name.as_str())
            .collect()
    };
    while Instant::now() < end && kit.is_running() && !lonely().is_empty() {
        kit.spin_once(TURN.min(end.saturating_duration_since(Instant::now())));
    }
    if !longest.is_zero() && !lonely().is_empty() {
        kit.log().warn(&format!("no subscriber after {longest:?} for {}", lonely().join(", ")));
    }
}

fn tell_damage(log: &Log, recording: &Recording) {
    for damage in recording.damage().iter().take(TOLD) {
        log.warn(&format!("{damage}; playing what can be read"));
    }
    if let Some(more) = recording.damage().len().checked_sub(TOLD + 1) {
        log.warn(&format!("and {} more broken places", more + 1));
    }
}

/// What has been played, watched by the other thread.
struct Progress {
    /// By the number of the topic.
    sent: Vec<AtomicU64>,
    unreadable: AtomicU64,
    latest_us: AtomicU64,
}

impl Progress {
    fn new(topics: usize) -> Self {
        let sent = (0..topics).map(|_| AtomicU64::new(0)).collect();
        Self { sent, unreadable: AtomicU64::new(0), latest_us: AtomicU64::new(0) }
    }

    fn total(&self) -> u64 {
        self.sent.iter().map(|count| count.load(Ordering::Relaxed)).sum()
    }

    fn status(&self, of: u64) -> Status {
        Status::new(Level::Ok, "replay", "playing")
            .with("messages", self.total())
            .with("messages_in_recording", of)
            .with("unreadable_places", self.unreadable.load(Ordering::Relaxed))
            .with("latest_ms", self.latest_us.load(Ordering::Relaxed) as f64 * 1e-3)
    }
}

struct Player<'a> {
    recording: &'a Recording,
    outlets: Vec<Option<PublisherUntyped>>,
    rate: f64,
    shutdown: Shutdown,
    log: Log,
    progress: &'a Progress,
}

impl Player<'_> {
    /// Sends everything. Latched topics begin: their first messages go out before all others, because subscribers take
    /// them for granted.
    fn play(&self) -> anyhow::Result<()> {
        let mut latched = self.latched_topics();
        let mut sent_early = BTreeSet::new();
        for message in self.recording.messages() {
            if latched.is_empty() || self.shutdown.is_requested() {
                break;
            }
            if let Ok(message) = message
                && latched.remove(&message.topic)
            {
                self.send(message.topic, &message.data)?;
                sent_early.insert(message.topic);
            }
        }
        let mut schedule = None;
        for message in self.recording.messages() {
            let message = match message {
                Ok(message) => message,
                Err(error) => {
                    if self.progress.unreadable.fetch_add(1, Ordering::Relaxed) < TOLD as u64 {
                        self.log.warn(&format!("{error}; going on behind it"));
                    }
                    continue;
                }
            };
            if self.outlets.get(message.topic).is_none_or(Option::is_none)
                || sent_early.remove(&message.topic)
            {
                continue;
            }
            let schedule =
                schedule.get_or_insert_with(|| Schedule::new(Instant::now(), message.log_time_ns, self.rate));
            let due = schedule.due(message.log_time_ns);
            if !self.sleep_until(due) {
                return Ok(());
            }
            let late = Instant::now().saturating_duration_since(due).as_micros() as u64;
            self.progress.latest_us.fetch_max(late, Ordering::Relaxed);
            self.send(message.topic, &message.data)?;
        }
        Ok(())
    }

    fn latched_topics(&self) -> BTreeSet<usize> {
        let topics = self.recording.topics().iter().zip(&self.outlets).enumerate();
        topics
            .filter(|(_, (topic, outlet))| {
                outlet.is_some() && topic.message_count > 0 && graph::is_latched(&topic.topic.offered_qos)
            })
            .map(|(number, _)| number)
            .collect()
    }

    fn send(&self, topic: usize, data: &[u8]) -> anyhow::Result<()> {
        if let (Some(Some(outlet)), Some(count)) = (self.outlets.get(topic), self.progress.sent.get(topic)) {
            let name = || self.recording.topics().get(topic).map_or("", |topic| topic.topic.name.as_str());
            outlet.publish_raw(data).with_context(|| format!("{}: message not sent", name()))?;
            count.fetch_add(1, Ordering::Relaxed);
        }
        Ok(())
    }

    /// False when the node was asked to end instead.
    fn sleep_until(&self, due: Instant) -> bool {
        loop {
            if self.shutdown.is_requested() {
                return false;
            }
            let left = due.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return true;
            }
            std::thread::sleep(left.min(TURN));
        }
    }
}

/// Says what was played, for people and for scripts.
fn report(
    kit: &NodeKit,
    settings: &PlaySettings,
    recording: &Recording,
    outlets: &[Option<PublisherUntyped>],
    progress: &Progress,
) {
    let numbered = recording.topics().iter().zip(outlets).zip(&progress.sent);
    let counts: Vec<_> = numbered
        .filter(|((_, outlet), _)| outlet.is_some())
        .map(|((topic, _), sent)| (topic.topic.name.clone(), sent.load(Ordering::Relaxed)))
        .collect();
    let words: Vec<_> = counts.iter().map(|(name, count)| format!("{name} {count}")).collect();
    kit.log().info(&format!(
        "{}: {} messages: {}",
        settings.path.display(),
        progress.total(),
        words.join(", ")
    ));
    let topics: serde_json::Map<_, _> =
        counts.into_iter().map(|(name, count)| (name, json!(count))).collect();
    kit.closing_report(&json!({
        "recording": settings.path.display().to_string(),
        "messages": progress.total(),
        "topics": topics,
        "unreadable_places": recording.damage().len() as u64 + progress.unreadable.load(Ordering::Relaxed),
        "latest_ms": progress.latest_us.load(Ordering::Relaxed) as f64 * 1e-3,
    }));
}
