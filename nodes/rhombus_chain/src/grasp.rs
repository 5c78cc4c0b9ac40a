//! Holding a point of the surface, and letting go of it.

use glam::DVec3;

use crate::body::Body;
use crate::interaction::Impression;
use crate::local_law::{LocalLaw, Mode};
use crate::mesh::SurfacePoint;
use crate::proxy::Proxy;
use crate::tissue::Tissue;

/// A grasp forgets the depth at which it began, and a released one its force, over this time of stamps.
pub(crate) const RAMP_NS: i64 = 50_000_000;

/// Share of [`RAMP_NS`] that has passed, 0 to 1.
pub(crate) fn ramp(since_ns: i64, stamp_ns: i64) -> f64 {
    // Both conversions are exact: at most 5e7.
    stamp_ns.saturating_sub(since_ns).clamp(0, RAMP_NS) as f64 / RAMP_NS as f64
}

/// A held point: the anchor is fixed in the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grasp {
    at: SurfacePoint,
    position: DVec3,
    normal: DVec3,
    /// The probe when the gripper closed.
    anchor: DVec3,
    depth_m: f64,
    /// Factor on the law at the held point.
    stiffness_factor: f64,
    /// Its gradient when the gripper closed, 1/m.
    stiffness_gradient_per_m: DVec3,
    since_ns: i64,
}

impl Grasp {
    pub(crate) fn new(body: &Body, proxy: &Proxy, depth_m: f64, stamp_ns: i64, probe: DVec3) -> Self {
        let position = body.mesh().position(proxy.at);
        let (stiffness_factor, stiffness_gradient_per_m) = body.stiffness_under(proxy);
        Self {
            at: proxy.at,
            position,
            normal: proxy.normal,
            anchor: probe,
            depth_m,
            stiffness_factor,
            stiffness_gradient_per_m,
            since_ns: stamp_ns,
        }
    }

    /// The law of this grasp at a stamp: with r the probe's way since the gripper closed, depth -r.n, plus
    /// what remains of the depth at which it closed; `-k_lat r_t` across. A held body is as stiff as at the held point; what
    /// pushed the probe to where the body is softer fades with the depth, so that closing the gripper changes no force.
    pub(crate) fn local_law(&self, tissue: &Tissue, stamp_ns: i64) -> LocalLaw {
        let left = 1.0 - ramp(self.since_ns, stamp_ns);
        LocalLaw {
            mode: Mode::Grasp,
            anchor: self.anchor,
            normal: self.normal,
            probe_radius_m: tissue.probe_radius_m(),
            depth_offset_m: self.depth_m * left,
            stiffness_factor: self.stiffness_factor,
            stiffness_gradient_per_m: self.stiffness_gradient_per_m * left,
            lateral_stiffness_n_per_m: tissue.lateral_stiffness_n_per_m() * self.stiffness_factor,
        }
    }

    /// How the held point moves the surface.
    pub(crate) fn impression(&self, law: &LocalLaw, probe: DVec3) -> Impression {
        Impression {
            at: self.at,
            position: self.position,
            normal: self.normal,
            depth_m: law.depth_m(probe),
            lateral_m: law.across(probe),
        }
    }
}

/// What remains of a grasp after its release.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fade {
    force_n: DVec3,
    impression: Impression,
    since_ns: i64,
}

impl Fade {
    /// From the force on the hand and the displacement at the release.
    pub(crate) fn new(force_n: DVec3, impression: Impression, since_ns: i64) -> Self {
        Self { force_n, impression, since_ns }
    }

    /// Share of the force that whatever came after the release has by now; the rest belongs to the fading
    /// grasp.
    pub(crate) fn successor_share(&self, stamp_ns: i64) -> f64 {
        ramp(self.since_ns, stamp_ns)
    }

    pub(crate) fn force_n(&self, stamp_ns: i64) -> DVec3 {
        self.force_n * (1.0 - ramp(self.since_ns, stamp_ns))
    }

    pub(crate) fn impression(&self, stamp_ns: i64) -> Impression {
        self.impression.scaled(1.0 - ramp(self.since_ns, stamp_ns))
    }
}
