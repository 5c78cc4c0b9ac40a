//! MCAP files of all recorders, whole and broken: a broken place costs no more than itself, and says where it is.
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests, which may panic")]

mod common;

use common::mcap_files::*;
use common::*;
use mcap::records::op;
use proptest::prelude::*;
use recording::Recording;
use recording::cdr::encode;

/// What is read of a file: numbers of the poses that are as they were written, sentences of the damage on opening, and of
/// the errors on the way. Messages that are not as they were written never come without a word.
fn contents(bytes: &[u8]) -> (Vec<u64>, Vec<String>, Vec<String>) {
    let recording = opened(bytes).unwrap();
    let (messages, errors) = read(&recording);
    let damage: Vec<_> = recording.damage().iter().map(ToString::to_string).collect();
    let errors: Vec<_> = errors.iter().map(ToString::to_string).collect();
    let as_written = |message: &&recording::Message| {
        let number = message.log_time_ns.saturating_sub(START_NS) / STEP_NS;
        number < 10_000 && log_time_ns(number) == message.log_time_ns && message.data == encode(&pose(number))
    };
    let whole: Vec<_> = messages.iter().filter(as_written).cloned().collect();
    assert!(whole.len() == messages.len() || !(damage.is_empty() && errors.is_empty()));
    (numbers(&whole), damage, errors)
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
fn flipped_bits_inside_a_chunk_cost_one_message_or_what_no_longer_decompresses_and_are_told_once() {
    for shape in [PLAIN, ZSTD, LZ4] {
        for summary in [true, false] {
            let mut bytes = file(Shape { summary, ..shape }, 0..1000, 100);
            let chunk = chunks(&bytes)[3].clone();
            bytes[(chunk.start + chunk.end) / 2] ^= 0x55;
            let (found, damage, errors) = contents(&bytes);
            let others: Vec<_> =
                found.iter().copied().filter(|number| !(300..400).contains(number)).collect();
            assert_eq!(others, (0..300).chain(400..1000).collect::<Vec<_>>(), "{shape:?}");
            if shape.compression.is_none() {
                assert_eq!(found.len(), 999);
            }
            let told: Vec<_> = damage.iter().chain(&errors).filter(|told| told.contains("a chunk")).collect();
            assert_eq!(told.len(), 1, "{damage:?} {errors:?}");
            assert!(told[0].contains("at byte"), "{told:?}");
            if !summary {
                let recording = opened(&bytes).unwrap();
                let readable = read(&recording).0.len() as u64;
                assert_eq!(counted(&recording), readable, "counted is what can be read");
            }
        }
    }
}

#[test]
fn any_bit_of_a_message_in_a_plain_chunk_costs_that_message_at_most() {
    for checksums in [true, false] {
        let whole = file(Shape { checksums, ..PLAIN }, 0..60, 20);
        let needle = encode(&pose(30));
        let data = whole.windows(needle.len()).position(|window| window == needle).unwrap();
        for bit in 0..(31 + 16) * 8 {
            let mut bytes = whole.clone();
            bytes[data - 31 + bit / 8] ^= 1 << (bit % 8);
            let recording = opened(&bytes).unwrap();
            let (messages, errors) = read(&recording);
            let sequences: Vec<_> = messages.iter().map(|message| message.sequence).collect();
            for number in (0..60).filter(|number| *number != 30) {
                assert!(sequences.contains(&number), "{number} is lost with bit {bit}");
            }
            assert!(messages.len() <= 60);
            assert!(
                !checksums || errors.iter().any(|error| error.to_string().contains("checksum")),
                "bit {bit}"
            );
        }
    }
}

#[test]
fn broken_times_of_half_of_a_chunks_messages_do_not_break_the_order() {
    let mut bytes = file(PLAIN, 0..6, 2);
    let places = chunks(&bytes);
    // The second message of the first chunk says that it is the last of all, that of the second that it is the first.
    for (number, chunk, time_ns) in [(1, 0, log_time_ns(9_000)), (3, 1, 1)] {
        let written = log_time_ns(number).to_le_bytes();
        let inside = &mut bytes[places[chunk].clone()];
        let after_head = inside.windows(8).rposition(|window| window == written).unwrap() - 8;
        inside[after_head..after_head + 8].copy_from_slice(&u64::to_le_bytes(time_ns));
    }
    let recording = opened(&bytes).unwrap();
    let (messages, errors) = read(&recording);
    assert!(messages.is_sorted_by_key(|message| message.log_time_ns));
    assert_eq!(numbers(&messages), [0, 2, 4, 5]);
    let told = errors.iter().filter(|error| error.to_string().contains("checksum")).count();
    assert_eq!(told, 2, "{errors:?}");
}

#[test]
fn a_hole_of_zeros_in_a_plain_chunk_costs_the_messages_it_is_in() {
    for (shape, told) in [(PLAIN, "checksum"), (Shape { checksums: false, ..PLAIN }, "broken records")] {
        let mut bytes = file(shape, 0..1000, 500);
        let chunk = chunks(&bytes)[1].clone();
        let size = (chunk.end - chunk.start) / 500;
        let begin = chunk.start + 100 * size;
        bytes[begin..begin + 50 * size].fill(0);
        let (found, damage, errors) = contents(&bytes);
        assert!(found.len() >= 1000 - 52, "{}", found.len());
        assert!(
            damage.iter().chain(&errors).any(|sentence| sentence.contains(told)),
            "{damage:?} {errors:?}"
        );
    }
}

#[test]
fn of_a_compressed_chunk_that_is_cut_what_decompresses_is_read() {
    for shape in [ZSTD, LZ4] {
        // 5000 poses are six blocks of a zstd frame.
        let bytes = file(shape, 0..5000, 5000);
        let chunk = chunks(&bytes)[0].clone();
        let (found, damage, _) = contents(&bytes[..chunk.end - 50]);
        assert!(found.len() > 3000 && found.len() < 5000, "{shape:?}: {}", found.len());
        assert_eq!(found, (0..found.len() as u64).collect::<Vec<_>>(), "{shape:?}");
        assert!(damage.iter().any(|told| told.contains("broken record")), "{damage:?}");
    }
}

#[test]
fn a_record_broken_inside_a_chunk_without_checksum_costs_that_record() {
    let mut bytes = file(Shape { checksums: false, ..PLAIN }, 0..300, 100);
    let needle = recording::cdr::encode(&pose(140));
    let data = bytes.windows(needle.len()).position(|window| window == needle).unwrap();
    // The length of the record of message 140 becomes 2^63.
    bytes[data - 22 - 1] = 0x80;
    let (found, damage, errors) = contents(&bytes);
    assert_eq!(found, (0..140).chain(141..300).collect::<Vec<_>>());
    assert_eq!((damage.len(), errors.len()), (0, 1));
    assert!(errors[0].contains("broken records"), "{errors:?}");
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

/// A chunk with these records inside, without a checksum.
fn chunk_of_records(compression: &str, inside: &[u8]) -> Vec<u8> {
    let stored = match compression {
        "" => inside.to_vec(),
        _ => zstd::bulk::compress(inside, 1).unwrap(),
    };
    let mut record = vec![op::CHUNK];
    record.extend((40 + compression.len() as u64 + stored.len() as u64).to_le_bytes());
    record.extend([0; 16]);
    record.extend((inside.len() as u64).to_le_bytes());
    record.extend([0; 4]);
    record.extend((compression.len() as u32).to_le_bytes());
    record.extend(compression.as_bytes());
    record.extend((stored.len() as u64).to_le_bytes());
    record.extend(&stored);
    record
}

fn record(kind: u8, content: &[u8]) -> Vec<u8> {
    [&[kind][..], &(content.len() as u64).to_le_bytes(), content].concat()
}

#[test]
fn millions_of_strange_records_in_a_chunk_are_one_sentence() {
    let whole = file(Shape { checksums: false, ..PLAIN }, 0..10, 10);
    let chunk = chunks(&whole)[0].clone();
    let loose = file(LOOSE, 0..10, 10);
    let pose = records(&loose).into_iter().find(|(kind, _)| *kind == op::MESSAGE).unwrap().1;
    let pose = &loose[pose];
    // Between poses: a message shorter than its head, a kind there is none of, a definition without its fields.
    let strange = [record(op::MESSAGE, &[0; 21]), record(0x70, &[1; 4]), record(op::SCHEMA, &[])].concat();
    let inside = [pose, &strange, pose, pose, pose].concat().repeat(50_000);
    let told_of = |compression: &str| {
        let mut bytes = whole.clone();
        bytes.splice(chunk.end..chunk.end, chunk_of_records(compression, &inside));
        let recording = opened(&bytes).unwrap();
        let (messages, errors) = read(&recording);
        let told: Vec<_> = recording.damage().iter().chain(&errors).map(ToString::to_string).collect();
        (messages.len(), told)
    };
    let (count, told) = told_of("");
    assert_eq!(count, 10 + 4 * 50_000, "{told:?}");
    assert!(told.iter().filter(|told| told.contains("broken records")).count() == 1, "{told:?}");
    assert!(told.len() <= 4, "{told:?}");
    let (count, told) = told_of("zstd");
    assert!(count > 10 && told.len() <= 4, "{count}: {told:?}");
}

#[test]
fn definitions_in_a_compressed_chunk_take_bounded_memory_and_are_told_in_one_sentence() {
    let whole = file(Shape { checksums: false, ..PLAIN }, 0..10, 10);
    let chunk = chunks(&whole)[0].clone();
    let text = |text: &[u8]| [&(text.len() as u32).to_le_bytes(), text].concat();
    let long = vec![b'#'; 3 << 20];
    let schemas: Vec<u8> = (100_u16..300)
        .flat_map(|id| {
            let content =
                [&id.to_le_bytes()[..], &text(TYPE.as_bytes()), &text(b"ros2msg"), &text(&long)].concat();
            chunk_of_records("zstd", &record(op::SCHEMA, &content))
        })
        .collect();
    let unreadable = chunk_of_records("zstd", &record(op::SCHEMA, &[0xff; 14]).repeat(1_000_000));
    let mut bytes = whole.clone();
    bytes.splice(chunk.end..chunk.end, [schemas, unreadable].concat());
    let before = resident_kb();
    let recording = opened(&bytes).unwrap();
    assert!(resident_kb() < before + 150_000, "{before} kB before, {} kB with it", resident_kb());
    assert_eq!(read(&recording).0.len(), 10);
    let told: Vec<_> = recording.damage().iter().map(ToString::to_string).collect();
    assert!(told.iter().any(|told| told.contains("1000000 definitions that cannot be read")), "{told:?}");
    assert!(told.iter().any(|told| told.contains("definitions of more than")), "{told:?}");
    assert!(told.len() <= 4, "{told:?}");
}

/// What this process has in memory, kB.
fn resident_kb() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|line| line.starts_with("VmRSS")).unwrap();
    line.split_whitespace().nth(1).unwrap().parse().unwrap()
}

