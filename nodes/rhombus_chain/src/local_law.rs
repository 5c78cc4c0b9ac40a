//! What a motor loop needs to answer a position with a force by itself, between two poses of the model.

use glam::DVec3;

use crate::contact_law::ContactLaw;

/// What the probe does to the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// Nothing.
    #[default]
    None,
    /// It presses.
    Contact,
    /// It holds a point of the surface: it may press and pull.
    Grasp,
}

/// The contact as the last pose left it: a plane and a law along its normal. Body frame.
///
/// At the pose it was made from it gives the force of that [`Step`](crate::Step) to rounding, except for what
/// remains of a grasp in the 50 ms after its release.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LocalLaw {
    /// What the probe does.
    pub mode: Mode,
    /// Contact: a point of the surface's tangent plane, under the probe. Grasp: the probe position at the
    /// grasp. In metres.
    pub anchor: DVec3,
    /// Unit vector out of the body; zero in mode none.
    pub normal: DVec3,
    /// Radius of the spherical probe in metres. Not used in a grasp.
    pub probe_radius_m: f64,
    /// Added to the depth, in metres: what remains of the depth at which a grasp began. 0 in contact.
    pub depth_offset_m: f64,
    /// The law's force is multiplied by this.
    pub stiffness_factor: f64,
    /// Grasp: force towards the anchor for each metre across the normal, in N/m.
    pub lateral_stiffness_n_per_m: f64,
}

impl LocalLaw {
    /// Depth of a probe at `probe` in metres, positive into the body, negative where the body is pulled or
    /// not touched.
    #[must_use]
    #[inline]
    pub fn depth_m(&self, probe: DVec3) -> f64 {
        let height_m = (probe - self.anchor).dot(self.normal);
        match self.mode {
            Mode::None => 0.0,
            Mode::Contact => self.probe_radius_m + self.depth_offset_m - height_m,
            Mode::Grasp => self.depth_offset_m - height_m,
        }
    }

    /// Force on the hand in newton for a probe at `probe`, both in the body frame. Real-time safe.
    ///
    /// Zero for a position that is not finite.
    #[must_use]
    #[inline]
    pub fn force_n(&self, law: &ContactLaw, probe: DVec3) -> DVec3 {
        let depth_m = self.depth_m(probe);
        if self.mode == Mode::None || (self.mode == Mode::Contact && depth_m <= 0.0) {
            return DVec3::ZERO;
        }
        let Ok(response) = law.at_depth(depth_m) else {
            return DVec3::ZERO;
        };
        let along = self.normal * (self.stiffness_factor * response.force_n);
        match self.mode {
            Mode::Grasp => along - self.across(probe) * self.lateral_stiffness_n_per_m,
            Mode::Contact | Mode::None => along,
        }
    }

    /// Displacement of the probe across the normal since the grasp, in metres; zero in the other modes.
    #[must_use]
    #[inline]
    pub fn across(&self, probe: DVec3) -> DVec3 {
        let offset = probe - self.anchor;
        if self.mode == Mode::Grasp { offset - self.normal * offset.dot(self.normal) } else { DVec3::ZERO }
    }
}
