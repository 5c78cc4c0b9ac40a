//! Which poses have been answered by a force, and how long that took.

use std::collections::VecDeque;
use std::time::Duration;

use node_kit::Histogram;

/// More unanswered poses than this are not waited for: 10 s at 1 kHz.
const MOST_WAITING: usize = 10_000;

/// Poses sent and forces that came back for them, matched by stamp.
#[derive(Clone, Debug)]
pub(crate) struct Answers {
    period_ns: u64,
    /// Poses without a force yet, oldest first: stamp and monotonic time of the sample.
    waiting: VecDeque<(i64, u64)>,
    given_up: u64,
    poses: u64,
    forces: u64,
    missed_deadlines: u64,
    first_and_last_pose_ns: Option<(u64, u64)>,
    first_and_last_force_ns: Option<(u64, u64)>,
    latency: Histogram,
}

/// What there is to say about poses and forces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct AnswerReport {
    pub(crate) poses: u64,
    pub(crate) forces: u64,
    /// Poses to which no force has come yet, or ever.
    pub(crate) unanswered: u64,
    pub(crate) pose_rate_hz: f64,
    pub(crate) force_rate_hz: f64,
    /// Forces that came later than one period after their pose.
    pub(crate) missed_deadlines: u64,
    /// Median, 99th percentile and maximum of the time from the reading of the device to the arrival of its force.
    pub(crate) latency_us: Option<[f64; 3]>,
}

impl Answers {
    /// For a device read every `period_ns`.
    pub(crate) fn new(period_ns: u64) -> Answers {
        Answers {
            period_ns,
            waiting: VecDeque::with_capacity(MOST_WAITING + 1),
            given_up: 0,
            poses: 0,
            forces: 0,
            missed_deadlines: 0,
            first_and_last_pose_ns: None,
            first_and_last_force_ns: None,
            latency: Histogram::default(),
        }
    }

    /// A pose is about to be sent.
    pub(crate) fn sent(&mut self, stamp_ns: i64, monotonic_ns: u64) {
        self.poses += 1;
        extend(&mut self.first_and_last_pose_ns, monotonic_ns);
        self.waiting.push_back((stamp_ns, monotonic_ns));
        if self.waiting.len() > MOST_WAITING {
            self.waiting.pop_front();
            self.given_up += 1;
        }
    }

    /// A force arrived. False when it answers no pose that waits. Forces come in the order of the poses, so the poses
    /// before this one will not be answered any more.
    pub(crate) fn arrived(&mut self, stamp_ns: i64, monotonic_ns: u64) -> bool {
        let Ok(place) = self.waiting.binary_search_by_key(&stamp_ns, |(stamp_ns, _)| *stamp_ns) else {
            return false;
        };
        self.given_up += place as u64;
        let sent_ns = self.waiting[place].1;
        self.waiting.drain(..=place);
        self.forces += 1;
        extend(&mut self.first_and_last_force_ns, monotonic_ns);
        let latency_ns = monotonic_ns.saturating_sub(sent_ns);
        self.latency.record(Duration::from_nanos(latency_ns));
        if latency_ns > self.period_ns {
            self.missed_deadlines += 1;
        }
        true
    }

    /// Whether every pose has its force.
    pub(crate) fn is_complete(&self) -> bool {
        self.waiting.is_empty()
    }

    pub(crate) fn report(&self) -> AnswerReport {
        let quantile = |share| self.latency.quantile_us(share);
        AnswerReport {
            poses: self.poses,
            forces: self.forces,
            unanswered: self.given_up + self.waiting.len() as u64,
            pose_rate_hz: rate_hz(self.poses, self.first_and_last_pose_ns),
            force_rate_hz: rate_hz(self.forces, self.first_and_last_force_ns),
            missed_deadlines: self.missed_deadlines,
            latency_us: quantile(0.5)
                .zip(quantile(0.99))
                .zip(self.latency.longest_us())
                .map(|((median, p99), max)| [median, p99, max]),
        }
    }
}

fn extend(first_and_last: &mut Option<(u64, u64)>, now_ns: u64) {
    let first = first_and_last.map_or(now_ns, |(first, _)| first);
    *first_and_last = Some((first, now_ns));
}

/// Messages per second between the first and the last; 0 with less than two.
fn rate_hz(count: u64, first_and_last_ns: Option<(u64, u64)>) -> f64 {
    match first_and_last_ns {
        Some((first, last)) if last > first => (count - 1) as f64 * 1e9 / (last - first) as f64,
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: u64 = 1_000_000;

    fn answers_to(stamps: std::ops::Range<i64>) -> Answers {
        let mut answers = Answers::new(MS);
        for stamp in stamps {
            answers.sent(stamp, stamp as u64 * MS);
        }
        answers
    }

    #[test]
    fn every_pose_answered_is_complete_with_its_latencies_and_rates() {
        let mut answers = answers_to(0..100);
        for stamp in 0..100 {
            assert!(answers.arrived(stamp, stamp as u64 * MS + 300_000));
        }
        assert!(answers.is_complete());
        let report = answers.report();
        assert_eq!(
            (report.poses, report.forces, report.unanswered, report.missed_deadlines),
            (100, 100, 0, 0)
        );
        assert!((report.pose_rate_hz - 1000.0).abs() < 1e-9 && (report.force_rate_hz - 1000.0).abs() < 1e-9);
        assert_eq!(report.latency_us, Some([300.0, 300.0, 300.0]));
    }

    #[test]
    fn a_pose_that_was_passed_over_is_unanswered_and_a_stranger_answers_nothing() {
        let mut answers = answers_to(0..10);
        assert!(answers.arrived(4, 5 * MS));
        assert_eq!(answers.report().unanswered, 4 + 5);
        for stranger in [-7, 4, 2, 1000] {
            assert!(!answers.arrived(stranger, 5 * MS));
        }
        assert_eq!(answers.report().forces, 1);
    }

    #[test]
    fn a_force_later_than_a_period_is_a_missed_deadline() {
        let mut answers = answers_to(0..2);
        answers.arrived(0, MS);
        answers.arrived(1, 2 * MS + 1);
        assert_eq!(answers.report().missed_deadlines, 1);
    }

    #[test]
    fn poses_that_nobody_answers_do_not_fill_the_memory() {
        let answers = answers_to(0..30_000);
        assert!(answers.waiting.len() <= MOST_WAITING);
        assert_eq!(answers.report().unanswered, 30_000);
        assert_eq!(answers.report().latency_us, None);
    }
}