/// Writes the checksum of the summary anew, or none.
fn seal(bytes: &mut [u8], with_checksum: bool) {
    let footer = bytes.len() - 8 - 20;
    let summary = u64::from_le_bytes(bytes[footer..footer + 8].try_into().unwrap()) as usize;
    let checksum = if with_checksum { crc32fast::hash(&bytes[summary..footer + 16]) } else { 0 };
    bytes[footer + 16..footer + 20].copy_from_slice(&checksum.to_le_bytes());
}

#[test]
fn an_index_that_lists_other_channels_hides_no_message_of_a_topic_and_is_said() {
    let whole = file(PLAIN, 0..500, 100);
    let of_kind = |kind: u8| records(&whole).into_iter().filter(move |found| found.0 == kind);
    for with_checksum in [true, false] {
        let mut bytes = whole.clone();
        // The first channel of the second chunk's index: behind start, end, place and length of the chunk.
        let index = of_kind(op::CHUNK_INDEX).nth(1).unwrap().1.start;
        bytes[index + 9 + 32 + 4] ^= 2;
        seal(&mut bytes, with_checksum);
        let recording = opened(&bytes).unwrap();
        let poses = recording.messages_of(&[0]).map(Result::unwrap).collect::<Vec<_>>();
        assert_eq!(numbers(&poses), (0..500).collect::<Vec<_>>());
        let told: Vec<_> = recording.damage().iter().map(ToString::to_string).collect();
        assert!(told.iter().any(|told| told.contains("lists other channels")), "{told:?}");
    }
    // Both indexes say the same, and the messages something else.
    let mut bytes = whole.clone();
    for (kind, at) in [(op::CHUNK_INDEX, 9 + 32 + 4), (op::MESSAGE_INDEX, 9)] {
        of_kind(kind).for_each(|(_, place)| bytes[place.start + at] ^= 2);
    }
    seal(&mut bytes, true);
    let recording = opened(&bytes).unwrap();
    let (mut count, mut told) = (0, Vec::new());
    for message in recording.stored_messages() {
        match message {
            Ok(_) => count += 1,
            Err(error) => told.push(error.to_string()),
        }
    }
    assert_eq!((count, told.len()), (500, 5), "{told:?}");
    assert!(told.iter().all(|told| told.contains("does not list for this chunk")), "{told:?}");
}

