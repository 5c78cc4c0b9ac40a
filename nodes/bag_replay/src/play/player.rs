//! The one who sends: each message when it is due, or in lockstep when the model is ready for it.

use std::time::{Duration, Instant};

use anyhow::Context;
use node_kit::Log;
use recording::{Durability, Message, Playback, Recording};

use super::control::{Control, Mode};
use super::lockstep::Lockstep;
use super::outlets::Outlet;
use super::progress::Progress;
use super::schedule::Schedule;
use super::sim_clock::SimClock;

/// Longest time between a signal and its effect.
const TURN: Duration = Duration::from_millis(50);
/// How often, in lockstep, everything else is looked after.
const LOOK_AROUND: Duration = Duration::from_millis(20);
/// Broken places and messages that are told one by one.
pub(crate) const TOLD: u64 = 10;

/// Who lets the time pass while the player waits.
pub(crate) trait Host {
    /// False when the node was asked to end.
    fn is_running(&self) -> bool;
    /// Waits, at most this long; less when something was asked for.
    ///
    /// # Errors
    /// The node cannot go on.
    fn idle(&mut self, longest: Duration) -> anyhow::Result<()>;
}

/// Sends a recording.
pub(crate) struct Player<'a> {
    pub(crate) recording: &'a Recording,
    pub(crate) playback: Playback,
    pub(crate) outlets: Vec<Outlet>,
    pub(crate) rate: f64,
    pub(crate) loops: bool,
    pub(crate) control: Control,
    pub(crate) clock: Option<SimClock>,
    pub(crate) log: Log,
    pub(crate) progress: &'a Progress,
}

/// Where a round is.
struct Round {
    /// None before the first message that has its place in time.
    schedule: Option<Schedule>,
    /// Time of the recording, ns since 1970; stands still in a pause.
    now_ns: u64,
    /// Whether a topic has been heard of, by its number.
    begun: Vec<bool>,
    next_tenth: u32,
    looked_around: Instant,
}

impl Round {
    /// Lets the time of the recording go on to what the schedule says, up to the message that comes next.
    fn advance(&mut self, now: Instant, next_ns: Option<u64>) {
        let scheduled_ns = self.schedule.map_or(0, |schedule| schedule.time_ns(now));
        self.now_ns = self.now_ns.max(scheduled_ns.min(next_ns.unwrap_or(scheduled_ns)));
    }
}

