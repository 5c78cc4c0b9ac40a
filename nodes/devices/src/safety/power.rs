//! Rule: the motors push a moving hand with limited power.

use super::LimitsHit;
use crate::{DeviceState, Wrench};

/// The wrench, scaled so that force and torque together give the hand no more than `max_power_w`, direction kept. The
/// gripper is left out: its force and its angle have no known lever. RT safe.
pub(super) fn limited(wrench: Wrench, state: &DeviceState, max_power_w: f64, hit: &mut LimitsHit) -> Wrench {
    let power_w = wrench.force_n.dot(state.linear_velocity_m_per_s)
        + wrench.torque_n_m.dot(state.angular_velocity_rad_per_s);
    if power_w <= max_power_w {
        return wrench;
    }
    hit.insert(LimitsHit::POWER);
    // A power that overflows leaves no force.
    let share = if power_w.is_finite() { max_power_w / power_w } else { 0.0 };
    Wrench {
        force_n: wrench.force_n * share,
        torque_n_m: wrench.torque_n_m * share,
        gripper_force_n: wrench.gripper_force_n,
    }
}
