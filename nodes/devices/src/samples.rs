//! The way out of the motor loop: every sample, in order, to a thread that may block.
//!
//! A bounded single-producer single-consumer ring (rtrb: wait-free on both sides; `crossbeam::queue::ArrayQueue` makes its
//! producer spin behind a preempted consumer when nearly full). The reader sleeps parked; `unpark` is at most one
//! system call that wakes it and never blocks.

use std::sync::{Arc, OnceLock};
use std::thread::Thread;
use std::time::Duration;

use crate::Sample;

/// An empty ring for `capacity` samples and its two ends.
pub fn samples(capacity: usize) -> (SampleSender, SampleReceiver) {
    let (ring, drain) = rtrb::RingBuffer::new(capacity);
    let reader = Arc::new(OnceLock::new());
    (SampleSender { ring, reader: reader.clone() }, SampleReceiver { drain, reader })
}

/// The motor loop's end.
#[derive(Debug)]
pub struct SampleSender {
    ring: rtrb::Producer<Sample>,
    reader: Arc<OnceLock<Thread>>,
}

impl SampleSender {
    /// Hands over a sample and wakes the reader; false when the ring is full and the sample is lost. RT safe.
    pub fn send(&mut self, sample: Sample) -> bool {
        let taken = self.ring.push(sample).is_ok();
        if let Some(reader) = self.reader.get() {
            reader.unpark();
        }
        taken
    }
}

/// The reader's end.
#[derive(Debug)]
pub struct SampleReceiver {
    drain: rtrb::Consumer<Sample>,
    reader: Arc<OnceLock<Thread>>,
}

impl SampleReceiver {
    /// The next sample, without waiting.
    pub fn try_recv(&mut self) -> Option<Sample> {
        self.drain.pop().ok()
    }

    /// The next sample, waiting for it up to `timeout`. None: nothing came, or the thread was woken for another reason.
    /// All waiting must happen in one thread, the first that calls this.
    pub fn recv_timeout(&mut self, timeout: Duration) -> Option<Sample> {
        // Registered before the ring is looked at, so a sample pushed in between finds somebody to wake.
        self.reader.get_or_init(std::thread::current);
        self.try_recv().or_else(|| {
            std::thread::park_timeout(timeout);
            self.try_recv()
        })
    }

    /// Whether the motor loop is gone; what it left in the ring can still be read.
    pub fn is_abandoned(&self) -> bool {
        self.drain.is_abandoned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DeviceState, FaultCause, ForceOrigin, LimitsHit, OperatingState, Wrench};
    use rhombus_chain::Pose;

    /// A sample that says nothing but its stamp.
    fn sample(stamp_ns: i64) -> Sample {
        Sample {
            stamp_ns,
            monotonic_ns: 0,
            late_ns: 0,
            work_ns: 0,
            state: DeviceState::at_rest(Pose::IDENTITY),
            wrench: Wrench::ZERO,
            origin: ForceOrigin::Nobody,
            depth_m: 0.0,
            operating: OperatingState::Disabled,
            fault: None::<FaultCause>,
            limits_hit: LimitsHit::NONE,
            energy: crate::safety::Energy::default(),
        }
    }

    #[test]
    fn samples_come_out_in_order_and_a_full_ring_refuses_the_newest() {
        let (mut sender, mut receiver) = samples(3);
        let taken: Vec<bool> = (0..5).map(|stamp_ns| sender.send(sample(stamp_ns))).collect();
        assert_eq!(taken, [true, true, true, false, false]);
        let out: Vec<i64> = std::iter::from_fn(|| receiver.try_recv()).map(|s| s.stamp_ns).collect();
        assert_eq!(out, [0, 1, 2]);
    }

    #[test]
    fn a_waiting_reader_gets_every_sample() {
        const COUNT: i64 = 20_000;
        let (mut sender, mut receiver) = samples(64);
        std::thread::scope(|scope| {
            scope.spawn(move || {
                for stamp_ns in 0..COUNT {
                    while !sender.send(sample(stamp_ns)) {
                        std::thread::yield_now();
                    }
                }
            });
            let mut next = 0;
            while next < COUNT {
                if let Some(sample) = receiver.recv_timeout(Duration::from_secs(10)) {
                    assert_eq!(sample.stamp_ns, next);
                    next += 1;
                }
            }
            // A sender that dies does not leave the reader asleep for ever: it is seen as abandoned.
            while !receiver.is_abandoned() {
                std::thread::yield_now();
            }
        });
    }
}
