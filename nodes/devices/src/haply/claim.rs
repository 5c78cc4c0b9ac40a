//! One driver for one device. The service lets any number of sessions command a device, and the newest force wins: two of
//! them would shake a hand between two worlds.
//!
//! Among drivers of this kind the claim is a socket in the kernel's abstract namespace, named by service and device. It has
//! no file that could stay behind: however a process ends, its claim ends with it. Other programs do not know of it; those
//! that command the device are seen by its control mode, which is a force only within a tick of one.

use std::net::SocketAddr;
use std::os::linux::net::SocketAddrExt;
use std::os::unix::net::{SocketAddr as Name, UnixListener};
use std::time::{Duration, Instant};

use super::line::Line;
use super::message::Arm;
use super::{BACKEND, exchange, request};
use crate::DeviceError;

/// A force of a program that has just ended is gone after the service's tick; much longer than that.
const TICKS: Duration = Duration::from_millis(200);
/// Between two looks.
const LOOK: Duration = Duration::from_millis(20);

/// Nobody else has the device as long as this lives.
#[derive(Debug)]
pub(super) struct Claim {
    _socket: UnixListener,
}

impl Claim {
    /// Claims a device of the service at `place`.
    ///
    /// # Errors
    /// Another driver has it.
    pub(super) fn of(place: SocketAddr, device_id: &str) -> Result<Claim, DeviceError> {
        // This machine has two addresses for itself.
        let host = if place.ip().is_loopback() { "here".to_owned() } else { place.ip().to_string() };
        let name = format!("rhombus_haptics/{BACKEND}/{host}:{}/{device_id}", place.port());
        let claimed = Name::from_abstract_name(name).and_then(|name| UnixListener::bind_addr(&name));
        claimed.map(|socket| Claim { _socket: socket }).map_err(|_| busy(device_id))
    }
}

/// Makes sure that no program commands the device, before this one does.
///
/// # Errors
/// One does, or the service does not answer.
pub(super) fn wait_until_idle(line: &mut Line, url: &str, arm: &Arm) -> Result<(), DeviceError> {
    let mut is_commanded = commanded(arm);
    let give_up = Instant::now() + TICKS;
    while is_commanded {
        if Instant::now() >= give_up {
            return Err(busy(&arm.device_id));
        }
        std::thread::sleep(LOOK);
        let answer = exchange::question(line, url, Some(request::EVERYTHING))?;
        let message = exchange::understood(&answer, url)?;
        is_commanded = message.arms().iter().any(|now| now.device_id == arm.device_id && commanded(now));
    }
    Ok(())
}

fn commanded(arm: &Arm) -> bool {
    arm.state.control_mode.as_deref() == Some("force")
}

fn busy(device_id: &str) -> DeviceError {
    DeviceError::Busy { what: format!("the Inverse3 {device_id}") }
}
