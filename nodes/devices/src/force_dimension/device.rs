//! An open device: readings, commands, motors.

use std::time::Duration;

use glam::DVec3;

use super::bus::Opened;
use super::failure::Failure;
use super::health::{self, Health};
use super::model::Model;
use super::sdk::Reading;
use super::{BACKEND, UNIT_US, WATCHDOG, frame};
use crate::realtime::monotonic_ns;
use crate::{Description, Device, DeviceError, DeviceLimits, DeviceState, MAX_JOINTS, Wrench};

/// How long the SDK may have no velocity, or repeat an old position, before the device counts as lost.
const PATIENCE_NS: u64 = 100_000_000;

/// A pause between two readings after which the SDK has no velocity at first, ns.
const VELOCITY_WINDOW_NS: u64 = 20_000_000;

/// An open device. Dropping it leaves its motors off and its brakes on.
pub struct ForceDimensionDevice {
    opened: Opened,
    description: Description,
    has_wrist: bool,
    has_active_wrist: bool,
    has_active_gripper: bool,
    /// -1 for a left-handed device, whose gripper the SDK counts the other way round.
    gripper_sign: f64,
    health: Health,
    enabled: bool,
    period_s: f64,
    /// When the last reading was, and the last one with a new position, ns.
    read_ns: u64,
    position_ns: u64,
    /// When the SDK last knew a velocity, or could not yet.
    velocity_ns: u64,
}

impl ForceDimensionDevice {
    /// What has been opened becomes a device if it is one that can be driven. Its motors are off.
    pub(super) fn start(opened: Opened, period_s: f64) -> Result<ForceDimensionDevice, DeviceError> {
        let Opened { sdk, id, serial } = opened;
        let refused = |what: String| refused(serial, what);
        let answer = |what: &'static str| {
            move |failure: Failure| refused(format!("{what}: {} ({})", failure.text(), sdk.last_words()))
        };
        let number = sdk.system_type(id).map_err(answer("it does not say what it is"))?;
        let model = Model::of_type(number).map_err(|what| DeviceError::Protocol {
            device: BACKEND,
            what: format!("device {serial}: {what}"),
            remedy: "choose another one with device.serial".to_owned(),
        })?;
        let (has_active_wrist, has_active_gripper) = (sdk.has_active_wrist(id), sdk.has_active_gripper(id));
        let [force, torque, grip] = sdk.max_wrench(id);
        let limit = |what, own, ours| held_limit(what, own, ours).map_err(refused);
        let limits = DeviceLimits {
            max_force_n: Some(limit("force", force, model.max_force_n)?),
            max_torque_n_m: match has_active_wrist && model.max_torque_n_m > 0.0 {
                true => Some(limit("torque", torque, model.max_torque_n_m)?),
                false => None,
            },
            max_gripper_force_n: match has_active_gripper && model.max_gripper_force_n > 0.0 {
                true => Some(limit("gripper force", grip, model.max_gripper_force_n)?),
                false => None,
            },
            workspace: model.workspace(),
        };
        let controller = sdk.controller_version(id).map_err(answer("it does not say its version"))?;
        let mut device = ForceDimensionDevice {
            description: Description {
                backend: BACKEND,
                model: model.name.to_owned(),
                serial: serial.to_string(),
                firmware: format!("controller {controller}, {}", sdk.text()),
                limits,
                buttons: model.buttons.iter().map(|&name| name.to_owned()).collect(),
                joints: Vec::new(),
                has_gripper: sdk.has_gripper(id),
                needs_homing: true,
                watchdog: None,
                status_names: health::STATUS_NAMES,
            },
            has_wrist: sdk.has_wrist(id),
            has_active_wrist: limits.max_torque_n_m.is_some(),
            has_active_gripper: limits.max_gripper_force_n.is_some(),
            gripper_sign: if sdk.is_left_handed(id) { -1.0 } else { 1.0 },
            health: Health::default(),
            enabled: false,
            period_s,
            read_ns: 0,
            position_ns: 0,
            velocity_ns: 0,
            opened,
        };
        let garbage = |error| match error {
            DeviceError::Lost { reason, .. } => refused(reason.to_owned()),
            error => error,
        };
        // Whatever ran before may have left them on.
        device.disable().map_err(garbage)?;
        device.description.watchdog = device.set_watchdog()?;
        // Its first answer decides: what is garbage now must not come to a motor loop.
        device.read().map_err(garbage)?;
        Ok(device)
    }

    /// Asks for [`WATCHDOG`] and believes only what the controller then says. None: it has no watchdog.
    fn set_watchdog(&self) -> Result<Option<Duration>, DeviceError> {
        let Opened { sdk, id, serial } = self.opened;
        let units = (WATCHDOG.as_micros() as u64 / UNIT_US) as u8;
        let now = match sdk.set_watchdog(id, units) {
            Ok(now) => now,
            Err(failure) if failure.is_unsupported() => return Ok(None),
            Err(failure) => {
                return Err(refused(serial, format!("its watchdog cannot be set: {}", failure.text())));
            }
        };
        let watchdog = Duration::from_micros(u64::from(now) * UNIT_US);
        // Off, never set, or one that trips between two commands of the loop.
        if now > units || watchdog.as_secs_f64() < 2.0 * self.period_s {
            let what = format!("its watchdog is at {watchdog:?} after {WATCHDOG:?} was set");
            return Err(refused(serial, what));
        }
        Ok(Some(watchdog))
    }

    /// A velocity of the SDK. It knows none until it has seen two positions within 20 ms: that is rest, unless it lasts.
    fn velocity(&self, answer: Result<[f64; 3], Failure>, now_ns: u64) -> Result<DVec3, DeviceError> {
        match answer.map(DVec3::from_array) {
            Ok(velocity) if velocity.is_finite() => Ok(velocity),
            Ok(_) => Err(lost("its velocity is not a finite number")),
            Err(Failure::TIMEOUT) if now_ns.saturating_sub(self.velocity_ns) < PATIENCE_NS => Ok(DVec3::ZERO),
            Err(failure) => Err(lost(failure.text())),
        }
    }
}

