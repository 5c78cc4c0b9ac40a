//! A slot for one value that always holds the newest: how commands reach the motor loop.
//!
//! Why not a queue: `crossbeam::queue::ArrayQueue` with capacity 1 and `force_push` keeps the newest too, but its `pop`
//! spins while a writer that has claimed the slot has not yet filled it. A motor loop with real-time priority would then
//! spin for ever on the core that the preempted writer needs. And an `AtomicCell` of a large value takes a lock. Here the
//! value travels as one pointer in an `AtomicCell`, which is one atomic exchange: it waits for nobody on either side, and
//! a reader sees a whole value or none.
//!
//! Who frees: the sender keeps a second reference to everything it has sent and lets go of it, the next time it sends,
//! once nobody else holds it. So the receiver never frees memory, and never allocates.

use std::sync::Arc;

use crossbeam::atomic::AtomicCell;

/// An empty slot and its two ends.
pub(crate) fn latest<T: Send + Sync>() -> (Sender<T>, Receiver<T>) {
    const { assert!(AtomicCell::<Option<Arc<T>>>::is_lock_free(), "one pointer is one atomic exchange") };
    let slot = Arc::new(AtomicCell::new(None));
    (Sender { slot: slot.clone(), lent: Vec::with_capacity(4) }, Receiver { slot, held: None })
}

/// The writing end. Keep it until the receiver is gone: dropping it earlier makes the receiver free what it holds.
pub(crate) struct Sender<T> {
    slot: Arc<AtomicCell<Option<Arc<T>>>>,
    /// Everything that the receiver may still hold.
    lent: Vec<Arc<T>>,
}

impl<T: Send + Sync> Sender<T> {
    /// Puts a value in place of the one before, taken or not. Allocates; never waits.
    pub(crate) fn send(&mut self, value: T) {
        let value = Arc::new(value);
        self.lent.push(value.clone());
        drop(self.slot.swap(Some(value)));
        self.lent.retain(|sent| Arc::strong_count(sent) > 1);
    }
}

/// The reading end.
pub(crate) struct Receiver<T> {
    slot: Arc<AtomicCell<Option<Arc<T>>>>,
    held: Option<Arc<T>>,
}

/// Another reading end of the same slot. A value reaches one of them, so one at a time is read.
#[cfg(feature = "pointer")]
impl<T> Clone for Receiver<T> {
    fn clone(&self) -> Receiver<T> {
        Receiver { slot: self.slot.clone(), held: None }
    }
}

impl<T: Send + Sync> Receiver<T> {
    /// The newest value ever sent; none before the first. RT safe.
    pub(crate) fn newest(&mut self) -> Option<&T> {
        if let Some(new) = self.slot.swap(None) {
            self.held = Some(new);
        }
        self.held.as_deref()
    }

    /// The newest value, if it was sent since the last look. RT safe.
    #[cfg(feature = "pointer")]
    pub(crate) fn news(&mut self) -> Option<&T> {
        self.held = Some(self.slot.swap(None)?);
        self.held.as_deref()
    }

    /// A writing end of the same slot.
    #[cfg(feature = "pointer")]
    pub(crate) fn sender(&self) -> Sender<T> {
        Sender { slot: self.slot.clone(), lent: Vec::with_capacity(4) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

    #[test]
    fn the_newest_value_wins_and_stays() {
        let (mut sender, mut receiver) = latest();
        assert_eq!(receiver.newest(), None);
        sender.send(1);
        sender.send(2);
        assert_eq!(receiver.newest(), Some(&2));
        assert_eq!(receiver.newest(), Some(&2));
        sender.send(3);
        assert_eq!(receiver.newest(), Some(&3));
    }

    #[test]
    fn two_threads_never_see_a_torn_value_nor_an_older_one_after_a_newer() {
        const ROUNDS: u64 = 300_000;
        let (mut sender, mut receiver) = latest::<[u64; 32]>();
        let done = AtomicBool::new(false);
        std::thread::scope(|scope| {
            scope.spawn(|| {
                for round in 1..=ROUNDS {
                    sender.send([round; 32]);
                    // The one held, the one just let go of, the newest, and one whose count was read too early.
                    assert!(sender.lent.len() <= 4, "{} values kept", sender.lent.len());
                }
                done.store(true, Ordering::Release);
            });
            let mut last = 0;
            while !done.load(Ordering::Acquire) || last < ROUNDS {
                if let Some(value) = receiver.newest() {
                    assert!(value.iter().all(|&word| word == value[0]), "torn: {value:?}");
                    assert!(value[0] >= last);
                    last = value[0];
                }
            }
        });
    }

    #[test]
    fn the_receiver_never_drops_a_value() {
        static DROPPED_HERE: AtomicUsize = AtomicUsize::new(0);
        struct Tracked(std::thread::ThreadId);
        impl Drop for Tracked {
            fn drop(&mut self) {
                if std::thread::current().id() != self.0 {
                    DROPPED_HERE.fetch_add(1, Ordering::Relaxed);
                }
            }
        }
        let (mut sender, mut receiver) = latest::<Tracked>();
        let done = AtomicBool::new(false);
        std::thread::scope(|scope| {
            scope.spawn(|| {
                while !done.load(Ordering::Acquire) {
                    receiver.newest();
                }
            });
            for _ in 0..100_000 {
                sender.send(Tracked(std::thread::current().id()));
            }
            done.store(true, Ordering::Release);
        });
        assert_eq!(DROPPED_HERE.load(Ordering::Relaxed), 0);
        drop(receiver);
        drop(sender);
    }
}
