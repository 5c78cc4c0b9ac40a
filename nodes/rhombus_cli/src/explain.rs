//! `rhombus explain`: what a scene builds, what it leaves out, and the memory of it.

use std::fmt::Write;
use std::path::PathBuf;

use clap::{Args, ValueHint};
use scene::{Node, Plan, Scene, TopicState};
use serde::Serialize;

use crate::assignments::Assignments;
use crate::output;

/// What a scene builds and what it leaves out: model, surface, device, viewer, topics, threads, memory
///
/// Reads the whole file, as all nodes together would, and builds the model; exit code 2 when a session could not start.
#[derive(Args)]
pub(crate) struct Explain {
    /// ROS 2 parameter file
    #[arg(value_name = "PARAMS.yaml", value_hint = ValueHint::FilePath)]
    parameters: PathBuf,
    #[command(flatten)]
    assignments: Assignments,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// Field names and their order are the JSON.
#[derive(Serialize)]
struct Explanation {
    scene: PathBuf,
    built: Vec<Built>,
    left_out: Vec<LeftOut>,
    devices: Vec<Device>,
    drivers: Vec<Driver>,
    topics: Vec<Topic>,
    threads: Vec<Threads>,
    warnings: Vec<String>,
    bytes: usize,
}

#[derive(Serialize)]
struct Built {
    part: &'static str,
    node: &'static str,
    what: String,
    bytes: Option<usize>,
}

#[derive(Serialize)]
struct LeftOut {
    part: &'static str,
    why: String,
}

/// An entry of `devices`.
#[derive(Serialize)]
struct Device {
    /// Sub-namespace; empty for the node's own namespace.
    name: String,
    backend: String,
}

/// A driver with a section of its own in the file.
#[derive(Serialize)]
struct Driver {
    node: String,
    backend: String,
    serial: String,
    rate_hz: f64,
    max_force_n: f64,
    /// Position of the device's base in the scene, m.
    base_m: [f64; 3],
}

#[derive(Serialize)]
struct Topic {
    name: String,
    message: &'static str,
    from: &'static str,
    to: &'static str,
    /// `active`, `silent` (advertised, nothing published) or `absent`.
    state: &'static str,
    why: Option<&'static str>,
}

#[derive(Serialize)]
struct Threads {
    node: &'static str,
    threads: Vec<&'static str>,
}

impl Explain {
    pub(crate) fn run(self) -> anyhow::Result<()> {
        let scene = self.assignments.scene(&self.parameters)?;
        let drivers = self.assignments.drivers(&self.parameters)?;
        let explanation = Explanation::new(self.parameters, &scene, scene.plan()?, &drivers);
        for warning in &explanation.warnings {
            eprintln!("rhombus: warning: {warning}");
        }
        match self.json {
            true => output::json(&explanation),
            false => output::text(&explanation.to_string()),
        }
    }
}

impl Explanation {
    fn new(file: PathBuf, scene: &Scene, plan: Plan, drivers: &[(String, Scene)]) -> Explanation {
        let bytes = plan.bytes();
        Explanation {
            scene: file,
            built: plan
                .built
                .into_iter()
                .map(|p| Built { part: p.name, node: p.node.name(), what: p.what, bytes: p.bytes })
                .collect(),
            left_out: plan
                .left_out
                .into_iter()
                // What a driver's own section brings in is not left out.
                .filter(|part| drivers.iter().all(|(_, scene)| scene.device.backend != part.name))
                .map(|l| LeftOut { part: l.name, why: l.why })
                .collect(),
            devices: scene.session.devices.iter().map(|name| Device::new(name, scene, drivers)).collect(),
            drivers: drivers.iter().map(|(node, scene)| Driver::new(node, scene)).collect(),
            topics: plan
                .topics
                .into_iter()
                .map(|t| {
                    let (state, why) = match t.state {
                        TopicState::Active => ("active", None),
                        TopicState::Silent(why) => ("silent", Some(why)),
                        TopicState::Absent(why) => ("absent", Some(why)),
                    };
                    Topic { name: t.name, message: t.message, from: t.from, to: t.to, state, why }
                })
                .collect(),
            threads: plan
                .threads
                .into_iter()
                .map(|(node, threads)| Threads { node: node.name(), threads })
                .collect(),
            warnings: plan.warnings.iter().map(ToString::to_string).collect(),
            bytes,
        }
    }
}

impl Device {
    /// With the driver's own section where there is one, in whatever namespace.
    fn new(name: &str, scene: &Scene, drivers: &[(String, Scene)]) -> Device {
        let end = format!("/{}/{}", name.trim_matches('/'), Node::HapticDevice.name());
        let own = drivers.iter().find(|(node, _)| !name.is_empty() && node.ends_with(&end));
        let scene = own.map_or(scene, |(_, scene)| scene);
        Device { name: name.to_owned(), backend: scene.device.backend.clone() }
    }
}

impl Driver {
    fn new(node: &str, scene: &Scene) -> Driver {
        let device = &scene.device;
        Driver {
            node: node.to_owned(),
            backend: device.backend.clone(),
            serial: device.serial.clone(),
            rate_hz: device.rate_hz,
            max_force_n: device.max_force_n,
            base_m: device.scene_from_device.translation.to_array(),
        }
    }
}

impl std::fmt::Display for Explanation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut text = String::new();
        writeln!(text, "built")?;
        for Built { part, what, bytes, .. } in &self.built {
            let memory = bytes.map(|bytes| format!("; {}", output::bytes(bytes))).unwrap_or_default();
            writeln!(text, "  {part:<15} {what}{memory}")?;
        }
        writeln!(text, "left out")?;
        for LeftOut { part, why } in &self.left_out {
            writeln!(text, "  {part:<15} {why}")?;
        }
        if !self.drivers.is_empty() {
            writeln!(text, "drivers with a section of their own")?;
        }
        for Driver { node, backend, serial, rate_hz, max_force_n, base_m } in &self.drivers {
            let which = if serial.is_empty() { String::new() } else { format!(" {serial}") };
            let what = format!("{backend}{which} at {rate_hz} Hz, at most {max_force_n} N");
            writeln!(text, "  {node:<15} {what}, base at {base_m:?} m")?;
        }
        writeln!(text, "topics")?;
        for Topic { name, message, from, to, state, why } in &self.topics {
            let way = if to.is_empty() { (*from).to_owned() } else { format!("{from} -> {to}") };
            let remark = why.map(|why| format!("; {state}: {why}")).unwrap_or_default();
            writeln!(text, "  {name:<21} {message:<41} {way}{remark}")?;
        }
        writeln!(text, "threads")?;
        for Threads { node, threads } in &self.threads {
            writeln!(text, "  {node:<15} {}", threads.join(", "))?;
        }
        writeln!(text, "memory of the model: {}", output::bytes(self.bytes))?;
        f.write_str(&text)
    }
}