impl Device for ForceDimensionDevice {
    fn description(&self) -> &Description {
        &self.description
    }

    fn read(&mut self) -> Result<DeviceState, DeviceError> {
        let (sdk, id) = (self.opened.sdk, self.opened.id);
        let failed = |failure: Failure| lost(failure.text());
        let Reading { position, rows, is_new } = sdk.reading(id, self.has_wrist).map_err(failed)?;
        let now_ns = monotonic_ns();
        let paused = now_ns.saturating_sub(self.read_ns) > VELOCITY_WINDOW_NS;
        if paused {
            self.velocity_ns = now_ns;
        }
        if is_new || paused {
            self.position_ns = now_ns;
        }
        self.read_ns = now_ns;
        if now_ns - self.position_ns > PATIENCE_NS {
            return Err(lost("the SDK repeats an old position"));
        }
        let pose = frame::pose(position, rows).map_err(lost)?;

        let answer = sdk.linear_velocity(id);
        if answer.is_ok() {
            self.velocity_ns = now_ns;
        }
        let linear_velocity_m_per_s = self.velocity(answer, now_ns)?;
        let angular_velocity_rad_per_s =
            if self.has_wrist { self.velocity(sdk.angular_velocity(id), now_ns)? } else { DVec3::ZERO };
        let gripper_rad = if self.description.has_gripper {
            let angle = self.gripper_sign * sdk.gripper_angle(id).map_err(failed)?;
            if !angle.is_finite() {
                return Err(lost("its gripper angle is not a finite number"));
            }
            Some(angle)
        } else {
            None
        };
        self.health.look(sdk, id, now_ns).map_err(failed)?;
        Ok(DeviceState {
            pose,
            linear_velocity_m_per_s,
            angular_velocity_rad_per_s,
            gripper_rad,
            buttons: sdk.button_mask(id) & !(u32::MAX << self.description.buttons.len()),
            joints: [0.0; MAX_JOINTS],
            homed: self.health.is_homed(),
            motors_off: if self.enabled { self.health.motors_off(now_ns) } else { None },
            status: self.health.status(),
            device_time_ns: self.position_ns,
        })
    }

