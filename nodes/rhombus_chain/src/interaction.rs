//! One device on one body: from probe positions and stamps to forces. The model's only state.

use glam::DVec3;
use thiserror::Error;

use crate::body::Body;
use crate::grasp::{Fade, Grasp};
use crate::local_law::{LocalLaw, Mode};
use crate::mesh::{COORDINATE_LIMIT_M, SurfacePoint, is_usable};
use crate::proxy::{self, Proxy};
use crate::tissue::Tissue;

/// One device on one body.
///
/// The state is plain data: clone it, compare it, keep it. What a step returns depends on this state and on
/// the step's arguments alone, so equal states and equal inputs give equal bits. It belongs to one body:
/// before it is used with another, [`reset`](Self::reset) it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Interaction {
    /// Stamp of the last pose.
    stamp_ns: Option<i64>,
    /// Whether the gripper was closed at the last pose.
    closed: bool,
    /// Contact memory: where the probe touched at the last pose.
    contact: Option<SurfacePoint>,
    /// What the gripper holds.
    grasp: Option<Grasp>,
    /// What remains of a grasp after its release.
    fade: Option<Fade>,
    /// How the surface is moved by the contact or grasp, as of the last pose.
    impression: Option<Impression>,
}

/// Answer to one probe pose. Body frame. The default is no contact and no force.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Step {
    /// What the probe does.
    pub mode: Mode,
    /// Force on the hand in newton.
    pub force_n: DVec3,
    /// The part of it along `normal` that comes from the contact law; positive pushes out.
    pub normal_force_n: f64,
    /// Depth in metres, positive into the body; negative when a held body is pulled; 0 in mode none.
    pub depth_m: f64,
    /// Tangent stiffness along the normal in N/m; 0 in mode none.
    pub stiffness_n_per_m: f64,
    /// Whether any chain is past its guard.
    pub saturated: bool,
    /// Where on the rest surface the contact or grasp is.
    pub surface_point: Option<SurfacePoint>,
    /// Position of that point; the probe itself in mode none.
    pub proxy: DVec3,
    /// Unit outward normal there; zero in mode none.
    pub normal: DVec3,
    /// What the motor loop may use until the next pose.
    pub local_law: LocalLaw,
}

/// How one contact or grasp moves the surface. Body frame, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impression {
    /// The point of the rest surface that moves by the whole depth.
    pub at: SurfacePoint,
    /// Its rest position.
    pub position: DVec3,
    /// Unit outward normal there.
    pub normal: DVec3,
    /// How far it is pushed in; negative: pulled out.
    pub depth_m: f64,
    /// How far a grasp has carried it across the normal.
    pub lateral_m: DVec3,
}

/// Why a pose is not answered. The state has not changed.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum StepError {
    /// A coordinate is NaN, infinite, or far beyond any device's workspace.
    #[error("probe position {0}; accepted: finite coordinates of at most {COORDINATE_LIMIT_M:e} m in size")]
    Position(DVec3),
    /// Time runs backwards.
    #[error("stamp {stamp_ns} ns comes after {previous_ns} ns; accepted: the same stamp or a later one")]
    StampWentBack {
        /// Stamp of the pose before.
        previous_ns: i64,
        /// Stamp of this pose.
        stamp_ns: i64,
    },
}

impl Interaction {
    /// No contact, no grasp, no stamp yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Forgets everything, the last stamp too.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// Answers one pose of the probe's centre, in metres in the body frame. Real-time safe.
    ///
    /// `grasp` says whether the gripper is closed. What it closes on it holds: a grasp begins at the first
    /// pose with a closed gripper after an open one, if that pose is in contact. A gripper that closes on air
    /// holds nothing until it opens and closes again. A new interaction counts as open.
    ///
    /// # Errors
    /// A position that is not usable, a stamp before the last one. Nothing has changed then; a caller that
    /// lets the force go to zero calls [`reset`](Self::reset).
    pub fn step(
        &mut self,
        body: &Body,
        tissue: &Tissue,
        stamp_ns: i64,
        probe_in_body: DVec3,
        grasp: bool,
    ) -> Result<Step, StepError> {
        self.check(stamp_ns, probe_in_body)?;
        let closes = grasp && !self.closed;
        if let Some(held) = self.grasp.take_if(|_| !grasp) {
            self.release(tissue, &held, stamp_ns, probe_in_body);
        }
        self.stamp_ns = Some(stamp_ns);
        self.closed = grasp;
        self.fade = self.fade.filter(|fade| fade.successor_share(stamp_ns) < 1.0);

        let touch = if self.grasp.is_some() { None } else { self.touch(body, tissue, probe_in_body) };
        if let (true, Some((proxy, depth_m))) = (closes, &touch) {
            self.grasp = Some(Grasp::new(body, proxy, *depth_m, stamp_ns, probe_in_body));
        }
        let (impression, local_law) = match (&self.grasp, &touch) {
            (Some(held), _) => {
                let law = held.local_law(tissue, stamp_ns);
                (Some(held.impression(&law, probe_in_body)), law)
            }
            (None, Some((proxy, depth_m))) => {
                (Some(press(body, proxy, *depth_m)), contact_law(body, tissue, proxy, probe_in_body))
            }
            (None, None) => (None, LocalLaw::default()),
        };
        self.contact = impression.map(|impression| impression.at);
        Ok(self.answer(tissue, stamp_ns, probe_in_body, impression, local_law))
    }

