//! Time stamps for samples: the system's time, yet strictly rising and evenly flowing.

/// The share of elapsed time by which the stamps may run faster or slower than the monotonic clock to follow the system's.
/// Twice what time synchronisation uses when it slews (500 ppm).
const SLEW: f64 = 1e-3;

/// Turns readings of the monotonic clock into stamps near the system's clock (Unix time).
///
/// The system's clock may be set, forwards and backwards. A force whose age is measured by such a clock can be kept alive
/// for ever by one step back, so stamps flow with the monotonic clock and approach the system's time by at most 1 ms/s.
/// After a step of the system's clock, stamps differ from it until that is made up or the session starts again.
#[derive(Clone, Debug)]
pub(crate) struct StampClock {
    monotonic_ns: u64,
    stamp_ns: i64,
}

impl StampClock {
    /// A clock that agrees with both now.
    pub(crate) fn new(monotonic_ns: u64, system_ns: i64) -> StampClock {
        StampClock { monotonic_ns, stamp_ns: system_ns }
    }

    /// The stamp of a moment: later than every stamp before. RT safe.
    pub(crate) fn stamp(&mut self, monotonic_ns: u64, system_ns: i64) -> i64 {
        let elapsed_ns = monotonic_ns.saturating_sub(self.monotonic_ns).min(i64::MAX as u64) as i64;
        let even_ns = self.stamp_ns.saturating_add(elapsed_ns);
        let most_ns = (elapsed_ns as f64 * SLEW) as i64;
        let error_ns = system_ns.saturating_sub(even_ns).clamp(-most_ns, most_ns);
        self.monotonic_ns = self.monotonic_ns.max(monotonic_ns);
        self.stamp_ns = even_ns.saturating_add(error_ns).max(self.stamp_ns + 1);
        self.stamp_ns
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const MS: i64 = 1_000_000;

    #[test]
    fn stamps_follow_a_system_clock_that_drifts_as_time_synchronisation_does() {
        let mut clock = StampClock::new(0, 0);
        for i in 1..=10_000i64 {
            let system_ns = i * MS + i * 500; // 500 ppm fast
            assert!((clock.stamp((i * MS) as u64, system_ns) - system_ns).abs() < 2);
        }
    }

    #[test]
    fn a_system_clock_set_back_an_hour_neither_stops_nor_reverses_the_stamps() {
        let mut clock = StampClock::new(0, 10_000_000 * MS);
        let before = clock.stamp(MS as u64, 10_000_001 * MS);
        let after = clock.stamp(1001 * MS as u64, 10_001_001 * MS - 3_600_000 * MS);
        let elapsed = after - before;
        assert!((999 * MS..=1001 * MS).contains(&elapsed), "{elapsed}");
    }

    proptest! {
        #[test]
        fn stamps_strictly_rise_whatever_the_clocks_say(
            readings in prop::collection::vec((any::<u32>(), -1_000_000_000_000i64..1_000_000_000_000_000), 1..100),
        ) {
            let mut clock = StampClock::new(0, 0);
            let mut last = 0;
            for (monotonic_ns, system_ns) in readings {
                let stamp = clock.stamp(u64::from(monotonic_ns), system_ns);
                prop_assert!(stamp > last);
                last = stamp;
            }
        }
    }
}
