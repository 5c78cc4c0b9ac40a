//! Playing: what is played how, and who does it.
//!
//! By the clock one thread sends and another keeps the node alive. In lockstep one thread does both, between two poses: a
//! hand-over between threads would take longer than the model's answer.

mod content;
mod control;
mod lockstep;
mod offer;
mod outlets;
mod player;
mod progress;
mod schedule;
mod settings;
mod sim_clock;

use std::time::{Duration, Instant};

use anyhow::{Context, anyhow, bail};
use node_kit::{Log, NodeKit, Shutdown, topics};
use recording::{Playback, Recording};
use serde_json::json;

use control::{Control, ControlServices};
use lockstep::Lockstep;
use outlets::Outlet;
use player::{Host, Player, TOLD};
use progress::Progress;
pub(crate) use settings::PlaySettings;
use sim_clock::SimClock;

use crate::rcl::RawNode;

/// Longest time between a signal and its effect.
const TURN: Duration = Duration::from_millis(50);
/// How long the publishers stay after the last message, so that reliable subscribers get what they still miss.
const LINGER: Duration = Duration::from_millis(500);

/// Plays a recording.
pub(crate) fn run(kit: &mut NodeKit, settings: &PlaySettings) -> anyhow::Result<()> {
    let recording = Recording::open(&settings.path)?;
    tell_damage(kit.log(), &recording);
    check_start(&recording, settings)?;
    let outlets = outlets::open(kit, &recording, settings)?;
    let node = RawNode::new(kit)?;
    let clock = match settings.clock_period {
        Some(period) => Some(SimClock::new(kit.publish(&topics::CLOCK, "")?, period)),
        None => None,
    };
    let control = Control::new(settings.paused);
    let services = ControlServices::new(kit, control.clone())?;
    let topics_in_recording = recording.topics().len();
    let mut lockstep = match settings.lockstep {
        Some(timeout) => {
            Some(Lockstep::new(kit, &node, &settings.devices, &outlets, topics_in_recording, timeout)?)
        }
        None => None,
    };
    let how = match (settings.lockstep, settings.rate) {
        (Some(_), _) => "in lockstep with the model".to_owned(),
        (None, rate) => format!("at rate {rate}"),
    };
    kit.ready(&format!("playing {} topics of {} {how}", outlets.len(), settings.path.display()));
    wait_for_subscribers(kit, &outlets, settings);
    check_types_in_graph(&node, &outlets)?;

    let progress = Progress::new(&recording, settings);
    let mut player = Player {
        recording: &recording,
        playback: playback(settings, &outlets),
        outlets: outlets.clone(),
        rate: settings.rate,
        loops: settings.loops,
        control: control.clone(),
        clock,
        log: kit.log().clone(),
        progress: &progress,
    };
    let mut host = NodeHost { kit, services, control: &control, progress: &progress };
    let result = match &mut lockstep {
        Some(lockstep) => lockstep
            .meet(&mut host, &outlets, settings.wait_for_subscribers)
            .and_then(|()| player.play(&mut host, Some(lockstep))),
        None => play_by_the_clock(&mut host, &mut player),
    };
    let end = Instant::now() + LINGER;
    while result.is_ok() && Instant::now() < end {
        host.idle(TURN)?;
    }
    report(kit, &recording, &outlets, &progress, lockstep.as_ref());
    result
}

/// Sends from a thread of its own.
fn play_by_the_clock(host: &mut NodeHost<'_>, player: &mut Player<'_>) -> anyhow::Result<()> {
    let mut clock = ClockHost { shutdown: host.kit.shutdown().clone(), control: player.control.clone() };
    std::thread::scope(|scope| {
        let builder = std::thread::Builder::new().name("bag_player".to_owned());
        let thread = builder
            .spawn_scoped(scope, move || player.play(&mut clock, None))
            .context("the playing thread")?;
        while !thread.is_finished() {
            host.idle(TURN)?;
        }
        thread.join().map_err(|_| anyhow!("the playing thread panicked"))?
    })
}

/// The node itself: waits for calls of services and serves them.
struct NodeHost<'a> {
    kit: &'a mut NodeKit,
    services: ControlServices,
    control: &'a Control,
    progress: &'a Progress,
}

impl Host for NodeHost<'_> {
    fn is_running(&self) -> bool {
        self.kit.is_running()
    }

    fn idle(&mut self, longest: Duration) -> anyhow::Result<()> {
        self.kit.spin_once(longest);
        self.services.serve();
        if self.kit.diagnostics_due() {
            self.kit.publish_diagnostics(vec![self.progress.status(self.control.mode())])?;
        }
        Ok(())
    }
}

