//! How a hand is led: towards the target, smoothly and no faster than a hand.

use glam::DVec3;

use crate::DeviceError;

/// The way to the target shrinks to 1/e in this time, s: the steps of targets that come at the rate of a screen, 17 ms apart,
/// are not felt.
const SMOOTHING_S: f64 = 0.02;

/// How the place where the hand means to be follows the target.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lead {
    max_speed_m_per_s: f64,
    period_s: f64,
    /// Share of the way that is covered in a period.
    share: f64,
}

impl Lead {
    /// For periods of `period_s` > 0.
    ///
    /// # Errors
    /// [`DeviceError::Setting`]: the speed is none.
    pub(super) fn new(max_speed_m_per_s: f64, period_s: f64) -> Result<Lead, DeviceError> {
        if !(max_speed_m_per_s.is_finite() && max_speed_m_per_s > 0.0) {
            return Err(DeviceError::Setting {
                name: "pointer.max_speed",
                value: max_speed_m_per_s.to_string(),
                accepted: "a finite number > 0 [m/s]".to_owned(),
            });
        }
        Ok(Lead { max_speed_m_per_s, period_s, share: -libm::expm1(-period_s / SMOOTHING_S) })
    }

    /// The velocity at which the hand means to move during the next period. RT safe.
    pub(super) fn velocity_m_per_s(&self, from: DVec3, target: DVec3) -> DVec3 {
        ((target - from) * (self.share / self.period_s)).clamp_length_max(self.max_speed_m_per_s)
    }

    /// Where a period at that velocity leads. RT safe.
    pub(super) fn after_a_period(&self, from: DVec3, velocity_m_per_s: DVec3) -> DVec3 {
        from + velocity_m_per_s * self.period_s
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_never_overshoots_and_keeps_the_largest_speed_whatever_the_rate() {
        let target = DVec3::new(0.03, -0.04, 0.0);
        for period_s in [0.25e-3, 1e-3, 0.1] {
            let lead = Lead::new(0.5, period_s).unwrap();
            let (mut at, mut left_m) = (DVec3::ZERO, target.length());
            for _ in 0..(1.0 / period_s) as usize {
                let velocity = lead.velocity_m_per_s(at, target);
                assert!(velocity.length() <= 0.5 * (1.0 + 1e-12));
                at = lead.after_a_period(at, velocity);
                assert!(at.distance(target) <= left_m);
                left_m = at.distance(target);
            }
            assert!(left_m < 1e-6, "{left_m} m left at {period_s} s");
        }
    }
}
