//! How a node ends: a signal sets a flag, the loop sees it, a second signal kills; a panic ends the whole process.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::{flag, low_level};

/// Exit code of a process in which any thread panicked.
const PANIC_EXIT_CODE: i32 = 101;

/// Whether the process was asked to end. Clones share the flag, so that other threads can watch it too.
#[derive(Clone, Debug, Default)]
pub struct Shutdown {
    requested: Arc<AtomicBool>,
}

impl Shutdown {
    /// Let SIGINT and SIGTERM set the flag (r2r installs no handler). The second signal ends the process at once.
    pub(crate) fn install() -> io::Result<Shutdown> {
        let shutdown = Shutdown::default();
        for signal in [SIGINT, SIGTERM] {
            // Order matters: on the first signal the flag is still unset when the default action looks at it.
            flag::register_conditional_default(signal, Arc::clone(&shutdown.requested))?;
            flag::register(signal, Arc::clone(&shutdown.requested))?;
        }
        Ok(shutdown)
    }

    /// True from the first signal, or [`Shutdown::request`], on.
    pub fn is_requested(&self) -> bool {
        self.requested.load(Ordering::Relaxed)
    }

    /// Ask the process to end, as a signal would.
    pub fn request(&self) {
        self.requested.store(true, Ordering::Relaxed);
    }
}

/// End the process with a non-zero code when any thread panics: half a node must not keep driving a device.
pub(crate) fn exit_on_panic() {
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        report(panic);
        // _exit: destructors of the middleware must not run while other threads still use it.
        low_level::exit(PANIC_EXIT_CODE);
    }));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_signal_sets_the_flag_and_the_process_lives_on() {
        let shutdown = Shutdown::install().unwrap();
        let watcher = shutdown.clone();
        assert!(!watcher.is_requested());
        low_level::raise(SIGTERM).unwrap();
        assert!(watcher.is_requested());
    }

    #[test]
    fn a_panic_in_any_thread_ends_the_process_with_a_code_of_its_own() {
        const INNER: &str = "RHOMBUS_TEST_PANICS";
        if std::env::var_os(INNER).is_some() {
            exit_on_panic();
            let thread = std::thread::Builder::new().spawn(|| panic!("on purpose")).unwrap();
            let _ = thread.join();
            return; // Not reached: this test would pass and the process end with 0.
        }
        let name = "shutdown::tests::a_panic_in_any_thread_ends_the_process_with_a_code_of_its_own";
        let mut again = std::process::Command::new(std::env::current_exe().unwrap());
        let output = again.args(["--exact", name, "--nocapture"]).env(INNER, "1").output().unwrap();
        assert_eq!(output.status.code(), Some(PANIC_EXIT_CODE));
        assert!(String::from_utf8_lossy(&output.stderr).contains("on purpose"));
    }
}
