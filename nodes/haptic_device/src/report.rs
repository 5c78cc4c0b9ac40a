//! What the driver says about itself: diagnostics once a second, and the closing report.

use devices::Counts;
use node_kit::{Level, Status};
use serde_json::{Value, json};

use crate::answers::AnswerReport;
use crate::forces::ForceCounts;

/// Everything worth saying at one moment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Health {
    pub(crate) answers: AnswerReport,
    pub(crate) counts: Counts,
    pub(crate) force_n: f64,
    pub(crate) peak_force_n: f64,
    pub(crate) peak_depth_m: f64,
    pub(crate) max_force_n: f64,
    pub(crate) forces: ForceCounts,
    pub(crate) unsent: u64,
}

impl Health {
    /// The diagnostics. `before` is the health one report earlier; `conflicts` says who disturbs whom.
    pub(crate) fn statuses(&self, before: &Health, conflicts: &[String], scheduling: &str) -> Vec<Status> {
        vec![self.motor_status(before, scheduling), self.force_status(before, conflicts)]
    }

    fn motor_status(&self, before: &Health, scheduling: &str) -> Status {
        let (now, then) = (&self.counts, &before.counts);
        let late = (now.late_ticks + now.skipped_ticks) - (then.late_ticks + then.skipped_ticks);
        let lost = (now.lost_samples - then.lost_samples) + (self.unsent - before.unsent);
        let unusable =
            (now.unusable_readings + now.unusable_forces) - (then.unusable_readings + then.unusable_forces);
        let (level, summary) = if unusable > 0 {
            (Level::Error, format!("{unusable} readings or forces that are not finite: no force"))
        } else if lost > 0 {
            (Level::Warn, format!("{lost} samples were not published"))
        } else if late * 20 > now.ticks - then.ticks {
            (Level::Warn, format!("{late} late or skipped ticks in a second"))
        } else {
            (Level::Ok, "motors driven".to_owned())
        };
        Status::new(level, "motor loop", summary)
            .with("ticks", now.ticks)
            .with("late_ticks", now.late_ticks)
            .with("skipped_ticks", now.skipped_ticks)
            .with("latest_tick_us", now.latest_ns / 1000)
            .with("lost_samples", now.lost_samples)
            .with("unsent_messages", self.unsent)
            .with("unusable_readings", now.unusable_readings)
            .with("unusable_forces", now.unusable_forces)
            .with("clamped_forces", now.clamped_forces)
            .with("slewed_forces", now.slewed_forces)
            .with("damped_ticks", now.damped_ticks)
            .with("losses", now.losses)
            .with("reopenings", now.reopenings)
            .with("max_force_n", self.max_force_n)
            .with("scheduling", scheduling)
    }

    fn force_status(&self, before: &Health, conflicts: &[String]) -> Status {
        let poses = self.answers.poses - before.answers.poses;
        let forces = self.answers.forces - before.answers.forces;
        let laws = self.forces.laws - before.forces.laws;
        let rejected = self.forces.rejected - before.forces.rejected;
        let (level, summary) = if !conflicts.is_empty() {
            (Level::Error, conflicts.join("; "))
        } else if rejected > 0 {
            (Level::Warn, format!("{rejected} forces or contact laws were rejected"))
        } else if poses > 0 && forces == 0 && laws == 0 {
            (Level::Warn, "nobody answers the poses: no force".to_owned())
        } else if forces * 2 < poses {
            (Level::Warn, format!("{forces} forces for {poses} poses in a second"))
        } else {
            (Level::Ok, "poses are answered".to_owned())
        };
        let [median_us, p99_us, max_us] = match self.answers.latency_us {
            Some(quantiles) => quantiles.map(|us| format!("{us:.0}")),
            None => ["-"; 3].map(str::to_owned),
        };
        Status::new(level, "force", summary)
            .with("poses", self.answers.poses)
            .with("forces", self.answers.forces)
            .with("unanswered", self.answers.unanswered)
            .with("pose_rate_hz", format!("{:.1}", self.answers.pose_rate_hz))
            .with("force_rate_hz", format!("{:.1}", self.answers.force_rate_hz))
            .with("latency_median_us", median_us)
            .with("latency_p99_us", p99_us)
            .with("latency_max_us", max_us)
            .with("missed_deadlines", self.answers.missed_deadlines)
            .with("contact_laws", self.forces.laws)
            .with("rejected", self.forces.rejected)
            .with("untimely", self.forces.untimely)
            .with("contested", self.forces.contested)
            .with("force_n", format!("{:.3}", self.force_n))
            .with("peak_force_n", format!("{:.3}", self.peak_force_n))
            .with("peak_depth_mm", format!("{:.2}", 1000.0 * self.peak_depth_m))
    }

