//! What can be asked of the motors, as plain data.

use std::str::FromStr;
use std::sync::Arc;

use rhombus_chain::{ContactLaw, LocalLaw};

use crate::Wrench;

/// Who decides on the force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ForceSource {
    /// The motor loop, by the newest contact law; without a valid one the newest commanded wrench.
    #[default]
    ContactLaw,
    /// The newest commanded wrench only.
    ServoForce,
}

impl FromStr for ForceSource {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "contact_law" => Ok(ForceSource::ContactLaw),
            "servo_cf" => Ok(ForceSource::ServoForce),
            _ => Err(format!("force source \"{text}\": accepted are \"contact_law\" and \"servo_cf\"")),
        }
    }
}

/// What the motors do with the sources.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SourceMode {
    /// They follow them.
    #[default]
    Follow,
    /// They give no force, whatever is commanded (CRTK `free`).
    Free,
    /// They hold the handle at the pose at which this began (CRTK `hold`).
    Hold,
}

/// A contact law for the motor loop, in the device frame.
#[derive(Clone, Debug)]
pub struct LawCommand {
    /// Stamp of the sample that the law was computed from, as this loop gave it.
    pub stamp_ns: i64,
    /// How long after that stamp the law may be used.
    pub validity_ns: i64,
    /// Where and how the body is touched.
    pub local: LocalLaw,
    /// The chains. Shared, because they change far less often than the place.
    pub chains: Arc<ContactLaw>,
}

/// In which axes a wrench is said. The force acts at the handle's origin either way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Axes {
    /// The device frame's, which stand still.
    #[default]
    Base,
    /// The handle's: the wrench turns with the handle for as long as it is used.
    Tip,
}

/// A wrench for the motors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ServoCommand {
    /// Since when it counts, by [`monotonic_ns`](crate::monotonic_ns): its stamp, or its arrival where it has none. Later
    /// for every command.
    pub since_ns: u64,
    /// Until when the wrench's gripper force counts, by the same clock; it has a stamp of its own.
    pub gripper_until_ns: u64,
    /// On the hand.
    pub wrench: Wrench,
    /// Its axes.
    pub axes: Axes,
}

/// A moment on both clocks of the motor loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Moment {
    /// By [`monotonic_ns`](crate::monotonic_ns).
    pub monotonic_ns: u64,
    /// By the stamp clock, which gives the samples their stamps.
    pub stamp_ns: i64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_source_is_named_as_its_topic() {
        assert_eq!("contact_law".parse(), Ok(ForceSource::ContactLaw));
        assert_eq!("servo_cf".parse(), Ok(ForceSource::ServoForce));
        assert!("servo".parse::<ForceSource>().unwrap_err().contains("servo_cf"));
    }
}
