//! From what is heard to what pages show: mesh, surface and devices, in the body's frame, encoded once for all pages.

use std::time::{Duration, Instant};

use glam::DVec3;
use node_kit::{Log, NodeKit, StartError, Throttle, TransformListener, convert};
use rhombus_chain::{FrameTree, Pose};
use scene::{BodySettings, Scene, read_stiffness_factors};

use super::health::Driver;
use super::link::{Numbered, Shown};
use super::protocol::{self, ContactState, DeviceState, Force};
use crate::device_view::{DeviceView, InFrame};
use crate::inputs::Inputs;

/// Without news the state is repeated this often.
const REPEAT_AFTER: Duration = Duration::from_millis(240);
/// Stamps that are farther from the node's clock than this are of another clock.
const SAME_CLOCK_S: f64 = 10.0;
/// At most one warning about the stiffness map in this time.
const WARN_PERIOD: Duration = Duration::from_secs(10);

/// Makes the binary messages.
pub(crate) struct Feed {
    frames: FrameTree,
    transforms: TransformListener,
    body_frame: String,
    body: BodySettings,
    mesh: Sequence,
    surface: Sequence,
    state: Sequence,
    topology_version: Option<u32>,
    surface_revision: Option<u64>,
    told: Option<(Instant, Vec<DeviceState>)>,
    log: Log,
    warnings: Throttle,
}

/// Numbers the messages of one kind.
#[derive(Debug, Default)]
struct Sequence(u32);

impl Sequence {
    fn next(&mut self, encode: impl FnOnce(u32) -> Vec<u8>) -> Option<Numbered> {
        self.0 = self.0.wrapping_add(1);
        Some(Numbered { sequence: self.0, bytes: encode(self.0).into() })
    }
}

impl Feed {
    /// Subscribe to the transforms of the graph; the parameters' are known.
    pub(crate) fn new(kit: &mut NodeKit, scene: &Scene) -> Result<Feed, StartError> {
        Ok(Feed {
            frames: scene.frames(kit.namespace()),
            transforms: TransformListener::new(kit)?,
            body_frame: kit.frame_id(&scene.body.frame_id),
            body: scene.body.clone(),
            mesh: Sequence::default(),
            surface: Sequence::default(),
            state: Sequence::default(),
            topology_version: None,
            surface_revision: None,
            told: None,
            log: kit.log().clone(),
            warnings: Throttle::new(WARN_PERIOD),
        })
    }

    /// Take over what arrived of transforms. True when more may wait.
    pub(crate) fn hear(&mut self) -> bool {
        let frames = &mut self.frames;
        self.transforms.update(|parent, child, transform| frames.hear(parent, child, transform)) > 0
    }

    /// Forget what pages have; the next one gets everything.
    pub(crate) fn forget(&mut self) {
        (self.topology_version, self.surface_revision, self.told) = (None, None, None);
    }

    /// Whether markers have looked at a surface that pages were not shown.
    pub(crate) fn lacks_surface_of(&self, inputs: &Inputs) -> bool {
        inputs.surface().is_some_and(|(_, revision)| self.surface_revision != Some(revision))
    }

    /// A frame that a device speaks in and that nothing connects to the body.
    pub(crate) fn unplaced(&self, view: &DeviceView, now: Instant) -> Option<String> {
        let heard = [
            view.contact(now).map(|contact| &contact.frame_id),
            view.commanded_n(now).map(|force_n| &force_n.frame_id),
            view.applied_n(now).map(|force_n| &force_n.frame_id),
            view.pose(now).map(|pose| &pose.frame_id),
        ];
        let unplaced = |frame_id: &&String| self.body_from(frame_id).is_none();
        heard.into_iter().flatten().find(unplaced).cloned()
    }

