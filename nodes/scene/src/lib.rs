//! What a scene file may say: names, units, ranges, defaults, validation; mesh files in, checked bodies out.
//!
//! One table, [`schema()`], has every parameter of every node. What checks a file, what a node declares and what the
//! documentation shows are made from it. Values go one way and get safer on it:
//!
//! ```text
//! parameter file ─┐  known names, types, ranges            together               built
//! node's values  ─┴─> Parameters ───────────────> Scene ─────────────> Tissue, Body
//! ```
//!
//! A parameter file is an ordinary ROS 2 one and is read as strictly as ROS 2 reads it: an array of numbers has a
//! decimal point in every entry (`[1.0, 2.0]`; `[1, 2]` is an array of integers and is refused, `[1, 2.0]` is none at
//! all), while an integer is accepted where a single number is expected. Every error says file, line, parameter, value
//! and what is accepted.
//!
//! ```
//! use scene::{Origin, Scene, Value};
//!
//! let slow = [("surface.rate".to_owned(), Value::Integer(10))];
//! let scene = Scene::from_values(slow, Origin::named("example"))?;
//! assert_eq!(scene.surface.rate_hz, 10.0);
//! let body = scene.load_body()?.body;
//! assert_eq!(body.mesh().vertices().len(), 3116);
//!
//! let never = [("surface.rate".to_owned(), Value::Double(-1.0))];
//! let error = Scene::from_values(never, Origin::named("example")).unwrap_err();
//! assert_eq!(error.to_string(), "example: surface.rate: -1.0 is not accepted; accepted: number, 0 to 1000 [Hz]");
//! # Ok::<(), scene::SceneError>(())
//! ```

mod assignment;
mod body;
mod chains;
mod drivers;
mod error;
mod frame_names;
pub mod generate;
mod haptic_loop;
mod mesh_file;
mod mesh_source;
mod origin;
mod parameters;
mod plan;
mod response_file;
mod scene;
pub mod schema;
mod sections;
mod session;
mod settings;
mod sites;
mod stiffness_file;
pub mod topic;
mod value;
mod yaml;
mod yaml_value;

pub use body::{LoadedBody, Warning};
pub use chains::ChainSettings;
pub use error::{Problem, SceneError};
pub use frame_names::{frame_id, frame_id_of_device, session_namespace};
pub use generate::BodyKind;
pub use mesh_file::{MeshFile, Obj};
pub use origin::Origin;
pub use parameters::Parameters;
pub use plan::{LeftOut, Part, Plan, PlannedTopic, TopicState};
pub use response_file::{
    ChainShape, LoadedResponse, RegionError, ResponseFile, ResponseHeader, load_response, mesh_checksum,
    read_response,
};
pub use scene::Scene;
pub use schema::{Check, DefaultValue, Kind, Length, Node, ParameterSpec, schema};
pub use sections::Reader;
pub use session::{LoadedSession, topology_version};
pub use settings::{
    BodySettings, DeviceSettings, GraspSettings, MeshSource, ProbeSettings, RecordingSettings,
    ReplaySettings, SessionSettings, SimulatedSettings, SurfaceSettings, ViewerSettings,
    VisualizationSettings,
};
pub use sites::{Site, sites};
pub use stiffness_file::{StiffnessFile, read_stiffness_factors, read_stiffness_map};
pub use value::Value;
