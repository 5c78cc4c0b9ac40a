//! CDR, the encoding of ROS 2 messages on the wire and in recordings.
//!
//! Written is XCDR1 little-endian with its four-byte header (`00 01 00 00`), which is what every ROS 2 middleware
//! writes; big-endian is read too. Values sit at multiples of their size, counted from behind the header.
//! Reading trusts nothing: any bytes give a value or an error, never a panic, and a length field can make it allocate
//! no more than the bytes behind it can fill. Bytes behind the last field are left out, as every reader of ROS 2 does:
//! rmw_fastrtps, asked to serialize without sending, returns the size it estimated. That a message is of another type is
//! told by the definition in the recording.

use std::fmt;

/// Plain CDR, little-endian. The last two bytes are options nobody uses.
const HEADER: [u8; 4] = [0x00, 0x01, 0x00, 0x00];
/// RTPS pads a message to a multiple of four, and some middlewares hand that padding on.
const PADDING_BYTES: usize = 3;

/// A message type of ROS 2: its name and its fields in order.
pub trait Message: Wire {
    /// Such as `geometry_msgs/msg/PoseStamped`.
    const TYPE_NAME: &'static str;
}

/// Something CDR can carry: a primitive, a string, an array, a sequence or a struct of them.
pub trait Wire: Sized {
    /// Fewest bytes a value takes, without alignment.
    const MIN_BYTES: usize;
    /// Appends the value.
    fn put(&self, encoder: &mut Encoder);
    /// Reads a value.
    ///
    /// # Errors
    /// When the bytes end early or cannot be such a value.
    fn take(decoder: &mut Decoder<'_>) -> Result<Self, Fault>;
    /// What the type looks like in a message definition.
    fn shape() -> Shape;
}

/// A type as message definitions name it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Shape {
    /// A number, `bool` or `string`, by its name in a `.msg` file.
    Primitive(&'static str),
    /// Any number of elements.
    Sequence(Box<Shape>),
    /// A fixed number of elements.
    Array(Box<Shape>, usize),
    /// Another message.
    Message {
        /// Such as `std_msgs/msg/Header`.
        type_name: &'static str,
        /// Name and type of each field, in order.
        fields: Vec<(&'static str, Shape)>,
    },
}

/// The bytes of `message`, header included.
pub fn encode<M: Message>(message: &M) -> Vec<u8> {
    let mut encoder = Encoder { bytes: HEADER.to_vec() };
    message.put(&mut encoder);
    encoder.bytes
}

/// The message in `bytes`, header included. What is behind its last field is left out.
///
/// # Errors
/// When the bytes end early or cannot be this type. Which field was at fault follows from the byte position.
pub fn decode<M: Message>(bytes: &[u8]) -> Result<M, CdrError> {
    decode_with_rest(bytes).map(|(message, _)| message)
}

/// As [`decode`], and how many bytes are behind the last field. Padding to a multiple of four does not count.
///
/// # Errors
/// As [`decode`].
pub fn decode_with_rest<M: Message>(bytes: &[u8]) -> Result<(M, usize), CdrError> {
    let error = |at, what| CdrError { type_name: M::TYPE_NAME, at, what };
    let mut decoder = Decoder::new(bytes).map_err(|fault| error(0, fault))?;
    let message = M::take(&mut decoder).map_err(|fault| error(decoder.at + HEADER.len(), fault))?;
    let left = decoder.left();
    Ok((message, if left > PADDING_BYTES { left } else { 0 }))
}

/// Bytes that are not the message they should be.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("not a {type_name}: byte {at}: {what}")]
pub struct CdrError {
    /// The type that was asked for.
    pub type_name: &'static str,
    /// Position in the message, header included.
    pub at: usize,
    /// What is wrong there.
    pub what: Fault,
}

/// What is wrong with the bytes.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// Header of another encoding (XCDR2, parameter lists) or none at all.
    #[error("the header {0:02x?} is not plain CDR (00 00 or 00 01, and two bytes)")]
    Header(Vec<u8>),
    /// The message ends inside a value.
    #[error("{needed} bytes are needed and {left} are left")]
    Truncated {
        /// Bytes of the value.
        needed: usize,
        /// Bytes there are.
        left: usize,
    },
    /// More elements than the remaining bytes can hold.
    #[error("{count} elements do not fit in the {left} bytes that are left")]
    Count {
        /// Announced elements.
        count: u32,
        /// Bytes there are.
        left: usize,
    },
    /// Neither 0 nor 1.
    #[error("{0} is not a boolean (0 or 1)")]
    Bool(u8),
    /// Not UTF-8, or without the zero at the end.
    #[error("not a text in UTF-8 that ends with a zero")]
    Text,
}

/// Collects the bytes of a message.
pub struct Encoder {
    bytes: Vec<u8>,
}

impl Encoder {
    fn align(&mut self, size: usize) {
        let position = self.bytes.len() - HEADER.len();
        self.bytes.resize(HEADER.len() + position.next_multiple_of(size), 0);
    }

