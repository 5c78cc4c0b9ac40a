//! The headers for firmware and the backend speak the same bytes, and firmware made with them is a device.

#![expect(clippy::unwrap_used, reason = "helpers of tests, outside the test functions")]

mod frames;
mod pantograph;
mod scripted;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

pub(crate) const HEADER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../nodes/devices/serial_device");
pub(crate) const PARTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/serial_header");

pub(crate) fn compiled(folder: &Path, compiler: &str, options: &[&str], sources: &[PathBuf]) -> PathBuf {
    let program = folder.join("program");
    let status = Command::new(compiler)
        .args(["-O1", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-I", HEADER, "-I", PARTS])
        .args(options)
        .args(sources)
        .arg("-o")
        .arg(&program)
        .arg("-lm")
        .status()
        .unwrap();
    assert!(status.success());
    program
}

/// One of the C programs beside this file.
pub(crate) fn c_program(folder: &Path, name: &str) -> PathBuf {
    compiled(folder, "cc", &["-std=c99", "-Wconversion"], &[Path::new(PARTS).join(name)])
}

/// What a program answers to all of its input.
pub(crate) fn answer(program: &Path, input: &[u8]) -> Vec<u8> {
    let mut child = Command::new(program).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    let mut stdin = child.stdin.take().unwrap();
    std::thread::scope(|scope| {
        std::thread::Builder::new().spawn_scoped(scope, move || stdin.write_all(input).unwrap()).unwrap();
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success());
        output.stdout
    })
}

pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}
