//! A short run of the fuzzer, always the same.

use std::process::Command;

#[test]
fn mutated_streams_break_no_invariant() {
    let output = Command::new(env!("CARGO_BIN_EXE_fuzz_serial"))
        .args(["--seed", "1", "--runs", "3000"])
        .output()
        .unwrap();
    let (said, faults) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{faults}");
    assert!(said.starts_with("3000 runs"), "{said}");
}
