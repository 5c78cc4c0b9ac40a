//! The first words with a device: who it is, and whether what it says can be lived with.

use std::io;
use std::time::Duration;

use glam::DVec3;

use super::states::{STATUS_NAMES, States};
use super::wire::{Hello, HelloRequest, Message, PROTOCOL_VERSION, Receiver, WrongMessage, capability};
use super::{BACKEND, Line, ns};
use crate::{Description, DeviceError, DeviceLimits, MAX_JOINTS, Workspace};

/// How long a device may take to answer: boards that restart when their port is opened need about two seconds.
const ANSWER_WITHIN: Duration = Duration::from_secs(3);
const ASK_EVERY: Duration = Duration::from_millis(100);
/// How long after its hello a device may take for its first state.
const STATE_WITHIN: Duration = Duration::from_millis(500);
const LOOK_EVERY: Duration = Duration::from_millis(2);
/// The slowest watchdog that still takes the force away within 50 ms.
const LONGEST_WATCHDOG_MS: u16 = 50;
const MOST_BUTTONS: u8 = 16;

/// What came before the hello, for the error's sake.
#[derive(Default)]
struct Heard {
    bytes: u64,
    frames: u64,
    bad_frames: u64,
}

/// A device that has said hello and sent its first state.
pub(super) struct Greeted {
    pub description: Description,
    pub states: States,
    pub receiver: Receiver,
    pub hello: Hello,
}

/// Asks until the device has said who it is, and waits for its first state. `place` is what errors call the line.
pub(super) fn greet<L: Line>(line: &mut L, place: &str) -> Result<Greeted, DeviceError> {
    let protocol = |what: String, remedy: &str| DeviceError::Protocol {
        device: BACKEND,
        what: format!("{place}: {what}"),
        remedy: remedy.to_owned(),
    };
    let mut receiver = Receiver::default();
    let mut heard = Heard::default();
    let mut known: Option<(Hello, Description, States)> = None;
    let mut until_ns = line.now_ns() + ns(ANSWER_WITHIN);
    let mut ask_ns = line.now_ns();
    let mut request = Request::default();
    let mut chunk = [0; 1024];
    while line.now_ns() < until_ns {
        if known.is_none() && line.now_ns() >= ask_ns {
            ask_ns = line.now_ns() + ns(ASK_EVERY);
            request.ask();
        }
        request.push_out(line)?;
        let Some(count) = arrived(line.read(&mut chunk))? else {
            line.wait(LOOK_EVERY);
            continue;
        };
        heard.bytes += count as u64;
        let mut input = &chunk[..count];
        while let Some(frame) = receiver.next(&mut input) {
            let Ok(payload) = frame else {
                heard.bad_frames += 1;
                continue;
            };
            heard.frames += 1;
            match (Message::decode(payload), &mut known) {
                (Ok(Message::Hello(hello)), None) => {
                    let description = describe(&hello).map_err(|what| {
                        protocol(what, "correct the firmware's hello; PROTOCOL.md says it")
                    })?;
                    let states = States::new(&hello);
                    until_ns = line.now_ns() + ns(STATE_WITHIN);
                    known = Some((hello, description, states));
                }
                (Ok(Message::State(state, joints)), Some((_, _, states))) => {
                    states.take(&state, joints, line.now_ns());
                }
                (Err(WrongMessage::Version(version)), None) => {
                    return Err(protocol(
                        format!(
                            "it speaks version {version} of the protocol, this program {PROTOCOL_VERSION}"
                        ),
                        "bring firmware and program to the same version",
                    ));
                }
                _ => {}
            }
        }
        let is_known = |known: &mut (_, _, States)| known.2.newest().is_some() && request.is_sent();
        if let Some((hello, description, states)) = known.take_if(is_known) {
            return Ok(Greeted { description, states, receiver, hello });
        }
    }
    Err(match known {
        Some((_, description, states)) => protocol(
            format!("{} said hello, {}", description.model, no_state(&states)),
            "correct the firmware's states; PROTOCOL.md says what they must be",
        ),
        None => {
            let (what, remedy) = heard.explain();
            protocol(what, remedy)
        }
    })
}

/// A hello request on its way out, behind a zero that ends whatever half frame the device may have.
#[derive(Default)]
struct Request {
    bytes: [u8; 8],
    length: usize,
    sent: usize,
}

impl Request {
    fn is_sent(&self) -> bool {
        self.sent == self.length
    }

    /// Another one, unless one is still on its way.
    fn ask(&mut self) {
        if self.is_sent() {
            let frame = HelloRequest { version: PROTOCOL_VERSION }.frame();
            (self.sent, self.length) = (0, 1 + frame.bytes().len());
            self.bytes[1..self.length].copy_from_slice(frame.bytes());
        }
    }

    fn push_out<L: Line>(&mut self, line: &mut L) -> Result<(), DeviceError> {
        if !self.is_sent() {
            self.sent += arrived(line.write(&self.bytes[self.sent..self.length]))?.unwrap_or(0);
        }
        Ok(())
    }
}

