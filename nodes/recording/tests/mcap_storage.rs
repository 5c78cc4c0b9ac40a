//! MCAP files of all recorders, whole and broken: a broken place costs no more than itself, and says where it is.
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests, which may panic")]

mod common;

use common::mcap_files::*;
use common::*;
use mcap::records::op;
use proptest::prelude::*;
use recording::Recording;

/// What is read of a file: numbers of the poses, sentences of the damage on opening, and of the errors on the way.
fn contents(bytes: &[u8]) -> (Vec<u64>, Vec<String>, Vec<String>) {
    let recording = opened(bytes).unwrap();
    let (messages, errors) = read(&recording);
    let damage = recording.damage().iter().map(ToString::to_string).collect();
    (numbers(&messages), damage, errors.iter().map(ToString::to_string).collect())
}

fn counted(recording: &Recording) -> u64 {
    recording.topics().iter().map(|topic| topic.message_count).sum()
}

#[test]
fn every_compression_with_and_without_chunks_and_summary_reads_the_same() {
    for shape in [PLAIN, ZSTD, LZ4, LOOSE] {
        for summary in [true, false] {
            let shape = Shape { summary, ..shape };
            let bytes = file(shape, 0..1000, 150);
            let recording = opened(&bytes).unwrap();
            assert_eq!(counted(&recording), 1000, "{shape:?}");
            assert_eq!(recording.topics()[0].topic.type_name, TYPE);
            assert_eq!(recording.log_time_bounds_ns(), Some((log_time_ns(0), log_time_ns(999))), "{shape:?}");
            let (found, damage, errors) = contents(&bytes);
            assert!(damage.is_empty() && errors.is_empty(), "{shape:?}: {damage:?} {errors:?}");
            assert_eq!(found, (0..1000).collect::<Vec<_>>(), "{shape:?}");
        }
    }
}

#[test]
fn flipped_bits_inside_a_chunk_cost_that_chunk_alone_and_are_told_once() {
    for shape in [PLAIN, ZSTD, LZ4] {
        for summary in [true, false] {
            let mut bytes = file(Shape { summary, ..shape }, 0..1000, 100);
            let chunk = chunks(&bytes)[3].clone();
            bytes[(chunk.start + chunk.end) / 2] ^= 0x55;
            let (found, damage, errors) = contents(&bytes);
            assert_eq!(found, (0..300).chain(400..1000).collect::<Vec<_>>(), "{shape:?}");
            let told: Vec<_> = damage.iter().chain(&errors).collect();
            assert_eq!(told.len(), 1, "{told:?}");
            assert!(told[0].contains("at byte") && told[0].contains("chunk"), "{told:?}");
            if !summary {
                assert_eq!(counted(&opened(&bytes).unwrap()), 900, "counted is what can be read");
            }
        }
    }
}

#[test]
fn a_record_broken_inside_a_chunk_without_checksum_costs_what_is_behind_it_in_the_chunk() {
    let mut bytes = file(Shape { checksums: false, ..PLAIN }, 0..300, 100);
    let needle = recording::cdr::encode(&pose(140));
    let data = bytes.windows(needle.len()).position(|window| window == needle).unwrap();
    // The length of the record of message 140 becomes 2^63.
    bytes[data - 22 - 1] = 0x80;
    let (found, damage, errors) = contents(&bytes);
    assert_eq!(found, (0..140).chain(200..300).collect::<Vec<_>>());
    assert_eq!((damage.len(), errors.len()), (0, 1));
    assert!(errors[0].contains("longer than the chunk"), "{errors:?}");
}

/// Places of the fields in the head of a chunk's record.
const CHUNK_FIELDS: [(&str, usize, usize); 8] = [
    ("kind", 0, 1),
    ("record length", 1, 8),
    ("start", 9, 8),
    ("end", 17, 8),
    ("size", 25, 8),
    ("checksum", 33, 4),
    ("name length", 37, 4),
    ("stored length", 45, 8),
];

