//! What a scene file may say: names, units, ranges, defaults, validation; mesh files in, checked bodies out.

mod body;
mod chains;
mod error;
pub mod generate;
mod mesh_file;
mod mesh_source;
mod origin;
mod parameters;
mod plan;
mod scene;
pub mod schema;
mod sections;
mod sites;
mod value;
mod yaml;

pub use body::{LoadedBody, Warning};
pub use chains::ChainSettings;
pub use error::{Problem, SceneError};
pub use generate::BodyKind;
pub use mesh_file::{MeshFile, Obj};
pub use origin::Origin;
pub use parameters::Parameters;
pub use plan::{LeftOut, Part, Plan, PlannedTopic, TopicState};
pub use scene::{
    BodySettings, DeviceSettings, GraspSettings, MeshSource, ProbeSettings, RecordingSettings,
    ReplaySettings, Scene, SessionSettings, SimulatedSettings, SurfaceSettings, VisualizationSettings,
};
pub use schema::{Check, DefaultValue, Kind, Length, Node, ParameterSpec, schema};
pub use sections::Reader;
pub use sites::{Site, sites};
pub use value::Value;