impl Player<'_> {
    /// Sends everything, once or until the node is asked to end: by the clock, or in lockstep.
    pub(crate) fn play(
        &mut self,
        host: &mut dyn Host,
        mut lockstep: Option<&mut Lockstep>,
    ) -> anyhow::Result<()> {
        loop {
            let before = self.progress.total();
            let number = self.progress.begin_round();
            if number > 1 {
                let back_s = self.progress.duration_s();
                self.log.info(&format!("round {number} begins: the time goes back by {back_s:.3} s"));
            }
            self.round(host, &mut lockstep)?;
            if !self.loops || !host.is_running() {
                return Ok(());
            }
            if self.progress.total() == before {
                self.log.warn("a round without any message is not played again");
                return Ok(());
            }
        }
    }

    fn round(&mut self, host: &mut dyn Host, lockstep: &mut Option<&mut Lockstep>) -> anyhow::Result<()> {
        let now = Instant::now();
        let mut round = Round {
            schedule: None,
            now_ns: self.progress.first_ns(),
            begun: vec![false; self.recording.topics().len()],
            next_tenth: 1,
            looked_around: now,
        };
        if let Some(clock) = &mut self.clock {
            clock.tell(now, round.now_ns)?;
        }
        for message in self.recording.playback(&self.playback) {
            match message {
                Ok(message) => {
                    if !self.message(host, lockstep, &mut round, &message)? {
                        break;
                    }
                }
                Err(error) if self.progress.unreadable() < TOLD => {
                    self.log.warn(&format!("{error}; going on behind it"));
                }
                Err(_) => {}
            }
        }
        Ok(())
    }

    /// Sends one message when it is its turn; false when the node was asked to end instead.
    fn message(
        &mut self,
        host: &mut dyn Host,
        lockstep: &mut Option<&mut Lockstep>,
        round: &mut Round,
        message: &Message,
    ) -> anyhow::Result<bool> {
        let Some(place) = self.outlets.iter().position(|outlet| outlet.topic == message.topic) else {
            return Ok(true);
        };
        let is_early = self.is_early(round, message);
        // In lockstep nothing has a time of its own: what the model is ready for is due.
        let due_ns = (!is_early && lockstep.is_none()).then_some(message.log_time_ns);
        if !self.wait_for_turn(host, round, due_ns)? {
            return Ok(false);
        }
        let Some(outlet) = self.outlets.get(place) else { return Ok(true) };
        let prepared = match outlet.content.prepare(&message.data) {
            Ok(prepared) => prepared,
            Err(error) => {
                if self.progress.broken() < TOLD {
                    let (topic, time_ns) = (&outlet.target, message.log_time_ns);
                    self.log
                        .warn(&format!("{topic}: the message logged at {time_ns} ns is left out: {error}"));
                }
                return Ok(true);
            }
        };
        let is_pose = outlet.content.is_pose();
        if let Some(lockstep) = lockstep {
            lockstep.before(host, message.topic)?;
            if let Some(clock) = self.clock.as_mut().filter(|_| is_pose) {
                clock.tell(Instant::now(), message.log_time_ns)?;
            }
        }
        let sent = outlet.publisher.publish_raw(&prepared.data);
        sent.with_context(|| format!("{}: message not sent", outlet.target))?;
        self.progress.sent(message.topic);
        if let Some(lockstep) = lockstep {
            lockstep.after(host, message.topic, prepared.stamp.as_ref())?;
        }
        let steps = is_pose || !self.outlets.iter().any(|outlet| outlet.content.is_pose());
        if steps && self.control.mode() == Mode::Stepping {
            self.control.stepped();
        }
        if !is_early {
            round.now_ns = round.now_ns.max(message.log_time_ns);
            self.progress.reach(message.log_time_ns);
            self.tell_progress(round);
        }
        Ok(true)
    }

    /// Whether a message is sent before its time because its topic is latched: see [`Recording::playback`].
    fn is_early(&self, round: &mut Round, message: &Message) -> bool {
        let has_begun = round.begun.get_mut(message.topic).map(|begun| std::mem::replace(begun, true));
        let is_latched = self.recording.topics().get(message.topic).is_some_and(|topic| {
            let offers = &topic.topic.offered_qos;
            offers.iter().any(|offer| offer.durability == Durability::TransientLocal)
        });
        is_latched && (message.log_time_ns < self.progress.first_ns() || has_begun == Some(false))
    }

    /// Waits until a message is due, if it has a time at all, and while the replay pauses; false when the node was asked to
    /// end instead. What has no time gives the rest of the node its turn now and then.
    fn wait_for_turn(
        &mut self,
        host: &mut dyn Host,
        round: &mut Round,
        log_time_ns: Option<u64>,
    ) -> anyhow::Result<bool> {
        let mut paused = false;
        loop {
            if !host.is_running() {
                return Ok(false);
            }
            let now = Instant::now();
            let wait = match self.control.mode() {
                Mode::Stepping => {
                    round.schedule = None;
                    return Ok(true);
                }
                Mode::Paused => {
                    if !std::mem::replace(&mut paused, true) {
                        round.advance(now, log_time_ns);
                    }
                    // What is due is counted anew from where the recording stands.
                    round.schedule = None;
                    TURN
                }
                Mode::Playing => {
                    let Some(log_time_ns) = log_time_ns else {
                        if now.saturating_duration_since(round.looked_around) >= LOOK_AROUND {
                            round.looked_around = now;
                            host.idle(Duration::ZERO)?;
                        }
                        return Ok(true);
                    };
                    let schedule = round.schedule.get_or_insert_with(|| {
                        // A recording that begins with silence is not waited for, one that goes on after a pause is.
                        let first_ns = if paused { round.now_ns.min(log_time_ns) } else { log_time_ns };
                        Schedule::new(now, first_ns, self.rate)
                    });
                    let due = schedule.due(log_time_ns);
                    if now >= due {
                        self.progress.late(now.saturating_duration_since(due));
                        return Ok(true);
                    }
                    round.advance(now, Some(log_time_ns));
                    (due - now).min(TURN)
                }
            };
            let wait = match &mut self.clock {
                Some(clock) => {
                    clock.tick(now, round.now_ns)?;
                    wait.min(clock.left(now))
                }
                None => wait,
            };
            host.idle(wait)?;
        }
    }

    /// A line of log for each tenth of the recording.
    fn tell_progress(&self, round: &mut Round) {
        let tenth = (self.progress.percent() / 10.0) as u32;
        if tenth >= round.next_tenth && self.progress.duration_s() > 0.0 {
            round.next_tenth = tenth + 1;
            self.log.info(&format!(
                "{} %: {:.1} of {:.1} s, {} messages",
                10 * tenth,
                self.progress.position_s(),
                self.progress.duration_s(),
                self.progress.total()
            ));
        }
    }
}
