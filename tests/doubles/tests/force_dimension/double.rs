//! A double as a process, its record, and loops that feed a device.

use std::io::{BufRead, BufReader, Lines, Write};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

use devices::force_dimension::{ForceDimensionDevice, Settings, open};
use devices::{Device, DeviceError, DeviceState, Wrench};
use glam::DVec3;

pub(crate) struct Double {
    child: Child,
    stdin: ChildStdin,
    stdout: Lines<BufReader<ChildStdout>>,
    folder: tempfile::TempDir,
}

/// One line of the record.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Line {
    pub(crate) t_ns: u64,
    pub(crate) event: String,
    pub(crate) wrench: Wrench,
}

impl Double {
    /// Starts one with these options; the record is that of the first device.
    pub(crate) fn start(options: &[&str]) -> Double {
        let folder = tempfile::tempdir().unwrap();
        let mut child = Command::new(env!("CARGO_BIN_EXE_force_dimension_double"))
            .arg("--sdk")
            .arg(folder.path())
            .arg("--record")
            .arg(folder.path().join("record.csv"))
            // Ends with this process, however that ends.
            .arg("--control")
            .args(options)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let stdin = child.stdin.take().unwrap();
        let mut stdout = BufReader::new(child.stdout.take().unwrap()).lines();
        let line = stdout.next().unwrap().unwrap();
        assert!(line.starts_with("ready: "), "{line}");
        Double { child, stdin, stdout, folder }
    }

    pub(crate) fn sdk(&self) -> PathBuf {
        self.folder.path().to_path_buf()
    }

    pub(crate) fn settings(&self, serial: &str) -> Settings {
        Settings { serial: serial.to_owned(), sdk: self.sdk(), period_s: 1e-3 }
    }

    pub(crate) fn open(&self) -> ForceDimensionDevice {
        open(self.settings("")).unwrap()
    }

    /// The sentence with which opening is refused.
    pub(crate) fn refusal(&self) -> (DeviceError, String) {
        let error = open(self.settings("")).err().expect("refused");
        let text = error.to_string();
        (error, text)
    }

    /// Tells the double something and waits until it is so.
    pub(crate) fn tell(&mut self, line: &str) {
        writeln!(self.stdin, "{line}").unwrap();
        assert_eq!(self.stdout.next().unwrap().unwrap(), format!("done: {line}"));
    }

    pub(crate) fn record(&self) -> Vec<Line> {
        let text = std::fs::read_to_string(self.folder.path().join("record.csv")).unwrap();
        let complete = &text[..text.rfind('\n').map_or(0, |end| end + 1)];
        complete.lines().skip(1).map(parse).collect()
    }

    pub(crate) fn last(&self) -> Line {
        self.record().pop().expect("something is recorded")
    }

    /// Which event last switched the motors on or off.
    pub(crate) fn last_switch(&self) -> String {
        let mut events = self.record().into_iter().rev().map(|line| line.event);
        events.find(|event| event != "command").expect("they were switched")
    }

    /// Whether the watchdog struck: on a busy machine a test may be late with its commands.
    pub(crate) fn was_late(&self) -> bool {
        self.record().iter().any(|line| line.event == "watchdog")
    }
}

impl Drop for Double {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn parse(line: &str) -> Line {
    let mut words = line.split(',');
    let t_ns = words.next().unwrap().parse().unwrap();
    let event = words.next().unwrap().to_owned();
    let numbers: Vec<f64> = words.map(|word| word.parse().unwrap()).collect();
    let [fx, fy, fz, tx, ty, tz, gripper_force_n, _commands] = numbers[..] else { panic!("{line}") };
    let wrench =
        Wrench { force_n: DVec3::new(fx, fy, fz), torque_n_m: DVec3::new(tx, ty, tz), gripper_force_n };
    Line { t_ns, event, wrench }
}

/// Reads and commands at 1 kHz until a state is as wished; at most 5 s.
pub(crate) fn feed_until(
    device: &mut ForceDimensionDevice,
    wrench: Wrench,
    wished: impl Fn(&DeviceState) -> bool,
) -> DeviceState {
    let end = Instant::now() + Duration::from_secs(5);
    loop {
        let state = device.read().unwrap();
        device.command(&wrench).unwrap();
        if wished(&state) {
            return state;
        }
        assert!(Instant::now() < end, "not within 5 s: {state:?}");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Reads at 1 kHz until it fails; at most 5 s.
pub(crate) fn read_until_error(device: &mut ForceDimensionDevice) -> DeviceError {
    let end = Instant::now() + Duration::from_secs(5);
    loop {
        if let Err(error) = device.read() {
            return error;
        }
        assert!(Instant::now() < end, "no error within 5 s");
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// Runs a test again when the watchdog struck in it because this machine was busy; at most ten times.
pub(crate) fn undisturbed(run: impl Fn() -> Double) -> Double {
    for _ in 0..10 {
        let double = run();
        if !double.was_late() {
            return double;
        }
    }
    panic!("the watchdog struck in each of ten runs");
}
