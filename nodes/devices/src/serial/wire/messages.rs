//! The four messages. Little endian, every field at a fixed place.

use super::Frame;
use super::fields::{Fields, Payload};

/// The version of the protocol that this is.
pub const PROTOCOL_VERSION: u8 = 1;
/// Length of a name in [`Hello`], filled up with zeros.
pub const NAME_LENGTH: usize = 32;
/// Bytes of a command on the line: the payload and four of framing.
pub const COMMAND_FRAME: usize = COMMAND + 4;

const HELLO_REQUEST_TYPE: u8 = 0x01;
const COMMAND_TYPE: u8 = 0x02;
const HELLO_TYPE: u8 = 0x81;
const STATE_TYPE: u8 = 0x82;

const COMMAND: usize = 32;
const STATE_JOINTS: usize = 8;

/// Host to device: who are you? Switches the motors off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HelloRequest {
    /// The version the host speaks.
    pub version: u8,
}

/// Host to device: the wrench on the hand, and what else is wanted. Complete each time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Command {
    /// Bits of [`command_flag`](super::command_flag).
    pub flags: u8,
    /// One more than that of the command before.
    pub sequence: u16,
    /// Force on the hand, N.
    pub force_n: [f32; 3],
    /// Torque on the hand, N m.
    pub torque_n_m: [f32; 3],
    /// Force of the gripper, N; positive opens.
    pub gripper_force_n: f32,
}

/// Device to host: what it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hello {
    /// The version it speaks.
    pub version: u8,
    /// How many buttons, at most 16.
    pub buttons: u8,
    /// How many joints are reported, at most 8.
    pub joints: u8,
    /// Bits of [`capability`](super::capability).
    pub capabilities: u32,
    /// After this time without a command the force is off, ms.
    pub watchdog_ms: u16,
    /// States sent in a second, as meant.
    pub state_rate_hz: u16,
    /// Largest force, N.
    pub max_force_n: f32,
    /// Largest torque, N m.
    pub max_torque_n_m: f32,
    /// Largest gripper force, N.
    pub max_gripper_force_n: f32,
    /// Middle of the workspace in the device frame, m.
    pub workspace_centre_m: [f32; 3],
    /// Its radius about z, m.
    pub workspace_radius_m: f32,
    /// Its height along z, m.
    pub workspace_height_m: f32,
    /// Name of the model, printable ASCII.
    pub model: [u8; NAME_LENGTH],
    /// Serial number, printable ASCII.
    pub serial: [u8; NAME_LENGTH],
    /// Version of the firmware, printable ASCII.
    pub firmware: [u8; NAME_LENGTH],
}

/// Device to host: the handle now.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct State {
    /// Bits of [`state_flag`](super::state_flag).
    pub flags: u8,
    /// A value of [`Cause`](super::Cause).
    pub cause: u8,
    /// Commands that never came, by the gaps in their sequence, modulo 256.
    pub lost_commands: u8,
    /// One more than that of the state before.
    pub sequence: u16,
    /// Sequence of the newest command.
    pub command_sequence: u16,
    /// The device's clock, us, modulo 2^32.
    pub time_us: u32,
    /// Time since the newest command came, us; 65535 and above are 65535.
    pub command_age_us: u16,
    /// Pressed buttons, one bit each.
    pub buttons: u16,
    /// Position of the handle in the device frame, m.
    pub position_m: [f32; 3],
    /// Orientation of the handle in the device frame, x y z w.
    pub orientation: [f32; 4],
    /// Velocity of the handle, m/s.
    pub linear_velocity_m_per_s: [f32; 3],
    /// Angular velocity of the handle in the device frame, rad/s.
    pub angular_velocity_rad_per_s: [f32; 3],
    /// Opening of the gripper, rad.
    pub gripper_rad: f32,
    /// Joint positions, rad or m; the first [`Hello::joints`] of them travel.
    pub joints: [f32; STATE_JOINTS],
}

/// What a payload says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Message {
    /// Host to device.
    HelloRequest(HelloRequest),
    /// Host to device.
    Command(Command),
    /// Device to host.
    Hello(Hello),
    /// Device to host, with the number of joints that came.
    State(State, usize),
}

/// Why a payload with a right checksum says nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WrongMessage {
    /// A hello of another version, whose layout is not known.
    Version(u8),
    /// Not the length that its type has.
    Length,
    /// No type of this version.
    Type,
}

impl Message {
    /// # Errors
    /// Says why a payload is no message of this version.
    pub fn decode(payload: &[u8]) -> Result<Message, WrongMessage> {
        let mut fields = Fields::new(payload);
        let kind = fields.u8()?;
        let message = match kind {
            HELLO_REQUEST_TYPE => Message::HelloRequest(HelloRequest { version: fields.u8()? }),
            COMMAND_TYPE => Message::Command(Command {
                flags: fields.u8()?,
                sequence: fields.u16()?,
                force_n: fields.f32s()?,
                torque_n_m: fields.f32s()?,
                gripper_force_n: fields.f32()?,
            }),
            HELLO_TYPE => Message::Hello(Hello::decode(&mut fields)?),
            STATE_TYPE => State::decode(&mut fields)?,
            _ => return Err(WrongMessage::Type),
        };
        if fields.is_empty() { Ok(message) } else { Err(WrongMessage::Length) }
    }
}

