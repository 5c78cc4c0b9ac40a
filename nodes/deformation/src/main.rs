//! The deformation model as a ROS 2 node: poses of hands in, forces on them and the surface's displacement out.
//!
//! For each pose on `measured_cp` one `servo_cf` with the same stamp, in the frame the pose came in, in order; then
//! `contact_law` and `contact_state`. At `surface.rate`, counted by stamps, `surface_displacement`; once, latched,
//! `body_mesh`. All in one thread that spins once and answers at once. The mechanics are in `rhombus_chain`.

mod counters;
mod device;
mod heard;
mod live;
mod messages;
mod model;
mod node;
mod surface;

use std::process::ExitCode;

fn main() -> ExitCode {
    node_kit::run(node_kit::Node::Deformation, node::run)
}
