//! The Haply backend against the double of its service: what the hand feels is read from the double's record.
#![cfg(feature = "haply")]
#![expect(clippy::unwrap_used, clippy::expect_used, reason = "tests, their helpers too")]

mod double;
mod loss;
mod opening;
mod pressing;

use assert_no_alloc::AllocDisabler;

#[global_allocator]
static ALLOCATOR: AllocDisabler = AllocDisabler;
