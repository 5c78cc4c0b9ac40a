//! The hardware behind `rhombus_sdk_double`: Force Dimension devices on a bus, each with its hand, motors, watchdog and
//! speed limit.
//!
//! ```text
//! force_dimension_double --sdk FOLDER [--sdk-version 3.17.5.0] [--only-dhd] [--control] [DEVICE OPTIONS]
//!                        [--device NAME[:SERIAL] [DEVICE OPTIONS]]...
//! ```
//! It lays out the SDK in FOLDER as the maker's archive does, so that `force_dimension.sdk: FOLDER` or `FORCEDIM_SDK=FOLDER`
//! is all a driver needs, and prints `ready: ...`. Device options belong to the device before them, or to the first: see
//! `arguments.rs`. With `--control`, lines on standard input change a running device (see `control.rs`), and their end is
//! the double's. SIGUSR1 unplugs all devices, SIGUSR2 plugs them in again, SIGTERM ends.
#![expect(clippy::print_stdout, reason = "the ready line and the answers to control lines")]

mod answers;
mod arguments;
mod bus;
mod control;
mod hardware;

use std::error::Error;
use std::io;
use std::os::unix::net::{UnixListener, UnixStream};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering::SeqCst};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use rhombus_doubles::{Signals, monotonic_ns};
use rhombus_sdk_double::{Request, SOCKET};

use arguments::Arguments;
use bus::Bus;
use hardware::STEP_S;

/// What all threads share.
type Shared = Arc<Mutex<Bus>>;

fn main() -> Result<(), Box<dyn Error>> {
    let signals = Signals::install();
    let arguments = Arguments::parse(std::env::args().skip(1))?;
    let libraries = lay_out(&arguments.sdk, arguments.only_dhd)?;
    let listener = UnixListener::bind(libraries.join(SOCKET))?;
    let bus = Arc::new(Mutex::new(Bus::new(&arguments)?));

    let accepting = bus.clone();
    start("accept", move || {
        for (number, stream) in listener.incoming().flatten().enumerate() {
            let bus = accepting.clone();
            // A connection that cannot be served is closed with its stream.
            let _ = start("program", move || serve(number as u64, stream, &bus));
        }
    })?;
    let left_alone = Arc::new(AtomicBool::new(false));
    if arguments.control {
        let (controlled, left_alone) = (bus.clone(), left_alone.clone());
        start("control", move || {
            control::follow(io::stdin().lines(), &controlled);
            left_alone.store(true, SeqCst);
        })?;
    }
    println!("ready: {} devices, SDK in {}", arguments.devices.len(), arguments.sdk.display());

    let step = Duration::from_nanos((STEP_S * 1e9) as u64);
    let mut done_ns = monotonic_ns();
    let mut unplugged = false;
    while !signals.ended() && !left_alone.load(SeqCst) {
        std::thread::sleep(step);
        let now_ns = monotonic_ns();
        let mut bus = lock(&bus);
        if signals.unplugged() != unplugged {
            unplugged = signals.unplugged();
            bus.plug_all(now_ns, !unplugged)?;
        }
        while done_ns + step.as_nanos() as u64 <= now_ns {
            done_ns += step.as_nanos() as u64;
            bus.advance(now_ns)?;
        }
    }
    Ok(())
}

/// Answers one program until it is gone. What it had open is closed then; its motors are left to the watchdog.
fn serve(program: u64, mut stream: UnixStream, bus: &Shared) {
    while let Ok(request) = Request::read(&mut stream) {
        let reply = answers::answer(bus, program, &request);
        if reply.write(&mut stream).is_err() {
            break;
        }
    }
    lock(bus).forget(program);
}

fn lock(bus: &Shared) -> MutexGuard<'_, Bus> {
    bus.lock().unwrap_or_else(PoisonError::into_inner)
}

fn start(name: &str, run: impl FnOnce() + Send + 'static) -> io::Result<()> {
    std::thread::Builder::new().name(name.to_owned()).spawn(run).map(drop)
}

/// The SDK's folders with this program's library under the SDK's names. The answer is the folder of the libraries.
fn lay_out(sdk: &Path, only_dhd: bool) -> io::Result<PathBuf> {
    let folder = sdk.join("lib/release").join(format!("lin-{}-gcc", std::env::consts::ARCH));
    std::fs::create_dir_all(&folder)?;
    let names: &[&str] =
        if only_dhd { &["libdhd.so.3.17.5", "libdhd.so.3"] } else { &["libdrd.so.3.17.5", "libdrd.so.3"] };
    for name in names.iter().chain([&SOCKET]) {
        match std::fs::remove_file(folder.join(name)) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => {}
        }
    }
    if let [file, link] = names {
        // A copy: a link would make the loader take two SDKs for one.
        std::fs::copy(library()?, folder.join(file))?;
        std::os::unix::fs::symlink(file, folder.join(link))?;
    }
    Ok(folder)
}

/// The shared library, which Cargo puts beside this program or into its `deps`.
fn library() -> io::Result<PathBuf> {
    let own = std::env::current_exe()?;
    let beside = own.parent().unwrap_or(Path::new("."));
    [beside.join("deps"), beside.to_path_buf()]
        .into_iter()
        .map(|folder| folder.join("librhombus_sdk_double.so"))
        .find(|file| file.is_file())
        .ok_or_else(|| {
            let looked =
                format!("librhombus_sdk_double.so is neither in {0} nor in {0}/deps", beside.display());
            io::Error::new(io::ErrorKind::NotFound, looked)
        })
}