    /// The closing report.
    pub(crate) fn closing(&self) -> Value {
        let AnswerReport {
            poses,
            forces,
            unanswered,
            pose_rate_hz,
            force_rate_hz,
            missed_deadlines,
            latency_us,
        } = self.answers;
        json!({
            "poses": poses,
            "forces": forces,
            "unanswered": unanswered,
            "pose_rate_hz": pose_rate_hz,
            "force_rate_hz": force_rate_hz,
            "latency_us": latency_us.map(|[median, p99, max]| json!({"median": median, "p99": p99, "max": max})),
            "missed_deadlines": missed_deadlines,
            "ticks": self.counts.ticks,
            "late_ticks": self.counts.late_ticks,
            "skipped_ticks": self.counts.skipped_ticks,
            "latest_tick_us": self.counts.latest_ns as f64 / 1000.0,
            "lost_samples": self.counts.lost_samples,
            "unsent_messages": self.unsent,
            "unusable_readings": self.counts.unusable_readings,
            "unusable_forces": self.counts.unusable_forces,
            "clamped_forces": self.counts.clamped_forces,
            "contact_laws": self.forces.laws,
            "rejected": self.forces.rejected,
            "untimely": self.forces.untimely,
            "contested": self.forces.contested,
            "losses": self.counts.losses,
            "peak_force_n": self.peak_force_n,
            "peak_depth_mm": 1000.0 * self.peak_depth_m,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn health() -> Health {
        let answers = crate::answers::Answers::new(1_000_000).report();
        Health {
            answers,
            counts: Counts::default(),
            force_n: 0.0,
            peak_force_n: 0.0,
            peak_depth_m: 0.0,
            max_force_n: 20.0,
            forces: ForceCounts::default(),
            unsent: 0,
        }
    }

    fn text(now: &Health) -> String {
        format!("{:?}", now.force_status(&health(), &[]))
    }

    #[test]
    fn poses_that_nobody_answers_are_a_warning() {
        let mut now = health();
        now.answers.poses = 1000;
        assert!(
            text(&now).contains("level: Warn, subject: \"force\", summary: \"nobody answers"),
            "{}",
            text(&now)
        );
        now.answers.forces = 1000;
        assert!(text(&now).contains("level: Ok, subject: \"force\""));
    }

    #[test]
    fn two_sources_of_one_command_are_an_error_that_names_them() {
        let conflict = "servo_cf has 2 publishers (/a, /b)".to_owned();
        let status = format!("{:?}", health().force_status(&health(), &[conflict]));
        assert!(status.contains("level: Error") && status.contains("/a, /b"), "{status}");
    }

    #[test]
    fn forces_that_are_not_finite_are_an_error() {
        let mut now = health();
        now.counts.unusable_forces = 1;
        let status = format!("{:?}", now.motor_status(&health(), "ordinary"));
        assert!(status.contains("level: Error, subject: \"motor loop\""), "{status}");
    }

    #[test]
    fn the_closing_report_has_the_keys_that_a_session_sums_up() {
        let mut now = health();
        now.answers.latency_us = Some([300.0, 700.0, 2000.0]);
        let report = now.closing();
        for key in [
            "poses",
            "forces",
            "unanswered",
            "pose_rate_hz",
            "force_rate_hz",
            "missed_deadlines",
            "late_ticks",
        ] {
            assert!(report[key].is_number(), "{key}");
        }
        assert_eq!(report["latency_us"]["p99"], 700.0);
    }
}
