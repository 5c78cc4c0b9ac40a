//! Inverse3, Inverse3x and Minverse by Haply, through the service that their maker runs on the machine.
//!
//! # The service
//! A WebSocket with JSON (<https://docs.haply.co/inverseSDK/service/realtime/websocket-protocol>). The first message lists
//! all devices; after that each message of the client gets exactly one answer with the state of all of them. A force holds
//! for one tick of the service: who stops sending lets the device idle. A thread of its own talks, at once when there is a
//! command and otherwise every millisecond; a command older than 20 ms it sends no more.
//!
//! A force has the key `vector` in service 3.5 and `values` before. Which one is decided when the device is opened: by what
//! the inventory has (`current_cursor_force`, `preset`: 3.5), then by a force of zero, to which the device must leave idle.
//!
//! # Frames
//! The service's frame is x right, y forward, z up from the mounting plate; the device frame is the same turned by a quarter
//! about z: x forward, y left, z up. Without a grip the handle's orientation is the identity; with one it is the grip's.
//!
//! # Limits
//! The SDK's pages state no force and no workspace. 2 N is the limit that Isaac Lab sets for this device
//! (`HaplyDeviceCfg.limit_force`, isaac-sim/IsaacLab); whoever has the data sheet of his device raises `haply.max_force`.
//! The workspace is assumed: a cylinder around the base that is meant to be larger than the arm's reach, so that the guard
//! at its edge takes no force away where the handle can be.

mod choose;
mod claim;
mod exchange;
mod frame;
mod line;
mod message;
mod reading;
mod request;
mod slot;

use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::thread::JoinHandle;
use std::time::Duration;

use glam::DVec3;

use crate::latest::{Receiver, Sender, latest};
use crate::{
    Description, Device, DeviceError, DeviceLimits, DeviceState, Found, Workspace, Wrench, monotonic_ns,
};
use claim::Claim;
use exchange::{COMMAND_AGE_NS, Exchange, Shared, THREAD_AGE_NS};
use line::{Address, Line};
use reading::Reader;

const BACKEND: &str = "haply";
const START_SERVICE: &str = "start the Haply service (open Haply Hub, or systemctl start haply-inverse-service), \
                             or set haply.url to where it runs";
const WHICH_PORT: &str = "haply.url must be the service's simulation channel, ws://localhost:10001; 10000 is the format \
                          of 3.0 and 10020 the events";

/// The service's own address.
pub const DEFAULT_URL: &str = "ws://localhost:10001";
/// The largest force without another word, N.
pub const DEFAULT_MAX_FORCE_N: f64 = 2.0;
/// The largest force that can be set, N; more is taken for a slip of the pen.
pub const LARGEST_FORCE_N: f64 = 20.0;

/// Around the base, 0.4 m to each side, 0.4 m up and down.
const WORKSPACE: Workspace = Workspace { centre: DVec3::ZERO, radius_m: 0.4, height_m: 0.8 };

/// Which device, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// The service, `ws://HOST:PORT`.
    pub url: String,
    /// `device_id` or `uuid` of the device; empty: the only one.
    pub serial: String,
    /// `device_id` of the grip; empty: the only one, if there is one.
    pub grip: String,
    /// The largest force the device may be asked for, N, > 0 and at most [`LARGEST_FORCE_N`].
    pub max_force_n: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            url: DEFAULT_URL.to_owned(),
            serial: String::new(),
            grip: String::new(),
            max_force_n: DEFAULT_MAX_FORCE_N,
        }
    }
}

/// An Inverse3 that answers.
pub struct HaplyDevice {
    description: Description,
    shared: Arc<Shared>,
    readings: Receiver<DeviceState>,
    /// Ends with the sender of the readings, so that [`read`](Device::read) never is the one that frees them.
    thread: Option<JoinHandle<Sender<DeviceState>>>,
    /// Given up after the thread has said goodbye.
    _claim: Claim,
}

