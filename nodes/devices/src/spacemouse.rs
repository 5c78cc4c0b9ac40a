//! SpaceMouse and its relatives by 3Dconnexion: six axes, no motors.
//!
//! # Rate control
//! The cap springs back, so its deflection is a speed: beyond the deadband each axis moves or turns a virtual handle, whose
//! pose is what this device reports. It stays in a virtual workspace of the size of the simulated device's.
//! [`home`](crate::Device::home) puts it back to the middle.
//!
//! # Frame
//! The cap's own axes are x right, y toward the user, z down (right-handed). The device frame has x forward, y left, z up:
//! device x = -y, y = -x, z = -z of the cap, for translations and rotations alike. Turns are about the axes of the device
//! frame, which stands still, and not about those of the virtual handle.
//!
//! # Silence
//! A deflected cap reports every 8 ms (SpaceNavigator) or 16 ms (Wireless), and three zeros when it is let go
//! (AndunHH/spacemouse, `SpaceNavigator.md` and `SpaceMouseWireless.md`; FreeSpacenav/spacenavd issue 108). So after 100 ms
//! of silence a deflection counts as none: a wireless cap that went out of reach must not drive the handle on.

mod decode;
mod models;
mod motion;
mod source;

use crate::{
    Description, Device, DeviceError, DeviceLimits, DeviceState, Found, Workspace, Wrench, monotonic_ns,
};
use decode::{Cap, LONGEST_REPORT};
use glam::DVec3;
use models::Model;
use motion::{Rate, VirtualHandle};
use source::{Recording, ReportSource};

const BACKEND: &str = "spacemouse";
const RULES: &str = "copy config/udev/70-rhombus-haptics.rules to /etc/udev/rules.d, run udevadm control --reload, and \
                     connect the device again";

/// Where the virtual handle can be.
pub const WORKSPACE: Workspace = Workspace { centre: DVec3::ZERO, radius_m: 0.18, height_m: 0.3 };

/// After this time without a report the cap counts as let go.
const SILENCE_NS: u64 = 100_000_000;
/// The most reports taken at one reading; a device sends one or two in 8 ms.
const MOST_REPORTS: usize = 16;

/// Which device, and how fast.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Serial number, or path as `/dev/hidraw3` since most have no number; empty: the only one.
    pub serial: String,
    /// Speed at full deflection along an axis, m/s, >= 0.
    pub linear_speed_m_per_s: f64,
    /// Speed at full deflection about an axis, rad/s, >= 0.
    pub angular_speed_rad_per_s: f64,
    /// The raw number that is full deflection, > 0.
    pub full_scale: f64,
    /// Share of the full deflection around the middle that moves nothing, 0 <= and < 1.
    pub deadband: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            serial: String::new(),
            linear_speed_m_per_s: 0.05,
            angular_speed_rad_per_s: 0.8,
            full_scale: 350.0,
            deadband: 0.03,
        }
    }
}

impl Settings {
    fn rate(&self) -> Result<Rate, DeviceError> {
        let refused = |name, value: f64, accepted: &str| {
            Err(DeviceError::Setting { name, value: value.to_string(), accepted: accepted.to_owned() })
        };
        for (name, value, accepted) in [
            ("spacemouse.linear_speed", self.linear_speed_m_per_s, "a finite number >= 0 [m/s]"),
            ("spacemouse.angular_speed", self.angular_speed_rad_per_s, "a finite number >= 0 [rad/s]"),
        ] {
            if !(value.is_finite() && value >= 0.0) {
                return refused(name, value, accepted);
            }
        }
        if !(self.full_scale.is_finite() && self.full_scale > 0.0) {
            return refused("spacemouse.full_scale", self.full_scale, "a finite number > 0");
        }
        if !(0.0..1.0).contains(&self.deadband) {
            return refused("spacemouse.deadband", self.deadband, "0 <= and < 1");
        }
        Ok(Rate {
            linear_m_per_s: self.linear_speed_m_per_s,
            angular_rad_per_s: self.angular_speed_rad_per_s,
            full_scale: self.full_scale,
            deadband: self.deadband,
        })
    }
}

/// A SpaceMouse that answers.
pub struct SpaceMouse {
    description: Description,
    source: Box<dyn ReportSource>,
    cap: Cap,
    handle: VirtualHandle,
    /// Of the last reading, and of the last report of the axes.
    last_ns: Option<u64>,
    reported_ns: u64,
}

/// Opens a device.
///
/// # Errors
/// None is there, several and no serial, or this user may not: each with its remedy.
pub fn open(settings: Settings) -> Result<SpaceMouse, DeviceError> {
    let rate = settings.rate()?;
    let hid = source::hid()?;
    let (found, all) = source::listed(&hid);
    let listed = source::choose(found, all, &settings.serial)?;
    let source = source::open(&hid, &listed)?;
    Ok(SpaceMouse::new(rate, Box::new(source), listed.model, listed.name()))
}

/// A device whose reports were written down: one a line, milliseconds since the first reading, then the bytes in
/// hexadecimal; `#` begins a comment. After the last one it is silent.
///
/// # Errors
/// [`DeviceError::Setting`] names the line that is no report.
pub fn replay(recording: &str, settings: &Settings) -> Result<SpaceMouse, DeviceError> {
    let source = Recording::parse(recording)?;
    Ok(SpaceMouse::new(settings.rate()?, Box::new(source), models::RECORDED, "recording".to_owned()))
}

