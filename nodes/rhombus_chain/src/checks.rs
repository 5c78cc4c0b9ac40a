//! What has to hold for every law and every body, as functions: asked by tests with 10^5 random cases and by whoever wants more.
//!
//! Nothing of the model calls them. Each case is made from numbers between 0 and 1, so that it can come from any generator.

mod extreme;
mod outcome;
mod work;

pub use extreme::Extreme;
pub use outcome::{Outcome, ThirdOutcome, outcome};
pub use work::{ClosedPath, Work, work};
