//! The scene in typed groups: what the nodes read instead of parameter names.

use std::path::{Path, PathBuf};

use rhombus_chain::{ContactLaw, ParameterError, Pose, SurfaceParameters, Tissue, TissueError};

use crate::mesh_source::file_of_body;
use crate::settings::{
    BodySettings, DeviceSettings, GraspSettings, MeshSource, ProbeSettings, RecordingSettings,
    ReplaySettings, SessionSettings, SimulatedSettings, SurfaceSettings, ViewerSettings,
    VisualizationSettings,
};
use crate::{ChainSettings, Parameters, Problem, Reader, SceneError, Value};

/// A validated scene. Every value has been checked against the schema; what depends on several values has been
/// checked too, except the chains and the mesh, which only the nodes that use them build: [`Scene::tissue`],
/// [`Scene::load_body`].
#[derive(Clone, Debug)]
pub struct Scene {
    /// What is touched.
    pub body: BodySettings,
    /// The parallel chains; none when no `chains.*` array is given.
    pub chains: Option<ChainSettings>,
    /// How the surface follows a contact.
    pub surface: SurfaceSettings,
    /// What touches it.
    pub probe: ProbeSettings,
    /// Grasping.
    pub grasp: GraspSettings,
    /// Frames and devices of the session.
    pub session: SessionSettings,
    /// The haptic device.
    pub device: DeviceSettings,
    /// The simulated backend's hand.
    pub simulated: SimulatedSettings,
    /// What RViz shows.
    pub visualization: VisualizationSettings,
    /// What browsers show.
    pub viewer: ViewerSettings,
    /// What is recorded.
    pub recording: RecordingSettings,
    /// What is replayed.
    pub replay: ReplaySettings,
    parameters: Parameters,
}

impl Scene {
    /// Reads a parameter file.
    ///
    /// # Errors
    /// See [`Parameters::from_file`] and [`Scene::from_parameters`].
    pub fn from_file(path: &Path, reader: Reader<'_>) -> Result<Scene, SceneError> {
        Scene::from_parameters(Parameters::from_file(path, reader)?)
    }

    /// From a node's own parameter values.
    ///
    /// # Errors
    /// See [`Parameters::from_values`] and [`Scene::from_parameters`].
    pub fn from_values(
        values: impl IntoIterator<Item = (String, Value)>,
        origin: crate::Origin,
    ) -> Result<Scene, SceneError> {
        Scene::from_parameters(Parameters::from_values(values, origin)?)
    }

    /// Puts checked values into typed groups.
    ///
    /// # Errors
    /// Some but not all of the chains' required arrays are given, or their lengths differ; the mesh's path cannot be
    /// resolved.
    pub fn from_parameters(p: Parameters) -> Result<Scene, SceneError> {
        Ok(Scene {
            body: BodySettings {
                mesh: MeshSource::resolve(&p)?,
                scale: p.double("body.scale")?,
                stiffness_map: file_of_body(&p, "body.stiffness_map")?,
                response: file_of_body(&p, "body.response")?,
                frame_id: p.text("body.frame_id")?.to_owned(),
                scene_from_body: pose(&p, "body.pose")?,
            },
            chains: ChainSettings::read(&p)?,
            surface: SurfaceSettings {
                cutoff: p.double("surface.cutoff")?,
                expansion: p.double("surface.expansion")?,
                spread: parsed(&p, "surface.spread")?,
                rate_hz: p.double("surface.rate")?,
            },
            probe: ProbeSettings {
                radius_m: p.double("probe.radius")?,
                contact_radius_m: p.double("probe.contact_radius")?,
            },
            grasp: GraspSettings {
                lateral: p.double("grasp.lateral")?,
                close_below_rad: p.double("grasp.close_below")?,
            },
            session: SessionSettings {
                scene_frame_id: p.text("scene.frame_id")?.to_owned(),
                devices: devices(&p)?,
                clutch_button: non_empty(p.text("clutch.button")?).map(str::to_owned),
                use_sim_time: p.bool("use_sim_time")?,
            },
            device: DeviceSettings {
                backend: p.text("device.backend")?.to_owned(),
                frame_id: p.text("device.frame_id")?.to_owned(),
                scene_from_device: pose(&p, "device.scene_from_device")?,
                motion_scale: p.double("device.motion_scale")?,
                serial: p.text("device.serial")?.to_owned(),
                rate_hz: p.double("device.rate")?,
                pose_rate_hz: p.double("device.pose_rate")?.min(p.double("device.rate")?),
                cpu: usize::try_from(p.integer("device.cpu")?).ok(),
                enable_at_start: p.bool("device.enable_at_start")?,
                gravity_compensation: p.bool("device.gravity_compensation")?,
                body_cf_absolute: p.bool("device.body_cf_absolute")?,
                max_torque_n_m: p.double("device.max_torque")?,
                max_gripper_force_n: p.double("device.max_gripper_force")?,
                max_force_n: p.double("device.max_force")?,
                force_source: p.text("device.force_source")?.to_owned(),
                // The schema has checked that it is not negative.
                wait_for_readers: usize::try_from(p.integer("device.wait_for_readers")?).unwrap_or(0),
            },
            simulated: SimulatedSettings {
                mass_kg: p.double("simulated.mass")?,
                stiffness_n_per_m: p.double("simulated.stiffness")?,
                damping_n_s_per_m: p.double("simulated.damping")?,
                depth_m: p.double("simulated.depth")?,
                pull_m: p.double("simulated.pull")?,
                slide_m: p.double("simulated.slide")?,
                period_s: p.double("simulated.period")?,
                noise_m: p.double("simulated.noise")?,
                quantisation_m: p.double("simulated.quantisation")?,
                dropout: p.double("simulated.dropout")?,
                latency_s: p.double("simulated.latency")?,
            },
            visualization: VisualizationSettings {
                rate_hz: p.double("visualization.rate")?,
                full_scale_m: p.double("visualization.full_scale")?,
                displacement_scale: p.double("visualization.displacement_scale")?,
                force_scale_m_per_n: p.double("visualization.force_scale")?,
                show_chains: p.bool("visualization.show_chains")?,
            },
            viewer: ViewerSettings {
                enabled: p.bool("viewer.enabled")?,
                address: p.text("viewer.address")?.to_owned(),
                // The schema has checked both ranges.
                port: u16::try_from(p.integer("viewer.port")?).unwrap_or(0),
                rate_hz: p.double("viewer.rate")?,
                max_pages: usize::try_from(p.integer("viewer.max_pages")?).unwrap_or(1),
            },
            recording: RecordingSettings {
                directory: PathBuf::from(p.text("recording.directory")?),
                topics: p.texts("recording.topics")?.iter().filter(|t| !t.is_empty()).cloned().collect(),
            },
            replay: ReplaySettings {
                path: non_empty(p.text("replay.path")?).map(PathBuf::from),
                rate: p.double("replay.rate")?,
                lockstep: p.bool("replay.lockstep")?,
            },
            parameters: p,
        })
    }

