//! From the cap to a pose: the cap's deflection is a speed, and the pose is what that speed leads to.

use glam::{DQuat, DVec3};
use rhombus_chain::Pose;

use super::decode::Cap;
use crate::Workspace;

/// A step is never taken for longer than this, s: after a pause the pose goes on from where it was.
const LONGEST_STEP_S: f64 = 0.1;

/// How a deflection becomes a speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rate {
    /// Speed at full deflection along an axis, m/s.
    pub(super) linear_m_per_s: f64,
    /// Speed at full deflection about an axis, rad/s.
    pub(super) angular_rad_per_s: f64,
    /// The raw number that is full deflection.
    pub(super) full_scale: f64,
    /// Share of the full deflection around the middle that moves nothing.
    pub(super) deadband: f64,
}

impl Rate {
    /// -1 to 1: zero up to the deadband, from there linear to one at full deflection, so that the speed never jumps.
    fn share(&self, raw: i16) -> f64 {
        let deflection = (f64::from(raw) / self.full_scale).clamp(-1.0, 1.0);
        let beyond = (deflection.abs() - self.deadband).max(0.0) / (1.0 - self.deadband);
        beyond.copysign(deflection)
    }

    /// In the device frame: x forward, y left, z up, while the cap has x right, y toward the user, z down.
    fn turned(&self, [x, y, z]: [i16; 3]) -> DVec3 {
        DVec3::new(-self.share(y), -self.share(x), -self.share(z))
    }
}

/// A virtual handle, moved by the cap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct VirtualHandle {
    rate: Rate,
    workspace: Workspace,
    pub(super) pose: Pose,
    pub(super) linear_velocity_m_per_s: DVec3,
    pub(super) angular_velocity_rad_per_s: DVec3,
}

impl VirtualHandle {
    /// In the middle of the workspace, not turned.
    pub(super) fn new(rate: Rate, workspace: Workspace) -> VirtualHandle {
        VirtualHandle {
            rate,
            workspace,
            pose: Pose { translation: workspace.centre, rotation: DQuat::IDENTITY },
            linear_velocity_m_per_s: DVec3::ZERO,
            angular_velocity_rad_per_s: DVec3::ZERO,
        }
    }

    /// Back to the middle.
    pub(super) fn reset(&mut self) {
        *self = VirtualHandle::new(self.rate, self.workspace);
    }

