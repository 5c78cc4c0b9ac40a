//! The library's end of the socket, what it remembers of each device, and each thread's last error.

#![expect(unsafe_code, reason = "dladdr and clock_gettime have no safe wrapper in std")]

use std::cell::Cell;
use std::ffi::{CStr, OsStr};
use std::io;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use crate::{Call, Reply, Request, SOCKET};

/// Error numbers of the SDK.
pub(crate) const COM: i32 = 2;
pub(crate) const TIMEOUT: i32 = 7;
pub(crate) const EXPERT_MODE_DISABLED: i32 = 9;

/// A velocity needs two positions within this time, as `dhdConfigLinearVelocity` has it at first.
const VELOCITY_WINDOW_NS: u64 = 20_000_000;

static LINK: Mutex<Link> = Mutex::new(Link { stream: None, last: [Last::NONE; 16] });

thread_local! {
    static ERROR: Cell<i32> = const { Cell::new(0) };
}

struct Link {
    stream: Option<UnixStream>,
    last: [Last; 16],
}

/// The last reading of one device.
#[derive(Clone, Copy)]
struct Last {
    numbers: [f64; 20],
    /// When the last two readings were.
    times_ns: [Option<u64>; 2],
}

impl Last {
    const NONE: Last = Last { numbers: [0.0; 20], times_ns: [None; 2] };
}

/// The last error of this thread.
pub(crate) fn last_error() -> i32 {
    ERROR.get()
}

pub(crate) fn fail(error: i32) -> i32 {
    ERROR.set(error);
    -1
}

/// One exchange with the device process. A negative answer has set the thread's error.
pub(crate) fn ask(request: Request) -> Reply {
    let mut link = LINK.lock().unwrap_or_else(PoisonError::into_inner);
    let reply = link.exchange(&request).unwrap_or_else(|_| {
        link.stream = None;
        Reply::failure(COM)
    });
    if reply.answer < 0 {
        fail(reply.error);
    } else if request.call == Call::Read
        && let Some(last) = usize::try_from(request.device).ok().and_then(|device| link.last.get_mut(device))
    {
        *last = Last { numbers: reply.numbers, times_ns: [last.times_ns[1], Some(now_ns())] };
    }
    reply
}

/// Whether the device process is there; connects to it when needed.
pub(crate) fn is_connected() -> bool {
    LINK.lock().unwrap_or_else(PoisonError::into_inner).connect().is_ok()
}

/// The last reading of a device.
pub(crate) fn last(device: i32) -> [f64; 20] {
    let link = LINK.lock().unwrap_or_else(PoisonError::into_inner);
    usize::try_from(device).ok().and_then(|device| link.last.get(device)).unwrap_or(&Last::NONE).numbers
}

/// Whether two readings of a device lie within the velocity's window.
pub(crate) fn has_velocity(device: i32) -> bool {
    let link = LINK.lock().unwrap_or_else(PoisonError::into_inner);
    let last = usize::try_from(device).ok().and_then(|device| link.last.get(device));
    last.and_then(|last| last.times_ns[0])
        .is_some_and(|then| now_ns().saturating_sub(then) <= VELOCITY_WINDOW_NS)
}

impl Link {
    fn connect(&mut self) -> io::Result<&mut UnixStream> {
        let stream = match self.stream.take() {
            Some(stream) => stream,
            None => UnixStream::connect(own_folder().ok_or(io::ErrorKind::NotFound)?.join(SOCKET))?,
        };
        Ok(self.stream.insert(stream))
    }

    fn exchange(&mut self, request: &Request) -> io::Result<Reply> {
        let stream = self.connect()?;
        request.write(stream)?;
        Reply::read(stream)
    }
}

/// The folder that this library was loaded from.
fn own_folder() -> Option<PathBuf> {
    let mut info = libc::Dl_info {
        dli_fname: std::ptr::null(),
        dli_fbase: std::ptr::null_mut(),
        dli_sname: std::ptr::null(),
        dli_saddr: std::ptr::null_mut(),
    };
    let address: *const Mutex<Link> = &raw const LINK;
    // SAFETY: the address is one of this library's, and the answer outlives the call.
    if unsafe { libc::dladdr(address.cast(), &raw mut info) } == 0 || info.dli_fname.is_null() {
        return None;
    }
    // SAFETY: not null, and the loader's own text ends in NUL and stays while the library is loaded.
    let file = unsafe { CStr::from_ptr(info.dli_fname) };
    Path::new(OsStr::from_bytes(file.to_bytes())).parent().map(Path::to_path_buf)
}

fn now_ns() -> u64 {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the time outlives the call.
    unsafe { libc::clock_gettime(libc::CLOCK_MONOTONIC, &raw mut time) };
    time.tv_sec as u64 * 1_000_000_000 + time.tv_nsec as u64
}
