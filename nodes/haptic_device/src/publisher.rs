//! The thread that publishes what the motor loop measured, as soon as it is there and in order.

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use devices::{Sample, SampleReceiver};
use node_kit::Log;

use crate::answers::Answers;
use crate::outbox::Outbox;

/// Longest sleep, so that the thread sees that it shall end.
const LONGEST_SLEEP: Duration = Duration::from_millis(20);

/// What the publisher thread and the node's thread both look at. The motor loop does not.
pub(crate) struct Exchange {
    /// Poses and the forces for them.
    pub(crate) answers: Answers,
    /// The largest force that the motors were given, N.
    pub(crate) peak_force_n: f64,
    /// The greatest depth by the contact law, m.
    pub(crate) peak_depth_m: f64,
    /// The newest sample.
    pub(crate) newest: Option<Sample>,
    /// Messages that could not be sent.
    pub(crate) unsent: u64,
}

impl Exchange {
    pub(crate) fn new(period_ns: u64) -> Exchange {
        let answers = Answers::new(period_ns);
        Exchange { answers, peak_force_n: 0.0, peak_depth_m: 0.0, newest: None, unsent: 0 }
    }
}

/// Both threads only count and compare while they hold the lock, so neither leaves it in disorder.
pub(crate) fn lock(exchange: &Mutex<Exchange>) -> MutexGuard<'_, Exchange> {
    exchange.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The running thread.
pub(crate) struct PublisherThread {
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl PublisherThread {
    /// Starts publishing what comes out of `samples`.
    pub(crate) fn start(
        outbox: Outbox,
        samples: SampleReceiver,
        exchange: Arc<Mutex<Exchange>>,
        log: Log,
    ) -> std::io::Result<PublisherThread> {
        let stop = Arc::new(AtomicBool::new(false));
        let asked_to_stop = stop.clone();
        let work = Work { outbox, samples, exchange, log };
        let thread = std::thread::Builder::new()
            .name("publisher".to_owned())
            .spawn(move || work.run(&asked_to_stop))?;
        Ok(PublisherThread { stop, thread: Some(thread) })
    }

    /// Publishes what is still there and ends.
    pub(crate) fn finish(&mut self) {
        self.stop.store(true, Relaxed);
        if let Some(thread) = self.thread.take() {
            // A panic has ended the process already.
            let _ = thread.join();
        }
    }
}

impl Drop for PublisherThread {
    fn drop(&mut self) {
        // The publishers must not be used when the node is gone.
        self.finish();
    }
}

struct Work {
    outbox: Outbox,
    samples: SampleReceiver,
    exchange: Arc<Mutex<Exchange>>,
    log: Log,
}

impl Work {
    fn run(mut self, stop: &AtomicBool) {
        loop {
            // Looked at before the ring: what the motor loop wrote before it ended is still published.
            let ending = stop.load(Relaxed);
            match self.samples.recv_timeout(LONGEST_SLEEP) {
                Some(sample) => self.publish(&sample),
                None if ending => return,
                None => {}
            }
        }
    }

    fn publish(&mut self, sample: &Sample) {
        let with_pose = self.outbox.takes_pose();
        {
            let mut exchange = lock(&self.exchange);
            if with_pose {
                // Before it is sent: the force may be back before this thread runs again.
                exchange.answers.sent(sample.stamp_ns, sample.monotonic_ns);
            }
            exchange.peak_force_n = exchange.peak_force_n.max(sample.wrench.force_n.length());
            exchange.peak_depth_m = exchange.peak_depth_m.max(sample.depth_m);
            exchange.newest = Some(*sample);
        }
        if let Err(error) = self.outbox.publish(sample, with_pose) {
            let mut exchange = lock(&self.exchange);
            exchange.unsent += 1;
            if exchange.unsent == 1 {
                self.log.error(&format!("{error}; further ones are counted in the diagnostics"));
            }
        }
    }
}
