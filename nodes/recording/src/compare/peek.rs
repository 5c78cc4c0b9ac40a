//! Looks at single values of a message without decoding it: its stamp, and the number that is drawn for it.
//!
//! A comparison of equal messages does nothing else with them, so this is what makes it quick.

use super::kind::Kind;

/// Walks over a message; any bytes give values or `None`.
struct Cursor<'a> {
    /// Behind the CDR header.
    body: &'a [u8],
    at: usize,
    big_endian: bool,
}

impl<'a> Cursor<'a> {
    fn new(data: &'a [u8]) -> Option<Self> {
        match data {
            [0x00, order @ (0 | 1), _, _, body @ ..] => Some(Self { body, at: 0, big_endian: *order == 0 }),
            _ => None,
        }
    }

    fn skip(&mut self, bytes: usize) -> Option<()> {
        self.at = self.at.checked_add(bytes)?;
        Some(())
    }

    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        self.at = self.at.checked_next_multiple_of(N)?;
        let mut bytes: [u8; N] = *self.body.get(self.at..)?.first_chunk()?;
        self.at += N;
        if self.big_endian {
            bytes.reverse();
        }
        Some(bytes)
    }

    fn u32(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    fn f64(&mut self) -> Option<f64> {
        self.take().map(f64::from_le_bytes)
    }

    /// The stamp in ns since 1970; every compared message begins with one.
    fn stamp_ns(&mut self) -> Option<i64> {
        let sec = self.take().map(i32::from_le_bytes)?;
        let nanosec = self.u32()?;
        Some(i64::from(sec) * 1_000_000_000 + i64::from(nanosec))
    }

    fn skip_text(&mut self) -> Option<()> {
        let length = self.u32()?;
        self.skip(length as usize)
    }
}

/// The stamp of a message with a header, ns since 1970.
pub(super) fn stamp_ns(data: &[u8]) -> Option<i64> {
    Cursor::new(data)?.stamp_ns()
}

/// Stamp and drawn number of a message: |force| in N, depth in m, or the largest displacement in m. The number is NaN for
/// kinds of which nothing is drawn and where it cannot be read.
pub(super) fn sample(kind: Kind, data: &[u8]) -> Option<(i64, f64)> {
    let mut cursor = Cursor::new(data)?;
    let stamp_ns = cursor.stamp_ns()?;
    Some((stamp_ns, drawn(kind, &mut cursor).unwrap_or(f64::NAN)))
}

fn drawn(kind: Kind, cursor: &mut Cursor<'_>) -> Option<f64> {
    match kind {
        Kind::Wrench => {
            cursor.skip_text()?;
            let [x, y, z] = [cursor.f64()?, cursor.f64()?, cursor.f64()?];
            Some((x * x + y * y + z * z).sqrt())
        }
        Kind::Contact => {
            cursor.skip_text()?;
            // mode, saturated, clutched; face; barycentric, probe, proxy, normal.
            cursor.skip(3)?;
            cursor.u32()?;
            cursor.f64()?;
            cursor.skip(11 * size_of::<f64>())?;
            cursor.f64()
        }
        Kind::Surface => {
            cursor.skip_text()?;
            cursor.u32()?;
            let vertices = cursor.u32()? as usize;
            cursor.skip(vertices.checked_mul(size_of::<u32>())?)?;
            let components = cursor.u32()? as usize;
            let bytes = cursor.body.get(cursor.at..)?.get(..components.checked_mul(size_of::<f32>())?)?;
            let squared = if cursor.big_endian {
                largest_squared(bytes, f32::from_be_bytes)
            } else {
                largest_squared(bytes, f32::from_le_bytes)
            };
            Some(squared.sqrt())
        }
        Kind::Law | Kind::Pose | Kind::Twist | Kind::Joints => None,
    }
}

/// Of vectors of three numbers. `max` passes over a NaN, which cannot be drawn.
fn largest_squared(bytes: &[u8], number: impl Fn([u8; 4]) -> f32) -> f64 {
    let (numbers, _) = bytes.as_chunks::<4>();
    let (vectors, _) = numbers.as_chunks::<3>();
    let squared = |vector: &[[u8; 4]; 3]| {
        let [x, y, z] = vector.map(|bytes| f64::from(number(bytes)));
        x * x + y * y + z * z
    };
    vectors.iter().map(squared).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::{Kind, sample, stamp_ns};
    use crate::cdr::encode;
    use crate::messages::{ContactState, Header, SurfaceDisplacement, Time, Vector3, Wrench, WrenchStamped};

    fn header(frame_id: &str) -> Header {
        Header { stamp: Time { sec: -1, nanosec: 7 }, frame_id: frame_id.to_owned() }
    }

    #[test]
    fn the_drawn_number_is_read_whatever_the_length_of_the_frame() {
        for frame_id in ["", "a", "ab", "abc", "abcd", "a_longer_frame"] {
            let force = Vector3 { x: 3.0, y: 0.0, z: -4.0 };
            let wrench = Wrench { force, torque: Vector3::default() };
            let wrench = encode(&WrenchStamped { header: header(frame_id), wrench });
            assert_eq!(sample(Kind::Wrench, &wrench), Some((-999_999_993, 5.0)), "{frame_id:?}");

            let contact = ContactState { header: header(frame_id), depth: 0.25, ..ContactState::default() };
            assert_eq!(sample(Kind::Contact, &encode(&contact)), Some((-999_999_993, 0.25)), "{frame_id:?}");

            let surface = SurfaceDisplacement {
                header: header(frame_id),
                topology_version: 1,
                vertex: vec![4, 9],
                displacement: vec![0.0, 0.5, 0.0, 3.0, 4.0, 0.0],
            };
            assert_eq!(sample(Kind::Surface, &encode(&surface)), Some((-999_999_993, 5.0)), "{frame_id:?}");
        }
    }

    #[test]
    fn a_message_that_ends_early_has_a_stamp_or_nothing_and_no_number() {
        let whole = encode(&WrenchStamped { header: header("base"), ..WrenchStamped::default() });
        for length in 0..whole.len() {
            let cut = &whole[..length];
            assert_eq!(stamp_ns(cut).is_some(), length >= 12);
            if length < 48 {
                assert!(sample(Kind::Wrench, cut).is_none_or(|(_, force)| force.is_nan()));
            }
        }
        let absurd = [&whole[..12], &[0xff; 40]].concat();
        assert!(sample(Kind::Surface, &absurd).is_some_and(|(_, largest)| largest.is_nan()));
    }
}
