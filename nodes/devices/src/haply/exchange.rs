//! The thread that talks to the service: one request, one answer, and again at the next command or after [`PAUSE`].
//!
//! The newest command wins on the way out, the newest reading on the way in; the motor loop waits for neither.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use glam::DVec3;

use super::BACKEND;
use super::frame::service_from_device;
use super::line::{Fault, Line, OPENING};
use super::message::Message;
use super::reading::Reader;
use super::request::{self, Spelling};
use super::slot::CommandSlot;
use crate::latest::Sender;
use crate::{DeviceError, DeviceState, MotorsOff, Scheduling, monotonic_ns};

/// A command that is older moves nothing any more.
pub(super) const COMMAND_AGE_NS: u64 = 20_000_000;
/// Longest time between two forces: less than a tick by what the way to the service may differ.
const LONGEST_GAP_NS: u64 = 15_000_000;
/// How long there may be no good reading before the device counts as lost.
const READING_AGE_NS: u64 = 100_000_000;
/// The same where the thread has not said so: then it is the thread that does not get to run.
pub(super) const THREAD_AGE_NS: u64 = 120_000_000;
/// How long an answer may take.
const ANSWER: Duration = Duration::from_millis(100);
/// How long the goodbye may take.
const GOODBYE: Duration = Duration::from_millis(20);
/// The longest time between two requests.
const PAUSE: Duration = Duration::from_millis(1);

/// Of `SCHED_FIFO`, where it is permitted: before all ordinary threads, behind the motor loop.
const PRIORITY: i32 = 1;

/// What the motor loop and the thread share.
#[derive(Debug, Default)]
pub(super) struct Shared {
    pub(super) command: CommandSlot,
    pub(super) enabled: AtomicBool,
    pub(super) stop: AtomicBool,
    /// Why the thread gave up.
    pub(super) lost: OnceLock<&'static str>,
}

/// The thread's part of an open device.
pub(super) struct Exchange {
    pub(super) line: Line,
    /// The device's id as a JSON string.
    pub(super) id: String,
    pub(super) spelling: Spelling,
    pub(super) reader: Reader,
}

impl Exchange {
    /// Talks until it is stopped or the device is lost. Gives back the sender, which must outlive the motor loop's end.
    pub(super) fn run(mut self, shared: &Shared, mut readings: Sender<DeviceState>) -> Sender<DeviceState> {
        // What is refused here is refused to the motor loop too, which says so.
        let _ = Scheduling::request(PRIORITY, None);
        let mut request = String::new();
        let mut good_ns = monotonic_ns();
        let mut held = DVec3::ZERO;
        let mut gap = Gap::default();
        while !shared.stop.load(Ordering::Acquire) {
            let is_enabled = shared.enabled.load(Ordering::Acquire);
            let force_n = gap.bridge(wanted(shared, &mut held), is_enabled, monotonic_ns());
            self.write_request(&mut request, force_n);
            let answer = match self.ask(&request, ANSWER) {
                Ok(answer) => answer,
                Err(fault) => {
                    let _ = shared.lost.set(fault.reason());
                    break;
                }
            };
            let now_ns = monotonic_ns();
            let state = Message::parse(&answer)
                .map_err(|_| "its service answers what is not its own JSON")
                .and_then(|message| self.reader.state(&message, now_ns, force_n.is_some()));
            match state {
                Ok(mut state) => {
                    good_ns = now_ns;
                    if gap.is_open {
                        state.motors_off.get_or_insert(MotorsOff::Watchdog);
                    }
                    readings.send(state);
                }
                Err(reason) if now_ns.saturating_sub(good_ns) >= READING_AGE_NS => {
                    let _ = shared.lost.set(reason);
                    break;
                }
                Err(_) => {}
            }
            std::thread::park_timeout(PAUSE);
        }
        // The force goes with this request, and not only when the service notices that nothing comes any more.
        self.write_request(&mut request, None);
        let deadline = Instant::now() + GOODBYE;
        let _ = self.line.send(&request, deadline);
        self.line.close(deadline);
        readings
    }

    /// A force, or none: then the device idles. A service before 3.5 gives no positions to a session without a force
    /// (<https://docs.haply.co/inverseSDK/3.0.8/service>), so it is sent one of zero.
    fn write_request(&self, request: &mut String, force_n: Option<DVec3>) {
        match (force_n, self.spelling) {
            (Some(force_n), spelling) => {
                request::force(request, &self.id, spelling, service_from_device(force_n));
            }
            (None, Spelling::Vector) => request::probe(request, &self.id),
            (None, Spelling::Values) => request::force(request, &self.id, Spelling::Values, DVec3::ZERO),
        }
    }

    fn ask(&mut self, request: &str, within: Duration) -> Result<tungstenite::Utf8Bytes, Fault> {
        let deadline = Instant::now() + within;
        self.line.send(request, deadline)?;
        self.line.receive(deadline)
    }
}

