//! Which commands are worth following by their stamps: not old, not from the future, not overtaken.

use std::fmt;

/// The stamps of one command topic.
#[derive(Clone, Debug)]
pub(crate) struct Freshness {
    limit_ns: i64,
    last_ns: Option<i64>,
}

/// Why a command is not followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Untimely {
    /// By so much, ns.
    Old(i64),
    /// By so much, ns.
    Ahead(i64),
    /// Another one with this stamp or a later one was followed before.
    Overtaken,
}

impl Freshness {
    /// Commands may be `limit_ns` old.
    pub(crate) fn new(limit_ns: i64) -> Freshness {
        Freshness { limit_ns, last_ns: None }
    }

    /// Judges a stamp by the clocks that its sender may have taken it from; the one that fits best counts. Stamp zero says
    /// nothing: the command is as old as its arrival.
    pub(crate) fn check(&mut self, stamp_ns: i64, clocks_ns: [i64; 2]) -> Result<(), Untimely> {
        if stamp_ns == 0 {
            return Ok(());
        }
        let ages_ns = clocks_ns.map(|now_ns| now_ns.saturating_sub(stamp_ns));
        let age_ns = if ages_ns[0].abs() <= ages_ns[1].abs() { ages_ns[0] } else { ages_ns[1] };
        if age_ns > self.limit_ns {
            return Err(Untimely::Old(age_ns));
        }
        if age_ns < -self.limit_ns {
            return Err(Untimely::Ahead(-age_ns));
        }
        if self.last_ns.is_some_and(|last_ns| stamp_ns <= last_ns) {
            return Err(Untimely::Overtaken);
        }
        self.last_ns = Some(stamp_ns);
        Ok(())
    }
}

impl fmt::Display for Untimely {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ms = |ns: i64| ns as f64 * 1e-6;
        match *self {
            Untimely::Old(age_ns) => write!(f, "its stamp is {:.1} ms old", ms(age_ns)),
            Untimely::Ahead(ns) => write!(f, "its stamp is {:.1} ms in the future", ms(ns)),
            Untimely::Overtaken => f.write_str("its stamp is not later than that of the command before"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: i64 = 1_000_000;
    const NOW: i64 = 1_700_000_000_000 * MS;

    fn check(freshness: &mut Freshness, stamp_ns: i64) -> Result<(), Untimely> {
        freshness.check(stamp_ns, [NOW, NOW])
    }

    #[test]
    fn a_command_is_followed_up_to_its_age_limit_and_not_beyond() {
        let mut freshness = Freshness::new(20 * MS);
        assert_eq!(check(&mut freshness, NOW - 20 * MS), Ok(()));
        assert_eq!(check(&mut freshness, NOW - 21 * MS), Err(Untimely::Old(21 * MS)));
        assert_eq!(check(&mut freshness, NOW + 21 * MS), Err(Untimely::Ahead(21 * MS)));
        assert_eq!(check(&mut freshness, i64::MIN), Err(Untimely::Old(i64::MAX)));
    }

    #[test]
    fn an_overtaken_command_is_not_followed_nor_the_same_one_twice() {
        let mut freshness = Freshness::new(20 * MS);
        assert_eq!(check(&mut freshness, NOW - 5 * MS), Ok(()));
        assert_eq!(check(&mut freshness, NOW - 5 * MS), Err(Untimely::Overtaken));
        assert_eq!(check(&mut freshness, NOW - 6 * MS), Err(Untimely::Overtaken));
        assert_eq!(check(&mut freshness, NOW - 4 * MS), Ok(()));
    }

    #[test]
    fn a_refused_stamp_from_the_future_does_not_block_what_comes_after() {
        let mut freshness = Freshness::new(20 * MS);
        assert!(check(&mut freshness, i64::MAX).is_err());
        assert_eq!(check(&mut freshness, NOW), Ok(()));
    }

    #[test]
    fn stamp_zero_is_a_client_that_sets_none() {
        let mut freshness = Freshness::new(20 * MS);
        assert_eq!(check(&mut freshness, 0), Ok(()));
        assert_eq!(check(&mut freshness, NOW), Ok(()));
        assert_eq!(check(&mut freshness, 0), Ok(()));
    }

    #[test]
    fn stamps_may_come_from_the_system_or_from_the_poses() {
        let mut freshness = Freshness::new(20 * MS);
        let hour = 3_600_000 * MS;
        assert_eq!(freshness.check(NOW + hour, [NOW, NOW + hour]), Ok(()));
        assert_eq!(Freshness::new(20 * MS).check(NOW, [NOW, NOW + hour]), Ok(()));
    }
}
