//! Recording: one thread receives and stamps, another writes.

use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use anyhow::bail;
use node_kit::{Level, NodeKit, Status};
use recording::{MessageDefinitions, Writer, Written};
use serde_json::json;

use crate::names;
use crate::settings::RecordSettings;
use crate::storage::Storage;
use crate::subscription::Subscription;

/// How often the graph is searched for publishers, while topics have none and afterwards.
const LOOK_PERIOD: Duration = Duration::from_millis(200);
const LOOK_PERIOD_COMPLETE: Duration = Duration::from_secs(1);
/// After a signal: the recording ends when nothing came for this long ...
const QUIET: Duration = Duration::from_millis(60);
/// ... and after this long even if publishers go on.
const LONGEST_END: Duration = Duration::from_millis(500);

/// Records until the node is asked to end.
pub(crate) fn run(kit: &mut NodeKit, settings: &RecordSettings) -> anyhow::Result<()> {
    let ros_distro = std::env::var("ROS_DISTRO").unwrap_or_default();
    // First what can fail because of a parameter: a recording that cannot begin leaves no directory behind.
    let subscriptions = subscriptions(kit, settings)?;
    let writer = Writer::create(&settings.directory, &ros_distro)?;
    let definitions = MessageDefinitions::from_environment();
    let log = kit.log().clone();
    let storage = Storage::start(
        writer,
        Box::new(move |type_name| definitions.get(type_name)),
        Box::new(move |text| log.warn(text)),
    )?;
    let mut recorder = Recorder { subscriptions, storage, next_look: Instant::now() };
    kit.ready(&format!("recording to {}", settings.directory.display()));
    while kit.is_running() && !recorder.storage.has_failed() {
        recorder.turn(kit, LOOK_PERIOD)?;
        if kit.diagnostics_due() {
            kit.publish_diagnostics(vec![recorder.status()])?;
        }
    }
    let mut quiet_since = Instant::now();
    let end = quiet_since + LONGEST_END;
    while quiet_since.elapsed() < QUIET && Instant::now() < end && !recorder.storage.has_failed() {
        if recorder.turn(kit, QUIET / 4)? {
            quiet_since = Instant::now();
        }
    }
    let received = recorder.storage.messages();
    let written = recorder.storage.finish()?;
    report(kit, &written);
    let stored: u64 = written.message_counts.iter().map(|(_, count)| count).sum();
    if stored != received {
        bail!("{received} messages were received and {stored} written");
    }
    Ok(())
}

struct Recorder {
    subscriptions: Vec<Subscription>,
    storage: Storage,
    next_look: Instant,
}

impl Recorder {
    /// One spin, then everything that came with it; whether anything did.
    fn turn(&mut self, kit: &mut NodeKit, timeout: Duration) -> anyhow::Result<bool> {
        kit.spin_once(timeout);
        let now_ns = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |now| now.as_nanos() as u64);
        let mut any = false;
        for subscription in &mut self.subscriptions {
            any |= subscription.drain(kit, &mut self.storage, now_ns);
        }
        let now = Instant::now();
        if now >= self.next_look {
            for subscription in &mut self.subscriptions {
                subscription.look(kit, &mut self.storage)?;
            }
            let waiting = self.subscriptions.iter().any(Subscription::is_waiting);
            self.next_look = now + if waiting { LOOK_PERIOD } else { LOOK_PERIOD_COMPLETE };
        }
        Ok(any)
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
            .with("messages_to_write", self.storage.queued())
            .with("queue_full", self.storage.held_up())
            .with("topics", self.subscriptions.len())
            .with("topics_without_publisher", waiting)
    }
}

/// Subscribes what is known and notes what is not.
fn subscriptions(kit: &mut NodeKit, settings: &RecordSettings) -> anyhow::Result<Vec<Subscription>> {
    let known = names::session_topics(kit.namespace(), &settings.devices);
    let wanted = |name: &String| settings.topics.is_empty() || settings.topics.contains(name);
    let mut subscriptions = Vec::new();
    for topic in known.iter().filter(|topic| wanted(&topic.name)) {
        subscriptions.push(Subscription::to_session_topic(kit, &topic.name, topic.type_name, &topic.qos)?);
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
