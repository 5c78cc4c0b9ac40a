//! MCAP records as bytes: found, taken out, put in.

use mcap::records::op;

/// Kind and length in front of a record.
pub const HEAD: usize = 9;
/// Start, end, size and CRC in front of the name of a chunk's compression.
const CHUNK_HEAD: usize = 28;

/// Where a record is.
#[derive(Debug, Clone, Copy)]
pub struct At {
    pub opcode: u8,
    /// Of its kind byte.
    pub begin: usize,
    /// Behind its content.
    pub end: usize,
}

/// All records of a whole file.
pub fn of(bytes: &[u8]) -> Vec<At> {
    let magic = mcap::MAGIC.len();
    let in_file = |record: At| At { begin: record.begin + magic, end: record.end + magic, ..record };
    of_buffer(&bytes[magic..bytes.len() - magic]).into_iter().map(in_file).collect()
}

/// All records of the inside of a chunk.
pub fn of_buffer(bytes: &[u8]) -> Vec<At> {
    let mut found = Vec::new();
    let mut begin = 0;
    while begin < bytes.len() {
        let length = u64::from_le_bytes(bytes[begin + 1..begin + HEAD].try_into().unwrap()) as usize;
        found.push(At { opcode: bytes[begin], begin, end: begin + HEAD + length });
        begin += HEAD + length;
    }
    found
}

/// Its chunks.
pub fn chunks(bytes: &[u8]) -> Vec<At> {
    of(bytes).into_iter().filter(|record| record.opcode == op::CHUNK).collect()
}

/// The first record of a kind.
pub fn first(bytes: &[u8], opcode: u8) -> At {
    of(bytes).into_iter().find(|record| record.opcode == opcode).unwrap()
}

/// A record.
pub fn record(opcode: u8, content: &[u8]) -> Vec<u8> {
    let mut bytes = vec![opcode];
    bytes.extend((content.len() as u64).to_le_bytes());
    bytes.extend(content);
    bytes
}

/// The records inside an uncompressed chunk of `bytes`.
pub fn inside(bytes: &[u8], chunk: At) -> &[u8] {
    // The name of the compression is empty; behind it are eight bytes of size.
    &bytes[chunk.begin + HEAD + CHUNK_HEAD + 4 + 8..chunk.end]
}

/// A chunk like `chunk` of `bytes` with another compression: its name, the stored bytes, and the size they are said to have.
pub fn recompressed(bytes: &[u8], chunk: At, compression: &str, stored: &[u8], size: u64) -> Vec<u8> {
    let head = &bytes[chunk.begin + HEAD..chunk.begin + HEAD + CHUNK_HEAD];
    let mut content = head[..16].to_vec();
    content.extend(size.to_le_bytes());
    content.extend(&head[24..28]);
    content.extend((compression.len() as u32).to_le_bytes());
    content.extend(compression.as_bytes());
    content.extend((stored.len() as u64).to_le_bytes());
    content.extend(stored);
    record(op::CHUNK, &content)
}

/// The file with one record replaced, and without its summary, whose places no longer hold.
pub fn replaced(bytes: &[u8], old: At, new: &[u8]) -> Vec<u8> {
    let data_end = first(bytes, op::DATA_END);
    let mut made = bytes[..old.begin].to_vec();
    made.extend(new);
    made.extend(&bytes[old.end..data_end.begin]);
    made.extend(record(op::DATA_END, &[0; 4]));
    made.extend(record(op::FOOTER, &[0; 20]));
    made.extend(mcap::MAGIC);
    made
}

/// A zstd frame of `count` zeros: one byte for each 128 KiB and three for the head of the block.
pub fn zeros_in_zstd(count: u64) -> Vec<u8> {
    const BLOCK: u64 = 128 << 10;
    const RUN: u32 = 1;
    // Magic; then: size in 8 bytes, window given by the descriptor behind it (128 KiB).
    let mut frame = vec![0x28, 0xb5, 0x2f, 0xfd, 0xc0, 0x38];
    frame.extend(count.to_le_bytes());
    let mut left = count;
    while left > 0 {
        let size = left.min(BLOCK);
        left -= size;
        let head = u32::from(left == 0) | RUN << 1 | (size as u32) << 3;
        frame.extend(&head.to_le_bytes()[..3]);
        frame.push(0);
    }
    frame
}
