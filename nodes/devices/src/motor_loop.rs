//! The thread that drives the motors at a fixed rate.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::thread::JoinHandle;

use thiserror::Error;

use crate::force_choice::{Commands, Moment};
use crate::latest::{Sender, latest};
use crate::realtime::{monotonic_ns, request_fifo, sleep_until, system_ns};
use crate::stamp_clock::StampClock;
use crate::tick::Ticker;
use crate::tick::{Counters, ForceLimit};
use crate::{Counts, Device, DeviceError, ForceSource, LawCommand, SampleSender, Scheduling, ServoCommand};

/// How the loop runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorSettings {
    /// Periods per second, 10 to 4000.
    pub rate_hz: f64,
    /// The largest force on the hand, N, >= 0; the device's own limit holds as well.
    pub max_force_n: f64,
    /// Who decides on the force.
    pub source: ForceSource,
    /// `SCHED_FIFO` priority to ask for, 1 to 99.
    pub fifo_priority: i32,
}

/// Why there is no motor loop, or none any more.
#[derive(Debug, Error)]
pub enum MotorError {
    /// The device says it can push with a force that no motor has.
    #[error(
        "the {device} device says that its largest force is {max_force_n} N; accepted is a finite number > 0"
    )]
    Limits {
        /// The backend.
        device: String,
        /// What it says.
        max_force_n: f64,
    },
    /// A rate that is not one.
    #[error("a motor loop of {rate_hz} Hz: accepted is 10 to 4000")]
    Rate {
        /// The rate.
        rate_hz: f64,
    },
    /// The operating system gave no thread.
    #[error("the motor loop's thread did not start: {0}")]
    Thread(#[from] std::io::Error),
    /// The device failed while the loop ran; the motors were switched off.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// The loop's thread panicked; the motors were switched off on the way out.
    #[error("the motor loop panicked")]
    Panicked,
}

/// A running motor loop: a thread of its own that in every period reads the device, computes the force and commands it.
///
/// Deadlines are absolute (`clock_nanosleep` with `TIMER_ABSTIME` on the monotonic clock), so a late period does not
/// shift the ones after it. The thread takes no lock, allocates nothing and calls nothing that waits, but for its own
/// sleep; it asks for `SCHED_FIFO`. Dropping this value stops it and takes the force away.
pub struct MotorLoop {
    laws: Sender<LawCommand>,
    servo: Sender<ServoCommand>,
    limit: Arc<ForceLimit>,
    counters: Arc<Counters>,
    stop: Arc<AtomicBool>,
    scheduling: Scheduling,
    // Joined in drop, before the senders go: the thread must not be the one that frees what they have sent.
    thread: Option<JoinHandle<Result<(), DeviceError>>>,
}

impl MotorLoop {
    /// Starts the loop. Samples go to `samples`, one for each period.
    ///
    /// # Errors
    /// [`MotorError`] when settings or device are unusable, or there is no thread to be had.
    pub fn start(
        device: Box<dyn Device>,
        settings: MotorSettings,
        samples: SampleSender,
    ) -> Result<MotorLoop, MotorError> {
        let MotorSettings { rate_hz, max_force_n, source, fifo_priority } = settings;
        if !(10.0..=4000.0).contains(&rate_hz) {
            return Err(MotorError::Rate { rate_hz });
        }
        let description = device.description();
        let device_n = description.limits.max_force_n.unwrap_or(f64::MIN_POSITIVE);
        if !(device_n.is_finite() && device_n > 0.0) {
            return Err(MotorError::Limits { device: description.backend.to_owned(), max_force_n: device_n });
        }
        let (law_sender, laws) = latest();
        let (servo_sender, servo) = latest();
        let limit = Arc::new(ForceLimit::new(max_force_n));
        let counters = Arc::new(Counters::default());
        let stop = Arc::new(AtomicBool::new(false));
        let ticker = Ticker::new(device, Commands { source, laws, servo }, limit.clone(), counters.clone());
        let period_ns = (1e9 / rate_hz).round() as u64;
        let (report, reported) = crossbeam::channel::bounded(1);
        let shared = (stop.clone(), counters.clone());
        let thread = std::thread::Builder::new().name("motor_loop".to_owned()).spawn(move || {
            // The receiver waits below, so there is room and somebody to take it.
            let _ = report.send(request_fifo(fifo_priority));
            let (stop, counters) = shared;
            run(ticker, period_ns, samples, &stop, &counters)
        })?;
        let scheduling = reported.recv().map_err(|_| MotorError::Panicked)?;
        Ok(MotorLoop {
            laws: law_sender,
            servo: servo_sender,
            limit,
            counters,
            stop,
            scheduling,
            thread: Some(thread),
        })
    }