/// A thread beside the node.
struct ClockHost {
    shutdown: Shutdown,
    control: Control,
}

impl Host for ClockHost {
    fn is_running(&self) -> bool {
        !self.shutdown.is_requested()
    }

    fn idle(&mut self, longest: Duration) -> anyhow::Result<()> {
        self.control.wait(longest);
        Ok(())
    }
}

fn playback(settings: &PlaySettings, outlets: &[Outlet]) -> Playback {
    let ns = |duration: Duration| u64::try_from(duration.as_nanos()).unwrap_or(u64::MAX);
    Playback {
        topics: outlets.iter().map(|outlet| outlet.topic).collect(),
        start_ns: ns(settings.start),
        duration_ns: settings.duration.map(ns),
    }
}

/// Waits until every reliable topic has a subscriber and those of poses as many as they should, for as long as the
/// parameters say.
fn wait_for_subscribers(kit: &mut NodeKit, outlets: &[Outlet], settings: &PlaySettings) {
    let longest = settings.wait_for_subscribers;
    let end = Instant::now() + longest;
    let lonely = || -> Vec<String> {
        let reliable = outlets.iter().filter(|outlet| outlet.is_reliable);
        let counted = reliable.map(|outlet| {
            let wanted = if outlet.content.is_pose() { settings.pose_readers } else { 1 };
            (outlet, outlet.publisher.get_inter_process_subscription_count().unwrap_or(0), wanted)
        });
        let missing = counted.filter(|(_, found, wanted)| found < wanted);
        missing.map(|(outlet, found, wanted)| format!("{} ({found} of {wanted})", outlet.target)).collect()
    };
    while Instant::now() < end && kit.is_running() && !lonely().is_empty() {
        kit.spin_once(TURN.min(end.saturating_duration_since(Instant::now())));
    }
    if !longest.is_zero() && !lonely().is_empty() {
        kit.log().warn(&format!("too few subscribers after {longest:?}: {}", lonely().join(", ")));
    }
}

/// Nobody hears a topic that others know with another type.
fn check_types_in_graph(node: &RawNode, outlets: &[Outlet]) -> anyhow::Result<()> {
    for (name, types) in node.topics()? {
        if let [first, second, ..] = types.as_slice()
            && outlets.iter().any(|outlet| outlet.target == name)
        {
            bail!(
                "{name} is {first} to one node and {second} to another; end the other one or give the topic another \
                 name with replay.remap"
            );
        }
    }
    Ok(())
}

/// A start behind the end would play nothing and call that a success.
fn check_start(recording: &Recording, settings: &PlaySettings) -> anyhow::Result<()> {
    let Some((first_ns, last_ns)) = recording.log_time_bounds_ns() else { return Ok(()) };
    let length = Duration::from_nanos(last_ns.saturating_sub(first_ns));
    if settings.start > length {
        bail!(
            "replay.start is {} s, and {} ends {} s after its first message",
            settings.start.as_secs_f64(),
            recording.path().display(),
            length.as_secs_f64()
        );
    }
    Ok(())
}

fn tell_damage(log: &Log, recording: &Recording) {
    let told = TOLD as usize;
    for damage in recording.damage().iter().take(told) {
        log.warn(&format!("{damage}; playing what can be read"));
    }
    if let Some(more) = recording.damage().len().checked_sub(told + 1) {
        log.warn(&format!("and {} more broken places", more + 1));
    }
}

/// Says what was played, for people and for scripts.
fn report(
    kit: &NodeKit,
    recording: &Recording,
    outlets: &[Outlet],
    progress: &Progress,
    lockstep: Option<&Lockstep>,
) {
    let sent: Vec<u64> = progress.counts().collect();
    let counts: Vec<_> = outlets
        .iter()
        .map(|outlet| (outlet.target.clone(), sent.get(outlet.topic).copied().unwrap_or(0)))
        .collect();
    let words: Vec<_> = counts.iter().map(|(name, count)| format!("{name} {count}")).collect();
    let path = recording.path().display();
    kit.log().info(&format!("{path}: {} messages: {}", progress.total(), words.join(", ")));
    let mut report = progress.report(recording.damage().len());
    report["recording"] = json!(path.to_string());
    report["topics"] = counts.into_iter().map(|(name, count)| (name, json!(count))).collect();
    if let Some(lockstep) = lockstep {
        report["lockstep"] = lockstep.report();
    }
    kit.closing_report(&report);
}