#[test]
fn large_chunks_that_overlap_in_time_are_merged_without_a_loss_in_little_memory() {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut writer = mcap::WriteOptions::new().compression(None).chunk_size(None).create(&mut bytes).unwrap();
    let poses = writer.add_channel(0, "/pose", "cdr", &Default::default()).unwrap();
    let images = writer.add_channel(0, "/image", "cdr", &Default::default()).unwrap();
    for chunk in 0..3 {
        for number in (chunk..900).step_by(3) {
            let mut put = |channel_id, data: &[u8]| {
                let time = log_time_ns(number);
                let header = mcap::records::MessageHeader {
                    channel_id,
                    sequence: 0,
                    log_time: time,
                    publish_time: time,
                };
                writer.write_to_known_channel(&header, data).unwrap();
            };
            put(poses, &encode(&pose(number)));
            put(images, &vec![number as u8; 80_000]);
        }
        writer.flush().unwrap();
    }
    writer.finish().unwrap();
    drop(writer);
    let recording = opened(bytes.get_ref()).unwrap();
    let place = |name: &str| recording.topics().iter().position(|found| found.topic.name == name).unwrap();
    let alone = recording.messages_of(&[place("/pose")]).map(Result::unwrap).collect::<Vec<_>>();
    assert_eq!(numbers(&alone), (0..900).collect::<Vec<_>>());
    let (image, mut all) = (place("/image"), recording.messages());
    let mut seen = Vec::new();
    while let Some(message) = all.next_ref() {
        let message = message.unwrap();
        let number = (message.log_time_ns - START_NS) / STEP_NS;
        let is_right = match message.topic == image {
            true => message.data == vec![number as u8; 80_000],
            false => message.data == encode(&pose(number)),
        };
        assert!(is_right, "{number}");
        seen.push((number, message.topic == image));
    }
    assert_eq!(seen, (0..900).flat_map(|number| [(number, false), (number, true)]).collect::<Vec<_>>());
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
/// Half a minute for a YAML parser. A QoS nobody can read is one that is not known.
#[test]
fn a_qos_of_brackets_takes_no_time() {
    let text = format!("- a: {}", "[".repeat(262_000));
    let qos = [b"offered_qos_profiles".as_slice(), text.as_bytes()]
        .map(|part| [&(part.len() as u32).to_le_bytes()[..], part].concat());
    let whole = file(LOOSE, 0..100, 1);
    let mut bytes = mcap::MAGIC.to_vec();
    for (kind, place) in
        records(&whole).into_iter().filter(|(kind, _)| *kind <= op::MESSAGE && *kind != op::FOOTER)
    {
        match kind {
            // Ends with the length of its metadata, of which there are none.
            op::CHANNEL => {
                let content = &whole[place.start + 9..place.end - 4];
                let size = (qos.concat().len() as u32).to_le_bytes();
                bytes.extend(record(kind, &[content, &size, &qos.concat()].concat()));
            }
            _ => bytes.extend(&whole[place]),
        }
    }
    let begun = std::time::Instant::now();
    let recording = opened(&bytes).unwrap();
    assert!(begun.elapsed().as_secs() < 10, "{:?}", begun.elapsed());
    assert!(recording.topics()[0].topic.offered_qos.is_empty());
    assert_eq!(numbers(&read(&recording).0), (0..100).collect::<Vec<_>>());
}

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

/// Of a file without chunks, types and channels are at its beginning, and again in the summary at its end.
#[test]
fn messages_outside_of_chunks_are_read_where_the_beginning_is_missing() {
    let whole = file(LOOSE, 0..1000, 1);
    let row: Vec<_> = records(&whole).into_iter().filter(|(kind, _)| *kind == op::MESSAGE).collect();
    // What is left at the front is nothing, the magic bytes, or these and the head of a record.
    for left in [0, 8, 30] {
        let mut bytes = whole.clone();
        bytes.drain(left..row[20].1.start + 5);
        let (found, damage, errors) = contents(&bytes);
        assert_eq!(found, (21..1000).collect::<Vec<_>>(), "{left}: {damage:?}");
        assert!(!damage.is_empty() && errors.is_empty(), "{left}: {damage:?} {errors:?}");
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

#[test]
fn any_length_of_a_message_in_a_row_costs_that_message_at_most() {
    for summary in [true, false] {
        let whole = file(Shape { summary, ..LOOSE }, 0..200, 200);
        let messages: Vec<_> = records(&whole)
            .into_iter()
            .filter(|(kind, _)| *kind == op::MESSAGE)
            .map(|(_, place)| place)
            .collect();
        for hit in [0, 1, 2, 135, 198, 199] {
            for (byte, value) in (1..9).flat_map(|byte| (0..=255).map(move |value| (byte, value))) {
                let mut bytes = whole.clone();
                bytes[messages[hit].start + byte] = value;
                let (found, ..) = read(&opened(&bytes).unwrap());
                let found: Vec<_> = found.iter().map(|message| message.sequence as usize).collect();
                for number in (0..200).filter(|number| *number != hit) {
                    assert!(
                        found.contains(&number),
                        "{number} is lost, {value} in byte {byte} of {hit}, {summary}"
                    );
                }
            }
        }
    }
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
