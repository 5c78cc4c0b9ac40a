//! The parallel rhombus-chain model (Zhang, Song, Liu, Li 2009): what force a soft body answers a probe with, and how its
//! surface moves. Values in, values out: no ROS, no files, no threads, no clock.
//!
//! From small to large: a unit is one rhombus, a [`Chain`] is units in series, a [`ContactLaw`] is chains in parallel,
//! a [`ContactShape`] is the surface around the contact. Units are SI. `depth` is positive into the body and every `force_n`
//! of a contact is on the hand, positive outwards; a chain itself speaks the paper's `DL`, `dl_1`, `F`, negative when pressed.

mod chain;
mod closed_form;
mod contact_law;
mod contact_shape;
mod double_double;
mod parameter_error;
mod parameters;
mod pose;
mod sums;
mod unit;

pub use chain::{Chain, ChainResponse};
pub use contact_law::{ContactLaw, ForceError, LawResponse, NonFinite};
pub use contact_shape::{ContactShape, Displacement};
pub use parameter_error::ParameterError;
pub use parameters::{ChainParameters, Formulation, Spread, SurfaceParameters};
pub use pose::{Pose, PoseError};
