//! How large messages are that rosbag2 compressed one by one.

use std::io::Read;

use crate::block::MAX_BLOCK_BYTES;
use crate::compression::messages::decoder;
pub(super) use crate::compression::messages::is_compressed;

/// The longest head of a frame, bytes.
pub(super) const HEAD: usize = 18;

/// How many bytes a message takes in memory, from its first [`HEAD`] bytes and its size in the file; `None` where a frame
/// does not say.
pub(super) fn size_in_memory(head: &[u8], stored: u64) -> Option<u64> {
    if !is_compressed(head) {
        return Some(stored);
    }
    // A broken head is said with its place when the message is read.
    zstd::zstd_safe::get_frame_content_size(head).unwrap_or(Some(stored))
}

/// Measures messages that do not say how large they are, up to a bound for all of a file.
pub(super) struct Measure {
    left: u64,
}

impl Measure {
    /// Up to so many bytes.
    pub(super) fn new(allowance: u64) -> Self {
        Self { left: allowance }
    }

    /// How many bytes a message takes in memory; [`MAX_BLOCK_BYTES`] where it is larger than that, which is said when it is
    /// read. `None` when the bound is reached.
    pub(super) fn size(&mut self, data: &[u8]) -> Option<u64> {
        if self.left == 0 {
            return None;
        }
        let counted = decoder(data)
            .and_then(|decoder| std::io::copy(&mut decoder.take(MAX_BLOCK_BYTES), &mut std::io::sink()))
            // So is what is broken.
            .unwrap_or(data.len() as u64);
        self.left = self.left.saturating_sub(counted);
        Some(counted)
    }
}
