//! A serial line that is slower than the motor loop carries fewer commands, none of them old.

#![cfg(feature = "serial")]
#![expect(clippy::unwrap_used, reason = "helpers of tests, outside the test functions")]

use std::collections::VecDeque;
use std::io;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use devices::serial::wire::{
    COMMAND_FRAME, Command, Hello, Message, PROTOCOL_VERSION, Receiver, State, capability,
};
use devices::serial::{Line, SerialDevice};
use devices::{Device, Wrench};
use glam::DVec3;

/// A line with a device at its end that says one state each millisecond.
#[derive(Default)]
struct Uart {
    now_ns: u64,
    bytes_per_s: u64,
    /// What the operating system holds, and how far the next byte has left.
    queue: VecDeque<u8>,
    left_ns: u64,
    receiver: Receiver,
    to_host: VecDeque<u8>,
    states: u64,
    greeted: bool,
    /// Every command that has arrived, and when.
    arrived: Vec<(u64, Command)>,
}

/// Both ends look at it.
#[derive(Clone)]
struct Shared(Arc<Mutex<Uart>>);

impl Uart {
    fn pass(&mut self, time: Duration) {
        self.now_ns += time.as_nanos() as u64;
        let byte_ns = 1_000_000_000 / self.bytes_per_s;
        self.left_ns += time.as_nanos() as u64;
        while self.left_ns >= byte_ns && !self.queue.is_empty() {
            self.left_ns -= byte_ns;
            let byte = [self.queue.pop_front().unwrap()];
            let mut input = &byte[..];
            let message =
                self.receiver.next(&mut input).map(|frame| Message::decode(frame.unwrap()).unwrap());
            match message {
                Some(Message::HelloRequest(_)) => {
                    self.greeted = true;
                    self.to_host.extend(hello().frame().bytes());
                }
                Some(Message::Command(command)) => self.arrived.push((self.now_ns, command)),
                _ => {}
            }
        }
        if self.queue.is_empty() {
            self.left_ns = 0;
        }
        while self.greeted && self.states < self.now_ns / 1_000_000 {
            self.states += 1;
            let state = State {
                sequence: self.states as u16,
                time_us: self.states as u32 * 1000,
                ..Default::default()
            };
            self.to_host.extend(state.frame(0).bytes());
        }
    }
}

fn hello() -> Hello {
    Hello {
        version: PROTOCOL_VERSION,
        buttons: 0,
        joints: 0,
        capabilities: capability::FORCE,
        watchdog_ms: 20,
        state_rate_hz: 1000,
        max_force_n: 10.0,
        max_torque_n_m: 0.0,
        max_gripper_force_n: 0.0,
        workspace_centre_m: [0.0; 3],
        workspace_radius_m: 0.1,
        workspace_height_m: 0.1,
        model: Hello::name("Slow"),
        serial: Hello::name("1"),
        firmware: Hello::name("1"),
    }
}

impl Line for Shared {
    fn now_ns(&self) -> u64 {
        self.0.lock().unwrap().now_ns
    }

    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let mut uart = self.0.lock().unwrap();
        if uart.to_host.is_empty() {
            return Err(io::ErrorKind::WouldBlock.into());
        }
        let count = into.len().min(uart.to_host.len());
        for (place, byte) in into.iter_mut().zip(uart.to_host.drain(..count)) {
            *place = byte;
        }
        Ok(count)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.lock().unwrap().queue.extend(bytes);
        Ok(bytes.len())
    }

    fn unsent(&self) -> usize {
        self.0.lock().unwrap().queue.len()
    }

    fn wait(&mut self, time: Duration) {
        self.0.lock().unwrap().pass(time);
    }
}

/// Commands for half a second at `loop_hz`, each with its time in s as force: age of each at its arrival, s.
fn ages_at_arrival(baud: u64, loop_hz: u64) -> Vec<f64> {
    let uart = Shared(Arc::new(Mutex::new(Uart { bytes_per_s: baud / 10, ..Uart::default() })));
    let mut device = SerialDevice::greet(uart.clone(), "uart").unwrap();
    device.enable().unwrap();
    uart.clone().wait(Duration::from_millis(20));
    uart.0.lock().unwrap().arrived.clear();
    for _ in 0..loop_hz / 2 {
        device.read().unwrap();
        let seconds = uart.now_ns() as f64 * 1e-9;
        device.command(&Wrench::of_force(DVec3::X * seconds)).unwrap();
        uart.clone().wait(Duration::from_nanos(1_000_000_000 / loop_hz));
    }
    let arrived = uart.0.lock().unwrap().arrived.clone();
    arrived.iter().map(|(at_ns, command)| *at_ns as f64 * 1e-9 - f64::from(command.force_n[0])).collect()
}

#[test]
fn a_line_that_is_fast_enough_carries_every_command() {
    let ages = ages_at_arrival(921_600, 1000);
    assert!(ages.len() >= 499, "{}", ages.len());
    assert!(ages.iter().all(|age_s| *age_s <= 1.1e-3), "{ages:?}");
}

#[test]
fn a_line_that_is_slower_than_the_loop_carries_what_it_can_and_nothing_older_than_two_frames() {
    for (baud, loop_hz) in [(921_600, 4000), (115_200, 1000), (57_600, 4000)] {
        let ages = ages_at_arrival(baud, loop_hz);
        let frame_s = 10.0 * COMMAND_FRAME as f64 / baud as f64;
        let most = 0.5 / frame_s;
        assert!(ages.len() as f64 > 0.8 * most - 2.0, "{baud}: {} of {most}", ages.len());
        let oldest_s = ages.iter().copied().fold(0.0, f64::max);
        let period_s = 1.0 / loop_hz as f64;
        assert!(
            oldest_s <= 2.0 * frame_s + period_s + 1e-6,
            "{baud}: {oldest_s} s, a frame takes {frame_s} s"
        );
    }
}
