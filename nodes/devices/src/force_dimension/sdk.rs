//! The maker's library: loaded at run time, so that neither building nor running without such a device needs it.
//!
//! The prototypes are our own, after the documented interface of SDK 3.16 and 3.17. A device number is a C `char`, a
//! C++ `bool` answer is one byte. A library once loaded stays: it has threads of its own.

#![expect(unsafe_code, reason = "functions of a C library that is loaded at run time")]

use std::ffi::{CStr, c_char, c_double, c_int, c_uchar, c_uint, c_ushort};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use libloading::Library;

use super::failure::Failure;

/// A device's number inside the SDK.
pub(super) type Id = c_char;

/// The oldest version whose calls and status fields are known to be those used here, and the first that is not.
const OLDEST: [c_int; 2] = [3, 16];
const UNKNOWN_MAJOR: c_int = 4;

/// More than the 17 numbers that `dhdGetStatus` writes today: a newer SDK may write more.
const STATUS_ROOM: usize = 64;

/// A table of functions, and how to find each in a library.
macro_rules! functions {
    ($name:ident { $($field:ident = $symbol:literal: fn($($argument:ty),*) $(-> $answer:ty)?;)* }) => {
        struct $name { $($field: unsafe extern "C" fn($($argument),*) $(-> $answer)?,)* }

        impl $name {
            /// The table, or the name of the first function that the library lacks.
            fn of(library: &Library) -> Result<$name, &'static str> {
                Ok($name {
                    $($field: {
                        // SAFETY: the type is the function's documented one, and the library is never unloaded, so
                        // that the pointer stays valid.
                        let symbol = unsafe {
                            library.get::<unsafe extern "C" fn($($argument),*) $(-> $answer)?>($symbol.as_bytes())
                        };
                        *symbol.map_err(|_| $symbol)?
                    },)*
                })
            }
        }
    };
}

functions! { Haptic {
    get_sdk_version = "dhdGetSDKVersion": fn(*mut c_int, *mut c_int, *mut c_int, *mut c_int);
    get_device_count = "dhdGetDeviceCount": fn() -> c_int;
    get_available_count = "dhdGetAvailableCount": fn() -> c_int;
    open_id = "dhdOpenID": fn(c_char) -> c_int;
    close = "dhdClose": fn(c_char) -> c_int;
    get_serial_number = "dhdGetSerialNumber": fn(*mut c_ushort, c_char) -> c_int;
    get_system_type = "dhdGetSystemType": fn(c_char) -> c_int;
    get_version = "dhdGetVersion": fn(*mut c_double, c_char) -> c_int;
    is_left_handed = "dhdIsLeftHanded": fn(c_char) -> u8;
    has_wrist = "dhdHasWrist": fn(c_char) -> u8;
    has_active_wrist = "dhdHasActiveWrist": fn(c_char) -> u8;
    has_gripper = "dhdHasGripper": fn(c_char) -> u8;
    has_active_gripper = "dhdHasActiveGripper": fn(c_char) -> u8;
    get_max_force = "dhdGetMaxForce": fn(c_char) -> c_double;
    get_max_torque = "dhdGetMaxTorque": fn(c_char) -> c_double;
    get_max_gripper_force = "dhdGetMaxGripperForce": fn(c_char) -> c_double;
    get_status = "dhdGetStatus": fn(*mut c_int, c_char) -> c_int;
    enable_force = "dhdEnableForce": fn(c_uchar, c_char) -> c_int;
    set_brakes = "dhdSetBrakes": fn(c_int, c_char) -> c_int;
    set_gravity_compensation = "dhdSetGravityCompensation": fn(c_int, c_char) -> c_int;
    get_position = "dhdGetPosition": fn(*mut c_double, *mut c_double, *mut c_double, c_char) -> c_int;
    get_position_and_frame = "dhdGetPositionAndOrientationFrame":
        fn(*mut c_double, *mut c_double, *mut c_double, *mut [c_double; 3], c_char) -> c_int;
    get_linear_velocity = "dhdGetLinearVelocity": fn(*mut c_double, *mut c_double, *mut c_double, c_char) -> c_int;
    get_angular_velocity = "dhdGetAngularVelocityRad":
        fn(*mut c_double, *mut c_double, *mut c_double, c_char) -> c_int;
    get_gripper_angle = "dhdGetGripperAngleRad": fn(*mut c_double, c_char) -> c_int;
    get_button_mask = "dhdGetButtonMask": fn(c_char) -> c_uint;
    set_wrench = "dhdSetForceAndTorqueAndGripperForce": fn(
        c_double, c_double, c_double, c_double, c_double, c_double, c_double, c_char) -> c_int;
    enable_expert_mode = "dhdEnableExpertMode": fn() -> c_int;
    disable_expert_mode = "dhdDisableExpertMode": fn() -> c_int;
    set_watchdog = "dhdSetWatchdog": fn(c_uchar, c_char) -> c_int;
    get_watchdog = "dhdGetWatchdog": fn(*mut c_uchar, c_char) -> c_int;
    error_get_last = "dhdErrorGetLast": fn() -> c_int;
    error_get_last_str = "dhdErrorGetLastStr": fn() -> *const c_char;
}}

