//! The node: set up once, then spin, answer, repeat.

use std::time::Duration;

use anyhow::Result;
use node_kit::{Change, FrameTree, Level, NodeKit, Status, TransformListener, convert, topics};
use rhombus_chain::{Body, Tissue};
use scene::Scene;
use serde_json::json;

use crate::device::{Device, World};
use crate::live::InContact;
use crate::model;
use crate::session_time::SessionTime;
use crate::surface::Surface;

/// Longest wait for a pose; how late a signal to end is seen.
const WAIT: Duration = Duration::from_millis(50);

/// Everything the node has.
struct Deformation {
    body: Body,
    tissue: Tissue,
    frames: FrameTree,
    body_frame: String,
    transforms: TransformListener,
    devices: Vec<Device>,
    surface: Surface,
    time: SessionTime,
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
        let tissue = scene.tissue()?;
        let loaded = scene.load_body().map_err(|error| match error.key {
            Some(_) => anyhow::Error::new(error),
            None => anyhow::Error::new(error).context("body.mesh"),
        })?;
        for (name, value) in model::computed(tissue.law()) {
            kit.show_computed(name, value)?;
        }
        let in_contact = InContact::default();
        kit.check_changes(in_contact.check());
        let mesh_warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
        mesh_warnings.iter().for_each(|warning| kit.log().warn(warning));

        let body_frame = kit.frame_id(&scene.body.frame_id);
        let mesh = convert::mesh(loaded.body.mesh().vertices(), loaded.body.mesh().triangles());
        let mut surface = Surface::new(body_frame.clone(), convert::topology_version(&mesh));
        surface.set_rate(kit, &scene, &loaded.body, &tissue)?;
        kit.publish(&topics::BODY_MESH, "")?.publish(&mesh)?;
        let names = &scene.session.devices;
        let devices: Result<Vec<Device>, _> =
            names.iter().map(|name| Device::new(kit, name, &tissue, &scene)).collect();
        Ok(Deformation {
            frames: frames_from_parameters(kit, &scene),
            transforms: TransformListener::new(kit)?,
            devices: devices?,
            body: loaded.body,
            tissue,
            body_frame,
            surface,
            time: SessionTime::new(names.len()),
            in_contact,
            mesh_warnings,
        })
    }

    /// Answer what has arrived, then publish the surface if it is due.
    fn turn(&mut self, kit: &NodeKit) -> Result<()> {
        self.transforms.update(&mut self.frames);
        let world = World {
            body: &self.body,
            tissue: &self.tissue,
            frames: &self.frames,
            body_frame: &self.body_frame,
        };
        let mut any = false;
        for (index, device) in self.devices.iter_mut().enumerate() {
            if let Some(stamp_ns) = device.turn(&world, kit.log())? {
                self.time.hear(index, stamp_ns);
                any = true;
            }
        }
        if let Some(stamp_ns) = self.time.now_ns().filter(|_| any) {
            self.in_contact.set(self.devices.iter().any(|device| device.counters().in_contact()));
            let sessions = self.devices.iter().map(Device::session);
            self.surface.step(&self.body, &self.tissue, stamp_ns, sessions)?;
        }
        Ok(())
    }

    /// Take over parameters that were set while the node runs. They have been checked.
    fn retune(&mut self, kit: &mut NodeKit, changes: &[Change]) -> Result<()> {
        let scene = Scene::from_parameters(kit.parameters().clone())?;
        self.tissue = scene.tissue()?;
        self.devices.iter_mut().for_each(|device| device.retune(&self.tissue, &scene));
        if changes.iter().any(|change| change.name == "surface.rate") {
            self.surface.set_rate(kit, &scene, &self.body, &self.tissue)?;
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
            .with("ignored_transforms", self.frames.ignored());
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
        format!(
            "{} vertices, {} parallel chains ({}), {} {}",
            self.body.mesh().vertices().len(),
            self.tissue.law().chains().len(),
            self.tissue.law().formulation(),
            self.devices.len(),
            if self.devices.len() == 1 { "device" } else { "devices" },
        )
    }
}

/// Where the parameters put body and devices in the scene. With several devices `device.scene_from_device` is the place
/// of all of them only when somebody says so; otherwise each driver says where its own stands, on `/tf_static`.
fn frames_from_parameters(kit: &NodeKit, scene: &Scene) -> FrameTree {
    let scene_frame = kit.frame_id(&scene.session.scene_frame_id);
    let mut frames = FrameTree::new();
    frames.set_from_parameters(&scene_frame, &kit.frame_id(&scene.body.frame_id), scene.body.scene_from_body);
    let devices = &scene.session.devices;
    if devices.len() == 1 || scene.parameters().is_given("device.scene_from_device") {
        for device in devices {
            let device_frame = kit.frame_id_of_device(device, &scene.device.frame_id);
            frames.set_from_parameters(&scene_frame, &device_frame, scene.device.scene_from_device);
        }
    }
    frames
}
