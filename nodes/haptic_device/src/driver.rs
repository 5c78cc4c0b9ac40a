//! The node: opens the device, starts motor loop and publisher, then carries forces, laws and orders to the motor loop
//! until it is told to end.

use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, anyhow};
use devices::{
    Answer, Backend, Description, Device, DeviceError, MotorError, MotorLoop, MotorSettings, SampleSender,
    Scheduling, samples,
};
use node_kit::NodeKit;
use scene::{Scene, Value};

use crate::backend::backend;
use crate::decimation::EveryNth;
use crate::desk::Desk;
use crate::emergency_stop::EmergencyStop;
use crate::forces::Forces;
use crate::motor_settings::motor_settings;
use crate::operating_report::OperatingReport;
use crate::outbox::Outbox;
#[cfg(feature = "pointer")]
use crate::pointer::Pointer;
use crate::publisher::{Exchange, PublisherThread, lock};
use crate::report::Health;
use crate::shared::Shared;
use crate::standing::Standing;
use crate::wrench_frame::DeviceFrames;

/// Samples that the publisher may be behind before some are lost: 1 s at 4 kHz.
const RING: usize = 4096;
/// A message ends the wait; this is how late the end of the session is seen.
const TURN: Duration = Duration::from_millis(10);
/// How long forces that are on their way are waited for at the end.
const LAST_FORCES: Duration = Duration::from_millis(200);
/// Between the discovery of the last reader and the first pose: time for the readers to discover this node, too.
const SETTLE: Duration = Duration::from_millis(300);
/// Between two lines about readers that are missing.
const REMINDER: Duration = Duration::from_secs(5);

/// Runs the driver until the process is asked to end. `around` may put something around the device that was opened.
pub(crate) fn run(kit: &mut NodeKit, around: impl FnOnce(Box<dyn Device>) -> Box<dyn Device>) -> Result<()> {
    let scene = Scene::from_parameters(kit.parameters().clone())?;
    let mut settings = motor_settings(&scene)?;
    let backend = backend(&scene, kit.log())?;
    let mut device = around(backend.open()?);
    let clutch_button = clutch_button(&scene, device.description())?;
    let can_carry_itself = can_carry_itself(&mut *device, settings.gravity_compensation)?;

    let pose_is_due = EveryNth::of_rates(settings.rate_hz, scene.device.pose_rate_hz);
    let pose_period_ns = (f64::from(pose_is_due.n()) * 1e9 / settings.rate_hz) as u64;
    let shared = Shared {
        description: device.description().clone(),
        frames: DeviceFrames::new(kit.frame_id(&scene.device.frame_id)),
        body_is_absolute: Arc::new(AtomicBool::new(scene.device.body_cf_absolute)),
        exchange: Arc::new(Mutex::new(Exchange::new(pose_period_ns))),
    };
    let _standing = Standing::new(kit, &scene, &shared.frames.base)?;
    let outbox = Outbox::new(kit, &shared, clutch_button, pose_is_due)?;
    let mut emergency_stop = EmergencyStop::new(kit, &scene.session.devices)?;
    let desk = Desk::new(kit, &shared, can_carry_itself)?;
    let forces = Forces::new(kit, &shared, &scene, &settings.safety)?;
    #[cfg(feature = "pointer")]
    let pointer = match &backend {
        Backend::Pointer(hand) => {
            Some(Pointer::new(kit, &scene, &shared.frames.base, hand.targets.sender())?)
        }
        _ => None,
    };
    only_lower_max_force(kit, scene.device.max_force_n);
    let report = OperatingReport::new(&shared.description, &settings.safety, settings.source);
    report.warn(kit.log());
    wait_for_readers(kit, &outbox, scene.device.wait_for_readers);
    if !kit.is_running() {
        return Ok(());
    }

    let (sender, receiver) = samples(RING);
    let publisher = PublisherThread::start(outbox, receiver, shared.exchange.clone(), kit.log().clone())
        .context("the publisher thread did not start")?;
    // A stop that was pressed before this driver came counts as well.
    let is_stopped = emergency_stop.was_pressed_before(kit)?;
    settings.enable_at_start &= !is_stopped;
    let motor = start_motor(device, backend, settings, sender)?;
    motor.set_emergency_stop(is_stopped);
    tell_scheduling(kit, motor.scheduling());
    tell_start(kit, &motor);
    let Shared { description, frames, .. } = &shared;
    kit.ready(&format!(
        "{} ({}) at {} Hz in frame {}",
        description.model, description.backend, scene.device.rate_hz, frames.base
    ));
    let max_force_n = scene.device.max_force_n;
    Driver {
        motor,
        publisher,
        shared,
        emergency_stop,
        desk,
        forces,
        #[cfg(feature = "pointer")]
        pointer,
        report,
        not_reopened: (0, String::new()),
        max_force_n,
    }
    .run(kit)
}

