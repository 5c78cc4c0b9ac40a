//! The thread that publishes what the motor loop measured, as soon as it is there and in order.

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use devices::{Sample, SampleReceiver};
use node_kit::{Log, NodeKit, PublishError, Publisher, StartError, convert, topics};
use r2r::geometry_msgs::msg::{PoseStamped, TwistStamped, WrenchStamped};
use r2r::sensor_msgs::msg::{JointState, Joy};
use r2r::std_msgs::msg::Header;

use crate::answers::Answers;

/// Longest sleep, so that the thread sees that it shall end.
const LONGEST_SLEEP: Duration = Duration::from_millis(20);
/// Time between two gripper messages while the gripper moves little, ns.
const GRIPPER_PERIOD_NS: u64 = 20_000_000;
/// A gripper that has moved by this since its last message is published at once, rad.
const GRIPPER_STEP_RAD: f64 = 0.01;

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

/// The topics of a device.
pub(crate) struct DeviceTopics {
    measured_cp: Publisher<PoseStamped>,
    measured_cv: Publisher<TwistStamped>,
    measured_cf: Publisher<WrenchStamped>,
    gripper: Publisher<JointState>,
    /// The bit of the clutch button and its topic; none without a clutch.
    clutch: Option<(u32, Publisher<Joy>)>,
}

impl DeviceTopics {
    /// Makes the publishers. `clutch_button` is the number of a button.
    pub(crate) fn new(kit: &mut NodeKit, clutch_button: Option<u32>) -> Result<DeviceTopics, StartError> {
        let clutch = match clutch_button {
            Some(button) => Some((1 << button, kit.publish(&topics::CLUTCH, "")?)),
            None => None,
        };
        Ok(DeviceTopics {
            measured_cp: kit.publish(&topics::MEASURED_CP, "")?,
            measured_cv: kit.publish(&topics::MEASURED_CV, "")?,
            measured_cf: kit.publish(&topics::MEASURED_CF, "")?,
            gripper: kit.publish(&topics::GRIPPER_MEASURED_JS, "")?,
            clutch,
        })
    }

    /// Subscriptions of the poses found so far.
    pub(crate) fn readers(&self) -> usize {
        self.measured_cp.readers()
    }
}

/// The running thread.
pub(crate) struct PublisherThread {
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl PublisherThread {
    /// Starts publishing what comes out of `samples`.
    pub(crate) fn start(
        topics: DeviceTopics,
        frame_id: String,
        samples: SampleReceiver,
        exchange: Arc<Mutex<Exchange>>,
        log: Log,
    ) -> std::io::Result<PublisherThread> {
        let stop = Arc::new(AtomicBool::new(false));
        let asked_to_stop = stop.clone();
        let work = Work { outbox: Outbox::new(topics, frame_id), samples, exchange, log };
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
        {
            let mut exchange = lock(&self.exchange);
            // Before it is sent: the force may be back before this thread runs again.
            exchange.answers.sent(sample.stamp_ns, sample.monotonic_ns);
            exchange.peak_force_n = exchange.peak_force_n.max(sample.force_n.length());
            exchange.peak_depth_m = exchange.peak_depth_m.max(sample.depth_m);
            exchange.newest = Some(*sample);
        }
        if let Err(error) = self.outbox.publish(sample) {
            let mut exchange = lock(&self.exchange);
            exchange.unsent += 1;
            if exchange.unsent == 1 {
                self.log.error(&format!("{error}; further ones are counted in the diagnostics"));
            }
        }
    }
}

/// The messages, kept from sample to sample so that the frame's name is not copied for each.
struct Outbox {
    topics: DeviceTopics,
    pose: PoseStamped,
    twist: TwistStamped,
    wrench: WrenchStamped,
    gripper: JointState,
    joy: Joy,
    gripper_sent_ns: Option<u64>,
    clutch_pressed: Option<bool>,
}

impl Outbox {
    fn new(topics: DeviceTopics, frame_id: String) -> Outbox {
        let header = Header { frame_id, ..Header::default() };
        Outbox {
            topics,
            pose: PoseStamped { header: header.clone(), ..PoseStamped::default() },
            twist: TwistStamped { header: header.clone(), ..TwistStamped::default() },
            wrench: WrenchStamped { header: header.clone(), ..WrenchStamped::default() },
            gripper: JointState {
                header: header.clone(),
                name: vec!["gripper".to_owned()],
                position: vec![0.0],
                ..JointState::default()
            },
            joy: Joy { header, buttons: vec![0], ..Joy::default() },
            gripper_sent_ns: None,
            clutch_pressed: None,
        }
    }

    /// The pose first: a force waits for it. But a gripper or clutch that has just changed goes ahead of the pose it
    /// belongs to.
    fn publish(&mut self, sample: &Sample) -> Result<(), PublishError> {
        let stamp = convert::stamp(sample.stamp_ns);
        self.publish_clutch(sample)?;
        self.publish_gripper(sample)?;
        self.pose.header.stamp = stamp.clone();
        self.pose.pose = convert::pose(&sample.state.pose);
        self.topics.measured_cp.publish(&self.pose)?;
        self.twist.header.stamp = stamp.clone();
        self.twist.twist.linear = convert::vector(sample.state.linear_velocity_m_per_s);
        self.twist.twist.angular = convert::vector(sample.state.angular_velocity_rad_per_s);
        self.topics.measured_cv.publish(&self.twist)?;
        self.wrench.header.stamp = stamp;
        self.wrench.wrench.force = convert::vector(sample.force_n);
        self.topics.measured_cf.publish(&self.wrench)
    }

    fn publish_clutch(&mut self, sample: &Sample) -> Result<(), PublishError> {
        let Some((bit, publisher)) = &self.topics.clutch else { return Ok(()) };
        let pressed = sample.state.buttons & bit != 0;
        if self.clutch_pressed.replace(pressed) == Some(pressed) {
            return Ok(());
        }
        self.joy.header.stamp = convert::stamp(sample.stamp_ns);
        self.joy.buttons[0] = i32::from(pressed);
        publisher.publish(&self.joy)
    }

    fn publish_gripper(&mut self, sample: &Sample) -> Result<(), PublishError> {
        let Some(angle_rad) = sample.state.gripper_rad else { return Ok(()) };
        let moved = (angle_rad - self.gripper.position[0]).abs() >= GRIPPER_STEP_RAD;
        let due = self
            .gripper_sent_ns
            .is_none_or(|sent_ns| sample.monotonic_ns.saturating_sub(sent_ns) >= GRIPPER_PERIOD_NS);
        if !(moved || due) {
            return Ok(());
        }
        self.gripper_sent_ns = Some(sample.monotonic_ns);
        self.gripper.header.stamp = convert::stamp(sample.stamp_ns);
        self.gripper.position[0] = angle_rad;
        self.topics.gripper.publish(&self.gripper)
    }
}
