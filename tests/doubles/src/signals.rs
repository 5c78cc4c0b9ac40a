//! Signals to a double: an end, and the cable.

#![expect(unsafe_code, reason = "sigaction has no safe wrapper in std")]

use std::sync::atomic::{AtomicBool, Ordering::SeqCst};

static ENDED: AtomicBool = AtomicBool::new(false);
static UNPLUGGED: AtomicBool = AtomicBool::new(false);

/// SIGTERM and SIGINT end a double, SIGUSR1 pulls its cable, SIGUSR2 puts it back.
#[derive(Clone, Copy, Debug)]
pub struct Signals(());

extern "C" fn handle(number: libc::c_int) {
    match number {
        libc::SIGUSR1 => UNPLUGGED.store(true, SeqCst),
        libc::SIGUSR2 => UNPLUGGED.store(false, SeqCst),
        _ => ENDED.store(true, SeqCst),
    }
}

impl Signals {
    /// Listens from now on.
    pub fn install() -> Signals {
        let handler: extern "C" fn(libc::c_int) = handle;
        for number in [libc::SIGTERM, libc::SIGINT, libc::SIGUSR1, libc::SIGUSR2] {
            // SAFETY: the handler only stores to atomics, which a signal handler may.
            unsafe { libc::signal(number, handler as libc::sighandler_t) };
        }
        Signals(())
    }

    /// Whether the double shall end.
    pub fn ended(self) -> bool {
        ENDED.load(SeqCst)
    }

    /// Whether the cable is out.
    pub fn unplugged(self) -> bool {
        UNPLUGGED.load(SeqCst)
    }
}
