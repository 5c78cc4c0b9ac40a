//! What each function of the SDK does to a device, and what it answers.

use std::io;
use std::time::Duration;

use rhombus_doubles::monotonic_ns;
use rhombus_sdk_double::{Call, Reply, Request};

use crate::bus::Bus;
use crate::hardware::{Garbage, Hardware, Mode};
use crate::{Shared, lock};

/// Error numbers of the SDK.
const ERROR: i32 = 1;
const COM: i32 = 2;
const NOT_AVAILABLE: i32 = 6;
const INVALID_INDEX: i32 = 15;
const DEVICE_IN_USE: i32 = 20;

/// The answer of "the motors cannot do all of it", which is a success.
const MOTOR_SATURATED: i32 = 2;
/// And of "the same data as before".
const TIMEGUARD: i32 = 1;

/// The controller's version that all devices have.
const CONTROLLER: f64 = 3.2;

pub(crate) fn answer(shared: &Shared, program: u64, request: &Request) -> Reply {
    if request.call == Call::AutoInit {
        return home(shared, program, request.device);
    }
    let mut bus = lock(shared);
    match request.call {
        Call::Version => Reply::of(0, &bus.version.map(f64::from)),
        Call::Count => Reply::of(bus.counts(program).0 as i32, &[]),
        Call::Available => Reply::of(bus.counts(program).1 as i32, &[]),
        Call::Open => open(&mut bus, program, request.device),
        _ => with(&mut bus, program, request.device, |hardware| one(hardware, request)),
    }
}

fn open(bus: &mut Bus, program: u64, place: i32) -> Reply {
    let Some(number) = bus.at(place) else { return Reply::failure(INVALID_INDEX) };
    let hardware = &mut bus.devices[number];
    if let Some(code) = hardware.device.refuse {
        return Reply::failure(code);
    }
    if hardware.opened_by.is_some_and(|by| by != program) {
        return Reply::failure(DEVICE_IN_USE);
    }
    hardware.opened_by = Some(program);
    Reply::of(number as i32, &[])
}

/// Does something with a device that this program has open.
fn with(
    bus: &mut Bus,
    program: u64,
    device: i32,
    act: impl FnOnce(&mut Hardware) -> io::Result<Reply>,
) -> Reply {
    let hardware = usize::try_from(device).ok().and_then(|device| bus.devices.get_mut(device));
    match hardware {
        None => Reply::failure(INVALID_INDEX),
        Some(hardware) if !hardware.plugged => Reply::failure(COM),
        Some(hardware) if hardware.opened_by != Some(program) => Reply::failure(INVALID_INDEX),
        // A record that cannot be written fails the call, so that no test passes without its record.
        Some(hardware) => act(hardware).unwrap_or_else(|_| Reply::failure(ERROR)),
    }
}

fn one(hardware: &mut Hardware, request: &Request) -> io::Result<Reply> {
    let (now_ns, value) = (monotonic_ns(), request.numbers[0]);
    let on = value != 0.0;
    Ok(match request.call {
        Call::Close => {
            hardware.opened_by = None;
            Reply::of(0, &[])
        }
        Call::Info => Reply::of(0, &info(hardware)),
        Call::Status => Reply::of(0, &status(hardware)),
        Call::EnableForce => {
            hardware.enable_force(now_ns, on)?;
            Reply::of(0, &[])
        }
        Call::Brakes => {
            hardware.set_brakes(now_ns, on)?;
            Reply::of(0, &[])
        }
        Call::Gravity => {
            hardware.gravity = on;
            Reply::of(0, &[])
        }
        Call::Read if hardware.device.garbage == Garbage::Silent => Reply::failure(COM),
        Call::Read => {
            let (numbers, is_new) = hardware.reading();
            Reply::of(if is_new { 0 } else { TIMEGUARD }, &numbers)
        }
        Call::Wrench => {
            let in_full = hardware.command(now_ns, &request.numbers)?;
            Reply::of(if in_full { 0 } else { MOTOR_SATURATED }, &[])
        }
        Call::SetWatchdog if hardware.set_watchdog(value as u8) => Reply::of(0, &[]),
        Call::SetWatchdog => Reply::failure(NOT_AVAILABLE),
        Call::GetWatchdog => Reply::of(0, &[f64::from(hardware.watchdog())]),
        Call::Supported => Reply::of(0, &[flag(hardware.device.kind.number != 60)]),
        Call::Initialized => Reply::of(0, &[flag(hardware.device.homed)]),
        Call::Stop if on => Reply::of(0, &[]),
        Call::Stop => {
            hardware.set_brakes(now_ns, true)?;
            Reply::of(0, &[])
        }
        // Not of one device.
        Call::Version | Call::Count | Call::Available | Call::Open | Call::AutoInit => {
            Reply::failure(INVALID_INDEX)
        }
    })
}

/// Regulates the handle to its reference for a while. As with the SDK, the motors are on afterwards. The watchdog is not:
/// a driver must not rely on the SDK to put back what its own regulation does without.
fn home(shared: &Shared, program: u64, device: i32) -> Reply {
    let began = with(&mut lock(shared), program, device, |hardware| {
        hardware.enable_force(monotonic_ns(), true)?;
        let device = &hardware.device;
        Ok(Reply::of(0, &[device.homing_s, flag(device.homing_fails)]))
    });
    if began.answer < 0 {
        return began;
    }
    let end_ns = monotonic_ns() + (began.numbers[0] * 1e9) as u64;
    while monotonic_ns() < end_ns {
        std::thread::sleep(Duration::from_millis(2));
        let held = with(&mut lock(shared), program, device, |hardware| {
            hardware.command(monotonic_ns(), &[0.0; 7]).map(|_| Reply::of(0, &[]))
        });
        if held.answer < 0 {
            return held;
        }
    }
    if began.numbers[1] != 0.0 {
        return Reply::failure(ERROR);
    }
    with(&mut lock(shared), program, device, |hardware| {
        hardware.set_watchdog(0);
        hardware.device.homed = true;
        Ok(Reply::of(0, &[]))
    })
}

fn flag(on: bool) -> f64 {
    f64::from(u8::from(on))
}

fn info(hardware: &Hardware) -> [f64; 11] {
    let (device, kind) = (&hardware.device, hardware.device.kind);
    let [force, torque, grip] = device.max_wrench;
    [
        f64::from(device.serial),
        f64::from(kind.number),
        CONTROLLER,
        flag(kind.left),
        flag(kind.wrist),
        flag(kind.active_wrist),
        flag(kind.gripper),
        flag(kind.gripper),
        force,
        torque,
        grip,
    ]
}

fn status(hardware: &Hardware) -> [f64; 17] {
    let (device, kind) = (&hardware.device, hardware.device.kind);
    let force = hardware.are_motors_on();
    [
        1.0,
        1.0,
        1.0,
        flag(!device.homed),
        flag(hardware.mode == Mode::Idle),
        flag(force),
        flag(hardware.mode == Mode::Brake),
        flag(force && kind.active_wrist),
        flag(kind.wrist),
        0.0,
        flag(hardware.gravity),
        0.0,
        1.0,
        0.0,
        f64::from(hardware.cause),
        0.0,
        flag(device.homed),
    ]
}
