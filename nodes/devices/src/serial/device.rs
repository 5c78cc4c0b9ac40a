//! An open device: its newest state in [`read`](Device::read), its newest command out in [`command`](Device::command).

use std::time::Duration;

use super::handshake::{Greeted, arrived, greet};
use super::outbox::Outbox;
use super::states::States;
use super::wire::{COMMAND_FRAME, Command, Frame, Message, Receiver, capability, command_flag, state_flag};
use super::{BACKEND, Line, Port, ns};
use crate::{Description, Device, DeviceError, DeviceState, MotorsOff, Wrench};

/// Without a state for this long the device counts as lost.
const LOST_AFTER: Duration = Duration::from_millis(100);
/// How long the device may take to follow [`Device::enable`] before its word on the motors counts.
const FOLLOWS_WITHIN: Duration = Duration::from_millis(100);
const HOMED_WITHIN: Duration = Duration::from_secs(30);
/// The most that one call reads, so that a device that never stops cannot hold the motor loop.
const CHUNKS: usize = 16;
const CHUNK: usize = 1024;
/// Commands whose time of sending is remembered.
const REMEMBERED: usize = 64;

/// An open device on a serial line.
pub struct SerialDevice<L: Line = Port> {
    line: L,
    description: Description,
    state_rate_hz: u16,
    receiver: Receiver,
    states: States,
    outbox: Outbox,
    wrench: Wrench,
    flags: u8,
    /// Sequence of the next command.
    sequence: u16,
    /// When the last commands were sent, by their sequence modulo the length, with their sequence.
    sent: [(u16, u64); REMEMBERED],
    /// The newest echo whose round trip was measured.
    measured: Option<u16>,
    enabled: Option<Enabled>,
    /// Why the line is gone for good.
    gone: Option<DeviceError>,
}

/// Motors that were asked to be on.
#[derive(Clone, Copy)]
struct Enabled {
    /// The first command that asked for it.
    sequence: u16,
    since_ns: u64,
    /// Whether the device has seen it.
    seen: bool,
}

impl<L: Line> SerialDevice<L> {
    /// Says hello on an open line. `place` is what errors call it. Takes up to 4 s.
    ///
    /// # Errors
    /// Whatever speaks against the device at the other end.
    pub fn greet(mut line: L, place: &str) -> Result<SerialDevice<L>, DeviceError> {
        let Greeted { description, states, receiver, hello } = greet(&mut line, place)?;
        Ok(SerialDevice {
            line,
            description,
            state_rate_hz: hello.state_rate_hz,
            receiver,
            states,
            outbox: Outbox::new(),
            wrench: Wrench::ZERO,
            flags: 0,
            sequence: 0,
            sent: [(0, 0); REMEMBERED],
            measured: None,
            enabled: None,
            gone: None,
        })
    }

    /// States in a second as the device means to send them.
    pub fn state_rate_hz(&self) -> u16 {
        self.state_rate_hz
    }

    /// Takes everything that has come, as far as one call may.
    fn receive(&mut self) -> Result<(), DeviceError> {
        let mut chunk = [0; CHUNK];
        for _ in 0..CHUNKS {
            let result = self.line.read(&mut chunk);
            let Some(count) = self.noted(arrived(result))? else { break };
            let now_ns = self.line.now_ns();
            let mut input = &chunk[..count];
            while let Some(frame) = self.receiver.next(&mut input) {
                match frame.map(Message::decode) {
                    Ok(Ok(Message::State(state, joints))) => {
                        if self.states.take(&state, joints, now_ns) {
                            follow(&mut self.states, &self.sent, &mut self.measured, &mut self.enabled);
                        }
                    }
                    // The answer to a hello that was asked twice.
                    Ok(Ok(Message::Hello(_))) => {}
                    _ => self.states.counts.bad_frames += 1,
                }
            }
            if count < CHUNK {
                break;
            }
        }
        Ok(())
    }