    /// Lengths are 32 bits in CDR; a message of more than 4 GiB cannot be said in it.
    fn put_length(&mut self, length: usize) {
        u32::try_from(length).unwrap_or(u32::MAX).put(self);
    }
}

/// Walks through the bytes of a message.
pub struct Decoder<'a> {
    /// Behind the header.
    body: &'a [u8],
    at: usize,
    big_endian: bool,
}

impl<'a> Decoder<'a> {
    fn new(bytes: &'a [u8]) -> Result<Self, Fault> {
        match bytes {
            [0x00, order @ (0 | 1), _, _, body @ ..] => Ok(Self { body, at: 0, big_endian: *order == 0 }),
            _ => Err(Fault::Header(bytes.iter().take(HEADER.len()).copied().collect())),
        }
    }

    fn left(&self) -> usize {
        self.body.len().saturating_sub(self.at)
    }

    fn bytes(&mut self, needed: usize) -> Result<&'a [u8], Fault> {
        let rest = self.body.get(self.at..).unwrap_or_default();
        let taken = rest.get(..needed).ok_or(Fault::Truncated { needed, left: rest.len() })?;
        self.at += needed;
        Ok(taken)
    }

    fn aligned<const N: usize>(&mut self) -> Result<[u8; N], Fault> {
        self.at = self.at.next_multiple_of(N);
        let left = self.left();
        self.bytes(N)?.first_chunk().copied().ok_or(Fault::Truncated { needed: N, left })
    }

    /// Reads a count of elements and checks that they can be there before anything is allocated for them.
    fn count(&mut self, bytes_each: usize) -> Result<usize, Fault> {
        let count = u32::take(self)?;
        let left = self.left();
        if (count as usize).saturating_mul(bytes_each) > left {
            return Err(Fault::Count { count, left });
        }
        Ok(count as usize)
    }
}

macro_rules! number {
    ($($type:ty = $name:literal),+) => {$(
        impl Wire for $type {
            const MIN_BYTES: usize = size_of::<$type>();
            fn put(&self, encoder: &mut Encoder) {
                encoder.align(Self::MIN_BYTES);
                encoder.bytes.extend_from_slice(&self.to_le_bytes());
            }
            fn take(decoder: &mut Decoder<'_>) -> Result<Self, Fault> {
                let bytes = decoder.aligned()?;
                Ok(if decoder.big_endian { Self::from_be_bytes(bytes) } else { Self::from_le_bytes(bytes) })
            }
            fn shape() -> Shape {
                Shape::Primitive($name)
            }
        }
    )+};
}
number!(u8 = "uint8", i32 = "int32", u32 = "uint32", u64 = "uint64", f32 = "float32", f64 = "float64");

impl Wire for bool {
    const MIN_BYTES: usize = 1;
    fn put(&self, encoder: &mut Encoder) {
        u8::from(*self).put(encoder);
    }
    fn take(decoder: &mut Decoder<'_>) -> Result<Self, Fault> {
        match u8::take(decoder)? {
            0 => Ok(false),
            1 => Ok(true),
            other => Err(Fault::Bool(other)),
        }
    }
    fn shape() -> Shape {
        Shape::Primitive("bool")
    }
}

impl Wire for String {
    const MIN_BYTES: usize = 4;
    fn put(&self, encoder: &mut Encoder) {
        encoder.put_length(self.len() + 1);
        encoder.bytes.extend_from_slice(self.as_bytes());
        encoder.bytes.push(0);
    }
    /// A length of 0 is the empty text: some middlewares leave its zero out.
    fn take(decoder: &mut Decoder<'_>) -> Result<Self, Fault> {
        let length = decoder.count(1)?;
        match decoder.bytes(length)? {
            [] => Ok(Self::new()),
            [text @ .., 0] => std::str::from_utf8(text).map(str::to_owned).map_err(|_| Fault::Text),
            _ => Err(Fault::Text),
        }
    }
    fn shape() -> Shape {
        Shape::Primitive("string")
    }
}

impl<T: Wire> Wire for Vec<T> {
    const MIN_BYTES: usize = 4;
    fn put(&self, encoder: &mut Encoder) {
        encoder.put_length(self.len());
        self.iter().for_each(|element| element.put(encoder));
    }
    fn take(decoder: &mut Decoder<'_>) -> Result<Self, Fault> {
        let count = decoder.count(T::MIN_BYTES)?;
        (0..count).map(|_| T::take(decoder)).collect()
    }
    fn shape() -> Shape {
        Shape::Sequence(Box::new(T::shape()))
    }
}

impl<T: Wire + Copy + Default, const N: usize> Wire for [T; N] {
    const MIN_BYTES: usize = N * T::MIN_BYTES;
    fn put(&self, encoder: &mut Encoder) {
        self.iter().for_each(|element| element.put(encoder));
    }
    fn take(decoder: &mut Decoder<'_>) -> Result<Self, Fault> {
        let mut array = [T::default(); N];
        for element in &mut array {
            *element = T::take(decoder)?;
        }
        Ok(array)
    }
    fn shape() -> Shape {
        Shape::Array(Box::new(T::shape()), N)
    }
}

impl fmt::Debug for Decoder<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "Decoder at {} of {}", self.at, self.body.len())
    }
}
