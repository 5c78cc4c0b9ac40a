//! What `rhombus` computes beyond one call of the model, for its commands, for the report and for tests.

pub mod calibrate;
pub mod output;
pub mod reference;
