//! Vertices side by side: the compiler works on four at once. Each is worked out by itself, so the bits do not depend on how
//! many that are, nor on the CPU.

use glam::{DVec3, Vec4};

/// Vertices of a block.
pub(crate) const BLOCK: usize = 8;
/// Vertices in one [`Vec4`].
pub(crate) const LANES: usize = 4;
/// The bits of all lanes.
pub(crate) const ALL: u32 = (1 << LANES) - 1;
/// Halves of a block.
pub(crate) const HALVES: usize = BLOCK / LANES;

/// x, y and z of four vertices.
pub(crate) type Axes = [Vec4; 3];

/// The vectors of all vertices, block by block; what is left of the last block is zero.
pub(crate) fn in_blocks(vectors: impl ExactSizeIterator<Item = [f32; 3]>) -> Vec<[Axes; HALVES]> {
    let mut blocks = vec![[Axes::default(); HALVES]; vectors.len().div_ceil(BLOCK)];
    for (vertex, vector) in vectors.enumerate() {
        let axes = &mut blocks[vertex / BLOCK][vertex % BLOCK / LANES];
        for (axis, value) in axes.iter_mut().zip(vector) {
            axis[vertex % LANES] = value;
        }
    }
    blocks
}

/// The same vector for four vertices.
pub(crate) fn splat(vector: DVec3) -> Axes {
    vector.as_vec3().to_array().map(Vec4::splat)
}

#[inline(always)]
pub(crate) fn dot(a: &Axes, b: &Axes) -> Vec4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
