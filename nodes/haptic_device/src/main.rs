//! The driver of one haptic device: its poses, velocities and forces to ROS 2, forces and contact laws from ROS 2 to its
//! motors.
//!
//! Three threads. The motor loop (crate `devices`) reads and commands the device and knows no ROS. The publisher thread
//! sleeps until the motor loop has a sample and publishes it at once, because a spin cannot be woken and publishing may
//! block. This thread owns the node: it spins, takes forces and laws, and hands the newest to the motor loop.

mod answers;
mod backend;
mod driver;
mod law_message;
mod press_sites;
mod publisher;
mod report;
mod stability_watch;

use std::process::ExitCode;

fn main() -> ExitCode {
    node_kit::run(node_kit::Node::HapticDevice, driver::run)
}
