//! Forces and contact laws from ROS 2: what arrives, what of it the motor loop gets, and why the rest does not.

use std::sync::atomic::Ordering::Relaxed;
use std::time::{Duration, Instant};

use devices::{Axes, CheckedSettings, LawCommand, MotorLoop, ServoCommand, Wrench, monotonic_ns};
use node_kit::{Inbox, NodeKit, StartError, Throttle, convert, topics};
use r2r::geometry_msgs::msg::WrenchStamped;
use r2r::rhombus_haptics_msgs::msg::ContactLaw;
use r2r::sensor_msgs::msg::JointState;
use scene::Scene;

use crate::freshness::{Backlog, Freshness, Since, Untimely};
use crate::law_message::LawReader;
use crate::now::now_ns;
use crate::publisher::lock;
use crate::shared::Shared;
use crate::sources::{CommandTopic, Sources};
use crate::stability_watch::StabilityWatch;
use crate::wrench_frame::body_axes;

/// Between two looks at who publishes the command topics.
const LOOK: Duration = Duration::from_millis(100);
/// The same for a topic that is in use: so long a second publisher's commands are taken for the first one's.
const BUSY_LOOK: Duration = Duration::from_millis(20);
/// Between two looks while a publisher is not known yet.
const EAGER_LOOK: Duration = Duration::from_millis(10);
/// Between two lines of one kind.
const LINE: Duration = Duration::from_secs(1);

/// What arrived and what became of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct ForceCounts {
    /// Contact laws that the motor loop got.
    pub(crate) laws: u64,
    /// Forces and laws that can not be followed: wrong frame, not finite, no law.
    pub(crate) rejected: u64,
    /// Forces and laws that came too late, or out of order.
    pub(crate) untimely: u64,
    /// Forces and laws of topics with more than one publisher, or none known yet.
    pub(crate) contested: u64,
}

/// The command topics.
pub(crate) struct Forces {
    /// None for a device without motors.
    inboxes: Option<Inboxes>,
    shared: Shared,
    reader: LawReader,
    stability: StabilityWatch,
    sources: Sources,
    looked: Looked,
    gripper: GripperForce,
    backlog: Backlog,
    /// Since when the commanded wrenches count.
    since: Since,
    counts: ForceCounts,
    lines: Lines,
}

struct Inboxes {
    wrenches: [WrenchInbox; 3],
    /// None for a gripper without a motor.
    gripper: Option<(Inbox<JointState>, Freshness)>,
    laws: (Inbox<ContactLaw>, Freshness),
}

struct WrenchInbox {
    topic: CommandTopic,
    inbox: Inbox<WrenchStamped>,
    freshness: Freshness,
}

/// When it was last looked who publishes the command topics.
#[derive(Clone, Copy, Default)]
struct Looked {
    everywhere: Option<Instant>,
    somewhere: Option<Instant>,
    /// Topics that commands came by since the last look.
    used: [bool; CommandTopic::ALL.len()],
}

fn is_past(looked: Option<Instant>, period: Duration) -> bool {
    looked.is_none_or(|looked| looked.elapsed() >= period)
}

/// One line a second for each kind of trouble.
struct Lines {
    rejected: Throttle,
    untimely: Throttle,
    contested: Throttle,
    unstable: Throttle,
}

/// The newest gripper force. It travels with the wrench commands, so that it never prolongs one.
#[derive(Clone, Copy, Debug)]
struct GripperForce {
    force_n: f64,
    since_ns: Option<u64>,
    validity_ns: u64,
}

impl GripperForce {
    /// Until when it may be used.
    fn until_ns(&self) -> u64 {
        self.since_ns.map_or(0, |ns| ns.saturating_add(self.validity_ns))
    }
}

impl Forces {
    /// Subscribes to what this device can do.
    pub(crate) fn new(
        kit: &mut NodeKit,
        shared: &Shared,
        scene: &Scene,
        safety: &CheckedSettings,
    ) -> Result<Forces, StartError> {
        let servo_ns = (safety.servo_validity_s * 1e9) as i64;
        let law_ns = (safety.law_validity_s * 1e9) as i64;
        let line = || Throttle::new(LINE);
        let inboxes = if shared.has_motors() {
            let mut wrench = |topic: CommandTopic, name: &topics::Topic<WrenchStamped>| {
                let inbox = kit.subscribe(name, "")?;
                Ok::<_, StartError>(WrenchInbox { topic, inbox, freshness: Freshness::new(servo_ns) })
            };
            Some(Inboxes {
                wrenches: [
                    wrench(CommandTopic::Servo, &topics::SERVO_CF)?,
                    wrench(CommandTopic::SpatialServo, &topics::SPATIAL_SERVO_CF)?,
                    wrench(CommandTopic::BodyServo, &topics::BODY_SERVO_CF)?,
                ],
                gripper: match shared.description.limits.max_gripper_force_n {
                    Some(_) => {
                        Some((kit.subscribe(&topics::GRIPPER_SERVO_JF, "")?, Freshness::new(servo_ns)))
                    }
                    None => None,
                },
                laws: (kit.subscribe(&topics::CONTACT_LAW, "")?, Freshness::new(law_ns)),
            })
        } else {
            None
        };
        Ok(Forces {
            inboxes,
            reader: LawReader::new(shared.frames.base.clone()),
            shared: shared.clone(),
            stability: StabilityWatch::new(scene),
            sources: Sources::default(),
            looked: Looked::default(),
            backlog: Backlog::new(servo_ns.unsigned_abs()),
            since: Since::default(),
            gripper: GripperForce { force_n: 0.0, since_ns: None, validity_ns: servo_ns.unsigned_abs() },
            counts: ForceCounts::default(),
            lines: Lines { rejected: line(), untimely: line(), contested: line(), unstable: line() },
        })
    }

