//! Recording: one thread fetches what came, another writes.
//!
//! Messages are fetched a hundred times a second, all that came since, and not when they come: a wake-up for each of
//! several thousand messages a second costs more than everything else. Nothing depends on when they are fetched, because
//! the log time is the moment at which the middleware received the message.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use anyhow::{Context, bail};
use node_kit::{Level, NodeKit, Status};
use recording::{MessageDefinitions, Written};
use serde_json::json;

use crate::batch::Batch;
use crate::rcl::RawNode;
use crate::session;
use crate::settings::RecordSettings;
use crate::storage::Storage;
use crate::subscription::Subscription;

/// Time between two fetches.
const FETCH_PERIOD: Duration = Duration::from_millis(10);
/// How often topics that are silent are asked, and parameters served.
const TURN_PERIOD: Duration = Duration::from_millis(50);
/// How often the graph is searched for publishers.
const LOOK_PERIOD: Duration = Duration::from_millis(200);
/// What is written in one piece.
const BATCH_BYTES: usize = 4 << 20;
/// After a signal: the recording ends when nothing came for this long ...
const QUIET: Duration = Duration::from_millis(60);
/// ... and after this long even if publishers go on.
const LONGEST_END: Duration = Duration::from_millis(500);

/// Records until the node is asked to end.
pub(crate) fn run(kit: &mut NodeKit, settings: &RecordSettings) -> anyhow::Result<()> {
    // A file size limit is then an error of writing like a full disk, and not the end of the process.
    let limited = Arc::new(AtomicBool::new(false));
    signal_hook::flag::register(signal_hook::consts::SIGXFSZ, limited).context("the signal SIGXFSZ")?;
    // First what can fail because of a parameter: a recording that cannot begin leaves no directory behind.
    let node = RawNode::new(kit)?;
    let subscriptions = subscriptions(kit, &node, settings)?;
    let writer = settings.create_writer()?;
    let definitions = MessageDefinitions::from_environment();
    let log = kit.log().clone();
    let storage = Storage::start(
        writer,
        Box::new(move |type_name| definitions.get(type_name)),
        Box::new(move |text| log.warn(text)),
    )?;
    let now = Instant::now();
    let mut recorder = Recorder { node, subscriptions, storage, settings, next_turn: now, next_look: now };
    kit.ready(&format!("recording to {}", settings.directory.display()));
    let mut due = now;
    while kit.is_running() && !recorder.storage.has_failed() {
        due = (due + FETCH_PERIOD).max(Instant::now());
        std::thread::sleep(due.saturating_duration_since(Instant::now()));
        recorder.turn(kit)?;
        if kit.diagnostics_due() {
            kit.publish_diagnostics(vec![recorder.status()])?;
        }
    }
    recorder.fetch_the_rest(kit)?;
    let received = recorder.storage.messages();
    let written = recorder.storage.finish().with_context(|| {
        format!("recording stopped after {received} messages; what had been written before stays readable")
    })?;
    report(kit, &written);
    let stored: u64 = written.message_counts.iter().map(|(_, count)| count).sum();
    if stored != received {
        bail!("{received} messages were received and {stored} written");
    }
    Ok(())
}

struct Recorder<'a> {
    node: RawNode,
    subscriptions: Vec<Subscription>,
    storage: Storage,
    settings: &'a RecordSettings,
    next_turn: Instant,
    next_look: Instant,
}

