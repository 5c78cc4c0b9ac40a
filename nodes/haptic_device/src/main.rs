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
mod forces;
mod freshness;
mod law_message;
mod lifecycle;
mod motor_settings;
mod now;
mod operating_report;
mod operating_state;
mod outbox;
mod press_sites;
mod publisher;
mod report;
mod shared;
mod sources;
mod stability_watch;
mod wrench_frame;

use std::process::ExitCode;

fn main() -> ExitCode {
    node_kit::run(node_kit::Node::HapticDevice, driver::run)
}
