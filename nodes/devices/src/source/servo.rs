//! The commanded wrench as a source: the last command that can be used.

use super::{Axes, Moment, ServoCommand};
use crate::safety::vector::limited;
use crate::{DeviceState, Wrench};

/// A command that arrives while a period runs is a little younger than the period's time. More is no time of this clock.
const YOUNGEST_NS: u64 = 10_000_000;

/// More than any device has, N, N m: what is larger counts as this much, so that no sum of forces overflows.
const LARGEST: f64 = 1e6;

/// Remembers the last usable command.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Servo {
    last: Option<ServoCommand>,
    refused_ns: Option<u64>,
}

impl Servo {
    /// Looks at the newest command. True when it is refused, once for each: not finite, from the future, or older than
    /// one before. The last usable one then goes on, and gets older. RT safe.
    pub(super) fn take(&mut self, newest: Option<&ServoCommand>, now: Moment) -> bool {
        let Some(command) = newest else { return false };
        let known_ns = self.last.map(|last| last.since_ns);
        if known_ns == Some(command.since_ns) || self.refused_ns == Some(command.since_ns) {
            return false;
        }
        let in_order = known_ns.is_none_or(|known_ns| command.since_ns > known_ns);
        let in_time = command.since_ns <= now.monotonic_ns.saturating_add(YOUNGEST_NS);
        if !(command.wrench.is_finite() && in_order && in_time) {
            self.refused_ns = Some(command.since_ns);
            return true;
        }
        let Wrench { force_n, torque_n_m, gripper_force_n } = command.wrench;
        let wrench = Wrench {
            force_n: limited(force_n, LARGEST),
            torque_n_m: limited(torque_n_m, LARGEST),
            gripper_force_n: gripper_force_n.clamp(-LARGEST, LARGEST),
        };
        self.last = Some(ServoCommand { wrench, ..*command });
        false
    }

    /// The command, in the device frame for the handle as it is now, and until when it may be used in full; none when it
    /// is older. RT safe.
    pub(super) fn wrench(&self, state: &DeviceState, validity_ns: u64, now: Moment) -> Option<(Wrench, u64)> {
        let ServoCommand { since_ns, gripper_until_ns, mut wrench, axes } = self.last?;
        let until_ns = since_ns.saturating_add(validity_ns);
        if now.monotonic_ns > until_ns {
            return None;
        }
        if now.monotonic_ns > gripper_until_ns {
            wrench.gripper_force_n = 0.0;
        }
        let wrench = match axes {
            Axes::Base => wrench,
            Axes::Tip => Wrench {
                force_n: state.pose.rotation * wrench.force_n,
                torque_n_m: state.pose.rotation * wrench.torque_n_m,
                ..wrench
            },
        };
        Some((wrench, until_ns))
    }
}
