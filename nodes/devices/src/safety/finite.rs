//! Rule: a wanted wrench that is not finite is none.

use super::LimitsHit;
use crate::Wrench;

/// The wrench, or zero where one of its numbers is not finite: what a broken computation says of the other numbers is
/// not to be trusted either. RT safe.
pub(super) fn or_nothing(wrench: Wrench, hit: &mut LimitsHit) -> Wrench {
    if wrench.is_finite() {
        return wrench;
    }
    hit.insert(LimitsHit::NOT_FINITE);
    Wrench::ZERO
}
