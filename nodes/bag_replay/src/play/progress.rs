//! How far a replay is, written by the player and read by whoever reports.

use std::sync::atomic::{AtomicU64, Ordering};

use node_kit::{Level, Status};
use recording::Recording;
use serde_json::json;

use super::control::Mode;
use super::settings::PlaySettings;

/// Numbers of a replay, in any thread.
pub(crate) struct Progress {
    /// Messages sent, by the number of the topic.
    sent: Vec<AtomicU64>,
    /// Places of the recording that cannot be read.
    unreadable: AtomicU64,
    /// Messages that are not what their topic says.
    broken: AtomicU64,
    latest_us: AtomicU64,
    position_ns: AtomicU64,
    rounds: AtomicU64,
    /// First and last log time of what is played.
    first_ns: u64,
    last_ns: u64,
}

impl Progress {
    pub(crate) fn new(recording: &Recording, settings: &PlaySettings) -> Self {
        let (first_ns, last_ns) = recording.log_time_bounds_ns().unwrap_or_default();
        let ns = |duration: std::time::Duration| u64::try_from(duration.as_nanos()).unwrap_or(u64::MAX);
        let first_ns = first_ns.saturating_add(ns(settings.start));
        let end_ns = settings.duration.map_or(u64::MAX, |duration| first_ns.saturating_add(ns(duration)));
        let count = || AtomicU64::new(0);
        Self {
            sent: recording.topics().iter().map(|_| count()).collect(),
            unreadable: count(),
            broken: count(),
            latest_us: count(),
            position_ns: AtomicU64::new(first_ns),
            rounds: count(),
            first_ns,
            last_ns: last_ns.min(end_ns).max(first_ns),
        }
    }

    /// First log time of what is played, ns since 1970.
    pub(crate) fn first_ns(&self) -> u64 {
        self.first_ns
    }

    /// A round begins; how many have begun.
    pub(crate) fn begin_round(&self) -> u64 {
        self.position_ns.store(self.first_ns, Ordering::Relaxed);
        self.rounds.fetch_add(1, Ordering::Relaxed) + 1
    }

    /// A message of a topic was sent.
    pub(crate) fn sent(&self, topic: usize) {
        if let Some(count) = self.sent.get(topic) {
            count.fetch_add(1, Ordering::Relaxed);
        }
    }

    /// The replay has come to this log time.
    pub(crate) fn reach(&self, log_time_ns: u64) {
        self.position_ns.fetch_max(log_time_ns, Ordering::Relaxed);
    }

    /// Counts a place that cannot be read; how many there were before.
    pub(crate) fn unreadable(&self) -> u64 {
        self.unreadable.fetch_add(1, Ordering::Relaxed)
    }

    /// Counts a message that is left out; how many there were before.
    pub(crate) fn broken(&self) -> u64 {
        self.broken.fetch_add(1, Ordering::Relaxed)
    }

    /// A message was sent this long after it was due.
    pub(crate) fn late(&self, by: std::time::Duration) {
        let late_us = u64::try_from(by.as_micros()).unwrap_or(u64::MAX);
        self.latest_us.fetch_max(late_us, Ordering::Relaxed);
    }

    /// Messages sent.
    pub(crate) fn total(&self) -> u64 {
        self.sent.iter().map(|count| count.load(Ordering::Relaxed)).sum()
    }

    /// Share of the recorded time that is played, in percent.
    pub(crate) fn percent(&self) -> f64 {
        let (position_s, duration_s) = (self.position_s(), self.duration_s());
        if duration_s > 0.0 { (100.0 * position_s / duration_s).min(100.0) } else { 100.0 }
    }

    /// Recorded time since the start.
    pub(crate) fn position_s(&self) -> f64 {
        let position_ns = self.position_ns.load(Ordering::Relaxed).min(self.last_ns);
        position_ns.saturating_sub(self.first_ns) as f64 * 1e-9
    }

    /// Recorded time that is played in a round.
    pub(crate) fn duration_s(&self) -> f64 {
        (self.last_ns - self.first_ns) as f64 * 1e-9
    }

    /// For diagnostics.
    pub(crate) fn status(&self, mode: Mode) -> Status {
        let state = if mode == Mode::Playing { "playing" } else { "paused" };
        let left_out = self.unreadable.load(Ordering::Relaxed) + self.broken.load(Ordering::Relaxed);
        let level = if left_out == 0 { Level::Ok } else { Level::Warn };
        let summary = if left_out == 0 { state.to_owned() } else { format!("{state}; damage is left out") };
        Status::new(level, "replay", summary)
            .with("state", state)
            .with("position_s", format_args!("{:.3}", self.position_s()))
            .with("duration_s", format_args!("{:.3}", self.duration_s()))
            .with("percent", format_args!("{:.1}", self.percent()))
            .with("rounds", self.rounds.load(Ordering::Relaxed))
            .with("messages", self.total())
            .with("unreadable_places", self.unreadable.load(Ordering::Relaxed))
            .with("broken_messages", self.broken.load(Ordering::Relaxed))
            .with("latest_ms", self.latest_us.load(Ordering::Relaxed) as f64 * 1e-3)
    }

    /// Messages sent of each topic, by the number of the topic.
    pub(crate) fn counts(&self) -> impl Iterator<Item = u64> {
        self.sent.iter().map(|count| count.load(Ordering::Relaxed))
    }

    /// For the closing report; `damage` is what was found on opening.
    pub(crate) fn report(&self, damage: usize) -> serde_json::Value {
        json!({
            "messages": self.total(),
            "rounds": self.rounds.load(Ordering::Relaxed),
            "unreadable_places": damage as u64 + self.unreadable.load(Ordering::Relaxed),
            "broken_messages": self.broken.load(Ordering::Relaxed),
            "latest_ms": self.latest_us.load(Ordering::Relaxed) as f64 * 1e-3,
        })
    }
}