#[test]
fn any_broken_field_of_a_chunks_head_costs_that_chunk_at_most() {
    for shape in [ZSTD, PLAIN] {
        for summary in [true, false] {
            let whole = file(Shape { summary, ..shape }, 0..500, 100);
            let chunk = chunks(&whole)[2].clone();
            for (field, at, length) in CHUNK_FIELDS {
                // The name of an empty compression takes no bytes.
                let at = if field == "stored length" && shape.compression.is_none() { at - 4 } else { at };
                for value in [[0, 0, 0, 0, 0, 0, 0, 0x80], [0xff; 8], [1, 0, 0, 0, 0, 0, 0, 0], [0; 8]] {
                    let mut bytes = whole.clone();
                    bytes[chunk.start + at..chunk.start + at + length].copy_from_slice(&value[8 - length..]);
                    let (found, ..) = contents(&bytes);
                    for number in (0..200).chain(300..500) {
                        assert!(found.binary_search(&number).is_ok(), "{field} {value:?}: {number} is lost");
                    }
                    assert!(found.is_sorted(), "{field} {value:?}");
                }
            }
        }
    }
}

#[test]
fn a_record_length_of_2_to_the_63_outside_of_chunks_costs_that_record_at_most() {
    for shape in [PLAIN, ZSTD, LOOSE] {
        let whole = file(shape, 0..60, 10);
        for (kind, place) in records(&whole) {
            let mut bytes = whole.clone();
            bytes[place.start + 8] = 0x80;
            let (found, damage, _) = contents(&bytes);
            let lost = match kind {
                op::CHUNK => 10,
                op::MESSAGE => 1,
                _ => 0,
            };
            assert!(
                found.len() + lost >= 60,
                "{kind:#04x} at {}: {} left, {damage:?}",
                place.start,
                found.len()
            );
            assert!(!damage.is_empty(), "{kind:#04x} at {}", place.start);
        }
    }
}

#[test]
fn a_chunk_of_unknown_compression_is_named_and_the_others_are_read() {
    let mut bytes = file(ZSTD, 0..300, 100);
    let chunk = chunks(&bytes)[1].clone();
    bytes[chunk.start + 41..chunk.start + 45].copy_from_slice(b"zoom");
    let (found, damage, errors) = contents(&bytes);
    assert_eq!(found, (0..100).chain(200..300).collect::<Vec<_>>());
    let told = damage.iter().chain(&errors).cloned().collect::<String>();
    assert!(told.contains("\"zoom\"") && told.contains("zstd, lz4"), "{told}");
}

#[test]
fn a_bomb_is_damage_whether_it_says_its_size_or_not() {
    let whole = file(Shape { summary: false, ..ZSTD }, 0..300, 100);
    let chunk = chunks(&whole)[1].clone();
    let bomb = zstd::bulk::compress(&vec![0; 80 << 20], 1).unwrap();
    for claimed in [80_u64 << 20, 1000, 1 << 62] {
        let mut record = vec![op::CHUNK];
        record.extend((40 + 4 + bomb.len() as u64).to_le_bytes());
        record.extend(&whole[chunk.start + 9..chunk.start + 25]);
        record.extend(claimed.to_le_bytes());
        record.extend([0; 4]);
        record.extend(&whole[chunk.start + 37..chunk.start + 45]);
        record.extend((bomb.len() as u64).to_le_bytes());
        record.extend(&bomb);
        let bytes = [&whole[..chunk.start], &record, &whole[chunk.end..]].concat();
        let (found, damage, errors) = contents(&bytes);
        assert_eq!(found, (0..100).chain(200..300).collect::<Vec<_>>());
        let told = damage.iter().chain(&errors).cloned().collect::<String>();
        assert!(told.contains("decompresses to"), "{told}");
    }
}

