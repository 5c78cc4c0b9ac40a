//! `rhombus replay`: a recording through the model again, without ROS, and whether it is still the same.

mod answers;
mod command;
mod inputs;
pub mod json;
pub mod junit;
pub mod markdown;
mod model;
pub mod plot;
mod record;
pub mod text;

pub use answers::OutputTopic;
pub use command::ReplayCommand;
pub use model::{Counts, Output, Replay};
