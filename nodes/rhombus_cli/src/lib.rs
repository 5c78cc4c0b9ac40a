//! What `rhombus` computes beyond one call of the model, for its commands, for the report and for tests.

pub mod assignments;
pub mod calibrate;
#[cfg(any(feature = "replay", feature = "report"))]
pub mod drawing;
pub mod guard;
pub mod markup;
pub mod output;
pub mod progress_bar;
pub mod reference;
#[cfg(feature = "replay")]
pub mod replay;
