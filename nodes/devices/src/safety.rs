//! The safety layer: what stands between any source of force and any motor. Plain state, no clock, no allocation, no
//! lock: it runs in the motor loop, and in tests and studies as it is.
//!
//! ```text
//! Wanted -> finite -> clamp -> engage gate -> workspace edge -> passivity -> power -> clamp -> finite -> slew -> motors
//!                        velocity guard ------------> fault: the same way to zero, at the slew limit
//! ```
//!
//! [`SafetySettings`] become [`CheckedSettings`] at the door: a value that is not safe for a hand is refused unless
//! `unsafe.parameters` names it. [`SafetyLayer`] applies them, one file for each rule; [`FaultLatch`] keeps the first
//! cause of a fault until somebody clears it.
//!
//! Why slew comes last: every set of wrenches that the clamps allow is convex and holds zero, and slew moves on the
//! straight line from an allowed wrench to an allowed wrench. So the clamps and the slew limit hold together, in every
//! period, on the way down to zero too.

mod clamp;
mod energy;
mod engage_gate;
mod fault;
mod finite;
mod layer;
mod limits_hit;
mod passivity;
mod power;
mod ranges;
mod settings;
mod slew;
pub(crate) mod vector;
mod velocity_guard;
mod workspace_edge;

pub use energy::Energy;
pub use fault::{FaultCause, FaultLatch};
pub use layer::{Applied, SafetyLayer};
pub use limits_hit::LimitsHit;
pub use ranges::{CheckedSettings, SafetyError};
pub use settings::SafetySettings;
