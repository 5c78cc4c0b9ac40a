//! What the motor loop asks of the operating system: the time, to sleep until a time, priority, memory that stays, a CPU.

#![expect(
    unsafe_code,
    reason = "clock_gettime, clock_nanosleep, pthread_setschedparam, mlockall and sched_setaffinity have no safe wrapper in std"
)]

use std::fmt;
use std::io;

/// How the operating system runs the motor loop's thread. What was refused is said with its reason and its remedy.
#[derive(Debug)]
pub struct Scheduling {
    priority: i32,
    fifo: io::Result<()>,
    memory: io::Result<()>,
    cpu: Option<(usize, io::Result<()>)>,
}

impl Scheduling {
    /// Asks for everything, for the calling thread; the memory is the whole process's.
    ///
    /// `priority` is that of `SCHED_FIFO`, 1 to 99: the thread then runs before all ordinary threads. Without a `cpu`
    /// it may run on any.
    pub fn request(priority: i32, cpu: Option<usize>) -> Scheduling {
        Scheduling {
            priority,
            fifo: request_fifo(priority),
            memory: lock_memory(),
            cpu: cpu.map(|cpu| (cpu, pin_to(cpu))),
        }
    }

    /// Whether the thread runs at the priority that was asked for.
    pub fn is_fifo(&self) -> bool {
        self.fifo.is_ok()
    }

    /// Whether all that was asked for was granted.
    pub fn is_granted(&self) -> bool {
        self.fifo.is_ok() && self.memory.is_ok() && self.cpu.as_ref().is_none_or(|(_, pinned)| pinned.is_ok())
    }
}

impl fmt::Display for Scheduling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.fifo {
            Ok(()) => write!(f, "SCHED_FIFO priority {}", self.priority)?,
            Err(error) => write!(
                f,
                "ordinary priority: SCHED_FIFO was refused ({error}); allow it with an rtprio limit for this user"
            )?,
        }
        match &self.memory {
            Ok(()) => write!(f, "; memory locked")?,
            Err(error) => {
                write!(f, "; memory not locked ({error}); allow it with a memlock limit for this user")?
            }
        }
        match &self.cpu {
            None => Ok(()),
            Some((cpu, Ok(()))) => write!(f, "; on CPU {cpu}"),
            Some((cpu, Err(error))) => write!(f, "; not bound to CPU {cpu} ({error})"),
        }
    }
}

fn request_fifo(priority: i32) -> io::Result<()> {
    let parameter = libc::sched_param { sched_priority: priority };
    // SAFETY: pthread_self is always valid, and the parameter outlives the call.
    let errno =
        unsafe { libc::pthread_setschedparam(libc::pthread_self(), libc::SCHED_FIFO, &raw const parameter) };
    if errno == 0 { Ok(()) } else { Err(io::Error::from_raw_os_error(errno)) }
}

fn lock_memory() -> io::Result<()> {
    // With a limit that is too small MCL_FUTURE would make later allocations fail instead of this call.
    let mut limit = libc::rlimit { rlim_cur: 0, rlim_max: 0 };
    // SAFETY: the pointer is valid for the call.
    if unsafe { libc::getrlimit(libc::RLIMIT_MEMLOCK, &raw mut limit) } != 0 {
        return Err(io::Error::last_os_error());
    }
    if limit.rlim_cur != libc::RLIM_INFINITY && !may_lock_all() {
        return Err(io::Error::other(format!("the limit is {} bytes", limit.rlim_cur)));
    }
    // On fault: what was used once stays, and the middleware's many unused stacks are not filled in.
    // SAFETY: the call takes flags only.
    if unsafe { libc::mlockall(libc::MCL_CURRENT | libc::MCL_FUTURE | libc::MCL_ONFAULT) } == 0 {
        Ok(())
    } else {
        Err(io::Error::last_os_error())
    }
}

