//! A device for tests of the checks: a mass in a loose hand, with faults to be switched on.

use std::time::Duration;

use glam::DVec3;
use rhombus_chain::Pose;

use super::sampling::{End, Reading, Series, Tick};
use crate::{Description, Device, DeviceError, DeviceLimits, DeviceState, MotorsOff, Workspace, Wrench};

/// Follows its force by a spring to the hand.
#[derive(Clone, Debug)]
pub(super) struct TestDevice {
    pub(super) description: Description,
    /// m/N, each axis; negative: goes against its force.
    pub(super) compliance: DVec3,
    /// Motors push although they are off.
    pub(super) brakes_fail: bool,
    /// Lost after so many readings.
    pub(super) lost_after: u64,
    /// Says this once its motors are on.
    pub(super) motors_off: Option<MotorsOff>,
    /// It repeats each reading so often.
    pub(super) repeats: u64,
    pub(super) enabled: bool,
    /// How often its motors were switched on, and the largest force that they got.
    pub(super) enables: u64,
    pub(super) largest_n: f64,
    pub(super) readings: u64,
    pub(super) position: DVec3,
}

impl Default for TestDevice {
    fn default() -> TestDevice {
        TestDevice {
            description: Description {
                backend: "test",
                model: "spring".to_owned(),
                serial: "7".to_owned(),
                firmware: "1.0".to_owned(),
                limits: DeviceLimits {
                    max_force_n: Some(8.0),
                    max_torque_n_m: None,
                    max_gripper_force_n: None,
                    workspace: Workspace { centre: DVec3::ZERO, radius_m: 0.1, height_m: 0.2 },
                },
                buttons: vec!["button1".to_owned(), "button2".to_owned()],
                joints: Vec::new(),
                has_gripper: false,
                needs_homing: false,
                watchdog: Some(Duration::from_millis(20)),
                status_names: &[],
            },
            compliance: DVec3::splat(2e-3),
            brakes_fail: false,
            lost_after: u64::MAX,
            motors_off: None,
            repeats: 1,
            enabled: false,
            enables: 0,
            largest_n: 0.0,
            readings: 0,
            position: DVec3::ZERO,
        }
    }
}

impl Device for TestDevice {
    fn description(&self) -> &Description {
        &self.description
    }

    fn read(&mut self) -> Result<DeviceState, DeviceError> {
        self.readings += 1;
        if self.readings > self.lost_after {
            return Err(DeviceError::Lost { device: "test", reason: "the cable is out" });
        }
        Ok(DeviceState {
            device_time_ns: self.readings / self.repeats,
            motors_off: self.motors_off.filter(|_| self.enabled),
            ..DeviceState::at_rest(Pose { translation: self.position, ..Pose::IDENTITY })
        })
    }

    fn command(&mut self, wrench: &Wrench) -> Result<(), DeviceError> {
        if self.enabled || self.brakes_fail {
            self.position = wrench.force_n * self.compliance;
        }
        if self.enabled {
            self.largest_n = self.largest_n.max(wrench.force_n.length());
        }
        Ok(())
    }

    fn enable(&mut self) -> Result<(), DeviceError> {
        (self.enabled, self.enables) = (true, self.enables + 1);
        Ok(())
    }

    fn disable(&mut self) -> Result<(), DeviceError> {
        (self.enabled, self.position) = (false, DVec3::ZERO);
        Ok(())
    }
}

/// Readings at 1 kHz, each new, taken in no time.
pub(super) fn series(states: impl Iterator<Item = DeviceState>) -> Series {
    let states: Vec<DeviceState> = states.collect();
    let tick = |(index, state): (usize, &DeviceState)| Tick {
        due_ns: index as u64 * 1_000_000,
        late_ns: 0,
        read_ns: 1000,
        command_ns: 1000,
        state: Reading { device_time_ns: 1 + index as u64, ..Reading::of(state) },
    };
    Series {
        period_ns: 1_000_000,
        missed: 0,
        ticks: states.iter().enumerate().map(tick).collect(),
        homed: states.last().is_some_and(|state| state.homed),
        status: [states[0].status, states[states.len() - 1].status],
        end: End::Whole,
    }
}
