//! One run, and what must hold in it.

use std::fmt;
use std::ops::AddAssign;
use std::sync::PoisonError;

use devices::serial::SerialDevice;
use devices::serial::wire::{Command, HelloRequest, Message, Receiver, command_flag};
use devices::{Description, Device, DeviceState, Wrench};
use fastrand::Rng;
use glam::DVec3;

use crate::memory_line::MemoryLine;
use crate::oracle;
use crate::stream;

/// What happened in a number of runs.
#[derive(Clone, Copy, Default)]
pub(crate) struct Tally {
    bytes: u64,
    frames: u64,
    bad_frames: u64,
    opened: u64,
    states: u64,
    commands: u64,
}

impl AddAssign for Tally {
    fn add_assign(&mut self, more: Tally) {
        self.bytes += more.bytes;
        self.frames += more.frames;
        self.bad_frames += more.bad_frames;
        self.opened += more.opened;
        self.states += more.states;
        self.commands += more.commands;
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Tally { bytes, frames, bad_frames, opened, states, commands } = self;
        write!(
            f,
            "{bytes} bytes, {frames} valid frames, {bad_frames} broken ones, {opened} devices opened, {states} states \
             read, {commands} commands sent; every invariant held"
        )
    }
}

/// One run.
pub(crate) fn run(seed: u64) -> Result<Tally, String> {
    let mut random = Rng::with_seed(seed);
    let bytes = stream::stream(&mut random);
    let mut tally = Tally { bytes: bytes.len() as u64, ..Tally::default() };
    decoder(&mut random, &bytes, &mut tally)?;
    device(&mut random, bytes, &mut tally)?;
    Ok(tally)
}

/// The decoder alone, with a valid frame at the end.
fn decoder(random: &mut Rng, bytes: &[u8], tally: &mut Tally) -> Result<(), String> {
    let last = HelloRequest { version: random.u8(..) }.frame();
    let mut stream = bytes.to_vec();
    stream.push(0);
    stream.extend(last.bytes());
    let mut receiver = Receiver::default();
    let mut found = Vec::new();
    let mut rest = &stream[..];
    while !rest.is_empty() {
        let (mut piece, after) = rest.split_at(random.usize(1..=rest.len().min(300)));
        rest = after;
        while let Some(frame) = receiver.next(&mut piece) {
            if let Ok(payload) = frame {
                // Whatever it says; it must not panic.
                let _ = Message::decode(payload);
            }
            found.push(frame.ok().map(<[u8]>::to_vec));
        }
    }
    let wanted = oracle::frames(&stream);
    tally.frames += wanted.iter().flatten().count() as u64;
    tally.bad_frames += wanted.iter().filter(|frame| frame.is_none()).count() as u64;
    if found != wanted {
        return Err(format!("the decoder found {found:?}, there is {wanted:?}"));
    }
    match oracle::frames(last.bytes()).first() == found.last() {
        true => Ok(()),
        false => Err("the valid frame at the end was not found".to_owned()),
    }
}

/// The whole backend: hello, and then whatever a motor loop may do.
fn device(random: &mut Rng, bytes: Vec<u8>, tally: &mut Tally) -> Result<(), String> {
    let (line, written) = MemoryLine::new(bytes, random);
    let mut wrenches = vec![Wrench::ZERO];
    let mut was_enabled = false;
    if let Ok(mut device) = SerialDevice::greet(line, "memory") {
        tally.opened += 1;
        described(device.description())?;
        let mut last: Option<DeviceState> = None;
        let mut number = 0;
        for _ in 0..random.usize(0..60) {
            match random.u8(0..24) {
                0 => {
                    was_enabled = true;
                    drop(device.enable());
                }
                1 => drop(device.disable()),
                2 => drop(device.set_gravity_compensation(random.bool())),
                3 if random.u8(0..8) == 0 => drop(device.home()),
                4..12 => {
                    number += 1;
                    let wrench = Wrench::of_force(DVec3::new(f64::from(number), 0.5, 0.0));
                    wrenches.push(wrench);
                    drop(device.command(&wrench));
                }
                _ => {
                    if let Ok(state) = device.read() {
                        tally.states += 1;
                        believed(&state, last.as_ref())?;
                        last = Some(state);
                    }
                }
            }
        }
    }
    let written = written.lock().unwrap_or_else(PoisonError::into_inner);
    tally.commands += sent(&written, &wrenches, was_enabled)?;
    Ok(())
}

fn described(description: &Description) -> Result<(), String> {
    let limits = &description.limits;
    let of_motors = [limits.max_force_n, limits.max_torque_n_m, limits.max_gripper_force_n];
    let sizes = [limits.workspace.radius_m, limits.workspace.height_m];
    let all = of_motors.into_iter().flatten().chain(sizes);
    let watched = of_motors.iter().all(Option::is_none) || description.watchdog.is_some();
    match all.into_iter().all(|limit| limit.is_finite() && limit > 0.0)
        && limits.workspace.centre.is_finite()
        && description.buttons.len() <= 16
        && description.joints.len() <= 8
        && watched
    {
        true => Ok(()),
        false => Err(format!("a device was opened that is none: {description:?}")),
    }
}

fn believed(state: &DeviceState, last: Option<&DeviceState>) -> Result<(), String> {
    let in_order = last.is_none_or(|last| state.device_time_ns >= last.device_time_ns);
    match state.is_finite() && state.pose.rotation.is_normalized() && in_order {
        true => Ok(()),
        false => Err(format!("read {state:?} after {last:?}")),
    }
}

/// Everything that was sent: whole frames, in sequence, with wrenches that were commanded. How many commands.
fn sent(written: &[u8], wrenches: &[Wrench], was_enabled: bool) -> Result<u64, String> {
    let mut commands = Vec::new();
    for frame in oracle::frames(written) {
        let payload = frame.as_deref().ok_or("a broken frame was sent")?;
        match Message::decode(payload) {
            Ok(Message::HelloRequest(_)) if commands.is_empty() => {}
            Ok(Message::Command(command)) => commands.push(command),
            other => return Err(format!("{other:?} was sent")),
        }
    }
    if commands.windows(2).any(|pair| pair[1].sequence <= pair[0].sequence) {
        return Err("commands were sent out of order".to_owned());
    }
    for Command { flags, force_n, torque_n_m, gripper_force_n, sequence } in &commands {
        let force = DVec3::from_array(force_n.map(f64::from));
        let known = wrenches.iter().any(|wrench| wrench.force_n == force);
        let on = flags & command_flag::MOTORS_ON != 0;
        if !known || *torque_n_m != [0.0; 3] || *gripper_force_n != 0.0 {
            return Err(format!("command {sequence} gives a force that nobody commanded: {force}"));
        }
        if (on && !was_enabled) || (!on && force != DVec3::ZERO) {
            return Err(format!("command {sequence}: motors {on}, enabled {was_enabled}, force {force}"));
        }
    }
    Ok(commands.len() as u64)
}