    /// The values the scene was made of.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// The chains, for a node that cannot do without.
    ///
    /// # Errors
    /// No `chains.*` array is given.
    pub fn required_chains(&self) -> Result<&ChainSettings, SceneError> {
        self.chains.as_ref().ok_or_else(|| ChainSettings::missing(&self.parameters))
    }

    /// The contact law, validated by the model.
    ///
    /// # Errors
    /// The chains are missing or not accepted by the model.
    pub fn law(&self) -> Result<ContactLaw, SceneError> {
        self.required_chains()?.law(&self.parameters)
    }

    /// The validated model settings: contact law, surface, probe, grasp.
    ///
    /// # Errors
    /// The chains are missing, or the model does not accept a setting.
    pub fn tissue(&self) -> Result<Tissue, SceneError> {
        Tissue::new(self.law()?, self.surface_parameters(), self.probe.radius_m, self.grasp.lateral).map_err(
            |error| {
                let name = match &error {
                    TissueError::Surface(ParameterError::SurfaceOutOfRange { name, .. }) => name,
                    TissueError::Surface(_) => "surface",
                    TissueError::ProbeRadius(_) => "probe.radius",
                    TissueError::GraspLateral(_) => "grasp.lateral",
                };
                self.parameters.error(name, Problem::Model(error.to_string()))
            },
        )
    }

    /// What the surface around a contact is computed from, besides the law.
    pub fn surface_parameters(&self) -> SurfaceParameters {
        SurfaceParameters {
            cutoff: self.surface.cutoff,
            expansion: self.surface.expansion,
            spread: self.surface.spread,
            contact_radius_m: self.probe.contact_radius_m,
        }
    }
}

/// Sub-namespaces, each once: two devices on one topic would each answer every pose.
fn devices(p: &Parameters) -> Result<Vec<String>, SceneError> {
    let names = p.texts("devices")?;
    let repeated = (1..names.len()).find(|i| names[..*i].contains(&names[*i]));
    match repeated {
        None => Ok(names.to_vec()),
        Some(index) => Err(p.error(
            "devices",
            Problem::OutOfRange {
                value: format!("{:?}", names[index]),
                index: Some(index),
                accepted: "each name once".to_owned(),
            },
        )),
    }
}

fn non_empty(text: &str) -> Option<&str> {
    (!text.is_empty()).then_some(text)
}

fn pose(p: &Parameters, name: &str) -> Result<Pose, SceneError> {
    let numbers = p.doubles(name)?;
    let array = <[f64; 7]>::try_from(numbers)
        .map_err(|_| p.error(name, Problem::Model(format!("{} entries, not 7", numbers.len()))))?;
    Pose::from_array(array).map_err(|error| p.error(name, Problem::Model(error.to_string())))
}

/// A word that the schema has checked, as the model's type.
pub(crate) fn parsed<T: std::str::FromStr<Err: std::fmt::Display>>(
    p: &Parameters,
    name: &str,
) -> Result<T, SceneError> {
    p.text(name)?.parse().map_err(|error: T::Err| p.error(name, Problem::Model(error.to_string())))
}