    /// Gives the loop a newer contact law.
    pub fn send_law(&mut self, command: LawCommand) {
        self.laws.send(command);
    }

    /// Gives the loop a newer force.
    pub fn send_servo(&mut self, command: ServoCommand) {
        self.servo.send(command);
    }

    /// Changes the largest force on the hand, N; what is not a positive number lets no force through.
    pub fn set_max_force_n(&self, max_force_n: f64) {
        self.limit.set(max_force_n);
    }

    /// What has been counted so far.
    pub fn counts(&self) -> Counts {
        self.counters.counts()
    }

    /// How the operating system runs the loop.
    pub fn scheduling(&self) -> Scheduling {
        self.scheduling
    }

    /// False once the loop has ended by itself; [`stop`](MotorLoop::stop) then says why.
    pub fn is_running(&self) -> bool {
        self.thread.as_ref().is_some_and(|thread| !thread.is_finished())
    }

    /// Takes the force away and ends the loop. Returns within about a period; a second call does nothing.
    ///
    /// # Errors
    /// What ended the loop before, or what the device said when it was switched off.
    pub fn stop(&mut self) -> Result<(), MotorError> {
        self.stop.store(true, Relaxed);
        match self.thread.take().map(JoinHandle::join) {
            None => Ok(()),
            Some(Ok(ended)) => Ok(ended?),
            Some(Err(_)) => Err(MotorError::Panicked),
        }
    }
}

impl Drop for MotorLoop {
    fn drop(&mut self) {
        // Whoever wants to know why it ended calls stop first.
        let _ = self.stop();
    }
}

fn run(
    mut ticker: Ticker,
    period_ns: u64,
    mut samples: SampleSender,
    stop: &AtomicBool,
    counters: &Counters,
) -> Result<(), DeviceError> {
    let mut clock = StampClock::new(monotonic_ns(), system_ns());
    let mut deadline_ns = monotonic_ns() + period_ns;
    loop {
        sleep_until(deadline_ns);
        if stop.load(Relaxed) {
            return ticker.off();
        }
        let start_ns = monotonic_ns();
        let late_ns = start_ns.saturating_sub(deadline_ns);
        if late_ns > period_ns / 2 {
            Counters::add(&counters.late_ticks, 1);
        }
        counters.latest_ns.fetch_max(late_ns, Relaxed);
        let now = Moment { monotonic_ns: start_ns, stamp_ns: clock.stamp(start_ns, system_ns()) };
        if let Some(sample) = ticker.tick(now)?
            && !samples.send(sample)
        {
            Counters::add(&counters.lost_samples, 1);
        }
        let (next_ns, skipped) = next_deadline(deadline_ns, period_ns, monotonic_ns());
        Counters::add(&counters.skipped_ticks, skipped);
        deadline_ns = next_ns;
    }
}

/// The deadline after `deadline_ns` and how many are left out: those that are a whole period past at `now_ns`. Running
/// them in a burst would command old positions' forces one after the other.
fn next_deadline(deadline_ns: u64, period_ns: u64, now_ns: u64) -> (u64, u64) {
    let next_ns = deadline_ns + period_ns;
    let skipped = now_ns.saturating_sub(next_ns) / period_ns;
    (next_ns + skipped * period_ns, skipped)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deadlines_stay_on_the_grid_and_whole_missed_periods_are_left_out() {
        assert_eq!(next_deadline(1000, 100, 1010), (1100, 0)); // in time
        assert_eq!(next_deadline(1000, 100, 1150), (1100, 0)); // late: the next one runs at once
        assert_eq!(next_deadline(1000, 100, 1200), (1200, 1));
        assert_eq!(next_deadline(1000, 100, 1437), (1400, 3));
    }
}