impl Recorder<'_> {
    /// Fetches what came on busy topics, and now and then does everything else.
    fn turn(&mut self, kit: &mut NodeKit) -> anyhow::Result<()> {
        let now = Instant::now();
        let everything = now >= self.next_turn;
        self.fetch(kit, |subscription| everything || subscription.is_busy(now))?;
        if everything {
            kit.spin_once(Duration::ZERO);
            self.next_turn = now + TURN_PERIOD;
        }
        if now >= self.next_look {
            self.look(kit)?;
            self.next_look = now + LOOK_PERIOD;
        }
        Ok(())
    }

    /// Hands everything that waits on some topics to the writing thread, by the time of receipt; how many messages.
    fn fetch(&mut self, kit: &mut NodeKit, asks: impl Fn(&Subscription) -> bool) -> anyhow::Result<usize> {
        let mut fetched = 0;
        loop {
            let mut batch = Batch::default();
            for subscription in self.subscriptions.iter_mut().filter(|subscription| asks(subscription)) {
                subscription.drain(kit, &mut self.storage, &mut batch, BATCH_BYTES)?;
            }
            if batch.is_empty() {
                return Ok(fetched);
            }
            fetched += batch.len();
            let is_last = batch.bytes() < BATCH_BYTES;
            batch.sort();
            self.storage.store(batch);
            if is_last {
                return Ok(fetched);
            }
        }
    }

    /// Asks for publishers of the topics, and for topics that nobody could know before.
    fn look(&mut self, kit: &mut NodeKit) -> anyhow::Result<()> {
        for subscription in &mut self.subscriptions {
            subscription.look(kit, &self.node, &mut self.storage)?;
        }
        if !self.settings.topics.is_empty() {
            return Ok(());
        }
        let (namespace, devices) = (kit.namespace().to_owned(), &self.settings.devices);
        let buttons: Vec<String> = self
            .node
            .topics()?
            .into_iter()
            .filter(|(name, types)| session::is_button(&namespace, devices, name, types))
            .map(|(name, _)| name)
            .filter(|name| self.subscriptions.iter().all(|subscription| subscription.name() != name))
            .collect();
        for name in buttons {
            let qos = session::button_qos();
            let subscription = Subscription::to_known_topic(&self.node, &name, session::BUTTON_TYPE, &qos);
            self.subscriptions.push(subscription?);
        }
        Ok(())
    }

    /// What was sent before the end was asked for may still be under way.
    fn fetch_the_rest(&mut self, kit: &mut NodeKit) -> anyhow::Result<()> {
        let mut quiet_since = Instant::now();
        let end = quiet_since + LONGEST_END;
        while quiet_since.elapsed() < QUIET && Instant::now() < end && !self.storage.has_failed() {
            if self.fetch(kit, |_| true)? > 0 {
                quiet_since = Instant::now();
            }
            std::thread::sleep(FETCH_PERIOD);
        }
        Ok(())
    }

    fn status(&self) -> Status {
        let waiting = self.subscriptions.iter().filter(|subscription| subscription.is_waiting()).count();
        let (level, summary) = match self.storage.held_up() {
            0 => (Level::Ok, "recording"),
            _ => (
                Level::Warn,
                "recording; the disk was too slow at times, nothing is lost as long as rcl's queues last",
            ),
        };
        Status::new(level, "recording", summary)
            .with("messages", self.storage.messages())
            .with("bytes_to_write", self.storage.queued_bytes())
            .with("queue_full", self.storage.held_up())
            .with("topics", self.subscriptions.len())
            .with("topics_without_publisher", waiting)
    }
}

/// Subscribes what is known and notes what is not.
fn subscriptions(
    kit: &NodeKit,
    node: &RawNode,
    settings: &RecordSettings,
) -> anyhow::Result<Vec<Subscription>> {
    let known = session::session_topics(kit.namespace(), &settings.devices);
    let wanted = |name: &String| settings.topics.is_empty() || settings.topics.contains(name);
    let mut subscriptions = Vec::new();
    for topic in known.iter().filter(|topic| wanted(&topic.name)) {
        subscriptions.push(Subscription::to_known_topic(node, &topic.name, &topic.type_name, &topic.qos)?);
    }
    for name in settings.topics.iter().filter(|name| known.iter().all(|topic| topic.name != **name)) {
        subscriptions.push(Subscription::to_any_topic(name));
    }
    Ok(subscriptions)
}

/// Says what was recorded, for people and for session scripts.
fn report(kit: &NodeKit, written: &Written) {
    let total: u64 = written.message_counts.iter().map(|(_, count)| count).sum();
    let counts: Vec<_> =
        written.message_counts.iter().map(|(name, count)| format!("{name} {count}")).collect();
    kit.log().info(&format!("{}: {total} messages: {}", written.directory.display(), counts.join(", ")));
    let topics: serde_json::Map<_, _> =
        written.message_counts.iter().map(|(name, count)| (name.clone(), json!(count))).collect();
    kit.closing_report(&json!({
        "recording": written.directory.display().to_string(),
        "messages": total,
        "topics": topics,
    }));
}
