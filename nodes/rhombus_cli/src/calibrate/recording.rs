//! Measured depths and forces from a recording: poses (`measured_cp`) and measured forces (`measured_cf`).
//!
//! The poses are answered again by a [`DeviceSession`] on the scene's body, which gives the depth and the normal of each
//! contact or grasp; each measured force belongs to the pose with the nearest stamp, and its part along the normal counts.
//! Grasp, gripper and clutch are heard as the model's node hears them.

use std::path::Path;

use glam::DVec3;
use recording::messages::{Bool, JointState, Joy, PoseStamped, Time, WrenchStamped};
use recording::{Recording, cdr};
use rhombus_chain::{Body, DeviceSession, HandPose, Mode, Pose, Tissue};
use scene::Scene;

use super::fitted::FitError;
use super::force::ForcePoint;

/// What a recording says about force and depth.
#[derive(Clone, Debug, PartialEq)]
pub struct Recorded {
    /// In order of time.
    pub force: Vec<ForcePoint>,
    /// Poses that were answered with a contact or grasp.
    pub touching: usize,
    /// Measured forces without a pose next to them, or without contact.
    pub unused: usize,
}

/// A measured force belongs to a pose whose stamp is at most this far away, ns.
const NEAR_NS: i64 = 2_000_000;

/// A pose that touched.
struct Touch {
    stamp_ns: i64,
    depth_m: f64,
    normal_in_frame: DVec3,
    frame: String,
}

/// Reads a recording and replays its poses on the scene's body. `device` is the sub-namespace of the device's topics; the
/// only one when `None`.
///
/// # Errors
/// The recording cannot be read, has not exactly one device's poses and forces, speaks of a frame the scene does not
/// connect with the body, or measured no force in contact.
pub fn read(
    path: &Path,
    scene: &Scene,
    body: &Body,
    tissue: &Tissue,
    device: Option<&str>,
) -> Result<Recorded, FitError> {
    let data = |problem: String| FitError::Data(format!("{}: {problem}", path.display()));
    let recording = Recording::open(path).map_err(|error| FitError::Data(error.to_string()))?;
    let prefix = prefix(&recording, device).map_err(data)?;
    let name = |topic: usize| recording.topics()[topic].topic.name.strip_prefix(&prefix).unwrap_or_default();
    let mut session = DeviceSession::new(scene.device.motion_scale);
    let (mut touches, mut forces) = (Vec::new(), Vec::new());
    for message in recording.messages() {
        let message = message.map_err(|error| FitError::Data(error.to_string()))?;
        let broken = |error: cdr::CdrError| data(format!("{}{}: {error}", prefix, name(message.topic)));
        match name(message.topic) {
            "measured_cp" => {
                let pose: PoseStamped = cdr::decode(&message.data).map_err(broken)?;
                let body_from_frame = body_from_frame(scene, &pose.header.frame_id).map_err(data)?;
                touches.extend(touch(&mut session, body, tissue, pose, body_from_frame));
            }
            "measured_cf" => {
                let force: WrenchStamped = cdr::decode(&message.data).map_err(broken)?;
                forces.push(force);
            }
            "grasp" => {
                let hold: Bool = cdr::decode(&message.data).map_err(broken)?;
                session.command_grasp(hold.data);
            }
            "clutch" => {
                let joy: Joy = cdr::decode(&message.data).map_err(broken)?;
                session.set_clutched(joy.buttons.first().is_some_and(|pressed| *pressed != 0));
            }
            "gripper/measured_js" => {
                let joints: JointState = cdr::decode(&message.data).map_err(broken)?;
                if let Some(angle_rad) = joints.position.first() {
                    session.set_gripper_closed(*angle_rad < scene.grasp.close_below_rad);
                }
            }
            _ => {}
        }
    }
    let recorded = paired(&touches, &forces).map_err(data)?;
    match recorded.force.is_empty() {
        false => Ok(recorded),
        true => Err(data(format!(
            "{} poses touch the body of the scene and none of {} measured forces belongs to one; accepted: forces stamped \
             within 2 ms of a pose in contact",
            recorded.touching,
            forces.len()
        ))),
    }
}

