//! Files that are made to cost time and memory: 10 MB each.

use std::io::Write;
use std::path::PathBuf;

use mcap::records::op;

use super::records::{self, chunks, recompressed, record, zeros_in_zstd};
use super::{Case, Expected, hostile_database, whole};

/// The size up to which a check promises its limits.
const SIZE: usize = 10_000_000;

/// What a check says of them does not matter, as long as it says it in time.
pub fn cases() -> Vec<Case> {
    let databases = hostile_database::files().into_iter().map(|(name, bytes)| file(name, bytes)).collect();
    [rows(), bombs(), texts(), walks(), metadata(), databases].into_iter().flatten().collect()
}

fn file(name: &'static str, bytes: Vec<u8>) -> Case {
    assert!(bytes.len() <= SIZE, "{name}: {} bytes", bytes.len());
    Case::file(name, Expected::Damaged, &[], 0, bytes)
}

/// The beginning of a whole file with its topics, and `piece` as often as it fits behind it.
fn row_of(piece: impl Fn(usize) -> Vec<u8>) -> Vec<u8> {
    let (_, bytes) = whole::bytes();
    let first = chunks(&bytes)[0];
    let mut made = bytes[..first.begin].to_vec();
    let inside = records::inside(&bytes, first);
    for definition in records::of_buffer(inside) {
        if definition.opcode != op::MESSAGE {
            made.extend(&inside[definition.begin..definition.end]);
        }
    }
    for number in 0.. {
        let piece = piece(number);
        if made.len() + piece.len() > SIZE {
            break;
        }
        made.extend(piece);
    }
    made
}

fn rows() -> Vec<Case> {
    let (_, bytes) = whole::bytes();
    let chunk = chunks(&bytes)[0];
    let message = |channel: u16, time: u64| {
        let mut content = channel.to_le_bytes().to_vec();
        content.extend([0; 4]);
        content.extend(time.to_le_bytes());
        content.extend(time.to_le_bytes());
        record(op::MESSAGE, &content)
    };
    let same_bytes = |byte: u8| [mcap::MAGIC, &vec![byte; SIZE - 8]].concat();
    let channel = |number: usize| {
        let mut content = (number as u16).to_le_bytes().to_vec();
        content.extend(0_u16.to_le_bytes());
        let name = format!("/{number}");
        for text in [name.as_str(), "cdr"] {
            content.extend((text.len() as u32).to_le_bytes());
            content.extend(text.as_bytes());
        }
        content.extend([0; 4]);
        record(op::CHANNEL, &content)
    };
    vec![
        file("bytes_00.mcap", same_bytes(0)),
        file("bytes_03.mcap", same_bytes(3)),
        file("bytes_05.mcap", same_bytes(5)),
        file("bytes_06.mcap", same_bytes(6)),
        file("bytes_ff.mcap", same_bytes(0xff)),
        file("tiny_messages.mcap", row_of(|number| message(1, number as u64))),
        file("tiny_messages_backwards.mcap", row_of(|number| message(1, u64::MAX - number as u64))),
        file("messages_of_nobody.mcap", row_of(|number| message(9000, number as u64))),
        file("tiny_chunks.mcap", row_of(|_| recompressed(&bytes, chunk, "", &[], 0))),
        file("tiny_chunks_of_nothing_known.mcap", row_of(|_| recompressed(&bytes, chunk, "x", &[0], 1))),
        file(
            "chunks_inside_chunks.mcap",
            row_of(|number| [&[op::CHUNK][..], &((SIZE - number * 9) as u64).to_le_bytes()].concat()),
        ),
        file("tiny_channels.mcap", row_of(channel)),
        file("tiny_records_of_no_kind.mcap", row_of(|_| record(0x70, &[]))),
    ]
}

fn bombs() -> Vec<Case> {
    let (_, bytes) = whole::bytes();
    let chunk = chunks(&bytes)[0];
    let zeros = zeros_in_zstd(60 << 20);
    let messages = |count: usize| {
        let mut content = 1_u16.to_le_bytes().to_vec();
        content.resize(22, 0);
        record(op::MESSAGE, &content).repeat(count)
    };
    let count = (60 << 20) / 31;
    let packed = zstd::bulk::compress(&messages(count), 3).unwrap();
    let lz4 = {
        let mut encoder = lz4_flex::frame::FrameEncoder::new(Vec::new());
        encoder.write_all(&messages(count)).unwrap();
        encoder.finish().unwrap()
    };
    let without_checksum = |compression: &str, stored: &[u8], size: u64| {
        let mut made = recompressed(&bytes, chunk, compression, stored, size);
        made[records::HEAD + 24..records::HEAD + 28].fill(0);
        made
    };
    let zeros = without_checksum("zstd", &zeros, 60 << 20);
    let packed = without_checksum("zstd", &packed, count as u64 * 31);
    let lz4 = without_checksum("lz4", &lz4, count as u64 * 31);
    vec![
        file("zstd_zeros.mcap", row_of(|_| zeros.clone())),
        file("zstd_messages.mcap", row_of(|_| packed.clone())),
        file("lz4_messages.mcap", row_of(|_| lz4.clone())),
    ]
}

