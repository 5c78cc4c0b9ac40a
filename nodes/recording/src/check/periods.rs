//! How evenly the messages of a topic came: rate, gaps, order of the log times.

use serde::Serialize;

/// A gap is a distance between neighbours of more than this many median distances.
const GAP_PERIODS: u64 = 3;

/// The largest distance between two consecutive messages.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Gap {
    /// Log time of the message in front of it, ns since 1970.
    pub after_ns: u64,
    /// How long it is, ns.
    pub length_ns: u64,
}

/// Log times of a topic.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Periods {
    /// Messages per second from the first to the last; `None` for fewer than two or all at once.
    pub mean_rate_hz: Option<f64>,
    /// Median distance of consecutive messages, ns; `None` for fewer than two.
    pub median_ns: Option<u64>,
    /// `None` for fewer than two messages.
    pub largest_gap: Option<Gap>,
    /// Distances longer than three times the median.
    pub gaps: u64,
    /// Messages stored behind one with a later log time.
    pub log_times_back: u64,
}

/// Collects log times in stored order.
#[derive(Debug, Default)]
pub(super) struct Times {
    times_ns: Vec<u64>,
    latest_ns: u64,
    back: u64,
}

impl Times {
    pub(super) fn take(&mut self, log_time_ns: u64) {
        // Doubling would take twice the memory; an eighth at a time is nearly as quick.
        if self.times_ns.len() == self.times_ns.capacity() {
            self.times_ns.reserve_exact((self.times_ns.len() / 8).max(64));
        }
        self.times_ns.push(log_time_ns);
        if log_time_ns < self.latest_ns {
            self.back += 1;
        }
        self.latest_ns = self.latest_ns.max(log_time_ns);
    }

    pub(super) fn bounds_ns(&self) -> Option<(u64, u64)> {
        Some((self.times_ns.iter().copied().min()?, self.latest_ns))
    }

    pub(super) fn finish(self) -> Periods {
        let mut times = self.times_ns;
        if self.back > 0 {
            times.sort_unstable();
        }
        let mut largest: Option<Gap> = None;
        for pair in times.windows(2) {
            let &[after_ns, next_ns] = pair else { continue };
            let length_ns = next_ns - after_ns;
            if largest.is_none_or(|largest| length_ns > largest.length_ns) {
                largest = Some(Gap { after_ns, length_ns });
            }
        }
        let span_ns = times.last().zip(times.first()).map_or(0, |(last, first)| last - first);
        let mean_rate_hz = (span_ns > 0).then(|| (times.len() - 1) as f64 * 1e9 / span_ns as f64);
        // In place: the distances take the room of the times.
        let count = times.len().saturating_sub(1);
        for place in 0..count {
            if let Some(&[time, next]) = times.get(place..place + 2).and_then(|pair| pair.first_chunk::<2>())
                && let Some(slot) = times.get_mut(place)
            {
                *slot = next - time;
            }
        }
        times.truncate(count);
        let median_ns = (count > 0).then(|| *times.select_nth_unstable(count / 2).1);
        let gaps = match median_ns {
            // Without a rhythm there is nothing to miss.
            None | Some(0) => 0,
            Some(median) => {
                let longest = median.saturating_mul(GAP_PERIODS);
                times.iter().filter(|distance| **distance > longest).count() as u64
            }
        };
        Periods { mean_rate_hz, median_ns, largest_gap: largest, gaps, log_times_back: self.back }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(times: &[u64]) -> Periods {
        let mut collected = Times::default();
        times.iter().for_each(|time| collected.take(*time));
        collected.finish()
    }

    #[test]
    fn a_gap_is_longer_than_three_median_periods_and_the_largest_says_where_it_is() {
        let found = of(&[0, 10, 20, 30, 61, 71, 101, 111, 121]);
        assert_eq!(found.median_ns, Some(10));
        assert_eq!(found.gaps, 1, "31 is a gap, 30 is none");
        assert_eq!(found.largest_gap, Some(Gap { after_ns: 30, length_ns: 31 }));
        let rate = found.mean_rate_hz.unwrap();
        assert!((rate - 8.0 / 121e-9).abs() < 1.0, "{rate}");
    }

    #[test]
    fn messages_stored_out_of_order_are_counted_and_make_no_gaps() {
        let found = of(&[0, 10, 50, 20, 30, 40]);
        assert_eq!((found.log_times_back, found.gaps), (3, 0));
        assert_eq!(found.largest_gap, Some(Gap { after_ns: 0, length_ns: 10 }));
    }

    #[test]
    fn few_or_simultaneous_messages_have_no_rate() {
        assert_eq!(of(&[]).mean_rate_hz, None);
        assert_eq!(of(&[5]).median_ns, None);
        let at_once = of(&[7, 7, 7]);
        assert_eq!((at_once.mean_rate_hz, at_once.median_ns, at_once.gaps), (None, Some(0), 0));
        assert_eq!(of(&[0, u64::MAX]).largest_gap, Some(Gap { after_ns: 0, length_ns: u64::MAX }));
    }
}
