//! MCAP files with broken bytes.

use mcap::records::op;

use super::Expected::{Damaged, Unreadable};
use super::records::{self, HEAD, chunks, first, recompressed, record, replaced, zeros_in_zstd};
use super::{Case, whole};

/// 2^63.
const HUGE: u64 = 1 << 63;

pub fn cases() -> Vec<Case> {
    let (_, bytes) = whole::bytes();
    [beginnings(&bytes), cuts(&bytes), flips(&bytes), lengths(&bytes), compressions(&bytes)]
        .into_iter()
        .flatten()
        .collect()
}

fn beginnings(bytes: &[u8]) -> Vec<Case> {
    let mut magic = bytes.to_vec();
    magic[1] = b'm';
    vec![
        Case::file("empty.mcap", Unreadable, &["empty"], 0, Vec::new()),
        Case::file("wrong_magic.mcap", Damaged, &["magic"], whole::MESSAGES, magic),
        Case::file("text.mcap", Unreadable, &["magic"], 0, b"not a recording at all\n".repeat(100)),
        Case::file("magic_only.mcap", Unreadable, &["closing records"], 0, mcap::MAGIC.to_vec()),
        Case::file("cut_in_magic.mcap", Unreadable, &["magic"], 0, mcap::MAGIC[..5].to_vec()),
    ]
}

fn cuts(bytes: &[u8]) -> Vec<Case> {
    let chunks = chunks(bytes);
    let (second, third) = (chunks[1], chunks[2]);
    let header = first(bytes, op::HEADER);
    let statistics = first(bytes, op::STATISTICS);
    vec![
        Case::file("cut_in_chunk.mcap", Damaged, &["byte"], 900, bytes[..third.begin + 5000].to_vec()),
        Case::file(
            "cut_between_records.mcap",
            Damaged,
            &["closing records"],
            900,
            bytes[..second.end].to_vec(),
        ),
        Case::file("cut_in_record_head.mcap", Damaged, &["byte"], 900, bytes[..third.begin + 4].to_vec()),
        Case::file(
            "cut_in_summary.mcap",
            Damaged,
            &["byte"],
            whole::MESSAGES,
            bytes[..statistics.end - 3].to_vec(),
        ),
        Case::file("cut_in_header.mcap", Unreadable, &["byte"], 0, bytes[..header.end - 3].to_vec()),
    ]
}

fn flips(bytes: &[u8]) -> Vec<Case> {
    let chunk = chunks(bytes)[1];
    let flipped = |at: usize| {
        let mut flipped = bytes.to_vec();
        flipped[at] ^= 0x10;
        flipped
    };
    // Inside of a chunk without a checksum: the length of a message in the middle.
    let mut unchecked = bytes[chunk.begin..chunk.end].to_vec();
    unchecked[HEAD + 24..HEAD + 28].fill(0);
    let middle = records::of_buffer(records::inside(bytes, chunk))[200];
    let inside = chunk.end - records::inside(bytes, chunk).len() - chunk.begin;
    unchecked[inside + middle.begin + 4] ^= 0x40;
    let index = first(bytes, op::CHUNK_INDEX);
    let statistics = first(bytes, op::STATISTICS);
    let footer = first(bytes, op::FOOTER);
    // Zeros over a tenth of a chunk, as a power cut leaves them.
    let mut hole = bytes.to_vec();
    let size = chunk.end - chunk.begin;
    hole[chunk.begin + size / 2..chunk.begin + size / 2 + size / 10].fill(0);
    // A channel in the index of one chunk becomes another, and the summary has no checksum that would tell.
    let mut other_channel = bytes.to_vec();
    other_channel[index.begin + HEAD + 32 + 4] ^= 4;
    other_channel[footer.begin + HEAD + 16..footer.begin + HEAD + 20].fill(0);
    vec![
        Case::file(
            "hole_in_chunk.mcap",
            Damaged,
            &["checksum", "broken records"],
            whole::MESSAGES - 150,
            hole,
        ),
        Case::file(
            "flipped_channel_in_index.mcap",
            Damaged,
            &["lists other channels"],
            whole::MESSAGES,
            other_channel,
        ),
        Case::file(
            "flipped_in_chunk.mcap",
            Damaged,
            &["checksum", "byte"],
            whole::MESSAGES - 1,
            flipped(chunk.begin + 9000),
        ),
        Case::file(
            "flipped_in_unchecked_chunk.mcap",
            Damaged,
            &["broken records"],
            whole::MESSAGES - 1,
            replaced(bytes, chunk, &unchecked),
        ),
        Case::file("flipped_in_chunk_head.mcap", Damaged, &["byte"], 2900, flipped(chunk.begin + HEAD + 20)),
        Case::file("flipped_kind_of_chunk.mcap", Damaged, &["byte"], 2900, flipped(chunk.begin)),
        Case::file(
            "flipped_length_of_chunk.mcap",
            Damaged,
            &["wrong kind or length"],
            whole::MESSAGES,
            flipped(chunk.begin + 3),
        ),
        Case::file(
            "flipped_in_index.mcap",
            Damaged,
            &["byte"],
            whole::MESSAGES,
            flipped(index.begin + HEAD + 10),
        ),
        Case::file(
            "flipped_in_statistics.mcap",
            Damaged,
            &["byte"],
            whole::MESSAGES,
            flipped(statistics.begin + HEAD + 2),
        ),
        Case::file(
            "flipped_in_footer.mcap",
            Damaged,
            &["byte"],
            whole::MESSAGES,
            flipped(footer.begin + HEAD + 1),
        ),
        Case::file(
            "flipped_in_last_magic.mcap",
            Damaged,
            &["byte"],
            whole::MESSAGES,
            flipped(bytes.len() - 2),
        ),
    ]
}

