//! Fields one after the other, little endian.

use super::{Frame, MAX_PAYLOAD, WrongMessage};

/// A payload being written.
pub(super) struct Payload {
    bytes: [u8; MAX_PAYLOAD],
    length: usize,
}

impl Payload {
    pub(super) fn new(kind: u8) -> Payload {
        let mut bytes = [0; MAX_PAYLOAD];
        bytes[0] = kind;
        Payload { bytes, length: 1 }
    }

    pub(super) fn put(&mut self, field: &[u8]) {
        let end = self.length + field.len();
        self.bytes[self.length..end].copy_from_slice(field);
        self.length = end;
    }

    pub(super) fn floats(&mut self, fields: &[f32]) {
        for field in fields {
            self.put(&field.to_le_bytes());
        }
    }

    /// What was written, ready to send.
    pub(super) fn framed(&self) -> Frame {
        #[expect(clippy::expect_used, reason = "no message is empty, nor longer than a hello's 140 bytes")]
        Frame::new(&self.bytes[..self.length]).expect("a message fits a frame")
    }
}

/// A payload being read.
pub(super) struct Fields<'a>(&'a [u8]);

impl Fields<'_> {
    pub(super) fn new(payload: &[u8]) -> Fields<'_> {
        Fields(payload)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn bytes<const N: usize>(&mut self) -> Result<[u8; N], WrongMessage> {
        let (field, rest) = self.0.split_first_chunk::<N>().ok_or(WrongMessage::Length)?;
        self.0 = rest;
        Ok(*field)
    }

    pub(super) fn u8(&mut self) -> Result<u8, WrongMessage> {
        Ok(self.bytes::<1>()?[0])
    }

    pub(super) fn u16(&mut self) -> Result<u16, WrongMessage> {
        Ok(u16::from_le_bytes(self.bytes()?))
    }

    pub(super) fn f32(&mut self) -> Result<f32, WrongMessage> {
        Ok(f32::from_le_bytes(self.bytes()?))
    }

    pub(super) fn f32s<const N: usize>(&mut self) -> Result<[f32; N], WrongMessage> {
        let mut floats = [0.0; N];
        for float in &mut floats {
            *float = self.f32()?;
        }
        Ok(floats)
    }
}
