//! Doubles as processes. They belong to another package, so that they are built here, beside the executable under test.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::LazyLock;

/// A running double in a folder of its own. It ends with this value.
pub(crate) struct Double {
    child: Child,
    folder: tempfile::TempDir,
    ready: String,
}

/// One line of what reached the motors.
pub(crate) struct Event {
    pub(crate) event: String,
    pub(crate) force_n: f64,
}

/// The folder of the doubles' executables: that of the one under test.
static EXECUTABLES: LazyLock<PathBuf> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_BIN_EXE_rhombus")).parent().expect("a folder");
    let mut build = Command::new(env!("CARGO"));
    build.args(["build", "--quiet", "-p", "rhombus_doubles", "--features", "haply", "--bins"]);
    build.arg("--target-dir").arg(folder.parent().expect("the target directory"));
    if folder.file_name().is_some_and(|name| name == "release") {
        build.arg("--release");
    }
    assert!(build.status().expect("cargo runs").success());
    folder.to_path_buf()
});

impl Double {
    pub(crate) fn serial(options: &str) -> Double {
        let link = |folder: &Path| vec!["--link".into(), folder.join("port")];
        Double::start("serial_double", link, &options.split_whitespace().collect::<Vec<_>>())
    }

    pub(crate) fn force_dimension(options: &[&str]) -> Double {
        let sdk = |folder: &Path| vec!["--sdk".into(), folder.to_path_buf()];
        Double::start("force_dimension_double", sdk, options)
    }

    pub(crate) fn haply(options: &[&str]) -> Double {
        Double::start("haply_double", |_| Vec::new(), options)
    }

    fn start(name: &str, own: impl Fn(&Path) -> Vec<PathBuf>, options: &[&str]) -> Double {
        let folder = tempfile::tempdir().expect("a folder");
        let mut child = Command::new(EXECUTABLES.join(name))
            .args(own(folder.path()))
            .arg("--record")
            .arg(folder.path().join("record.csv"))
            .args(options)
            .stdout(Stdio::piped())
            .spawn()
            .expect("the double starts");
        let mut line = String::new();
        BufReader::new(child.stdout.take().expect("stdout")).read_line(&mut line).expect("a line");
        let ready = line.trim().strip_prefix("ready: ").expect("ready").to_owned();
        Double { child, folder, ready }
    }

    /// What it says when it is ready: the service's address.
    pub(crate) fn ready(&self) -> &str {
        &self.ready
    }

    /// Where the SDK lies.
    pub(crate) fn folder(&self) -> String {
        self.folder.path().to_string_lossy().into_owned()
    }

    /// The serial port.
    pub(crate) fn port(&self) -> String {
        self.folder.path().join("port").to_string_lossy().into_owned()
    }

    /// Holds the serial port as another program would: exclusively.
    pub(crate) fn hold(&self) -> devices::serial::Port {
        devices::serial::Port::open(&self.port(), 921_600).expect("the port is free")
    }

    pub(crate) fn record(&self) -> Vec<Event> {
        let text = std::fs::read_to_string(self.folder.path().join("record.csv")).expect("a record");
        let whole = text.rsplit_once('\n').map_or("", |(whole, _)| whole);
        whole
            .lines()
            .skip(1)
            .map(|line| {
                let words: Vec<&str> = line.split(',').collect();
                let axis = |column: usize| words[column].parse::<f64>().expect("a number");
                let force_n = (2..5).map(|column| axis(column) * axis(column)).sum::<f64>().sqrt();
                Event { event: words[1].to_owned(), force_n }
            })
            .collect()
    }

    /// Waits for an event at the motors, for at most 10 s.
    pub(crate) fn wait_for(&self, event: &str) {
        for _ in 0..1000 {
            if self.record().iter().any(|line| line.event == event) {
                return;
            }
            std::thread::sleep(std::time::Duration::from_millis(10));
        }
        panic!("no {event} within 10 s");
    }

    /// They were on, and are off now.
    pub(crate) fn motors_are_off(&self) {
        let record = self.record();
        let last = record.iter().rev().find(|line| line.event != "command").expect("an event");
        assert_ne!(last.event, "enable");
    }

    /// Neither were they switched on, nor did a force reach them.
    pub(crate) fn motors_stayed_off(&self) {
        for Event { event, force_n } in self.record() {
            assert!(event != "enable" && force_n == 0.0, "{event} {force_n}");
        }
    }
}

impl Drop for Double {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
