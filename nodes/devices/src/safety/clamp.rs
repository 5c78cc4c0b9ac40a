//! Rule: no more force, torque and gripper force than user and device both allow, direction kept.

use super::vector::limited;
use super::{LimitsHit, SafetySettings};
use crate::{DeviceLimits, Wrench};

/// The largest values, each the smaller of the user's and the device's.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clamp {
    /// The larger of what may be set live: the settings' and the device's.
    ceiling_n: f64,
    force_n: f64,
    torque_n_m: f64,
    gripper_n: f64,
}

impl Clamp {
    /// A device without a limit has no motor there, and gets nothing.
    pub(super) fn new(settings: &SafetySettings, limits: &DeviceLimits) -> Clamp {
        let both = |user: f64, device: Option<f64>| permission(user).min(permission(device.unwrap_or(0.0)));
        let force_n = both(settings.max_force_n, limits.max_force_n);
        Clamp {
            ceiling_n: force_n,
            force_n,
            torque_n_m: both(settings.max_torque_n_m, limits.max_torque_n_m),
            gripper_n: both(settings.max_gripper_force_n, limits.max_gripper_force_n),
        }
    }

    /// A new largest force; never more than what was checked at the start. RT safe.
    pub(super) fn set_max_force_n(&mut self, force_n: f64) {
        self.force_n = permission(force_n).min(self.ceiling_n);
    }

    /// The wrench within the limits. RT safe.
    pub(super) fn apply(&self, wrench: Wrench, hit: &mut LimitsHit) -> Wrench {
        let within = Wrench {
            force_n: limited(wrench.force_n, self.force_n),
            torque_n_m: limited(wrench.torque_n_m, self.torque_n_m),
            gripper_force_n: wrench.gripper_force_n.clamp(-self.gripper_n, self.gripper_n),
        };
        hit.insert_if(within.force_n != wrench.force_n, LimitsHit::FORCE);
        hit.insert_if(within.torque_n_m != wrench.torque_n_m, LimitsHit::TORQUE);
        hit.insert_if(
            within.gripper_force_n.to_bits() != wrench.gripper_force_n.to_bits(),
            LimitsHit::GRIPPER,
        );
        within
    }
}

/// A limit that is not a number is no permission, nor is one below zero.
fn permission(limit: f64) -> f64 {
    if limit > 0.0 { limit } else { 0.0 }
}