    fn next_command(&mut self) -> Frame {
        let [force, torque] = [self.wrench.force_n, self.wrench.torque_n_m].map(|v| v.as_vec3().to_array());
        let command = Command {
            flags: self.flags,
            sequence: self.sequence,
            force_n: force,
            torque_n_m: torque,
            gripper_force_n: self.wrench.gripper_force_n as f32,
        };
        self.sent[usize::from(self.sequence) % REMEMBERED] = (self.sequence, self.line.now_ns());
        self.sequence = self.sequence.wrapping_add(1);
        self.states.counts.commands += 1;
        command.frame()
    }

    /// Sends what is wanted now, unless earlier commands have not left yet: then a later one will be the newest. So a
    /// line that is slower than the motor loop carries fewer commands, none of them old.
    fn send_newest(&mut self) -> Result<(), DeviceError> {
        self.push_out()?;
        if !self.outbox.is_empty() || self.line.unsent() >= COMMAND_FRAME {
            self.states.counts.skipped_commands += 1;
            return Ok(());
        }
        let command = self.next_command();
        self.outbox.replace(&[command]);
        self.push_out()
    }

    /// Lets the device look for its reference position once. False when it ended without.
    fn search(&mut self, until_ns: u64) -> Result<bool, DeviceError> {
        self.flags |= command_flag::HOME;
        let first = self.sequence;
        let mut homed = false;
        while self.line.now_ns() < until_ns {
            self.send_newest()?;
            self.line.wait(Duration::from_millis(2));
            let state = self.read()?;
            let newest = self.states.newest();
            // It follows from the first state that echoes the wish on.
            let ended = newest.is_some_and(|newest| {
                let knows = |echo: u16| echo.wrapping_sub(first).cast_signed() >= 0;
                newest.echo.is_some_and(|(echo, _)| knows(echo)) && newest.flags & state_flag::HOMING == 0
            });
            if ended {
                homed = state.homed;
                break;
            }
        }
        self.flags &= !command_flag::HOME;
        let without = self.sequence;
        // The wish must be seen to go before it can come again.
        while self.line.now_ns() < until_ns {
            self.send_newest()?;
            self.line.wait(Duration::from_millis(2));
            self.read()?;
            let echo = self.states.newest().and_then(|newest| newest.echo);
            if echo.is_some_and(|(echo, _)| echo.wrapping_sub(without).cast_signed() >= 0) {
                break;
            }
        }
        Ok(homed)
    }

    fn push_out(&mut self) -> Result<(), DeviceError> {
        if let Some(gone) = &self.gone {
            return Err(gone.clone());
        }
        while !self.outbox.is_empty() {
            let result = self.line.write(self.outbox.rest());
            match self.noted(arrived(result))? {
                Some(count) => self.outbox.took(count),
                None => break,
            }
        }
        Ok(())
    }

    /// Remembers that the line is gone.
    fn noted<T>(&mut self, result: Result<T, DeviceError>) -> Result<T, DeviceError> {
        if let Err(error) = &result {
            self.gone = Some(error.clone());
        }
        result
    }

    /// Why the device keeps its motors off although it was enabled.
    fn motors_off(&self) -> Option<MotorsOff> {
        let enabled = self.enabled?;
        let overdue = self.line.now_ns().saturating_sub(enabled.since_ns) > ns(FOLLOWS_WITHIN);
        if enabled.seen || overdue { self.states.newest()?.cause } else { None }
    }
}

/// What the echo in the newest state tells: round trips, and whether the device knows that it is enabled.
fn follow(
    states: &mut States,
    sent: &[(u16, u64); REMEMBERED],
    measured: &mut Option<u16>,
    enabled: &mut Option<Enabled>,
) {
    let Some(newest) = states.newest() else { return };
    let Some((echo, age_us)) = newest.echo else { return };
    if let Some(enabled) = enabled {
        enabled.seen |= echo.wrapping_sub(enabled.sequence).cast_signed() >= 0;
    }
    let (sequence, sent_ns) = sent[usize::from(echo) % REMEMBERED];
    if sequence == echo && sent_ns > 0 && *measured != Some(echo) && age_us < u16::MAX {
        *measured = Some(echo);
        let round_trip_us =
            (newest.received_ns.saturating_sub(sent_ns) / 1000).saturating_sub(u64::from(age_us));
        let counts = &mut states.counts;
        counts.round_trip_us = round_trip_us;
        counts.longest_round_trip_us = counts.longest_round_trip_us.max(round_trip_us);
    }
}

