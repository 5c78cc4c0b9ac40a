//! Which commands are worth following by their stamps: not old, not from the future, not overtaken; and how old they are.

use std::fmt;

/// The stamps of one command topic.
#[derive(Clone, Debug)]
pub(crate) struct Freshness {
    limit_ns: i64,
    /// Stamp and arrival, by the monotonic clock, of the last command that was followed.
    last: Option<(i64, u64)>,
}

/// Turns that empty what has waited: after a turn that was long in coming, until one had to wait for its message.
#[derive(Clone, Debug)]
pub(crate) struct Backlog {
    away_ns: u64,
    turn_ns: u64,
    ended_ns: Option<u64>,
    has_waited: bool,
}

/// A turn that waits shorter than this found a message that was there before it, ns.
const SHORTEST_WAIT_NS: u64 = 300_000;

impl Backlog {
    /// Turns that are `away_ns` apart are long in coming.
    pub(crate) fn new(away_ns: u64) -> Backlog {
        Backlog { away_ns, turn_ns: 0, ended_ns: None, has_waited: true }
    }

    pub(crate) fn begin_turn(&mut self, now_ns: u64) {
        self.turn_ns = now_ns;
        let Some(ended_ns) = self.ended_ns else { return };
        let waited_ns = now_ns.saturating_sub(ended_ns);
        if waited_ns > self.away_ns {
            self.has_waited = false;
        } else if waited_ns >= SHORTEST_WAIT_NS {
            self.has_waited = true;
        }
    }

    pub(crate) fn end_turn(&mut self, now_ns: u64) {
        self.ended_ns = Some(now_ns);
    }
}

/// Since when commands count, by the monotonic clock. A command is as old as its stamp says, however it was delayed on
/// its way; and each counts from later than the one before, because the motor loop takes what does not for overtaken.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Since {
    last_ns: u64,
}

impl Since {
    /// For a command that is so old now.
    pub(crate) fn of(&mut self, now_ns: u64, age_ns: u64) -> u64 {
        self.last_ns = now_ns.saturating_sub(age_ns).max(self.last_ns.saturating_add(1));
        self.last_ns
    }
}

/// Why a command is not followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Untimely {
    /// By so much, ns.
    Old(i64),
    /// By so much, ns.
    Ahead(i64),
    /// Without a stamp, and among others that had waited for a node that was away.
    Backlog,
    /// Another one with this stamp or a later one was followed before.
    Overtaken,
}

impl Freshness {
    /// Commands may be `limit_ns` old.
    pub(crate) fn new(limit_ns: i64) -> Freshness {
        Freshness { limit_ns, last: None }
    }

    /// Judges a stamp by the clocks that its sender may have taken it from; the one that fits best counts. How old the
    /// command is, ns. Stamp zero says nothing: the command is as old as its arrival, unless it has waited in the queue of
    /// a node that was away. The order matters only among commands that could both still be followed: the system's clock
    /// may be set back.
    pub(crate) fn check(
        &mut self,
        stamp_ns: i64,
        clocks_ns: &[i64],
        backlog: &Backlog,
    ) -> Result<u64, Untimely> {
        if stamp_ns == 0 {
            return if backlog.has_waited { Ok(0) } else { Err(Untimely::Backlog) };
        }
        let age_ns = age_ns(stamp_ns, clocks_ns);
        if age_ns > self.limit_ns {
            return Err(Untimely::Old(age_ns));
        }
        if age_ns < -self.limit_ns {
            return Err(Untimely::Ahead(-age_ns));
        }
        let arrived_ns = backlog.turn_ns;
        let still_counts_ns = self.limit_ns.unsigned_abs().saturating_mul(2);
        if self.last.is_some_and(|(last_ns, at_ns)| {
            stamp_ns <= last_ns && arrived_ns.saturating_sub(at_ns) <= still_counts_ns
        }) {
            return Err(Untimely::Overtaken);
        }
        self.last = Some((stamp_ns, arrived_ns));
        // A little from the future is a clock that goes ahead, and no command.
        Ok(u64::try_from(age_ns).unwrap_or(0))
    }
}

/// The age of a stamp, ns, by the clock that fits best; negative: it is in the future.
pub(crate) fn age_ns(stamp_ns: i64, clocks_ns: &[i64]) -> i64 {
    let ages_ns = clocks_ns.iter().map(|now_ns| now_ns.saturating_sub(stamp_ns));
    ages_ns.min_by_key(|age_ns| age_ns.saturating_abs()).unwrap_or(i64::MAX)
}

