//! What a motor loop needs to answer a position with a force by itself, between two poses of the model.

use glam::DVec3;

use crate::chain::finite;
use crate::contact_law::{ContactLaw, LawResponse};

/// How long after its pose a contact law may be used, ns. Longer than the gaps of a loaded machine, shorter than it takes a
/// hand to get to where the plane of the law has nothing to do with the surface.
pub const LAW_VALIDITY_NS: i64 = 50_000_000;

const LARGEST: DVec3 = DVec3::splat(f64::MAX);

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
    /// The law's force and energy are multiplied by this at the anchor ...
    pub stiffness_factor: f64,
    /// ... and by this much more for each metre of the probe from there, 1/m; never by less than 0. Perpendicular to the
    /// normal. Zero where the body has no regional stiffness.
    pub stiffness_gradient_per_m: DVec3,
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

    /// What the law's force and energy are multiplied by for a probe at `probe`.
    #[must_use]
    #[inline]
    pub fn factor(&self, probe: DVec3) -> f64 {
        (self.stiffness_factor + self.stiffness_gradient_per_m.dot(probe - self.anchor)).max(0.0)
    }

    /// Force on the hand in newton for a probe at `probe`, both in the body frame. Real-time safe.
    ///
    /// The gradient of an energy: `-grad(factor E) - k_lat r_t`. Zero for a position that is not finite.
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
        self.force_of(&response, probe)
    }

    /// The force for a probe at `probe`, where the law's answer is `response`. Finite for every finite position.
    #[inline]
    pub(crate) fn force_of(&self, response: &LawResponse, probe: DVec3) -> DVec3 {
        let factor = self.factor(probe);
        let along = self.normal * finite(factor * response.force_n);
        // A factor that is kept at 0 has no gradient.
        let gradient_per_m = if factor > 0.0 { self.stiffness_gradient_per_m } else { DVec3::ZERO };
        let across = self.across(probe) * self.lateral_stiffness_n_per_m + gradient_per_m * response.energy_j;
        (along - across.clamp(-LARGEST, LARGEST)).clamp(-LARGEST, LARGEST)
    }

    /// The same law with a share of its forces.
    pub(crate) fn scaled(&self, share: f64) -> Self {
        Self {
            stiffness_factor: self.stiffness_factor * share,
            stiffness_gradient_per_m: self.stiffness_gradient_per_m * share,
            lateral_stiffness_n_per_m: self.lateral_stiffness_n_per_m * share,
            ..*self
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
