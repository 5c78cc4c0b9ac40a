//! The operating state in action: what requests and faults do to it, period by period. Everything here is RT safe but
//! what a request asks of the device itself.

use std::sync::Arc;

use crate::requests::Askee;
use crate::safety::{FaultCause, FaultLatch};
use crate::shared::Shared;
use crate::source::SourceMode;
use crate::{
    Answer, Device, DeviceError, DeviceState, MotorSettings, MotorStatus, OperatingState, Request,
    StateCommand,
};

/// Periods in a row with readings that are not finite before that is a fault; more, with good ones in between.
const UNUSABLE_READINGS: u32 = 10;
/// Good readings that make up for one that is not finite. With less between them, they add up to a fault.
const GOOD_FOR_UNUSABLE: u32 = 10;
/// Time that a device gets after enabling before motors that are off are a fault, ns.
const MOTORS_ON_TIME_NS: u64 = 200_000_000;

/// The operating state, the faults, and what somebody asked for.
pub(crate) struct Operation {
    requests: Askee,
    shared: Arc<Shared>,
    owner_timeout_ns: u64,
    gravity_compensation: bool,
    operating: OperatingState,
    mode: SourceMode,
    faults: FaultLatch,
    emergency_stop: bool,
    owner_is_silent: bool,
    has_device: bool,
    is_homed: bool,
    is_busy: bool,
    home: bool,
    /// Whether the force begins from nothing in the next period.
    begins_anew: bool,
    /// Whether the device's motors are on, as far as this loop has switched them.
    motors_on: bool,
    enabled_ns: u64,
    unusable: u32,
}

impl Operation {
    pub(crate) fn new(requests: Askee, shared: Arc<Shared>, settings: &MotorSettings) -> Operation {
        Operation {
            requests,
            shared,
            owner_timeout_ns: (settings.safety.ros_timeout_s * 1e9) as u64,
            gravity_compensation: settings.gravity_compensation,
            operating: OperatingState::Disabled,
            mode: SourceMode::Follow,
            faults: FaultLatch::default(),
            emergency_stop: false,
            owner_is_silent: false,
            has_device: true,
            is_homed: false,
            is_busy: false,
            home: false,
            begins_anew: false,
            motors_on: false,
            enabled_ns: 0,
            unusable: 0,
        }
    }

    /// Whether the motors are on, and whether they may push.
    pub(crate) fn state(&self) -> OperatingState {
        self.operating
    }

    /// What the motors do with the sources.
    pub(crate) fn mode(&self) -> SourceMode {
        self.mode
    }

    /// Whether a device that is opened shall carry its own weight.
    pub(crate) fn gravity_compensation(&self) -> bool {
        self.gravity_compensation
    }

    /// The first thing that went wrong since the last command that cleared it.
    pub(crate) fn fault(&self) -> Option<FaultCause> {
        self.faults.cause()
    }