    /// What arrived so far, and what became of it.
    pub(crate) fn counts(&self) -> ForceCounts {
        self.counts
    }

    /// Who disturbs whom, in words; none when every command topic has one publisher at most.
    pub(crate) fn conflicts(&self) -> Vec<String> {
        self.sources.conflicts()
    }

    /// Passes on what arrived. True when a force came that answers no pose: a client commands anew.
    pub(crate) fn take(&mut self, kit: &NodeKit, motor: &mut MotorLoop) -> bool {
        let Some(mut inboxes) = self.inboxes.take() else { return false };
        self.look_around(kit);
        self.backlog.begin_turn(monotonic_ns());
        // Laws first: with one of them the motor loop does not need the force.
        while let Some(message) = inboxes.laws.0.take() {
            if let Some(command) = self.law(kit, &message, &mut inboxes.laws.1) {
                self.counts.laws += 1;
                motor.send_law(command);
            }
        }
        if let Some((inbox, freshness)) = &mut inboxes.gripper {
            while let Some(message) = inbox.take() {
                self.take_gripper(kit, &message, freshness);
            }
        }
        let mut is_anew = false;
        for WrenchInbox { topic, inbox, freshness } in &mut inboxes.wrenches {
            while let Some(message) = inbox.take() {
                let now_ns = monotonic_ns();
                let stamp_ns = convert::stamp_ns(&message.header.stamp);
                // Other clients' forces have stamps of their own and answer no pose.
                let answers = *topic == CommandTopic::Servo
                    && lock(&self.shared.exchange).answers.arrived(stamp_ns, now_ns);
                if let Some((wrench, axes, age_ns)) = self.wrench(kit, *topic, &message, freshness) {
                    is_anew |= !answers;
                    let since_ns = self.since.of(now_ns, age_ns);
                    let gripper_until_ns = self.gripper.until_ns();
                    motor.send_servo(ServoCommand { since_ns, gripper_until_ns, wrench, axes });
                }
            }
        }
        self.inboxes = Some(inboxes);
        self.backlog.end_turn(monotonic_ns());
        is_anew
    }

    /// The wrench of a message, its axes and its age in ns, if it is one to follow.
    fn wrench(
        &mut self,
        kit: &NodeKit,
        topic: CommandTopic,
        message: &WrenchStamped,
        freshness: &mut Freshness,
    ) -> Option<(Wrench, Axes, u64)> {
        let axes = match topic {
            CommandTopic::BodyServo => body_axes(self.shared.body_is_absolute.load(Relaxed)),
            _ => Axes::Base,
        };
        let wrench = Wrench {
            force_n: convert::dvec3_of_vector(&message.wrench.force),
            torque_n_m: convert::dvec3_of_vector(&message.wrench.torque),
            gripper_force_n: self.gripper.force_n,
        };
        if let Err(reason) = self.shared.frames.check(axes, &message.header.frame_id) {
            return self.reject(kit, topic, &reason);
        }
        if !wrench.is_finite() {
            return self.reject(kit, topic, "the wrench is not finite");
        }
        if !self.is_only_source(kit, topic) {
            return None;
        }
        let age_ns = self.age_ns(kit, topic, freshness, convert::stamp_ns(&message.header.stamp))?;
        Some((wrench, axes, age_ns))
    }

    fn take_gripper(&mut self, kit: &NodeKit, message: &JointState, freshness: &mut Freshness) {
        let topic = CommandTopic::GripperServo;
        let [force_n] = message.effort[..] else {
            let found = message.effort.len();
            return self
                .reject(kit, topic, &format!("effort has {found} entries; accepted is 1"))
                .unwrap_or(());
        };
        if !force_n.is_finite() {
            return self.reject(kit, topic, "the effort is not finite").unwrap_or(());
        }
        if self.is_only_source(kit, topic)
            && let Some(age_ns) = self.age_ns(kit, topic, freshness, convert::stamp_ns(&message.header.stamp))
        {
            self.gripper.force_n = force_n;
            self.gripper.since_ns = Some(monotonic_ns().saturating_sub(age_ns));
        }
    }

