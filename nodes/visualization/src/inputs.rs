//! The topics that are read: the newest message of each, looked at only when somebody wants the picture.

use std::time::{Duration, Instant};

use glam::DVec3;
use node_kit::{Inbox, Log, NodeKit, StartError, Throttle, convert, topics};
use r2r::geometry_msgs::msg::{PoseStamped, WrenchStamped};
use r2r::rhombus_haptics_msgs::msg::{ContactState, SurfaceDisplacement};
use r2r::shape_msgs::msg::Mesh;
use rhombus_chain::frame_of_message;

use crate::device_view::{DeviceView, InFrame, NotDrawable};
use crate::messages;
use crate::surface::{BodySurface, DisplacementError};

/// At most one line about messages that are not drawn in this time.
const WARN_PERIOD: Duration = Duration::from_secs(10);

/// Messages that were not drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct NotDrawn {
    /// Something in it is NaN, infinite, senseless or in no frame.
    pub(crate) not_drawable: u64,
    /// A displacement of another mesh than the one that is here.
    pub(crate) other_mesh: u64,
}

impl NotDrawn {
    pub(crate) fn total(self) -> u64 {
        self.not_drawable + self.other_mesh
    }
}

/// Everything the node hears, and what it made of it.
pub(crate) struct Inputs {
    mesh: Newest<Mesh>,
    displacement: Newest<SurfaceDisplacement>,
    devices: Vec<DeviceInputs>,
    surface: Option<Surface>,
    views: Vec<DeviceView>,
    not_drawn: NotDrawn,
    log: Log,
    warnings: Throttle,
}

struct Surface {
    surface: BodySurface,
    topology_version: u32,
    revision: u64,
    /// Stamp of the newest displacement, ns.
    stamp_ns: i64,
}

struct DeviceInputs {
    contact: Newest<ContactState>,
    command: Newest<WrenchStamped>,
    /// Heard from the first page on.
    #[cfg(feature = "viewer")]
    applied: Option<Newest<WrenchStamped>>,
    pose: Newest<PoseStamped>,
    /// Stamp of the newest pose, ns.
    stamp_ns: i64,
}

impl Inputs {
    /// Subscribe, for each entry of `devices` to the topics of that device.
    pub(crate) fn new(kit: &mut NodeKit, devices: &[String]) -> Result<Inputs, StartError> {
        let device_inputs: Result<Vec<DeviceInputs>, StartError> = devices
            .iter()
            .map(|device| {
                Ok(DeviceInputs {
                    contact: Newest::new(kit.subscribe_passing(&topics::CONTACT_STATE, device)?),
                    command: Newest::new(kit.subscribe_passing(&topics::SERVO_CF, device)?),
                    #[cfg(feature = "viewer")]
                    applied: None,
                    pose: Newest::new(kit.subscribe_passing(&topics::MEASURED_CP, device)?),
                    stamp_ns: 0,
                })
            })
            .collect();
        Ok(Inputs {
            mesh: Newest::new(kit.subscribe_newest(&topics::BODY_MESH, "")?),
            displacement: Newest::new(kit.subscribe_newest(&topics::SURFACE_DISPLACEMENT, "")?),
            devices: device_inputs?,
            surface: None,
            views: devices.iter().map(|_| DeviceView::default()).collect(),
            not_drawn: NotDrawn::default(),
            log: kit.log().clone(),
            warnings: Throttle::new(WARN_PERIOD),
        })
    }

    /// Hear from now on what the motors of `devices` apply, which only pages show.
    #[cfg(feature = "viewer")]
    pub(crate) fn hear_applied_forces(
        &mut self,
        kit: &mut NodeKit,
        devices: &[String],
    ) -> Result<(), StartError> {
        for (inputs, device) in self.devices.iter_mut().zip(devices) {
            if inputs.applied.is_none() {
                inputs.applied = Some(Newest::new(kit.subscribe_passing(&topics::MEASURED_CF, device)?));
            }
        }
        Ok(())
    }

    /// Keep the newest of what has arrived and nothing else. After every spin.
    pub(crate) fn receive(&mut self, now: Instant) {
        self.mesh.receive(now);
        self.displacement.receive(now);
        for device in &mut self.devices {
            device.contact.receive(now);
            device.command.receive(now);
            #[cfg(feature = "viewer")]
            if let Some(applied) = &mut device.applied {
                applied.receive(now);
            }
            device.pose.receive(now);
        }
    }

    /// Whether something about the surface waits to be looked at.
    #[cfg(feature = "viewer")]
    pub(crate) fn has_new_surface(&self) -> bool {
        self.mesh.held.is_some() || self.displacement.held.is_some()
    }

