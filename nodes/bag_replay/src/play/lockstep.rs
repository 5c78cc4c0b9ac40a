//! Lockstep: the next pose is sent when the force for the last one has come back, with its stamp.
//!
//! Topics are in order in themselves but not with each other. So the model says how many messages on its buttons and
//! frames it has taken into account, and a pose waits for those that were sent before it.

use std::time::{Duration, Instant};

use anyhow::{Context, bail};
use node_kit::topics::{self, Topic};
use node_kit::{Histogram, NodeKit};
use recording::cdr;
use recording::messages::{Time, UInt64, WrenchStamped};

use super::outlets::Outlet;
use super::player::Host;
use crate::names::absolute;
use crate::rcl::{RawNode, Subscription, WaitSet};

/// Longest time between two looks at what else the node has to do.
const TURN: Duration = Duration::from_millis(20);
/// What the model has not been heard to know of this player is known after this long.
const SETTLE: Duration = Duration::from_millis(500);

/// Waits for the model.
pub(crate) struct Lockstep {
    wait_set: WaitSet,
    devices: Vec<Device>,
    buttons: Total,
    transforms: Total,
    /// By the number of the topic in the recording.
    roles: Vec<Role>,
    timeout: Duration,
    answered: Histogram,
    began: Option<Instant>,
    ended: Option<Instant>,
}

/// One device of the session.
struct Device {
    pose_topic: String,
    force_topic: String,
    forces: Subscription,
}

/// A number that the model counts up.
struct Total {
    topic: String,
    subscription: Subscription,
    heard: Option<u64>,
    /// What it must come to before the next pose is sent.
    wanted: u64,
}

/// What a topic is to the model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Role {
    /// Poses of the device with this number.
    Pose(usize),
    Buttons,
    Transforms,
    Other,
}

impl Lockstep {
    /// Subscribes to the answers.
    ///
    /// # Errors
    /// No poses of the session's devices are played.
    pub(crate) fn new(
        kit: &NodeKit,
        node: &RawNode,
        devices: &[String],
        outlets: &[Outlet],
        topics_in_recording: usize,
        timeout: Duration,
    ) -> anyhow::Result<Self> {
        let in_graph = |name: String| absolute(kit.namespace(), &name);
        let mut known = Vec::new();
        let mut buttons = Vec::new();
        for device in devices {
            let pose_topic = in_graph(topics::MEASURED_CP.name_in(device));
            let its_buttons = [
                topics::GRASP.name_in(device),
                topics::GRIPPER_MEASURED_JS.name_in(device),
                topics::CLUTCH.name_in(device),
            ];
            buttons.extend(its_buttons.map(in_graph));
            if outlets.iter().any(|outlet| outlet.content.is_pose() && outlet.target == pose_topic) {
                let force_topic = in_graph(topics::SERVO_CF.name_in(device));
                let forces = subscribe(node, &topics::SERVO_CF, &force_topic)?;
                known.push(Device { pose_topic, force_topic, forces });
            }
        }
        if known.is_empty() {
            let played: Vec<_> = outlets.iter().map(|outlet| &outlet.target).collect();
            bail!(
                "replay.lockstep: no poses are played for any of the devices {devices:?}; played are {played:?}"
            );
        }
        let transforms = [topics::TF.name_in(""), topics::TF_STATIC.name_in("")];
        let mut roles = vec![Role::Other; topics_in_recording];
        for outlet in outlets {
            let role = match known.iter().position(|device| device.pose_topic == outlet.target) {
                Some(number) if outlet.content.is_pose() => Role::Pose(number),
                _ if buttons.contains(&outlet.target) => Role::Buttons,
                _ if transforms.contains(&outlet.target) => Role::Transforms,
                _ => Role::Other,
            };
            if let Some(place) = roles.get_mut(outlet.topic) {
                *place = role;
            }
            if role == Role::Other && outlet.content.is_pose() {
                kit.log().warn(&format!(
                    "{} is played without waiting for answers: it belongs to none of the devices {devices:?}",
                    outlet.target
                ));
            }
        }
        Ok(Self {
            wait_set: node.wait_set(known.len() + 2)?,
            devices: known,
            buttons: Total::new(node, &topics::BUTTONS_HEARD, in_graph)?,
            transforms: Total::new(node, &topics::TRANSFORMS_HEARD, in_graph)?,
            roles,
            timeout,
            answered: Histogram::default(),
            began: None,
            ended: None,
        })
    }

