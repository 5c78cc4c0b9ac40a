//! The serial backend against its double at a pseudo-terminal.

#![expect(clippy::unwrap_used, clippy::panic, reason = "helpers of tests, outside the test functions")]

mod client;
mod double;
mod fuzzed;
mod opening;
mod running;
mod unplugged;
mod watchdog;

/// Aborts on an allocation where none may be.
#[global_allocator]
static ALLOCATOR: assert_no_alloc::AllocDisabler = assert_no_alloc::AllocDisabler;
