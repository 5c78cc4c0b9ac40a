//! What goes over the line, byte for byte: `serial_device/PROTOCOL.md` says it for people, `rhombus_serial.h` for
//! firmware. Both directions of every message are here, so that doubles and tests speak it too.
//!
//! Decoding takes any bytes: what is no frame or no message is said so, and nothing here looks at what a value means.
//! All of it is RT safe.

mod bits;
mod fields;
mod frame;
mod messages;

pub use bits::{Cause, capability, command_flag, state_flag};
pub use frame::{BadFrame, Frame, MAX_FRAME, MAX_PAYLOAD, Receiver, checksum};
pub use messages::{
    COMMAND_FRAME, Command, Hello, HelloRequest, Message, NAME_LENGTH, PROTOCOL_VERSION, State, WrongMessage,
};