fn lengths(bytes: &[u8]) -> Vec<Case> {
    let chunk = chunks(bytes)[1];
    let header = first(bytes, op::HEADER);
    let huge = |record: records::At| {
        let mut huge = bytes.to_vec();
        huge[record.begin + 1..record.begin + HEAD].copy_from_slice(&HUGE.to_le_bytes());
        huge
    };
    let mut chunk_size = bytes.to_vec();
    chunk_size[chunk.begin + HEAD + 16..chunk.begin + HEAD + 24].copy_from_slice(&HUGE.to_le_bytes());
    let mut stored_size = bytes.to_vec();
    stored_size[chunk.begin + HEAD + 32..chunk.begin + HEAD + 40].copy_from_slice(&HUGE.to_le_bytes());
    vec![
        Case::file("huge_record.mcap", Damaged, &["wrong kind or length"], whole::MESSAGES, huge(chunk)),
        Case::file("huge_header.mcap", Damaged, &["9223372036854775808"], 900, huge(header)),
        Case::file("huge_chunk.mcap", Damaged, &["byte"], 2900, chunk_size),
        Case::file("huge_stored_size.mcap", Damaged, &["byte"], 2900, stored_size),
    ]
}

fn compressions(bytes: &[u8]) -> Vec<Case> {
    let chunk = chunks(bytes)[1];
    let records = records::inside(bytes, chunk);
    let size = records.len() as u64;
    let with = |compression: &str, stored: &[u8], size: u64| {
        replaced(bytes, chunk, &recompressed(bytes, chunk, compression, stored, size))
    };
    // A file of nothing but chunks that grow a thousandfold and more.
    let bomb = zeros_in_zstd(60 << 20);
    let bombs: Vec<u8> = (0..400).flat_map(|_| recompressed(bytes, chunk, "zstd", &bomb, 60 << 20)).collect();
    let mut only_bombs = bytes[..chunk.begin].to_vec();
    only_bombs.extend(bombs);
    vec![
        Case::file("unknown_compression.mcap", Damaged, &["brotli"], 2900, with("brotli", records, size)),
        Case::file("zstd_garbage.mcap", Damaged, &["zstd"], 2900, with("zstd", records, size)),
        Case::file("lz4_garbage.mcap", Damaged, &["lz4"], 2900, with("lz4", records, size)),
        Case::file(
            "zstd_bomb.mcap",
            Damaged,
            &["byte"],
            2900,
            with("zstd", &zeros_in_zstd(4 << 30), 4 << 30),
        ),
        Case::file(
            "zstd_bomb_that_says_little.mcap",
            Damaged,
            &["zstd"],
            2900,
            with("zstd", &zeros_in_zstd(4 << 30), size),
        ),
        Case::file("zstd_bombs.mcap", Damaged, &["byte"], 900, only_bombs),
        Case::file(
            "record_in_chunk_beyond_its_end.mcap",
            Damaged,
            &["byte"],
            2900,
            replaced(bytes, chunk, &{
                let stored = [&record(op::MESSAGE, &[0; 50])[..], &[op::MESSAGE, 0xff, 0xff, 0xff]].concat();
                let mut made = recompressed(bytes, chunk, "", &stored, stored.len() as u64);
                made[HEAD + 24..HEAD + 28].fill(0);
                made
            }),
        ),
    ]
}
