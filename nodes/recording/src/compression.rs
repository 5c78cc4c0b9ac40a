//! Compressed chunks and compressed files, decompressed up to a bound.
//!
//! What a file says about its sizes is never believed: memory and disk grow with what comes out, and stop at the bound.

use std::fs::File;
use std::io::{BufReader, Read, Write};
use std::path::Path;

use tempfile::NamedTempFile;

use crate::block::MAX_BLOCK_BYTES;
use crate::error::Error;

/// The largest window of a zstd frame, 2 to this power: that of a frame made with `zstd -19`, and no more memory than a block.
pub(crate) const WINDOW_LOG: u32 = 26;
/// Bytes that a whole recording may decompress to, whatever its size ...
const ANY_FILE_BYTES: u64 = 1 << 30;
/// ... and for each of its own bytes. Together they stop a bomb long before it fills a disk or takes minutes.
const BYTES_PER_BYTE: u64 = 100;
/// Read and written at once.
const PIECE_BYTES: usize = 1 << 20;

/// The compressions of chunks that are read.
pub(crate) const KNOWN: [&str; 3] = ["", "zstd", "lz4"];

/// How many bytes the parts of a file of this size may decompress to altogether.
pub(crate) fn allowance(file_bytes: u64) -> u64 {
    file_bytes.saturating_mul(BYTES_PER_BYTE).saturating_add(ANY_FILE_BYTES)
}

/// The inside of a chunk; `size` is what its head says.
///
/// # Errors
/// A sentence without the place.
pub(crate) fn decompress(compression: &str, stored: Vec<u8>, size: u64) -> Result<Vec<u8>, String> {
    let failed = |error: std::io::Error| {
        format!("a chunk whose {compression} compression is broken ({error}), {} bytes", stored.len())
    };
    // One byte more than it says tells a bomb.
    let most = size.min(MAX_BLOCK_BYTES) + 1;
    let mut bytes = Vec::with_capacity(if compression.is_empty() { 0 } else { most as usize });
    match compression {
        "" => return Ok(stored),
        "zstd" => {
            let mut decoder = zstd::stream::read::Decoder::with_buffer(&stored[..]).map_err(failed)?;
            decoder.window_log_max(WINDOW_LOG).map_err(failed)?;
            decoder.take(most).read_to_end(&mut bytes).map_err(failed)?;
        }
        "lz4" => {
            let decoder = lz4_flex::frame::FrameDecoder::new(&stored[..]);
            decoder.take(most).read_to_end(&mut bytes).map_err(failed)?;
        }
        other => return Err(unknown(other)),
    }
    if bytes.len() as u64 != size {
        let than = if bytes.len() as u64 > size { "more" } else { "less" };
        let stored = stored.len();
        return Err(format!(
            "a chunk of {stored} bytes that decompresses to {than} than the {size} bytes it says"
        ));
    }
    Ok(bytes)
}

/// What to say about a chunk with a compression that is not read.
pub(crate) fn unknown(compression: &str) -> String {
    format!("a chunk with compression {compression:?}; accepted: zstd, lz4 and none")
}

/// Decompresses a file that rosbag2 compressed as a whole. The temporary file goes with the value; its name has that of the
/// original in it. What came out before a broken place is kept, with the error.
pub(crate) fn whole_file(path: &Path) -> Result<(NamedTempFile, Option<Error>), Error> {
    let source = File::open(path).map_err(Error::io(path, "open"))?;
    let length = source.metadata().map_err(Error::io(path, "open"))?.len();
    let name = path.file_stem().unwrap_or_default();
    let directory = std::env::temp_dir();
    let mut temporary = tempfile::Builder::new()
        .prefix("decompressed_")
        .suffix(name)
        .tempfile_in(&directory)
        .map_err(Error::io(&directory, "make a temporary file in"))?;
    let broken = |at: u64, error: &dyn std::fmt::Display| {
        Error::damaged(
            path,
            0,
            format!("the zstd compression of the file breaks off after {at} bytes: {error}"),
        )
    };
    let mut decoder = match zstd::stream::read::Decoder::new(BufReader::new(source)) {
        Ok(decoder) => decoder,
        Err(error) => return Err(broken(0, &error)),
    };
    decoder.window_log_max(WINDOW_LOG + 1).map_err(Error::io(path, "decompress"))?;
    let most = allowance(length);
    let mut piece = vec![0; PIECE_BYTES];
    let mut written = 0_u64;
    let damage = loop {
        match decoder.read(&mut piece) {
            Ok(0) => break None,
            Ok(count) if written + count as u64 > most => {
                let reason = format!(
                    "decompresses to more than the {most} bytes that are accepted of a file of its size"
                );
                break Some(Error::damaged(path, 0, reason));
            }
            Ok(count) => {
                let bytes = piece.get(..count).unwrap_or_default();
                let action =
                    "write the decompressed recording (set TMPDIR to a directory with more space) to";
                temporary.write_all(bytes).map_err(Error::io(temporary.path(), action))?;
                written += count as u64;
            }
            Err(error) => break Some(broken(written, &error)),
        }
    };
    Ok((temporary, damage))
}
