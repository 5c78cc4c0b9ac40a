//! Why the force was taken away, and the latch that keeps the reason.

use thiserror::Error;

use crate::MotorsOff;

/// What took the force away until a command clears it. Each is a sentence: what happened, and how it is cleared.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum FaultCause {
    /// Somebody pressed the emergency stop.
    #[error("emergency stop; release it (emergency_stop: false), then enable")]
    EmergencyStop,
    /// The handle was faster than `safety.max_speed`.
    #[error("the handle was faster than safety.max_speed; hold it still, then enable")]
    Velocity,
    /// The device stopped answering.
    #[error("the device stopped answering; connect it again, then enable")]
    DeviceLost,
    /// The device switched its motors off by itself.
    #[error("the device switched its motors off: {}; then enable", remedy(.0))]
    DeviceMotorsOff(MotorsOff),
    /// The device's readings were not finite for too long.
    #[error("the device's readings are not finite; check device and cable, then enable")]
    NotFinite,
    /// The safety layer itself came to a force that is not finite.
    #[error(
        "the safety layer came to a force that is not finite; report this with the log and the device's model, then enable"
    )]
    ForceNotFinite,
    /// The ROS thread was silent for longer than `safety.ros_timeout`.
    #[error(
        "the ROS thread has not been heard of for safety.ros_timeout; restart the driver if it stays silent, otherwise enable"
    )]
    RosThreadHung,
    /// Homing did not work.
    #[error("the device could not be homed; free the handle, then enable and home again")]
    HomingFailed,
}

fn remedy(reason: &MotorsOff) -> &'static str {
    match reason {
        MotorsOff::Button => "the force button is not pressed; press it",
        MotorsOff::Velocity => "the handle was faster than the device allows; hold it still",
        MotorsOff::Watchdog => "no command reached it in time; see the motor loop's late periods",
        MotorsOff::Software => "software told it to; stop other programs that use it",
        MotorsOff::Usb => "the cable was pulled; plug it in",
        MotorsOff::DeadMan => "the dead man's switch was released; hold it",
        MotorsOff::Emergency => "its own emergency stop was pressed; release it",
        MotorsOff::Other => "for a reason of its own; see its manual",
    }
}

/// Keeps the first cause of a fault. A command clears it by beginning with an empty one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FaultLatch {
    cause: Option<FaultCause>,
}

impl FaultLatch {
    /// Latches a cause; one that is latched already stays. RT safe.
    pub fn raise(&mut self, cause: FaultCause) {
        self.cause.get_or_insert(cause);
    }

    /// The first cause. RT safe.
    pub fn cause(&self) -> Option<FaultCause> {
        self.cause
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_cause_stays() {
        let mut latch = FaultLatch::default();
        assert_eq!(latch.cause(), None);
        latch.raise(FaultCause::Velocity);
        latch.raise(FaultCause::DeviceLost);
        assert_eq!(latch.cause(), Some(FaultCause::Velocity));
    }

    #[test]
    fn every_cause_says_what_happened_and_what_to_do() {
        let off = [
            MotorsOff::Button,
            MotorsOff::Velocity,
            MotorsOff::Watchdog,
            MotorsOff::Software,
            MotorsOff::Usb,
            MotorsOff::DeadMan,
            MotorsOff::Emergency,
            MotorsOff::Other,
        ];
        let others = [
            FaultCause::EmergencyStop,
            FaultCause::Velocity,
            FaultCause::DeviceLost,
            FaultCause::NotFinite,
            FaultCause::ForceNotFinite,
            FaultCause::RosThreadHung,
            FaultCause::HomingFailed,
        ];
        let mut sentences: Vec<String> =
            off.map(FaultCause::DeviceMotorsOff).into_iter().chain(others).map(|c| c.to_string()).collect();
        for sentence in &sentences {
            assert!(sentence.contains("; ") && (sentence.contains("enable") || sentence.contains("home")));
        }
        let count = sentences.len();
        sentences.sort();
        sentences.dedup();
        assert_eq!(sentences.len(), count);
    }
}
