//! Rule: force, torque and gripper force change no faster than the slew limits, whatever asks for it, and no single
//! command steps by more than the limits allow in 2 ms, however slow the loop is: a hand feels the step, not its rate.

use super::vector::{towards, towards_number};
use super::{LimitsHit, SafetySettings};
use crate::Wrench;

/// The longest time that one command's step makes use of, s.
const LONGEST_STEP_S: f64 = 2e-3;

/// The share of a slew limit, 0 to 1, that a loop with this period, s, comes to with steps that are no longer.
pub(super) fn share_of_limit(period_s: f64) -> f64 {
    (LONGEST_STEP_S / period_s).min(1.0)
}

/// How fast.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slew {
    n_per_s: f64,
    n_m_per_s: f64,
    gripper_n_per_s: f64,
}

impl Slew {
    pub(super) fn new(settings: &SafetySettings) -> Slew {
        Slew {
            n_per_s: settings.slew_n_per_s,
            n_m_per_s: settings.torque_slew_n_m_per_s,
            gripper_n_per_s: settings.gripper_slew_n_per_s,
        }
    }

    /// From `from` as far towards `to` as `dt_s` allows, of which no more than 2 ms count. RT safe.
    pub(super) fn apply(&self, from: &Wrench, to: &Wrench, dt_s: f64, hit: &mut LimitsHit) -> Wrench {
        let dt_s = dt_s.min(LONGEST_STEP_S);
        let reached = Wrench {
            force_n: towards(from.force_n, to.force_n, self.n_per_s * dt_s),
            torque_n_m: towards(from.torque_n_m, to.torque_n_m, self.n_m_per_s * dt_s),
            gripper_force_n: towards_number(
                from.gripper_force_n,
                to.gripper_force_n,
                self.gripper_n_per_s * dt_s,
            ),
        };
        hit.insert_if(reached != *to, LimitsHit::SLEW);
        reached
    }
}
