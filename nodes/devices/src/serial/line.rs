//! What a device hangs on: bytes in, bytes out, and the time. A serial port is one ([`Port`](super::Port)); tests and
//! fuzzing have others.

use std::io;
use std::time::Duration;

/// A line that never makes its caller wait.
pub trait Line: Send {
    /// The time, ns; it never goes back. RT safe.
    fn now_ns(&self) -> u64;

    /// Bytes that have come, as many as there are and fit. RT safe.
    ///
    /// # Errors
    /// [`io::ErrorKind::WouldBlock`] when there are none now; 0 bytes or any other error: the line is gone.
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize>;

    /// Sends as much of `bytes` as can be taken now, and says how much. RT safe.
    ///
    /// # Errors
    /// [`io::ErrorKind::WouldBlock`] when nothing can be taken now; any other error: the line is gone.
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize>;

    /// Bytes taken by [`write`](Line::write) that have not left yet; 0 where nobody knows. RT safe.
    fn unsent(&self) -> usize;

    /// Lets time pass. Not RT safe.
    fn wait(&mut self, time: Duration);
}
