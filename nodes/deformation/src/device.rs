//! One device: its topics, its contact with the body, and the answer to each of its poses.

use std::time::{Duration, Instant};

use node_kit::{
    FrameTree, Inbox, Log, NodeKit, PublishError, Publisher, StartError, Status, Throttle, convert, topics,
};
use r2r::geometry_msgs::msg::{PoseStamped, WrenchStamped};
use r2r::rhombus_haptics_msgs::msg::{ContactLaw, ContactState};
use r2r::sensor_msgs::msg::{JointState, Joy};
use r2r::std_msgs::msg::Bool;
use rhombus_chain::{Answer, Body, DeviceSession, HandPose, Rejection, Tissue};

use crate::counters::Counters;
use crate::messages::Messages;
use crate::place::Place;

/// Time between two log lines about rejected poses of one device.
const LOG_PERIOD: Duration = Duration::from_secs(1);

/// What the poses of all devices meet.
pub(crate) struct World<'a> {
    pub(crate) body: &'a Body,
    pub(crate) tissue: &'a Tissue,
    pub(crate) frames: &'a FrameTree,
    pub(crate) body_frame: &'a str,
}

/// One device on the body.
pub(crate) struct Device {
    subject: String,
    session: DeviceSession,
    place: Place,
    close_below_rad: f64,
    poses: Inbox<PoseStamped>,
    grasp: Inbox<Bool>,
    gripper: Inbox<JointState>,
    clutch: Inbox<Joy>,
    force: Publisher<WrenchStamped>,
    law: Publisher<ContactLaw>,
    state: Publisher<ContactState>,
    messages: Messages,
    counters: Counters,
    rejections: Throttle,
}

impl Device {
    /// `name` is the sub-namespace of the device's topics; "" is the node's own namespace.
    pub(crate) fn new(
        kit: &mut NodeKit,
        name: &str,
        tissue: &Tissue,
        scene: &scene::Scene,
    ) -> Result<Device, StartError> {
        let motion_scale = scene.device.motion_scale;
        Ok(Device {
            subject: if name.is_empty() { "device".to_owned() } else { name.to_owned() },
            session: DeviceSession::new(motion_scale),
            place: Place::default(),
            close_below_rad: scene.grasp.close_below_rad,
            poses: kit.subscribe(&topics::MEASURED_CP, name)?,
            grasp: kit.subscribe(&topics::GRASP, name)?,
            gripper: kit.subscribe(&topics::GRIPPER_MEASURED_JS, name)?,
            clutch: kit.subscribe(&topics::CLUTCH, name)?,
            force: kit.publish(&topics::SERVO_CF, name)?,
            law: kit.publish(&topics::CONTACT_LAW, name)?,
            state: kit.publish(&topics::CONTACT_STATE, name)?,
            messages: Messages::new(tissue, motion_scale),
            counters: Counters::new(),
            rejections: Throttle::new(LOG_PERIOD),
        })
    }

    /// Answer every pose that has arrived, oldest first. The stamp of the newest one.
    pub(crate) fn turn(&mut self, world: &World<'_>, log: &Log) -> Result<Option<i64>, PublishError> {
        self.read_buttons();
        let mut newest_ns = None;
        while let Some(pose) = self.poses.take() {
            self.step(world, log, &pose)?;
            newest_ns = Some(convert::stamp_ns(&pose.header.stamp));
        }
        Ok(newest_ns)
    }

    /// One pose, one force: first what the hand waits for, then the rest.
    fn step(&mut self, world: &World<'_>, log: &Log, pose: &PoseStamped) -> Result<(), PublishError> {
        let taken = Instant::now();
        let hand = self.locate(world, pose);
        let answer = self.session.answer(world.body, world.tissue, &hand);
        self.publish_force(pose, &answer)?;
        self.counters.answered(&answer, taken.elapsed());
        self.publish_contact(pose, &answer)?;
        self.report_rejection(log, pose, &answer);
        Ok(())
    }

    fn locate(&mut self, world: &World<'_>, pose: &PoseStamped) -> HandPose {
        HandPose {
            stamp_ns: convert::stamp_ns(&pose.header.stamp),
            frame_from_hand: convert::pose_array(&pose.pose),
            body_from_frame: self.place.find(world.frames, world.body_frame, &pose.header.frame_id),
        }
    }

    fn publish_force(
        &mut self,
        pose: &PoseStamped,
        answer: &Result<Answer, Rejection>,
    ) -> Result<(), PublishError> {
        self.messages.set_force(&pose.header, answer.as_ref().ok());
        self.force.publish(&self.messages.force)
    }

    fn publish_contact(
        &mut self,
        pose: &PoseStamped,
        answer: &Result<Answer, Rejection>,
    ) -> Result<(), PublishError> {
        self.messages.set_contact(&pose.header, answer.as_ref().ok());
        self.law.publish(&self.messages.law)?;
        self.state.publish(&self.messages.state)
    }

    fn report_rejection(&mut self, log: &Log, pose: &PoseStamped, answer: &Result<Answer, Rejection>) {
        if let Err(rejection) = answer {
            let (subject, frame) = (&self.subject, &pose.header.frame_id);
            self.rejections
                .warn(log, || format!("{subject}: pose in frame \"{frame}\" rejected: {rejection}"));
        }
    }

    /// Grasp, gripper and clutch, as they were last said; they count from the next pose on.
    fn read_buttons(&mut self) {
        while let Some(grasp) = self.grasp.take() {
            self.session.command_grasp(grasp.data);
        }
        while let Some(gripper) = self.gripper.take() {
            match gripper.position.first() {
                Some(angle_rad) if angle_rad.is_finite() => {
                    self.session.set_gripper_closed(*angle_rad < self.close_below_rad);
                }
                _ => self.counters.ignored_input(),
            }
        }
        while let Some(joy) = self.clutch.take() {
            match joy.buttons.first() {
                Some(button) => self.session.set_clutched(*button != 0),
                None => self.counters.ignored_input(),
            }
        }
    }

    /// Take over settings that were changed while the node runs.
    pub(crate) fn retune(&mut self, tissue: &Tissue, scene: &scene::Scene) {
        self.close_below_rad = scene.grasp.close_below_rad;
        self.messages.set_chains(tissue, self.session.motion_scale());
    }

    pub(crate) fn session(&self) -> &DeviceSession {
        &self.session
    }

    pub(crate) fn counters(&self) -> &Counters {
        &self.counters
    }

    pub(crate) fn subject(&self) -> &str {
        &self.subject
    }

    pub(crate) fn status(&mut self) -> Status {
        self.counters.status(&self.subject)
    }
}
