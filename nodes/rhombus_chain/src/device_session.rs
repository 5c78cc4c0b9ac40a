//! One device on one body: from the pose of the hand in whatever frame it came, to the force on the hand in that frame.
//!
//! In front of the model's [`Interaction`] stands the way from hand to probe: frame, motion scale, clutch, and the checks
//! of what came in. It is here and not in a node, so that a recording is replayed with the same code without ROS.
//!
//! The probe is at `body_from_frame * (motion_scale * hand) + offset`. The scale stretches the hand's position about the
//! origin of the frame the pose came in; forces are not scaled. The offset is zero until the clutch moves it: while the
//! clutch is held the probe stays where it is, and so does the force; the offset follows the hand, and on release the
//! motion goes on from there.

use glam::DVec3;
use thiserror::Error;

use crate::body::Body;
use crate::interaction::{Impression, Interaction, Step, StepError};
use crate::local_law::LocalLaw;
use crate::parameters::ChainParameters;
use crate::pose::{Pose, PoseError};
use crate::tissue::Tissue;

/// One device on one body. Plain data: equal states and equal inputs give equal bits.
#[derive(Clone, Debug, PartialEq)]
pub struct DeviceSession {
    interaction: Interaction,
    motion_scale: f64,
    /// What the clutch has added to the probe's position, body frame, m.
    offset_in_body_m: DVec3,
    /// The probe at the last accepted pose, body frame, m.
    probe_in_body: Option<DVec3>,
    /// Stamp of the last pose, accepted or not.
    stamp_ns: Option<i64>,
    grasp_commanded: bool,
    gripper_closed: bool,
    clutched: bool,
}

/// A pose as it came in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HandPose {
    /// When the device measured it.
    pub stamp_ns: i64,
    /// `[x, y, z, qx, qy, qz, qw]` of the hand in its frame, unchecked.
    pub frame_from_hand: [f64; 7],
    /// Where that frame is in the body's; none when nothing connects the two.
    pub body_from_frame: Option<Pose>,
}

/// The answer to one pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// Force on the hand in newton, in the frame of the pose.
    pub force_in_frame_n: DVec3,
    /// What the motor loop may use until the next pose, in the frame of the pose and for positions of the *hand*: the
    /// motion scale and the clutch are worked in. It belongs to the chains of [`chain_for_hand`].
    pub law_for_hand: LocalLaw,
    /// The model's answer, in the body frame.
    pub step: Step,
    /// Centre of the probe, in the body frame, m.
    pub probe_in_body: DVec3,
    /// From the body frame to the frame of the pose.
    pub frame_from_body: Pose,
    /// The clutch is held: moving the hand does not move the probe.
    pub clutched: bool,
}

/// Why a pose got no answer. The contact has been reset; the force is zero.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum Rejection {
    /// A NaN, an infinity, or a position far beyond any device's workspace.
    #[error("{0}")]
    NotFinite(PoseError),
    /// A quaternion that is not a rotation.
    #[error("{0}")]
    NotUnitQuaternion(PoseError),
    /// No transform connects the pose's frame with the body's.
    #[error(
        "the pose's frame is not connected with the body's; accepted: a frame that /tf, /tf_static or the parameters connect"
    )]
    UnknownFrame,
    /// The stamp is before the last one. The time line starts anew from it.
    #[error("{0}")]
    StampBackwards(StepError),
    /// The probe is farther away than the model computes.
    #[error("{0}")]
    OutOfReach(StepError),
}

impl Rejection {
    /// Names of all causes, in the order of [`Rejection::cause`].
    pub const CAUSES: [&'static str; 5] =
        ["not_finite", "not_unit_quaternion", "unknown_frame", "stamp_backwards", "out_of_reach"];

    /// Index of the cause in [`Rejection::CAUSES`], for counters.
    #[must_use]
    pub fn cause(&self) -> usize {
        match self {
            Self::NotFinite(_) => 0,
            Self::NotUnitQuaternion(_) => 1,
            Self::UnknownFrame => 2,
            Self::StampBackwards(_) => 3,
            Self::OutOfReach(_) => 4,
        }
    }
}

impl DeviceSession {
    /// A device that has not moved yet. `motion_scale`: motion of the probe for each metre of the hand, finite, > 0.
    #[must_use]
    pub fn new(motion_scale: f64) -> Self {
        Self {
            interaction: Interaction::new(),
            motion_scale,
            offset_in_body_m: DVec3::ZERO,
            probe_in_body: None,
            stamp_ns: None,
            grasp_commanded: false,
            gripper_closed: false,
            clutched: false,
        }
    }