functions! { Robotic {
    open_id = "drdOpenID": fn(c_char) -> c_int;
    close = "drdClose": fn(c_char) -> c_int;
    is_supported = "drdIsSupported": fn(c_char) -> u8;
    is_initialized = "drdIsInitialized": fn(c_char) -> u8;
    auto_init = "drdAutoInit": fn(c_char) -> c_int;
    stop = "drdStop": fn(bool, c_char) -> c_int;
}}

/// A loaded library. Its functions are safe to call from any thread ("thread-safe" in its documentation).
pub(super) struct Sdk {
    haptic: Haptic,
    /// The functions of libdrd; none when only libdhd was found.
    robotic: Option<Robotic>,
    path: PathBuf,
    version: [c_int; 4],
    /// Devices that this process has open: the SDK would hand them out twice.
    pub(super) open: Mutex<Vec<(Id, u16)>>,
}

/// What one reading of the position gives.
pub(super) struct Reading {
    /// m
    pub(super) position: [f64; 3],
    /// Rows of the orientation frame.
    pub(super) rows: [[f64; 3]; 3],
    /// Whether it is another than before.
    pub(super) is_new: bool,
}

const UPRIGHT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Why a file is not the SDK.
pub(super) enum Unusable {
    /// The loader's words for why it is no library.
    NotLoaded(String),
    /// What is wrong with the library.
    Refused(String),
}

impl Sdk {
    /// Loads a file, or for the system's loader a name. It stays loaded, even when refused: its threads may run.
    pub(super) fn of(path: PathBuf, is_drd: bool) -> Result<Sdk, Unusable> {
        // SAFETY: loading runs the library's initialisers; it is the file that the user or the system names as SDK.
        let library =
            unsafe { Library::new(&path) }.map_err(|error| Unusable::NotLoaded(error.to_string()))?;
        let library: &'static Library = Box::leak(Box::new(library));
        let lacks = |symbol| {
            Unusable::Refused(format!("{} has no function {symbol}: not a usable SDK", path.display()))
        };
        let haptic = Haptic::of(library).map_err(lacks)?;
        let mut version = [0; 4];
        let [major, minor, release, revision] = &mut version;
        // SAFETY: four distinct integers that outlive the call.
        unsafe { (haptic.get_sdk_version)(major, minor, release, revision) };
        let [major, minor, ..] = version;
        if [major, minor] < OLDEST || major >= UNKNOWN_MAJOR {
            return Err(Unusable::Refused(format!(
                "{} is SDK {}; accepted is 3.16 to 3.x, the versions whose calls and status fields are known to be \
                 those that this driver uses",
                path.display(),
                dotted(version)
            )));
        }
        let robotic = if is_drd { Some(Robotic::of(library).map_err(lacks)?) } else { None };
        Ok(Sdk { haptic, robotic, path, version, open: Mutex::new(Vec::new()) })
    }

    /// The file or name that it was loaded from.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// File and version, for people.
    pub(super) fn text(&self) -> String {
        format!("SDK {} ({})", dotted(self.version), self.path.display())
    }

    /// Devices on the bus, those of other programs too.
    pub(super) fn device_count(&self) -> Result<c_int, Failure> {
        // SAFETY: no arguments.
        self.check(unsafe { (self.haptic.get_device_count)() })
    }

    /// Devices on the bus that no other program has.
    pub(super) fn available_count(&self) -> Result<c_int, Failure> {
        // SAFETY: no arguments.
        self.check(unsafe { (self.haptic.get_available_count)() })
    }

    /// Opens the device with this place on the bus. The answer is its number.
    pub(super) fn open_id(&self, index: c_int) -> Result<Id, Failure> {
        let Ok(index) = Id::try_from(index) else { return Err(Failure(15)) };
        let open = self.robotic.as_ref().map_or(self.haptic.open_id, |robotic| robotic.open_id);
        // SAFETY: plain numbers.
        let id = self.check(unsafe { open(index) })?;
        Id::try_from(id).map_err(|_| Failure(15))
    }

    pub(super) fn close(&self, id: Id) {
        let close = self.robotic.as_ref().map_or(self.haptic.close, |robotic| robotic.close);
        // SAFETY: plain numbers. There is nothing to be done about a device that does not close.
        unsafe { close(id) };
    }