    /// Does what was asked for since the last time. `device` is none while there is none.
    ///
    /// # Errors
    /// The device is lost.
    pub(crate) fn serve(
        &mut self,
        mut device: Option<&mut (dyn Device + 'static)>,
        now_ns: u64,
    ) -> Result<(), DeviceError> {
        self.watch_emergency_stop();
        while let Some((request, is_given_up)) = self.requests.take(now_ns) {
            // Whoever asked was told that nothing came of it; only what takes force away is still done.
            let is_refused = is_given_up && request != Request::State(StateCommand::Disable);
            let done =
                if is_refused { Ok(false) } else { self.execute(request, device.as_deref_mut(), now_ns) };
            self.publish();
            let state = self.operating;
            let is_accepted = matches!(done, Ok(true));
            self.requests.answer(if is_accepted { Answer::Accepted(state) } else { Answer::Refused(state) });
            match done {
                Ok(_) | Err(DeviceError::Unsupported { .. }) => {}
                Err(lost) => return Err(lost),
            }
        }
        Ok(())
    }

    /// Whether it was accepted.
    fn execute(
        &mut self,
        request: Request,
        device: Option<&mut (dyn Device + 'static)>,
        now_ns: u64,
    ) -> Result<bool, DeviceError> {
        match request {
            Request::State(command) => self.command(command, device, now_ns),
            Request::Free => Ok(self.change_mode(SourceMode::Free)),
            Request::Hold => Ok(self.change_mode(SourceMode::Hold)),
            Request::Follow => Ok(self.change_mode(SourceMode::Follow)),
            Request::GravityCompensation(on) => {
                self.gravity_compensation = on;
                match device {
                    Some(device) => device.set_gravity_compensation(on).map(|()| true),
                    None => Ok(false),
                }
            }
        }
    }

    fn watch_emergency_stop(&mut self) {
        let (is_pressed, was_pressed) = self.shared.take_emergency_stop();
        self.emergency_stop = is_pressed;
        // However short: who let go again before this period, or while the device was homed or opened, meant it too.
        if was_pressed || (is_pressed && self.operating.has_motors_on()) {
            self.raise(FaultCause::EmergencyStop);
        }
    }

    fn change_mode(&mut self, mode: SourceMode) -> bool {
        let is_enabled = self.operating == OperatingState::Enabled;
        if is_enabled {
            self.mode = mode;
        }
        is_enabled
    }

    fn command(
        &mut self,
        command: StateCommand,
        device: Option<&mut (dyn Device + 'static)>,
        now_ns: u64,
    ) -> Result<bool, DeviceError> {
        let Some(next) = self.operating.after(command) else { return Ok(false) };
        match command {
            StateCommand::Enable => {
                let Some(device) = device else { return Ok(false) };
                if self.present().is_some() {
                    return Ok(false);
                }
                // Motors whose force is still on its way to zero after a disable are on.
                if !self.motors_on {
                    device.enable()?;
                    self.motors_on = true;
                    self.enabled_ns = now_ns;
                }
                self.faults = FaultLatch::default();
                self.mode = SourceMode::Follow;
                self.begins_anew |= self.operating != OperatingState::Enabled;
            }
            StateCommand::Resume => (self.mode, self.begins_anew) = (SourceMode::Follow, true),
            // Allowed whatever is wrong; what is wrong then keeps the motors from being enabled.
            StateCommand::Disable => {
                self.faults = FaultLatch::default();
                (self.home, self.is_busy) = (false, false);
            }
            StateCommand::Pause => {}
            StateCommand::Home => {
                let Some(device) = device else { return Ok(false) };
                self.home = device.description().needs_homing;
                self.is_busy = self.home;
            }
            // The reference position is the device's own; it forgets it when it is switched off.
            StateCommand::Unhome => return Ok(false),
        }
        self.operating = next;
        Ok(true)
    }

    /// What is wrong at this moment, whatever has been latched.
    fn present(&self) -> Option<FaultCause> {
        if self.emergency_stop {
            Some(FaultCause::EmergencyStop)
        } else if !self.has_device {
            Some(FaultCause::DeviceLost)
        } else if self.owner_is_silent {
            Some(FaultCause::RosThreadHung)
        } else {
            None
        }
    }

    /// Switches motors that may not push off, once there is no force left that would step; `last` is when nobody may
    /// switch them on again.
    ///
    /// # Errors
    /// The device is lost.
    pub(crate) fn switch_motors(
        &mut self,
        device: &mut dyn Device,
        force_is_zero: bool,
        last: bool,
    ) -> Result<(), DeviceError> {
        if self.motors_on && force_is_zero && (last || !self.operating.has_motors_on()) {
            device.disable()?;
            self.motors_on = false;
        }
        Ok(())
    }

    /// Whether the device's motors are on.
    pub(crate) fn motors_are_on(&self) -> bool {
        self.motors_on
    }

    /// A fault, from any state. The first one stays.
    pub(crate) fn raise(&mut self, cause: FaultCause) {
        self.faults.raise(cause);
        self.operating = OperatingState::Fault;
        (self.home, self.is_busy) = (false, false);
    }

    /// Looks at what a reading says about the device, and whether the owner lives.
    pub(crate) fn watch(&mut self, state: &DeviceState, now_ns: u64) {
        self.unusable = self.unusable.saturating_sub(1);
        self.is_homed = state.homed;
        let settled = now_ns.saturating_sub(self.enabled_ns) >= MOTORS_ON_TIME_NS;
        if let Some(reason) = state.motors_off
            && self.operating.has_motors_on()
            && settled
        {
            self.raise(FaultCause::DeviceMotorsOff(reason));
        }
        self.watch_owner(now_ns);
    }

    /// A reading that is not finite: one may be a glitch, many are a fault.
    pub(crate) fn watch_unusable(&mut self, now_ns: u64) {
        self.unusable = (self.unusable + GOOD_FOR_UNUSABLE).min(UNUSABLE_READINGS * GOOD_FOR_UNUSABLE);
        if self.unusable >= UNUSABLE_READINGS * GOOD_FOR_UNUSABLE && self.operating.has_motors_on() {
            self.raise(FaultCause::NotFinite);
        }
        self.watch_owner(now_ns);
    }

    fn watch_owner(&mut self, now_ns: u64) {
        self.owner_is_silent = self.shared.silence_ns(now_ns) > self.owner_timeout_ns;
        if self.owner_is_silent && self.operating.has_motors_on() {
            self.raise(FaultCause::RosThreadHung);
        }
    }

    /// The device is gone: a fault, also when its motors were off, because nothing works any more.
    pub(crate) fn lose_device(&mut self) {
        (self.has_device, self.is_homed, self.motors_on) = (false, false, false);
        self.raise(FaultCause::DeviceLost);
        self.publish();
    }

    /// The device is back. The fault stays until a command.
    pub(crate) fn find_device(&mut self) {
        self.has_device = true;
        self.publish();
    }

    /// Whether the force shall begin anew. True once.
    pub(crate) fn take_begins_anew(&mut self) -> bool {
        std::mem::take(&mut self.begins_anew)
    }

    /// Whether homing waits for the force to go.
    pub(crate) fn wants_homing(&self) -> bool {
        self.home
    }

    /// Whether somebody wants the device homed. True once.
    pub(crate) fn take_homing(&mut self) -> bool {
        std::mem::take(&mut self.home)
    }

    /// Homing has ended.
    pub(crate) fn end_homing(&mut self, result: Result<(), DeviceError>) {
        self.is_busy = false;
        if result.is_err() {
            self.raise(FaultCause::HomingFailed);
        }
        self.publish();
    }

    /// Shows the state to the owner.
    pub(crate) fn publish(&self) {
        self.shared.set_status(MotorStatus {
            operating: self.operating,
            fault: self.faults.cause(),
            barred_by: self.present(),
            is_homed: self.is_homed,
            is_busy: self.is_busy,
        });
    }
}

#[cfg(test)]
mod tests;