    /// Answers one pose. Real-time safe.
    ///
    /// # Errors
    /// Why the pose is not accepted; the contact is then reset, so the answer is no force and no contact.
    pub fn answer(&mut self, body: &Body, tissue: &Tissue, pose: &HandPose) -> Result<Answer, Rejection> {
        let answer = self.try_answer(body, tissue, pose);
        if answer.is_err() {
            self.interaction.reset();
        }
        answer
    }

    fn try_answer(&mut self, body: &Body, tissue: &Tissue, pose: &HandPose) -> Result<Answer, Rejection> {
        let frame_from_hand = Pose::from_array(pose.frame_from_hand).map_err(|error| match error {
            PoseError::NonFinite { .. } => Rejection::NotFinite(error),
            PoseError::NotUnit { .. } => Rejection::NotUnitQuaternion(error),
        })?;
        let body_from_frame = pose.body_from_frame.ok_or(Rejection::UnknownFrame)?;
        let previous_ns = self.stamp_ns.replace(pose.stamp_ns);
        if let Some(previous_ns) = previous_ns.filter(|previous_ns| pose.stamp_ns < *previous_ns) {
            let stamp_ns = pose.stamp_ns;
            return Err(Rejection::StampBackwards(StepError::StampWentBack { previous_ns, stamp_ns }));
        }

        let unclutched = body_from_frame.transform_point(frame_from_hand.translation * self.motion_scale);
        let frozen = self.probe_in_body.filter(|_| self.clutched);
        if let Some(frozen) = frozen {
            self.offset_in_body_m = frozen - unclutched;
        }
        let probe_in_body = frozen.unwrap_or(unclutched + self.offset_in_body_m);
        let grasp = self.grasp_commanded || self.gripper_closed;
        let step = self.interaction.step(body, tissue, pose.stamp_ns, probe_in_body, grasp);
        let step = step.map_err(Rejection::OutOfReach)?;
        self.probe_in_body = Some(probe_in_body);

        let frame_from_body = body_from_frame.inverse();
        Ok(Answer {
            force_in_frame_n: frame_from_body.rotate(step.force_n),
            law_for_hand: self.law_for_hand(&step.local_law, &frame_from_body),
            step,
            probe_in_body,
            frame_from_body,
            clutched: self.clutched,
        })
    }

    /// The law of the probe in the body as a law of the hand in its frame: with `probe = s hand + offset` every length is
    /// divided by s and every stiffness multiplied by it, which leaves the force as it is.
    fn law_for_hand(&self, law: &LocalLaw, frame_from_body: &Pose) -> LocalLaw {
        let anchor_in_frame = frame_from_body.transform_point(law.anchor - self.offset_in_body_m);
        LocalLaw {
            mode: law.mode,
            anchor: anchor_in_frame / self.motion_scale,
            normal: frame_from_body.rotate(law.normal),
            probe_radius_m: law.probe_radius_m / self.motion_scale,
            depth_offset_m: law.depth_offset_m / self.motion_scale,
            stiffness_factor: law.stiffness_factor,
            stiffness_gradient_per_m: frame_from_body.rotate(law.stiffness_gradient_per_m)
                * self.motion_scale,
            lateral_stiffness_n_per_m: law.lateral_stiffness_n_per_m * self.motion_scale,
        }
    }

    /// Hold the surface while true, whatever the gripper does. Counts from the next pose on.
    pub fn command_grasp(&mut self, hold: bool) {
        self.grasp_commanded = hold;
    }

    /// The gripper is closed: holds the surface too.
    pub fn set_gripper_closed(&mut self, closed: bool) {
        self.gripper_closed = closed;
    }

    /// The clutch is held. Counts from the next pose on.
    pub fn set_clutched(&mut self, clutched: bool) {
        self.clutched = clutched;
    }

    /// Motion of the probe for each metre of the hand.
    #[must_use]
    pub fn motion_scale(&self) -> f64 {
        self.motion_scale
    }

    /// How this device moves the surface.
    pub fn impressions(&self) -> impl Iterator<Item = Impression> {
        self.interaction.impressions()
    }
}

/// The chain that goes with [`Answer::law_for_hand`]: lengths divided by the motion scale, stiffnesses multiplied by it. At
/// hand depth d it gives the force that `chain` gives at `motion_scale * d`.
#[must_use]
pub fn chain_for_hand(chain: &ChainParameters, motion_scale: f64) -> ChainParameters {
    ChainParameters {
        rod_length_m: chain.rod_length_m / motion_scale,
        pitch_m: chain.pitch_m / motion_scale,
        normal_stiffness_n_per_m: chain.normal_stiffness_n_per_m * motion_scale,
        tangential_stiffness_n_per_m: chain.tangential_stiffness_n_per_m * motion_scale,
        ..*chain
    }
}
