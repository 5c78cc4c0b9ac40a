//! One device: its mechanics, its motors, and what its controller does by itself.

use std::io;
use std::time::Duration;

use devices::{Workspace, Wrench};
use glam::DVec3;
use rhombus_doubles::{Event, Motors, PressingHand, Record};

use crate::arguments::{Device, FirmwareWatchdog};

/// The controller's and the hand's step, s.
pub(crate) const STEP_S: f64 = 0.25e-3;

/// What electromagnetic brakes do to the handle, N s/m.
const BRAKING_N_S_PER_M: f64 = 20.0;

const UNIT: Duration = Duration::from_micros(125);

/// What the device answers instead of the truth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Garbage {
    None,
    /// A position that is not a number.
    Nan,
    /// A position farther away than the device is large.
    Far,
    /// An orientation frame of zeros.
    Frame,
    /// One that is mirrored.
    Mirror,
    /// A velocity that is not a number.
    Velocity,
    /// A gripper angle that is not a number.
    Gripper,
    /// The same position again and again.
    Stuck,
    /// Readings that fail with a communication error.
    Silent,
}

impl std::str::FromStr for Garbage {
    type Err = String;

    fn from_str(word: &str) -> Result<Garbage, String> {
        Ok(match word {
            "none" => Garbage::None,
            "nan" => Garbage::Nan,
            "far" => Garbage::Far,
            "frame" => Garbage::Frame,
            "mirror" => Garbage::Mirror,
            "velocity" => Garbage::Velocity,
            "gripper" => Garbage::Gripper,
            "stuck" => Garbage::Stuck,
            "silent" => Garbage::Silent,
            _ => {
                return Err(format!(
                    "garbage {word:?}: accepted is none, nan, far, frame, mirror, velocity, gripper, stuck, silent"
                ));
            }
        })
    }
}

/// What the controller does with the motors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mode {
    Idle,
    Force,
    Brake,
}

/// `dhdGetStatus`'s reasons for forces that are off.
pub(crate) mod cause {
    pub(crate) const NONE: i32 = 0;
    pub(crate) const BUTTON: i32 = 1;
    pub(crate) const VELOCITY: i32 = 2;
    pub(crate) const WATCHDOG: i32 = 3;
    pub(crate) const SOFTWARE: i32 = 4;
    pub(crate) const USB: i32 = 5;
}

/// A device with power.
pub(crate) struct Hardware {
    pub(crate) device: Device,
    hand: PressingHand,
    motors: Motors,
    pub(crate) mode: Mode,
    pub(crate) cause: i32,
    pub(crate) plugged: bool,
    /// The program that has it open.
    pub(crate) opened_by: Option<u64>,
    pub(crate) buttons: u32,
    pub(crate) gravity: bool,
    watchdog_units: u8,
    stuck_at: Option<DVec3>,
}

impl Hardware {
    pub(crate) fn new(device: Device) -> Result<Hardware, Box<dyn std::error::Error>> {
        let workspace = Workspace { centre: DVec3::ZERO, radius_m: 0.3, height_m: 0.6 };
        let hand = PressingHand::new(device.hand, workspace, STEP_S)?;
        let record = Record::create(device.record.as_deref())?;
        Ok(Hardware {
            hand,
            motors: Motors::new(None, record),
            mode: Mode::Brake,
            cause: cause::SOFTWARE,
            plugged: true,
            opened_by: None,
            buttons: 0,
            gravity: true,
            watchdog_units: 0,
            stuck_at: None,
            device,
        })
    }

    /// One step of hand and controller.
    pub(crate) fn advance(&mut self, now_ns: u64) -> io::Result<()> {
        self.guard(now_ns)?;
        let mut force_n = self.motors.wrench(now_ns)?.force_n;
        if self.mode == Mode::Brake {
            force_n -= BRAKING_N_S_PER_M * self.hand.velocity();
        }
        self.hand.advance(force_n);
        Ok(())
    }

    /// The controller's own watchdog and speed limit.
    fn guard(&mut self, now_ns: u64) -> io::Result<()> {
        if self.motors.update(now_ns)? {
            (self.mode, self.cause) = (Mode::Brake, cause::WATCHDOG);
        }
        if self.motors.are_on() && self.hand.velocity().length() > self.device.threshold_m_per_s {
            self.motors.off(now_ns, Event::Velocity)?;
            (self.mode, self.cause) = (Mode::Brake, cause::VELOCITY);
        }
        Ok(())
    }

