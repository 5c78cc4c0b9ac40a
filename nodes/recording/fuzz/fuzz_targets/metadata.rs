//! Any bytes as the `metadata.yaml` of a recording that is whole.
#![no_main]

mod common;

use libfuzzer_sys::fuzz_target;

static FILE: &[u8] = include_bytes!("../corpus/mcap/plain");

fuzz_target!(|bytes: &[u8]| {
    let directory = tempfile::tempdir().expect("a temporary directory");
    std::fs::write(directory.path().join("session_0.mcap"), FILE).expect("space for it");
    std::fs::write(directory.path().join("metadata.yaml"), bytes).expect("space for it");
    let recording = recording::Recording::open(directory.path()).expect("the file is whole");
    assert!(recording.messages().filter(Result::is_ok).count() > 0, "metadata hides messages");
    common::read(directory.path());
});
