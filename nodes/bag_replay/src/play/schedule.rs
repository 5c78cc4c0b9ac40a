//! When a recorded message is due: the spacing of the recording, divided by the rate.

use std::time::{Duration, Instant};

/// Maps log times to moments of the steady clock.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Schedule {
    start: Instant,
    first_ns: u64,
    rate: f64,
}

impl Schedule {
    /// The message logged at `first_ns` is due at `start`. `rate` 2 is twice as fast as recorded.
    pub(crate) fn new(start: Instant, first_ns: u64, rate: f64) -> Self {
        Self { start, first_ns, rate }
    }

    /// When a message is due. What is logged before the first one is due at once; the year 2500 is as good as never.
    pub(crate) fn due(&self, log_time_ns: u64) -> Instant {
        const LONGEST: Duration = Duration::from_secs(500 * 365 * 86_400);
        let offset_s = log_time_ns.saturating_sub(self.first_ns) as f64 * 1e-9 / self.rate;
        self.start + Duration::try_from_secs_f64(offset_s).unwrap_or(LONGEST).min(LONGEST)
    }

    /// The time of the recording, ns since 1970.
    pub(crate) fn time_ns(&self, now: Instant) -> u64 {
        let played_ns = now.saturating_duration_since(self.start).as_nanos() as f64 * self.rate;
        self.first_ns.saturating_add(played_ns as u64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spacing_is_kept_and_divided_by_the_rate() {
        let start = Instant::now();
        let at = |rate, log_time_ns| {
            Schedule::new(start, 1_700_000_000_000_000_000, rate).due(log_time_ns) - start
        };
        assert_eq!(at(1.0, 1_700_000_000_250_000_000), Duration::from_millis(250));
        assert_eq!(at(2.0, 1_700_000_001_000_000_000), Duration::from_millis(500));
        assert_eq!(at(0.5, 1_700_000_001_000_000_000), Duration::from_secs(2));
        assert_eq!(at(1.0, 0), Duration::ZERO);
        assert!(at(0.01, u64::MAX) > Duration::from_secs(86_400));
    }

    #[test]
    fn the_time_of_the_recording_goes_on_at_the_rate() {
        let start = Instant::now();
        let schedule = Schedule::new(start, 5_000_000_000, 0.5);
        assert_eq!(schedule.time_ns(start), 5_000_000_000);
        assert_eq!(schedule.time_ns(start + Duration::from_secs(4)), 7_000_000_000);
    }
}
