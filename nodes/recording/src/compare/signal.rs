//! Two signals over time in bounded memory: least and greatest value in bins that widen as the recording goes on.

use std::collections::BTreeMap;

/// Most bins of a signal.
const MOST_BINS: usize = 2000;

/// A number of the golden and of the computed messages of a topic over their stamps.
#[derive(Debug, Clone, PartialEq)]
pub struct Signal {
    /// What it is: `|force|`, `depth`, `largest displacement`.
    pub quantity: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// By time, each with at least one message; at most 2000.
    pub bins: Vec<Bin>,
}

/// What happened in a stretch of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bin {
    /// Begin of the stretch, ns since 1970 by stamp.
    pub start_ns: i64,
    /// Behind its end.
    pub end_ns: i64,
    /// Least and greatest golden value; `None` without a message in it.
    pub golden: Option<(f64, f64)>,
    /// The same of the computed messages.
    pub computed: Option<(f64, f64)>,
    /// The same of computed minus golden, over messages that belong together.
    pub difference: Option<(f64, f64)>,
}

/// Collects a [`Signal`].
#[derive(Debug, Default)]
pub(super) struct Bins {
    /// A bin is 2^shift ns wide.
    shift: u32,
    /// By stamp >> shift.
    done: BTreeMap<i64, Ranges>,
    /// Where the last value went: messages come by time, mostly.
    current: Option<(i64, Ranges)>,
}

#[derive(Debug, Clone, Copy, Default)]
struct Ranges {
    golden: Range,
    computed: Range,
    difference: Range,
}

#[derive(Debug, Clone, Copy)]
struct Range {
    low: f64,
    high: f64,
}

impl Bins {
    /// Adds what a golden and a computed message say; NaN adds nothing.
    pub(super) fn add(&mut self, stamp_ns: i64, golden: f64, computed: f64) {
        let key = stamp_ns >> self.shift;
        if self.current.is_none_or(|(current, _)| current != key) {
            self.go_to(key);
        }
        let (_, ranges) = self.current.get_or_insert_with(|| (stamp_ns >> self.shift, Ranges::default()));
        ranges.golden.add(golden);
        ranges.computed.add(computed);
        ranges.difference.add(computed - golden);
    }

    fn go_to(&mut self, key: i64) {
        self.put_back();
        self.current = self.done.remove(&key).map(|ranges| (key, ranges));
        while self.done.len() >= MOST_BINS {
            self.put_back();
            self.shift += 1;
            let narrow = std::mem::take(&mut self.done);
            for (key, ranges) in narrow {
                self.done.entry(key >> 1).or_default().join(&ranges);
            }
        }
    }

    fn put_back(&mut self) {
        if let Some((key, ranges)) = self.current.take() {
            self.done.entry(key).or_default().join(&ranges);
        }
    }

    pub(super) fn finish(mut self, (quantity, unit): (&'static str, &'static str)) -> Signal {
        self.put_back();
        let shift = self.shift;
        let bins = self.done.into_iter().map(|(key, ranges)| Bin {
            start_ns: key << shift,
            end_ns: (key << shift).saturating_add(1 << shift),
            golden: ranges.golden.ends(),
            computed: ranges.computed.ends(),
            difference: ranges.difference.ends(),
        });
        Signal { quantity, unit, bins: bins.collect() }
    }
}

impl Ranges {
    fn join(&mut self, other: &Self) {
        for (own, other) in [
            (&mut self.golden, other.golden),
            (&mut self.computed, other.computed),
            (&mut self.difference, other.difference),
        ] {
            own.low = own.low.min(other.low);
            own.high = own.high.max(other.high);
        }
    }
}

impl Range {
    /// `min` and `max` pass over a NaN.
    fn add(&mut self, value: f64) {
        self.low = self.low.min(value);
        self.high = self.high.max(value);
    }

    fn ends(self) -> Option<(f64, f64)> {
        (self.low <= self.high).then_some((self.low, self.high))
    }
}

impl Default for Range {
    fn default() -> Self {
        Self { low: f64::INFINITY, high: f64::NEG_INFINITY }
    }
}

#[cfg(test)]
mod tests {
    use super::{Bins, MOST_BINS};

    #[test]
    fn an_hour_is_in_few_bins_that_keep_every_peak() {
        let mut bins = Bins::default();
        for number in 0..3_600_000_i64 {
            let value = if number == 1_234_567 { 7.0 } else { 0.5 };
            bins.add(1_700_000_000_000_000_000 + number * 1_000_000, value, -value);
        }
        let signal = bins.finish(("depth", "m"));
        assert!((MOST_BINS / 2 - 1..=MOST_BINS).contains(&signal.bins.len()), "{}", signal.bins.len());
        let peaks: Vec<_> = signal.bins.iter().filter(|bin| bin.golden == Some((0.5, 7.0))).collect();
        assert_eq!(peaks.len(), 1);
        let peak_ns = 1_700_000_000_000_000_000 + 1_234_567 * 1_000_000;
        assert!((peaks[0].start_ns..peaks[0].end_ns).contains(&peak_ns));
        assert_eq!(peaks[0].difference, Some((-14.0, -1.0)));
        assert!(signal.bins.is_sorted_by_key(|bin| bin.start_ns));
    }

    #[test]
    fn stamps_that_jump_anywhere_end_in_bounded_memory() {
        let mut bins = Bins::default();
        for number in 0..100_000_i64 {
            bins.add(number.wrapping_mul(0x9e37_79b9_7f4a_7c15_u64 as i64), 1.0, f64::NAN);
        }
        for stamp_ns in [i64::MIN, i64::MAX, 0, -1] {
            bins.add(stamp_ns, 1.0, f64::NAN);
        }
        let signal = bins.finish(("depth", "m"));
        assert!(!signal.bins.is_empty() && signal.bins.len() <= MOST_BINS);
        assert!(signal.bins.iter().all(|bin| bin.computed.is_none() && bin.difference.is_none()));
    }
}
