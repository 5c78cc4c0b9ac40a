//! `haptic_device` as it is, but for three ways to make it panic while it drives a device:
//!
//! | what | which thread panics |
//! |---|---|
//! | SIGUSR1 | one that is neither the node's nor the motor loop's, as the publisher is |
//! | a message on the topic `panic` | the node's, in the middle of a spin |
//! | SIGUSR2 | the motor loop's, in the middle of a period |
#![expect(clippy::panic, reason = "it is what this program is for")]

mod device;

use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::task::{Context, Poll, Wake, Waker};
use std::time::Duration;

use anyhow::Result;
use futures::Stream;
use node_kit::{ForcedExit, NodeKit};
use r2r::QosProfile;
use r2r::std_msgs::msg::Empty;
use signal_hook::consts::{SIGUSR1, SIGUSR2};

/// Between two looks at the signal.
const LOOK: Duration = Duration::from_micros(200);

fn main() -> ExitCode {
    node_kit::before_forced_exit(ForcedExit {
        prepare: devices::motors_off_at_once,
        unwinds: devices::is_motor_loop,
    });
    node_kit::run(node_kit::Node::HapticDevice, run)
}

fn run(kit: &mut NodeKit) -> Result<()> {
    panic_in_a_thread()?;
    let mut panics = kit.node().subscribe::<Empty>("panic", QosProfile::default())?;
    panic_when_woken(&mut panics);
    let now = flag(SIGUSR2)?;
    haptic_device::run_with(kit, |device| Box::new(device::Panicking { device, now }))
}

/// A flag that a signal sets.
fn flag(signal: i32) -> Result<Arc<AtomicBool>> {
    let flag = Arc::new(AtomicBool::new(false));
    signal_hook::flag::register(signal, flag.clone())?;
    Ok(flag)
}

fn panic_in_a_thread() -> Result<()> {
    let now = flag(SIGUSR1)?;
    std::thread::Builder::new().name("panics".to_owned()).spawn(move || {
        while !now.load(Relaxed) {
            std::thread::sleep(LOOK);
        }
        panic!("on purpose, in a thread of its own")
    })?;
    Ok(())
}

/// Whoever puts a message into the stream wakes who waits for it: the node's thread, while it spins.
fn panic_when_woken(messages: &mut (impl Stream<Item = Empty> + Unpin)) {
    struct Panic;
    impl Wake for Panic {
        fn wake(self: Arc<Self>) {
            panic!("on purpose, in the node's thread")
        }
    }
    let waker = Waker::from(Arc::new(Panic));
    let waits = std::pin::Pin::new(messages).poll_next(&mut Context::from_waker(&waker));
    assert!(matches!(waits, Poll::Pending), "nobody can have sent anything yet");
}
