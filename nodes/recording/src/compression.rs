//! Compressed chunks, messages and files, decompressed up to a bound.
//!
//! What a file says about its sizes is never believed: memory and disk grow with what comes out, and stop at the bound.

pub(crate) mod messages;

use std::fs::File;
use std::io::{BufReader, Read, Write};
use std::path::Path;

use tempfile::TempPath;

use crate::block::MAX_BLOCK_BYTES;
use crate::error::Error;

/// The largest window of a zstd frame, 2 to this power: that of a frame made with `zstd -19`, and no more memory than a block.
pub(crate) const WINDOW_LOG: u32 = 26;
/// Bytes that the chunks of a recording may decompress to altogether, whatever the sizes of its files ...
const ANY_CHUNKS_BYTES: u64 = 1 << 30;
/// ... those of files that are compressed as a whole, which lie on a disk and can be a hundred million records ...
const ANY_WHOLE_FILES_BYTES: u64 = 1 << 28;
/// ... and for each byte of a file. Together they stop a bomb long before it fills a disk or takes minutes.
const BYTES_PER_BYTE: u64 = 100;
/// Read and written at once.
const PIECE_BYTES: usize = 1 << 20;

/// The compressions of chunks that are read.
pub(crate) const KNOWN: [&str; 3] = ["", "zstd", "lz4"];

/// What the files of a recording may decompress to.
pub(crate) struct Allowance {
    files: usize,
    /// For chunks and messages.
    pub(crate) parts: Pool,
    /// For files that are compressed as a whole.
    pub(crate) whole_files: Pool,
}

/// Bytes for all files of a recording beside those that each has for its own bytes.
pub(crate) struct Pool(u64);

impl Allowance {
    /// For a recording of so many files.
    pub(crate) fn new(files: usize) -> Self {
        Self { files, parts: Pool(ANY_CHUNKS_BYTES), whole_files: Pool(ANY_WHOLE_FILES_BYTES) }
    }

    /// What the messages in each of so many blocks of a file may decompress to, beside what [`most_in_block`] gives for
    /// their own bytes.
    pub(crate) fn share_of_block(&self, blocks: usize) -> u64 {
        ANY_CHUNKS_BYTES / (self.files.max(1) as u64).saturating_mul(blocks.max(1) as u64)
    }
}

impl Pool {
    /// How many bytes a file of this size may decompress to.
    pub(crate) fn of(&self, file_bytes: u64) -> u64 {
        file_bytes.saturating_mul(BYTES_PER_BYTE).saturating_add(self.0)
    }

    /// Takes what a file of this size did decompress to.
    pub(crate) fn pay(&mut self, file_bytes: u64, decompressed: u64) {
        let own = file_bytes.saturating_mul(BYTES_PER_BYTE);
        self.0 = self.0.saturating_sub(decompressed.saturating_sub(own));
    }
}

/// How many bytes a block may have whose messages are compressed one by one, and which takes `stored` bytes in its file.
pub(crate) fn most_in_block(stored: u64, share: u64) -> u64 {
    stored.saturating_mul(BYTES_PER_BYTE).saturating_add(share).min(MAX_BLOCK_BYTES)
}

/// The inside of a chunk; `size` is what its head says. Where the compression is broken or says another size: what comes
/// out before, and a sentence without the place.
pub(crate) fn decompress(compression: &str, stored: Vec<u8>, size: u64) -> (Vec<u8>, Option<String>) {
    let failed = |error: std::io::Error| {
        format!("a chunk whose {compression} compression is broken ({error}), {} bytes", stored.len())
    };
    // One byte more than it says tells a bomb.
    let most = size.min(MAX_BLOCK_BYTES) + 1;
    let mut bytes = Vec::with_capacity(if compression.is_empty() { 0 } else { most as usize });
    let decompressed = match compression {
        "" => return (stored, None),
        "zstd" => zstd::stream::read::Decoder::with_buffer(&stored[..]).and_then(|mut decoder| {
            decoder.window_log_max(WINDOW_LOG)?;
            decoder.take(most).read_to_end(&mut bytes)
        }),
        "lz4" => lz4_flex::frame::FrameDecoder::new(&stored[..]).take(most).read_to_end(&mut bytes),
        other => return (bytes, Some(unknown(other))),
    };
    let fault = match decompressed {
        Err(error) => Some(failed(error)),
        Ok(_) if bytes.len() as u64 != size => {
            let than = if bytes.len() as u64 > size { "more" } else { "less" };
            let stored = stored.len();
            Some(format!(
                "a chunk of {stored} bytes that decompresses to {than} than the {size} bytes it says"
            ))
        }
        Ok(_) => None,
    };
    (bytes, fault)
}

/// What to say about a chunk with a compression that is not read.
pub(crate) fn unknown(compression: &str) -> String {
    format!("a chunk with compression {compression:?}; accepted: zstd, lz4 and none")
}

/// Decompresses a file that rosbag2 compressed as a whole. The temporary file goes with the value; its name has that of the
/// original in it. What came out before a broken place is kept, with the error.
pub(crate) fn whole_file(path: &Path, pool: &mut Pool) -> Result<(TempPath, Option<Error>), Error> {
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
    let most = pool.of(length);
    let mut piece = vec![0; PIECE_BYTES];
    let mut written = 0_u64;
    let damage = loop {
        match decoder.read(&mut piece) {
            Ok(0) => break None,
            Ok(count) if written + count as u64 > most => {
                let reason = format!(
                    "decompresses to more than the {most} bytes that are accepted of it in a recording of this size"
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
    pool.pay(length, written);
    // Its handle is not needed: a recording can have more parts than a process may have open files.
    Ok((temporary.into_temp_path(), damage))
}
