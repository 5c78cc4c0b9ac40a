//! The model on a recording: messages in the order of a replay, each answered before the next.

use anyhow::Context;
use recording::cdr::{self, CdrError};
use recording::messages::{Bool, Header, JointState, Joy, PoseStamped, TFMessage, TransformStamped};
use recording::{MessageRef, Recording};
use rhombus_chain::{MeasuredPose, Rejection, Session};
use scene::Scene;

use super::answers::{self, Answers, OutputTopic, PER_DEVICE, Surface};
use super::inputs::{Input, Inputs};

/// A replay that is ready to begin.
pub struct Replay<'a> {
    recording: &'a Recording,
    inputs: Inputs,
    session: Session,
    devices: Vec<Answers>,
    surface: Surface,
    topics: Vec<OutputTopic>,
    counts: Counts,
}

/// What a replay met.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Counts {
    /// Poses, answered or rejected.
    pub poses: u64,
    /// Poses that the model rejected and answered with no force, by cause.
    pub rejected: [u64; Rejection::CAUSES.len()],
    /// Messages of the model's inputs that could not be decoded or said nothing that could be used.
    pub unusable: u64,
    /// Places of the recording that could not be read.
    pub unreadable_places: u64,
    /// Surfaces.
    pub surfaces: u64,
    /// First and last stamp of poses, ns since 1970.
    pub stamps_ns: Option<(i64, i64)>,
}

/// A computed message.
#[derive(Clone, Copy, Debug)]
pub struct Output<'a> {
    /// Index into [`Replay::topics`].
    pub topic: usize,
    /// Log time of the message that it answers, ns since 1970.
    pub log_time_ns: u64,
    /// CDR with its header.
    pub data: &'a [u8],
}

impl<'a> Replay<'a> {
    /// Of a recording, on the body and with the chains of a scene. See [`Inputs::find`] for the other arguments.
    ///
    /// # Errors
    /// The scene has no model, or the recording has nothing for it.
    pub fn new(
        recording: &'a Recording,
        scene: &Scene,
        namespace: Option<&str>,
        remap: &[(String, String)],
    ) -> anyhow::Result<Self> {
        let names = &scene.session.devices;
        let inputs = Inputs::find(recording, names, namespace, remap)?;
        let loaded = scene.load_session(&inputs.namespace)?;
        let session = loaded.session;
        Ok(Self {
            recording,
            topics: answers::topics(&inputs.namespace, names),
            devices: names.iter().map(|_| Answers::new(&session, scene.device.motion_scale)).collect(),
            surface: Surface::new(session.body_frame(), loaded.topology_version),
            inputs,
            session,
            counts: Counts::default(),
        })
    }

    /// The topics that are computed.
    pub fn topics(&self) -> &[OutputTopic] {
        &self.topics
    }

    /// Replays everything; each computed message goes to `take` at once.
    ///
    /// # Errors
    /// What `take` says.
    pub fn run(mut self, mut take: impl FnMut(Output<'_>) -> anyhow::Result<()>) -> anyhow::Result<Counts> {
        let mut first = true;
        self.counts.unreadable_places = self.recording.damage().len() as u64;
        let mut messages = self.recording.playback(&self.inputs.playback());
        while let Some(message) = messages.next_ref() {
            let Ok(message) = message else {
                self.counts.unreadable_places += 1;
                continue;
            };
            if std::mem::take(&mut first) {
                let data = answers::rest_mesh(&self.session);
                let topic = self.topics.len() - 1;
                take(Output { topic, log_time_ns: message.log_time_ns, data: &data })?;
            }
            if self.hear(&message, &mut take).context("cannot hand on a computed message")?.is_err() {
                self.counts.unusable += 1;
            }
        }
        Ok(self.counts)
    }

    /// One message. The inner error: it cannot be decoded.
    fn hear(
        &mut self,
        message: &MessageRef<'_>,
        take: &mut impl FnMut(Output<'_>) -> anyhow::Result<()>,
    ) -> anyhow::Result<Result<(), CdrError>> {
        let Some(input) = self.inputs.of(message.topic) else { return Ok(Ok(())) };
        match input {
            Input::Pose(device) => match cdr::decode::<PoseStamped>(message.data) {
                Ok(PoseStamped { header, pose }) => {
                    let (p, q) = (pose.position, pose.orientation);
                    self.answer(device, &header, [p.x, p.y, p.z, q.x, q.y, q.z, q.w], message, take)?;
                }
                Err(error) => return Ok(Err(error)),
            },
            Input::Transform(device) => match cdr::decode::<TransformStamped>(message.data) {
                Ok(TransformStamped { header, transform, .. }) => {
                    let (t, q) = (transform.translation, transform.rotation);
                    self.answer(device, &header, [t.x, t.y, t.z, q.x, q.y, q.z, q.w], message, take)?;
                }
                Err(error) => return Ok(Err(error)),
            },
            other => return Ok(self.hear_other(other, message.data)),
        }
        Ok(Ok(()))
    }

    fn hear_other(&mut self, input: Input, data: &[u8]) -> Result<(), CdrError> {
        let usable = match input {
            Input::Grasp(device) => {
                self.session.command_grasp(device, cdr::decode::<Bool>(data)?.data);
                true
            }
            Input::Gripper(device) => {
                let joints: JointState = cdr::decode(data)?;
                self.session.hear_gripper(device, joints.position.first().copied())
            }
            Input::Clutch(device) => {
                let joy: Joy = cdr::decode(data)?;
                self.session.hear_clutch(device, joy.buttons.first().copied())
            }
            Input::Frames | Input::Pose(_) | Input::Transform(_) => {
                for placed in cdr::decode::<TFMessage>(data)?.transforms {
                    let (t, q) = (placed.transform.translation, placed.transform.rotation);
                    let parent_from_child = [t.x, t.y, t.z, q.x, q.y, q.z, q.w];
                    self.session.hear_transform(
                        &placed.header.frame_id,
                        &placed.child_frame_id,
                        parent_from_child,
                    );
                }
                true
            }
        };
        self.counts.unusable += u64::from(!usable);
        Ok(())
    }

    fn answer(
        &mut self,
        device: usize,
        header: &Header,
        frame_from_hand: [f64; 7],
        message: &MessageRef<'_>,
        take: &mut impl FnMut(Output<'_>) -> anyhow::Result<()>,
    ) -> anyhow::Result<()> {
        let stamp_ns = answers::stamp_ns(&header.stamp);
        let pose = MeasuredPose { stamp_ns, frame_id: &header.frame_id, frame_from_hand };
        let answer = self.session.answer(device, &pose);
        self.counts.poses += 1;
        let (first, last) = self.counts.stamps_ns.unwrap_or((stamp_ns, stamp_ns));
        self.counts.stamps_ns = Some((first.min(stamp_ns), last.max(stamp_ns)));
        if let Err(rejection) = &answer {
            self.counts.rejected[rejection.cause()] += 1;
        }
        let log_time_ns = message.log_time_ns;
        let answers = &mut self.devices[device];
        answers.set(header, answer.as_ref().ok());
        for (place, data) in answers.encoded() {
            take(Output { topic: device * PER_DEVICE + place, log_time_ns, data: &data })?;
        }
        if let Some(moment) = self.session.surface_if_due() {
            let data = self.surface.encoded(&moment);
            self.counts.surfaces += 1;
            take(Output { topic: self.topics.len() - 2, log_time_ns, data: &data })?;
        }
        Ok(())
    }
}
