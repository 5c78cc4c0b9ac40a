//! What a device measures, as messages: which topics it has, and what goes out for each sample.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use devices::{Axes, Description, Sample, Wrench};
use node_kit::{NodeKit, PublishError, Publisher, StartError, convert, topics, transform_stamped};
use r2r::geometry_msgs::msg::{PoseStamped, TwistStamped, WrenchStamped};
use r2r::sensor_msgs::msg::{JointState, Joy};
use r2r::std_msgs::msg::Header;
use r2r::tf2_msgs::msg::TFMessage;
use rhombus_chain::Pose;

use crate::buttons::Button;
use crate::decimation::{Every, EveryNth};
use crate::shared::Shared;
use crate::wrench_frame::{DeviceFrames, body_axes};

/// Time between two gripper messages while the gripper moves little, ns. Clients take 10 ms of silence for a loss.
const GRIPPER_PERIOD_NS: u64 = 5_000_000;
/// A gripper that has moved by this since its last message is published at once, rad.
const GRIPPER_STEP_RAD: f64 = 0.01;
/// Time between two transforms of the handle, ns.
const TRANSFORM_PERIOD_NS: u64 = 20_000_000;

/// The publishers and messages of a device. Messages are made once and filled anew.
pub(crate) struct Outbox {
    frames: DeviceFrames,
    body_is_absolute: Arc<AtomicBool>,
    measured_cp: (Publisher<PoseStamped>, PoseStamped),
    measured_cv: (Publisher<TwistStamped>, TwistStamped),
    measured_js: Option<(Publisher<JointState>, JointState)>,
    base_cf: ([Publisher<WrenchStamped>; 2], WrenchStamped),
    body_cf: (Publisher<WrenchStamped>, WrenchStamped),
    gripper: Option<Gripper>,
    buttons: Vec<ButtonTopic>,
    transforms: Publisher<TFMessage>,
    transform_is_due: Every,
    pose_is_due: EveryNth,
}

struct Gripper {
    publisher: Publisher<JointState>,
    message: JointState,
    is_due: Every,
}

/// A button by the device's name for it, or the clutch.
struct ButtonTopic {
    bit: u32,
    button: Button,
    publisher: Publisher<Joy>,
}

impl Outbox {
    /// Makes the publishers: of what this device has. `clutch_button` is the number of a button.
    pub(crate) fn new(
        kit: &mut NodeKit,
        shared: &Shared,
        clutch_button: Option<u32>,
        pose_is_due: EveryNth,
    ) -> Result<Outbox, StartError> {
        let Shared { description, frames, .. } = shared;
        let header = Header { frame_id: frames.base.clone(), ..Header::default() };
        let joint_state = |names: &[String]| JointState {
            header: header.clone(),
            name: names.to_vec(),
            position: vec![0.0; names.len()],
            ..JointState::default()
        };
        let measured_js = if description.joints.is_empty() {
            None
        } else {
            Some((kit.publish(&topics::MEASURED_JS, "")?, joint_state(&description.joints)))
        };
        let gripper = if description.has_gripper {
            Some(Gripper {
                publisher: kit.publish(&topics::GRIPPER_MEASURED_JS, "")?,
                message: joint_state(&["gripper".to_owned()]),
                is_due: Every::new(GRIPPER_PERIOD_NS),
            })
        } else {
            None
        };
        let wrench = WrenchStamped { header: header.clone(), ..WrenchStamped::default() };
        Ok(Outbox {
            measured_cp: (
                kit.publish(&topics::MEASURED_CP, "")?,
                PoseStamped { header: header.clone(), ..PoseStamped::default() },
            ),
            measured_cv: (
                kit.publish(&topics::MEASURED_CV, "")?,
                TwistStamped { header: header.clone(), ..TwistStamped::default() },
            ),
            measured_js,
            base_cf: (
                [kit.publish(&topics::MEASURED_CF, "")?, kit.publish(&topics::SPATIAL_MEASURED_CF, "")?],
                wrench.clone(),
            ),
            body_cf: (kit.publish(&topics::BODY_MEASURED_CF, "")?, wrench),
            gripper,
            buttons: buttons(kit, description, clutch_button)?,
            transforms: kit.publish(&topics::TF, "")?,
            transform_is_due: Every::new(TRANSFORM_PERIOD_NS),
            pose_is_due,
            frames: frames.clone(),
            body_is_absolute: shared.body_is_absolute.clone(),
        })
    }

    /// Subscriptions of the poses found so far.
    pub(crate) fn readers(&self) -> usize {
        self.measured_cp.0.readers()
    }

    /// Whether this sample's pose is to be published. To be asked once for each sample.
    pub(crate) fn takes_pose(&mut self) -> bool {
        self.pose_is_due.is_due()
    }

    /// Publishes a sample: buttons and gripper when they change, the rest when `with_pose`. The pose comes first, because a
    /// force waits for it; but a gripper or a button that has just changed goes ahead of the pose that it belongs to.
    pub(crate) fn publish(&mut self, sample: &Sample, with_pose: bool) -> Result<(), PublishError> {
        self.publish_buttons(sample)?;
        self.publish_gripper(sample)?;
        if with_pose {
            self.publish_motion(sample)?;
            self.publish_wrench(sample)?;
        }
        if self.transform_is_due.is_due(sample.monotonic_ns) {
            let DeviceFrames { base, tip } = &self.frames;
            let transform = transform_stamped(sample.stamp_ns, base, tip, &sample.state.pose);
            self.transforms.publish(&TFMessage { transforms: vec![transform] })?;
        }
        Ok(())
    }