/// The name in front of `measured_cp` of the only device with poses and forces.
fn prefix(recording: &Recording, device: Option<&str>) -> Result<String, String> {
    let names: Vec<&str> = recording.topics().iter().map(|topic| topic.topic.name.as_str()).collect();
    let prefixes: Vec<&str> = names
        .iter()
        .filter_map(|name| name.strip_suffix("measured_cp").filter(|prefix| prefix.ends_with('/')))
        .filter(|prefix| names.contains(&format!("{prefix}measured_cf").as_str()))
        .filter(|prefix| {
            device.is_none_or(|device| prefix.trim_end_matches('/').ends_with(&format!("/{device}")))
        })
        .collect();
    match prefixes[..] {
        [prefix] => Ok(prefix.to_owned()),
        [] => Err(format!(
            "no device with both measured_cp and measured_cf; its topics are {}; accepted: poses and measured forces",
            names.join(" ")
        )),
        _ => Err(format!("several devices: {}; accepted: --device NAME for one of them", prefixes.join(" "))),
    }
}

/// Where the parameters put the frame of a pose. Names are compared without their namespace.
fn body_from_frame(scene: &Scene, frame_id: &str) -> Result<Pose, String> {
    let bare = |name: &str| name.rsplit('/').next().unwrap_or_default().to_owned();
    let body_from_scene = scene.body.scene_from_body.inverse();
    let frame = bare(frame_id);
    let frames = [
        (&scene.device.frame_id, body_from_scene * scene.device.scene_from_device),
        (&scene.session.scene_frame_id, body_from_scene),
        (&scene.body.frame_id, Pose::IDENTITY),
    ];
    let found = frames.iter().find(|(name, _)| bare(name) == frame);
    found.map(|(_, pose)| *pose).ok_or_else(|| {
        let names: Vec<&str> = frames.iter().map(|(name, _)| name.as_str()).collect();
        format!("a pose in frame {frame_id:?}; accepted: the scene's {}", names.join(", "))
    })
}

/// A pose that touches; one that is rejected or does not touch is none.
fn touch(
    session: &mut DeviceSession,
    body: &Body,
    tissue: &Tissue,
    pose: PoseStamped,
    body_from_frame: Pose,
) -> Option<Touch> {
    let (p, q) = (&pose.pose.position, &pose.pose.orientation);
    let pose_in = HandPose {
        stamp_ns: nanoseconds(&pose.header.stamp),
        frame_from_hand: [p.x, p.y, p.z, q.x, q.y, q.z, q.w],
        body_from_frame: Some(body_from_frame),
    };
    let answer = session.answer(body, tissue, &pose_in).ok()?;
    (answer.step.mode != Mode::None).then(|| Touch {
        stamp_ns: pose_in.stamp_ns,
        depth_m: answer.step.depth_m,
        normal_in_frame: answer.frame_from_body.rotate(answer.step.normal),
        frame: pose.header.frame_id,
    })
}

/// Gives each force to the pose next to it.
fn paired(touches: &[Touch], forces: &[WrenchStamped]) -> Result<Recorded, String> {
    let mut force = Vec::new();
    for wrench in forces {
        let stamp_ns = nanoseconds(&wrench.header.stamp);
        let after = touches.partition_point(|touch| touch.stamp_ns < stamp_ns);
        let near =
            [after.checked_sub(1), Some(after)].into_iter().flatten().filter_map(|place| touches.get(place));
        let Some(touch) = near.min_by_key(|touch| touch.stamp_ns.abs_diff(stamp_ns)) else { continue };
        if touch.stamp_ns.abs_diff(stamp_ns) > NEAR_NS.unsigned_abs() {
            continue;
        }
        if touch.frame != wrench.header.frame_id {
            let (pose, found) = (&touch.frame, &wrench.header.frame_id);
            return Err(format!("a force in frame {found:?}; accepted: that of the poses, {pose:?}"));
        }
        let f = &wrench.wrench.force;
        let along = DVec3::new(f.x, f.y, f.z).dot(touch.normal_in_frame);
        if along.is_finite() {
            force.push(ForcePoint { depth_m: touch.depth_m, force_n: along });
        }
    }
    Ok(Recorded { touching: touches.len(), unused: forces.len() - force.len(), force })
}

fn nanoseconds(time: &Time) -> i64 {
    i64::from(time.sec) * 1_000_000_000 + i64::from(time.nanosec)
}