    /// What moves the surface: the contact or grasp, and what remains of a grasp after its release.
    pub fn impressions(&self) -> impl Iterator<Item = Impression> {
        let stamp_ns = self.stamp_ns.unwrap_or_default();
        self.impression.into_iter().chain(self.fade.map(|fade| fade.impression(stamp_ns)))
    }

    fn check(&self, stamp_ns: i64, probe: DVec3) -> Result<(), StepError> {
        if !is_usable(probe) {
            return Err(StepError::Position(probe));
        }
        match self.stamp_ns {
            Some(previous_ns) if stamp_ns < previous_ns => {
                Err(StepError::StampWentBack { previous_ns, stamp_ns })
            }
            _ => Ok(()),
        }
    }

    /// The contact of a probe that holds nothing, and its depth: followed from the last contact, from the
    /// held point after a release, or a new one at the closest point.
    fn touch(&self, body: &Body, tissue: &Tissue, probe: DVec3) -> Option<(Proxy, f64)> {
        let radius_m = tissue.probe_radius_m();
        let follow = |from| {
            let proxy = proxy::follow(body.mesh(), from, probe)?;
            let depth_m = radius_m - proxy.distance_m;
            (depth_m > 0.0).then_some((proxy, depth_m))
        };
        self.contact.and_then(follow).or_else(|| new_contact(body, radius_m, probe).and_then(follow))
    }

    /// Turns a grasp into a fading one, with all the force the hand would have felt had it held on.
    fn release(&mut self, tissue: &Tissue, held: &Grasp, stamp_ns: i64, probe: DVec3) {
        let law = held.local_law(tissue, stamp_ns);
        let share = self.share(stamp_ns);
        let rest_n = self.fade.map_or(DVec3::ZERO, |fade| fade.force_n(stamp_ns));
        let force_n = rest_n + law.force_n(tissue.law(), probe) * share;
        let impression = held.impression(&law, probe).scaled(share);
        self.fade = Some(Fade::new(force_n, impression, stamp_ns));
    }

    /// Share of the force that belongs to the present contact or grasp.
    fn share(&self, stamp_ns: i64) -> f64 {
        self.fade.map_or(1.0, |fade| fade.successor_share(stamp_ns))
    }

    fn answer(
        &mut self,
        tissue: &Tissue,
        stamp_ns: i64,
        probe: DVec3,
        impression: Option<Impression>,
        local_law: LocalLaw,
    ) -> Step {
        let share = self.share(stamp_ns);
        let fading_n = self.fade.map_or(DVec3::ZERO, |fade| fade.force_n(stamp_ns));
        self.impression = impression.map(|impression| impression.scaled(share));
        let Some(impression) = impression else {
            return Step { force_n: fading_n, proxy: probe, ..Step::default() };
        };
        // The depth is finite because the position is, and then the law answers.
        let Ok(response) = tissue.law().at_depth(impression.depth_m) else {
            return Step { force_n: fading_n, proxy: probe, ..Step::default() };
        };
        let local_law = local_law.scaled(share);
        let factor = local_law.factor(probe);
        Step {
            mode: local_law.mode,
            force_n: fading_n + local_law.force_of(&response, probe),
            normal_force_n: response.force_n * factor,
            depth_m: impression.depth_m,
            stiffness_n_per_m: response.stiffness_n_per_m * factor,
            saturated: response.saturated,
            surface_point: Some(impression.at),
            proxy: impression.position,
            normal: impression.normal,
            local_law,
        }
    }
}

/// Where a probe that touched nothing begins to touch: the closest point of the surface, within the probe's
/// radius, or at whatever distance when the probe's centre is already inside.
fn new_contact(body: &Body, radius_m: f64, probe: DVec3) -> Option<SurfacePoint> {
    let (mesh, index) = (body.mesh(), body.index());
    if index.is_farther_than(probe, radius_m) {
        return None;
    }
    let near = index.closest(mesh, probe, radius_m);
    let near =
        near.or_else(|| index.encloses(mesh, probe).then(|| index.closest(mesh, probe, f64::INFINITY))?);
    near.map(|(at, _)| at)
}

fn press(body: &Body, proxy: &Proxy, depth_m: f64) -> Impression {
    let position = body.mesh().position(proxy.at);
    Impression { at: proxy.at, position, normal: proxy.normal, depth_m, lateral_m: DVec3::ZERO }
}

/// The tangent plane under the probe. Its anchor is taken below the probe, so that the plane is at the
/// proxy's distance also where the proxy is not straight below.
fn contact_law(body: &Body, tissue: &Tissue, proxy: &Proxy, probe: DVec3) -> LocalLaw {
    let (stiffness_factor, stiffness_gradient_per_m) = body.stiffness_under(proxy);
    LocalLaw {
        mode: Mode::Contact,
        anchor: probe - proxy.normal * proxy.distance_m,
        normal: proxy.normal,
        probe_radius_m: tissue.probe_radius_m(),
        stiffness_factor,
        stiffness_gradient_per_m,
        ..LocalLaw::default()
    }
}

impl Impression {
    /// The same place, moved by a share of the displacement.
    pub(crate) fn scaled(&self, share: f64) -> Self {
        Self { depth_m: self.depth_m * share, lateral_m: self.lateral_m * share, ..*self }
    }
}
