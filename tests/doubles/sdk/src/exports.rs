//! The SDK's functions by their C names. Each is called as its documentation says: with pointers that may be written to.

#![expect(unsafe_code, reason = "functions of a C library")]

use std::ffi::{c_char, c_double, c_int, c_uchar, c_uint, c_ushort};
use std::sync::atomic::{AtomicBool, Ordering::SeqCst};

use crate::link::{EXPERT_MODE_DISABLED, TIMEOUT, ask, fail, has_velocity, is_connected, last, last_error};
use crate::{Call, Reply, Request, VERSION};

/// Expert mode is the library's, not the device's.
static EXPERT: AtomicBool = AtomicBool::new(false);

fn of(call: Call, id: c_char) -> Reply {
    ask(Request::of(call, c_int::from(id)))
}

fn set(call: Call, value: f64, id: c_char) -> c_int {
    ask(Request { call, device: c_int::from(id), numbers: [value, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0] }).answer
}

/// # Safety
/// `to` may be written to.
unsafe fn put<T>(to: *mut T, value: T) {
    // SAFETY: the caller's promise.
    unsafe { to.write(value) }
}

/// # Safety
/// All three may be written to.
unsafe fn put_vector(to: [*mut c_double; 3], from: &[f64]) {
    for (to, &from) in to.into_iter().zip(from) {
        // SAFETY: the caller's promise.
        unsafe { put(to, from) };
    }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn dhdGetSDKVersion(
    major: *mut c_int,
    minor: *mut c_int,
    release: *mut c_int,
    revision: *mut c_int,
) {
    let version = if is_connected() {
        let numbers = ask(Request::of(Call::Version, 0)).numbers;
        std::array::from_fn(|part| numbers[part] as c_int)
    } else {
        VERSION
    };
    for (to, from) in [major, minor, release, revision].into_iter().zip(version) {
        // SAFETY: the SDK's contract.
        unsafe { put(to, from) };
    }
}

#[unsafe(no_mangle)]
extern "C" fn dhdGetDeviceCount() -> c_int {
    if is_connected() { ask(Request::of(Call::Count, 0)).answer } else { 0 }
}

#[unsafe(no_mangle)]
extern "C" fn dhdGetAvailableCount() -> c_int {
    if is_connected() { ask(Request::of(Call::Available, 0)).answer } else { 0 }
}

#[unsafe(no_mangle)]
extern "C" fn dhdOpenID(id: c_char) -> c_int {
    of(Call::Open, id).answer
}

#[unsafe(no_mangle)]
extern "C" fn drdOpenID(id: c_char) -> c_int {
    of(Call::Open, id).answer
}

#[unsafe(no_mangle)]
extern "C" fn dhdClose(id: c_char) -> c_int {
    of(Call::Close, id).answer
}

#[unsafe(no_mangle)]
extern "C" fn drdClose(id: c_char) -> c_int {
    of(Call::Close, id).answer
}

#[unsafe(no_mangle)]
unsafe extern "C" fn dhdGetSerialNumber(serial: *mut c_ushort, id: c_char) -> c_int {
    let reply = of(Call::Info, id);
    // SAFETY: the SDK's contract.
    unsafe { put(serial, reply.numbers[0] as c_ushort) };
    reply.answer
}

#[unsafe(no_mangle)]
extern "C" fn dhdGetSystemType(id: c_char) -> c_int {
    let reply = of(Call::Info, id);
    if reply.answer < 0 { reply.answer } else { reply.numbers[1] as c_int }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn dhdGetVersion(version: *mut c_double, id: c_char) -> c_int {
    let reply = of(Call::Info, id);
    // SAFETY: the SDK's contract.
    unsafe { put(version, reply.numbers[2]) };
    reply.answer
}

#[unsafe(no_mangle)]
extern "C" fn dhdIsLeftHanded(id: c_char) -> bool {
    of(Call::Info, id).numbers[3] != 0.0
}

#[unsafe(no_mangle)]
extern "C" fn dhdHasWrist(id: c_char) -> bool {
    of(Call::Info, id).numbers[4] != 0.0
}

#[unsafe(no_mangle)]
extern "C" fn dhdHasActiveWrist(id: c_char) -> bool {
    of(Call::Info, id).numbers[5] != 0.0
}

#[unsafe(no_mangle)]
extern "C" fn dhdHasGripper(id: c_char) -> bool {
    of(Call::Info, id).numbers[6] != 0.0
}

#[unsafe(no_mangle)]
extern "C" fn dhdHasActiveGripper(id: c_char) -> bool {
    of(Call::Info, id).numbers[7] != 0.0
}

#[unsafe(no_mangle)]
extern "C" fn dhdGetMaxForce(id: c_char) -> c_double {
    of(Call::Info, id).numbers[8]
}

#[unsafe(no_mangle)]
extern "C" fn dhdGetMaxTorque(id: c_char) -> c_double {
    of(Call::Info, id).numbers[9]
}

#[unsafe(no_mangle)]
extern "C" fn dhdGetMaxGripperForce(id: c_char) -> c_double {
    of(Call::Info, id).numbers[10]
}

#[unsafe(no_mangle)]
unsafe extern "C" fn dhdGetStatus(status: *mut c_int, id: c_char) -> c_int {
    let reply = of(Call::Status, id);
    for (index, &number) in reply.numbers.iter().take(17).enumerate() {
        // SAFETY: the SDK's contract: room for 17.
        unsafe { put(status.add(index), number as c_int) };
    }
    reply.answer
}

#[unsafe(no_mangle)]
extern "C" fn dhdEnableForce(on: c_uchar, id: c_char) -> c_int {
    set(Call::EnableForce, f64::from(on), id)
}

#[unsafe(no_mangle)]
extern "C" fn dhdSetBrakes(on: c_int, id: c_char) -> c_int {
    set(Call::Brakes, f64::from(on), id)
}

#[unsafe(no_mangle)]
extern "C" fn dhdSetGravityCompensation(on: c_int, id: c_char) -> c_int {
    set(Call::Gravity, f64::from(on), id)
}

#[unsafe(no_mangle)]
unsafe extern "C" fn dhdGetPosition(
    x: *mut c_double,
    y: *mut c_double,
    z: *mut c_double,
    id: c_char,
) -> c_int {
    let reply = of(Call::Read, id);
    // SAFETY: the SDK's contract.
    unsafe { put_vector([x, y, z], &reply.numbers) };
    reply.answer
}

#[unsafe(no_mangle)]
unsafe extern "C" fn dhdGetPositionAndOrientationFrame(
    x: *mut c_double,
    y: *mut c_double,
    z: *mut c_double,
    rows: *mut [c_double; 3],
    id: c_char,
) -> c_int {
    let reply = of(Call::Read, id);
    // SAFETY: the SDK's contract.
    unsafe { put_vector([x, y, z], &reply.numbers) };
    for (index, row) in reply.numbers[3..12].chunks_exact(3).enumerate() {
        // SAFETY: the SDK's contract: room for three rows.
        unsafe { put(rows.add(index), [row[0], row[1], row[2]]) };
    }
    reply.answer
}

/// # Safety
/// All three may be written to.
unsafe fn put_velocity(to: [*mut c_double; 3], first: usize, id: c_char) -> c_int {
    let device = c_int::from(id);
    if !has_velocity(device) {
        return fail(TIMEOUT);
    }
    // SAFETY: the caller's promise.
    unsafe { put_vector(to, &last(device)[first..first + 3]) };
    0
}

#[unsafe(no_mangle)]
unsafe extern "C" fn dhdGetLinearVelocity(
    x: *mut c_double,
    y: *mut c_double,
    z: *mut c_double,
    id: c_char,
) -> c_int {
    // SAFETY: the SDK's contract.
    unsafe { put_velocity([x, y, z], 12, id) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn dhdGetAngularVelocityRad(
    x: *mut c_double,
    y: *mut c_double,
    z: *mut c_double,
    id: c_char,
) -> c_int {
    // SAFETY: the SDK's contract.
    unsafe { put_velocity([x, y, z], 15, id) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn dhdGetGripperAngleRad(angle: *mut c_double, id: c_char) -> c_int {
    // SAFETY: the SDK's contract.
    unsafe { put(angle, last(c_int::from(id))[18]) };
    0
}

#[unsafe(no_mangle)]
extern "C" fn dhdGetButtonMask(id: c_char) -> c_uint {
    last(c_int::from(id))[19] as c_uint
}

#[unsafe(no_mangle)]
extern "C" fn dhdSetForceAndTorqueAndGripperForce(
    fx: c_double,
    fy: c_double,
    fz: c_double,
    tx: c_double,
    ty: c_double,
    tz: c_double,
    grip: c_double,
    id: c_char,
) -> c_int {
    let numbers = [fx, fy, fz, tx, ty, tz, grip];
    ask(Request { call: Call::Wrench, device: c_int::from(id), numbers }).answer
}

#[unsafe(no_mangle)]
extern "C" fn dhdEnableExpertMode() -> c_int {
    EXPERT.store(true, SeqCst);
    0
}

#[unsafe(no_mangle)]
extern "C" fn dhdDisableExpertMode() -> c_int {
    EXPERT.store(false, SeqCst);
    0
}

#[unsafe(no_mangle)]
extern "C" fn dhdSetWatchdog(units: c_uchar, id: c_char) -> c_int {
    if EXPERT.load(SeqCst) {
        set(Call::SetWatchdog, f64::from(units), id)
    } else {
        fail(EXPERT_MODE_DISABLED)
    }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn dhdGetWatchdog(units: *mut c_uchar, id: c_char) -> c_int {
    if !EXPERT.load(SeqCst) {
        return fail(EXPERT_MODE_DISABLED);
    }
    let reply = of(Call::GetWatchdog, id);
    // SAFETY: the SDK's contract.
    unsafe { put(units, reply.numbers[0] as c_uchar) };
    reply.answer
}

#[unsafe(no_mangle)]
extern "C" fn dhdErrorGetLast() -> c_int {
    last_error()
}

#[unsafe(no_mangle)]
extern "C" fn dhdErrorGetLastStr() -> *const c_char {
    match last_error() {
        0 => c"no error",
        2 => c"communication error",
        7 => c"timeout",
        20 => c"device already in use",
        _ => c"error",
    }
    .as_ptr()
}

#[unsafe(no_mangle)]
extern "C" fn drdIsSupported(id: c_char) -> bool {
    of(Call::Supported, id).numbers[0] != 0.0
}

#[unsafe(no_mangle)]
extern "C" fn drdIsInitialized(id: c_char) -> bool {
    of(Call::Initialized, id).numbers[0] != 0.0
}

#[unsafe(no_mangle)]
extern "C" fn drdAutoInit(id: c_char) -> c_int {
    of(Call::AutoInit, id).answer
}

#[unsafe(no_mangle)]
extern "C" fn drdStop(force: bool, id: c_char) -> c_int {
    set(Call::Stop, f64::from(u8::from(force)), id)
}
