//! How a node ends: a signal sets a flag and the loop sees it; a second signal, an abort or a panic ends the whole process,
//! but not before what [`before_forced_exit`] named has run.

#![expect(unsafe_code, reason = "signal-hook cannot know that an action is safe in a signal handler")]

use std::io;
use std::sync::Arc;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use signal_hook::consts::{SIGABRT, SIGHUP, SIGINT, SIGQUIT, SIGTERM};
use signal_hook::low_level;

/// Exit code of a process in which any thread panicked.
const PANIC_EXIT_CODE: i32 = 101;

/// What must happen before the process is gone, however it ends, short of SIGKILL.
#[derive(Clone, Copy, Debug)]
pub struct ForcedExit {
    /// Runs in a signal handler or a panicking thread: no lock, no allocation, an end in sight.
    pub prepare: fn(),
    /// Whether a panic of this thread shall unwind it instead of ending the process: unwinding does what is needed, and
    /// the thread's owner sees that it has ended.
    pub unwinds: fn() -> bool,
}

static FORCED_EXIT: OnceLock<ForcedExit> = OnceLock::new();

/// Names what must happen before a forced exit. The first call counts.
pub fn before_forced_exit(action: ForcedExit) {
    FORCED_EXIT.get_or_init(|| action);
}

fn prepare() {
    if let Some(action) = FORCED_EXIT.get() {
        (action.prepare)();
    }
}

/// Whether the process was asked to end. Clones share the flag, so that other threads can watch it too.
#[derive(Clone, Debug, Default)]
pub struct Shutdown {
    requested: Arc<AtomicBool>,
}

impl Shutdown {
    /// Lets signals set the flag (r2r installs no handler): Ctrl-C, SIGTERM, a terminal that goes away. The second signal
    /// ends the process at once, and so does an abort of the middleware.
    pub(crate) fn install() -> io::Result<Shutdown> {
        let shutdown = Shutdown::default();
        for signal in [SIGINT, SIGTERM, SIGHUP, SIGQUIT] {
            let requested = Arc::clone(&shutdown.requested);
            let action = move || {
                if requested.swap(true, Ordering::Relaxed) {
                    prepare();
                    low_level::exit(128 + signal);
                }
            };
            // SAFETY: the action is an atomic exchange, what ForcedExit promises of itself, and _exit.
            unsafe { low_level::register(signal, action)? };
        }
        let abort = || {
            prepare();
            // Ends the process as if there were no handler.
            let _ = low_level::emulate_default_handler(SIGABRT);
        };
        // SAFETY: as above; emulating the default handler is what signal-hook made for a handler.
        unsafe { low_level::register(SIGABRT, abort)? };
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
        prepare();
        if FORCED_EXIT.get().is_some_and(|action| (action.unwinds)()) {
            // Unwinding is what counts now, and a backtrace can take as long as a device's watchdog.
            let text = panic.to_string();
            let _ = thread::Builder::new().name("panic".to_owned()).spawn(move || eprintln!("{text}"));
            return;
        }
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

    const INNER: &str = "RHOMBUS_TEST_ENDS";

    /// Runs one test again in a process of its own, where it may end the process: exit code and what it said.
    fn alone(name: &str) -> (std::process::ExitStatus, String) {
        let mut again = std::process::Command::new(std::env::current_exe().unwrap());
        let name = format!("shutdown::tests::{name}");
        let output = again.args(["--exact", &name, "--nocapture"]).env(INNER, "1").output().unwrap();
        (output.status, String::from_utf8_lossy(&output.stderr).into_owned())
    }

    fn is_alone() -> bool {
        std::env::var_os(INNER).is_some()
    }

    fn say_prepared() {
        eprintln!("prepared");
    }

    #[test]
    fn a_panic_in_any_thread_ends_the_process_prepared_and_with_a_code_of_its_own() {
        if is_alone() {
            before_forced_exit(ForcedExit { prepare: say_prepared, unwinds: || false });
            exit_on_panic();
            let thread = std::thread::Builder::new().spawn(|| panic!("on purpose")).unwrap();
            let _ = thread.join();
            return; // Not reached: this test would pass and the process end with 0.
        }
        let (status, said) =
            alone("a_panic_in_any_thread_ends_the_process_prepared_and_with_a_code_of_its_own");
        assert_eq!(status.code(), Some(PANIC_EXIT_CODE));
        let (prepared, panicked) = (said.find("prepared").unwrap(), said.find("on purpose").unwrap());
        assert!(prepared < panicked, "{said}");
    }

    #[test]
    fn a_thread_that_must_unwind_does_and_the_process_lives_on() {
        if is_alone() {
            before_forced_exit(ForcedExit {
                prepare: || (),
                unwinds: || std::thread::current().name() == Some("motors"),
            });
            exit_on_panic();
            let motors = std::thread::Builder::new().name("motors".to_owned());
            assert!(motors.spawn(|| panic!("on purpose")).unwrap().join().is_err());
            eprintln!("lives on");
            return;
        }
        let (status, said) = alone("a_thread_that_must_unwind_does_and_the_process_lives_on");
        assert!(status.success() && said.contains("lives on"), "{said}");
    }

    #[test]
    fn a_second_signal_and_an_abort_end_the_process_prepared() {
        use std::os::unix::process::ExitStatusExt;
        if is_alone() {
            before_forced_exit(ForcedExit { prepare: say_prepared, unwinds: || false });
            let _shutdown = Shutdown::install().unwrap();
            if std::env::var_os("RHOMBUS_TEST_ABORTS").is_some() {
                std::process::abort();
            }
            low_level::raise(SIGINT).unwrap();
            low_level::raise(SIGINT).unwrap();
            return; // Not reached.
        }
        let name = "a_second_signal_and_an_abort_end_the_process_prepared";
        let (status, said) = alone(name);
        assert_eq!(status.code(), Some(128 + SIGINT));
        assert!(said.contains("prepared"), "{said}");
        let mut aborts = std::process::Command::new(std::env::current_exe().unwrap());
        let name = format!("shutdown::tests::{name}");
        let aborts = aborts.args(["--exact", &name, "--nocapture"]).env(INNER, "1");
        let output = aborts.env("RHOMBUS_TEST_ABORTS", "1").output().unwrap();
        assert_eq!(output.status.signal(), Some(SIGABRT));
        assert!(String::from_utf8_lossy(&output.stderr).contains("prepared"));
    }
}
