//! Finds which golden and which computed message belong together when their stamps no longer agree.
//!
//! Nothing is sorted: stamps may repeat or jump back. From the first two messages whose stamps differ, the nearest later
//! pair with equal stamps is looked for, nearest meaning that fewest messages are left over. Only so many messages are
//! looked at, so that memory is bounded; a message that is missing or too many costs itself and nothing behind it.

use std::collections::VecDeque;

use super::golden::{Golden, Waiting};

/// Messages of each side that are looked at.
pub(super) const LOOK_AHEAD: usize = 1024;
/// Bytes of them: messages may be large.
pub(super) const LOOK_AHEAD_BYTES: usize = 8 << 20;

/// What the first messages of both sides turn out to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Gap {
    /// Not known before more computed messages came.
    Wait,
    /// So many golden messages have no computed one, then so many computed ones have no golden one.
    Unpaired { golden: usize, computed: usize },
    /// So many of both belong together in their order: their stamps alone are different.
    OtherStamps(usize),
}

/// Computed messages that wait for their golden ones.
#[derive(Debug, Default)]
pub(super) struct Pending {
    queue: VecDeque<Waiting>,
    bytes: usize,
    /// Sums of places that have been searched since the last pair.
    searched: usize,
}

impl Pending {
    pub(super) fn is_empty(&self) -> bool {
        self.queue.is_empty()
    }

    pub(super) fn push(&mut self, message: Waiting) {
        self.bytes += message.data.len();
        self.queue.push_back(message);
    }

    pub(super) fn front(&self) -> Option<&Waiting> {
        self.queue.front()
    }

    pub(super) fn pop(&mut self) -> Option<Waiting> {
        let message = self.queue.pop_front()?;
        self.bytes -= message.data.len();
        Some(message)
    }

    /// Begins anew at what are now the first messages.
    pub(super) fn restart(&mut self) {
        self.searched = 0;
    }

    /// What to do with the first messages of both sides, whose stamps differ. `ended` says that no computed message will come.
    pub(super) fn gap(&mut self, golden: &mut Golden<'_>, slot: usize, ended: bool) -> Gap {
        let computed = self.queue.len();
        let is_full = computed >= LOOK_AHEAD || self.bytes >= LOOK_AHEAD_BYTES;
        loop {
            let sum = self.searched;
            // A pair that leaves `sum` messages over may still be beaten by computed messages to come, unless `sum` came.
            if sum >= computed && !is_full && !ended {
                return Gap::Wait;
            }
            let ahead = golden.ahead(slot, (sum + 1).min(LOOK_AHEAD));
            let last_golden = ahead.len().min(LOOK_AHEAD).saturating_sub(1);
            let last_computed = computed.saturating_sub(1);
            if sum > last_golden + last_computed {
                return self.without_a_pair(golden, slot, ended);
            }
            for place in sum.saturating_sub(last_golden)..=sum.min(last_computed) {
                let (Some(own), Some(other)) = (self.queue.get(place), ahead.get(sum - place)) else {
                    continue;
                };
                if own.stamp_ns == other.stamp_ns {
                    return Gap::of(sum - place, place);
                }
            }
            self.searched += 1;
        }
    }

    /// No stamp in sight is equal: one side is behind by more than is looked at, or the stamps have nothing in common.
    fn without_a_pair(&self, golden: &mut Golden<'_>, slot: usize, ended: bool) -> Gap {
        let ahead = golden.ahead(slot, LOOK_AHEAD + 1).len();
        let is_everything = ended && ahead <= LOOK_AHEAD && golden.ended(slot);
        let (golden_count, computed_count) = (ahead.min(LOOK_AHEAD), self.queue.len());
        if is_everything && golden_count == computed_count {
            return Gap::OtherStamps(golden_count);
        }
        let bounds = |messages: &VecDeque<Waiting>, count| {
            let stamps = || messages.iter().take(count).map(|message| message.stamp_ns);
            (stamps().min(), stamps().max())
        };
        let (golden_first, golden_last) = bounds(golden.ahead(slot, golden_count), golden_count);
        let (first, last) = bounds(&self.queue, computed_count);
        if golden_last < first {
            Gap::Unpaired { golden: golden_count, computed: 0 }
        } else if last < golden_first {
            Gap::Unpaired { golden: 0, computed: computed_count }
        } else {
            Gap::OtherStamps(golden_count.min(computed_count))
        }
    }
}

impl Gap {
    fn of(golden: usize, computed: usize) -> Self {
        if golden == computed { Self::OtherStamps(golden) } else { Self::Unpaired { golden, computed } }
    }
}
