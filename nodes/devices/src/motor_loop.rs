//! The thread that drives the motors at a fixed rate, as its owner sees it.

use std::ops::RangeInclusive;
use std::sync::Arc;
use std::sync::atomic::Ordering::Relaxed;
use std::thread::JoinHandle;

use thiserror::Error;

use crate::latest::{Sender, latest};
use crate::motor_thread::{self, MotorThread};
use crate::realtime::monotonic_ns;
use crate::requests::{Asker, requests};
use crate::safety::CheckedSettings;
use crate::shared::Shared;
use crate::{
    Answer, Counts, Description, Device, DeviceError, ForceSource, LawCommand, MotorStatus, Request,
    SampleSender, Scheduling, ServoCommand, StateCommand, Workspace,
};

/// Accepted rates of the loop, Hz. A slower one would break what is promised of any: with 5 ms between two commands, none
/// of which steps by more than 4 N, the default's 20 N are gone in 25 ms of the 30 that they have, and four commands
/// reach a device within the 20 ms of the shortest watchdog.
pub const RATES_HZ: RangeInclusive<f64> = 200.0..=4000.0;

/// How the loop runs.
#[derive(Clone, Debug, PartialEq)]
pub struct MotorSettings {
    /// Periods per second, within [`RATES_HZ`].
    pub rate_hz: f64,
    /// `SCHED_FIFO` priority to ask for, 1 to 99.
    pub fifo_priority: i32,
    /// CPU to stay on; none: any.
    pub cpu: Option<usize>,
    /// Who decides on the force.
    pub source: ForceSource,
    /// What stands between any source and the motors; checked for this rate.
    pub safety: CheckedSettings,
    /// Motors on at the start.
    pub enable_at_start: bool,
    /// The device carries its own weight, where it can.
    pub gravity_compensation: bool,
}

/// Why there is no motor loop, or none any more.
#[derive(Debug, Error)]
pub enum MotorError {
    /// The device says it can push with a force that no motor has, or stands nowhere.
    #[error("the {device} device says that its {what} is {value}; accepted is a finite number{}", if *is_size { " > 0" } else { "" })]
    Limits {
        /// The backend.
        device: &'static str,
        /// The largest force, torque or gripper force, or a number of the workspace, with its unit.
        what: &'static str,
        /// What it says.
        value: f64,
        /// Whether it has to be larger than zero.
        is_size: bool,
    },
    /// A rate that is not one.
    #[error("a motor loop of {rate_hz} Hz: accepted is {} to {}", RATES_HZ.start(), RATES_HZ.end())]
    Rate {
        /// The rate.
        rate_hz: f64,
    },
    /// The operating system gave no thread.
    #[error("the motor loop's thread did not start: {0}")]
    Thread(#[from] std::io::Error),
    /// The device cannot be opened, or does not confirm that its motors are off.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// The loop's thread panicked; the motors were switched off on the way out.
    #[error("the motor loop panicked")]
    Panicked,
}

/// A running motor loop: a thread of its own that in every period reads the device, chooses the force, makes it safe and
/// commands it.
///
/// Deadlines are absolute (`clock_nanosleep` with `TIMER_ABSTIME` on the monotonic clock), so a late period does not
/// shift the ones after it. The thread takes no lock, allocates nothing and calls nothing that waits, but for its own
/// sleep, as long as there is a device; a device that is lost is a fault, and the thread then tries to open it again.
/// Dropping this value brings the force to zero at the slew limit and switches the motors off.
pub struct MotorLoop {
    laws: Sender<LawCommand>,
    servo: Sender<ServoCommand>,
    asker: Asker,
    shared: Arc<Shared>,
    scheduling: Scheduling,
    description: Description,
    enabled: Option<Answer>,
    // Joined in drop, before the senders go: the thread must not be the one that frees what they have sent.
    thread: Option<JoinHandle<Result<(), DeviceError>>>,
}

impl MotorLoop {
    /// Opens the device and starts the loop. `open` is called again, in the loop's thread, when the device is lost.
    /// Samples go to `samples`, one for each period.
    ///
    /// # Errors
    /// [`MotorError`] when settings or device are unusable, or there is no thread to be had.
    pub fn start(
        mut open: impl FnMut() -> Result<Box<dyn Device>, DeviceError> + Send + 'static,
        settings: MotorSettings,
        samples: SampleSender,
    ) -> Result<MotorLoop, MotorError> {
        if !RATES_HZ.contains(&settings.rate_hz) {
            return Err(MotorError::Rate { rate_hz: settings.rate_hz });
        }
        let device = open()?;
        let description = device.description().clone();
        check_limits(&description)?;
        let (law_sender, laws) = latest();
        let (servo_sender, servo) = latest();
        let (asker, askee) = requests();
        let shared = Arc::new(Shared::new(settings.safety.max_force_n, monotonic_ns()));
        let MotorSettings { fifo_priority: priority, cpu, enable_at_start, .. } = settings;
        let motor = MotorThread::new(device, Box::new(open), settings, laws, servo, askee, shared.clone());
        let (report, reported) = crossbeam::channel::bounded(1);
        let thread = std::thread::Builder::new().name("motor_loop".to_owned()).spawn(move || {
            // The receiver waits below, so there is room and somebody to take it.
            let _ = report.send(Scheduling::request(priority, cpu));
            motor_thread::run(motor, samples)
        })?;
        let scheduling = reported.recv().map_err(|_| MotorError::Panicked)?;
        let mut motor = MotorLoop {
            laws: law_sender,
            servo: servo_sender,
            asker,
            shared,
            scheduling,
            description,
            enabled: None,
            thread: Some(thread),
        };
        if enable_at_start {
            motor.enabled = Some(motor.request(Request::State(StateCommand::Enable)));
        }
        Ok(motor)
    }