#[test]
fn more_bombs_than_a_file_of_its_size_may_hold_are_left_out_without_being_decompressed() {
    let whole = file(Shape { summary: false, ..ZSTD }, 0..100, 100);
    let chunk = chunks(&whole)[0].clone();
    // One record of an application, which is quickly passed over.
    let mut inside = vec![0; 60 << 20];
    inside[0] = 0x80;
    inside[1..9].copy_from_slice(&((60_u64 << 20) - 9).to_le_bytes());
    let bomb = zstd::bulk::compress(&inside, 1).unwrap();
    let mut record = vec![op::CHUNK];
    record.extend((40 + 4 + bomb.len() as u64).to_le_bytes());
    record.extend([0; 16]);
    record.extend((60_u64 << 20).to_le_bytes());
    record.extend([0; 4]);
    record.extend(&whole[chunk.start + 37..chunk.start + 45]);
    record.extend((bomb.len() as u64).to_le_bytes());
    record.extend(&bomb);
    let mut bytes = whole[..chunk.end].to_vec();
    (0..40).for_each(|_| bytes.extend(&record));
    bytes.extend(&whole[chunk.end..]);
    let recording = opened(&bytes).unwrap();
    assert_eq!(read(&recording).0.len(), 100);
    let told =
        recording.damage().iter().map(ToString::to_string).filter(|told| told.contains("behind others"));
    assert!(told.count() >= 20);
}

#[test]
fn millions_of_strange_records_in_a_chunk_are_one_sentence() {
    let mut bytes = file(Shape { checksums: false, ..ZSTD }, 0..10, 10);
    let chunk = chunks(&bytes)[0].clone();
    let inside = zstd::bulk::compress(&vec![0; 9 << 20], 1).unwrap();
    let mut record = vec![op::CHUNK];
    record.extend((44 + inside.len() as u64).to_le_bytes());
    record.extend([0; 16]);
    record.extend((9_u64 << 20).to_le_bytes());
    record.extend([0, 0, 0, 0, 4, 0, 0, 0]);
    record.extend(b"zstd");
    record.extend((inside.len() as u64).to_le_bytes());
    record.extend(&inside);
    // A chunk without messages is not kept, so this one has to begin with one.
    bytes.splice(chunk.end..chunk.end, record);
    let recording = opened(&bytes).unwrap();
    let (messages, errors) = read(&recording);
    assert_eq!(messages.len(), 10);
    assert!(recording.damage().len() + errors.len() <= 3, "{:?} {errors:?}", recording.damage());
}

#[test]
fn a_text_inside_a_definition_that_says_it_has_gigabytes_takes_no_memory() {
    let whole = file(Shape { checksums: false, ..PLAIN }, 0..10, 10);
    // The map of the channel has one pair of empty texts, and the first one says that it has 2^31 bytes.
    let (_, channel) =
        records(&file(LOOSE, 0..1, 1)).into_iter().find(|(kind, _)| *kind == op::CHANNEL).unwrap();
    let mut bytes = whole.clone();
    let mut record = file(LOOSE, 0..1, 1)[channel].to_vec();
    let size = record.len() - 9;
    record[1..9].copy_from_slice(&(size as u64 + 8).to_le_bytes());
    let map = record.len() - 4;
    record[map..].copy_from_slice(&8_u32.to_le_bytes());
    record.extend(0x8000_0000_u32.to_le_bytes());
    record.extend(0_u32.to_le_bytes());
    let chunk = chunks(&whole)[0].clone();
    bytes.splice(chunk.start..chunk.start, record);
    let before = peak_kb();
    let (found, damage, _) = contents(&bytes);
    assert_eq!((found.len(), damage.is_empty()), (10, false));
    assert!(peak_kb() < before + 1_900_000);
}

/// The most address space this process had, kB.
fn peak_kb() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|line| line.starts_with("VmPeak")).unwrap();
    line.split_whitespace().nth(1).unwrap().parse().unwrap()
}

#[test]
fn wrong_magic_at_either_end_is_said_and_costs_nothing() {
    let whole = file(PLAIN, 0..200, 100);
    for at in (0..8).chain(whole.len() - 8..whole.len()) {
        let mut bytes = whole.clone();
        bytes[at] ^= 0x20;
        let (found, damage, errors) = contents(&bytes);
        assert_eq!(found.len(), 200, "byte {at}");
        assert!(
            errors.is_empty() && damage.iter().any(|told| told.contains("magic")),
            "byte {at}: {damage:?}"
        );
    }
    // Bytes that went missing at the beginning, or came in front of it.
    for bytes in [whole[5..].to_vec(), [b"garbage", &whole[..]].concat(), [&whole[..], b"garbage"].concat()] {
        let (found, damage, _) = contents(&bytes);
        assert_eq!((found.len(), damage.is_empty()), (200, false));
    }
}

