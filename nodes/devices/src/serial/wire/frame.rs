//! A frame: payload and CRC-16, stuffed so that the byte 0 is left to end it.

use crc::{CRC_16_IBM_3740, Crc};

/// The longest payload: with its checksum less than one block of COBS, so that stuffing always costs one byte.
pub const MAX_PAYLOAD: usize = 251;
/// The longest frame: stuffing byte, payload, checksum, end.
pub const MAX_FRAME: usize = 1 + MAX_PAYLOAD + CHECKSUM + 1;
const CHECKSUM: usize = 2;

/// CRC-16/IBM-3740, also known as CCITT-FALSE: polynomial 0x1021, start 0xffff, nothing reflected, nothing added.
static CRC: Crc<u16> = Crc::<u16>::new(&CRC_16_IBM_3740);

/// The checksum of a payload.
pub fn checksum(payload: &[u8]) -> u16 {
    CRC.checksum(payload)
}

/// A payload, ready to send.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    bytes: [u8; MAX_FRAME],
    length: usize,
}

impl Frame {
    /// Frames a payload; none when it is empty or longer than [`MAX_PAYLOAD`].
    pub fn new(payload: &[u8]) -> Option<Frame> {
        if payload.is_empty() || payload.len() > MAX_PAYLOAD {
            return None;
        }
        let mut plain = [0; MAX_PAYLOAD + CHECKSUM];
        let end = payload.len() + CHECKSUM;
        plain[..payload.len()].copy_from_slice(payload);
        plain[payload.len()..end].copy_from_slice(&checksum(payload).to_le_bytes());
        let mut bytes = [0; MAX_FRAME];
        let stuffed = cobs::try_encode(&plain[..end], &mut bytes).ok()?;
        Some(Frame { bytes, length: stuffed + 1 })
    }

    /// What goes over the line: no 0 but the last byte.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes[..self.length]
    }
}

/// Why bytes between two zeros are no frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BadFrame {
    /// Longer than any frame.
    TooLong,
    /// Not stuffed bytes, or fewer than a payload and its checksum.
    Stuffing,
    /// The checksum is not the payload's.
    Checksum,
}

/// Finds frames in a stream of bytes that may begin, break off and be wrong anywhere.
#[derive(Clone, Debug)]
pub struct Receiver {
    bytes: [u8; MAX_FRAME],
    length: usize,
    too_long: bool,
}

impl Default for Receiver {
    fn default() -> Receiver {
        Receiver { bytes: [0; MAX_FRAME], length: 0, too_long: false }
    }
}

impl Receiver {
    /// The payload of the next frame in `input`, from whose front everything used is taken; none when all of it was
    /// used and the frame goes on. An end without anything before it is no frame and no fault.
    pub fn next<'a>(&'a mut self, input: &mut &[u8]) -> Option<Result<&'a [u8], BadFrame>> {
        loop {
            let Some(end) = input.iter().position(|&byte| byte == 0) else {
                self.keep(input);
                *input = &[];
                return None;
            };
            self.keep(&input[..end]);
            *input = &input[end + 1..];
            if self.length > 0 || self.too_long {
                break;
            }
        }
        let length = std::mem::take(&mut self.length);
        if std::mem::take(&mut self.too_long) {
            return Some(Err(BadFrame::TooLong));
        }
        Some(unframe(&mut self.bytes[..length]))
    }

    fn keep(&mut self, part: &[u8]) {
        let end = self.length + part.len();
        // The end itself is never kept.
        if end >= MAX_FRAME {
            self.too_long = true;
            self.length = 0;
        }
        if !self.too_long {
            self.bytes[self.length..end].copy_from_slice(part);
            self.length = end;
        }
    }
}

fn unframe(stuffed: &mut [u8]) -> Result<&[u8], BadFrame> {
    let length = cobs::decode_in_place(stuffed).map_err(|_| BadFrame::Stuffing)?;
    let (payload, sum) = stuffed[..length].split_last_chunk::<CHECKSUM>().ok_or(BadFrame::Stuffing)?;
    match payload.is_empty() {
        true => Err(BadFrame::Stuffing),
        false if checksum(payload) == u16::from_le_bytes(*sum) => Ok(payload),
        false => Err(BadFrame::Checksum),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn received(stream: &[u8], chunk: usize) -> Vec<Result<Vec<u8>, BadFrame>> {
        let mut receiver = Receiver::default();
        let mut found = Vec::new();
        for mut part in stream.chunks(chunk) {
            while let Some(frame) = receiver.next(&mut part) {
                found.push(frame.map(<[u8]>::to_vec));
            }
        }
        found
    }

    #[test]
    fn the_checksum_is_the_one_of_the_catalogue() {
        assert_eq!(checksum(b"123456789"), 0x29b1);
    }

    #[test]
    fn a_payload_that_does_not_fit_one_block_is_no_frame() {
        assert!(Frame::new(&[]).is_none());
        assert!(Frame::new(&[1; MAX_PAYLOAD + 1]).is_none());
        let longest = Frame::new(&[1; MAX_PAYLOAD]).unwrap();
        assert_eq!(received(longest.bytes(), 7), [Ok(vec![1; MAX_PAYLOAD])]);
    }

    #[test]
    fn whatever_is_longer_than_a_frame_is_one_fault_and_the_next_frame_is_found() {
        let mut stream = vec![0xaa; 100_000];
        stream.push(0);
        stream.extend(Frame::new(b"after").unwrap().bytes());
        assert_eq!(received(&stream, 64), [Err(BadFrame::TooLong), Ok(b"after".to_vec())]);
    }

    #[test]
    fn half_a_frame_spoils_itself_alone() {
        let frame = Frame::new(b"one payload").unwrap();
        let mut stream = frame.bytes()[..6].to_vec();
        stream.push(0);
        stream.extend(frame.bytes());
        let found = received(&stream, 5);
        assert!(found[0].is_err());
        assert_eq!(found[1..], [Ok(b"one payload".to_vec())]);
    }

    proptest! {
        #[test]
        fn what_is_framed_is_received_whatever_the_chunks(
            payloads in prop::collection::vec(prop::collection::vec(any::<u8>(), 1..=MAX_PAYLOAD), 1..5),
            chunk in 1..300usize,
        ) {
            let mut stream = Vec::new();
            for payload in &payloads {
                let frame = Frame::new(payload).unwrap();
                prop_assert_eq!(frame.bytes().len(), payload.len() + 4);
                prop_assert_eq!(frame.bytes().iter().filter(|&&byte| byte == 0).count(), 1);
                stream.extend(frame.bytes());
            }
            let found: Vec<_> = received(&stream, chunk).into_iter().map(Result::unwrap).collect();
            prop_assert_eq!(found, payloads);
        }

        #[test]
        fn a_burst_of_up_to_16_wrong_bits_is_never_a_frame(
            payload in prop::collection::vec(any::<u8>(), 1..=120),
            burst in 1..=u16::MAX,
            at in any::<prop::sample::Index>(),
        ) {
            let mut plain = payload.clone();
            plain.extend(checksum(&payload).to_le_bytes());
            let at = at.index(plain.len() - 1);
            for (byte, wrong) in plain[at..].iter_mut().zip(burst.to_be_bytes()) {
                *byte ^= wrong;
            }
            let mut stream = [0; MAX_FRAME];
            let length = cobs::encode(&plain, &mut stream);
            prop_assert_eq!(received(&stream[..=length], 16), [Err(BadFrame::Checksum)]);
        }
    }
}
