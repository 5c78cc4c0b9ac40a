//! MCAP files in memory as other recorders write them, and their records.

use std::ops::Range;

use mcap::records::{MessageHeader, op};
use mcap::{Compression, WriteOptions};
use recording::cdr::encode;

use super::{log_time_ns, pose};

/// How a file is written.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shape {
    pub(crate) compression: Option<Compression>,
    pub(crate) chunks: bool,
    pub(crate) summary: bool,
    pub(crate) checksums: bool,
}

/// Uncompressed chunks with a summary.
pub(crate) const PLAIN: Shape = Shape { compression: None, chunks: true, summary: true, checksums: true };
/// The same, compressed.
pub(crate) const ZSTD: Shape = Shape { compression: Some(Compression::Zstd), ..PLAIN };
pub(crate) const LZ4: Shape = Shape { compression: Some(Compression::Lz4), ..PLAIN };
/// Messages outside of chunks.
pub(crate) const LOOSE: Shape = Shape { chunks: false, ..PLAIN };

pub(crate) const TYPE: &str = "geometry_msgs/msg/PoseStamped";

/// Poses `numbers` on `/pose`, `per_chunk` in each chunk.
pub(crate) fn file(shape: Shape, numbers: Range<u64>, per_chunk: u64) -> Vec<u8> {
    file_of(shape, numbers, per_chunk, |number| encode(&pose(number)))
}

/// The same with other bytes as the messages.
pub(crate) fn file_of(
    shape: Shape,
    numbers: Range<u64>,
    per_chunk: u64,
    data: impl Fn(u64) -> Vec<u8>,
) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let options = WriteOptions::new()
        .profile("ros2")
        .compression(shape.compression)
        .use_chunks(shape.chunks)
        .chunk_size(None)
        .calculate_chunk_crcs(shape.checksums)
        .emit_summary_records(shape.summary)
        .emit_summary_offsets(shape.summary);
    let mut writer = options.create(&mut bytes).unwrap();
    let schema = writer.add_schema(TYPE, "ros2msg", b"").unwrap();
    let channel_id = writer.add_channel(schema, "/pose", "cdr", &Default::default()).unwrap();
    for number in numbers.clone() {
        let time = log_time_ns(number);
        let header =
            MessageHeader { channel_id, sequence: number as u32, log_time: time, publish_time: time };
        writer.write_to_known_channel(&header, &data(number)).unwrap();
        if (number - numbers.start + 1).is_multiple_of(per_chunk) {
            writer.flush().unwrap();
        }
    }
    writer.finish().unwrap();
    drop(writer);
    bytes.into_inner()
}

/// The records of a file: kind and place, heads included.
pub(crate) fn records(bytes: &[u8]) -> Vec<(u8, Range<usize>)> {
    let mut records = Vec::new();
    let mut at = mcap::MAGIC.len();
    while at + mcap::MAGIC.len() < bytes.len() {
        let end = at + 9 + u64::from_le_bytes(bytes[at + 1..at + 9].try_into().unwrap()) as usize;
        records.push((bytes[at], at..end));
        at = end;
    }
    records
}

/// The places of the chunks.
pub(crate) fn chunks(bytes: &[u8]) -> Vec<Range<usize>> {
    records(bytes).into_iter().filter(|(kind, _)| *kind == op::CHUNK).map(|(_, place)| place).collect()
}
