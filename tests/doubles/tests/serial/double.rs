//! A double in a process of its own, and what it wrote down.

use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

use devices::serial::{SerialDevice, Settings};
use devices::{Device, DeviceError, DeviceState, MotorsOff, Wrench};

/// A running double in a folder of its own.
pub(crate) struct Double {
    child: Child,
    out: BufReader<ChildStdout>,
    folder: tempfile::TempDir,
}

/// One line of the record.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Line {
    pub t_ns: u64,
    pub event: String,
    /// Force, torque, gripper force.
    pub wrench: [f64; 7],
}

impl Line {
    pub(crate) fn is_zero(&self) -> bool {
        self.wrench == [0.0; 7]
    }
}

impl Double {
    pub(crate) fn start(options: &str) -> Double {
        let folder = tempfile::tempdir().unwrap();
        Double::start_in(folder, options)
    }

    fn start_in(folder: tempfile::TempDir, options: &str) -> Double {
        std::fs::create_dir(folder.path().join("ports")).unwrap();
        let mut child = Command::new(env!("CARGO_BIN_EXE_serial_double"))
            .arg("--link")
            .arg(folder.path().join("ports/device"))
            .arg("--record")
            .arg(folder.path().join("record.csv"))
            .args(["--attached", "yes"])
            .args(options.split_whitespace())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut out = BufReader::new(child.stdout.take().unwrap());
        let mut ready = String::new();
        out.read_line(&mut ready).unwrap();
        assert!(ready.starts_with("ready: /dev/pts/"), "{ready:?}");
        Double { child, out, folder }
    }

    /// The link that the double keeps to its pseudo-terminal.
    pub(crate) fn port(&self) -> PathBuf {
        self.ports().join("device")
    }

    /// The folder of the link.
    pub(crate) fn ports(&self) -> PathBuf {
        self.folder.path().join("ports")
    }

    pub(crate) fn settings(&self) -> Settings {
        settings(&self.port())
    }

    pub(crate) fn open(&self) -> Result<SerialDevice, DeviceError> {
        devices::serial::open(self.settings())
    }

    /// Sends the double a signal by name.
    pub(crate) fn signal(&self, name: &str) {
        signal(self.child.id(), name);
    }

    pub(crate) fn record(&self) -> Vec<Line> {
        let text = std::fs::read_to_string(self.folder.path().join("record.csv")).unwrap();
        let whole_lines = text.rsplit_once('\n').map_or("", |(whole, _)| whole);
        whole_lines.lines().skip(1).map(line).collect()
    }

    /// Waits for a line of the record after the first `after` ones.
    pub(crate) fn wait_for(&self, after: usize, what: impl Fn(&Line) -> bool) -> Line {
        let mut found = None;
        wait_until("a line of the record", || {
            found = self.record().into_iter().skip(after).find(&what);
            found.is_some()
        });
        found.unwrap()
    }

    /// Ends the double; the longest time between two looks at its line.
    pub(crate) fn end(mut self) -> Duration {
        self.signal("TERM");
        let mut rest = String::new();
        self.out.read_to_string(&mut rest).unwrap();
        assert!(self.child.wait().unwrap().success());
        let us = rest.trim().strip_prefix("longest tick: ").and_then(|rest| rest.strip_suffix(" us"));
        Duration::from_micros(us.unwrap().parse().unwrap())
    }
}

impl Drop for Double {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

pub(crate) fn settings(port: &Path) -> Settings {
    Settings { port: port.to_string_lossy().into_owned(), baud: 921_600, serial: String::new() }
}

pub(crate) fn signal(process: u32, name: &str) {
    let status = Command::new("kill").arg(format!("-{name}")).arg(process.to_string()).status().unwrap();
    assert!(status.success());
}

/// Reads until `what` is true of a state.
pub(crate) fn read_until(device: &mut SerialDevice, what: impl Fn(&DeviceState) -> bool) -> DeviceState {
    let mut found = None;
    wait_until("a state", || {
        found = read(device).filter(&what);
        found.is_some()
    });
    found.unwrap()
}

/// A state, unless the machine was so busy that none came for 100 ms.
pub(crate) fn read(device: &mut SerialDevice) -> Option<DeviceState> {
    match device.read() {
        Ok(state) => Some(state),
        Err(DeviceError::Lost { reason: "no state for 100 ms", .. }) => None,
        Err(error) => panic!("{error}"),
    }
}

/// One period of a loop that presses, and enables again whenever the machine was so busy that the watchdog acted.
pub(crate) fn press(device: &mut SerialDevice, wrench: &Wrench) -> Option<DeviceState> {
    let state = read(device);
    if state.is_some_and(|state| state.motors_off == Some(MotorsOff::Watchdog)) {
        device.enable().unwrap();
    }
    device.command(wrench).unwrap();
    state
}

/// Waits for what must happen sooner or later.
pub(crate) fn wait_until(what: &str, mut is_so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < Duration::from_secs(20), "still no {what}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

fn line(text: &str) -> Line {
    let fields: Vec<&str> = text.split(',').collect();
    let numbers: Vec<f64> = fields[2..9].iter().map(|field| field.parse().unwrap()).collect();
    Line {
        t_ns: fields[0].parse().unwrap(),
        event: fields[1].to_owned(),
        wrench: numbers.try_into().unwrap(),
    }
}
