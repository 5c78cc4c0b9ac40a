//! A Haply service that is not there: WebSocket, JSON, one answer for each message, hands on the handles.
//!
//! Everything is in the service's frame, the record and the hand's places too. A force holds for one tick, `--tick-ms`; then,
//! or at a message without a force for the device, it idles. That a connection was closed does not take the force away: only
//! the tick does, as the worse of the two cases.

mod options;
mod service;
mod session;

use std::io::{self, Write};
use std::net::TcpListener;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering::SeqCst};
use std::time::Duration;

use rhombus_doubles::{Event, Signals, monotonic_ns};

use options::Options;
use service::{STEP_NS, Service};
use session::serve;

fn run() -> Result<(), Box<dyn std::error::Error>> {
    let options = Options::parse(std::env::args().skip(1))?;
    let signals = Signals::install();
    let listener = TcpListener::bind(("127.0.0.1", options.port))?;
    let (address, attached) = (listener.local_addr()?, options.attached);
    let service = Arc::new(Service::new(options, signals)?);
    let theirs = service.clone();
    std::thread::Builder::new().name("accept".to_owned()).spawn(move || {
        for stream in listener.incoming().flatten() {
            if theirs.signals.unplugged() && theirs.options.unplugs_service {
                continue;
            }
            let service = theirs.clone();
            // A connection that ends in an error ends; the service goes on.
            let served = move || drop(serve(&service, stream));
            let _ = std::thread::Builder::new().name("session".to_owned()).spawn(served);
        }
    })?;
    let left_alone = Arc::new(AtomicBool::new(false));
    if attached {
        let left_alone = left_alone.clone();
        std::thread::Builder::new().name("attached".to_owned()).spawn(move || {
            // An error is an end too.
            let _ = io::copy(&mut io::stdin(), &mut io::sink());
            left_alone.store(true, SeqCst);
        })?;
    }
    let mut out = io::stdout();
    writeln!(out, "ready: ws://{address}")?;
    out.flush()?;
    let mut next_ns = monotonic_ns();
    while !signals.ended() && !left_alone.load(SeqCst) {
        next_ns += STEP_NS;
        {
            let mut handle = service.handle();
            if signals.unplugged() && handle.motors.are_on() {
                handle.motors.off(monotonic_ns(), Event::Gone)?;
            }
            let wrench = handle.motors.wrench(monotonic_ns())?;
            handle.hand.advance(wrench.force_n);
        }
        std::thread::sleep(Duration::from_nanos(next_ns.saturating_sub(monotonic_ns())));
    }
    Ok(())
}

fn main() {
    if let Err(error) = run() {
        eprintln!("haply_double: {error}");
        std::process::exit(2);
    }
    // Sessions may wait for a peer that says nothing.
    std::process::exit(0);
}