/// Whether this process may lock memory whatever the limit is: `CAP_IPC_LOCK`.
fn may_lock_all() -> bool {
    const CAP_IPC_LOCK: u32 = 14;
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let effective = status.lines().find_map(|line| line.strip_prefix("CapEff:"));
    let bits = effective.and_then(|bits| u64::from_str_radix(bits.trim(), 16).ok());
    bits.is_some_and(|bits| bits & (1 << CAP_IPC_LOCK) != 0)
}

fn pin_to(cpu: usize) -> io::Result<()> {
    if cpu >= libc::CPU_SETSIZE as usize {
        return Err(io::Error::from_raw_os_error(libc::EINVAL));
    }
    // SAFETY: a set of CPUs is plain bits, and zero is the empty set.
    let mut set: libc::cpu_set_t = unsafe { std::mem::zeroed() };
    // SAFETY: the index was checked above.
    unsafe { libc::CPU_SET(cpu, &mut set) };
    // SAFETY: 0 is the calling thread; the set outlives the call and the size is its own.
    let refused = unsafe { libc::sched_setaffinity(0, size_of::<libc::cpu_set_t>(), &raw const set) } != 0;
    if refused { Err(io::Error::last_os_error()) } else { Ok(()) }
}

/// Keeps the calling thread's signals for other threads: a handler that waits for the motor loop must not run on it.
pub(crate) fn block_signals() {
    // SAFETY: an empty set is made before it is filled, and both pointers are valid for the calls.
    unsafe {
        let mut set: libc::sigset_t = std::mem::zeroed();
        libc::sigemptyset(&raw mut set);
        for number in [libc::SIGINT, libc::SIGTERM, libc::SIGHUP, libc::SIGQUIT] {
            libc::sigaddset(&raw mut set, number);
        }
        libc::pthread_sigmask(libc::SIG_BLOCK, &raw const set, std::ptr::null_mut());
    }
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

/// The deadline after `deadline_ns` and how many are left out: those that are a whole period past at `now_ns`. Running
/// them in a burst would command old positions' forces one after the other. One period that is late runs at once. RT safe.
pub fn next_deadline(deadline_ns: u64, period_ns: u64, now_ns: u64) -> (u64, u64) {
    let next_ns = deadline_ns + period_ns;
    let skipped = now_ns.saturating_sub(next_ns) / period_ns;
    (next_ns + skipped * period_ns, skipped)
}

/// Sleeps until the monotonic clock shows `deadline_ns`; returns at once when that is past. RT safe.
pub fn sleep_until(deadline_ns: u64) {
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
    fn deadlines_stay_on_the_grid_and_whole_missed_periods_are_left_out() {
        assert_eq!(next_deadline(1000, 100, 1010), (1100, 0)); // in time
        assert_eq!(next_deadline(1000, 100, 1150), (1100, 0)); // late: the next one runs at once
        assert_eq!(next_deadline(1000, 100, 1200), (1200, 1));
        assert_eq!(next_deadline(1000, 100, 1437), (1400, 3));
    }

    #[test]
    fn sleep_never_ends_before_its_deadline() {
        let deadline_ns = monotonic_ns() + 3_000_000;
        sleep_until(deadline_ns);
        assert!(monotonic_ns() >= deadline_ns);
        sleep_until(0);
    }

    #[test]
    fn what_is_refused_says_how_to_get_it() {
        let refused = || Err(io::Error::from_raw_os_error(libc::EPERM));
        let scheduling =
            Scheduling { priority: 50, fifo: refused(), memory: refused(), cpu: Some((77, refused())) };
        let text = scheduling.to_string();
        assert!(!scheduling.is_granted());
        for word in ["SCHED_FIFO", "rtprio", "memlock", "CPU 77"] {
            assert!(text.contains(word), "{text}");
        }
    }

    #[test]
    fn a_thread_on_a_cpu_stays_there_and_a_cpu_that_is_not_there_is_refused() {
        let thread = std::thread::Builder::new().spawn(|| {
            pin_to(0).unwrap();
            // SAFETY: the call has no preconditions.
            assert_eq!(unsafe { libc::sched_getcpu() }, 0);
            assert!(pin_to(100_000).is_err());
        });
        thread.unwrap().join().unwrap();
    }
}
