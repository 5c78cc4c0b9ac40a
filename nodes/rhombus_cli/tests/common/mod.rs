//! Runs the real executable in a folder of its own.
#![expect(clippy::expect_used, reason = "a test may fail here")]

use std::path::PathBuf;
use std::process::{Command, Output};

/// One chain that the model accepts.
#[allow(dead_code, reason = "not every test file needs it")]
pub(crate) const PAPER: &str = "/**:
  ros__parameters:
    chains:
      formulation: published
      rod_length: [0.01]
      angle: [0.5235987755982988]
      ratio: [0.8]
      units: [12]
      normal_stiffness: [500.0]
      tangential_stiffness: [100.0]
      tangential_growth: [10.0]
";

pub(crate) struct Folder {
    folder: tempfile::TempDir,
}

/// What a run left behind.
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Folder {
    pub(crate) fn new() -> Folder {
        Folder { folder: tempfile::tempdir().expect("a folder") }
    }

    #[allow(dead_code, reason = "not every test file needs it")]
    pub(crate) fn with(self, name: &str, text: &str) -> Folder {
        std::fs::write(self.path(name), text).expect("a file");
        self
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_rhombus"));
        command.current_dir(self.folder.path()).args(arguments);
        command
    }

    pub(crate) fn run(&self, arguments: &[&str]) -> Run {
        let Output { status, stdout, stderr } = self.command(arguments).output().expect("it starts");
        let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
        Run { code: status.code().expect("no signal"), stdout: text(stdout), stderr: text(stderr) }
    }

    /// Stdout of a run that must succeed without a word on stderr.
    pub(crate) fn success(&self, arguments: &[&str]) -> String {
        let run = self.run(arguments);
        assert_eq!((run.code, run.stderr.as_str()), (0, ""), "{arguments:?}");
        run.stdout
    }

    /// Stderr of a run that must be refused without a word on stdout.
    #[allow(dead_code, reason = "not every test file needs it")]
    pub(crate) fn refusal(&self, arguments: &[&str]) -> String {
        let run = self.run(arguments);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{arguments:?}: {}", run.stderr);
        run.stderr
    }

    #[allow(dead_code, reason = "not every test file needs it")]
    pub(crate) fn json(&self, arguments: &[&str]) -> serde_json::Value {
        serde_json::from_str(&self.success(arguments)).expect("JSON and nothing else")
    }
}
