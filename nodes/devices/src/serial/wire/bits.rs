//! What single bits and numbers of the messages mean.

/// Bits of [`Hello::capabilities`](super::Hello::capabilities).
pub mod capability {
    /// It has motors for a force.
    pub const FORCE: u32 = 1;
    /// It has motors for a torque.
    pub const TORQUE: u32 = 1 << 1;
    /// It measures its orientation.
    pub const ORIENTATION: u32 = 1 << 2;
    /// It measures the opening of a gripper.
    pub const GRIPPER: u32 = 1 << 3;
    /// The gripper has a motor.
    pub const GRIPPER_FORCE: u32 = 1 << 4;
    /// Positions mean something only after homing.
    pub const NEEDS_HOMING: u32 = 1 << 5;
    /// It can carry its own weight.
    pub const GRAVITY_COMPENSATION: u32 = 1 << 6;
}

/// Bits of [`Command::flags`](super::Command::flags).
pub mod command_flag {
    /// Motors on. A device that has switched them off itself wants to see a command without it first.
    pub const MOTORS_ON: u8 = 1;
    /// Find the reference position; begins when it appears, ends early when it goes.
    pub const HOME: u8 = 1 << 1;
    /// Carry the device's own weight.
    pub const GRAVITY_COMPENSATION: u8 = 1 << 2;
}

/// Bits of [`State::flags`](super::State::flags).
pub mod state_flag {
    /// The motors are on.
    pub const MOTORS_ON: u8 = 1;
    /// The position is referenced.
    pub const HOMED: u8 = 1 << 1;
    /// It is finding its reference position.
    pub const HOMING: u8 = 1 << 2;
    /// At least one command came since the hello: the echo means something.
    pub const COMMANDED: u8 = 1 << 3;
}

/// Why the motors are off: the values of [`State::cause`](super::State::cause).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Cause {
    /// They are on, or were never asked to be.
    None = 0,
    /// A command said so.
    Command = 1,
    /// No command came in time.
    Watchdog = 2,
    /// The handle was too fast.
    Velocity = 3,
    /// A force button is not pressed.
    Button = 4,
    /// The dead man's switch was released.
    DeadMan = 5,
    /// The device's emergency stop.
    Emergency = 6,
    /// Anything else.
    Other = 255,
}
