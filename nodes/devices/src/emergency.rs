//! Motors off when there is no time for anything else: a panic, an abort, a second Ctrl-C.
//!
//! A process may hold several motor loops; each looks here once in every period. What ends the process waits for them.

use std::cell::Cell;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::SeqCst};

use crate::realtime::{monotonic_ns, sleep_until};

static STOP: AtomicBool = AtomicBool::new(false);
static RUNNING: AtomicUsize = AtomicUsize::new(0);

/// Longest wait for the loops: a period of the slowest, and the longest way of the force to zero.
const PATIENCE_NS: u64 = 700_000_000;

thread_local! {
    static IS_MOTOR_LOOP: Cell<bool> = const { Cell::new(false) };
}

/// Ends every motor loop of this process: forces to zero, motors off; waits for that, at most 700 ms. Takes no lock and
/// allocates nothing, so that a signal handler may call it. A motor loop's own thread waits for the others only:
/// unwinding takes its own force away.
pub fn motors_off_at_once() {
    STOP.store(true, SeqCst);
    let own = usize::from(IS_MOTOR_LOOP.get());
    let give_up_ns = monotonic_ns() + PATIENCE_NS;
    while RUNNING.load(SeqCst) > own && monotonic_ns() < give_up_ns {
        sleep_until(monotonic_ns() + 200_000);
    }
}

/// Whether this thread is a motor loop's.
pub fn is_motor_loop() -> bool {
    IS_MOTOR_LOOP.get()
}

/// A running loop, for as long as it lives. In the loop's own thread.
pub(crate) struct Running(());

impl Running {
    pub(crate) fn begin() -> Running {
        IS_MOTOR_LOOP.set(true);
        RUNNING.fetch_add(1, SeqCst);
        Running(())
    }

    /// Whether the loop shall end at once. RT safe.
    pub(crate) fn is_over(&self) -> bool {
        STOP.load(SeqCst)
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        RUNNING.fetch_sub(1, SeqCst);
    }
}