    /// Look at what arrived from the model about the surface.
    pub(crate) fn look_at_surface(&mut self) {
        if let Some((_, mesh)) = self.mesh.take() {
            self.take_mesh(&mesh);
        }
        // A displacement that comes before its mesh waits for it.
        if let Some(surface) = &mut self.surface
            && let Some((_, SurfaceDisplacement { header, topology_version, vertex, displacement })) =
                self.displacement.take()
        {
            match surface.surface.displace(topology_version, vertex, displacement) {
                Ok(changed) => {
                    surface.revision += u64::from(changed);
                    surface.stamp_ns = convert::stamp_ns(&header.stamp);
                }
                Err(error) => {
                    match error {
                        DisplacementError::OtherMesh { .. } => self.not_drawn.other_mesh += 1,
                        _ => self.not_drawn.not_drawable += 1,
                    }
                    self.warnings.warn(&self.log, || format!("surface_displacement is not drawn: {error}"));
                }
            }
        }
    }

    fn take_mesh(&mut self, mesh: &Mesh) {
        let topology_version = convert::topology_version(mesh);
        if self.surface.as_ref().is_some_and(|surface| surface.topology_version == topology_version) {
            return;
        }
        match messages::surface(mesh, topology_version) {
            Ok(surface) => {
                let revision = self.surface.as_ref().map_or(0, |before| before.revision + 1);
                self.surface = Some(Surface { surface, topology_version, revision, stamp_ns: 0 });
            }
            Err(error) => {
                self.not_drawn.not_drawable += 1;
                self.warnings.warn(&self.log, || format!("body_mesh is not drawn: {error}"));
            }
        }
    }

    /// Look at what arrived about the devices.
    pub(crate) fn look_at_devices(&mut self) {
        for (inputs, view) in self.devices.iter_mut().zip(&mut self.views) {
            for (topic, seen) in inputs.look(view) {
                if seen == Err(NotDrawable) {
                    self.not_drawn.not_drawable += 1;
                    self.warnings.warn(&self.log, || {
                        format!("{topic} is not drawn: accepted are finite numbers, unit directions and a frame_id")
                    });
                }
            }
        }
    }

    /// The surface and a number that grows when it changes.
    pub(crate) fn surface(&self) -> Option<(&BodySurface, u64)> {
        self.surface.as_ref().map(|surface| (&surface.surface, surface.revision))
    }

    /// Stamp of the newest displacement that is drawn, ns.
    #[cfg(feature = "viewer")]
    pub(crate) fn surface_stamp_ns(&self) -> i64 {
        self.surface.as_ref().map_or(0, |surface| surface.stamp_ns)
    }

    /// One for each device.
    pub(crate) fn views(&self) -> &[DeviceView] {
        &self.views
    }

    /// Stamps of the newest poses, one for each device, ns.
    pub(crate) fn stamps_ns(&self) -> impl Iterator<Item = i64> {
        self.devices.iter().map(|device| device.stamp_ns)
    }

    pub(crate) fn not_drawn(&self) -> NotDrawn {
        self.not_drawn
    }
}

impl DeviceInputs {
    fn look(&mut self, view: &mut DeviceView) -> Vec<(&'static str, Result<(), NotDrawable>)> {
        let mut seen = Vec::new();
        if let Some((when, state)) = self.contact.take() {
            seen.push(("contact_state", view.hear_contact(when, messages::contact(&state))));
        }
        if let Some((when, wrench)) = self.command.take() {
            seen.push(("servo_cf", view.hear_command(when, force(&wrench))));
        }
        #[cfg(feature = "viewer")]
        if let Some((when, wrench)) = self.applied.as_mut().and_then(Newest::take) {
            seen.push(("measured_cf", view.hear_applied(when, force(&wrench))));
        }
        if let Some((when, pose)) = self.pose.take() {
            self.stamp_ns = convert::stamp_ns(&pose.header.stamp);
            let frame_id = frame_of_message(&pose.header.frame_id).to_owned();
            seen.push(("measured_cp", view.hear_pose(when, frame_id, convert::pose_array(&pose.pose))));
        }
        seen
    }
}

fn force(wrench: &WrenchStamped) -> InFrame<DVec3> {
    let frame_id = frame_of_message(&wrench.header.frame_id).to_owned();
    InFrame { frame_id, value: convert::dvec3_of_vector(&wrench.wrench.force) }
}

/// The newest message of a topic and when it came, until somebody looks at it.
struct Newest<M> {
    inbox: Inbox<M>,
    held: Option<(Instant, M)>,
}

impl<M: 'static> Newest<M> {
    fn new(inbox: Inbox<M>) -> Newest<M> {
        Newest { inbox, held: None }
    }

    fn receive(&mut self, now: Instant) {
        if let Some(message) = self.inbox.newest() {
            self.held = Some((now, message));
        }
    }

    fn take(&mut self) -> Option<(Instant, M)> {
        self.held.take()
    }
}
