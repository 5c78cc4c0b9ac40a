//! A change of source without a step of the force.

use crate::Wrench;
use crate::safety::vector::sum;

/// Time in which the difference between two sources fades, ns. Long against a period of the loop, short for a hand.
const FADE_NS: u64 = 20_000_000;

/// What remains of the difference at the last change.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct HandOver {
    difference: Wrench,
    began_ns: u64,
    fading: bool,
}

impl HandOver {
    /// From now on `from` goes over into what the new source, which says `to` at this moment, will say. RT safe.
    pub(super) fn begin(&mut self, from: &Wrench, to: &Wrench, now_ns: u64) {
        let difference = sum(from, to, -1.0);
        *self = HandOver { difference, began_ns: now_ns, fading: difference != Wrench::ZERO };
    }

    /// Forgets the difference. RT safe.
    pub(super) fn end(&mut self) {
        self.fading = false;
    }

    /// How much of the difference is left now; none when the change is over. RT safe.
    pub(super) fn share(&mut self, now_ns: u64) -> Option<f64> {
        let since_ns = now_ns.saturating_sub(self.began_ns);
        self.fading &= since_ns < FADE_NS;
        self.fading.then(|| 1.0 - since_ns as f64 / FADE_NS as f64)
    }

    /// What the new source says with `share` of the difference added. RT safe.
    pub(super) fn blend(&self, to: &Wrench, share: f64) -> Wrench {
        sum(to, &self.difference, share)
    }
}
