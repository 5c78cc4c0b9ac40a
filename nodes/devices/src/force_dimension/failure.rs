//! What the SDK's error numbers mean.

use std::ffi::c_int;

/// A call that answered with a negative number, by the number of `dhdErrorGetLast` in the same thread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Failure(pub(super) c_int);

impl Failure {
    pub(super) const NO_DRIVER_FOUND: Failure = Failure(4);
    pub(super) const TIMEOUT: Failure = Failure(7);

    /// Whether another program holds the device.
    pub(super) fn is_busy(self) -> bool {
        matches!(self.0, 3 | 20)
    }

    /// Whether the device cannot do what was asked, as opposed to having failed at it.
    pub(super) fn is_unsupported(self) -> bool {
        matches!(self.0, 6 | 10 | 16)
    }

    /// In words. RT safe.
    pub(super) fn text(self) -> &'static str {
        match self.0 {
            0 | 1 => "the SDK reports an error without saying which",
            2 => "the communication with the device failed",
            3 => "the device controller is busy",
            4 => "the SDK finds no USB driver for it",
            5 => "the device is gone from the bus",
            6 => "the device is not available",
            7 => "the device did not answer in time",
            8 => "the device's geometry is not valid",
            9 => "the SDK's expert mode is off",
            10 => "the SDK has not implemented this",
            11 => "the SDK is out of memory",
            12 => "the device is not ready",
            13 => "the SDK misses a file",
            14 => "the device's configuration cannot be read",
            15 => "the SDK does not know this device number",
            16 => "the SDK has dropped this function",
            17 => "the SDK was given no place to write to",
            18 => "the device's redundant sensors disagree",
            19 => "the device has this switched off",
            20 => "the device is in use by another program",
            21 => "the SDK found a parameter not valid",
            22 => "the robotic regulation is not running",
            _ => "the SDK reports an error number that is not documented",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_documented_number_has_its_own_words() {
        let texts: std::collections::BTreeSet<_> = (1..=23).map(|number| Failure(number).text()).collect();
        assert_eq!(texts.len(), 23);
    }

    #[test]
    fn only_two_numbers_mean_that_another_program_has_it() {
        assert_eq!((0..40).filter(|&number| Failure(number).is_busy()).collect::<Vec<_>>(), [3, 20]);
    }
}
