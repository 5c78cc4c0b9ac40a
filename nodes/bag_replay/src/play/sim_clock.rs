//! `/clock`: the time of the recording, for nodes with `use_sim_time`.

use std::time::{Duration, Instant};

use node_kit::{PublishError, Publisher, convert};
use r2r::rosgraph_msgs::msg::Clock;

/// Publishes the time at most once in a period of the steady clock, or when told to.
pub(crate) struct SimClock {
    publisher: Publisher<Clock>,
    period: Duration,
    due: Option<Instant>,
}

impl SimClock {
    pub(crate) fn new(publisher: Publisher<Clock>, period: Duration) -> Self {
        Self { publisher, period, due: None }
    }

    /// Says what time it is, ns since 1970, if it is time to say so.
    pub(crate) fn tick(&mut self, now: Instant, time_ns: u64) -> Result<(), PublishError> {
        if self.left(now).is_zero() { self.tell(now, time_ns) } else { Ok(()) }
    }

    /// Says what time it is now.
    pub(crate) fn tell(&mut self, now: Instant, time_ns: u64) -> Result<(), PublishError> {
        // A player that was held up does not make up for what it missed.
        let next = self.due.map_or(now, |due| due + self.period);
        self.due = Some(if next <= now { now + self.period } else { next.min(now + self.period) });
        let time_ns = i64::try_from(time_ns).unwrap_or(i64::MAX);
        self.publisher.publish(&Clock { clock: convert::stamp(time_ns) })
    }

    /// How long until it is time again.
    pub(crate) fn left(&self, now: Instant) -> Duration {
        self.due.map_or(Duration::ZERO, |due| due.saturating_duration_since(now))
    }
}
