//! A session: devices on one body, from what they say to what they are answered, in the order in which they say it.
//!
//! Everything the answers depend on comes in here and time is in the stamps, so that the same inputs in the same order
//! give the same bits, whether a node brings them or a recording. [`Session::answer`] is real-time safe as long as a pose
//! names the frame that its device's last one named.

use glam::DVec3;

use crate::body::Body;
use crate::device_session::{Answer, DeviceSession, HandPose, Rejection};
use crate::frame_tree::{FrameTree, frame_of_message};
use crate::pose::Pose;
use crate::session_time::SessionTime;
use crate::stamp_rate::StampRate;
use crate::surface_field::SurfaceField;
use crate::tissue::Tissue;

/// What a session is made of.
#[derive(Clone, Debug)]
pub struct SessionParts {
    /// What is touched.
    pub body: Body,
    /// What it is made of.
    pub tissue: Tissue,
    /// The body's frame, as tf names it.
    pub body_frame: String,
    /// What is known of frames from the start.
    pub frames: FrameTree,
    /// Number of devices.
    pub devices: usize,
    /// Motion of the probe for each metre of the hand.
    pub motion_scale: f64,
    /// A gripper holds the surface below this angle, rad.
    pub close_below_rad: f64,
    /// How often, by stamps, the surface is computed, and the memory for it; none computes none.
    pub surface: Option<(StampRate, SurfaceField)>,
}

/// Devices on one body.
#[derive(Clone, Debug)]
pub struct Session {
    body: Body,
    tissue: Tissue,
    body_frame: String,
    frames: FrameTree,
    devices: Vec<Device>,
    time: SessionTime,
    close_below_rad: f64,
    surface: Option<(StampRate, SurfaceField)>,
}

/// A pose of a hand as a device measured it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeasuredPose<'a> {
    /// When, ns since 1970.
    pub stamp_ns: i64,
    /// In which frame; a leading "/" is left out, as tf does.
    pub frame_id: &'a str,
    /// `[x, y, z, qx, qy, qz, qw]` in that frame, unchecked.
    pub frame_from_hand: [f64; 7],
}

/// The surface at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceMoment<'a> {
    /// The session's time, ns since 1970.
    pub stamp_ns: i64,
    /// The vertices that are not at rest, ascending.
    pub vertices: &'a [u32],
    /// Their displacements in the body's frame, m.
    pub displacements: &'a [DVec3],
}

#[derive(Clone, Debug)]
struct Device {
    session: DeviceSession,
    place: Place,
}

/// Where the frame of a device's poses is, looked up only when the frame or any transform has changed.
#[derive(Clone, Debug, Default)]
struct Place {
    frame_id: String,
    version: Option<u64>,
    body_from_frame: Option<Pose>,
}

impl Session {
    /// A session in which nobody has said anything yet.
    #[must_use]
    pub fn new(parts: SessionParts) -> Self {
        let device = Device { session: DeviceSession::new(parts.motion_scale), place: Place::default() };
        Self {
            body: parts.body,
            tissue: parts.tissue,
            body_frame: parts.body_frame,
            frames: parts.frames,
            devices: vec![device; parts.devices],
            time: SessionTime::new(parts.devices),
            close_below_rad: parts.close_below_rad,
            surface: parts.surface,
        }
    }

    /// A transform from `/tf` or `/tf_static`; see [`FrameTree::hear`].
    pub fn hear_transform(&mut self, parent: &str, child: &str, parent_from_child: [f64; 7]) {
        self.frames.hear(parent, child, parent_from_child);
    }

    /// Hold the surface while true. Counts from the device's next pose on, as gripper and clutch do.
    pub fn command_grasp(&mut self, device: usize, hold: bool) {
        if let Some(device) = self.devices.get_mut(device) {
            device.session.command_grasp(hold);
        }
    }

    /// The opening of a device's gripper, rad. False: it says nothing that could be used.
    pub fn hear_gripper(&mut self, device: usize, angle_rad: Option<f64>) -> bool {
        let (Some(device), Some(angle_rad)) = (self.devices.get_mut(device), angle_rad) else { return false };
        if angle_rad.is_finite() {
            device.session.set_gripper_closed(angle_rad < self.close_below_rad);
        }
        angle_rad.is_finite()
    }

    /// The first button of a device's clutch, 0 released. False: there is none.
    pub fn hear_clutch(&mut self, device: usize, button: Option<i32>) -> bool {
        let (Some(device), Some(button)) = (self.devices.get_mut(device), button) else { return false };
        device.session.set_clutched(button != 0);
        true
    }

    /// Answers one pose of one device.
    ///
    /// # Errors
    /// Why the pose is not accepted; the contact is then reset: no force, no contact.
    pub fn answer(&mut self, device: usize, pose: &MeasuredPose<'_>) -> Result<Answer, Rejection> {
        let Some(Device { session, place }) = self.devices.get_mut(device) else {
            return Err(Rejection::UnknownFrame);
        };
        self.time.hear(device, pose.stamp_ns);
        let hand = HandPose {
            stamp_ns: pose.stamp_ns,
            frame_from_hand: pose.frame_from_hand,
            body_from_frame: place.find(&self.frames, &self.body_frame, pose.frame_id),
        };
        session.answer(&self.body, &self.tissue, &hand)
    }

    /// The surface, moved by all devices, if it is due at the session's time. To be asked after every answer: what it is
    /// then depends on the order of the poses alone and not on how many were waiting.
    pub fn surface_if_due(&mut self) -> Option<SurfaceMoment<'_>> {
        let (rate, field) = self.surface.as_mut()?;
        let stamp_ns = self.time.now_ns()?;
        if !rate.is_due(stamp_ns) {
            return None;
        }
        let impressions = self.devices.iter().flat_map(|device| device.session.impressions());
        field.update(&self.body, &self.tissue, impressions);
        Some(SurfaceMoment { stamp_ns, vertices: field.vertices(), displacements: field.displacements() })
    }

    /// Takes over other settings of the same body. What is in contact stays so.
    pub fn retune(&mut self, tissue: Tissue, close_below_rad: f64) {
        self.tissue = tissue;
        self.close_below_rad = close_below_rad;
    }

    /// Computes the surface at another rate from now on; none drops its memory.
    pub fn set_surface(&mut self, surface: Option<(StampRate, SurfaceField)>) {
        self.surface = surface;
    }

    /// What is touched.
    #[must_use]
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// What it is made of.
    #[must_use]
    pub fn tissue(&self) -> &Tissue {
        &self.tissue
    }

    /// What is known of frames.
    #[must_use]
    pub fn frames(&self) -> &FrameTree {
        &self.frames
    }

    /// The body's frame, as tf names it.
    #[must_use]
    pub fn body_frame(&self) -> &str {
        &self.body_frame
    }
}

impl SurfaceMoment<'_> {
    /// x, y and z of each displacement as messages carry them: a tenth of a micrometre on a metre, and half the bytes.
    pub fn displacements_f32(&self) -> impl Iterator<Item = f32> {
        self.displacements.iter().flat_map(|displacement| displacement.as_vec3().to_array())
    }
}

impl Place {
    fn find(&mut self, tree: &FrameTree, body_frame: &str, frame_id: &str) -> Option<Pose> {
        if self.version != Some(tree.version()) || self.frame_id != frame_id {
            self.version = Some(tree.version());
            frame_id.clone_into(&mut self.frame_id);
            self.body_from_frame = tree.lookup(body_frame, frame_of_message(frame_id));
        }
        self.body_from_frame
    }
}
