//! Median, 99th percentile and maximum of times.

/// Of a set of times, us.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Spread {
    pub(super) median_us: f64,
    pub(super) p99_us: f64,
    pub(super) max_us: f64,
}

impl Spread {
    /// Of times in ns; all zero when there are none.
    pub(super) fn of(times_ns: impl Iterator<Item = u64>) -> Spread {
        let mut times: Vec<u64> = times_ns.collect();
        times.sort_unstable();
        let at = |share: f64| {
            let place = (share * times.len().saturating_sub(1) as f64).ceil() as usize;
            times.get(place).map_or(0.0, |&time| time as f64 * 1e-3)
        };
        Spread { median_us: at(0.5), p99_us: at(0.99), max_us: at(1.0) }
    }
}

impl std::fmt::Display for Spread {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "median {:.1}, p99 {:.1}, max {:.1} us", self.median_us, self.p99_us, self.max_us)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_one_to_a_hundred_microseconds() {
        let spread = Spread::of((1..=100).rev().map(|us| us * 1000));
        assert_eq!(spread, Spread { median_us: 51.0, p99_us: 100.0, max_us: 100.0 });
        assert_eq!(Spread::of([7000].into_iter()), Spread { median_us: 7.0, p99_us: 7.0, max_us: 7.0 });
        assert_eq!(Spread::of(std::iter::empty()), Spread::default());
    }
}