impl fmt::Display for Untimely {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ms = |ns: i64| ns as f64 * 1e-6;
        match *self {
            Untimely::Old(age_ns) => write!(f, "its stamp is {:.1} ms old", ms(age_ns)),
            Untimely::Ahead(ns) => write!(f, "its stamp is {:.1} ms in the future", ms(ns)),
            Untimely::Backlog => {
                f.write_str("it has no stamp and has waited with others for this node, which was busy")
            }
            Untimely::Overtaken => f.write_str("its stamp is not later than that of the command before"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: i64 = 1_000_000;
    const NOW: i64 = 1_700_000_000_000 * MS;

    fn check(freshness: &mut Freshness, stamp_ns: i64) -> Result<u64, Untimely> {
        freshness.check(stamp_ns, &[NOW, NOW], &Backlog::new(20 * MS as u64))
    }

    /// A backlog after turns at these times, ms, each of which takes no time.
    fn turns_at(times_ms: &[f64]) -> Backlog {
        let mut backlog = Backlog::new(20 * MS as u64);
        for time_ms in times_ms {
            backlog.begin_turn((time_ms * 1e6) as u64);
            backlog.end_turn((time_ms * 1e6) as u64);
        }
        backlog
    }

    #[test]
    fn unstamped_commands_that_waited_for_a_node_that_was_away_are_not_followed() {
        let mut freshness = Freshness::new(20 * MS);
        let mut unstamped = |times_ms: &[f64]| freshness.check(0, &[NOW, NOW], &turns_at(times_ms));
        assert_eq!(unstamped(&[0.0, 1.0, 2.0]), Ok(0));
        assert_eq!(unstamped(&[0.0, 800.0]), Err(Untimely::Backlog));
        assert_eq!(unstamped(&[0.0, 800.0, 800.1, 800.2]), Err(Untimely::Backlog));
        assert_eq!(
            unstamped(&[0.0, 800.0, 800.1, 801.1, 801.2]),
            Ok(0),
            "a turn has waited: the queue was empty"
        );
    }

    #[test]
    fn a_clock_that_was_set_back_blocks_nobody_for_longer_than_a_command_lives() {
        let mut freshness = Freshness::new(20 * MS);
        let hour = 3_600_000 * MS;
        assert_eq!(freshness.check(NOW, &[NOW, NOW], &turns_at(&[0.0])), Ok(0));
        let earlier = NOW - hour;
        assert_eq!(freshness.check(earlier, &[earlier, NOW], &turns_at(&[1.0])), Err(Untimely::Overtaken));
        assert_eq!(freshness.check(earlier, &[earlier, NOW], &turns_at(&[41.0])), Ok(0));
    }

    #[test]
    fn a_command_is_followed_up_to_its_age_limit_and_not_beyond() {
        let mut freshness = Freshness::new(20 * MS);
        assert_eq!(check(&mut freshness, NOW - 20 * MS), Ok(20 * MS as u64));
        assert_eq!(check(&mut freshness, NOW - 21 * MS), Err(Untimely::Old(21 * MS)));
        assert_eq!(check(&mut freshness, NOW + 21 * MS), Err(Untimely::Ahead(21 * MS)));
        assert_eq!(check(&mut freshness, i64::MIN), Err(Untimely::Old(i64::MAX)));
    }

    #[test]
    fn a_command_counts_from_its_stamp_and_later_than_the_one_before() {
        let mut since = Since::default();
        let now_ns = 100 * MS as u64;
        let mut freshness = Freshness::new(20 * MS);
        let age_ns = check(&mut freshness, NOW - 17 * MS).unwrap();
        assert_eq!(since.of(now_ns, age_ns), 83 * MS as u64, "not 17 ms more");
        let ahead_ns = check(&mut freshness, NOW + 5 * MS).unwrap();
        assert_eq!(since.of(now_ns, ahead_ns), now_ns, "never from the future");
        // By another clock it may seem older than the one before.
        assert_eq!(since.of(now_ns, 3 * MS as u64), now_ns + 1);
        assert_eq!(Since::default().of(5, 20), 1, "a machine that was just switched on");
    }

    #[test]
    fn an_overtaken_command_is_not_followed_nor_the_same_one_twice() {
        let mut freshness = Freshness::new(20 * MS);
        assert_eq!(check(&mut freshness, NOW - 5 * MS), Ok(5 * MS as u64));
        assert_eq!(check(&mut freshness, NOW - 5 * MS), Err(Untimely::Overtaken));
        assert_eq!(check(&mut freshness, NOW - 6 * MS), Err(Untimely::Overtaken));
        assert_eq!(check(&mut freshness, NOW - 4 * MS), Ok(4 * MS as u64));
    }

    #[test]
    fn a_refused_stamp_from_the_future_does_not_block_what_comes_after() {
        let mut freshness = Freshness::new(20 * MS);
        assert!(check(&mut freshness, i64::MAX).is_err());
        assert_eq!(check(&mut freshness, NOW), Ok(0));
    }

    #[test]
    fn stamp_zero_is_a_client_that_sets_none() {
        let mut freshness = Freshness::new(20 * MS);
        assert_eq!(check(&mut freshness, 0), Ok(0));
        assert_eq!(check(&mut freshness, NOW), Ok(0));
        assert_eq!(check(&mut freshness, 0), Ok(0));
    }

    #[test]
    fn stamps_may_come_from_the_system_or_from_the_poses() {
        let mut freshness = Freshness::new(20 * MS);
        let hour = 3_600_000 * MS;
        assert_eq!(freshness.check(NOW + hour, &[NOW, NOW + hour], &turns_at(&[])), Ok(0));
        assert_eq!(Freshness::new(20 * MS).check(NOW, &[NOW, NOW + hour], &turns_at(&[])), Ok(0));
    }
}
