//! The node: starts device, motor loop and publisher, then carries forces and laws to the motor loop until it is told to
//! end.

use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use anyhow::{Context, Result, anyhow};
use devices::{ForceSource, LawCommand, MotorLoop, MotorSettings, ServoCommand, monotonic_ns, samples};
use node_kit::{Inbox, NodeKit, Throttle, convert, frames, topics};
use r2r::geometry_msgs::msg::WrenchStamped;
use r2r::rhombus_haptics_msgs::msg::ContactLaw;
use scene::{Scene, Value};

use crate::backend::backend;
use crate::law_message::LawReader;
use crate::publisher::{DeviceTopics, Exchange, PublisherThread, lock};
use crate::report::Health;
use crate::stability_watch::StabilityWatch;

/// Samples that the publisher may be behind before some are lost: 4 s at 1 kHz.
const RING: usize = 4096;
/// Real-time priority of the motor loop: the middle, as robot controllers take it.
const FIFO_PRIORITY: i32 = 50;
/// A message ends the wait; this is how late the end of the session is seen.
const TURN: Duration = Duration::from_millis(10);
/// How long forces that are on their way are waited for at the end.
const LAST_FORCES: Duration = Duration::from_millis(200);
/// Between the discovery of the last reader and the first pose: time for the readers to discover this node, too.
const SETTLE: Duration = Duration::from_millis(300);
/// Between two lines about readers that are missing.
const REMINDER: Duration = Duration::from_secs(5);

/// Runs the driver until the process is asked to end or the device is lost.
pub(crate) fn run(kit: &mut NodeKit) -> Result<()> {
    let scene = Scene::from_parameters(kit.parameters().clone())?;
    let clutch_button = clutch_button(&scene)?;
    let source: ForceSource = scene.device.force_source.parse().map_err(|text: String| anyhow!(text))?;
    let device = backend(&scene, kit.log())?.open()?;
    let name = device.name().to_owned();
    let frame_id = kit.frame_id(&scene.device.frame_id);

    let topics = DeviceTopics::new(kit, clutch_button)?;
    let servo_cf = kit.subscribe(&topics::SERVO_CF, "")?;
    let contact_law = kit.subscribe(&topics::CONTACT_LAW, "")?;
    only_lower_max_force(kit, scene.device.max_force_n);
    wait_for_readers(kit, &topics, scene.device.wait_for_readers);

    let exchange = Arc::new(Mutex::new(Exchange::new((1e9 / scene.device.rate_hz) as u64)));
    let (sender, receiver) = samples(RING);
    let publisher =
        PublisherThread::start(topics, frame_id.clone(), receiver, exchange.clone(), kit.log().clone())
            .context("the publisher thread did not start")?;
    let settings = MotorSettings {
        rate_hz: scene.device.rate_hz,
        max_force_n: scene.device.max_force_n,
        source,
        fifo_priority: FIFO_PRIORITY,
    };
    let motor = MotorLoop::start(device, settings, sender)?;
    let scheduling = motor.scheduling().to_string();
    kit.log().info(&format!("motor loop: {scheduling}"));
    kit.ready(&format!("{name} device at {} Hz in frame {frame_id}", scene.device.rate_hz));

    let mut driver = Driver {
        motor,
        publisher,
        exchange,
        inboxes: Inboxes { servo_cf, contact_law },
        reader: LawReader::new(frame_id.clone()),
        frame_id,
        max_force_n: scene.device.max_force_n,
        stability: StabilityWatch::new(&scene),
        unstable: Throttle::new(Duration::from_secs(1)),
        laws: 0,
        rejected: 0,
        rejections: Throttle::new(Duration::from_secs(1)),
    };
    let mut reported = driver.health();
    while kit.is_running() && driver.motor.is_running() {
        driver.turn(kit);
        if kit.diagnostics_due() {
            let health = driver.health();
            kit.publish_diagnostics(health.statuses(&reported, &scheduling))?;
            reported = health;
        }
    }
    driver.close(kit)
}

struct Inboxes {
    servo_cf: Inbox<WrenchStamped>,
    contact_law: Inbox<ContactLaw>,
}

