//! The three things the motor loop asks of the operating system: the time, to sleep until a time, and priority.

#![expect(
    unsafe_code,
    reason = "clock_gettime, clock_nanosleep and pthread_setschedparam have no safe wrapper in std"
)]

use std::fmt;

/// How the operating system runs the motor loop's thread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheduling {
    /// `SCHED_FIFO`: it runs before all ordinary threads.
    Fifo {
        /// 1 to 99.
        priority: i32,
    },
    /// Like any other thread, because real-time priority was not permitted.
    Ordinary {
        /// The operating system's error number.
        errno: i32,
    },
}

impl fmt::Display for Scheduling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Scheduling::Fifo { priority } => write!(f, "SCHED_FIFO priority {priority}"),
            Scheduling::Ordinary { errno } => write!(
                f,
                "ordinary priority: SCHED_FIFO was refused ({}); allow it with an rtprio limit for this user",
                std::io::Error::from_raw_os_error(*errno)
            ),
        }
    }
}

/// Asks for `SCHED_FIFO` for the calling thread.
pub(crate) fn request_fifo(priority: i32) -> Scheduling {
    let parameter = libc::sched_param { sched_priority: priority };
    // SAFETY: pthread_self is always valid, and the parameter outlives the call.
    let errno =
        unsafe { libc::pthread_setschedparam(libc::pthread_self(), libc::SCHED_FIFO, &raw const parameter) };
    if errno == 0 { Scheduling::Fifo { priority } } else { Scheduling::Ordinary { errno } }
}

/// Time since some fixed moment, ns; it never goes back. RT safe.
pub fn monotonic_ns() -> u64 {
    let time = read_clock(libc::CLOCK_MONOTONIC);
    time.tv_sec as u64 * 1_000_000_000 + time.tv_nsec as u64
}

/// The system's time, ns since 1970. It can be set. RT safe.
pub(crate) fn system_ns() -> i64 {
    let time = read_clock(libc::CLOCK_REALTIME);
    time.tv_sec * 1_000_000_000 + time.tv_nsec
}

fn read_clock(clock: libc::clockid_t) -> libc::timespec {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: the pointer is valid for the call; it fails only for an unknown clock, and Linux has both of ours.
    unsafe { libc::clock_gettime(clock, &raw mut time) };
    time
}

/// Sleeps until the monotonic clock shows `deadline_ns`; returns at once when that is past. RT safe.
pub(crate) fn sleep_until(deadline_ns: u64) {
    let deadline = libc::timespec {
        tv_sec: (deadline_ns / 1_000_000_000) as libc::time_t,
        tv_nsec: (deadline_ns % 1_000_000_000) as libc::c_long,
    };
    loop {
        // SAFETY: the deadline outlives the call; with TIMER_ABSTIME no remaining time is written.
        let error = unsafe {
            libc::clock_nanosleep(
                libc::CLOCK_MONOTONIC,
                libc::TIMER_ABSTIME,
                &raw const deadline,
                std::ptr::null_mut(),
            )
        };
        if error != libc::EINTR {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sleep_never_ends_before_its_deadline() {
        let deadline_ns = monotonic_ns() + 3_000_000;
        sleep_until(deadline_ns);
        assert!(monotonic_ns() >= deadline_ns);
        sleep_until(0);
    }

    #[test]
    fn a_refused_priority_says_how_to_get_it() {
        let text = Scheduling::Ordinary { errno: libc::EPERM }.to_string();
        assert!(text.contains("SCHED_FIFO") && text.contains("rtprio"), "{text}");
    }
}
