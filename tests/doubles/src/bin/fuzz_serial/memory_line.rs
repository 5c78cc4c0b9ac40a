//! A line without a port: a stream to read in random pieces, a store for what is written, and a clock of its own.

use std::io::{self, ErrorKind};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use devices::serial::Line;
use fastrand::Rng;

/// How the line ends when the stream does.
#[derive(Clone, Copy)]
enum End {
    Quiet,
    HangsUp,
    Fails,
}

/// Everything that was written, for whoever looks at it later.
pub(crate) type Written = Arc<Mutex<Vec<u8>>>;

pub(crate) struct MemoryLine {
    stream: Vec<u8>,
    at: usize,
    end: End,
    largest: usize,
    now_ns: u64,
    unsent: usize,
    written: Written,
    random: Rng,
}

impl MemoryLine {
    pub(crate) fn new(stream: Vec<u8>, random: &mut Rng) -> (MemoryLine, Written) {
        let written = Written::default();
        let end = *random.choice([End::Quiet, End::HangsUp, End::Fails].iter()).unwrap_or(&End::Quiet);
        let line = MemoryLine {
            stream,
            at: 0,
            end,
            largest: random.usize(1..400),
            now_ns: random.u64(0..1 << 60),
            unsent: 0,
            written: written.clone(),
            random: random.fork(),
        };
        (line, written)
    }
}

impl Line for MemoryLine {
    fn now_ns(&self) -> u64 {
        self.now_ns
    }

    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        self.now_ns += self.random.u64(0..50_000);
        let left = &self.stream[self.at..];
        if left.is_empty() {
            return match self.end {
                End::Quiet => Err(ErrorKind::WouldBlock.into()),
                End::HangsUp => Ok(0),
                End::Fails => Err(io::Error::from_raw_os_error(libc::EIO)),
            };
        }
        match self.random.u8(0..8) {
            0 => Err(ErrorKind::WouldBlock.into()),
            1 => Err(ErrorKind::Interrupted.into()),
            _ => {
                let count = self.random.usize(1..=self.largest).min(left.len()).min(into.len());
                into[..count].copy_from_slice(&left[..count]);
                self.at += count;
                Ok(count)
            }
        }
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = match self.random.u8(0..4) {
            0 => return Err(ErrorKind::WouldBlock.into()),
            1 => self.random.usize(1..=bytes.len()),
            _ => bytes.len(),
        };
        self.unsent += count;
        self.written.lock().unwrap_or_else(PoisonError::into_inner).extend(&bytes[..count]);
        Ok(count)
    }

    fn unsent(&self) -> usize {
        self.unsent
    }

    fn wait(&mut self, time: Duration) {
        self.now_ns += time.as_nanos() as u64;
        self.unsent = self.unsent.saturating_sub(self.random.usize(0..100));
    }
}
