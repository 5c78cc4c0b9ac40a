//! A computed session against its golden recording: what differs is found, where it differs, and nothing else.
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests, which may panic")]

mod digest;
mod property;
mod session;
mod stamps;
mod values;
mod verdicts;
