//! A serial port of the operating system.
//!
//! It is opened twice: by `serialport`, which sets the rate and keeps every other program out (`TIOCEXCL` and `flock`),
//! and as a file that does not block, because `serialport`'s own reads wait for their timeout and allocate their errors.

#![expect(unsafe_code, reason = "TIOCOUTQ has no safe wrapper that does not allocate its error")]

use std::fs::{File, OpenOptions};
use std::io::{self, Read, Write};
use std::os::fd::AsRawFd;
use std::os::unix::fs::OpenOptionsExt;
use std::path::Path;
use std::time::Duration;

use serialport::{ClearBuffer, SerialPort, SerialPortType, TTYPort};

use super::{BACKEND, Line};
use crate::{DeviceError, monotonic_ns};

/// An open serial port. Nobody else has it as long as it lives.
pub struct Port {
    file: File,
    /// Holds the exclusive access.
    _settings: TTYPort,
}

impl Port {
    /// Opens the port at `path` with 8 data bits, no parity, one stop bit and no flow control.
    ///
    /// # Errors
    /// No such port, no permission, in use, or no serial port at all.
    pub fn open(path: &str, baud: u32) -> Result<Port, DeviceError> {
        let file = OpenOptions::new()
            .read(true)
            .write(true)
            .custom_flags(libc::O_NONBLOCK | libc::O_NOCTTY)
            .open(path)
            .map_err(|error| not_opened(path, &error))?;
        let settings =
            TTYPort::open(&serialport::new(path, baud)).map_err(|error| not_set(path, baud, &error))?;
        let given = settings.baud_rate().unwrap_or(baud);
        if given.abs_diff(baud) > baud / 50 {
            return Err(DeviceError::Setting {
                name: "serial.baud",
                value: baud.to_string(),
                accepted: format!("a rate that {path} can do; it does {given} instead"),
            });
        }
        // What came before this moment was for nobody.
        let _ = settings.clear(ClearBuffer::All);
        Ok(Port { file, _settings: settings })
    }
}

impl Line for Port {
    fn now_ns(&self) -> u64 {
        monotonic_ns()
    }

    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        self.file.read(into)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn unsent(&self) -> usize {
        let mut bytes: libc::c_int = 0;
        // SAFETY: the file is open as long as `self`, and TIOCOUTQ writes one int, which outlives the call.
        let answer = unsafe { libc::ioctl(self.file.as_raw_fd(), libc::TIOCOUTQ, &raw mut bytes) };
        if answer == 0 { usize::try_from(bytes).unwrap_or(0) } else { 0 }
    }

    fn wait(&mut self, time: Duration) {
        std::thread::sleep(time);
    }
}

/// Where devices are looked for: `port` itself, every entry of it when it is a folder, and every USB serial port when
/// it is empty. Built-in ports are left in peace unless they are named: who knows what hangs on them.
///
/// # Errors
/// No such port, or none at all.
pub(super) fn candidates(port: &str) -> Result<Vec<String>, DeviceError> {
    let mut found: Vec<String> = if port.is_empty() {
        usb_ports().into_iter().map(|(name, _)| name).collect()
    } else if Path::new(port).is_dir() {
        let entries = std::fs::read_dir(port).map_err(|error| not_opened(port, &error))?;
        entries.flatten().map(|entry| entry.path().to_string_lossy().into_owned()).collect()
    } else {
        vec![port.to_owned()]
    };
    if found.is_empty() {
        let looked = match port {
            "" => "there is no USB serial port (looked in /sys/class/tty)".to_owned(),
            folder => format!("serial.port = {folder} is an empty folder"),
        };
        let remedy =
            "plug the device in, or name its port with serial.port, which can also be a built-in one";
        return Err(DeviceError::NotFound { device: BACKEND, looked, remedy: remedy.to_owned() });
    }
    found.sort();
    Ok(found)
}

/// The USB serial ports of this machine, each with what its USB descriptor says.
fn usb_ports() -> Vec<(String, String)> {
    // serialport panics where there is no such folder.
    if !Path::new("/sys/class/tty").is_dir() {
        return Vec::new();
    }
    let ports = serialport::available_ports().unwrap_or_default();
    let usb = ports.into_iter().filter_map(|port| match port.port_type {
        SerialPortType::UsbPort(usb) => Some((port.port_name, usb.product.unwrap_or_default())),
        _ => None,
    });
    usb.collect()
}

fn not_opened(path: &str, error: &io::Error) -> DeviceError {
    match error.kind() {
        io::ErrorKind::NotFound => {
            let ports: Vec<String> =
                usb_ports().into_iter().map(|(name, product)| format!("{name} ({product})")).collect();
            let there = if ports.is_empty() { "none".to_owned() } else { ports.join(", ") };
            DeviceError::NotFound {
                device: BACKEND,
                looked: format!("serial.port = {path} does not exist; USB serial ports now: {there}"),
                remedy: "plug the device in, or set serial.port to its port".to_owned(),
            }
        }
        io::ErrorKind::PermissionDenied => DeviceError::Permission {
            what: path.to_owned(),
            remedy: "install the udev rules, or add this user to the group that owns the port \
                     (`sudo usermod -aG dialout $USER`, then log in again)"
                .to_owned(),
        },
        io::ErrorKind::ResourceBusy => DeviceError::Busy { what: path.to_owned() },
        _ => no_port(path, &error.to_string()),
    }
}

fn not_set(path: &str, baud: u32, error: &serialport::Error) -> DeviceError {
    match error.kind() {
        // What serialport makes of EBUSY and of a lock that another program holds.
        serialport::ErrorKind::NoDevice => DeviceError::Busy { what: path.to_owned() },
        serialport::ErrorKind::Io(kind) => not_opened(path, &io::Error::from(kind)),
        _ => no_port(path, &format!("{} at {baud} baud", error.description)),
    }
}

fn no_port(path: &str, error: &str) -> DeviceError {
    DeviceError::Protocol {
        device: BACKEND,
        what: format!("{path} does not open as a serial port ({error})"),
        remedy: "set serial.port to the device's serial port; if it is, unplug it and plug it in again"
            .to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // Tests may run as a user whom nothing is forbidden, so the refusals of the system are made here.
    #[test]
    fn what_the_system_refuses_is_told_apart() {
        let refused = |errno| not_opened("/dev/ttyACM0", &io::Error::from_raw_os_error(errno));
        let forbidden = refused(libc::EACCES);
        assert!(matches!(forbidden, DeviceError::Permission { .. }));
        let text = forbidden.to_string();
        assert!(
            text.contains("/dev/ttyACM0") && text.contains("udev rules") && text.contains("dialout"),
            "{text}"
        );
        assert_eq!(refused(libc::EBUSY), DeviceError::Busy { what: "/dev/ttyACM0".to_owned() });
        assert!(matches!(refused(libc::ENOENT), DeviceError::NotFound { .. }));
        assert!(matches!(refused(libc::EIO), DeviceError::Protocol { .. }));
    }
}
