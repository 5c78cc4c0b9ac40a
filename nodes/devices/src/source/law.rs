//! The contact law as a source.

use rhombus_chain::Mode;

use super::{LawCommand, Moment};
use crate::{DeviceState, Wrench};

/// Until when a law may be used, by the monotonic clock; none when it may not now. A law with a stamp from the future is
/// not one of this loop's. RT safe.
pub(super) fn expires_ns(command: &LawCommand, longest_ns: i64, now: Moment) -> Option<u64> {
    let age_ns = now.stamp_ns.saturating_sub(command.stamp_ns);
    let validity_ns = command.validity_ns.min(longest_ns);
    let left_ns = u64::try_from(validity_ns.checked_sub(age_ns)?).ok()?;
    (age_ns >= 0).then(|| now.monotonic_ns.saturating_add(left_ns))
}

/// The law's force for the handle as it is now, with the probe's depth in m. RT safe.
pub(super) fn evaluate(command: &LawCommand, state: &DeviceState) -> (Wrench, f64) {
    let LawCommand { local, chains, .. } = command;
    let probe = state.pose.translation;
    let depth_m = local.depth_m(probe);
    // Negative depth is a pull in a grasp, and no contact otherwise.
    let depth_m = if local.mode == Mode::Contact { depth_m.max(0.0) } else { depth_m };
    (Wrench::of_force(local.force_n(chains, probe)), depth_m)
}
