//! Stands in for `libdrd.so.3` and `libdhd.so.3`: the functions of the Force Dimension SDK that the driver uses, under
//! their C names. The device is another process, `force_dimension_double`, which listens at [`SOCKET`] in the folder that
//! this library was loaded from. Without it there is no device on the bus.
//!
//! As in the SDK, a reading of the position is one exchange with the device, velocity, gripper and buttons come from
//! the last one, the velocity needs two readings in 20 ms, and the last error is each thread's own.

mod exports;
mod link;
mod wire;

pub use wire::{Call, Reply, Request};

/// The socket's name, beside the library.
pub const SOCKET: &str = "hardware.sock";
/// The version that the library is when no device process says otherwise.
pub const VERSION: [i32; 4] = [3, 17, 5, 0];
