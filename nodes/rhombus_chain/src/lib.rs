//! The parallel rhombus-chain model (Zhang, Song, Liu, Li 2009): what force a soft body answers a probe with, and how its
//! surface moves. Values in, values out: no ROS, no files, no threads, no clock.
//!
//! From small to large: a unit is one rhombus, a [`Chain`] is units in series, a [`ContactLaw`] is chains in parallel,
//! a [`ContactShape`] is the surface around the contact. Units are SI. `depth` is positive into the body and every `force_n`
//! of a contact is on the hand, positive outwards; a chain itself speaks the paper's `DL`, `dl_1`, `F`, negative when pressed.

mod arc_length;
mod body;
mod chain;
pub mod checks;
mod closed_form;
mod closest;
mod contact_law;
mod contact_report;
mod contact_shape;
mod device_session;
mod double_double;
mod expansion;
mod frame_tree;
mod grasp;
mod interaction;
mod local_law;
mod mesh;
mod parameter_error;
mod parameters;
mod pose;
mod proxy;
mod response;
mod rings;
mod session;
mod session_time;
pub mod stability;
mod stamp_rate;
mod stiffness_map;
mod sums;
mod surface_field;
mod surface_index;
mod tissue;
mod unit;

pub use arc_length::ArcLengths;
pub use body::Body;
pub use chain::{Chain, ChainResponse};
pub use contact_law::{ContactLaw, ForceError, LawResponse, NonFinite};
pub use contact_report::ContactReport;
pub use contact_shape::{ContactShape, Displacement};
pub use device_session::{Answer, DeviceSession, HandPose, Rejection, chain_for_hand};
pub use frame_tree::{FrameTree, frame_of_message};
pub use interaction::{Impression, Interaction, Step, StepError};
pub use local_law::{LAW_VALIDITY_NS, LocalLaw, Mode};
pub use mesh::{Inspection, MeshError, SurfaceMesh, SurfacePoint, inspect};
pub use parameter_error::ParameterError;
pub use parameters::{ChainParameters, Formulation, Spread, SurfaceParameters};
pub use pose::{Pose, PoseError};
pub use response::{
    MOST_CHAINS, MOST_HARMONICS, MOST_MODES, Response, ResponseError, ResponseParts, tangent_frame,
};
pub use session::{MeasuredPose, Session, SessionParts, SurfaceMoment};
pub use session_time::SessionTime;
pub use stamp_rate::StampRate;
pub use stiffness_map::{StiffnessMap, StiffnessMapError};
pub use surface_field::SurfaceField;
pub use surface_index::SurfaceIndex;
pub use tissue::{Tissue, TissueError};
