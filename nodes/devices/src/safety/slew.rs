//! Rule: force, torque and gripper force change no faster than the slew limits, whatever asks for it.

use super::vector::{towards, towards_number};
use super::{LimitsHit, SafetySettings};
use crate::Wrench;

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

    /// From `from` as far towards `to` as `dt_s` allows. RT safe.
    pub(super) fn apply(&self, from: &Wrench, to: &Wrench, dt_s: f64, hit: &mut LimitsHit) -> Wrench {
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
