//! The motor loop's thread: periods while there is a device, attempts to open it again while there is none.

use std::sync::Arc;
use std::sync::atomic::Ordering::Relaxed;
use std::time::Duration;

use crate::emergency::Running;
use crate::latest::Receiver;
use crate::motor_loop::check_limits;
use crate::operation::Operation;
use crate::realtime::{block_signals, monotonic_ns, next_deadline, sleep_until, system_ns};
use crate::requests::Askee;
use crate::shared::{Counters, Shared};
use crate::source::Moment;
use crate::stamp_clock::StampClock;
use crate::tick::{Commands, Ticker};
use crate::{Device, DeviceError, LawCommand, MotorSettings, Sample, SampleSender, ServoCommand};

/// Between two attempts to open a device that was lost.
const REOPEN_PERIOD_NS: u64 = 500_000_000;
/// Between two looks at requests while there is no device.
const IDLE_NS: u64 = 5_000_000;
/// Longest way of the force to zero at the end, if the settings would make it longer.
const LONGEST_RELEASE: Duration = Duration::from_millis(500);

/// Opens the device.
pub(crate) type Opener = Box<dyn FnMut() -> Result<Box<dyn Device>, DeviceError> + Send>;

/// Everything the thread owns.
pub(crate) struct MotorThread {
    device: Option<Box<dyn Device>>,
    serial: String,
    open: Opener,
    period_ns: u64,
    settings: MotorSettings,
    operation: Operation,
    commands: Commands,
    shared: Arc<Shared>,
}

impl MotorThread {
    pub(crate) fn new(
        device: Box<dyn Device>,
        open: Opener,
        settings: MotorSettings,
        laws: Receiver<LawCommand>,
        servo: Receiver<ServoCommand>,
        requests: Askee,
        shared: Arc<Shared>,
    ) -> MotorThread {
        MotorThread {
            serial: device.description().serial.clone(),
            device: Some(device),
            open,
            period_ns: (1e9 / settings.rate_hz).round() as u64,
            operation: Operation::new(requests, shared.clone(), &settings),
            commands: Commands { laws, servo },
            settings,
            shared,
        }
    }

    /// The device again, if it is there and the same one. Not RT safe; nothing is being pushed.
    fn reopen(&mut self) -> Result<Box<dyn Device>, String> {
        let device = (self.open)().map_err(|error| error.to_string())?;
        let description = device.description();
        if description.serial != self.serial {
            return Err(format!(
                "there is a {} with serial number {:?}, but this was {:?}; connect that one, or start anew",
                description.model, description.serial, self.serial
            ));
        }
        check_limits(description).map_err(|error| error.to_string())?;
        Ok(device)
    }
}

/// Runs until it is told to end. The motors are then off.
///
/// # Errors
/// What the device said when its motors were switched off at the end.
pub(crate) fn run(mut motor: MotorThread, mut samples: SampleSender) -> Result<(), DeviceError> {
    block_signals();
    let running = Running::begin();
    let mut clock = StampClock::new(monotonic_ns(), system_ns());
    while let Some(mut device) = wait_for_device(&mut motor, &running) {
        // A device that carries no weight says so, which is as good.
        let _ = device.set_gravity_compensation(motor.operation.gravity_compensation());
        let mut ticker =
            Ticker::new(device, &motor.settings, &mut motor.operation, &mut motor.commands, &motor.shared);
        match run_periods(&mut ticker, motor.period_ns, &mut clock, &mut samples, &motor.shared, &running) {
            Ended::Told => return release(&mut ticker, motor.period_ns, &mut clock),
            Ended::Lost => {
                drop(ticker);
                Counters::add(&motor.shared.counters.losses, 1);
                motor.operation.lose_device();
            }
        }
    }
    Ok(())
}

/// The open device, or the one that is found again; none when the loop shall end first.
fn wait_for_device(motor: &mut MotorThread, running: &Running) -> Option<Box<dyn Device>> {
    let mut next_attempt_ns = monotonic_ns() + REOPEN_PERIOD_NS;
    loop {
        if motor.shared.stop.load(Relaxed) || running.is_over() {
            return None;
        }
        if let Some(device) = motor.device.take() {
            return Some(device);
        }
        // Without a device there is nothing that could be lost.
        let _ = motor.operation.serve(None, monotonic_ns());
        let now_ns = monotonic_ns();
        if now_ns >= next_attempt_ns {
            next_attempt_ns = now_ns + REOPEN_PERIOD_NS;
            match motor.reopen() {
                Ok(device) => {
                    motor.device = Some(device);
                    Counters::add(&motor.shared.counters.reopenings, 1);
                    motor.operation.find_device();
                    continue;
                }
                // Whoever has not yet heard of the attempt before needs the newest one only.
                Err(why) => drop(motor.shared.not_reopened.force_push(why)),
            }
        }
        sleep_until(monotonic_ns() + IDLE_NS);
    }
}

/// Why the periods ended.
enum Ended {
    /// Somebody wants the loop to end.
    Told,
    /// The device is gone.
    Lost,
}

fn run_periods(
    ticker: &mut Ticker,
    period_ns: u64,
    clock: &mut StampClock,
    samples: &mut SampleSender,
    shared: &Shared,
    running: &Running,
) -> Ended {
    let counters = &shared.counters;
    let mut deadline_ns = monotonic_ns() + period_ns;
    let mut work_ns = 0;
    loop {
        sleep_until(deadline_ns);
        if shared.stop.load(Relaxed) || running.is_over() {
            return Ended::Told;
        }
        let now = moment(clock);
        let late_ns = now.monotonic_ns.saturating_sub(deadline_ns);
        if late_ns > period_ns / 2 {
            Counters::add(&counters.late_ticks, 1);
        }
        counters.latest_ns.fetch_max(late_ns, Relaxed);
        let ticked = ticker.tick(now);
        let before_ns = std::mem::replace(&mut work_ns, monotonic_ns().saturating_sub(now.monotonic_ns));
        match ticked {
            Ok(Some(sample)) => {
                if !samples.send(Sample { late_ns, work_ns: before_ns, ..sample }) {
                    Counters::add(&counters.lost_samples, 1);
                }
            }
            Ok(None) => {}
            Err(_) => return Ended::Lost,
        }
        let (next_ns, skipped) = next_deadline(deadline_ns, period_ns, monotonic_ns());
        Counters::add(&counters.skipped_ticks, skipped);
        deadline_ns = next_ns;
        if ticker.wants_homing() {
            // May take seconds, and is asked for by a person; the grid begins anew after it.
            ticker.home();
            deadline_ns = monotonic_ns() + period_ns;
        }
    }
}

/// The end: the force to zero at the slew limit, then the motors off.
fn release(ticker: &mut Ticker, period_ns: u64, clock: &mut StampClock) -> Result<(), DeviceError> {
    let give_up_ns = monotonic_ns() + LONGEST_RELEASE.as_nanos() as u64;
    ticker.begin_release();
    while !ticker.is_released() && monotonic_ns() < give_up_ns {
        sleep_until(monotonic_ns() + period_ns);
        if ticker.tick(moment(clock)).is_err() {
            break;
        }
    }
    ticker.off()
}

fn moment(clock: &mut StampClock) -> Moment {
    let monotonic_ns = monotonic_ns();
    Moment { monotonic_ns, stamp_ns: clock.stamp(monotonic_ns, system_ns()) }
}
