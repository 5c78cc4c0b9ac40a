//! Force Dimension's delta, omega, sigma and lambda, and Novint's Falcon, through the maker's SDK.
//!
//! The SDK is loaded at run time ([`Settings::sdk`] says where to look first) and is not needed to build. All numbers are
//! SI in the device's frame as its manual has it: x towards the user, y to the user's right, z up.
//!
//! What the device itself guards stays on: its speed threshold as the factory set it, and its watchdog, which takes the
//! force away when no command came for [`WATCHDOG`]. Gravity is compensated by the SDK, on this computer, with each
//! command; so commands must keep coming, zero ones too.

mod bus;
mod device;
mod failure;
mod frame;
mod health;
mod load;
mod model;
mod sdk;
mod search;
mod usb;

pub use device::ForceDimensionDevice;

use std::path::PathBuf;
use std::time::Duration;

use crate::{DeviceError, Found};

const BACKEND: &str = "force_dimension";

/// After this time without a command the device's controller takes the force away. The longest that it can do is 255
/// units of 125 us.
pub const WATCHDOG: Duration = Duration::from_micros(250 * UNIT_US);
const UNIT_US: u64 = 125;

/// The SDK needs two positions in 20 ms to know a velocity, so that the loop may not be slower than this; then the
/// watchdog gets three commands in its time.
const LONGEST_PERIOD_S: f64 = 0.01;

/// Which device is opened, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// `device.serial`: the serial number, as it is printed on the device; empty: the only device there is.
    pub serial: String,
    /// `force_dimension.sdk`: the folder in which the SDK, or its library itself, is looked for first; empty: only in
    /// the usual places.
    pub sdk: PathBuf,
    /// The motor loop's period, s.
    pub period_s: f64,
}

/// Opens a device; its motors are off. Not RT safe.
///
/// # Errors
/// Every [`DeviceError`] but `Lost` and `Unsupported`: the settings, the SDK, the device or its limits are not usable.
pub fn open(settings: Settings) -> Result<ForceDimensionDevice, DeviceError> {
    let wanted = settings.wanted()?;
    if !(settings.period_s > 0.0 && settings.period_s <= LONGEST_PERIOD_S) {
        return Err(DeviceError::Setting {
            name: "device.rate",
            value: format!("{} Hz", 1.0 / settings.period_s),
            accepted: format!(
                "at least {} Hz with a Force Dimension device, whose velocity estimate and watchdog need it",
                1.0 / LONGEST_PERIOD_S
            ),
        });
    }
    ForceDimensionDevice::start(bus::open(load::load(&settings.sdk)?, wanted)?, settings.period_s)
}

/// The devices on the bus, those that another program has open too. Each free one is opened for a moment. Not RT safe.
///
/// # Errors
/// [`DeviceError::Library`] without a usable SDK, [`DeviceError::Permission`] when there are devices that may not be
/// opened.
pub fn list(settings: &Settings) -> Result<Vec<Found>, DeviceError> {
    bus::list(load::load(&settings.sdk)?)
}

impl Settings {
    fn wanted(&self) -> Result<Option<u16>, DeviceError> {
        let serial = self.serial.trim();
        if serial.is_empty() {
            return Ok(None);
        }
        serial.parse().map(Some).map_err(|_| DeviceError::Setting {
            name: "device.serial",
            value: self.serial.clone(),
            accepted: "the number on a Force Dimension device, 0 to 65535, or nothing for the only device"
                .to_owned(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn settings(serial: &str, period_s: f64) -> Settings {
        Settings { serial: serial.to_owned(), sdk: PathBuf::from("/nowhere"), period_s }
    }

    #[test]
    fn a_serial_is_a_number_of_sixteen_bits_or_nothing() {
        assert_eq!(settings(" ", 1e-3).wanted(), Ok(None));
        assert_eq!(settings("11311", 1e-3).wanted(), Ok(Some(11311)));
        for serial in ["65536", "-1", "left", "0x10"] {
            let text = settings(serial, 1e-3).wanted().unwrap_err().to_string();
            assert!(text.contains("device.serial") && text.contains(serial), "{text}");
        }
    }

    #[test]
    fn a_loop_too_slow_for_velocity_and_watchdog_is_refused_before_anything_is_opened() {
        for period_s in [0.0101, 0.0, -1.0, f64::NAN] {
            let text = open(settings("", period_s)).err().unwrap().to_string();
            assert!(text.contains("device.rate") && text.contains("100 Hz"), "{text}");
        }
    }
}
