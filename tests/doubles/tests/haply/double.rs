//! The service as a process, and a motor loop in short.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use devices::haply::{self, HaplyDevice, Settings};
use devices::{Device, DeviceState, MotorsOff, Wrench};
use glam::DVec3;

/// The service as a process.
pub(crate) struct Double {
    pub(crate) process: Child,
    pub(crate) url: String,
    directory: tempfile::TempDir,
}

impl Double {
    pub(crate) fn start(options: &[&str]) -> Double {
        let directory = tempfile::tempdir().unwrap();
        let mut process = Command::new(env!("CARGO_BIN_EXE_haply_double"))
            .args(options)
            .arg("--record")
            .arg(directory.path().join("record.csv"))
            .args(["--attached", "yes"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(process.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let url = line.trim().strip_prefix("ready: ").unwrap().to_owned();
        Double { process, url, directory }
    }

    pub(crate) fn settings(&self) -> Settings {
        Settings { url: self.url.clone(), ..Settings::default() }
    }

    pub(crate) fn open(&self) -> HaplyDevice {
        haply::open(self.settings()).unwrap()
    }

    pub(crate) fn signal(&self, name: &str) {
        signal(&self.process, name);
    }

    /// Time, event and force of each line of the record so far.
    pub(crate) fn record(&self) -> Vec<(u64, String, DVec3)> {
        let text = std::fs::read_to_string(self.directory.path().join("record.csv")).unwrap();
        let whole = text.rsplit_once('\n').map_or("", |(lines, _)| lines);
        whole
            .lines()
            .skip(1)
            .map(|line| {
                let words: Vec<&str> = line.split(',').collect();
                let force = [2, 3, 4].map(|column| words[column].parse::<f64>().unwrap());
                (words[0].parse().unwrap(), words[1].to_owned(), DVec3::from(force))
            })
            .collect()
    }
}

/// A process that ends with the test, however the test ends.
pub(crate) struct Ended(pub(crate) Child);

impl Drop for Ended {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

impl Drop for Double {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

pub(crate) fn signal(process: &Child, name: &str) {
    assert!(
        Command::new("kill")
            .arg(format!("-{name}"))
            .arg(process.id().to_string())
            .status()
            .unwrap()
            .success()
    );
}

/// A motor loop in short: reads and commands once a millisecond. One that this machine kept waiting enables the motors anew.
pub(crate) fn press(device: &mut HaplyDevice, force_n: DVec3, milliseconds: u32) -> DeviceState {
    let mut state = device.read().unwrap();
    for _ in 0..milliseconds {
        state = device.read().unwrap();
        if state.motors_off == Some(MotorsOff::Watchdog) {
            device.disable().unwrap();
            std::thread::sleep(Duration::from_millis(5));
            device.enable().unwrap();
        }
        device.command(&Wrench::of_force(force_n)).unwrap();
        std::thread::sleep(Duration::from_millis(1));
    }
    state
}

/// Waits until something is so; much longer than it takes.
pub(crate) fn eventually(what: &str, mut is_so: impl FnMut() -> bool) {
    let begin = Instant::now();
    while !is_so() {
        assert!(begin.elapsed() < Duration::from_secs(10), "{what} never came");
        std::thread::sleep(Duration::from_millis(2));
    }
}

pub(crate) fn refusal(settings: Settings) -> String {
    let begin = Instant::now();
    let error = haply::open(settings).err().expect("opened");
    assert!(begin.elapsed() < Duration::from_secs(6), "{error} came late");
    error.to_string()
}
