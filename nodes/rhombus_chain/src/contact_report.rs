//! What is told about a contact: the values of `contact_state`, in the frame of the pose.

use glam::DVec3;

use crate::device_session::Answer;
use crate::local_law::Mode;

/// One contact of one device with the body. Positions and directions are in the frame of the pose. By default nothing is
/// touched and nothing is known of the probe, as after a pose that was rejected.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactReport {
    /// None, contact or grasp.
    pub mode: Mode,
    /// A chain is past its guard.
    pub saturated: bool,
    /// The clutch is held.
    pub clutched: bool,
    /// Triangle with the proxy; 0 without contact.
    pub face: u32,
    /// Weights of its corners at the proxy; zero without contact.
    pub barycentric: DVec3,
    /// Centre of the probe, m.
    pub probe: DVec3,
    /// The contact point on the rest surface, m; zero without contact.
    pub proxy: DVec3,
    /// Out of the body, unit length; zero without contact.
    pub normal: DVec3,
    /// m, positive into the body.
    pub depth_m: f64,
    /// On the hand along the normal, N, positive pushes out.
    pub force_n: f64,
    /// Change of the force for each metre of depth, N/m.
    pub stiffness_n_per_m: f64,
}

impl From<&Answer> for ContactReport {
    fn from(answer: &Answer) -> Self {
        let (step, frame) = (&answer.step, &answer.frame_from_body);
        let touched = step.surface_point.filter(|_| step.mode != Mode::None);
        Self {
            mode: step.mode,
            saturated: step.saturated,
            clutched: answer.clutched,
            face: touched.map_or(0, |at| at.face),
            barycentric: touched.map_or(DVec3::ZERO, |at| at.barycentric),
            probe: frame.transform_point(answer.probe_in_body),
            proxy: touched.map_or(DVec3::ZERO, |_| frame.transform_point(step.proxy)),
            normal: frame.rotate(step.normal),
            depth_m: step.depth_m,
            force_n: step.normal_force_n,
            stiffness_n_per_m: step.stiffness_n_per_m,
        }
    }
}