    fn command(&mut self, wrench: &Wrench) -> Result<(), DeviceError> {
        if !self.enabled {
            return Ok(());
        }
        let torque = if self.has_active_wrist { wrench.torque_n_m } else { DVec3::ZERO };
        let grip = if self.has_active_gripper { self.gripper_sign * wrench.gripper_force_n } else { 0.0 };
        self.opened
            .sdk
            .set_wrench(self.opened.id, wrench.force_n.to_array(), torque.to_array(), grip)
            .map_err(|failure| lost(failure.text()))
    }

    fn enable(&mut self) -> Result<(), DeviceError> {
        let (sdk, id) = (self.opened.sdk, self.opened.id);
        let on = sdk
            .set_brakes(id, false)
            .and_then(|()| sdk.enable_force(id, true))
            // The force that was last set comes back with the motors, unless another is set.
            .and_then(|()| sdk.set_wrench(id, [0.0; 3], [0.0; 3], 0.0));
        if let Err(failure) = on {
            // Half on is off. The first failure is the one to tell.
            let _ = self.disable();
            return Err(lost(failure.text()));
        }
        self.enabled = true;
        self.health.enabled(monotonic_ns());
        Ok(())
    }

    fn disable(&mut self) -> Result<(), DeviceError> {
        let (sdk, id) = (self.opened.sdk, self.opened.id);
        self.enabled = false;
        // Each by itself: none depends on the success of the one before.
        let zero = sdk.set_wrench(id, [0.0; 3], [0.0; 3], 0.0);
        let off = sdk.enable_force(id, false);
        let brakes = sdk.set_brakes(id, true);
        zero.and(off).and(brakes).map_err(|failure| lost(failure.text()))
    }

    /// Moves the handle through `drdAutoInit`; it returns when the reference position is found, which takes seconds.
    /// Motors are afterwards on or off as they were before.
    fn home(&mut self) -> Result<(), DeviceError> {
        let Opened { sdk, id, serial } = self.opened;
        if !sdk.can_home(id) {
            return Err(DeviceError::Unsupported {
                device: BACKEND,
                what: "homing by itself (that needs libdrd and a device that it supports): move its handle by hand \
                       to every stop until its light stops blinking",
            });
        }
        let was_enabled = self.enabled;
        let homed = sdk.home(id).map_err(|failure| {
            refused(serial, format!("homing failed: {} ({})", failure.text(), sdk.last_words()))
        });
        self.health.forget();
        // What the SDK's regulation has made of the watchdog is not documented, so it is set again.
        let watchdog = self.set_watchdog().and_then(|now| match now == self.description.watchdog {
            true => Ok(()),
            false => Err(refused(serial, format!("its watchdog is {now:?} after homing"))),
        });
        let motors = if was_enabled && watchdog.is_ok() { self.enable() } else { self.disable() };
        homed.and(watchdog).and(motors)
    }

    fn set_gravity_compensation(&mut self, on: bool) -> Result<(), DeviceError> {
        let (sdk, id) = (self.opened.sdk, self.opened.id);
        sdk.set_gravity_compensation(id, on).map_err(|failure| lost(failure.text()))
    }
}

impl Drop for ForceDimensionDevice {
    fn drop(&mut self) {
        // Nobody is left to tell; the device's watchdog is what remains.
        let _ = self.disable();
    }
}

/// The smaller of the limit that the device itself keeps to and the model's. Negative is the SDK's word for "none".
fn held_limit(what: &str, own: f64, model: f64) -> Result<f64, String> {
    if own.is_finite() && own != 0.0 {
        return Ok(if own < 0.0 { model } else { own.min(model) });
    }
    Err(format!("it says that its largest {what} is {own}"))
}

fn refused(serial: u16, what: String) -> DeviceError {
    DeviceError::Protocol {
        device: BACKEND,
        what: format!("device {serial}: {what}"),
        remedy: "switch it off and on again; if that does not help, run the maker's test program on it"
            .to_owned(),
    }
}

fn lost(reason: &'static str) -> DeviceError {
    DeviceError::Lost { device: BACKEND, reason }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smaller_limit_holds_and_a_limit_that_is_none_is_refused() {
        assert_eq!(held_limit("force", -1.0, 12.0), Ok(12.0));
        assert_eq!(held_limit("force", 5.0, 12.0), Ok(5.0));
        assert_eq!(held_limit("force", 50.0, 12.0), Ok(12.0));
        for own in [0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(held_limit("force", own, 12.0).is_err(), "{own}");
        }
    }
}
