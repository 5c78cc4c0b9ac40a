//! Reports of the device, byte by byte.
//!
//! Byte 0 is the report's id, numbers are 16 bit, low byte first (PySpaceMouse's `devices.toml`; descriptors and traffic of
//! a SpaceNavigator and a SpaceMouse Wireless in AndunHH/spacemouse):
//!
//! | id | bytes | what |
//! |---|---|---|
//! | 1 | 7 | translation x y z |
//! | 2 | 7 | rotation x y z |
//! | 1 | 13 | translation and rotation in one: Wireless, Pro Wireless, Enterprise |
//! | 3 | 2 and more | pressed buttons, one bit each |
//!
//! Each axis goes from -350 to 350 by the descriptor. The cap's own frame is right-handed: x right, y toward the user,
//! z down; rotations are about these axes.

/// The longest report that is read; longer ones of other kinds are cut off.
pub(super) const LONGEST_REPORT: usize = 64;

/// The cap and the buttons, as last reported.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Cap {
    /// Translation along the cap's own axes.
    pub(super) translation: [i16; 3],
    /// Rotation about them.
    pub(super) rotation: [i16; 3],
    /// One bit for each pressed button.
    pub(super) buttons: u32,
}

impl Cap {
    /// Takes a report; false when it is none of the axes or buttons, or too short. RT safe.
    pub(super) fn take(&mut self, report: &[u8]) -> bool {
        match report {
            [1, axes @ ..] => match (three(axes), axes.get(6..).and_then(three)) {
                (Some(translation), Some(rotation)) => {
                    (self.translation, self.rotation) = (translation, rotation);
                }
                (Some(translation), None) => self.translation = translation,
                (None, _) => return false,
            },
            [2, axes @ ..] => match three(axes) {
                Some(rotation) => self.rotation = rotation,
                None => return false,
            },
            [3, mask @ ..] if !mask.is_empty() => {
                self.buttons = mask
                    .iter()
                    .take(4)
                    .enumerate()
                    .fold(0, |bits, (at, &byte)| bits | u32::from(byte) << (8 * at));
            }
            _ => return false,
        }
        true
    }

    /// Whether the cap is not in its middle.
    pub(super) fn is_deflected(&self) -> bool {
        self.translation != [0; 3] || self.rotation != [0; 3]
    }
}

fn three(bytes: &[u8]) -> Option<[i16; 3]> {
    match bytes {
        [a, b, c, d, e, f, ..] => {
            Some([i16::from_le_bytes([*a, *b]), i16::from_le_bytes([*c, *d]), i16::from_le_bytes([*e, *f])])
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn two_reports_carry_translation_and_rotation_apart() {
        let mut cap = Cap::default();
        assert!(cap.take(&[1, 0x5e, 0x01, 0xa2, 0xfe, 0x00, 0x00]));
        assert_eq!((cap.translation, cap.rotation), ([350, -350, 0], [0; 3]));
        assert!(cap.take(&[2, 1, 0, 2, 0, 0xff, 0xff]));
        assert_eq!((cap.translation, cap.rotation), ([350, -350, 0], [1, 2, -1]));
    }

    #[test]
    fn one_report_carries_all_six_axes() {
        let mut cap = Cap::default();
        assert!(cap.take(&[1, 1, 0, 2, 0, 3, 0, 4, 0, 5, 0, 0xfa, 0xff]));
        assert_eq!((cap.translation, cap.rotation), ([1, 2, 3], [4, 5, -6]));
    }

    #[test]
    fn buttons_are_bits_from_the_first_byte_on() {
        let mut cap = Cap::default();
        assert!(cap.take(&[3, 0b10]));
        assert_eq!(cap.buttons, 0b10);
        assert!(cap.take(&[3, 1, 0, 0x80, 0x40, 0xff]));
        assert_eq!(cap.buttons, 0x4080_0001);
    }

    #[test]
    fn half_reports_and_others_change_nothing() {
        let mut cap = Cap::default();
        assert!(cap.take(&[1, 1, 0, 2, 0, 3, 0]));
        let before = cap;
        // The battery of the wireless models is report 0x17.
        let others: [&[u8]; 7] =
            [&[], &[1], &[1, 9, 9, 9, 9, 9], &[2, 9, 9, 9], &[3], &[0x17, 100, 1], &[0; 13]];
        for report in others {
            assert!(!cap.take(report), "{report:?}");
            assert_eq!(cap, before);
        }
    }

    proptest! {
        #[test]
        fn any_bytes_are_taken_or_left_and_never_fall_over(
            reports in prop::collection::vec(prop::collection::vec(any::<u8>(), 0..LONGEST_REPORT + 1), 0..40),
        ) {
            let mut cap = Cap::default();
            for report in &reports {
                let before = cap;
                if !cap.take(report) {
                    prop_assert_eq!(cap, before);
                }
            }
        }
    }
}
