//! Messages that rosbag2 compressed one by one (`compression_mode: MESSAGE`): each is a zstd frame of its own.
//!
//! A frame is known by its first bytes, which no CDR message can have: that one begins with 0.

use std::io::Read;

use crate::block::MAX_BLOCK_BYTES;
use crate::compression::{WINDOW_LOG, allowance};

const MAGIC: [u8; 4] = [0x28, 0xb5, 0x2f, 0xfd];
/// The longest head of a frame, bytes.
pub(super) const HEAD: usize = 18;

pub(super) fn is_compressed(data: &[u8]) -> bool {
    data.starts_with(&MAGIC)
}

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
    /// For a file of this size.
    pub(super) fn new(file_bytes: u64) -> Self {
        Self { left: allowance(file_bytes) }
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

/// Appends the message to `bytes`, which may grow up to [`MAX_BLOCK_BYTES`]. On error nothing is appended.
pub(super) fn append(data: &[u8], bytes: &mut Vec<u8>) -> Result<(), String> {
    let begin = bytes.len();
    let left = usize::try_from(MAX_BLOCK_BYTES).unwrap_or(usize::MAX).saturating_sub(begin);
    let appended = if is_compressed(data) {
        decompress(data, left, bytes)
    } else if data.len() <= left {
        bytes.extend_from_slice(data);
        Ok(())
    } else {
        Err(format!("has {} bytes; accepted: {MAX_BLOCK_BYTES}", data.len()))
    };
    if appended.is_err() {
        bytes.truncate(begin);
    }
    appended
}

fn decompress(data: &[u8], left: usize, bytes: &mut Vec<u8>) -> Result<(), String> {
    let begin = bytes.len();
    let not_zstd = |error: std::io::Error| format!("is compressed and cannot be decompressed: {error}");
    // One byte more than allowed tells a bomb from a message that fits exactly.
    let decoded = decoder(data).and_then(|decoder| decoder.take(left as u64 + 1).read_to_end(bytes));
    decoded.map_err(not_zstd)?;
    if bytes.len() - begin > left {
        return Err(format!("is {} bytes that decompress to more than {left}", data.len()));
    }
    Ok(())
}

fn decoder(data: &[u8]) -> std::io::Result<zstd::stream::read::Decoder<'_, &[u8]>> {
    let mut decoder = zstd::stream::read::Decoder::with_buffer(data)?;
    decoder.window_log_max(WINDOW_LOG)?;
    Ok(decoder.single_frame())
}
