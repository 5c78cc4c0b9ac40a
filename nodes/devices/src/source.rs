//! Which wrench is wanted of the motors: by the newest contact law, evaluated here, by a commanded wrench, by a spring
//! that holds the handle, or by nobody.

mod command;
mod hand_over;
mod hold;
mod law;
mod servo;
mod wanted;

pub use command::{Axes, ForceSource, LawCommand, Moment, ServoCommand, SourceMode};
pub use wanted::{ForceOrigin, Inputs, Source, Wanted};