    /// What has changed since the last turn. `ros_s` is the time that stamps have now; `drivers` has one for each device.
    pub(crate) fn update(&mut self, now: Instant, ros_s: f64, inputs: &Inputs, drivers: &[Driver]) -> Update {
        let mut update = Update::default();
        if let Some((surface, revision)) = inputs.surface() {
            let version = surface.topology_version();
            let is_new = self.topology_version != Some(version);
            if is_new {
                let factors = self.stiffness_factors(surface.rest_m().len());
                update.mesh =
                    self.mesh.next(|sequence| protocol::mesh(sequence, surface, factors.as_deref()));
                self.topology_version = Some(version);
            }
            if is_new || self.surface_revision != Some(revision) {
                let stamp_s = seconds(inputs.surface_stamp_ns());
                update.surface = self.surface.next(|sequence| protocol::surface(sequence, surface, stamp_s));
                self.surface_revision = Some(revision);
            }
        }
        let views = inputs.views().iter().zip(drivers);
        let devices: Vec<DeviceState> =
            views.map(|(view, driver)| self.device(view, now, ros_s, driver)).collect();
        let is_due = self
            .told
            .as_ref()
            .is_none_or(|(when, told)| *told != devices || now.duration_since(*when) >= REPEAT_AFTER);
        if is_due {
            update.state = self.state.next(|sequence| protocol::state(sequence, ros_s, &devices));
            self.told = Some((now, devices));
        }
        update
    }

    fn device(&self, view: &DeviceView, now: Instant, ros_s: f64, driver: &Driver) -> DeviceState {
        let contact = || {
            let contact = view.contact(now)?;
            let body_from_frame = self.body_from(&contact.frame_id)?;
            let heard = view.contact_heard()?;
            let stamp_s = seconds(contact.stamp_ns);
            let latency_s = ros_s - now.duration_since(heard).as_secs_f64() - stamp_s;
            Some(ContactState {
                mode: contact.mode,
                saturated: contact.saturated,
                clutched: contact.clutched,
                stamp_s,
                probe: body_from_frame * view.probe(now)?.value,
                proxy_m: body_from_frame.transform_point(contact.proxy_m),
                normal: body_from_frame.rotate(contact.normal),
                depth_m: contact.depth_m,
                force_n: contact.force_n,
                stiffness_n_per_m: contact.stiffness_n_per_m,
                latency_s: (latency_s.abs() < SAME_CLOCK_S).then_some(latency_s),
            })
        };
        let in_body =
            |force_n: &InFrame<DVec3>| Some(self.body_from(&force_n.frame_id)?.rotate(force_n.value));
        let commanded_n = view.commanded_n(now).and_then(in_body);
        // The command of a model is no force on a hand whose driver is silent.
        let force = match driver.publishes_force {
            true => view.applied_n(now).and_then(in_body).map(Force::Applied),
            false => commanded_n.map(Force::Commanded),
        };
        let handle = || {
            let pose = view.pose(now)?;
            Some(self.body_from(&pose.frame_id)? * pose.value)
        };
        let pose_rate_hz = driver.pose_rate_hz;
        DeviceState { contact: contact(), force, commanded_n, handle: handle(), pose_rate_hz }
    }

    fn body_from(&self, frame_id: &str) -> Option<Pose> {
        self.frames.lookup(&self.body_frame, frame_id)
    }

    fn stiffness_factors(&mut self, vertices: usize) -> Option<Vec<f32>> {
        let problem = match read_stiffness_factors(&self.body) {
            Ok(factors) if factors.is_empty() => return None,
            Ok(factors)
                if factors.len() == vertices
                    && factors.iter().all(|factor| factor.is_finite() && *factor > 0.0) =>
            {
                // Colours need no more digits.
                return Some(factors.into_iter().map(|factor| factor as f32).collect());
            }
            Ok(factors) => format!("{} factors for the {vertices} vertices of body_mesh", factors.len()),
            Err(error) => error.to_string(),
        };
        self.warnings.warn(&self.log, || format!("pages show no stiffness map: {problem}"));
        None
    }
}

/// What has changed.
#[derive(Debug, Default)]
pub(crate) struct Update {
    mesh: Option<Numbered>,
    surface: Option<Numbered>,
    state: Option<Numbered>,
}

impl Update {
    pub(crate) fn is_empty(&self) -> bool {
        self.mesh.is_none() && self.surface.is_none() && self.state.is_none()
    }

    /// What has not changed stays.
    pub(crate) fn apply(self, shown: &mut Shown) {
        let newest = |new: Option<Numbered>, place: &mut Option<Numbered>| *place = new.or(place.take());
        newest(self.mesh, &mut shown.mesh);
        newest(self.surface, &mut shown.surface);
        newest(self.state, &mut shown.state);
    }
}

fn seconds(ns: i64) -> f64 {
    // To a fraction of a microsecond for centuries.
    ns as f64 * 1e-9
}

/// The node's clock, s.
pub(crate) fn ros_seconds(kit: &NodeKit) -> f64 {
    seconds(convert::stamp_ns(&kit.now()))
}