#[test]
fn a_summary_that_lies_is_not_believed() {
    let whole = file(PLAIN, 0..500, 100);
    let footer = whole.len() - 8 - 20;
    let without_checksum = |change: &dyn Fn(&mut Vec<u8>)| {
        let mut bytes = whole.clone();
        bytes[footer + 16..footer + 20].fill(0);
        change(&mut bytes);
        let recording = opened(&bytes).unwrap();
        assert_eq!(
            (counted(&recording), recording.log_time_bounds_ns()),
            (500, Some((log_time_ns(0), log_time_ns(499))))
        );
        assert_eq!(numbers(&read(&recording).0), (0..500).collect::<Vec<_>>());
    };
    without_checksum(&|_| {});
    without_checksum(&|bytes| bytes[footer + 7] = 0x80);
    without_checksum(&|bytes| bytes[footer..footer + 8].fill(0xff));
    without_checksum(&|bytes| bytes[footer] ^= 1);
    for (kind, place) in records(&whole) {
        let content = place.start + 9;
        match kind {
            // Start, end, place and length of a chunk.
            op::CHUNK_INDEX => {
                (0..4).for_each(|field| without_checksum(&|bytes| bytes[content + 8 * field + 5] ^= 1))
            }
            // How many chunks there are.
            op::STATISTICS => without_checksum(&|bytes| bytes[content + 8 + 2 + 4 + 4 + 4] ^= 1),
            _ => {}
        }
    }
}

/// The chunk a byte belongs to.
fn chunk_of(bytes: &[u8], at: usize) -> Option<u64> {
    (0..).zip(chunks(bytes)).find(|(_, place)| place.contains(&at)).map(|(number, _)| number)
}

thread_local! {
    static FILES: Vec<Vec<u8>> = [PLAIN, ZSTD, LZ4, Shape { summary: false, ..PLAIN }]
        .map(|shape| file(shape, 0..200, 20)).to_vec();
    static LOOSE_FILE: Vec<u8> = file(LOOSE, 0..200, 200);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, ..ProptestConfig::default() })]

    #[test]
    fn one_changed_byte_costs_the_chunk_it_is_in_at_most(
        which in 0..4_usize, at in any::<prop::sample::Index>(), value in any::<u8>(),
    ) {
        let whole = FILES.with(|files| files[which].clone());
        let at = at.index(whole.len());
        let mut bytes = whole.clone();
        bytes[at] = value;
        let damaged = chunk_of(&whole, at);
        // The text of a topic that is nowhere else may change its name or type, but never its messages.
        let (found, ..) = contents(&bytes);
        let kept = (0..200).filter(|number| damaged != Some(number / 20));
        for number in kept {
            // The only description of the channel may have been in the damaged chunk.
            prop_assert!(found.contains(&number) || (which == 3 && damaged == Some(0)), "{} is lost, byte {} of {}: {} -> {}", number, at, which, whole[at], value);
        }
        prop_assert!(found.len() <= 200 && found.is_sorted());
    }

    #[test]
    fn one_changed_byte_in_a_row_of_messages_costs_one_message_at_most(
        at in any::<prop::sample::Index>(), value in any::<u8>(),
    ) {
        let mut bytes = LOOSE_FILE.with(Clone::clone);
        let messages: Vec<_> = records(&bytes).into_iter().filter(|(kind, _)| *kind == op::MESSAGE).collect();
        let (first, last) = (messages[0].1.start, messages[messages.len() - 1].1.end);
        let at = first + at.index(last - first);
        let hit = messages.iter().position(|(_, place)| place.contains(&at)).unwrap() as u32;
        bytes[at] = value;
        let (messages, _) = read(&opened(&bytes).unwrap());
        let found: Vec<_> = messages.iter().map(|message| message.sequence).collect();
        for number in (0..200).filter(|number| *number != hit) {
            prop_assert!(found.contains(&number), "{} is lost, byte {} of message {}", number, at, hit);
        }
    }
}