/// Between two forces the service's tick may have taken the force away. The next one would be a step, so there is none
/// until the motors are enabled anew, as with a device that has a watchdog of its own.
#[derive(Clone, Copy, Debug, Default)]
struct Gap {
    forced_ns: Option<u64>,
    is_open: bool,
}

impl Gap {
    /// What of the wanted force goes out at `now_ns`.
    fn bridge(&mut self, wanted_n: Option<DVec3>, is_enabled: bool, now_ns: u64) -> Option<DVec3> {
        if !is_enabled {
            *self = Gap::default();
            return None;
        }
        let is_late = self.forced_ns.is_some_and(|ns| now_ns.saturating_sub(ns) > LONGEST_GAP_NS);
        self.is_open |= is_late || wanted_n.is_none();
        let force_n = wanted_n.filter(|_| !self.is_open);
        if force_n.is_some() {
            self.forced_ns = Some(now_ns);
        }
        force_n
    }
}

/// The newest force, N, device frame; none while the motors are off or when the motor loop has fallen silent.
fn wanted(shared: &Shared, held: &mut DVec3) -> Option<DVec3> {
    if !shared.enabled.load(Ordering::Acquire) {
        return None;
    }
    if let Some((force_n, at_ns)) = shared.command.read() {
        if monotonic_ns().saturating_sub(at_ns) > COMMAND_AGE_NS {
            return None;
        }
        *held = force_n;
    }
    Some(*held)
}

/// A question while opening, where an answer may take longer and a fault is told in full.
pub(super) fn question(line: &mut Line, url: &str, request: Option<&str>) -> Result<String, DeviceError> {
    let deadline = Instant::now() + OPENING;
    let answer = match request {
        Some(request) => line.send(request, deadline).and_then(|()| line.receive(deadline)),
        None => line.receive(deadline),
    };
    answer.map(|text| text.as_str().to_owned()).map_err(|fault| DeviceError::Protocol {
        device: BACKEND,
        what: format!("at {url}, {}", fault.reason()),
        remedy: super::WHICH_PORT.to_owned(),
    })
}

/// Reads an answer while opening.
pub(super) fn understood<'a>(text: &'a str, url: &str) -> Result<Message<'a>, DeviceError> {
    Message::parse(text).map_err(|why| {
        let begin: String = text.chars().take(60).collect();
        DeviceError::Protocol {
            device: BACKEND,
            what: format!("what {url} says is not the service's JSON ({why}); it begins {begin:?}"),
            remedy: super::WHICH_PORT.to_owned(),
        }
    })
}

/// Finds out by forces of zero which spelling makes the device leave idle. When neither does, or the service does not tell
/// its control mode, `guess` it is.
pub(super) fn settle_spelling(
    line: &mut Line,
    url: &str,
    device_id: &str,
    guess: Spelling,
) -> Result<Spelling, DeviceError> {
    const TRIES: u32 = 5;
    let id = request::quoted(device_id);
    let mut request = String::new();
    for spelling in [guess, guess.other()] {
        for _ in 0..TRIES {
            request::force(&mut request, &id, spelling, DVec3::ZERO);
            let answer = question(line, url, Some(&request))?;
            let message = understood(&answer, url)?;
            let arm = message.arms().iter().find(|arm| arm.device_id == device_id);
            match arm.and_then(|arm| arm.state.control_mode.as_deref()) {
                None => return Ok(guess),
                Some("force") => return Ok(spelling),
                Some(_) => std::thread::sleep(PAUSE),
            }
        }
    }
    Ok(guess)
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: u64 = 1_000_000;

    #[test]
    fn forces_in_time_go_out_and_after_a_gap_none_does_until_the_motors_are_enabled_anew() {
        let mut gap = Gap::default();
        let push = Some(DVec3::Z);
        assert_eq!(gap.bridge(push, true, 100 * MS), push, "the first one follows nothing");
        assert_eq!(gap.bridge(push, true, 115 * MS), push);
        assert_eq!(gap.bridge(push, true, 131 * MS), None, "the tick may have passed");
        assert!(gap.is_open);
        assert_eq!(gap.bridge(push, true, 132 * MS), None, "it would be a step");
        assert_eq!(gap.bridge(None, false, 133 * MS), None);
        assert_eq!(gap.bridge(push, true, 134 * MS), push);
    }

    #[test]
    fn a_motor_loop_that_fell_silent_opens_the_gap() {
        let mut gap = Gap::default();
        gap.bridge(Some(DVec3::Z), true, MS);
        assert_eq!(gap.bridge(None, true, 2 * MS), None);
        assert_eq!(gap.bridge(Some(DVec3::Z), true, 3 * MS), None);
    }
}