    /// Waits until the model and this node know each other in both directions, so that not even the first answer is lost.
    ///
    /// # Errors
    /// They do not after `longest`.
    pub(crate) fn meet(
        &mut self,
        host: &mut dyn Host,
        outlets: &[Outlet],
        longest: Duration,
    ) -> anyhow::Result<()> {
        let end = Instant::now() + longest.max(self.timeout);
        let mut met = None;
        while host.is_running() {
            self.hear()?;
            let now = Instant::now();
            match self.missing(outlets) {
                // What comes from the model's latched topics shows that it knows the subscriptions made before them.
                None if self.buttons.heard.is_some() && self.transforms.heard.is_some() => break,
                None if now.saturating_duration_since(*met.get_or_insert(now)) >= SETTLE => break,
                Some(missing) if now >= end => bail!(
                    "replay.lockstep: {missing} within {} s; the model must run with replay.lockstep: true and the \
                     same devices",
                    longest.max(self.timeout).as_secs_f64()
                ),
                _ => host.idle(TURN)?,
            }
        }
        self.buttons.begin();
        self.transforms.begin();
        Ok(())
    }

    /// Before a message of a topic is sent: for a pose, the model must know all that was sent before.
    ///
    /// # Errors
    /// It does not in time.
    pub(crate) fn before(&mut self, host: &mut dyn Host, topic: usize) -> anyhow::Result<()> {
        let Role::Pose(_) = self.role(topic) else { return Ok(()) };
        self.began.get_or_insert_with(Instant::now);
        let known =
            |lockstep: &mut Self| Ok(lockstep.buttons.is_reached() && lockstep.transforms.is_reached());
        if self.until(host, known)? {
            return Ok(());
        }
        let behind = if self.buttons.is_reached() { &self.transforms } else { &self.buttons };
        bail!(
            "lockstep: {} is {} and not {} {} s after the messages that it counts were sent; does the model run with \
             replay.lockstep: true and the devices of this replay?",
            behind.topic,
            behind.heard.unwrap_or(0),
            behind.wanted,
            self.timeout.as_secs_f64()
        )
    }

    /// After a message of a topic was sent, with the stamp of a pose: waits for its force.
    ///
    /// # Errors
    /// The force does not come in time.
    pub(crate) fn after(
        &mut self,
        host: &mut dyn Host,
        topic: usize,
        stamp: Option<&Time>,
    ) -> anyhow::Result<()> {
        let (number, stamp) = match (self.role(topic), stamp) {
            (Role::Pose(number), Some(stamp)) => (number, stamp),
            (Role::Buttons, _) => {
                self.buttons.wanted += 1;
                return Ok(());
            }
            (Role::Transforms, _) => {
                self.transforms.wanted += 1;
                return Ok(());
            }
            _ => return Ok(()),
        };
        let sent = Instant::now();
        let answered = |lockstep: &mut Self| match lockstep.devices.get_mut(number) {
            Some(device) => device.has_answer(stamp),
            None => Ok(true),
        };
        if self.until(host, answered)? {
            let now = Instant::now();
            self.answered.record(now.saturating_duration_since(sent));
            self.ended = Some(now);
            return Ok(());
        }
        let Some(device) = self.devices.get(number) else { return Ok(()) };
        bail!(
            "lockstep: no force on {} for the pose of stamp {}.{:09} on {} within {} s",
            device.force_topic,
            stamp.sec,
            stamp.nanosec,
            device.pose_topic,
            self.timeout.as_secs_f64()
        )
    }

    /// Poses answered, how many in a second, and how long an answer took; for the closing report.
    pub(crate) fn report(&self) -> serde_json::Value {
        let poses = self.answered.total();
        let elapsed_s = match (self.began, self.ended) {
            (Some(began), Some(ended)) => ended.saturating_duration_since(began).as_secs_f64(),
            _ => 0.0,
        };
        serde_json::json!({
            "poses": poses,
            "pose_rate_hz": if elapsed_s > 0.0 { poses as f64 / elapsed_s } else { 0.0 },
            "answer_us": {
                "median": self.answered.quantile_us(0.5),
                "p99": self.answered.quantile_us(0.99),
                "max": self.answered.longest_us(),
            },
        })
    }

