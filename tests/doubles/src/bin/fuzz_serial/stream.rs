//! What a device, a bad line and a liar send.

use devices::serial::wire::{Frame, Hello, PROTOCOL_VERSION, State, capability, state_flag};
use fastrand::Rng;

/// A stream that begins as a device's does, mostly, and goes wrong somewhere, mostly.
pub(crate) fn stream(random: &mut Rng) -> Vec<u8> {
    let joints = random.u8(0..=8);
    let mut bytes = Vec::new();
    if random.u8(0..4) == 0 {
        noise(random, &mut bytes);
    }
    let hellos = if random.u8(0..10) == 0 { 0 } else { random.usize(1..4) };
    for _ in 0..hellos {
        bytes.extend(hello(random, joints).frame().bytes());
    }
    let mut state = State { sequence: random.u16(..), time_us: random.u32(..), ..State::default() };
    for _ in 0..random.usize(0..60) {
        next_state(random, &mut state);
        let joints = if random.u8(0..30) == 0 { random.usize(0..9) } else { usize::from(joints) };
        bytes.extend(state.frame(joints).bytes());
        if random.u8(0..20) == 0 {
            bytes.extend(liar(random).bytes());
        }
    }
    for _ in 0..random.usize(0..8) {
        mutate(random, &mut bytes);
    }
    bytes
}

fn hello(random: &mut Rng, joints: u8) -> Hello {
    let mut hello = Hello {
        version: PROTOCOL_VERSION,
        buttons: random.u8(0..=16),
        joints,
        capabilities: random.u32(..) | if random.u8(0..8) > 0 { capability::FORCE } else { 0 },
        watchdog_ms: 20,
        state_rate_hz: random.u16(..),
        max_force_n: 20.0,
        max_torque_n_m: 0.5,
        max_gripper_force_n: 8.0,
        workspace_centre_m: [0.0; 3],
        workspace_radius_m: 0.1,
        workspace_height_m: 0.1,
        model: Hello::name("Fuzz"),
        serial: Hello::name("1"),
        firmware: Hello::name("0"),
    };
    // Mostly a torque without an orientation would end the conversation.
    if random.u8(0..16) > 0 {
        hello.capabilities |= capability::ORIENTATION;
    }
    match random.u8(0..24) {
        0 => hello.version = random.u8(..),
        1 => hello.buttons = random.u8(..),
        2 => hello.joints = random.u8(..),
        3 => hello.watchdog_ms = random.u16(..),
        4 => hello.max_force_n = any_float(random),
        5 => hello.max_torque_n_m = any_float(random),
        6 => hello.max_gripper_force_n = any_float(random),
        7 => hello.workspace_centre_m[random.usize(0..3)] = any_float(random),
        8 => hello.workspace_radius_m = any_float(random),
        9 => hello.serial[random.usize(0..32)] = random.u8(..),
        _ => {}
    }
    hello
}

fn next_state(random: &mut Rng, state: &mut State) {
    let odd = random.u8(0..40);
    state.sequence = if odd == 0 { random.u16(..) } else { state.sequence.wrapping_add(1) };
    state.time_us = if odd == 1 { random.u32(..) } else { state.time_us.wrapping_add(1000) };
    state.flags = random.u8(..) | if random.u8(0..4) > 0 { state_flag::HOMED } else { 0 };
    state.cause = random.u8(..);
    state.lost_commands = random.u8(..);
    state.command_sequence = random.u16(0..20);
    state.command_age_us = random.u16(..);
    state.buttons = random.u16(..);
    state.orientation = [0.0, 0.0, 0.6, 0.8];
    state.position_m = [0.0; 3].map(|_: f32| random.f32());
    state.gripper_rad = random.f32();
    match odd {
        2 => state.orientation[random.usize(0..4)] = any_float(random),
        3 => state.position_m[random.usize(0..3)] = any_float(random),
        4 => state.linear_velocity_m_per_s[random.usize(0..3)] = any_float(random),
        5 => state.angular_velocity_rad_per_s[random.usize(0..3)] = any_float(random),
        6 => state.gripper_rad = any_float(random),
        7 => state.joints[random.usize(0..8)] = any_float(random),
        _ => {}
    }
}

/// NaN, infinities, zeros, denormals: whatever bits there are.
fn any_float(random: &mut Rng) -> f32 {
    match random.u8(0..6) {
        0 => f32::NAN,
        1 => f32::INFINITY,
        2 => -1.0,
        3 => 0.0,
        _ => f32::from_bits(random.u32(..)),
    }
}

/// A right frame around any payload.
fn liar(random: &mut Rng) -> Frame {
    let mut payload = [0; 251];
    random.fill(&mut payload);
    payload[0] = if random.bool() { random.u8(..) } else { 0x81 + random.u8(0..2) };
    let length = match random.u8(0..4) {
        0 => 140,
        1 => 72 + 4 * random.usize(0..9),
        _ => random.usize(1..=251),
    };
    // A payload of 1 to 251 bytes always fits.
    Frame::new(&payload[..length]).unwrap_or_else(|| State::default().frame(0))
}

fn noise(random: &mut Rng, bytes: &mut Vec<u8>) {
    let zeros = random.u8(1..=255);
    for _ in 0..random.usize(1..700) {
        bytes.push(if random.u8(..) < zeros / 16 { 0 } else { random.u8(..) });
    }
}

fn mutate(random: &mut Rng, bytes: &mut Vec<u8>) {
    if bytes.is_empty() {
        return noise(random, bytes);
    }
    let at = random.usize(0..bytes.len());
    let end = (at + random.usize(0..200)).min(bytes.len());
    match random.u8(0..10) {
        0 => bytes[at] ^= 1 << random.u8(0..8),
        1 => bytes[at] = random.u8(..),
        2 => bytes[at] = 0,
        3 => bytes.insert(at, random.u8(..)),
        4 => drop(bytes.drain(at..end)),
        5 => bytes.extend_from_within(at..end),
        6 => bytes.rotate_left(at),
        7 => bytes.truncate(at.max(1)),
        8 => {
            let mut more = Vec::new();
            noise(random, &mut more);
            bytes.splice(at..at, more);
        }
        _ => bytes[at..end].iter_mut().for_each(|byte| *byte = byte.rotate_left(3)),
    }
}
