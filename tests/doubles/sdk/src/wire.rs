//! What passes between library and device process: frames of fixed length, numbers as 64-bit floats, little endian.

use std::io::{self, Read, Write};

/// What is asked of the device process.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Call {
    /// The SDK's version: four numbers.
    Version = 1,
    /// How many devices are on the bus.
    Count,
    /// How many of them no other program has.
    Available,
    /// Opens the device with this place on the bus; the answer is its number.
    Open,
    /// Closes it.
    Close,
    /// Serial, type, controller version, left-handed, wrist, active wrist, gripper, active gripper, largest force,
    /// torque and gripper force.
    Info,
    /// The 17 status numbers.
    Status,
    /// Motors on (1) or off (0).
    EnableForce,
    /// Brakes on (1) or off (0).
    Brakes,
    /// Gravity compensation on (1) or off (0).
    Gravity,
    /// Position (3), rows of the frame (9), linear (3) and angular velocity (3), gripper angle, buttons.
    Read,
    /// Force (3), torque (3), gripper force.
    Wrench,
    /// Sets the watchdog, units of 125 us.
    SetWatchdog,
    /// Answers with it.
    GetWatchdog,
    /// Whether the device can be homed.
    Supported,
    /// Whether it is.
    Initialized,
    /// Homes it; the answer comes when it is done.
    AutoInit,
    /// Ends the regulation that homing leaves behind; motors stay on (1) or brake (0).
    Stop,
}

impl Call {
    const ALL: [Call; 18] = [
        Call::Version,
        Call::Count,
        Call::Available,
        Call::Open,
        Call::Close,
        Call::Info,
        Call::Status,
        Call::EnableForce,
        Call::Brakes,
        Call::Gravity,
        Call::Read,
        Call::Wrench,
        Call::SetWatchdog,
        Call::GetWatchdog,
        Call::Supported,
        Call::Initialized,
        Call::AutoInit,
        Call::Stop,
    ];
}

/// A question.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request {
    /// Which.
    pub call: Call,
    /// Of which device: its number, or with [`Call::Open`] its place on the bus.
    pub device: i32,
    /// Its arguments.
    pub numbers: [f64; 7],
}

/// Its answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reply {
    /// What the SDK's function returns.
    pub answer: i32,
    /// The SDK's error number when that is negative.
    pub error: i32,
    /// What it writes.
    pub numbers: [f64; 20],
}

impl Request {
    /// Without arguments.
    pub fn of(call: Call, device: i32) -> Request {
        Request { call, device, numbers: [0.0; 7] }
    }

    /// Writes one frame.
    ///
    /// # Errors
    /// The other side is gone.
    pub fn write(&self, to: &mut impl Write) -> io::Result<()> {
        let mut frame = [0; 64];
        frame[..4].copy_from_slice(&(self.call as u32).to_le_bytes());
        frame[4..8].copy_from_slice(&self.device.to_le_bytes());
        put(&mut frame[8..], &self.numbers);
        to.write_all(&frame)
    }

    /// Waits for one frame.
    ///
    /// # Errors
    /// The other side is gone, or asks what is not known.
    pub fn read(from: &mut impl Read) -> io::Result<Request> {
        let mut frame = [0; 64];
        from.read_exact(&mut frame)?;
        let number = u32::from_le_bytes([frame[0], frame[1], frame[2], frame[3]]);
        let device = i32::from_le_bytes([frame[4], frame[5], frame[6], frame[7]]);
        let call = Call::ALL.into_iter().find(|&call| call as u32 == number);
        Ok(Request { call: call.ok_or(io::ErrorKind::InvalidData)?, device, numbers: get(&frame[8..]) })
    }
}

impl Reply {
    /// Success, with what it writes.
    pub fn of(answer: i32, written: &[f64]) -> Reply {
        let mut numbers = [0.0; 20];
        for (to, from) in numbers.iter_mut().zip(written) {
            *to = *from;
        }
        Reply { answer, error: 0, numbers }
    }

    /// A failure.
    pub fn failure(error: i32) -> Reply {
        Reply { answer: -1, error, numbers: [0.0; 20] }
    }

    /// Writes one frame.
    ///
    /// # Errors
    /// The other side is gone.
    pub fn write(&self, to: &mut impl Write) -> io::Result<()> {
        let mut frame = [0; 168];
        frame[..4].copy_from_slice(&self.answer.to_le_bytes());
        frame[4..8].copy_from_slice(&self.error.to_le_bytes());
        put(&mut frame[8..], &self.numbers);
        to.write_all(&frame)
    }

    /// Waits for one frame.
    ///
    /// # Errors
    /// The other side is gone.
    pub fn read(from: &mut impl Read) -> io::Result<Reply> {
        let mut frame = [0; 168];
        from.read_exact(&mut frame)?;
        let answer = i32::from_le_bytes([frame[0], frame[1], frame[2], frame[3]]);
        let error = i32::from_le_bytes([frame[4], frame[5], frame[6], frame[7]]);
        Ok(Reply { answer, error, numbers: get(&frame[8..]) })
    }
}

fn put(to: &mut [u8], numbers: &[f64]) {
    for (bytes, number) in to.chunks_exact_mut(8).zip(numbers) {
        bytes.copy_from_slice(&number.to_le_bytes());
    }
}

fn get<const N: usize>(from: &[u8]) -> [f64; N] {
    let mut numbers = [0.0; N];
    for (number, bytes) in numbers.iter_mut().zip(from.chunks_exact(8)) {
        let mut eight = [0; 8];
        eight.copy_from_slice(bytes);
        *number = f64::from_le_bytes(eight);
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        for call in Call::ALL {
            let request = Request { call, device: -3, numbers: [1.5, -2.0, 0.0, 4.0, 5.0, f64::MAX, 7.0] };
            let mut bytes = Vec::new();
            request.write(&mut bytes).unwrap();
            assert_eq!(Request::read(&mut bytes.as_slice()).unwrap(), request);
        }
        let reply = Reply::of(2, &[0.1, 0.2, 0.3]);
        let mut bytes = Vec::new();
        reply.write(&mut bytes).unwrap();
        assert_eq!(Reply::read(&mut bytes.as_slice()).unwrap(), reply);
    }

    #[test]
    fn an_unknown_question_is_refused() {
        assert_eq!(Request::read(&mut [0xff; 64].as_slice()).unwrap_err().kind(), io::ErrorKind::InvalidData);
    }
}
