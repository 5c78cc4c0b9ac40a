//! CDR: what is encoded comes back, known bytes are read, and no bytes at all do harm.
#![allow(clippy::unwrap_used, reason = "helpers of tests, which may panic")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use proptest::collection::vec;
use proptest::prelude::*;
use recording::cdr::{Fault, Message, decode, decode_with_rest, encode};
use recording::messages::*;

/// Counts the bytes a thread asks for, so that a test can say how much decoding took.
struct Counting;

thread_local! {
    static ALLOCATED: Cell<usize> = const { Cell::new(0) };
}

#[expect(unsafe_code, reason = "an allocator that counts; every call goes to the system's unchanged")]
// SAFETY: the memory is the system allocator's, with the layout the caller gave; counting touches a plain cell.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // A thread that is ending has no counter any more, and no test in it either.
        let _ = ALLOCATED.try_with(|bytes| bytes.set(bytes.get() + layout.size()));
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: `pointer` came from `System.alloc` with this layout.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// Calls `check` for every message type of the crate.
macro_rules! for_every_type {
    ($check:ident, $($argument:expr),*) => {
        $check::<Time>($($argument),*);
        $check::<Header>($($argument),*);
        $check::<PoseStamped>($($argument),*);
        $check::<WrenchStamped>($($argument),*);
        $check::<Bool>($($argument),*);
        $check::<Joy>($($argument),*);
        $check::<JointState>($($argument),*);
        $check::<ContactState>($($argument),*);
        $check::<SurfaceDisplacement>($($argument),*);
    };
}

fn header() -> impl Strategy<Value = Header> {
    (any::<i32>(), any::<u32>(), ".{0,12}")
        .prop_map(|(sec, nanosec, frame_id)| Header { stamp: Time { sec, nanosec }, frame_id })
}

fn point() -> impl Strategy<Value = Point> {
    [any::<f64>(), any::<f64>(), any::<f64>()].prop_map(|[x, y, z]| Point { x, y, z })
}

fn vector() -> impl Strategy<Value = Vector3> {
    point().prop_map(|Point { x, y, z }| Vector3 { x, y, z })
}

fn pose_stamped() -> impl Strategy<Value = PoseStamped> {
    (header(), point(), point(), any::<f64>()).prop_map(|(header, position, Point { x, y, z }, w)| {
        PoseStamped { header, pose: Pose { position, orientation: Quaternion { x, y, z, w } } }
    })
}

fn contact_state() -> impl Strategy<Value = ContactState> {
    let flags = (any::<u8>(), any::<bool>(), any::<bool>(), any::<u32>());
    let places = (point(), point(), vector(), [any::<f64>(), any::<f64>(), any::<f64>()]);
    (header(), flags, places).prop_map(
        |(header, (mode, saturated, clutched, face), (probe, proxy, normal, barycentric))| {
            let [depth, force, stiffness] = barycentric;
            ContactState {
                header,
                mode,
                saturated,
                clutched,
                face,
                barycentric,
                probe,
                proxy,
                normal,
                depth,
                force,
                stiffness,
            }
        },
    )
}

fn round_trips<M: Message + PartialEq + std::fmt::Debug>(message: &M) {
    let bytes = encode(message);
    assert_eq!(&decode::<M>(&bytes).unwrap(), message);
    for length in 0..bytes.len() {
        assert!(decode::<M>(&bytes[..length]).is_err(), "{length} of {} bytes were accepted", bytes.len());
    }
}

/// Decodes `bytes` and asks that it takes memory in proportion to them, whatever they say.
fn does_no_harm<M: Message>(bytes: &[u8]) {
    let before = ALLOCATED.get();
    let _ = decode::<M>(bytes);
    let allocated = ALLOCATED.get() - before;
    // A text of one byte (five in CDR) takes 24 bytes as a Rust string, and vectors grow by doubling.
    assert!(allocated <= 16 * bytes.len() + 256, "{}: {allocated} bytes for {}", M::TYPE_NAME, bytes.len());
}

