//! `rhombus calibrate`: chains for a body by finite elements, a half-space, measured tables, recordings or reference solutions.

mod body;
mod command;
pub mod errors;
mod fitted;
mod force;
pub mod half_space;
mod least_squares;
pub mod measured;
pub mod recording;
mod regional;
mod rings;
mod shape;
pub mod sites;
pub mod table;
mod write;

pub use command::Calibrate;
pub use fitted::{FitError, Fitted, MOST_CHAINS, Reached};
pub use force::{ForcePoint, relative_error};
