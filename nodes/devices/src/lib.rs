//! Haptic devices without ROS: what a device is ([`Device`]), what stands behind it ([`Backend`]), and the motor loop
//! that reads poses and commands forces at a fixed rate ([`MotorLoop`]).
//!
//! ```text
//!             newest wins (latest)                      every sample, in order (samples)
//! ROS thread ---- contact law, servo force ---> motor loop ---- pose, velocity, force ---> publisher thread
//!                                                 |  ^
//!                                          command|  |read
//!                                                 v  |
//!                                                Device
//! ```
//!
//! The motor loop waits for nobody and allocates nothing: it takes the newest contact law when there is one and
//! evaluates it itself, so a late message costs freshness of the law and never a period of the loop.

mod backend;
mod device;
mod error;
mod force_choice;
#[cfg(feature = "force_dimension")]
pub mod force_dimension;
#[cfg(feature = "haply")]
pub mod haply;
mod latest;
mod motor_loop;
mod operating;
mod realtime;
mod samples;
#[cfg(feature = "simulated")]
pub mod simulated;
mod stamp_clock;
mod tick;

pub use backend::Backend;
pub use device::{
    Description, Device, DeviceLimits, DeviceState, Found, MAX_JOINTS, MAX_STATUS, MotorsOff, Workspace,
    Wrench,
};
pub use error::DeviceError;
pub use force_choice::{ForceOrigin, ForceSource, LawCommand, ServoCommand};
pub use motor_loop::{MotorError, MotorLoop, MotorSettings};
pub use operating::{OperatingState, StateCommand};
pub use realtime::{Scheduling, monotonic_ns};
pub use samples::{SampleReceiver, SampleSender, samples};
pub use tick::{Counts, Sample};
