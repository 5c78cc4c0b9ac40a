//! How long something took, over a whole session, in fixed memory.

use std::time::Duration;

/// Buckets for each doubling of the duration.
const PER_OCTAVE: usize = 16;
const BUCKETS: usize = 64 * PER_OCTAVE;

/// Counts of durations in buckets of one part in sixteen; quantiles are as exact as a bucket is wide (6 %).
#[derive(Clone, Debug)]
pub struct Histogram {
    counts: Box<[u64]>,
    total: u64,
    longest_ns: u64,
}

impl Default for Histogram {
    fn default() -> Histogram {
        Histogram { counts: vec![0; BUCKETS].into_boxed_slice(), total: 0, longest_ns: 0 }
    }
}

impl Histogram {
    /// Count one duration. Allocates nothing.
    pub fn record(&mut self, duration: Duration) {
        let ns = u64::try_from(duration.as_nanos()).unwrap_or(u64::MAX);
        if let Some(count) = self.counts.get_mut(bucket(ns)) {
            *count += 1;
        }
        self.total += 1;
        self.longest_ns = self.longest_ns.max(ns);
    }

    /// Number of durations counted.
    pub fn total(&self) -> u64 {
        self.total
    }

    /// The longest one, exactly, in microseconds; none before the first.
    pub fn longest_us(&self) -> Option<f64> {
        (self.total > 0).then(|| self.longest_ns as f64 / 1000.0)
    }

    /// The duration in microseconds that a share of all stay below (0.5: the median); none before the first.
    pub fn quantile_us(&self, share: f64) -> Option<f64> {
        let rank = ((self.total as f64 * share).ceil() as u64).clamp(1, self.total.max(1));
        let mut below = 0;
        let bucket = self.counts.iter().position(|count| {
            below += count;
            below >= rank
        })?;
        Some(upper_end_ns(bucket).min(self.longest_ns as f64) / 1000.0)
    }
}

/// Buckets of width 1 ns up to 16 ns, then sixteen in each octave.
fn bucket(ns: u64) -> usize {
    let octave = ns.max(1).ilog2().saturating_sub(PER_OCTAVE.ilog2());
    octave as usize * PER_OCTAVE + (ns >> octave) as usize
}

fn upper_end_ns(bucket: usize) -> f64 {
    // From the second octave on a bucket's number carries the leading one of its values.
    let octave = (bucket / PER_OCTAVE).saturating_sub(1);
    let leading = bucket - octave * PER_OCTAVE;
    (leading as f64 + 1.0) * (octave as f64).exp2()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_duration_falls_into_the_bucket_whose_end_is_just_above_it() {
        for ns in (0..5000).chain([123_456, 99_999_999, 7_777_777_777]) {
            let end = upper_end_ns(bucket(ns));
            assert!((ns as f64) < end && end <= ns as f64 * 1.0625 + 1.0, "{ns}: {end}");
        }
        assert!(bucket(u64::MAX) < BUCKETS);
    }

    #[test]
    fn quantiles_of_a_known_distribution_come_out_within_a_bucket() {
        let mut histogram = Histogram::default();
        assert_eq!((histogram.quantile_us(0.5), histogram.longest_us()), (None, None));
        (1..=1000).for_each(|us| histogram.record(Duration::from_micros(us)));
        for (share, expected_us) in [(0.5, 500.0), (0.99, 990.0), (0.001, 1.0)] {
            let found_us = histogram.quantile_us(share).unwrap();
            assert!((found_us / expected_us - 1.0).abs() < 0.07, "{share}: {found_us}");
        }
        assert_eq!(histogram.longest_us(), Some(1000.0));
        assert_eq!(histogram.quantile_us(1.0), Some(1000.0), "never beyond the longest");
        assert_eq!(histogram.total(), 1000);
    }
}