    pub(super) fn serial_number(&self, id: Id) -> Result<u16, Failure> {
        let mut serial = 0;
        // SAFETY: the number outlives the call.
        self.check(unsafe { (self.haptic.get_serial_number)(&raw mut serial, id) })?;
        Ok(serial)
    }

    pub(super) fn system_type(&self, id: Id) -> Result<c_int, Failure> {
        // SAFETY: plain numbers.
        self.check(unsafe { (self.haptic.get_system_type)(id) })
    }

    /// Version of the device's controller.
    pub(super) fn controller_version(&self, id: Id) -> Result<f64, Failure> {
        let mut version = 0.0;
        // SAFETY: the number outlives the call.
        self.check(unsafe { (self.haptic.get_version)(&raw mut version, id) })?;
        Ok(version)
    }

    pub(super) fn is_left_handed(&self, id: Id) -> bool {
        // SAFETY: plain numbers.
        unsafe { (self.haptic.is_left_handed)(id) != 0 }
    }

    pub(super) fn has_wrist(&self, id: Id) -> bool {
        // SAFETY: plain numbers.
        unsafe { (self.haptic.has_wrist)(id) != 0 }
    }

    pub(super) fn has_active_wrist(&self, id: Id) -> bool {
        // SAFETY: plain numbers.
        unsafe { (self.haptic.has_active_wrist)(id) != 0 }
    }

    pub(super) fn has_gripper(&self, id: Id) -> bool {
        // SAFETY: plain numbers.
        unsafe { (self.haptic.has_gripper)(id) != 0 }
    }

    pub(super) fn has_active_gripper(&self, id: Id) -> bool {
        // SAFETY: plain numbers.
        unsafe { (self.haptic.has_active_gripper)(id) != 0 }
    }

    /// Limits that the SDK holds commands to: force N, torque N m, gripper force N; negative: it does not.
    pub(super) fn max_wrench(&self, id: Id) -> [f64; 3] {
        // SAFETY: plain numbers.
        unsafe {
            [
                (self.haptic.get_max_force)(id),
                (self.haptic.get_max_torque)(id),
                (self.haptic.get_max_gripper_force)(id),
            ]
        }
    }

    /// The status numbers. RT safe.
    pub(super) fn status<const N: usize>(&self, id: Id) -> Result<[i32; N], Failure> {
        let mut status = [0; STATUS_ROOM];
        // SAFETY: room for more numbers than the SDK has, outliving the call.
        self.check(unsafe { (self.haptic.get_status)(status.as_mut_ptr(), id) })?;
        Ok(std::array::from_fn(|index| status.get(index).copied().unwrap_or_default()))
    }

    /// Motors on or off. RT safe.
    pub(super) fn enable_force(&self, id: Id, on: bool) -> Result<(), Failure> {
        // SAFETY: plain numbers.
        self.check(unsafe { (self.haptic.enable_force)(on.into(), id) }).map(drop)
    }

    /// Brakes on or off. RT safe.
    pub(super) fn set_brakes(&self, id: Id, on: bool) -> Result<(), Failure> {
        // SAFETY: plain numbers.
        self.check(unsafe { (self.haptic.set_brakes)(on.into(), id) }).map(drop)
    }

    pub(super) fn set_gravity_compensation(&self, id: Id, on: bool) -> Result<(), Failure> {
        // SAFETY: plain numbers.
        self.check(unsafe { (self.haptic.set_gravity_compensation)(on.into(), id) }).map(drop)
    }

    /// Where the handle is; without a wrist it is upright. RT safe.
    pub(super) fn reading(&self, id: Id, has_wrist: bool) -> Result<Reading, Failure> {
        let (mut position, mut rows) = ([f64::NAN; 3], [[f64::NAN; 3]; 3]);
        let [x, y, z] = &mut position;
        let answer = if has_wrist {
            // SAFETY: three numbers and a matrix, all distinct, that outlive the call.
            unsafe { (self.haptic.get_position_and_frame)(x, y, z, rows.as_mut_ptr(), id) }
        } else {
            rows = UPRIGHT;
            // SAFETY: three distinct numbers that outlive the call.
            unsafe { (self.haptic.get_position)(x, y, z, id) }
        };
        let is_new = self.check(answer)? != TIMEGUARD;
        Ok(Reading { position, rows, is_new })
    }

    /// Velocity of the handle, m/s. RT safe.
    pub(super) fn linear_velocity(&self, id: Id) -> Result<[f64; 3], Failure> {
        let mut velocity = [f64::NAN; 3];
        let [x, y, z] = &mut velocity;
        // SAFETY: three distinct numbers that outlive the call.
        self.check(unsafe { (self.haptic.get_linear_velocity)(x, y, z, id) })?;
        Ok(velocity)
    }

