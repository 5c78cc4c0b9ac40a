//! The process of the driver: `haptic_device`. However it ends, short of SIGKILL, the motors go off first.

use std::process::ExitCode;

use node_kit::ForcedExit;

fn main() -> ExitCode {
    node_kit::before_forced_exit(ForcedExit {
        prepare: devices::motors_off_at_once,
        unwinds: devices::is_motor_loop,
    });
    node_kit::run(node_kit::Node::HapticDevice, haptic_device::run)
}