struct Driver {
    // Dropped first: motors off before anything else goes.
    motor: MotorLoop,
    publisher: PublisherThread,
    shared: Shared,
    emergency_stop: EmergencyStop,
    desk: Desk,
    forces: Forces,
    /// None for another backend.
    #[cfg(feature = "pointer")]
    pointer: Option<Pointer>,
    report: OperatingReport,
    /// Which loss of the device was told last, and why it was not opened again.
    not_reopened: (u64, String),
    max_force_n: f64,
}

impl Driver {
    fn run(mut self, kit: &mut NodeKit) -> Result<()> {
        let mut reported = self.health();
        while kit.is_running() && self.motor.is_running() {
            let changed = self.turn(kit)?;
            if kit.diagnostics_due() {
                let health = self.health();
                let statuses = self.statuses(&health, &reported);
                kit.publish_diagnostics(statuses)?;
                reported = health;
            } else if changed {
                kit.publish_diagnostics(vec![self.operating_status()])?;
            }
        }
        self.close(kit)
    }

    /// Waits for messages and parameters and passes them on. True when the operating state has changed.
    fn turn(&mut self, kit: &mut NodeKit) -> Result<bool> {
        for change in kit.spin_once(TURN) {
            if let ("device.max_force", Value::Double(max_force_n)) = (change.name, &change.value) {
                self.max_force_n = *max_force_n;
                self.motor.set_max_force_n(*max_force_n);
            }
        }
        self.motor.beat();
        self.emergency_stop.take(kit, &self.motor)?;
        #[cfg(feature = "pointer")]
        if let Some(pointer) = &mut self.pointer
            && pointer.take(kit)
        {
            kit.publish_diagnostics(vec![pointer.status()])?;
        }
        if self.forces.take(kit, &mut self.motor) {
            self.desk.follow_again(kit, &mut self.motor);
        }
        self.tell_lost_device(kit);
        Ok(self.desk.take(kit, &mut self.motor)?)
    }

    /// Says why a lost device is not opened again; the same reason once for each loss.
    fn tell_lost_device(&mut self, kit: &NodeKit) {
        let Some(why) = self.motor.take_not_reopened() else { return };
        let told = (self.motor.counts().losses, why);
        if told != self.not_reopened {
            kit.log().warn(&format!("the lost device is looked for: {}", told.1));
            self.not_reopened = told;
        }
    }

    fn health(&self) -> Health {
        let exchange = lock(&self.shared.exchange);
        Health {
            answers: exchange.answers.report(),
            counts: self.motor.counts(),
            force_n: exchange.newest.map_or(0.0, |sample| sample.wrench.force_n.length()),
            peak_force_n: exchange.peak_force_n,
            peak_depth_m: exchange.peak_depth_m,
            max_force_n: self.max_force_n,
            forces: self.forces.counts(),
            unsent: exchange.unsent,
        }
    }

    fn statuses(&mut self, health: &Health, before: &Health) -> Vec<node_kit::Status> {
        let conflicts = self.forces.conflicts();
        let mut statuses = health.statuses(before, &conflicts, &self.motor.scheduling().to_string());
        statuses.push(self.operating_status());
        statuses.push(self.emergency_stop.status());
        #[cfg(feature = "pointer")]
        statuses.extend(self.pointer.as_mut().map(Pointer::status));
        statuses
    }

    fn operating_status(&self) -> node_kit::Status {
        let newest = lock(&self.shared.exchange).newest;
        self.report.status(self.motor.status(), newest.as_ref())
    }

