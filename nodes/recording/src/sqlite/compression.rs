//! Messages that rosbag2 compressed one by one (`compression_mode: MESSAGE`): each is a zstd frame of its own.
//!
//! A frame is known by its first bytes, which no CDR message can have: that one begins with 0.

use std::io::Read;

use crate::block::MAX_BLOCK_BYTES;
use crate::compression::WINDOW_LOG;

const MAGIC: [u8; 4] = [0x28, 0xb5, 0x2f, 0xfd];
/// The longest head of a frame, bytes.
pub(super) const HEAD: usize = 18;

pub(super) fn is_compressed(data: &[u8]) -> bool {
    data.starts_with(&MAGIC)
}

/// How many bytes a message takes in memory, from its first [`HEAD`] bytes and its size in the file. A frame that does not
/// say is taken for the largest one.
pub(super) fn size_in_memory(head: &[u8], stored: u64) -> u64 {
    if !is_compressed(head) {
        return stored;
    }
    match zstd::zstd_safe::get_frame_content_size(head) {
        Ok(Some(size)) => size,
        Ok(None) => MAX_BLOCK_BYTES,
        // Said with its place when the message is read.
        Err(_) => stored,
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
    let mut decoder = zstd::stream::read::Decoder::with_buffer(data).map_err(not_zstd)?;
    decoder.window_log_max(WINDOW_LOG).map_err(not_zstd)?;
    // One byte more than allowed tells a bomb from a message that fits exactly.
    decoder.single_frame().take(left as u64 + 1).read_to_end(bytes).map_err(not_zstd)?;
    if bytes.len() - begin > left {
        return Err(format!("is {} bytes that decompress to more than {left}", data.len()));
    }
    Ok(())
}
