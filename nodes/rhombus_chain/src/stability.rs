//! Whether a contact law can be felt through a sampled device without buzzing: MODEL section 7, in closed form.
//!
//! A law is analysed once, not in a loop. Under the energy law the tangent stiffness
//! `dF/dDL = (K - T + T cos(theta)/cos^3(x)) / S_n^2` rises with the stretch, so a body stiffens when pulled and softens when
//! pressed; under the published law `dF/dDL = (k_n - k_t tan(theta) tan(x)) / S_n` it is the other way round. Between its guards
//! each chain is monotone, beyond them straight, and all chains of a law share the formulation: the stiffest point of any
//! range of depths is one of its ends.

mod demand;
mod ranges;
mod verdict;

pub use demand::{Cause, Demand, Reach};
pub use ranges::{Bend, ChainAnalysis, LawAnalysis, Range};
pub use verdict::{HapticLoop, Verdict};