    fn publish_motion(&mut self, sample: &Sample) -> Result<(), PublishError> {
        let (stamp, state) = (convert::stamp(sample.stamp_ns), &sample.state);
        let (publisher, message) = &mut self.measured_cp;
        message.header.stamp = stamp.clone();
        message.pose = convert::pose(&state.pose);
        publisher.publish(message)?;
        let (publisher, message) = &mut self.measured_cv;
        message.header.stamp = stamp.clone();
        message.twist.linear = convert::vector(state.linear_velocity_m_per_s);
        message.twist.angular = convert::vector(state.angular_velocity_rad_per_s);
        publisher.publish(message)?;
        let Some((publisher, message)) = &mut self.measured_js else { return Ok(()) };
        message.header.stamp = stamp;
        let joints = message.position.len().min(state.joints.len());
        message.position[..joints].copy_from_slice(&state.joints[..joints]);
        publisher.publish(message)
    }

    fn publish_wrench(&mut self, sample: &Sample) -> Result<(), PublishError> {
        let stamp = convert::stamp(sample.stamp_ns);
        let (publishers, message) = &mut self.base_cf;
        fill(message, &sample.wrench);
        message.header.stamp = stamp.clone();
        for publisher in publishers {
            publisher.publish(message)?;
        }
        let axes = body_axes(self.body_is_absolute.load(Relaxed));
        let (publisher, message) = &mut self.body_cf;
        fill(message, &in_axes(&sample.wrench, axes, &sample.state.pose));
        message.header.stamp = stamp;
        if message.header.frame_id != self.frames.of(axes) {
            self.frames.of(axes).clone_into(&mut message.header.frame_id);
        }
        publisher.publish(message)
    }

    fn publish_buttons(&mut self, sample: &Sample) -> Result<(), PublishError> {
        for ButtonTopic { bit, button, publisher } in &mut self.buttons {
            for event in button.events(sample.state.buttons & *bit != 0, sample.monotonic_ns) {
                let header =
                    Header { stamp: convert::stamp(sample.stamp_ns), frame_id: self.frames.base.clone() };
                publisher.publish(&Joy { header, axes: Vec::new(), buttons: vec![*event] })?;
            }
        }
        Ok(())
    }

    fn publish_gripper(&mut self, sample: &Sample) -> Result<(), PublishError> {
        let (Some(gripper), Some(angle_rad)) = (&mut self.gripper, sample.state.gripper_rad) else {
            return Ok(());
        };
        let moved = (angle_rad - gripper.message.position[0]).abs() >= GRIPPER_STEP_RAD;
        if !gripper.is_due.is_due_or(moved, sample.monotonic_ns) {
            return Ok(());
        }
        gripper.message.header.stamp = convert::stamp(sample.stamp_ns);
        gripper.message.position[0] = angle_rad;
        gripper.publisher.publish(&gripper.message)
    }
}

/// Every button that the device names, and the clutch under its own name, too.
fn buttons(
    kit: &mut NodeKit,
    description: &Description,
    clutch_button: Option<u32>,
) -> Result<Vec<ButtonTopic>, StartError> {
    let mut buttons = Vec::new();
    for (place, name) in description.buttons.iter().enumerate() {
        let publisher = kit.publish(&topics::button(name), "")?;
        buttons.push(ButtonTopic { bit: 1 << place, button: Button::default(), publisher });
    }
    if let Some(place) = clutch_button {
        let publisher = kit.publish(&topics::CLUTCH, "")?;
        buttons.push(ButtonTopic { bit: 1 << place, button: Button::default(), publisher });
    }
    Ok(buttons)
}

fn fill(message: &mut WrenchStamped, wrench: &Wrench) {
    message.wrench.force = convert::vector(wrench.force_n);
    message.wrench.torque = convert::vector(wrench.torque_n_m);
}

/// A wrench of the device frame in other axes, for a handle at `pose`.
fn in_axes(wrench: &Wrench, axes: Axes, pose: &Pose) -> Wrench {
    match axes {
        Axes::Base => *wrench,
        Axes::Tip => {
            let tip_from_base = pose.rotation.conjugate();
            Wrench {
                force_n: tip_from_base * wrench.force_n,
                torque_n_m: tip_from_base * wrench.torque_n_m,
                ..*wrench
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DQuat, DVec3};
    use std::f64::consts::FRAC_PI_2;

    #[test]
    fn the_bodys_axes_turn_with_the_handle_and_the_bases_do_not() {
        let quarter_turn = Pose { translation: DVec3::ONE, rotation: DQuat::from_rotation_z(FRAC_PI_2) };
        let wrench = Wrench { torque_n_m: DVec3::Y, ..Wrench::of_force(DVec3::X) };
        let body = in_axes(&wrench, Axes::Tip, &quarter_turn);
        assert!((body.force_n - DVec3::NEG_Y).length() < 1e-15);
        assert!((body.torque_n_m - DVec3::X).length() < 1e-15);
        assert_eq!(in_axes(&wrench, Axes::Base, &quarter_turn), wrench);
    }
}
