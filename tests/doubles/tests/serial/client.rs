//! A program that presses, in a process of its own, so that others can stop and kill it.

use std::io::{BufRead, BufReader, Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use devices::{Device, Wrench};
use glam::DVec3;

use crate::double::{press, read, settings, signal};

const PORT: &str = "RHOMBUS_SERIAL_TEST_PORT";

/// The force with which the client presses, N.
pub(crate) const FORCE_N: f64 = 5.0;

/// A running client.
pub(crate) struct Client(Child);

impl Client {
    /// Starts it; returns when it presses.
    pub(crate) fn start(port: &Path) -> Client {
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args([
                "client::press_until_the_device_keeps_its_motors_off",
                "--exact",
                "--ignored",
                "--nocapture",
            ])
            .env(PORT, port)
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let out = BufReader::new(child.stdout.take().unwrap());
        // The rest of what it says is taken by nobody, so that it never waits for a reader.
        let mut lines = out.lines();
        assert!(lines.any(|line| line.unwrap().contains("pressing")));
        std::thread::Builder::new().spawn(move || lines.count()).unwrap();
        Client(child)
    }

    pub(crate) fn signal(&self, name: &str) {
        signal(self.0.id(), name);
    }

    /// Whether it ended by itself, with a cause that it was sure of.
    pub(crate) fn ended_well(&mut self) -> bool {
        self.0.wait().unwrap().success()
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
#[ignore = "a process of its own, started by other tests"]
fn press_until_the_device_keeps_its_motors_off() {
    let port = std::env::var_os(PORT).unwrap();
    let mut device = devices::serial::open(settings(Path::new(&port))).unwrap();
    device.enable().unwrap();
    let mut out = std::io::stdout();
    let mut said = false;
    let push = Wrench::of_force(DVec3::X * FORCE_N);
    let cause = loop {
        std::thread::sleep(Duration::from_millis(1));
        if !said {
            // Until it says so, a busy machine is no reason to end.
            press(&mut device, &push);
        } else {
            device.command(&push).unwrap();
        }
        let Some(state) = read(&mut device) else { continue };
        match state.motors_off {
            Some(cause) if said => break cause,
            Some(_) => continue,
            None => {}
        }
        if !std::mem::replace(&mut said, true) {
            writeln!(out, "pressing").unwrap();
            out.flush().unwrap();
        }
    };
    assert_eq!(cause, devices::MotorsOff::Watchdog);
    // It goes on and on, and still gets no force: the device wants to be enabled again.
    for _ in 0..100 {
        std::thread::sleep(Duration::from_millis(1));
        device.command(&push).unwrap();
        assert!(read(&mut device).is_none_or(|state| state.motors_off.is_some()));
    }
    let _ = std::io::stdin().read(&mut []);
}