    /// The device.
    pub fn description(&self) -> &Description {
        &self.description
    }

    /// How the operating system runs the loop.
    pub fn scheduling(&self) -> &Scheduling {
        &self.scheduling
    }

    /// What came of [`MotorSettings::enable_at_start`]; none when it is off. Anything but [`Answer::Accepted`] leaves the
    /// motors off until a command.
    pub fn enabled_at_start(&self) -> Option<Answer> {
        self.enabled
    }

    /// Hands over a contact law. The newest one wins.
    pub fn send_law(&mut self, law: LawCommand) {
        self.laws.send(law);
    }

    /// Hands over a commanded wrench. The newest one wins.
    pub fn send_servo(&mut self, servo: ServoCommand) {
        self.servo.send(servo);
    }

    /// Asks something of the loop and waits for its answer, at most 100 ms.
    pub fn request(&mut self, request: Request) -> Answer {
        self.asker.ask(request)
    }

    /// The emergency stop is pressed, or released. Seen by the loop in its next period, whatever else it was asked; a
    /// press is a fault even when it is released before that.
    pub fn set_emergency_stop(&self, pressed: bool) {
        self.shared.set_emergency_stop(pressed);
    }

    /// Says that the owner lives. To be called more often than [`SafetySettings::ros_timeout_s`].
    pub fn beat(&self) {
        self.shared.beat(monotonic_ns());
    }

    /// Changes the largest force, N. From the next period on.
    pub fn set_max_force_n(&self, max_force_n: f64) {
        self.shared.set_max_force_n(max_force_n);
    }

    /// The operating state and what goes with it.
    pub fn status(&self) -> MotorStatus {
        self.shared.status()
    }

    /// What the loop has counted.
    pub fn counts(&self) -> Counts {
        self.shared.counters.counts()
    }

    /// Why the last attempt to open a lost device again failed, if there was one since the last call.
    pub fn take_not_reopened(&self) -> Option<String> {
        self.shared.not_reopened.pop()
    }

    /// False when the loop has ended: after a panic, or [`motors_off_at_once`](crate::motors_off_at_once).
    pub fn is_running(&self) -> bool {
        self.thread.as_ref().is_some_and(|thread| !thread.is_finished())
    }

    /// Brings the force to zero at the slew limit, switches the motors off and ends the loop; a second call does nothing.
    ///
    /// # Errors
    /// What the device said when it was switched off.
    pub fn stop(&mut self) -> Result<(), MotorError> {
        self.shared.stop.store(true, Relaxed);
        match self.thread.take().map(JoinHandle::join) {
            None => Ok(()),
            Some(Ok(ended)) => Ok(ended?),
            Some(Err(_)) => Err(MotorError::Panicked),
        }
    }
}

impl Drop for MotorLoop {
    fn drop(&mut self) {
        // Whoever wants to know how it ended calls stop first.
        let _ = self.stop();
    }
}

/// A device without motors is one; motors without a strength are not, nor is a workspace that is nowhere.
pub(crate) fn check_limits(description: &Description) -> Result<(), MotorError> {
    let limits = &description.limits;
    let Workspace { centre, radius_m, height_m } = limits.workspace;
    let sizes = [
        ("largest force [N]", limits.max_force_n),
        ("largest torque [N m]", limits.max_torque_n_m),
        ("largest gripper force [N]", limits.max_gripper_force_n),
        ("workspace's radius [m]", Some(radius_m)),
        ("workspace's height [m]", Some(height_m)),
    ];
    let places = [
        ("workspace's centre x [m]", Some(centre.x)),
        ("workspace's centre y [m]", Some(centre.y)),
        ("workspace's centre z [m]", Some(centre.z)),
    ];
    for (numbers, is_size) in [(&sizes[..], true), (&places[..], false)] {
        for &(what, value) in numbers {
            if let Some(value) = value
                && !(value.is_finite() && (value > 0.0 || !is_size))
            {
                return Err(MotorError::Limits { device: description.backend, what, value, is_size });
            }
        }
    }
    Ok(())
}
