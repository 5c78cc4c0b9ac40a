//! Messages that rosbag2 compressed one by one (`compression_mode: MESSAGE`): each is a zstd frame of its own.
//!
//! A frame is known by its first bytes, which no CDR message can have: that one begins with 0.

use std::io::Read;

use super::WINDOW_LOG;
use crate::block::Entry;

const MAGIC: [u8; 4] = [0x28, 0xb5, 0x2f, 0xfd];

pub(crate) fn is_compressed(data: &[u8]) -> bool {
    data.starts_with(&MAGIC)
}

/// Appends the message to `bytes`, which may grow up to `most`. On error nothing is appended.
pub(crate) fn append(data: &[u8], bytes: &mut Vec<u8>, most: u64) -> Result<(), String> {
    let begin = bytes.len();
    let left = usize::try_from(most).unwrap_or(usize::MAX).saturating_sub(begin);
    let appended = if is_compressed(data) {
        decompress(data, left, bytes)
    } else if data.len() <= left {
        bytes.extend_from_slice(data);
        Ok(())
    } else {
        Err(format!("has {} bytes; accepted: {left}", data.len()))
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

/// Of the one frame in `data`.
pub(crate) fn decoder(data: &[u8]) -> std::io::Result<zstd::stream::read::Decoder<'_, &[u8]>> {
    let mut decoder = zstd::stream::read::Decoder::with_buffer(data)?;
    decoder.window_log_max(WINDOW_LOG)?;
    Ok(decoder.single_frame())
}

/// Messages of a block that cannot be decompressed.
#[derive(Default)]
pub(crate) struct Refused {
    pub(crate) count: u64,
    /// Where the first of them lies in the block, and what is wrong with it.
    pub(crate) first: Option<(usize, String)>,
}

/// Decompresses the messages of a block in place, in the order of its entries, as long as all of them have no more than
/// `most` bytes; the others are left out.
pub(crate) fn decompress_all(bytes: &mut Vec<u8>, entries: &mut Vec<Entry>, most: u64) -> Refused {
    let data =
        |entry: &Entry| bytes.get(entry.data.start as usize..entry.data.end as usize).unwrap_or_default();
    let mut refused = Refused::default();
    if !entries.iter().any(|entry| is_compressed(data(entry))) {
        return refused;
    }
    let mut decompressed = Vec::new();
    entries.retain_mut(|entry| {
        let begin = decompressed.len();
        if let Err(reason) = append(data(entry), &mut decompressed, most) {
            refused.count += 1;
            refused.first.get_or_insert((entry.data.start as usize, reason));
            return false;
        }
        // Blocks are smaller than 4 GiB.
        entry.data = begin as u32..decompressed.len() as u32;
        true
    });
    *bytes = decompressed;
    refused
}
