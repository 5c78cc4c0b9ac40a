//! Rule: a handle that is faster than allowed is a fault.

use glam::DVec3;

use super::vector::size;
use crate::DeviceState;

/// So many new readings in a row must be too fast. One wrong position makes two fast differences, there and back, and a
/// transport that paused makes one; three in a row are motion. At 1 kHz and 1.5 m/s that is 4.5 mm.
const READINGS: u32 = 3;

/// Watches the larger of the reported velocity and the velocity that the positions show.
#[derive(Clone, Copy, Debug)]
pub(super) struct VelocityGuard {
    max_m_per_s: f64,
    period_s: f64,
    last: Option<Reading>,
    fast: u32,
}

#[derive(Clone, Copy, Debug)]
struct Reading {
    position: DVec3,
    device_time_ns: u64,
    age_s: f64,
}

impl VelocityGuard {
    pub(super) fn new(max_m_per_s: f64, period_s: f64) -> VelocityGuard {
        VelocityGuard { max_m_per_s, period_s, last: None, fast: 0 }
    }

    /// Whether the handle is too fast, `elapsed_s` after the call before. RT safe.
    pub(super) fn is_too_fast(&mut self, state: &DeviceState, elapsed_s: f64) -> bool {
        let mut speed = size(state.linear_velocity_m_per_s);
        let position = state.pose.translation;
        if let Some(last) = &mut self.last {
            last.age_s += elapsed_s;
            if last.position == position && last.device_time_ns == state.device_time_ns {
                // The same reading once more: a device that is slower than the loop says nothing new.
                return self.fast >= READINGS;
            }
            // Two periods that follow closely on each other do not make the handle faster.
            speed = speed.max(size(position - last.position) / last.age_s.max(self.period_s));
        }
        self.last = Some(Reading { position, device_time_ns: state.device_time_ns, age_s: 0.0 });
        self.fast = if speed > self.max_m_per_s { self.fast.saturating_add(1) } else { 0 };
        self.fast >= READINGS
    }

    /// Forgets what it has seen. RT safe.
    pub(super) fn reset(&mut self) {
        self.last = None;
        self.fast = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;
    use proptest::prelude::*;
    use rhombus_chain::Pose;

    const T: f64 = 1e-3;

    fn at(x: f64, reported: f64, device_time_ns: u64) -> DeviceState {
        DeviceState {
            linear_velocity_m_per_s: DVec3::X * reported,
            device_time_ns,
            ..DeviceState::at_rest(Pose { translation: DVec3::X * x, rotation: DQuat::IDENTITY })
        }
    }

    /// How many readings of a motion pass before the guard acts.
    fn passes(states: impl IntoIterator<Item = DeviceState>) -> Option<usize> {
        let mut guard = VelocityGuard::new(1.5, T);
        states.into_iter().position(|state| guard.is_too_fast(&state, T))
    }

    #[test]
    fn a_fast_handle_is_seen_in_its_positions_and_in_its_reported_velocity() {
        assert_eq!(passes((0..100).map(|i| at(0.002 * f64::from(i), 0.0, 0))), Some(3));
        assert_eq!(passes((0..100).map(|i| at(0.0, 2.0, i))), Some(2));
        assert_eq!(passes((0..100).map(|i| at(0.0014 * f64::from(i), 1.4, 0))), None);
    }

    #[test]
    fn one_wrong_position_is_no_fault() {
        let glitch = |i: u64| at(if i == 50 { 0.1 } else { 0.0001 * i as f64 }, 0.1, i);
        assert_eq!(passes((0..100).map(glitch)), None);
    }

    #[test]
    fn a_device_slower_than_the_loop_is_not_taken_for_a_fast_handle() {
        // 0.5 m/s, a reading every 8 periods: 4 mm in one period.
        let slow = |i: u64| at(0.004 * (i / 8) as f64, 0.0, i / 8);
        assert_eq!(passes((0..800).map(slow)), None);
        // 3 m/s is too fast at that rate too, after three new readings.
        let fast = |i: u64| at(0.024 * (i / 8) as f64, 0.0, i / 8);
        assert_eq!(passes((0..800).map(fast)), Some(24));
    }

    #[test]
    fn two_periods_close_together_do_not_make_the_handle_faster() {
        let mut guard = VelocityGuard::new(1.5, T);
        // Half a millimetre for each reading of the device, at 0.1 ms after one another in a loop that was late.
        for i in 0..100 {
            assert!(!guard.is_too_fast(&at(0.0005 * f64::from(i), 0.5, 0), 1e-4));
        }
    }

    proptest! {
        #[test]
        fn whatever_moves_faster_for_three_readings_is_found(
            speed in 1.6..1e300f64, start in 0usize..50,
        ) {
            let states = (0..start).map(|_| at(0.0, 0.0, 0)).chain((0..10).map(|i| at(0.0, speed, i)));
            prop_assert!(passes(states).is_some_and(|ticks| ticks <= start + 3));
        }
    }
}