impl<L: Line> Device for SerialDevice<L> {
    fn description(&self) -> &Description {
        &self.description
    }

    fn read(&mut self) -> Result<DeviceState, DeviceError> {
        self.push_out()?;
        self.receive()?;
        let lost = |reason| DeviceError::Lost { device: BACKEND, reason };
        let received_ns = self.states.newest().map_or(0, |newest| newest.received_ns);
        if self.line.now_ns().saturating_sub(received_ns) > ns(LOST_AFTER) {
            return Err(lost(self.states.refused.map_or("no state for 100 ms", |refused| refused.what())));
        }
        self.states.device_state(self.motors_off()).ok_or_else(|| lost("no state at all"))
    }

    fn command(&mut self, wrench: &Wrench) -> Result<(), DeviceError> {
        self.wrench = if self.enabled.is_some() { *wrench } else { Wrench::ZERO };
        self.send_newest()
    }

    fn enable(&mut self) -> Result<(), DeviceError> {
        self.wrench = Wrench::ZERO;
        // A device that has switched its motors off itself must see a command without them first.
        self.flags &= !command_flag::MOTORS_ON;
        let off = self.next_command();
        self.flags |= command_flag::MOTORS_ON;
        self.enabled = Some(Enabled { sequence: self.sequence, since_ns: self.line.now_ns(), seen: false });
        let on = self.next_command();
        self.outbox.replace(&[off, on]);
        self.push_out()
    }

    fn disable(&mut self) -> Result<(), DeviceError> {
        self.wrench = Wrench::ZERO;
        self.enabled = None;
        self.flags &= !(command_flag::MOTORS_ON | command_flag::HOME);
        let off = self.next_command();
        self.outbox.replace(&[off]);
        for _ in 0..10 {
            self.push_out()?;
            if self.outbox.is_empty() {
                return Ok(());
            }
            self.line.wait(Duration::from_micros(500));
        }
        let reason = "it takes no commands; its watchdog takes the force away";
        Err(DeviceError::Lost { device: BACKEND, reason })
    }

    fn home(&mut self) -> Result<(), DeviceError> {
        self.wrench = Wrench::ZERO;
        let until_ns = self.line.now_ns() + ns(HOMED_WITHIN);
        // A hiccup here lets the device's watchdog end its search, and a handle that was held may be free later.
        while self.line.now_ns() < until_ns {
            if self.search(until_ns)? {
                return Ok(());
            }
        }
        Err(DeviceError::Protocol {
            device: BACKEND,
            what: format!("it did not find its reference position within {} s", HOMED_WITHIN.as_secs()),
            remedy: "free the handle and its end switches, then home again".to_owned(),
        })
    }

    fn set_gravity_compensation(&mut self, on: bool) -> Result<(), DeviceError> {
        if !self.states.has(capability::GRAVITY_COMPENSATION) {
            return Err(DeviceError::Unsupported { device: BACKEND, what: "gravity compensation" });
        }
        self.flags &= !command_flag::GRAVITY_COMPENSATION;
        if on {
            self.flags |= command_flag::GRAVITY_COMPENSATION;
        }
        self.send_newest()
    }
}

impl<L: Line> Drop for SerialDevice<L> {
    /// Motors off, and time for the command to leave before the port closes.
    fn drop(&mut self) {
        if self.disable().is_err() {
            return;
        }
        for _ in 0..20 {
            if self.line.unsent() == 0 {
                break;
            }
            self.line.wait(Duration::from_millis(1));
        }
    }
}