proptest! {
    #[test]
    fn encoded_messages_come_back_and_any_cut_is_an_error(
        pose in pose_stamped(), state in contact_state(), torque in vector(), force in vector(), header in header(),
        axes in vec(any::<f32>(), 0..5), buttons in vec(any::<i32>(), 0..5), names in vec(".{0,8}", 0..4),
        numbers in vec(any::<f64>(), 0..6), vertex in vec(any::<u32>(), 0..9), data in any::<bool>(),
    ) {
        round_trips(&pose);
        round_trips(&state);
        round_trips(&WrenchStamped { header: header.clone(), wrench: Wrench { force, torque } });
        round_trips(&Bool { data });
        round_trips(&Joy { header: header.clone(), axes: axes.clone(), buttons });
        round_trips(&JointState {
            header: header.clone(), name: names, position: numbers.clone(), velocity: numbers.clone(), effort: numbers,
        });
        round_trips(&SurfaceDisplacement { header, topology_version: 7, vertex, displacement: axes });
    }

    #[test]
    fn any_bytes_give_a_value_or_an_error_within_their_own_memory(bytes in vec(any::<u8>(), 0..300), big in any::<bool>()) {
        let framed: Vec<u8> = [0, u8::from(!big), 0, 0].into_iter().chain(bytes.iter().copied()).collect();
        for_every_type!(does_no_harm, &bytes);
        for_every_type!(does_no_harm, &framed);
    }

    #[test]
    fn a_flipped_bit_anywhere_does_no_harm(state in contact_state(), at in any::<prop::sample::Index>(), bit in 0..8_u32) {
        let mut bytes = encode(&state);
        let at = at.index(bytes.len());
        bytes[at] ^= 1_u8 << bit;
        does_no_harm::<ContactState>(&bytes);
    }
}

/// `std_msgs/Header` of stamp 1.5 s and frame "ab", as rclpy serializes it.
const HEADER_LITTLE: [u8; 19] = [0, 1, 0, 0, 1, 0, 0, 0, 0, 0x65, 0xcd, 0x1d, 3, 0, 0, 0, b'a', b'b', 0];
const HEADER_BIG: [u8; 19] = [0, 0, 0, 0, 0, 0, 0, 1, 0x1d, 0xcd, 0x65, 0, 0, 0, 0, 3, b'a', b'b', 0];

#[test]
fn known_bytes_are_read_in_both_byte_orders_and_written_little_endian() {
    let header = Header { stamp: Time { sec: 1, nanosec: 500_000_000 }, frame_id: "ab".to_owned() };
    assert_eq!(decode::<Header>(&HEADER_LITTLE).unwrap(), header);
    assert_eq!(decode::<Header>(&HEADER_BIG).unwrap(), header);
    assert_eq!(encode(&header), HEADER_LITTLE);
}

#[test]
fn a_count_beyond_the_bytes_is_refused_before_anything_is_allocated() {
    let mut bytes = encode(&SurfaceDisplacement::default());
    let count_at = bytes.len() - 8;
    bytes[count_at..count_at + 4].copy_from_slice(&u32::MAX.to_le_bytes());
    let before = ALLOCATED.get();
    let error = decode::<SurfaceDisplacement>(&bytes).unwrap_err();
    assert!(ALLOCATED.get() - before < 64);
    assert_eq!(error.what, Fault::Count { count: u32::MAX, left: 4 });
    assert!(error.to_string().contains("rhombus_haptics_msgs/msg/SurfaceDisplacement"), "{error}");
}

#[test]
fn a_shorter_message_another_encoding_and_broken_values_are_refused() {
    assert!(matches!(
        decode::<PoseStamped>(&encode(&Header::default())).unwrap_err().what,
        Fault::Truncated { .. }
    ));
    assert_eq!(decode::<Bool>(&[0, 1, 0, 0, 2]).unwrap_err().what, Fault::Bool(2));
    assert!(matches!(decode::<Bool>(&[0, 6, 0, 0, 1]).unwrap_err().what, Fault::Header(_)));
    assert!(matches!(decode::<Bool>(&[]).unwrap_err().what, Fault::Header(_)));
    let mut no_zero = HEADER_LITTLE;
    no_zero[18] = b'c';
    assert_eq!(decode::<Header>(&no_zero).unwrap_err().what, Fault::Text);
    let mut no_utf8 = HEADER_LITTLE;
    no_utf8[16] = 0xff;
    assert_eq!(decode::<Header>(&no_utf8).unwrap_err().what, Fault::Text);
}

#[test]
fn padding_to_a_multiple_of_four_is_part_of_a_message() {
    let mut bytes = encode(&Bool { data: true });
    bytes.extend([0, 0, 0]);
    assert_eq!(decode_with_rest::<Bool>(&bytes).unwrap(), (Bool { data: true }, 0));
}

/// rmw_fastrtps, asked to serialize without sending, returns the size it estimated, with anything at the end.
#[test]
fn bytes_behind_the_last_field_are_counted_and_change_nothing() {
    let joints = JointState { position: vec![0.1], ..JointState::default() };
    let pose = PoseStamped::default();
    for count in [4, 8, 64] {
        let behind = vec![0xa5; count];
        let bytes = [encode(&joints), behind.clone()].concat();
        assert_eq!(decode_with_rest::<JointState>(&bytes).unwrap(), (joints.clone(), count));
        assert_eq!(decode::<PoseStamped>(&[encode(&pose), behind].concat()).unwrap(), pose);
    }
}