/// How many bytes were moved; none when there was nothing to move now.
pub(super) fn arrived(result: io::Result<usize>) -> Result<Option<usize>, DeviceError> {
    match result {
        Ok(0) => Err(DeviceError::Lost { device: BACKEND, reason: "its port has hung up: is it unplugged?" }),
        Ok(count) => Ok(Some(count)),
        Err(error) if matches!(error.kind(), io::ErrorKind::WouldBlock | io::ErrorKind::Interrupted) => {
            Ok(None)
        }
        Err(_) => Err(DeviceError::Lost { device: BACKEND, reason: "its port has failed: is it unplugged?" }),
    }
}

impl Heard {
    /// What was heard instead of a hello, and what to do.
    fn explain(&self) -> (String, &'static str) {
        let Heard { bytes, frames, bad_frames } = self;
        let seconds = ANSWER_WITHIN.as_secs();
        match (*bytes, *frames, *bad_frames) {
            (0, _, _) => (
                format!("no answer, 0 bytes within {seconds} s"),
                "check power, cable, firmware and serial.baud, and that serial.port is the device",
            ),
            (_, 0, 0) => (
                format!(
                    "{bytes} bytes within {seconds} s, no end of a frame in them: baud mismatch, or another device?"
                ),
                "set serial.baud to the firmware's rate; check that serial.port is the device",
            ),
            (_, 0, _) => (
                format!(
                    "{bytes} bytes within {seconds} s, no valid frame, {bad_frames} broken ones: baud mismatch, bytes \
                     lost on the way, or another device?"
                ),
                "set serial.baud to the firmware's rate; check the cable and that serial.port is the device",
            ),
            _ => (
                format!(
                    "{bytes} bytes within {seconds} s, {frames} valid frames, {bad_frames} broken ones, no hello"
                ),
                "correct the firmware: it must answer a hello request at any time",
            ),
        }
    }
}

fn no_state(states: &States) -> String {
    let within = STATE_WITHIN.as_millis();
    match states.refused {
        Some(refused) => format!("but sent no usable state within {within} ms: {}", refused.what()),
        None => format!("but sent no state within {within} ms"),
    }
}

/// What a hello says, checked.
fn describe(hello: &Hello) -> Result<Description, String> {
    let has = |capability| hello.capabilities & capability != 0;
    let limit = |name, capability, value: f32, unit| match has(capability) {
        true if value.is_finite() && value > 0.0 => Ok(Some(f64::from(value))),
        true => Err(format!("its {name} is {value} {unit}; accepted is a finite number above 0")),
        false => Ok(None),
    };
    let size = |name, value: f32| match value.is_finite() && value > 0.0 {
        true => Ok(f64::from(value)),
        false => Err(format!("its {name} is {value} m; accepted is a finite number above 0")),
    };
    let centre = DVec3::from_array(hello.workspace_centre_m.map(f64::from));
    if !centre.is_finite() {
        return Err(format!("its workspace is around {centre}; accepted are finite numbers"));
    }
    let limits = DeviceLimits {
        max_force_n: limit("maximum force", capability::FORCE, hello.max_force_n, "N")?,
        max_torque_n_m: limit("maximum torque", capability::TORQUE, hello.max_torque_n_m, "N m")?,
        max_gripper_force_n: limit(
            "maximum gripper force",
            capability::GRIPPER_FORCE,
            hello.max_gripper_force_n,
            "N",
        )?,
        workspace: Workspace {
            centre,
            radius_m: size("workspace radius", hello.workspace_radius_m)?,
            height_m: size("workspace height", hello.workspace_height_m)?,
        },
    };
    if has(capability::TORQUE) && !has(capability::ORIENTATION) {
        return Err("it has motors for a torque but does not measure its orientation".to_owned());
    }
    let motors = has(capability::FORCE) || has(capability::TORQUE) || has(capability::GRIPPER_FORCE);
    if motors && !(1..=LONGEST_WATCHDOG_MS).contains(&hello.watchdog_ms) {
        return Err(format!(
            "its watchdog is {} ms; accepted is 1 to {LONGEST_WATCHDOG_MS} ms",
            hello.watchdog_ms
        ));
    }
    if hello.buttons > MOST_BUTTONS {
        return Err(format!("it has {} buttons; accepted are at most {MOST_BUTTONS}", hello.buttons));
    }
    if usize::from(hello.joints) > MAX_JOINTS {
        return Err(format!("it has {} joints; accepted are at most {MAX_JOINTS}", hello.joints));
    }
    Ok(Description {
        backend: BACKEND,
        model: text("model", &hello.model)?,
        serial: text("serial number", &hello.serial)?,
        firmware: text("firmware version", &hello.firmware)?,
        limits,
        buttons: (1..=hello.buttons).map(|number| format!("button{number}")).collect(),
        joints: (1..=hello.joints).map(|number| format!("joint{number}")).collect(),
        has_gripper: has(capability::GRIPPER),
        needs_homing: has(capability::NEEDS_HOMING),
        watchdog: motors.then(|| Duration::from_millis(u64::from(hello.watchdog_ms))),
        status_names: STATUS_NAMES,
    })
}

fn text(what: &str, name: &[u8]) -> Result<String, String> {
    let length = name.iter().position(|&byte| byte == 0).unwrap_or(name.len());
    let text = &name[..length];
    match text.iter().all(|byte| (b' '..=b'~').contains(byte)) {
        true => Ok(String::from_utf8_lossy(text).trim().to_owned()),
        false => Err(format!("its {what} is \"{}\"; accepted is printable ASCII", text.escape_ascii())),
    }
}