    pub(crate) fn enable_force(&mut self, now_ns: u64, on: bool) -> io::Result<()> {
        if on {
            self.motors.enable(now_ns)?;
            (self.mode, self.cause) = (Mode::Force, cause::NONE);
        } else {
            self.switch_off(now_ns, Event::Off, cause::SOFTWARE)?;
        }
        Ok(())
    }

    pub(crate) fn set_brakes(&mut self, now_ns: u64, on: bool) -> io::Result<()> {
        if on {
            self.switch_off(now_ns, Event::Off, cause::SOFTWARE)?;
        } else if self.mode == Mode::Brake {
            self.mode = Mode::Idle;
        }
        Ok(())
    }

    /// Motors off if they are on, and brakes on.
    pub(crate) fn switch_off(&mut self, now_ns: u64, event: Event, cause: i32) -> io::Result<()> {
        if self.motors.are_on() {
            self.motors.off(now_ns, event)?;
            self.cause = cause;
        }
        self.mode = Mode::Brake;
        Ok(())
    }

    pub(crate) fn plug(&mut self, now_ns: u64, plugged: bool) -> io::Result<()> {
        if !plugged {
            self.switch_off(now_ns, Event::Gone, cause::USB)?;
            self.opened_by = None;
        }
        self.plugged = plugged;
        Ok(())
    }

    /// A command in the SDK's signs. The answer is whether the motors could do all of it.
    pub(crate) fn command(&mut self, now_ns: u64, numbers: &[f64; 7]) -> io::Result<bool> {
        self.guard(now_ns)?;
        let kind = self.device.kind;
        let [fx, fy, fz, tx, ty, tz, grip] = *numbers;
        let mut force_n = DVec3::new(fx, fy, fz);
        // The SDK holds forces to its own limit, where one is set, without a word.
        let limit_n = self.device.max_wrench[0];
        if limit_n > 0.0 {
            force_n = force_n.clamp_length_max(limit_n);
        }
        let wanted_n = force_n;
        force_n = force_n.clamp_length_max(self.device.peak_force_n);
        let wrench = Wrench {
            force_n,
            torque_n_m: if kind.active_wrist { DVec3::new(tx, ty, tz) } else { DVec3::ZERO },
            gripper_force_n: if kind.gripper { self.sign() * grip } else { 0.0 },
        };
        self.motors.command(now_ns, wrench)?;
        Ok(force_n == wanted_n)
    }

    pub(crate) fn are_motors_on(&self) -> bool {
        self.motors.are_on()
    }

    /// Sets the watchdog if the controller has one.
    pub(crate) fn set_watchdog(&mut self, units: u8) -> bool {
        if self.device.firmware_watchdog == FirmwareWatchdog::None {
            return false;
        }
        self.watchdog_units = units;
        self.motors.set_watchdog((units > 0).then(|| UNIT * u32::from(units)));
        true
    }

    pub(crate) fn watchdog(&self) -> u8 {
        match self.device.firmware_watchdog {
            FirmwareWatchdog::Answers(units) => units,
            _ => self.watchdog_units,
        }
    }

    /// What a reading writes, and whether it is new.
    pub(crate) fn reading(&mut self) -> ([f64; 20], bool) {
        let garbage = self.device.garbage;
        let mut position = self.hand.position();
        self.stuck_at = (garbage == Garbage::Stuck).then(|| self.stuck_at.unwrap_or(position));
        position = self.stuck_at.unwrap_or(position);
        match garbage {
            Garbage::Nan => position.y = f64::NAN,
            Garbage::Far => position.z = 40.0,
            _ => {}
        }
        let frame = match garbage {
            Garbage::Frame => [0.0; 9],
            Garbage::Mirror => [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -1.0],
            // A wrist turned by a right angle about z, so that rows and columns cannot be mistaken for each other.
            _ if self.device.kind.wrist => [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0],
            _ => [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        };
        let velocity = if garbage == Garbage::Velocity { DVec3::NAN } else { self.hand.velocity() };
        let gripper =
            if garbage == Garbage::Gripper { f64::NAN } else { self.sign() * self.device.gripper_rad };
        let mut numbers = [0.0; 20];
        numbers[..3].copy_from_slice(&position.to_array());
        numbers[3..12].copy_from_slice(&frame);
        numbers[12..15].copy_from_slice(&velocity.to_array());
        numbers[18] = gripper;
        numbers[19] = f64::from(self.buttons);
        (numbers, garbage != Garbage::Stuck)
    }

    /// The SDK counts a left-handed gripper the other way round.
    fn sign(&self) -> f64 {
        if self.device.kind.left { -1.0 } else { 1.0 }
    }
}
