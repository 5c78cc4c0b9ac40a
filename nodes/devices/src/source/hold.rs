//! A spring that holds the handle where it was.

use rhombus_chain::Pose;

use crate::{DeviceState, Wrench};

/// Half of what a 1 kHz loop renders stably on a handle with 0.3 N s/m of its own friction (K T < 2 b).
const STIFFNESS_N_PER_M: f64 = 300.0;
const DAMPING_N_S_PER_M: f64 = 3.0;
const STIFFNESS_N_M_PER_RAD: f64 = 0.3;
const DAMPING_N_M_S_PER_RAD: f64 = 0.003;

/// The wrench of spring and damper between the handle and `held`. Torque comes of it too; a device without motors there
/// does not get it. RT safe.
pub(super) fn wrench(held: &Pose, state: &DeviceState) -> Wrench {
    let turn = held.rotation * state.pose.rotation.conjugate();
    // The two signs of a quaternion are one rotation; the positive one is the short way.
    let turn = if turn.w < 0.0 { -turn } else { turn };
    Wrench {
        force_n: STIFFNESS_N_PER_M * (held.translation - state.pose.translation)
            - DAMPING_N_S_PER_M * state.linear_velocity_m_per_s,
        torque_n_m: STIFFNESS_N_M_PER_RAD * turn.to_scaled_axis()
            - DAMPING_N_M_S_PER_RAD * state.angular_velocity_rad_per_s,
        gripper_force_n: 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DQuat, DVec3};

    #[test]
    fn the_spring_pulls_back_along_the_way_and_against_the_turn() {
        let held = Pose { translation: DVec3::new(0.1, 0.0, 0.0), rotation: DQuat::from_rotation_z(0.5) };
        let away = Pose { translation: DVec3::new(0.1, 0.01, 0.0), rotation: DQuat::from_rotation_z(0.7) };
        let got = wrench(&held, &DeviceState::at_rest(away));
        assert!((got.force_n - DVec3::new(0.0, -3.0, 0.0)).length() < 1e-12);
        assert!((got.torque_n_m - DVec3::new(0.0, 0.0, -0.06)).length() < 1e-12);
        assert_eq!(wrench(&held, &DeviceState::at_rest(held)), Wrench::ZERO);
        // The other sign of the same rotation.
        let flipped = Pose { rotation: -away.rotation, ..away };
        assert!((wrench(&held, &DeviceState::at_rest(flipped)).torque_n_m - got.torque_n_m).length() < 1e-12);
    }

    #[test]
    fn the_damper_works_against_the_motion() {
        let held = Pose::IDENTITY;
        let moving = DeviceState {
            linear_velocity_m_per_s: DVec3::X,
            angular_velocity_rad_per_s: DVec3::Y,
            ..DeviceState::at_rest(held)
        };
        let got = wrench(&held, &moving);
        assert_eq!((got.force_n, got.torque_n_m), (DVec3::X * -3.0, DVec3::Y * -0.003));
    }
}
