//! One device: its topics, and the answer to each of its poses.

use std::time::{Duration, Instant};

use node_kit::{Inbox, Log, NodeKit, PublishError, Publisher, StartError, Status, Throttle, convert, topics};
use r2r::geometry_msgs::msg::{PoseStamped, WrenchStamped};
use r2r::rhombus_haptics_msgs::msg::{ContactLaw, ContactState};
use r2r::sensor_msgs::msg::{JointState, Joy};
use r2r::std_msgs::msg::Bool;
use rhombus_chain::{Answer, MeasuredPose, Rejection, Session, Tissue};

use crate::counters::Counters;
use crate::messages::Messages;
use crate::surface::Surface;

/// Time between two log lines about rejected poses of one device.
const LOG_PERIOD: Duration = Duration::from_secs(1);

/// One device on the body.
pub(crate) struct Device {
    subject: String,
    /// Its number in the session.
    index: usize,
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
        index: usize,
        name: &str,
        tissue: &Tissue,
        scene: &scene::Scene,
    ) -> Result<Device, StartError> {
        Ok(Device {
            subject: if name.is_empty() { "device".to_owned() } else { name.to_owned() },
            index,
            poses: kit.subscribe(&topics::MEASURED_CP, name)?,
            grasp: kit.subscribe(&topics::GRASP, name)?,
            gripper: kit.subscribe(&topics::GRIPPER_MEASURED_JS, name)?,
            clutch: kit.subscribe(&topics::CLUTCH, name)?,
            force: kit.publish(&topics::SERVO_CF, name)?,
            law: kit.publish(&topics::CONTACT_LAW.kept_in_lockstep(scene.replay.lockstep), name)?,
            state: kit.publish(&topics::CONTACT_STATE, name)?,
            messages: Messages::new(tissue, scene.device.motion_scale),
            counters: Counters::new(),
            rejections: Throttle::new(LOG_PERIOD),
        })
    }

    /// Grasp, gripper and clutch, as they were last said; they count from the next pose on. The number of messages.
    pub(crate) fn hear_buttons(&mut self, session: &mut Session) -> u64 {
        let mut heard = 0;
        while let Some(grasp) = self.grasp.take() {
            heard += 1;
            session.command_grasp(self.index, grasp.data);
        }
        while let Some(gripper) = self.gripper.take() {
            heard += 1;
            if !session.hear_gripper(self.index, gripper.position.first().copied()) {
                self.counters.ignored_input();
            }
        }
        while let Some(joy) = self.clutch.take() {
            heard += 1;
            if !session.hear_clutch(self.index, joy.buttons.first().copied()) {
                self.counters.ignored_input();
            }
        }
        heard
    }

    /// Answer every pose that has arrived, oldest first, each followed by the surface if that is due.
    pub(crate) fn answer(
        &mut self,
        session: &mut Session,
        surface: &mut Surface,
        log: &Log,
    ) -> Result<(), PublishError> {
        while let Some(pose) = self.poses.take() {
            self.step(session, log, &pose)?;
            if let Some(moment) = session.surface_if_due() {
                surface.publish(&moment)?;
            }
        }
        Ok(())
    }

    /// One pose, one force: first what the hand waits for, then the rest.
    fn step(&mut self, session: &mut Session, log: &Log, pose: &PoseStamped) -> Result<(), PublishError> {
        let taken = Instant::now();
        let measured = MeasuredPose {
            stamp_ns: convert::stamp_ns(&pose.header.stamp),
            frame_id: &pose.header.frame_id,
            frame_from_hand: convert::pose_array(&pose.pose),
        };
        let answer = session.answer(self.index, &measured);
        self.publish_force(pose, &answer)?;
        self.counters.answered(&answer, taken.elapsed());
        self.publish_contact(pose, &answer)?;
        self.report_rejection(log, pose, &answer);
        Ok(())
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

    /// Take over settings that were changed while the node runs.
    pub(crate) fn retune(&mut self, tissue: &Tissue, motion_scale: f64) {
        self.messages.set_chains(tissue, motion_scale);
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