    /// Angular velocity of the handle, rad/s. RT safe.
    pub(super) fn angular_velocity(&self, id: Id) -> Result<[f64; 3], Failure> {
        let mut velocity = [f64::NAN; 3];
        let [x, y, z] = &mut velocity;
        // SAFETY: three distinct numbers that outlive the call.
        self.check(unsafe { (self.haptic.get_angular_velocity)(x, y, z, id) })?;
        Ok(velocity)
    }

    /// The gripper's angle with the device's own sign, rad. RT safe.
    pub(super) fn gripper_angle(&self, id: Id) -> Result<f64, Failure> {
        let mut angle = f64::NAN;
        // SAFETY: the number outlives the call.
        self.check(unsafe { (self.haptic.get_gripper_angle)(&raw mut angle, id) })?;
        Ok(angle)
    }

    /// Pressed buttons, one bit each. RT safe.
    pub(super) fn button_mask(&self, id: Id) -> u32 {
        // SAFETY: plain numbers.
        unsafe { (self.haptic.get_button_mask)(id) }
    }

    /// Force N, torque N m, and the gripper's force N with the device's own sign. RT safe.
    pub(super) fn set_wrench(
        &self,
        id: Id,
        force: [f64; 3],
        torque: [f64; 3],
        grip: f64,
    ) -> Result<(), Failure> {
        let ([fx, fy, fz], [tx, ty, tz]) = (force, torque);
        // SAFETY: plain numbers.
        self.check(unsafe { (self.haptic.set_wrench)(fx, fy, fz, tx, ty, tz, grip, id) }).map(drop)
    }

    /// Sets the controller's watchdog, in units of 125 us, and asks what it is then.
    pub(super) fn set_watchdog(&self, id: Id, units: u8) -> Result<u8, Failure> {
        // SAFETY: no arguments.
        self.check(unsafe { (self.haptic.enable_expert_mode)() })?;
        let mut now = 0;
        // SAFETY: plain numbers, and one that outlives the call.
        let answer = self
            .check(unsafe { (self.haptic.set_watchdog)(units, id) })
            .and_then(|_| self.check(unsafe { (self.haptic.get_watchdog)(&raw mut now, id) }));
        // SAFETY: no arguments. That expert mode stays on harms nothing here.
        unsafe { (self.haptic.disable_expert_mode)() };
        answer.map(|_| now)
    }

    /// Whether the library can find the device's reference position by itself.
    pub(super) fn can_home(&self, id: Id) -> bool {
        // SAFETY: plain numbers.
        self.robotic.as_ref().is_some_and(|robotic| unsafe { (robotic.is_supported)(id) != 0 })
    }

    /// Whether the device knows its reference position; none when libdrd is not there to ask. RT safe.
    pub(super) fn is_homed(&self, id: Id) -> Option<bool> {
        // SAFETY: plain numbers.
        self.robotic.as_ref().map(|robotic| unsafe { (robotic.is_initialized)(id) != 0 })
    }

    /// Moves the handle to find the reference position; returns when found. Motors and brakes are afterwards as the
    /// SDK leaves them.
    pub(super) fn home(&self, id: Id) -> Result<(), Failure> {
        let Some(robotic) = &self.robotic else { return Err(Failure(10)) };
        // SAFETY: plain numbers.
        let homed = self.check(unsafe { (robotic.auto_init)(id) }).map(drop);
        // SAFETY: plain values; without force, that is into brakes.
        let stopped = self.check(unsafe { (robotic.stop)(false, id) }).map(drop);
        homed.and(stopped)
    }

    /// The SDK's own words for the last failure in this thread. Not RT safe.
    pub(super) fn last_words(&self) -> String {
        // SAFETY: no arguments.
        let text = unsafe { (self.haptic.error_get_last_str)() };
        if text.is_null() {
            return String::new();
        }
        // SAFETY: not null, and the SDK answers with a text that ends in NUL and stays until the thread's next call.
        unsafe { CStr::from_ptr(text) }.to_string_lossy().into_owned()
    }

    /// Every answer by itself: negative is a failure; 0, 1 (old data again) and 2 (motors at their limit) are not. RT safe.
    fn check(&self, answer: c_int) -> Result<c_int, Failure> {
        if answer >= 0 {
            return Ok(answer);
        }
        // SAFETY: no arguments.
        Err(Failure(unsafe { (self.haptic.error_get_last)() }))
    }
}

/// The answer "the same data as before, because asking again so soon would be pointless".
const TIMEGUARD: c_int = 1;

fn dotted(version: [c_int; 4]) -> String {
    version.map(|part| part.to_string()).join(".")
}