impl HelloRequest {
    /// Ready to send.
    pub fn frame(&self) -> Frame {
        let mut payload = Payload::new(HELLO_REQUEST_TYPE);
        payload.put(&[self.version]);
        payload.framed()
    }
}

impl Command {
    /// Ready to send.
    pub fn frame(&self) -> Frame {
        let mut payload = Payload::new(COMMAND_TYPE);
        payload.put(&[self.flags]);
        payload.put(&self.sequence.to_le_bytes());
        payload.floats(&self.force_n);
        payload.floats(&self.torque_n_m);
        payload.floats(&[self.gripper_force_n]);
        payload.framed()
    }
}

impl Hello {
    /// Ready to send.
    pub fn frame(&self) -> Frame {
        let mut payload = Payload::new(HELLO_TYPE);
        payload.put(&[self.version, self.buttons, self.joints]);
        payload.put(&self.capabilities.to_le_bytes());
        payload.put(&self.watchdog_ms.to_le_bytes());
        payload.put(&self.state_rate_hz.to_le_bytes());
        payload.floats(&[self.max_force_n, self.max_torque_n_m, self.max_gripper_force_n]);
        payload.floats(&self.workspace_centre_m);
        payload.floats(&[self.workspace_radius_m, self.workspace_height_m]);
        for name in [&self.model, &self.serial, &self.firmware] {
            payload.put(name);
        }
        payload.framed()
    }

    /// A name as [`Hello`] holds it, cut to its length.
    pub fn name(text: &str) -> [u8; NAME_LENGTH] {
        let mut name = [0; NAME_LENGTH];
        let length = text.len().min(NAME_LENGTH);
        name[..length].copy_from_slice(&text.as_bytes()[..length]);
        name
    }

    fn decode(fields: &mut Fields<'_>) -> Result<Hello, WrongMessage> {
        let version = fields.u8()?;
        if version != PROTOCOL_VERSION {
            return Err(WrongMessage::Version(version));
        }
        Ok(Hello {
            version,
            buttons: fields.u8()?,
            joints: fields.u8()?,
            capabilities: u32::from_le_bytes(fields.bytes()?),
            watchdog_ms: fields.u16()?,
            state_rate_hz: fields.u16()?,
            max_force_n: fields.f32()?,
            max_torque_n_m: fields.f32()?,
            max_gripper_force_n: fields.f32()?,
            workspace_centre_m: fields.f32s()?,
            workspace_radius_m: fields.f32()?,
            workspace_height_m: fields.f32()?,
            model: fields.bytes()?,
            serial: fields.bytes()?,
            firmware: fields.bytes()?,
        })
    }
}

impl State {
    /// Ready to send, with the first `joints` joints; at most 8 of them.
    pub fn frame(&self, joints: usize) -> Frame {
        let joints = joints.min(STATE_JOINTS);
        let mut payload = Payload::new(STATE_TYPE);
        payload.put(&[self.flags, self.cause, self.lost_commands]);
        payload.put(&self.sequence.to_le_bytes());
        payload.put(&self.command_sequence.to_le_bytes());
        payload.put(&self.time_us.to_le_bytes());
        payload.put(&self.command_age_us.to_le_bytes());
        payload.put(&self.buttons.to_le_bytes());
        payload.floats(&self.position_m);
        payload.floats(&self.orientation);
        payload.floats(&self.linear_velocity_m_per_s);
        payload.floats(&self.angular_velocity_rad_per_s);
        payload.floats(&[self.gripper_rad]);
        payload.floats(&self.joints[..joints]);
        payload.framed()
    }

    fn decode(fields: &mut Fields<'_>) -> Result<Message, WrongMessage> {
        let mut state = State {
            flags: fields.u8()?,
            cause: fields.u8()?,
            lost_commands: fields.u8()?,
            sequence: fields.u16()?,
            command_sequence: fields.u16()?,
            time_us: u32::from_le_bytes(fields.bytes()?),
            command_age_us: fields.u16()?,
            buttons: fields.u16()?,
            position_m: fields.f32s()?,
            orientation: fields.f32s()?,
            linear_velocity_m_per_s: fields.f32s()?,
            angular_velocity_rad_per_s: fields.f32s()?,
            gripper_rad: fields.f32()?,
            joints: [0.0; STATE_JOINTS],
        };
        let mut joints = 0;
        while !fields.is_empty() {
            *state.joints.get_mut(joints).ok_or(WrongMessage::Length)? = fields.f32()?;
            joints += 1;
        }
        Ok(Message::State(state, joints))
    }
}
