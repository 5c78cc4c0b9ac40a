//! What a device's part of the node has done: for `/diagnostics` and the closing report.

use std::time::{Duration, Instant};

use node_kit::{Histogram, Level, Status};
use rhombus_chain::{Answer, Mode, Rejection};
use serde_json::{Value, json};

/// Counters of one device since the start.
#[derive(Debug)]
pub(crate) struct Counters {
    poses: u64,
    forces: u64,
    rejected: [u64; Rejection::CAUSES.len()],
    ignored_inputs: u64,
    saturated: u64,
    peak_depth_m: f64,
    peak_force_n: f64,
    step: Histogram,
    last: Last,
    reported: Reported,
}

/// The newest answer.
#[derive(Debug, Default)]
struct Last {
    mode: Mode,
    clutched: bool,
    depth_m: f64,
    force_n: f64,
}

/// Where the counters were at the last report.
#[derive(Debug)]
struct Reported {
    at: Instant,
    poses: u64,
    rejected: u64,
}

impl Counters {
    pub(crate) fn new() -> Counters {
        Counters {
            poses: 0,
            forces: 0,
            rejected: [0; Rejection::CAUSES.len()],
            ignored_inputs: 0,
            saturated: 0,
            peak_depth_m: 0.0,
            peak_force_n: 0.0,
            step: Histogram::default(),
            last: Last::default(),
            reported: Reported { at: Instant::now(), poses: 0, rejected: 0 },
        }
    }

    /// A pose was answered and its force sent, `step` after the pose was taken.
    pub(crate) fn answered(&mut self, answer: &Result<Answer, Rejection>, step: Duration) {
        self.poses += 1;
        self.forces += 1;
        self.step.record(step);
        match answer {
            Ok(answer) => {
                let force_n = answer.force_in_frame_n.length();
                let depth_m = answer.step.depth_m;
                self.saturated += u64::from(answer.step.saturated);
                self.peak_depth_m = self.peak_depth_m.max(depth_m);
                self.peak_force_n = self.peak_force_n.max(force_n);
                self.last = Last { mode: answer.step.mode, clutched: answer.clutched, depth_m, force_n };
            }
            Err(rejection) => {
                self.rejected[rejection.cause()] += 1;
                self.last = Last::default();
            }
        }
    }

    /// A message on grasp, gripper or clutch said nothing that could be used.
    pub(crate) fn ignored_input(&mut self) {
        self.ignored_inputs += 1;
    }

    /// Whether the device touches or holds the body.
    pub(crate) fn in_contact(&self) -> bool {
        self.last.mode != Mode::None
    }

    fn rejected(&self) -> u64 {
        self.rejected.iter().sum()
    }

    /// Health since the last call.
    pub(crate) fn status(&mut self, subject: &str) -> Status {
        let now = Instant::now();
        let seconds = now.duration_since(self.reported.at).as_secs_f64().max(1e-3);
        let rate_hz = (self.poses - self.reported.poses) as f64 / seconds;
        let newly_rejected = self.rejected() - self.reported.rejected;
        self.reported = Reported { at: now, poses: self.poses, rejected: self.rejected() };

        let (level, summary) = match (newly_rejected, self.last.mode) {
            (0, _) if self.poses == 0 => (Level::Ok, "no pose yet".to_owned()),
            (0, _) if self.last.clutched => (Level::Ok, "clutched".to_owned()),
            (0, Mode::None) => (Level::Ok, "no contact".to_owned()),
            (0, Mode::Contact) => (Level::Ok, "contact".to_owned()),
            (0, Mode::Grasp) => (Level::Ok, "grasp".to_owned()),
            (n, _) => (Level::Warn, format!("{n} poses rejected and answered with no force")),
        };
        let mut status = Status::new(level, subject, summary)
            .with("rate_hz", format!("{rate_hz:.1}"))
            .with("poses", self.poses)
            .with("forces", self.forces)
            .with("depth_mm", format!("{:.3}", self.last.depth_m * 1e3))
            .with("force_n", format!("{:.3}", self.last.force_n))
            .with("peak_depth_mm", format!("{:.3}", self.peak_depth_m * 1e3))
            .with("peak_force_n", format!("{:.3}", self.peak_force_n))
            .with("saturated", self.saturated)
            .with("step_median_us", in_us(self.step.quantile_us(0.5)))
            .with("step_p99_us", in_us(self.step.quantile_us(0.99)))
            .with("rejected", self.rejected())
            .with("ignored_inputs", self.ignored_inputs);
        for (cause, count) in Rejection::CAUSES.iter().zip(self.rejected) {
            status = status.with(format!("rejected_{cause}"), count);
        }
        status
    }

    /// Everything since the start.
    pub(crate) fn report(&self) -> Value {
        let causes: serde_json::Map<String, Value> = Rejection::CAUSES
            .iter()
            .zip(self.rejected)
            .map(|(cause, n)| ((*cause).to_owned(), json!(n)))
            .collect();
        json!({
            "poses": self.poses,
            "forces": self.forces,
            "rejected": self.rejected(),
            "rejected_by_cause": causes,
            "ignored_inputs": self.ignored_inputs,
            "saturated": self.saturated,
            "peak_depth_mm": self.peak_depth_m * 1e3,
            "peak_force_n": self.peak_force_n,
            "step_median_us": self.step.quantile_us(0.5),
            "step_p99_us": self.step.quantile_us(0.99),
            "step_max_us": self.step.longest_us(),
        })
    }
}

fn in_us(duration_us: Option<f64>) -> String {
    duration_us.map_or_else(|| "-".to_owned(), |us| format!("{us:.1}"))
}