/// The devices that are connected.
///
/// # Errors
/// The operating system does not list its HID devices.
pub fn list(_: &Settings) -> Result<Vec<Found>, DeviceError> {
    let (found, _) = source::listed(&source::hid()?);
    let line = |listed: source::Listed| Found {
        backend: BACKEND,
        serial: listed.name(),
        what: format!("{} at {}", listed.model.name, listed.path.to_string_lossy()),
    };
    Ok(found.into_iter().map(line).collect())
}

impl SpaceMouse {
    fn new(rate: Rate, source: Box<dyn ReportSource>, model: Model, serial: String) -> SpaceMouse {
        let description = Description {
            backend: BACKEND,
            model: model.name.to_owned(),
            serial,
            firmware: String::new(),
            limits: DeviceLimits {
                max_force_n: None,
                max_torque_n_m: None,
                max_gripper_force_n: None,
                workspace: WORKSPACE,
            },
            buttons: (1..=model.buttons).map(|number| format!("button{number}")).collect(),
            joints: Vec::new(),
            has_gripper: false,
            needs_homing: false,
            watchdog: None,
            status_names: &[],
        };
        SpaceMouse {
            description,
            source,
            cap: Cap::default(),
            handle: VirtualHandle::new(rate, WORKSPACE),
            last_ns: None,
            reported_ns: 0,
        }
    }

    /// The virtual handle at a time of any clock that never goes back. RT safe.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] when the device is gone.
    pub fn read_at(&mut self, now_ns: u64) -> Result<DeviceState, DeviceError> {
        let mut report = [0; LONGEST_REPORT];
        // The cap was where it was until now; what it says now holds from now on.
        let since_ns = now_ns.saturating_sub(self.last_ns.replace(now_ns).unwrap_or(now_ns));
        self.handle.advance(&self.cap, since_ns as f64 * 1e-9);
        for _ in 0..MOST_REPORTS {
            let read = self.source.next(now_ns, &mut report);
            let length = read.map_err(|reason| DeviceError::Lost { device: BACKEND, reason })?;
            if length == 0 {
                break;
            }
            if self.cap.take(&report[..length.min(LONGEST_REPORT)]) {
                self.reported_ns = now_ns;
            }
        }
        if self.cap.is_deflected() && now_ns.saturating_sub(self.reported_ns) >= SILENCE_NS {
            self.cap = Cap { buttons: self.cap.buttons, ..Cap::default() };
        }
        Ok(DeviceState {
            linear_velocity_m_per_s: self.handle.linear_velocity_m_per_s,
            angular_velocity_rad_per_s: self.handle.angular_velocity_rad_per_s,
            buttons: self.cap.buttons,
            device_time_ns: now_ns,
            ..DeviceState::at_rest(self.handle.pose)
        })
    }
}

impl Device for SpaceMouse {
    fn description(&self) -> &Description {
        &self.description
    }

    fn read(&mut self) -> Result<DeviceState, DeviceError> {
        self.read_at(monotonic_ns())
    }

    /// Does nothing: there are no motors.
    fn command(&mut self, _: &Wrench) -> Result<(), DeviceError> {
        Ok(())
    }

    fn enable(&mut self) -> Result<(), DeviceError> {
        Ok(())
    }

    fn disable(&mut self) -> Result<(), DeviceError> {
        Ok(())
    }

    /// The virtual handle goes back to the middle.
    fn home(&mut self) -> Result<(), DeviceError> {
        self.handle.reset();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A device that reports something and then goes.
    struct Leaves(Vec<Vec<u8>>);

    impl ReportSource for Leaves {
        fn next(&mut self, _: u64, report: &mut [u8]) -> Result<usize, &'static str> {
            let bytes = self.0.pop().ok_or("it was unplugged or switched off")?;
            report[..bytes.len()].copy_from_slice(&bytes);
            Ok(bytes.len())
        }
    }

    fn device(source: impl ReportSource + 'static) -> SpaceMouse {
        let rate = Settings::default().rate().unwrap();
        SpaceMouse::new(rate, Box::new(source), models::RECORDED, String::new())
    }

    #[test]
    fn a_device_that_goes_is_lost() {
        let mut device = device(Leaves(vec![vec![1, 0, 0, 0, 0, 0, 0]]));
        let error = device.read_at(0).unwrap_err();
        assert_eq!(error, DeviceError::Lost { device: BACKEND, reason: "it was unplugged or switched off" });
        assert!(device.read().is_err(), "it stays lost");
    }

    #[test]
    fn it_has_no_motors_and_says_so() {
        let mut device = device(Leaves(vec![]));
        let limits = device.description().limits;
        assert_eq!(
            (limits.max_force_n, limits.max_torque_n_m, limits.max_gripper_force_n),
            (None, None, None)
        );
        assert_eq!(device.command(&Wrench::of_force(DVec3::X)), Ok(()));
    }

    #[test]
    fn settings_that_are_no_rate_are_refused_by_their_parameter() {
        let base = Settings::default;
        for (settings, name) in [
            (Settings { linear_speed_m_per_s: -0.1, ..base() }, "spacemouse.linear_speed"),
            (Settings { angular_speed_rad_per_s: f64::NAN, ..base() }, "spacemouse.angular_speed"),
            (Settings { full_scale: f64::INFINITY, ..base() }, "spacemouse.full_scale"),
            (Settings { deadband: 1.0, ..base() }, "spacemouse.deadband"),
        ] {
            let text = open(settings).err().unwrap().to_string();
            assert!(text.contains(name), "{text}");
        }
    }
}
