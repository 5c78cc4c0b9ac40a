//! A rate that is counted by stamps, so that a recording is replayed with the same outputs.

/// Says at which stamps something that happens at a rate is due.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StampRate {
    period_ns: i64,
    due_ns: Option<i64>,
}

impl StampRate {
    /// `rate_hz` times in each second of stamps; none for a rate that is not above zero.
    #[must_use]
    pub fn new(rate_hz: f64) -> Option<Self> {
        // The cast saturates: a period beyond i64 is for ever.
        (rate_hz > 0.0).then(|| Self { period_ns: ((1e9 / rate_hz) as i64).max(1), due_ns: None })
    }

    /// Whether it is due at this stamp, and if so, when it is due next. The average rate is kept however the stamps are
    /// spaced; periods without a stamp are not made up for. Stamps that go back start anew once they are a period back: also
    /// where every one goes back it is due at its rate and not at each.
    pub fn is_due(&mut self, stamp_ns: i64) -> bool {
        let next_ns = match self.due_ns {
            Some(due_ns)
                if stamp_ns < due_ns
                    && due_ns.saturating_sub(stamp_ns) < self.period_ns.saturating_mul(2) =>
            {
                return false;
            }
            Some(due_ns) if stamp_ns >= due_ns => due_ns.saturating_add(self.period_ns),
            _ => stamp_ns,
        };
        let next_ns = if next_ns > stamp_ns { next_ns } else { stamp_ns.saturating_add(self.period_ns) };
        self.due_ns = Some(next_ns);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: i64 = 1_000_000;

    #[test]
    fn a_thousand_poses_give_the_rate_and_not_a_divisor_of_a_thousand() {
        let mut rate = StampRate::new(60.0).unwrap();
        let due = (0..10_000).filter(|ms| rate.is_due(ms * MS)).count();
        assert_eq!(due, 600);
    }

    #[test]
    fn a_gap_is_not_made_up_for_and_time_that_goes_back_starts_anew() {
        let mut rate = StampRate::new(100.0).unwrap();
        assert!(rate.is_due(0));
        assert!(!rate.is_due(9 * MS));
        assert!(rate.is_due(1000 * MS));
        assert!(!rate.is_due(1001 * MS));
        assert!(rate.is_due(5 * MS), "ten minutes back is not ten minutes of silence");
        assert!(!rate.is_due(14 * MS));
        assert!(rate.is_due(15 * MS));
    }

    #[test]
    fn stamps_that_all_go_back_give_the_rate_as_well() {
        let mut rate = StampRate::new(100.0).unwrap();
        let due = (0..1000).rev().filter(|ms| rate.is_due(ms * MS)).count();
        assert_eq!(due, 100);
        let mut rate = StampRate::new(100.0).unwrap();
        let due = (0..1000).filter(|ms| rate.is_due((ms - 3 * (ms % 2)) * MS)).count();
        assert!((99..=101).contains(&due), "{due} with every other stamp going back");
    }

    #[test]
    fn extreme_rates_and_stamps_neither_overflow_nor_stall() {
        assert_eq!(StampRate::new(0.0), None);
        assert_eq!(StampRate::new(f64::NAN), None);
        let mut rare = StampRate::new(1e-300).unwrap();
        assert!(rare.is_due(0) && !rare.is_due(i64::MAX - 1));
        let mut often = StampRate::new(1e300).unwrap();
        assert!(often.is_due(i64::MIN) && often.is_due(i64::MIN + 1) && often.is_due(i64::MAX));
    }
}
