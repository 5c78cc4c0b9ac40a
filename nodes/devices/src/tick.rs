//! One period of the motor loop: read, check, choose, limit, command. Everything here is RT safe and knows no clock.

use std::sync::Arc;

use crate::latest::Receiver;
use crate::operation::Operation;
use crate::safety::{Applied, Energy, FaultCause, LimitsHit, SafetyLayer};
use crate::shared::{Counters, Shared};
use crate::source::{ForceOrigin, Inputs, Moment, Source};
use crate::{
    Device, DeviceError, DeviceState, LawCommand, MotorSettings, OperatingState, ServoCommand, Wrench,
};

/// What one period produced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time of the reading on the system's clock, ns since 1970; strictly rising.
    pub stamp_ns: i64,
    /// Time of the reading by [`monotonic_ns`](crate::monotonic_ns).
    pub monotonic_ns: u64,
    /// How long after its deadline the period began, ns.
    pub late_ns: u64,
    /// How long the period before worked, ns.
    pub work_ns: u64,
    /// The handle.
    pub state: DeviceState,
    /// What the motors were given, device frame.
    pub wrench: Wrench,
    /// Where it came from.
    pub origin: ForceOrigin,
    /// How deep the probe is by the contact law, m, negative when the body is pulled; 0 without a law or a contact.
    pub depth_m: f64,
    /// The operating state.
    pub operating: OperatingState,
    /// Why it is a fault.
    pub fault: Option<FaultCause>,
    /// The rules that made the force another than what was wanted.
    pub limits_hit: LimitsHit,
    /// Energy between motors and hand since the device was opened.
    pub energy: Energy,
}

/// The reading ends of both command slots; newest wins.
pub(crate) struct Commands {
    pub(crate) laws: Receiver<LawCommand>,
    pub(crate) servo: Receiver<ServoCommand>,
}

/// An open device with everything that decides on its force. Dropping it takes the force away, on every path, a panic
/// included.
pub(crate) struct Ticker<'a> {
    device: Box<dyn Device>,
    operation: &'a mut Operation,
    commands: &'a mut Commands,
    shared: &'a Arc<Shared>,
    source: Source,
    safety: SafetyLayer,
    released: bool,
}

impl<'a> Ticker<'a> {
    /// Ready for the first period, motors off.
    pub(crate) fn new(
        device: Box<dyn Device>,
        settings: &MotorSettings,
        operation: &'a mut Operation,
        commands: &'a mut Commands,
        shared: &'a Arc<Shared>,
    ) -> Ticker<'a> {
        let limits = device.description().limits;
        Ticker {
            source: Source::new(settings.source, &settings.safety),
            safety: SafetyLayer::new(&settings.safety, &limits, 1.0 / settings.rate_hz),
            device,
            operation,
            commands,
            shared,
            released: false,
        }
    }

    /// One period. None when the reading was not finite: the force then falls, and there is nothing to tell.
    ///
    /// # Errors
    /// The device is lost. The caller drops the ticker then, which takes the force away as far as that is possible.
    pub(crate) fn tick(&mut self, now: Moment) -> Result<Option<Sample>, DeviceError> {
        Counters::add(&self.shared.counters.ticks, 1);
        self.operation.serve(Some(&mut *self.device), now.monotonic_ns)?;
        let state = self.device.read()?;
        let sample = if state.is_finite() { Some(self.drive(state, now)?) } else { self.drive_blind(now)? };
        self.operation.switch_motors(&mut *self.device, self.safety.is_zero(), self.released)?;
        self.operation.publish();
        Ok(sample)
    }

    fn drive(&mut self, state: DeviceState, now: Moment) -> Result<Sample, DeviceError> {
        self.operation.watch(&state, now.monotonic_ns);
        self.safety.set_max_force_n(self.shared.max_force_n());
        if self.operation.take_begins_anew() {
            self.safety.begin_anew();
        }
        let permitted = self.permits_force(&state);
        let wanted = self.source.want(&Inputs {
            state: &state,
            now,
            mode: self.operation.mode(),
            permitted,
            law: self.commands.laws.newest(),
            servo: self.commands.servo.newest(),
        });
        let Applied { wrench, fault, limits_hit } =
            self.safety.step(&wanted, &state, permitted, now.monotonic_ns);
        if let Some(cause) = fault {
            self.operation.raise(cause);
        }
        self.device.command(&wrench)?;
        self.count(limits_hit);
        Ok(Sample {
            stamp_ns: now.stamp_ns,
            monotonic_ns: now.monotonic_ns,
            late_ns: 0,
            work_ns: 0,
            state,
            wrench,
            origin: if permitted { wanted.origin } else { ForceOrigin::Nobody },
            depth_m: wanted.depth_m,
            operating: self.operation.state(),
            fault: self.operation.fault(),
            limits_hit,
            energy: self.safety.energy(),
        })
    }

    fn drive_blind(&mut self, now: Moment) -> Result<Option<Sample>, DeviceError> {
        Counters::add(&self.shared.counters.unusable_readings, 1);
        self.operation.watch_unusable(now.monotonic_ns);
        let applied = self.safety.step_blind(now.monotonic_ns);
        self.device.command(&applied.wrench)?;
        Ok(None)
    }

    /// Before a device is homed its positions mean nothing, and a force that waits for homing has to go.
    fn permits_force(&self, state: &DeviceState) -> bool {
        self.operation.state() == OperatingState::Enabled
            && !self.released
            && !self.operation.wants_homing()
            && (state.homed || !self.device.description().needs_homing)
    }

    fn count(&self, hit: LimitsHit) {
        let counters = &self.shared.counters;
        for (rule, counter) in [
            (LimitsHit::NOT_FINITE, &counters.unusable_forces),
            (LimitsHit::FORCE, &counters.clamped_forces),
            (LimitsHit::SLEW, &counters.slewed_forces),
            (LimitsHit::PASSIVITY, &counters.damped_ticks),
        ] {
            Counters::add(counter, u64::from(hit.contains(rule)));
        }
    }

    /// Whether somebody wants the device homed, and there is no force to lose. True once.
    pub(crate) fn wants_homing(&mut self) -> bool {
        self.safety.is_zero() && self.operation.motors_are_on() && self.operation.take_homing()
    }

    /// Homes the device. Not RT safe: it may take seconds, and nothing else is served meanwhile.
    pub(crate) fn home(&mut self) {
        let result = self.device.home();
        self.safety.begin_anew();
        self.operation.end_homing(result);
    }

    /// From now on the force goes to zero, and then the motors go off.
    pub(crate) fn begin_release(&mut self) {
        self.released = true;
    }

    /// Whether they are off.
    pub(crate) fn is_released(&self) -> bool {
        self.released && !self.operation.motors_are_on()
    }

    /// Takes the force away at once.
    ///
    /// # Errors
    /// What the device says.
    pub(crate) fn off(&mut self) -> Result<(), DeviceError> {
        let commanded = self.device.command(&Wrench::ZERO);
        self.device.disable().and(commanded)
    }
}

impl Drop for Ticker<'_> {
    fn drop(&mut self) {
        // There is nobody left to tell; the loop reports what `off` said when it ends by itself.
        let _ = self.off();
    }
}
