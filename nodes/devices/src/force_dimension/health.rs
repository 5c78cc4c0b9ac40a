//! What the device says about itself: status numbers, whether it is homed, whether it has switched its motors off.
//!
//! The maker does not say whether asking costs a transfer on the bus, so it is asked every 5 ms, not with each reading.
//! The device has acted before it is asked; this only tells why.

use super::failure::Failure;
use super::sdk::{Id, Sdk};
use crate::{MAX_STATUS, MotorsOff};

/// Names of the status numbers, in the SDK's order.
pub(super) const STATUS_NAMES: &[&str] = &[
    "power",
    "connected",
    "started",
    "reset",
    "idle",
    "force",
    "brake",
    "torque",
    "wrist_detected",
    "error",
    "gravity",
    "timeguard",
    "wrist_init",
    "redundancy",
    "force_off_cause",
    "locks",
    "axis_checked",
];

const RESET: usize = 3;
const FORCE: usize = 5;
const FORCE_OFF_CAUSE: usize = 14;

const BETWEEN_LOOKS_NS: u64 = 5_000_000;

/// After motors were switched on, the status may lag behind for this long.
const SWITCHING_NS: u64 = 50_000_000;

/// The newest answers.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Health {
    status: [i32; MAX_STATUS],
    /// None: not to be asked for, only libdhd is there.
    homed: Option<bool>,
    looked_ns: Option<u64>,
    enabled_ns: u64,
    /// Whether the motors were seen to be on since they were switched on.
    seen_on: bool,
}

impl Health {
    /// Asks the device when it is time. RT safe.
    pub(super) fn look(&mut self, sdk: &Sdk, id: Id, now_ns: u64) -> Result<(), Failure> {
        if self.looked_ns.is_some_and(|last_ns| now_ns.saturating_sub(last_ns) < BETWEEN_LOOKS_NS) {
            return Ok(());
        }
        self.took(sdk.status(id)?, sdk.is_homed(id), now_ns);
        Ok(())
    }

    fn took(&mut self, status: [i32; MAX_STATUS], homed: Option<bool>, now_ns: u64) {
        (self.status, self.homed, self.looked_ns) = (status, homed, Some(now_ns));
        self.seen_on |= status[FORCE] != 0;
    }

    /// Asks again with the next reading.
    pub(super) fn forget(&mut self) {
        self.looked_ns = None;
    }

    /// The motors were switched on just now. RT safe.
    pub(super) fn enabled(&mut self, now_ns: u64) {
        (self.enabled_ns, self.seen_on, self.looked_ns) = (now_ns, false, None);
    }

    pub(super) fn status(&self) -> [i32; MAX_STATUS] {
        self.status
    }

    /// Whether the position is referenced: the controller's light does not blink.
    pub(super) fn is_homed(&self) -> bool {
        self.homed.unwrap_or(true) && self.status[RESET] == 0
    }

    /// Why the motors are off although they were switched on.
    pub(super) fn motors_off(&self, now_ns: u64) -> Option<MotorsOff> {
        let switching = !self.seen_on && now_ns.saturating_sub(self.enabled_ns) < SWITCHING_NS;
        if self.status[FORCE] != 0 || switching {
            return None;
        }
        Some(match self.status[FORCE_OFF_CAUSE] {
            1 => MotorsOff::Button,
            2 => MotorsOff::Velocity,
            3 => MotorsOff::Watchdog,
            4 => MotorsOff::Software,
            5 => MotorsOff::Usb,
            6 => MotorsOff::DeadMan,
            _ => MotorsOff::Other,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn status(force: i32, cause: i32) -> [i32; MAX_STATUS] {
        let mut status = [0; MAX_STATUS];
        (status[FORCE], status[FORCE_OFF_CAUSE]) = (force, cause);
        status
    }

    #[test]
    fn there_is_a_name_for_each_number_and_room_for_all() {
        assert_eq!(STATUS_NAMES.len(), 17);
        assert!(STATUS_NAMES.len() <= MAX_STATUS);
        assert_eq!((STATUS_NAMES[RESET], STATUS_NAMES[FORCE]), ("reset", "force"));
        assert_eq!(STATUS_NAMES[FORCE_OFF_CAUSE], "force_off_cause");
    }

    #[test]
    fn motors_that_were_on_and_are_off_say_why_at_once() {
        let mut health = Health::default();
        health.enabled(0);
        health.took(status(1, 0), Some(true), 1_000_000);
        assert_eq!(health.motors_off(1_000_000), None);
        health.took(status(0, 2), Some(true), 6_000_000);
        assert_eq!(health.motors_off(6_000_000), Some(MotorsOff::Velocity));
    }

    #[test]
    fn motors_that_have_just_been_switched_on_have_time_to_start() {
        let mut health = Health::default();
        health.enabled(0);
        health.took(status(0, 4), Some(true), 1_000_000);
        assert_eq!(health.motors_off(1_000_000), None);
        assert_eq!(health.motors_off(SWITCHING_NS), Some(MotorsOff::Software));
    }

    #[test]
    fn a_device_in_reset_is_not_homed_whatever_the_library_says() {
        let mut health = Health::default();
        for (reset, homed, expected) in [
            (0, Some(true), true),
            (0, Some(false), false),
            (0, None, true),
            (1, Some(true), false),
            (1, None, false),
        ] {
            let mut status = status(1, 0);
            status[RESET] = reset;
            health.took(status, homed, 0);
            assert_eq!(health.is_homed(), expected, "{reset} {homed:?}");
        }
    }
}
