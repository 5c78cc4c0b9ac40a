//! A self-built device at a pseudo-terminal: the firmware of `serial_device/PROTOCOL.md` with a hand on its handle.
//!
//! ```text
//! serial_double [--link PATH] [--record FILE] [--fault FAULT] [--serial TEXT] [--rate HZ] [--baud BIT/S] [--joints N]
//!               [--homing S] [--max-speed M/S] [--attached yes|no] [hand options]
//! ```
//! Prints `ready: /dev/pts/N`; SIGUSR1 pulls the cable, SIGUSR2 puts it back (at `--link` again, with another number),
//! SIGTERM ends it and prints the longest time between two looks at the line. Attached, it ends with its standard input.

mod arguments;
mod fault;
mod firmware;
mod line;

use std::error::Error;
use std::io::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering::SeqCst};
use std::time::Duration;

use arguments::Arguments;
use devices::Scheduling;
use firmware::Firmware;
use line::Line;
use rhombus_doubles::{Motors, Record, Signals, monotonic_ns};

/// Between two looks at the line, and the step of the mechanics.
const TICK: Duration = Duration::from_micros(250);
/// Firmware waits for nobody; where that is not permitted it is what it is.
const PRIORITY: i32 = 60;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse(std::env::args().skip(1))?;
    let signals = Signals::install();
    let record = Record::create(arguments.record.as_deref())?;
    let motors = Motors::new(Some(firmware::WATCHDOG), record);
    let mut firmware = Firmware::new(&arguments, motors, TICK.as_secs_f64())?;
    let mut line = Some(Line::open(&arguments)?);
    if let Some(line) = &line {
        announce(&format!("ready: {}", line.path()))?;
    }
    let left_alone = Arc::new(AtomicBool::new(false));
    if arguments.attached {
        let left_alone = left_alone.clone();
        std::thread::Builder::new().name("attached".to_owned()).spawn(move || {
            // An error is an end too.
            let _ = std::io::copy(&mut std::io::stdin(), &mut std::io::sink());
            left_alone.store(true, SeqCst);
        })?;
    }
    let _ = Scheduling::request(PRIORITY, None);
    let tick_ns = TICK.as_nanos() as u64;
    let (mut now_ns, mut longest_ns) = (monotonic_ns(), 0);
    let mut due_ns = now_ns;
    while !signals.ended() && !left_alone.load(SeqCst) {
        due_ns = (due_ns + tick_ns).max(now_ns);
        std::thread::sleep(Duration::from_nanos(due_ns.saturating_sub(monotonic_ns())));
        let before_ns = std::mem::replace(&mut now_ns, monotonic_ns());
        longest_ns = longest_ns.max(now_ns - before_ns);
        if signals.unplugged() {
            line = None;
        } else if line.is_none() {
            line = Some(Line::open(&arguments)?);
        }
        if let Some(line) = &mut line {
            firmware.listen(line, now_ns)?;
        }
        firmware.advance(now_ns)?;
        if let Some(line) = &mut line {
            firmware.speak(line, now_ns)?;
        }
    }
    announce(&format!("longest tick: {} us", longest_ns / 1000))?;
    Ok(())
}

fn announce(what: &str) -> std::io::Result<()> {
    let mut out = std::io::stdout();
    writeln!(out, "{what}")?;
    out.flush()
}
