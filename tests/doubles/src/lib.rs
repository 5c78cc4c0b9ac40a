//! Devices that are not there, for tests: each is a process of its own that speaks the real interface of its device, with
//! a hand on the handle, motors that the device's own watchdog switches off, and a record of every command that reached
//! them. A driver can be killed or stopped while it presses, and the record says what the hand felt.

mod hand;
mod motors;
mod record;
mod signals;

pub use hand::{HandArguments, PressingHand};
pub use motors::Motors;
pub use record::{Event, Record};
pub use signals::Signals;

/// Time of the monotonic clock, ns: the same for all processes of a machine.
pub use devices::monotonic_ns;
