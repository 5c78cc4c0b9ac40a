//! The Force Dimension backend against its double: the SDK's functions in a shared library, the devices in a process of
//! their own that records what reached their motors.
#![expect(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests, which may panic"
)]

mod alive;
mod double;
mod moving;
mod opening;
mod stopped;

/// Panics at an allocation inside `assert_no_alloc`.
#[global_allocator]
static ALLOCATOR: assert_no_alloc::AllocDisabler = assert_no_alloc::AllocDisabler;