    /// Lets `step_s` pass with the cap where it is. RT safe.
    pub(super) fn advance(&mut self, cap: &Cap, step_s: f64) {
        let step_s = step_s.clamp(0.0, LONGEST_STEP_S);
        let wanted = self.rate.linear_m_per_s * self.rate.turned(cap.translation);
        let before = self.pose.translation;
        self.pose.translation = self.workspace.nearest(before + wanted * step_s);
        // At the edge the handle does not move as fast as the cap asks for.
        self.linear_velocity_m_per_s =
            if step_s > 0.0 { (self.pose.translation - before) / step_s } else { wanted };
        self.angular_velocity_rad_per_s = self.rate.angular_rad_per_s * self.rate.turned(cap.rotation);
        let turn = DQuat::from_scaled_axis(self.angular_velocity_rad_per_s * step_s);
        self.pose.rotation = (turn * self.pose.rotation).normalize();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f64::consts::PI;

    const RATE: Rate =
        Rate { linear_m_per_s: 0.05, angular_rad_per_s: 0.8, full_scale: 350.0, deadband: 0.03 };
    const WORKSPACE: Workspace = Workspace { centre: DVec3::ZERO, radius_m: 0.18, height_m: 0.3 };

    fn moved(cap: Cap, seconds: f64) -> VirtualHandle {
        let mut handle = VirtualHandle::new(RATE, WORKSPACE);
        for _ in 0..(seconds * 1000.0) as usize {
            handle.advance(&cap, 1e-3);
        }
        handle
    }

    #[test]
    fn full_deflection_for_a_second_moves_by_the_speed() {
        // Pushed away from the user: raw y negative, device frame x.
        let forward = moved(Cap { translation: [0, -350, 0], ..Cap::default() }, 1.0);
        assert!((forward.pose.translation - DVec3::new(0.05, 0.0, 0.0)).length() < 1e-9);
        assert!((forward.linear_velocity_m_per_s - DVec3::new(0.05, 0.0, 0.0)).length() < 1e-9);
        let left = moved(Cap { translation: [-350, 0, 0], ..Cap::default() }, 1.0);
        assert!((left.pose.translation - DVec3::new(0.0, 0.05, 0.0)).length() < 1e-9);
        let up = moved(Cap { translation: [0, 0, -350], ..Cap::default() }, 1.0);
        assert!((up.pose.translation - DVec3::new(0.0, 0.0, 0.05)).length() < 1e-9);
    }

    #[test]
    fn a_turn_is_about_the_devices_axis_by_speed_times_time() {
        // Raw z is down: a negative number turns to the left about up.
        let handle = moved(Cap { rotation: [0, 0, -350], ..Cap::default() }, 0.5 * PI / 0.8);
        let expected = DQuat::from_rotation_z(0.5 * PI);
        assert!(handle.pose.rotation.angle_between(expected) < 2e-3);
        // About forward, then about left: both in the frame that stands still.
        let mut handle = VirtualHandle::new(RATE, WORKSPACE);
        for _ in 0..100 {
            handle.advance(&Cap { rotation: [0, -350, 0], ..Cap::default() }, 0.01);
        }
        for _ in 0..100 {
            handle.advance(&Cap { rotation: [-350, 0, 0], ..Cap::default() }, 0.01);
        }
        let expected = DQuat::from_rotation_y(0.8) * DQuat::from_rotation_x(0.8);
        assert!(handle.pose.rotation.angle_between(expected) < 1e-6);
    }

    #[test]
    fn the_middle_does_not_drift_and_the_speed_starts_from_zero() {
        assert_eq!(
            moved(Cap { translation: [10, -10, 10], rotation: [10; 3], buttons: 0 }, 5.0).pose,
            Pose { translation: DVec3::ZERO, rotation: DQuat::IDENTITY }
        );
        let slow = moved(Cap { translation: [0, -11, 0], ..Cap::default() }, 0.1);
        assert!(slow.linear_velocity_m_per_s.x > 0.0 && slow.linear_velocity_m_per_s.x < 1e-3 * 0.05 * 2.0);
    }

    #[test]
    fn the_handle_stays_inside_and_says_that_it_stands() {
        let handle = moved(Cap { translation: [-350, -350, -350], ..Cap::default() }, 20.0);
        assert!((handle.pose.translation.truncate().length() - WORKSPACE.radius_m).abs() < 1e-9);
        assert!((handle.pose.translation.z - 0.15).abs() < 1e-12);
        assert!(handle.linear_velocity_m_per_s.length() < 1e-6, "{}", handle.linear_velocity_m_per_s);
    }

    proptest! {
        #[test]
        fn nothing_reported_leads_out_of_the_workspace_or_to_no_rotation(
            steps in prop::collection::vec((any::<[i16; 6]>(), -1.0..10.0f64), 0..100),
        ) {
            let mut handle = VirtualHandle::new(RATE, WORKSPACE);
            for ([a, b, c, d, e, f], step_s) in steps {
                handle.advance(&Cap { translation: [a, b, c], rotation: [d, e, f], buttons: 0 }, step_s);
                prop_assert!(handle.pose.translation.truncate().length() <= WORKSPACE.radius_m * (1.0 + 1e-12));
                prop_assert!(handle.pose.translation.z.abs() <= 0.15 + 1e-12);
                prop_assert!((handle.pose.rotation.length() - 1.0).abs() < 1e-12);
                prop_assert!(handle.linear_velocity_m_per_s.length() <= 0.05 * 3f64.sqrt() + 1e-9);
            }
        }
    }
}