    /// Motors off first, then what was measured, then the forces still on their way, then the report.
    fn close(mut self, kit: &mut NodeKit) -> Result<()> {
        let ended = self.motor.stop();
        self.publisher.finish();
        let deadline = Instant::now() + LAST_FORCES;
        while Instant::now() < deadline && !lock(&self.shared.exchange).answers.is_complete() {
            self.turn(kit)?;
        }
        self.desk.tell_end()?;
        #[cfg_attr(not(feature = "pointer"), expect(unused_mut, reason = "nothing to add"))]
        let mut report = self.health().closing();
        #[cfg(feature = "pointer")]
        if let Some(pointer) = &self.pointer {
            report["pointer"] = pointer.closing();
        }
        kit.closing_report(&report);
        ended.context("the motor loop ended; the motors are off")
    }
}

/// Starts with the device that is open already; `backend` opens it again when it is lost.
fn start_motor(
    device: Box<dyn Device>,
    backend: Backend,
    settings: MotorSettings,
    samples: SampleSender,
) -> Result<MotorLoop, MotorError> {
    // Whatever is connected meanwhile, a device that was lost is that one.
    let backend = backend.for_serial(&device.description().serial);
    let mut open = Some(device);
    let opener = move || match open.take() {
        Some(device) => Ok(device),
        None => backend.open(),
    };
    MotorLoop::start(opener, settings, samples)
}

/// What the operating system granted the motor loop; what it refused is worth a warning.
fn tell_scheduling(kit: &NodeKit, scheduling: &Scheduling) {
    let text = format!("motor loop: {scheduling}");
    if scheduling.is_granted() { kit.log().info(&text) } else { kit.log().warn(&text) }
}

/// Motors that did not go on at the start, although they should have.
fn tell_start(kit: &NodeKit, motor: &MotorLoop) {
    let why = match motor.enabled_at_start() {
        None | Some(Answer::Accepted(_)) => return,
        Some(Answer::Refused(state)) => format!("the operating state is {state}"),
        Some(Answer::Unanswered) => "the motor loop did not answer within 100 ms".to_owned(),
    };
    kit.log().warn(&format!("device.enable_at_start: the motors are off, because {why}; command enable"));
}

/// Sets the gravity compensation; false for a device that has none.
fn can_carry_itself(device: &mut dyn Device, on: bool) -> Result<bool, DeviceError> {
    match device.set_gravity_compensation(on) {
        Ok(()) => Ok(true),
        Err(DeviceError::Unsupported { .. }) => Ok(false),
        Err(error) => Err(error),
    }
}

/// The number of the clutch button; none without a clutch.
fn clutch_button(scene: &Scene, device: &Description) -> Result<Option<u32>> {
    let Some(text) = &scene.session.clutch_button else { return Ok(None) };
    let buttons = device.buttons.len() as u32;
    match text.parse() {
        Ok(button) if button < buttons => Ok(Some(button)),
        _ => Err(anyhow!(
            "clutch.button \"{text}\": {} has {buttons} buttons ({}); accepted are the number of one, \"0\" for the \
             first, and \"\" for none",
            device.model,
            device.buttons.join(", ")
        )),
    }
}

/// While a hand is on the handle the limit may only become safer.
fn only_lower_max_force(kit: &mut NodeKit, at_start_n: f64) {
    kit.check_changes(Box::new(move |after, _| match after.double("device.max_force") {
        Ok(max_force_n) if max_force_n > at_start_n => Err(format!(
            "device.max_force: {max_force_n} N is more than the {at_start_n} N at the start; while the node runs only up \
             to that is accepted"
        )),
        _ => Ok(()),
    }));
}

/// Waits until `count` subscriptions of the poses are there, so that nobody misses the first one.
fn wait_for_readers(kit: &mut NodeKit, outbox: &Outbox, count: usize) {
    if count == 0 {
        return;
    }
    let mut remind_at = Instant::now() + REMINDER;
    while kit.is_running() && outbox.readers() < count {
        kit.spin_once(TURN);
        if Instant::now() >= remind_at {
            remind_at += REMINDER;
            let found = outbox.readers();
            kit.log().warn(&format!(
                "device.wait_for_readers: {found} of {count} readers of measured_cp are there"
            ));
        }
    }
    let settled = Instant::now() + SETTLE;
    while kit.is_running() && Instant::now() < settled {
        kit.spin_once(TURN);
    }
}
