//! The newest target on its way from whoever hears the pointer to the motor loop.

use std::fmt;

use glam::DVec3;
use thiserror::Error;

use crate::hand::LIMITS;
use crate::latest::{self, latest};

/// Where somebody points, and for how long that counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    position: DVec3,
    valid_for_s: f64,
}

/// A place that the hand cannot go to.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum NotATarget {
    /// NaN or infinite.
    #[error("the position [{}, {}, {}] m is not finite", .0.x, .0.y, .0.z)]
    NotFinite(DVec3),
    /// Outside the workspace, in the device frame.
    #[error(
        "the position [{:.3}, {:.3}, {:.3}] m in the device's frame is out of its reach: {} m around its z axis, z within {} m",
        .0.x, .0.y, .0.z, LIMITS.workspace.radius_m, 0.5 * LIMITS.workspace.height_m
    )]
    OutOfReach(DVec3),
}

impl Target {
    /// A place in the workspace (device frame, m) that counts for `valid_for_s` after it has reached the device. A place
    /// outside has no stand-in: the nearest one inside may lie deep in the body, beside what was pointed at.
    ///
    /// # Errors
    /// [`NotATarget`].
    pub fn new(position: DVec3, valid_for_s: f64) -> Result<Target, NotATarget> {
        if !position.is_finite() {
            Err(NotATarget::NotFinite(position))
        } else if !LIMITS.workspace.contains(position) {
            Err(NotATarget::OutOfReach(position))
        } else {
            Ok(Target { position, valid_for_s })
        }
    }

    /// In the device frame, m.
    pub fn position(&self) -> DVec3 {
        self.position
    }

    /// For so long it counts, s.
    pub fn valid_for_s(&self) -> f64 {
        self.valid_for_s
    }
}

/// The device's end of a slot for the newest target. A clone is another device's, of which one at a time may be open.
#[derive(Clone)]
pub struct Targets(latest::Receiver<Target>);

impl Targets {
    /// An empty slot.
    pub fn new() -> Targets {
        Targets(latest().1)
    }

    /// The end that points, of which there may be one.
    pub fn sender(&self) -> TargetSender {
        TargetSender(self.0.sender())
    }

    /// The newest target, if it was sent since the last look. RT safe.
    pub(super) fn news(&mut self) -> Option<Target> {
        self.0.news().copied()
    }
}

impl Default for Targets {
    fn default() -> Targets {
        Targets::new()
    }
}

impl fmt::Debug for Targets {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Targets")
    }
}

/// The end that points. To be kept until the motor loop has ended, so that the motor loop frees nothing.
pub struct TargetSender(latest::Sender<Target>);

impl TargetSender {
    /// Puts a target in place of the one before, whether the device has seen that or not. Waits for nobody.
    pub fn send(&mut self, target: Target) {
        self.0.send(target);
    }
}

/// For how many more periods the newest target counts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Validity {
    period_s: f64,
    position: DVec3,
    periods_left: u64,
}

impl Validity {
    pub(super) fn new(period_s: f64) -> Validity {
        Validity { period_s, position: DVec3::ZERO, periods_left: 0 }
    }

    /// The place to go to in the next period; none when no target counts any longer. RT safe.
    pub(super) fn period(&mut self, news: Option<Target>) -> Option<DVec3> {
        if let Some(Target { position, valid_for_s }) = news {
            self.position = position;
            // What is negative or no number becomes 0.
            self.periods_left = (valid_for_s / self.period_s).round() as u64;
        }
        self.periods_left = self.periods_left.checked_sub(1)?;
        Some(self.position)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_that_is_not_finite_is_no_target() {
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let text = Target::new(DVec3::new(0.0, x, 0.0), 0.3).unwrap_err().to_string();
            assert!(text.contains("is not finite"), "{text}");
        }
    }

    #[test]
    fn a_place_outside_the_workspace_is_no_target_and_its_edge_is_one() {
        for edge in [DVec3::new(0.18, 0.0, 0.0), DVec3::new(0.0, -0.18, 0.15), DVec3::new(0.0, 0.0, -0.15)] {
            assert_eq!(Target::new(edge, 0.3).unwrap().position(), edge);
        }
        for far in [DVec3::new(0.2, 0.0, 0.05), DVec3::new(0.13, 0.13, 0.0), DVec3::new(0.0, 0.0, -1e300)] {
            assert_eq!(Target::new(far, 0.3), Err(NotATarget::OutOfReach(far)));
        }
        let text = Target::new(DVec3::new(0.2, 0.0, 0.05), 0.3).unwrap_err().to_string();
        assert!(
            text.contains("[0.200, 0.000, 0.050] m") && text.contains("0.18 m around its z axis"),
            "{text}"
        );
    }

    #[test]
    fn a_target_counts_for_its_time_in_periods_and_the_same_again_anew() {
        let mut targets = Targets::new();
        let mut sender = targets.sender();
        let mut validity = Validity::new(1e-3);
        assert_eq!(validity.period(targets.news()), None, "before the first");
        for _ in 0..2 {
            sender.send(Target::new(0.1 * DVec3::X, 0.003).unwrap());
            for _ in 0..3 {
                assert_eq!(validity.period(targets.news()), Some(0.1 * DVec3::X));
            }
            assert_eq!(validity.period(targets.news()), None);
        }
        sender.send(Target::new(0.1 * DVec3::X, 0.003).unwrap());
        sender.send(Target::new(0.1 * DVec3::Y, 0.003).unwrap());
        assert_eq!(validity.period(targets.news()), Some(0.1 * DVec3::Y), "the newest wins");
    }

    #[test]
    fn a_time_that_is_none_counts_for_no_period() {
        let mut targets = Targets::new();
        let mut sender = targets.sender();
        let mut validity = Validity::new(1e-3);
        for valid_for_s in [0.0, -1.0, f64::NAN] {
            sender.send(Target::new(0.1 * DVec3::X, valid_for_s).unwrap());
            assert_eq!(validity.period(targets.news()), None);
        }
    }
}
