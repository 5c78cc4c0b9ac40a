//! What a scene builds and what it leaves out, by the decisions the nodes take.
//!
//! The plan is made by building: what is said to be there has been constructed and measured, what is left out has not.

mod topics;

use rhombus_chain::{Body, DeviceSession, StampRate, SurfaceField, Tissue};

pub use topics::{PlannedTopic, TopicState};

use crate::schema::{Check, spec};
use crate::{LoadedBody, MeshSource, Node, Scene, SceneError, Warning};

/// What a scene builds and leaves out.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// What is constructed.
    pub built: Vec<Part>,
    /// What could be there and is not.
    pub left_out: Vec<LeftOut>,
    /// Topics of the session, in the node's namespace.
    pub topics: Vec<PlannedTopic>,
    /// Threads of each node, without those of the middleware.
    pub threads: Vec<(Node, Vec<&'static str>)>,
    /// Nothing that stops a session.
    pub warnings: Vec<Warning>,
}

/// Something that is constructed.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Short name: "contact law".
    pub name: &'static str,
    /// The node that has it.
    pub node: Node,
    /// What it is in this scene.
    pub what: String,
    /// Its memory in bytes; none for what has no memory of its own worth counting.
    pub bytes: Option<usize>,
}

/// Something that is not constructed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// Short name: "expansion".
    pub name: &'static str,
    /// The parameter value that decides it.
    pub why: String,
}

impl Plan {
    /// Memory of all parts, bytes.
    pub fn bytes(&self) -> usize {
        self.built.iter().filter_map(|part| part.bytes).sum()
    }

    /// A built part by its name.
    pub fn part(&self, name: &str) -> Option<&Part> {
        self.built.iter().find(|part| part.name == name)
    }

    /// Whether something is left out.
    pub fn leaves_out(&self, name: &str) -> bool {
        self.left_out.iter().any(|part| part.name == name)
    }

    fn build(&mut self, name: &'static str, node: Node, what: String, bytes: Option<usize>) {
        self.built.push(Part { name, node, what, bytes });
    }

    fn leave_out(&mut self, name: &'static str, why: impl Into<String>) {
        self.left_out.push(LeftOut { name, why: why.into() });
    }
}

impl Scene {
    /// Builds what the session would build, measures it and drops it.
    ///
    /// # Errors
    /// As [`Scene::tissue`] and [`Scene::load_body`]: the scene cannot run.
    pub fn plan(&self) -> Result<Plan, SceneError> {
        let tissue = self.tissue()?;
        let LoadedBody { body, warnings } = self.load_body()?;
        let mut plan = Plan {
            built: Vec::new(),
            left_out: Vec::new(),
            topics: Vec::new(),
            threads: Vec::new(),
            warnings,
        };
        self.plan_model(&mut plan, &body, &tissue);
        self.plan_surface(&mut plan, &body, &tissue);
        self.plan_device(&mut plan);
        self.plan_viewer(&mut plan);
        plan.topics = topics::planned(self);
        plan.threads = vec![
            (Node::HapticDevice, vec!["node", "motor_loop", "publisher"]),
            (Node::Deformation, vec!["node"]),
            (Node::Visualization, if self.viewer.enabled { vec!["node", "viewer"] } else { vec!["node"] }),
        ];
        Ok(plan)
    }

    /// The surface field and when it is due; none when `surface.rate` is 0.
    pub fn surface_field(&self, body: &Body, tissue: &Tissue) -> Option<(StampRate, SurfaceField)> {
        StampRate::new(self.surface.rate_hz).map(|rate| (rate, SurfaceField::new(body, tissue)))
    }

    /// Whether the surface bulges beyond the boundary.
    pub fn expands(&self) -> bool {
        self.surface.expansion > 0.0
    }

    /// Whether markers are published.
    pub fn has_markers(&self) -> bool {
        self.visualization.rate_hz > 0.0
    }

    /// Whether the chains are drawn.
    pub fn draws_chains(&self) -> bool {
        self.has_markers() && self.visualization.show_chains && self.chains.is_some()
    }

