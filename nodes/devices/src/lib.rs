//! Haptic devices without ROS: what a device is ([`Device`]), what stands behind it ([`Backend`]), and the motor loop
//! that reads poses and commands forces at a fixed rate ([`MotorLoop`]).
//!
//! ```text
//!             newest wins (latest)                      every sample, in order (samples)
//! ROS thread ---- contact law, servo wrench --> motor loop ---- pose, velocity, wrench --> publisher thread
//!       |                                       |        ^
//!       +---- requests, answered at once ---->  | source | read
//!                                               | safety |
//!                                               v        |
//!                                               Device --+
//! ```
//!
//! The motor loop waits for nobody and allocates nothing: it takes the newest contact law when there is one and
//! evaluates it itself ([`source`]), so a late message costs freshness of the law and never a period of the loop. What
//! reaches the motors has passed the [`safety`] layer, whatever its source and whatever the backend.

#[cfg(not(any(
    feature = "simulated",
    feature = "force_dimension",
    feature = "haply",
    feature = "serial",
    feature = "spacemouse",
    feature = "pointer"
)))]
compile_error!(
    "no backend: choose one or more of the features simulated, force_dimension, haply, serial, spacemouse, pointer"
);

mod backend;
pub mod check;
mod device;
mod emergency;
mod error;
#[cfg(feature = "force_dimension")]
pub mod force_dimension;
#[cfg(any(feature = "simulated", feature = "pointer"))]
pub mod hand;
#[cfg(feature = "haply")]
pub mod haply;
mod latest;
mod motor_loop;
mod motor_thread;
mod operating;
mod operation;
#[cfg(feature = "pointer")]
pub mod pointer;
mod realtime;
mod requests;
pub mod safety;
mod samples;
#[cfg(feature = "serial")]
pub mod serial;
mod shared;
#[cfg(feature = "simulated")]
pub mod simulated;
pub mod source;
#[cfg(feature = "spacemouse")]
pub mod spacemouse;
mod stamp_clock;
mod tick;

pub use backend::Backend;
pub use device::{
    Description, Device, DeviceLimits, DeviceState, Found, Listed, MAX_JOINTS, MAX_STATUS, MotorsOff,
    Workspace, Wrench,
};
pub use emergency::{is_motor_loop, motors_off_at_once};
pub use error::DeviceError;
pub use motor_loop::{MotorError, MotorLoop, MotorSettings, RATES_HZ};
pub use operating::{OperatingState, StateCommand};
pub use realtime::{Scheduling, monotonic_ns, next_deadline, sleep_until};
pub use requests::{Answer, Request};
pub use safety::{CheckedSettings, FaultCause, LimitsHit, SafetyError, SafetySettings};
pub use samples::{SampleReceiver, SampleSender, samples};
pub use shared::{Counts, MotorStatus};
pub use source::{Axes, ForceOrigin, ForceSource, LawCommand, ServoCommand, SourceMode};
pub use tick::Sample;
