//! The typed groups of a scene, one for each group of parameters.

use std::path::{Path, PathBuf};

use rhombus_chain::{Pose, Spread};

use crate::BodyKind;

/// `body.*`.
#[derive(Clone, Debug, PartialEq)]
pub struct BodySettings {
    /// Where the rest surface comes from.
    pub mesh: MeshSource,
    /// Factor that makes mesh coordinates metres.
    pub scale: f64,
    /// Factors on the contact law; none where it is the same everywhere. The path is resolved.
    pub stiffness_map: Option<PathBuf>,
    /// The file of the calibrated body; none where chains are the same in all directions. The path is resolved.
    pub response: Option<PathBuf>,
    /// Frame of the rest surface.
    pub frame_id: String,
    /// Pose of the body in the scene.
    pub scene_from_body: Pose,
}

impl BodySettings {
    /// The file that has a factor on the contact law for each vertex: a map or a calibrated body.
    #[must_use]
    pub fn stiffness_file(&self) -> Option<&Path> {
        self.stiffness_map.as_deref().or(self.response.as_deref())
    }
}

/// Where a rest surface comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshSource {
    /// Generated, with its default number of vertices.
    BuiltIn(BodyKind),
    /// An OBJ file; the path is resolved.
    File(PathBuf),
}

/// `surface.*`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceSettings {
    /// Boundary criterion, share of the rest angle.
    pub cutoff: f64,
    /// Share of the displaced volume that bulges outward; 0 computes none.
    pub expansion: f64,
    /// Meaning of distance from the contact.
    pub spread: Spread,
    /// Published displacements, Hz of stamps; 0 computes none.
    pub rate_hz: f64,
}

/// `probe.*`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProbeSettings {
    /// Radius of the sphere, m.
    pub radius_m: f64,
    /// Radius that moves with the contact by the full depth, m.
    pub contact_radius_m: f64,
}

/// `grasp.*`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GraspSettings {
    /// Lateral stiffness as a share of the law's stiffness at rest.
    pub lateral: f64,
    /// The gripper holds below this angle, rad.
    pub close_below_rad: f64,
}

/// What the nodes of a session share.
#[derive(Clone, Debug, PartialEq)]
pub struct SessionSettings {
    /// Frame in which body and devices stand.
    pub scene_frame_id: String,
    /// Sub-namespaces of the devices' topics; the empty text is the node's own namespace.
    pub devices: Vec<String>,
    /// The clutch button; none when empty.
    pub clutch_button: Option<String>,
    /// Time comes from `/clock`.
    pub use_sim_time: bool,
}

/// `device.*`.
#[derive(Clone, Debug, PartialEq)]
pub struct DeviceSettings {
    /// Name of the backend.
    pub backend: String,
    /// Frame of the device's poses.
    pub frame_id: String,
    /// Pose of the device's base in the scene.
    pub scene_from_device: Pose,
    /// Motion in the scene for each metre of motion of the device.
    pub motion_scale: f64,
    /// Which of several connected devices; empty: the only one.
    pub serial: String,
    /// Rate of the motor loop, Hz.
    pub rate_hz: f64,
    /// Rate of the published poses, Hz.
    pub pose_rate_hz: f64,
    /// CPU that the motor loop stays on; none: any.
    pub cpu: Option<usize>,
    /// Motors on at the start.
    pub enable_at_start: bool,
    /// The device carries its own weight, where it can.
    pub gravity_compensation: bool,
    /// `body/` wrenches have the axes of the device frame.
    pub body_cf_absolute: bool,
    /// Largest torque on the hand, N m.
    pub max_torque_n_m: f64,
    /// Largest force of the gripper on the fingers, N.
    pub max_gripper_force_n: f64,
    /// Largest force on the hand, N.
    pub max_force_n: f64,
    /// What the motors follow: `contact_law` or `servo_cf`.
    pub force_source: String,
    /// Subscriptions of the poses to wait for before the motors start.
    pub wait_for_readers: usize,
}

impl DeviceSettings {
    /// Whether the hand on it is simulated, whoever leads it.
    pub fn is_virtual(&self) -> bool {
        matches!(self.backend.as_str(), "simulated" | "pointer")
    }
}

/// `simulated.*`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimulatedSettings {
    /// Mass of the hand and the moving parts of the device, kg.
    pub mass_kg: f64,
    /// Stiffness with which the hand follows its path, N/m.
    pub stiffness_n_per_m: f64,
    /// Damping to its path, N s/m.
    pub damping_n_s_per_m: f64,
    /// Intended press, m.
    pub depth_m: f64,
    /// Intended pull of the grasped surface, m.
    pub pull_m: f64,
    /// Intended slide along the surface, m.
    pub slide_m: f64,
    /// Time for a pair of sites, s.
    pub period_s: f64,
    /// Standard deviation of the noise on measured positions, m.
    pub noise_m: f64,
    /// Step of measured positions, m.
    pub quantisation_m: f64,
    /// Share of readings that repeat the one before.
    pub dropout: f64,
    /// Age of readings, s.
    pub latency_s: f64,
}

/// `visualization.*`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VisualizationSettings {
    /// Published markers, Hz; 0 publishes none.
    pub rate_hz: f64,
    /// Displacement of the last colour, m.
    pub full_scale_m: f64,
    /// Displacements are drawn this many times as large.
    pub displacement_scale: f64,
    /// Length of the force arrow, m for each N.
    pub force_scale_m_per_n: f64,
    /// Draw the chains at each contact.
    pub show_chains: bool,
}

/// `viewer.*`.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewerSettings {
    /// Serve the page.
    pub enabled: bool,
    /// Address or host name to listen at.
    pub address: String,
    /// TCP port; 0 takes any that is free.
    pub port: u16,
    /// Updates to each page, Hz.
    pub rate_hz: f64,
    /// Pages at once.
    pub max_pages: usize,
}

/// `recording.*`.
#[derive(Clone, Debug, PartialEq)]
pub struct RecordingSettings {
    /// Folder of the recordings.
    pub directory: PathBuf,
    /// Topics to record; empty means every topic of the session.
    pub topics: Vec<String>,
}

/// `replay.*`.
#[derive(Clone, Debug, PartialEq)]
pub struct ReplaySettings {
    /// Recording to play.
    pub path: Option<PathBuf>,
    /// Speed, 1 as recorded.
    pub rate: f64,
    /// The next pose waits for the force of the last one.
    pub lockstep: bool,
}