    fn plan_model(&self, plan: &mut Plan, body: &Body, tissue: &Tissue) {
        let law = tissue.law();
        let units: Vec<String> =
            law.chains().iter().map(|chain| chain.parameters().units.to_string()).collect();
        let chains = match units.as_slice() {
            [one] => format!("one chain of {one} units"),
            many => format!("{} parallel chains of {} units", many.len(), many.join(", ")),
        };
        let rest = law.rest_stiffness_n_per_m();
        plan.build(
            "contact law",
            Node::Deformation,
            format!("{}, {chains}, {rest:.1} N/m at rest", law.formulation()),
            Some(size_of_val(law) + size_of_val(law.chains())),
        );
        let mesh = body.mesh();
        let [low, high] = mesh.extents();
        let e = high - low;
        let name = match &self.body.mesh {
            MeshSource::BuiltIn(kind) => format!("{}, generated", kind.name()),
            MeshSource::File(path) => path.display().to_string(),
        };
        let (vertices, triangles) = (mesh.vertices().len(), mesh.triangles().len());
        plan.build(
            "body",
            Node::Deformation,
            format!(
                "{name}: {vertices} vertices, {triangles} triangles, {:.3} x {:.3} x {:.3} m",
                e.x, e.y, e.z
            ),
            Some(mesh.memory_bytes()),
        );
        match (&self.body.stiffness_map, body.stiffness()) {
            (Some(path), Some(map)) => {
                let (low, high) = map.range();
                let what = format!("{}: {low} to {high} times the contact law", path.display());
                plan.build("stiffness map", Node::Deformation, what, Some(map.memory_bytes()));
            }
            (None, Some(map)) => {
                let (low, high) = map.range();
                let what = format!("of the calibrated body: {low:.3} to {high:.3} times the contact law");
                plan.build("stiffness map", Node::Deformation, what, Some(map.memory_bytes()));
            }
            _ => plan.leave_out("stiffness map", "body.stiffness_map is \"\""),
        }
        match (&self.body.response, body.response()) {
            (Some(path), Some(response)) => {
                let (harmonics, modes) = (response.harmonics(), response.modes());
                let what = format!("{}: {harmonics} harmonics, {modes} body modes", path.display());
                plan.build("response", Node::Deformation, what, Some(response.memory_bytes()));
            }
            _ => plan.leave_out("response", "body.response is \"\""),
        }
        let index_bytes = body.index().memory_bytes();
        plan.build(
            "spatial index",
            Node::Deformation,
            format!("over {triangles} triangles"),
            Some(index_bytes),
        );
        let count = self.session.devices.len();
        let devices = if count == 1 { "one device".to_owned() } else { format!("{count} devices") };
        let bytes = Some(count * size_of::<DeviceSession>());
        plan.build("contact memory", Node::Deformation, format!("of {devices}, with grasp"), bytes);
    }

    fn plan_surface(&self, plan: &mut Plan, body: &Body, tissue: &Tissue) {
        let surface = &self.surface;
        let Some((_, field)) = self.surface_field(body, tissue) else {
            plan.leave_out("surface", "surface.rate is 0");
            plan.leave_out("boundary", "no surface");
            plan.leave_out("expansion", "no surface");
            return;
        };
        let what = format!("{} Hz of stamps, spread {}", surface.rate_hz, surface.spread);
        plan.build("surface", Node::Deformation, what, Some(field.memory_bytes()));
        if surface.cutoff > 0.0 {
            let percent = 100.0 * surface.cutoff;
            let what = format!("units that turn by {percent} % of the rest angle or less are not moved");
            plan.build("boundary", Node::Deformation, what, None);
        } else {
            plan.leave_out("boundary", "surface.cutoff is 0: every unit is moved");
        }
        if self.expands() {
            let percent = 100.0 * surface.expansion;
            let what =
                format!("{percent} % of the displaced volume bulges outward; its memory is in surface");
            plan.build("expansion", Node::Deformation, what, None);
        } else {
            plan.leave_out("expansion", "surface.expansion is 0");
        }
    }

    fn plan_device(&self, plan: &mut Plan) {
        let device = &self.device;
        let what = format!("{} at {} Hz, at most {} N", device.backend, device.rate_hz, device.max_force_n);
        plan.build("backend", Node::HapticDevice, what, None);
        if let Some(Check::OneOf(backends)) = spec("device.backend").map(|spec| spec.check) {
            for other in backends.iter().filter(|name| **name != device.backend) {
                plan.leave_out(other, format!("device.backend is {:?}", device.backend));
            }
        }
        match &self.session.clutch_button {
            Some(button) => plan.build("clutch", Node::HapticDevice, format!("button {button}"), None),
            None => plan.leave_out("clutch", "clutch.button is \"\""),
        }
    }

    fn plan_viewer(&self, plan: &mut Plan) {
        if self.viewer.enabled {
            let what = format!("page for browsers, {} Hz while one shows it", self.viewer.rate_hz);
            plan.build("page", Node::Visualization, what, None);
        } else {
            plan.leave_out("page", "viewer.enabled is false");
        }
        if !self.has_markers() {
            plan.leave_out("viewer", "visualization.rate is 0");
            plan.leave_out("drawn chains", "no viewer");
            return;
        }
        let what = format!("RViz markers, {} Hz while somebody reads them", self.visualization.rate_hz);
        plan.build("viewer", Node::Visualization, what, None);
        if self.draws_chains() {
            plan.build("drawn chains", Node::Visualization, "rods, mass points, springs".to_owned(), None);
        } else {
            plan.leave_out("drawn chains", "visualization.show_chains is false");
        }
    }
}
