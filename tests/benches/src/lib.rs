//! What the benchmarks share: order statistics, the probe's path, the name of the machine.
//!
//! A benchmark prints a table for people and writes every raw number as CSV. Figures quoted elsewhere are ratios to the
//! baseline of the same run, since absolute times of shared machines drift.

mod closed_loop;
mod machine;
mod path;
mod statistics;

pub use closed_loop::{ClosedLoop, Transport};
pub use machine::machine_name;
pub use path::{PRESS_M, pressed, walk_on_surface};
pub use statistics::Spread;
