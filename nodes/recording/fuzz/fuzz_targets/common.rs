//! Everything there is to do with a recording.

use std::path::Path;

use recording::{Playback, Recording};

/// So many messages are looked at: a small file can hold millions.
const ENOUGH: usize = 100_000;

/// Opens what lies at `path` and reads it in every order.
pub fn read(path: &Path) {
    let Ok(recording) = Recording::open(path) else { return };
    let _ = (recording.log_time_bounds_ns(), recording.metadata_disagreements());
    recording.damage().iter().for_each(|damage| drop(damage.to_string()));
    let mut messages = recording.messages();
    let mut last_ns = 0;
    for _ in 0..ENOUGH {
        match messages.next_ref() {
            Some(Ok(message)) => {
                assert!(message.log_time_ns >= last_ns, "out of order");
                assert!(message.topic < recording.topics().len(), "of no topic");
                last_ns = message.log_time_ns;
            }
            Some(Err(error)) => drop(error.to_string()),
            None => break,
        }
    }
    let first: Vec<usize> = (0..recording.topics().len()).take(1).collect();
    recording.messages_of(&first).take(ENOUGH).for_each(drop);
    recording.stored_messages().take(ENOUGH).for_each(drop);
    let playback = Playback { start_ns: 1_000_000, duration_ns: Some(u64::MAX), ..Playback::default() };
    recording.playback(&playback).take(ENOUGH).for_each(drop);
}