    fn law(&mut self, kit: &NodeKit, message: &ContactLaw, freshness: &mut Freshness) -> Option<LawCommand> {
        let topic = CommandTopic::Law;
        let command = match self.reader.read(message) {
            Ok(command) => command,
            Err(refusal) => return self.reject(kit, topic, &refusal.to_string()),
        };
        if !self.is_only_source(kit, topic) {
            return None;
        }
        // The motor loop looks at the law's own stamp.
        self.age_ns(kit, topic, freshness, command.stamp_ns)?;
        if let Some(verdict) = self.stability.warning(&command) {
            // In the words of `rhombus stability`.
            self.lines.unstable.warn(kit.log(), || format!("stability: {verdict}"));
        }
        Some(command)
    }

    /// Looks who publishes the command topics, where that was not done a short while ago.
    fn look_around(&mut self, kit: &NodeKit) {
        if is_past(self.looked.everywhere, LOOK) {
            self.look(kit, [true; CommandTopic::ALL.len()]);
        } else if is_past(self.looked.somewhere, BUSY_LOOK) {
            self.look(kit, self.looked.used);
        }
    }

    fn look(&mut self, kit: &NodeKit, which: [bool; CommandTopic::ALL.len()]) {
        let now = Instant::now();
        if which.iter().all(|is_asked| *is_asked) {
            self.looked.everywhere = Some(now);
        }
        self.looked = Looked { somewhere: Some(now), used: Default::default(), ..self.looked };
        for topic in CommandTopic::ALL.into_iter().filter(|topic| which[*topic as usize]) {
            let publishers = match topic {
                CommandTopic::Servo => kit.publishers_of(&topics::SERVO_CF, ""),
                CommandTopic::SpatialServo => kit.publishers_of(&topics::SPATIAL_SERVO_CF, ""),
                CommandTopic::BodyServo => kit.publishers_of(&topics::BODY_SERVO_CF, ""),
                CommandTopic::GripperServo => kit.publishers_of(&topics::GRIPPER_SERVO_JF, ""),
                CommandTopic::Law => kit.publishers_of(&topics::CONTACT_LAW, ""),
            };
            match publishers {
                Ok(publishers) => self.sources.see(topic, publishers),
                // Nobody is known then, and nobody is followed.
                Err(error) => {
                    self.sources.see(topic, Vec::new());
                    self.lines.contested.error(kit.log(), || {
                        format!("{}: its publishers cannot be looked up: {error}", topic.name())
                    });
                }
            }
        }
    }

    /// Whether the topic has one publisher. Checked before the first force of it is followed.
    fn is_only_source(&mut self, kit: &NodeKit, topic: CommandTopic) -> bool {
        self.looked.used[topic as usize] = true;
        if !self.sources.knows(topic) && is_past(self.looked.somewhere, EAGER_LOOK) {
            self.look(kit, [true; CommandTopic::ALL.len()]);
        }
        let Some(refusal) = self.sources.refusal(topic) else { return true };
        self.counts.contested += 1;
        if self.sources.knows(topic) {
            self.lines.contested.error(kit.log(), || refusal);
        }
        false
    }

    /// How old a command is, ns; none when it is not to be followed.
    fn age_ns(
        &mut self,
        kit: &NodeKit,
        topic: CommandTopic,
        freshness: &mut Freshness,
        stamp_ns: i64,
    ) -> Option<u64> {
        match freshness.check(stamp_ns, &self.clocks_ns(kit), &self.backlog) {
            Ok(age_ns) => Some(age_ns),
            Err(untimely) => {
                self.counts.untimely += 1;
                self.tell_untimely(kit, topic, untimely);
                None
            }
        }
    }

    fn tell_untimely(&mut self, kit: &NodeKit, topic: CommandTopic, untimely: Untimely) {
        self.lines.untimely.warn(kit.log(), || format!("{}: not followed: {untimely}", topic.name()));
    }

    /// What the clocks show that stamps are taken from: the system's, the one of the poses, and `/clock` if it is in use.
    fn clocks_ns(&self, kit: &NodeKit) -> [i64; 3] {
        let system_ns = now_ns();
        let poses_ns = lock(&self.shared.exchange).newest.map_or(system_ns, |sample| {
            let since_ns = monotonic_ns().saturating_sub(sample.monotonic_ns);
            sample.stamp_ns.saturating_add_unsigned(since_ns)
        });
        [system_ns, poses_ns, convert::stamp_ns(&kit.now())]
    }

    fn reject<T>(&mut self, kit: &NodeKit, topic: CommandTopic, reason: &str) -> Option<T> {
        self.counts.rejected += 1;
        self.lines.rejected.warn(kit.log(), || format!("{}: rejected: {reason}", topic.name()));
        None
    }
}