/// Opens a device.
///
/// # Errors
/// No service, no such device, more than one and no serial, a device that is not calibrated or that another program
/// commands, a service that answers something else: each with its remedy.
pub fn open(settings: Settings) -> Result<HaplyDevice, DeviceError> {
    let address = Address::parse(&settings.url)?;
    let max_force_n = settings.max_force_n;
    if !(max_force_n.is_finite() && max_force_n > 0.0 && max_force_n <= LARGEST_FORCE_N) {
        return Err(DeviceError::Setting {
            name: "haply.max_force",
            value: max_force_n.to_string(),
            accepted: format!("more than 0 and at most {LARGEST_FORCE_N} [N]"),
        });
    }
    let (mut line, inventory) = inventory(&address)?;
    let message = exchange::understood(&inventory, address.url())?;
    let arm = choose::arm(&message, &settings)?;
    let grip_id = choose::grip(&message, &settings)?;
    let device_id = arm.device_id.to_string();
    let claim = Claim::of(line.place()?, &device_id)?;
    claim::wait_until_idle(&mut line, address.url(), arm)?;
    let description = Description {
        backend: BACKEND,
        model: choose::model(arm),
        serial: device_id.clone(),
        firmware: choose::firmware(arm),
        limits: DeviceLimits {
            max_force_n: Some(max_force_n),
            max_torque_n_m: None,
            max_gripper_force_n: None,
            workspace: WORKSPACE,
        },
        buttons: grip_id.iter().flat_map(|_| reading::BUTTONS).map(str::to_owned).collect(),
        joints: Vec::new(),
        has_gripper: false,
        needs_homing: false,
        watchdog: Some(Duration::from_nanos(COMMAND_AGE_NS)),
        status_names: reading::STATUS_NAMES,
    };
    let spelling = exchange::settle_spelling(&mut line, address.url(), &device_id, choose::spelling(arm))?;
    let mut reader = Reader::new(device_id.clone(), grip_id);
    let first = reader.state(&message, monotonic_ns(), false).map_err(|reason| DeviceError::Protocol {
        device: BACKEND,
        what: reason.to_owned(),
        remedy: "look at the device in Haply Hub".to_owned(),
    })?;
    let (mut sender, readings) = latest();
    sender.send(first);
    let shared = Arc::new(Shared::default());
    let talk = Exchange { line, id: request::quoted(&device_id), spelling, reader };
    let theirs = shared.clone();
    let thread = std::thread::Builder::new()
        .name("haply".to_owned())
        .spawn(move || talk.run(&theirs, sender))
        .map_err(|error| DeviceError::Library {
            what: format!("there is no thread for the Haply service ({error})"),
            remedy: "end other programs, or raise the limit of threads".to_owned(),
        })?;
    Ok(HaplyDevice { description, shared, readings, thread: Some(thread), _claim: claim })
}

/// The devices that the service knows.
///
/// # Errors
/// No service, or not this one.
pub fn list(settings: &Settings) -> Result<Vec<Found>, DeviceError> {
    let address = Address::parse(&settings.url)?;
    let (line, inventory) = inventory(&address)?;
    line.close(std::time::Instant::now() + Duration::from_millis(20));
    let message = exchange::understood(&inventory, address.url())?;
    Ok(message.arms().iter().map(choose::found).collect())
}

/// Connects, and asks for everything: the first message may be older than a device that was just plugged in.
fn inventory(address: &Address) -> Result<(Line, String), DeviceError> {
    let mut line = Line::open(address)?;
    let first = exchange::question(&mut line, address.url(), None)?;
    exchange::understood(&first, address.url())?;
    let everything = exchange::question(&mut line, address.url(), Some(request::EVERYTHING))?;
    Ok((line, everything))
}

impl HaplyDevice {
    fn alive(&self) -> Result<(), DeviceError> {
        match self.shared.lost.get() {
            None => Ok(()),
            Some(reason) => Err(DeviceError::Lost { device: BACKEND, reason }),
        }
    }

    fn wake(&self) {
        if let Some(thread) = &self.thread {
            thread.thread().unpark();
        }
    }
}

impl Device for HaplyDevice {
    fn description(&self) -> &Description {
        &self.description
    }

    fn read(&mut self) -> Result<DeviceState, DeviceError> {
        self.alive()?;
        let now_ns = monotonic_ns();
        match self.readings.newest() {
            Some(state) if now_ns.saturating_sub(state.device_time_ns) <= THREAD_AGE_NS => Ok(*state),
            _ => Err(DeviceError::Lost {
                device: BACKEND,
                reason: "the thread that talks to its service does not get to run",
            }),
        }
    }

    fn command(&mut self, wrench: &Wrench) -> Result<(), DeviceError> {
        self.shared.command.write(wrench.force_n, monotonic_ns());
        self.wake();
        self.alive()
    }

    fn enable(&mut self) -> Result<(), DeviceError> {
        self.shared.command.write(DVec3::ZERO, monotonic_ns());
        self.shared.enabled.store(true, Ordering::Release);
        self.wake();
        self.alive()
    }

    fn disable(&mut self) -> Result<(), DeviceError> {
        self.shared.enabled.store(false, Ordering::Release);
        self.wake();
        self.alive()
    }
}

impl Drop for HaplyDevice {
    /// Waits until the thread has told the service that there is no force any more; at most one answer's time.
    fn drop(&mut self) {
        self.shared.enabled.store(false, Ordering::Release);
        self.shared.stop.store(true, Ordering::Release);
        self.wake();
        if let Some(thread) = self.thread.take() {
            // A panic of the thread has closed the line, and there is nobody to tell.
            let _ = thread.join();
        }
    }
}