    /// Waits until a condition holds; false when it does not in time. Who is asked to end meanwhile need not wait.
    fn until(
        &mut self,
        host: &mut dyn Host,
        mut condition: impl FnMut(&mut Self) -> anyhow::Result<bool>,
    ) -> anyhow::Result<bool> {
        let begin = Instant::now();
        let mut turn = begin + TURN;
        loop {
            self.hear()?;
            if condition(self)? || !host.is_running() {
                return Ok(true);
            }
            let now = Instant::now();
            if now.saturating_duration_since(begin) >= self.timeout {
                return Ok(false);
            }
            if now >= turn {
                host.idle(Duration::ZERO)?;
                turn = now + TURN;
            }
            let forces = self.devices.iter().map(|device| &device.forces);
            let totals = [&self.buttons.subscription, &self.transforms.subscription];
            self.wait_set.wait(forces.chain(totals), TURN)?;
        }
    }

    fn hear(&mut self) -> anyhow::Result<()> {
        self.buttons.hear()?;
        self.transforms.hear()
    }

    /// What is not there yet, in words.
    fn missing(&self, outlets: &[Outlet]) -> Option<String> {
        let unheard = |topic: usize| {
            let readers = outlets.iter().find(|outlet| outlet.topic == topic);
            readers.is_some_and(|outlet| {
                outlet.publisher.get_inter_process_subscription_count().unwrap_or(0) == 0
            })
        };
        let mut played = self.roles.iter().enumerate().filter(|(_, role)| **role != Role::Other);
        if let Some((topic, _)) = played.find(|(topic, _)| unheard(*topic)) {
            let name = outlets.iter().find(|outlet| outlet.topic == topic).map(|outlet| &outlet.target);
            return Some(format!("{} has no subscriber", name.map_or("", String::as_str)));
        }
        let forces = self.devices.iter().map(|device| (&device.force_topic, &device.forces));
        let totals = [&self.buttons, &self.transforms].map(|total| (&total.topic, &total.subscription));
        let silent = forces.chain(totals).find(|(_, subscription)| subscription.publishers() == 0);
        silent.map(|(topic, _)| format!("{topic} has no publisher"))
    }

    fn role(&self, topic: usize) -> Role {
        self.roles.get(topic).copied().unwrap_or(Role::Other)
    }
}

impl Device {
    /// Whether the force for the pose of this stamp has come; forces for others are no answers to it.
    fn has_answer(&mut self, stamp: &Time) -> anyhow::Result<bool> {
        while let Some(message) = self.forces.take()? {
            let force: WrenchStamped =
                cdr::decode(message.data).with_context(|| format!("a force on {}", self.force_topic))?;
            if force.header.stamp == *stamp {
                return Ok(true);
            }
        }
        Ok(false)
    }
}

impl Total {
    fn new<M>(node: &RawNode, topic: &Topic<M>, in_graph: impl Fn(String) -> String) -> anyhow::Result<Self> {
        let name = in_graph(topic.name().to_owned());
        let subscription = subscribe(node, topic, &name)?;
        Ok(Self { topic: name, subscription, heard: None, wanted: 0 })
    }

    /// Counting begins at what the model has heard so far.
    fn begin(&mut self) {
        self.wanted = self.heard.unwrap_or(0);
    }

    fn hear(&mut self) -> anyhow::Result<()> {
        while let Some(message) = self.subscription.take()? {
            let total: UInt64 =
                cdr::decode(message.data).with_context(|| format!("a message on {}", self.topic))?;
            self.heard = Some(total.data);
        }
        Ok(())
    }

    fn is_reached(&self) -> bool {
        self.heard.unwrap_or(0) >= self.wanted
    }
}

fn subscribe<M>(node: &RawNode, topic: &Topic<M>, name: &str) -> anyhow::Result<Subscription> {
    node.subscribe(name, &crate::session::type_name_of::<M>(), topic.qos())
}
