//! The newest command on its way from the motor loop to the thread that talks to the service.
//!
//! [`latest`](crate::latest) allocates where it sends, which a motor loop must not. Here it sends: the numbers are atomics
//! between two counts of one counter (a sequence lock), so writing waits for nothing, and who reads looks again when a
//! write came in between.

use std::sync::atomic::{AtomicU64, Ordering, fence};

use glam::DVec3;

/// A force with the time at which it was commanded. One writer.
#[derive(Debug, Default)]
pub(super) struct CommandSlot {
    /// Odd while the numbers are being written.
    count: AtomicU64,
    numbers: [AtomicU64; 4],
}

impl CommandSlot {
    /// Puts a command in place of the one before. RT safe.
    pub(super) fn write(&self, force_n: DVec3, at_ns: u64) {
        let count = self.count.load(Ordering::Relaxed);
        self.count.store(count.wrapping_add(1), Ordering::Relaxed);
        fence(Ordering::Release);
        let numbers = [force_n.x.to_bits(), force_n.y.to_bits(), force_n.z.to_bits(), at_ns];
        for (slot, number) in self.numbers.iter().zip(numbers) {
            slot.store(number, Ordering::Relaxed);
        }
        self.count.store(count.wrapping_add(2), Ordering::Release);
    }

    /// The newest command and its time; none when the writer was in between each time it was looked at.
    pub(super) fn read(&self) -> Option<(DVec3, u64)> {
        for _ in 0..16 {
            let before = self.count.load(Ordering::Acquire);
            let [x, y, z, at_ns] = std::array::from_fn(|i| self.numbers[i].load(Ordering::Relaxed));
            fence(Ordering::Acquire);
            if before.is_multiple_of(2) && self.count.load(Ordering::Relaxed) == before {
                return Some((DVec3::new(f64::from_bits(x), f64::from_bits(y), f64::from_bits(z)), at_ns));
            }
            std::hint::spin_loop();
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn a_reader_never_sees_half_of_a_command_nor_an_older_one_after_a_newer() {
        let (slot, done) = (CommandSlot::default(), AtomicBool::new(false));
        std::thread::scope(|scope| {
            scope.spawn(|| {
                for round in 1..=300_000u64 {
                    slot.write(DVec3::splat(round as f64), round);
                }
                done.store(true, Ordering::Release);
            });
            let mut last = 0;
            while !done.load(Ordering::Acquire) {
                if let Some((force, at)) = slot.read() {
                    assert_eq!(force, DVec3::splat(at as f64));
                    assert!(at >= last);
                    last = at;
                }
            }
            assert_eq!(slot.read(), Some((DVec3::splat(300_000.0), 300_000)));
        });
    }
}
