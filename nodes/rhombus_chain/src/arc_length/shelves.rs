//! A queue that hands out its entries nearly in the order of their keys.

/// "Nothing here" in the links of the queue.
pub(super) const NONE: u32 = u32::MAX;

/// Number of shelves.
const SHELVES: usize = 512;

/// Entries are put on shelves of equal depth by their key; on a shelf the last to come is the first to be
/// served.
///
/// An exact order would cost more than it saves where an entry that comes a little late does no harm. The
/// entries belong to the caller, who keeps for each the number of the one behind it.
#[derive(Clone, Debug)]
pub(super) struct Shelves {
    /// First entry of each shelf; keys one round of shelves apart share one.
    first: Box<[u32; SHELVES]>,
    per_m: f64,
    /// The shelf being served, counted through all rounds.
    present: u64,
    waiting: usize,
}

impl Shelves {
    /// For keys that exceed the one last served by at most `span_m`, in steps of `depth_m` if the shelves
    /// allow.
    pub(super) fn new(depth_m: f64, span_m: f64) -> Self {
        let depth_m = depth_m.max(span_m / (SHELVES - 2) as f64);
        Self { first: Box::new([NONE; SHELVES]), per_m: 1.0 / depth_m, present: 0, waiting: 0 }
    }

    /// Begins again at key 0. The queue has to be empty.
    pub(super) fn restart(&mut self) {
        self.present = 0;
    }

    /// Puts `entry` on its shelf; returns the entry that is now behind it.
    #[inline]
    pub(super) fn push(&mut self, entry: u32, key_m: f64) -> u32 {
        let shelf = u64::from((key_m * self.per_m) as u32).max(self.present);
        self.waiting += 1;
        std::mem::replace(&mut self.first[shelf as usize % SHELVES], entry)
    }

    /// Takes the next entry; `behind` says which one is behind it.
    #[inline]
    pub(super) fn pop(&mut self, behind: impl FnOnce(u32) -> u32) -> Option<u32> {
        if self.waiting == 0 {
            return None;
        }
        loop {
            let first = &mut self.first[self.present as usize % SHELVES];
            if *first != NONE {
                let entry = *first;
                *first = behind(entry);
                self.waiting -= 1;
                return Some(entry);
            }
            self.present += 1;
        }
    }
}