struct Driver {
    // Dropped first: motors off before anything else goes.
    motor: MotorLoop,
    publisher: PublisherThread,
    exchange: Arc<Mutex<Exchange>>,
    inboxes: Inboxes,
    reader: LawReader,
    frame_id: String,
    max_force_n: f64,
    stability: StabilityWatch,
    unstable: Throttle,
    laws: u64,
    rejected: u64,
    rejections: Throttle,
}

impl Driver {
    /// Waits for messages and parameters and passes them on.
    fn turn(&mut self, kit: &mut NodeKit) {
        for change in kit.spin_once(TURN) {
            if let ("device.max_force", Value::Double(max_force_n)) = (change.name, &change.value) {
                self.max_force_n = *max_force_n;
                self.motor.set_max_force_n(*max_force_n);
            }
        }
        // Laws first: with one of them the motor loop does not need the force.
        while let Some(message) = self.inboxes.contact_law.take() {
            match self.reader.read(&message) {
                Ok(command) => {
                    self.laws += 1;
                    self.judge(kit, &command);
                    self.motor.send_law(command);
                }
                Err(refusal) => self.reject(kit, "contact_law", &refusal.to_string()),
            }
        }
        while let Some(message) = self.inboxes.servo_cf.take() {
            self.take_servo(kit, &message);
        }
    }

    /// In the words of `rhombus stability`.
    fn judge(&mut self, kit: &NodeKit, command: &LawCommand) {
        if let Some(verdict) = self.stability.warning(command) {
            self.unstable.warn(kit.log(), || format!("stability: {verdict}"));
        }
    }

    fn take_servo(&mut self, kit: &NodeKit, message: &WrenchStamped) {
        let received_ns = monotonic_ns();
        let frame = frames::frame_of_message(&message.header.frame_id);
        if frame != self.frame_id {
            let reason =
                format!("frame_id is \"{frame}\"; this device's forces are in \"{}\"", self.frame_id);
            self.reject(kit, "servo_cf", &reason);
            return;
        }
        // Other clients' forces have stamps of their own and answer no pose.
        lock(&self.exchange).answers.arrived(convert::stamp_ns(&message.header.stamp), received_ns);
        // A force that is not finite goes on too: the motor loop makes it none, at once, and counts it.
        let force_n = convert::dvec3_of_vector(&message.wrench.force);
        self.motor.send_servo(ServoCommand { received_ns, force_n });
    }

    fn reject(&mut self, kit: &NodeKit, topic: &str, reason: &str) {
        self.rejected += 1;
        self.rejections.warn(kit.log(), || format!("{topic}: rejected: {reason}"));
    }

    fn health(&self) -> Health {
        let exchange = lock(&self.exchange);
        Health {
            answers: exchange.answers.report(),
            counts: self.motor.counts(),
            force_n: exchange.newest.map_or(0.0, |sample| sample.force_n.length()),
            peak_force_n: exchange.peak_force_n,
            peak_depth_m: exchange.peak_depth_m,
            max_force_n: self.max_force_n,
            laws: self.laws,
            rejected: self.rejected,
            unsent: exchange.unsent,
        }
    }

    /// Motors off first, then what was measured, then the forces still on their way, then the report.
    fn close(mut self, kit: &mut NodeKit) -> Result<()> {
        let ended = self.motor.stop();
        self.publisher.finish();
        let deadline = Instant::now() + LAST_FORCES;
        while Instant::now() < deadline && !lock(&self.exchange).answers.is_complete() {
            self.turn(kit);
        }
        kit.closing_report(&self.health().closing());
        ended.context("the motor loop ended; the motors are off")
    }
}

/// The number of the clutch button; none without a clutch.
fn clutch_button(scene: &Scene) -> Result<Option<u32>> {
    let Some(text) = &scene.session.clutch_button else { return Ok(None) };
    match text.parse() {
        Ok(button @ 0..=31) => Ok(Some(button)),
        _ => Err(anyhow!(
            "clutch.button \"{text}\": accepted are a button's number, \"0\" to \"31\", and \"\" for none"
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
fn wait_for_readers(kit: &mut NodeKit, topics: &DeviceTopics, count: usize) {
    if count == 0 {
        return;
    }
    let mut remind_at = Instant::now() + REMINDER;
    while kit.is_running() && topics.readers() < count {
        kit.spin_once(TURN);
        if Instant::now() >= remind_at {
            remind_at += REMINDER;
            let found = topics.readers();
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
