//! The node: set up once, then spin, answer, repeat.

use std::time::Duration;

use anyhow::Result;
use node_kit::{Change, Level, NodeKit, Status, TransformListener, convert, topics};
use rhombus_chain::Session;
use scene::Scene;
use serde_json::json;

use crate::device::Device;
use crate::heard::Heard;
use crate::live::InContact;
use crate::model;
use crate::surface::Surface;

/// Longest wait for a pose; how late a signal to end is seen.
const WAIT: Duration = Duration::from_millis(50);

/// Everything the node has.
struct Deformation {
    session: Session,
    transforms: TransformListener,
    devices: Vec<Device>,
    surface: Surface,
    /// Only for a replay in lockstep.
    heard: Option<Heard>,
    in_contact: InContact,
    mesh_warnings: Vec<String>,
}

/// Run until the process is asked to end.
pub(crate) fn run(kit: &mut NodeKit) -> Result<()> {
    let mut deformation = Deformation::new(kit)?;
    kit.ready(&deformation.summary());
    while kit.is_running() {
        let changes = kit.spin_once(WAIT);
        deformation.turn(kit)?;
        if !changes.is_empty() {
            deformation.retune(kit, &changes)?;
        }
        if kit.diagnostics_due() {
            kit.publish_diagnostics(deformation.statuses())?;
        }
    }
    kit.closing_report(&deformation.report());
    Ok(())
}

impl Deformation {
    fn new(kit: &mut NodeKit) -> Result<Deformation> {
        let scene = Scene::from_parameters(kit.parameters().clone())?;
        let loaded = scene.load_session(kit.namespace()).map_err(|error| match error.key {
            Some(_) => anyhow::Error::new(error),
            None => anyhow::Error::new(error).context("body.mesh"),
        })?;
        let session = loaded.session;
        for (name, value) in model::computed(session.tissue().law()) {
            kit.show_computed(name, value)?;
        }
        let in_contact = InContact::default();
        kit.check_changes(in_contact.check());
        let mesh_warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
        mesh_warnings.iter().for_each(|warning| kit.log().warn(warning));

        let rest = session.body().mesh();
        kit.publish(&topics::BODY_MESH, "")?.publish(&convert::mesh(rest.vertices(), rest.triangles()))?;
        let mut surface = Surface::new(session.body_frame(), loaded.topology_version, scene.replay.lockstep);
        if scene.surface.rate_hz > 0.0 {
            surface.announce(kit)?;
        }
        let names = scene.session.devices.iter().enumerate();
        let devices: Result<Vec<Device>, _> =
            names.map(|(index, name)| Device::new(kit, index, name, session.tissue(), &scene)).collect();
        Ok(Deformation {
            transforms: TransformListener::new(kit)?,
            devices: devices?,
            heard: scene.replay.lockstep.then(|| Heard::new(kit)).transpose()?,
            session,
            surface,
            in_contact,
            mesh_warnings,
        })
    }

    /// Hear what has been said of frames and buttons, then answer the poses that have arrived.
    fn turn(&mut self, kit: &NodeKit) -> Result<()> {
        let session = &mut self.session;
        let transforms = self
            .transforms
            .update(|parent, child, transform| session.hear_transform(parent, child, transform));
        let buttons = self.devices.iter_mut().map(|device| device.hear_buttons(session)).sum();
        if let Some(heard) = &mut self.heard {
            heard.add(buttons, transforms)?;
        }
        for device in &mut self.devices {
            device.answer(session, &mut self.surface, kit.log())?;
        }
        self.in_contact.set(self.devices.iter().any(|device| device.counters().in_contact()));
        Ok(())
    }

    /// Take over parameters that were set while the node runs. They have been checked.
    fn retune(&mut self, kit: &mut NodeKit, changes: &[Change]) -> Result<()> {
        let scene = Scene::from_parameters(kit.parameters().clone())?;
        self.session.retune(scene.tissue()?, scene.grasp.close_below_rad);
        let tissue = self.session.tissue();
        self.devices.iter_mut().for_each(|device| device.retune(tissue, scene.device.motion_scale));
        if changes.iter().any(|change| change.name == "surface.rate") {
            let at_rate = scene.surface_field(self.session.body(), tissue);
            if at_rate.is_some() {
                self.surface.announce(kit)?;
            }
            self.session.set_surface(at_rate);
        }
        for Change { name, value } in changes {
            kit.log().info(&format!("{name} is now {value}"));
        }
        Ok(())
    }

    fn statuses(&mut self) -> Vec<Status> {
        let (level, summary) = match self.mesh_warnings.first() {
            None => (Level::Ok, "as it should be"),
            Some(warning) => (Level::Warn, warning.as_str()),
        };
        let contacts = self.devices.iter().filter(|device| device.counters().in_contact()).count();
        let body = Status::new(level, "body", summary)
            .with("active_contacts", contacts)
            .with("touched_vertices", self.surface.touched())
            .with("surfaces", self.surface.published())
            .with("ignored_transforms", self.session.frames().ignored());
        std::iter::once(body).chain(self.devices.iter_mut().map(Device::status)).collect()
    }

    /// Everything since the start: each device's, and what is asked of the session over all of them.
    fn report(&self) -> serde_json::Value {
        let devices: serde_json::Map<String, serde_json::Value> = self
            .devices
            .iter()
            .map(|device| (device.subject().to_owned(), device.counters().report()))
            .collect();
        let sum = |key: &str| devices.values().filter_map(|report| report[key].as_u64()).sum::<u64>();
        let most = |key: &str| devices.values().filter_map(|report| report[key].as_f64()).reduce(f64::max);
        json!({
            "poses": sum("poses"),
            "forces": sum("forces"),
            "rejected": sum("rejected"),
            "surfaces": self.surface.published(),
            "peak_depth_mm": most("peak_depth_mm"),
            "peak_force_n": most("peak_force_n"),
            "step_median_us": most("step_median_us"),
            "step_p99_us": most("step_p99_us"),
            "devices": devices,
        })
    }

    fn summary(&self) -> String {
        let law = self.session.tissue().law();
        format!(
            "{} vertices, {} parallel chains ({}), {} {}",
            self.session.body().mesh().vertices().len(),
            law.chains().len(),
            law.formulation(),
            self.devices.len(),
            if self.devices.len() == 1 { "device" } else { "devices" },
        )
    }
}
