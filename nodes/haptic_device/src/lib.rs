//! The driver of one haptic device: its poses, velocities and forces to ROS 2; forces, contact laws and orders from ROS 2
//! to its motors, in the words of CRTK.
//!
//! Three threads. The motor loop (crate `devices`) reads and commands the device and knows no ROS. The publisher thread
//! sleeps until the motor loop has a sample and publishes it at once, because a spin cannot be woken and publishing may
//! block. This thread owns the node: it spins, takes forces and laws, and hands the newest to the motor loop.

mod answers;
mod backend;
mod buttons;
mod decimation;
mod desk;
mod driver;
mod emergency_stop;
mod forces;
mod freshness;
mod law_message;
mod lifecycle;
mod motor_settings;
mod now;
mod operating_report;
mod operating_state;
mod outbox;
#[cfg(any(feature = "simulated", feature = "pointer"))]
mod placement;
#[cfg(feature = "pointer")]
mod pointer;
#[cfg(feature = "pointer")]
mod pointer_frames;
#[cfg(feature = "simulated")]
mod press_sites;
mod publisher;
mod report;
mod shared;
mod sources;
mod stability_watch;
mod standing;
mod wrench_frame;

use anyhow::Result;
use devices::Device;
use node_kit::NodeKit;

/// Drives the device of the node's parameters until the node is told to end.
///
/// # Errors
/// Why it cannot begin, or go on. The motors are off.
pub fn run(kit: &mut NodeKit) -> Result<()> {
    driver::run(kit, |device| device)
}

/// The same with something around the opened device, which the motor loop then takes for the device itself.
///
/// # Errors
/// As for [`run`].
pub fn run_with(kit: &mut NodeKit, around: impl FnOnce(Box<dyn Device>) -> Box<dyn Device>) -> Result<()> {
    driver::run(kit, around)
}