fn texts() -> Vec<Case> {
    // One long definition for many topics, and one long QoS for each.
    let (_, bytes) = whole::bytes();
    let begin = chunks(&bytes)[0].begin;
    let schema = |text: &[u8]| {
        let mut content = 7_u16.to_le_bytes().to_vec();
        for part in [&b"geometry_msgs/msg/PoseStamped"[..], b"ros2msg", text] {
            content.extend((part.len() as u32).to_le_bytes());
            content.extend(part);
        }
        record(op::SCHEMA, &content)
    };
    let channel = |number: u16, qos: &str| {
        let mut content = (100 + number).to_le_bytes().to_vec();
        content.extend(7_u16.to_le_bytes());
        let name = format!("/{number}/measured_cp");
        for text in [name.as_str(), "cdr"] {
            content.extend((text.len() as u32).to_le_bytes());
            content.extend(text.as_bytes());
        }
        let mut entry = Vec::new();
        for text in ["offered_qos_profiles", qos] {
            entry.extend((text.len() as u32).to_le_bytes());
            entry.extend(text.as_bytes());
        }
        content.extend((entry.len() as u32).to_le_bytes());
        content.extend(entry);
        record(op::CHANNEL, &content)
    };
    let shared = |text: &[u8], count: u16| {
        let mut made = [&bytes[..begin], &schema(text)].concat();
        (0..count).for_each(|number| made.extend(channel(number, "")));
        made
    };
    let with_qos = |qos: &str| [&bytes[..begin], &schema(b""), &channel(0, qos)].concat();
    vec![
        file("definition_of_many.mcap", shared(&b"float64 x\n".repeat(500_000), 30_000)),
        file("definition_of_arrays.mcap", shared(&b"[".repeat(5_000_000), 100)),
        file(
            "definition_of_types.mcap",
            shared(&format!("{}\nMSG: a/B\na/B x\n", "=".repeat(80)).repeat(50_000).into_bytes(), 100),
        ),
        file("qos_nested.mcap", with_qos(&"[".repeat(9_000_000))),
        file("qos_nested_blocks.mcap", with_qos(&"- ".repeat(4_500_000))),
        file("qos_aliases.mcap", with_qos(&aliases())),
        file("qos_of_many.mcap", with_qos(&"- {depth: 1}\n".repeat(600_000))),
    ]
}

