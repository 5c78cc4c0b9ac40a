//! Self-built devices on a serial line: USB CDC or a UART, with an open protocol (`serial_device/PROTOCOL.md`).
//!
//! The device sends states at its own rate; the newest one counts. Every command is complete (motors, force, torque,
//! gripper), carries a sequence number, and comes back as an echo in the states, so lost frames and round trips are
//! counted. The device's own watchdog takes the force away 20 ms after the last command, whatever happens here.

mod device;
mod find;
mod handshake;
mod line;
mod outbox;
mod port;
mod states;
pub mod wire;

pub use device::SerialDevice;
pub use line::Line;
pub use port::Port;

use std::time::Duration;

use crate::{DeviceError, Listed};

const BACKEND: &str = "serial";

/// Where the device hangs, and which one it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// The port, a folder of ports (as `/dev/serial/by-id`), or empty for all USB serial ports.
    pub port: String,
    /// Bits per second of a UART; USB devices do not care.
    pub baud: u32,
    /// Serial number of the device; empty when there is only one.
    pub serial: String,
}

/// Opens the one device that the settings select. Takes up to 4 s; boards that restart when their port is opened do so.
///
/// # Errors
/// No such port, no permission, in use, no answer, another version of the protocol, limits that are none, states that
/// are none, several devices and no choice: each with its remedy.
pub fn open(settings: Settings) -> Result<SerialDevice, DeviceError> {
    check(&settings)?;
    find::choose(find::try_all(&settings)?, &settings.serial)
}

/// The devices that answer. Says hello at every port that [`Settings::port`] means, whatever the serial number.
///
/// # Errors
/// A setting out of range, or a port that is not there.
pub fn list(settings: &Settings) -> Result<Listed, DeviceError> {
    check(settings)?;
    match find::try_all(settings) {
        Ok(tried) => Ok(find::listed(tried)),
        // No port at all, and none asked for.
        Err(DeviceError::NotFound { .. }) if settings.port.is_empty() => Ok(Listed::default()),
        Err(error) => Err(error),
    }
}

fn check(settings: &Settings) -> Result<(), DeviceError> {
    // Below, three commands no longer fit the watchdog's 20 ms.
    if (57_600..=12_000_000).contains(&settings.baud) {
        return Ok(());
    }
    Err(DeviceError::Setting {
        name: "serial.baud",
        value: settings.baud.to_string(),
        accepted: "57600 to 12000000 bit/s".to_owned(),
    })
}

/// A time in whole nanoseconds.
const fn ns(time: Duration) -> u64 {
    time.as_nanos() as u64
}
