//! Any bytes as a `.mcap` file.
#![no_main]

mod common;

use std::io::Write;

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut file = tempfile::Builder::new().suffix(".mcap").tempfile().expect("a temporary file");
    file.write_all(bytes).expect("space for it");
    common::read(file.path());
});