/// Files that are small and unpack, or look, like a great many definitions.
fn walks() -> Vec<Case> {
    let (_, bytes) = whole::bytes();
    let chunk = chunks(&bytes)[0];
    let begin = &bytes[..chunk.begin];
    let packed = |inside: &[u8]| {
        let stored = zstd::bulk::compress(inside, 3).unwrap();
        let mut made = recompressed(&bytes, chunk, "zstd", &stored, inside.len() as u64);
        made[records::HEAD + 24..records::HEAD + 28].fill(0);
        made
    };
    let text = |text: &[u8]| [&(text.len() as u32).to_le_bytes(), text].concat();
    let schema = |id: u16, definition: &[u8]| {
        let name = text(b"geometry_msgs/msg/PoseStamped");
        record(op::SCHEMA, &[&id.to_le_bytes()[..], &name, &text(b"ros2msg"), &text(definition)].concat())
    };
    let channel = |id: u16, pairs: &[u8]| {
        let name = text(format!("/{id}").as_bytes());
        record(op::CHANNEL, &[&id.to_le_bytes()[..], &[0, 0], &name, &text(b"cdr"), &text(pairs)].concat())
    };
    let long = vec![b'#'; 50 << 20];
    let schemas: Vec<u8> = (0..30).flat_map(|id| packed(&schema(10 + id, &long))).collect();
    let unreadable = packed(&record(op::SCHEMA, &[]).repeat((60 << 20) / 9)).repeat(30);
    let cut_texts = packed(&record(op::SCHEMA, &[0xff; 14]).repeat((60 << 20) / 23)).repeat(30);
    let different = (0..3_000_000_u32).flat_map(|key| [text(&key.to_le_bytes()), text(&[])].concat());
    let keys = packed(&channel(9, &different.collect::<Vec<_>>()));
    let keys = keys.repeat((SIZE - begin.len()) / keys.len());
    let qos = "- {history: 1, depth: 1, reliability: 1, durability: 1, deadline: {sec: 0, nsec: 0}, lifespan: {sec: 0, nsec: 0}, \
               liveliness: 1, liveliness_lease_duration: {sec: 0, nsec: 0}, avoid_ros_namespace_conventions: false}\n"
        .repeat(1200);
    let with_qos = [text(b"offered_qos_profiles"), text(qos.as_bytes())].concat();
    let offers: Vec<u8> = (0..16_u16)
        .flat_map(|part| {
            packed(&(0..200).flat_map(|id| channel(100 + part * 200 + id, &with_qos)).collect::<Vec<_>>())
        })
        .collect();
    // Metadata whose map goes on for half a megabyte and then does not add up, one beginning behind each other.
    let mut maps = Vec::new();
    while maps.len() < 9_000_000 {
        let (count, map) = (38_000, 500_003_u32);
        let end = maps.len() + count * 13;
        for _ in 0..count {
            let behind = (maps.len() + 13) as u64;
            let name = end as u64 - behind;
            maps.push(op::METADATA);
            maps.extend((name + 4 + 4 + u64::from(map)).to_le_bytes());
            maps.extend((name as u32).to_le_bytes());
        }
        maps.extend(map.to_le_bytes());
        maps.resize(maps.len() + map as usize, 0);
    }
    let whole_file = |piece: &[u8]| {
        let mut encoder = zstd::stream::Encoder::new(Vec::new(), 3).unwrap();
        encoder.write_all(begin).unwrap();
        let many = piece.repeat((1 << 20) / piece.len());
        (0..1024).for_each(|_| encoder.write_all(&many).unwrap());
        encoder.finish().unwrap()
    };
    let behind_begin = |more: &[u8]| [begin, more].concat();
    vec![
        file("definitions_in_chunks.mcap", behind_begin(&schemas)),
        file("unreadable_definitions.mcap", behind_begin(&unreadable)),
        file("definitions_with_cut_texts.mcap", behind_begin(&cut_texts)),
        file("channel_with_many_keys.mcap", behind_begin(&keys)),
        file("qos_of_many_channels.mcap", behind_begin(&offers)),
        file("maps_that_go_on.mcap", behind_begin(&maps)),
        file("schemas.mcap.zstd", whole_file(&record(op::SCHEMA, &[]))),
        file("chunks.mcap.zstd", whole_file(&record(op::CHUNK, &[]))),
        file(
            "messages.mcap.zstd",
            whole_file(&record(
                op::MESSAGE,
                &[1, 0, 0, 0, 0, 0, 5, 0, 0, 0, 0, 0, 0, 0, 5, 0, 0, 0, 0, 0, 0, 0],
            )),
        ),
    ]
}

fn metadata() -> Vec<Case> {
    let (metadata, bytes) = whole::bytes();
    let metadata = String::from_utf8(metadata).unwrap();
    let with = |name, metadata: String| Case {
        name,
        expected: Expected::Damaged,
        words: &[],
        readable: 0,
        files: vec![
            (PathBuf::from("metadata.yaml"), metadata.into_bytes()),
            (PathBuf::from("session_0.mcap"), bytes.clone()),
        ],
    };
    let files = "  - session_0.mcap\n";
    let many: String = (0..400_000).map(|number| format!("    - s_{number}.mcap\n")).collect();
    vec![
        with("metadata_nested", "[".repeat(9_000_000)),
        with("metadata_nested_blocks", "- ".repeat(4_500_000)),
        with("metadata_aliases", aliases()),
        with("metadata_long_text", metadata.replace("jazzy", &"x".repeat(9_000_000))),
        with("metadata_many_files", metadata.replace(files, &many)),
        many_topics(&metadata),
    ]
}

/// Metadata and a file with tens of thousands of topics that are not the same.
fn many_topics(metadata: &str) -> Case {
    let file = row_of(|number| {
        let name = format!("/{number}");
        let mut content = [&(number as u16).to_le_bytes()[..], &[0, 0]].concat();
        for text in [name.as_str(), "cdr"] {
            content.extend((text.len() as u32).to_le_bytes());
            content.extend(text.as_bytes());
        }
        content.extend([0; 4]);
        if number < 60_000 { record(op::CHANNEL, &content) } else { vec![0; SIZE] }
    });
    let topics = "  topics_with_message_count:\n";
    let many: String = (100_000..140_000)
        .map(|number| {
            format!("    - {{topic_metadata: {{name: /{number}, type: a/B, serialization_format: cdr}}, message_count: 0}}\n")
        })
        .collect();
    Case {
        name: "metadata_many_topics",
        expected: Expected::Damaged,
        words: &[],
        readable: 0,
        files: vec![
            (
                PathBuf::from("metadata.yaml"),
                metadata.replace(topics, &format!("{topics}{many}")).into_bytes(),
            ),
            (PathBuf::from("session_0.mcap"), file),
        ],
    }
}

/// Each level is the one before ten times.
fn aliases() -> String {
    let mut text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n".to_owned();
    for level in 1..20 {
        let before = format!("*a{}", level - 1);
        text.push_str(&format!("a{level}: &a{level} [{}]\n", [before.as_str(); 10].join(", ")));
    }
    text
}
