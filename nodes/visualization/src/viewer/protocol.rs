//! What goes over the WebSocket, as bytes and texts; `PROTOCOL.md` beside the crate says what they mean.

mod asked;
mod mesh;
mod state;
mod surface;
mod texts;

pub(crate) use asked::{Asked, MAX_FRAME};
pub(crate) use mesh::mesh;
pub(crate) use state::{ContactState, DeviceState, Force, at_page, state};
pub(crate) use surface::surface;
pub(crate) use texts::{
    DeviceHealth, Hello, NodeHealth, ShownParameter, chains, hello, parameter_result, parameters, pointer,
    pong, refused, status,
};

/// Number of the protocol, said in the first message.
pub(crate) const VERSION: u32 = 1;

/// What a binary message is; its first byte.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Mesh = 1,
    Surface = 2,
    State = 3,
}

/// Bytes in front of every binary message.
const HEADER_BYTES: usize = 8;

/// A message of this kind with its header and room for `bytes` more.
fn message(kind: Kind, sequence: u32, bytes: usize) -> Vec<u8> {
    let mut message = Vec::with_capacity(HEADER_BYTES + bytes);
    message.extend_from_slice(&[kind as u8, 0, 0, 0]);
    message.extend_from_slice(&sequence.to_le_bytes());
    message
}

fn put_u32(message: &mut Vec<u8>, number: u32) {
    message.extend_from_slice(&number.to_le_bytes());
}

fn put_f64(message: &mut Vec<u8>, number: f64) {
    message.extend_from_slice(&number.to_le_bytes());
}

/// In single precision, as everything that is drawn.
fn put_f32(message: &mut Vec<u8>, number: f64) {
    message.extend_from_slice(&(number as f32).to_le_bytes());
}

fn put_vector(message: &mut Vec<u8>, vector: glam::DVec3) {
    vector.to_array().into_iter().for_each(|number| put_f32(message, number));
}
