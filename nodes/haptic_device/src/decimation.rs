//! When something that is measured more often than it is published is due.

/// Every n-th sample. Counted, not timed: a loop that is late and catches up loses none.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EveryNth {
    n: u32,
    left: u32,
}

impl EveryNth {
    /// Of samples at `rate_hz` as many as `wanted_hz` allows.
    pub(crate) fn of_rates(rate_hz: f64, wanted_hz: f64) -> EveryNth {
        // Rates are 1 to 4000; a wanted rate that is a hair below a divisor is that divisor.
        let n = (rate_hz / wanted_hz - 1e-6).ceil().clamp(1.0, 4000.0) as u32;
        EveryNth { n, left: 0 }
    }

    /// Number of samples for each one that is due.
    pub(crate) fn n(self) -> u32 {
        self.n
    }

    /// Whether this sample is due; the first one is.
    pub(crate) fn is_due(&mut self) -> bool {
        let is_due = self.left == 0;
        self.left = if is_due { self.n - 1 } else { self.left - 1 };
        is_due
    }
}

/// Due once in every period of a grid, with the first moment that is asked for in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Every {
    period_ns: u64,
    next_ns: Option<u64>,
}

impl Every {
    /// Once in `period_ns`.
    pub(crate) fn new(period_ns: u64) -> Every {
        Every { period_ns, next_ns: None }
    }

    /// Whether it is due now. A moment up to an eighth of the period early counts: moments jitter.
    pub(crate) fn is_due(&mut self, now_ns: u64) -> bool {
        self.is_due_or(false, now_ns)
    }

    /// Whether it is due now, for another reason maybe; the grid then begins anew.
    pub(crate) fn is_due_or(&mut self, anyway: bool, now_ns: u64) -> bool {
        let next_ns = self.next_ns.unwrap_or(now_ns);
        if anyway {
            self.next_ns = Some(now_ns + self.period_ns);
            return true;
        }
        if now_ns + self.period_ns / 8 < next_ns {
            return false;
        }
        // The grid stays, unless whole periods were missed: those are not made up for.
        let missed = now_ns.saturating_sub(next_ns) / self.period_ns.max(1);
        self.next_ns = Some(next_ns + (missed + 1) * self.period_ns);
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const US: u64 = 1000;

    #[test]
    fn of_four_thousand_samples_a_second_every_fourth_is_due_from_the_first_on() {
        let mut every = EveryNth::of_rates(4000.0, 1000.0);
        let due: Vec<u32> = (0..40).filter(|_| every.is_due()).collect();
        assert_eq!(due, (0..10).map(|i| 4 * i).collect::<Vec<_>>());
    }

    #[test]
    fn never_more_are_due_than_wanted_and_all_where_there_are_too_few() {
        let n = |rate, wanted| EveryNth::of_rates(rate, wanted).n();
        assert_eq!([n(1000.0, 1000.0), n(200.0, 1000.0), n(1500.0, 1000.0), n(4000.0, 1.0)], [1, 1, 2, 4000]);
        assert_eq!(n(3000.0, 1000.0 - 1e-10), 3);
    }

    #[test]
    fn a_grid_keeps_its_rate_although_moments_are_late() {
        let mut every = Every::new(1000 * US);
        let late = |i: u64| (i * 37 % 100) * US;
        let due: Vec<u64> = (0..400).filter(|i| every.is_due(5000 * US + i * 250 * US + late(*i))).collect();
        assert_eq!(due, (0..100).map(|i| 4 * i).collect::<Vec<_>>());
    }

    #[test]
    fn missed_periods_are_not_made_up_for() {
        let mut every = Every::new(1000 * US);
        assert!(every.is_due(0));
        assert!(every.is_due(10_500 * US));
        assert!(!every.is_due(10_600 * US));
        assert!(every.is_due(11_000 * US), "the grid stays");
    }

    #[test]
    fn another_reason_starts_the_grid_anew() {
        let mut every = Every::new(1000 * US);
        assert!(every.is_due(0) && every.is_due_or(true, 400 * US));
        assert!(!every.is_due(1000 * US));
        assert!(every.is_due(1400 * US));
    }
}
