//! Body modes: `sum_j z_j Phi_j` at the vertices of a block.

use glam::Vec4;

use super::Response;
use super::lanes::{Axes, HALVES, in_blocks};

/// The modes in the order in which they are read: for each block of vertices all modes.
#[derive(Clone, Debug)]
pub(crate) struct Modes {
    count: usize,
    fields: Vec<[Axes; HALVES]>,
}

impl Modes {
    pub(crate) fn new(response: &Response) -> Self {
        let parts = response.parts();
        let count = parts.modes;
        let by_mode: Vec<_> = parts
            .mode_fields
            .chunks_exact(3 * response.vertices.max(1))
            .map(|field| in_blocks(field.as_chunks::<3>().0.iter().copied()))
            .collect();
        let blocks = by_mode.first().map_or(0, Vec::len);
        let fields = (0..blocks).flat_map(|block| by_mode.iter().map(move |mode| mode[block])).collect();
        Self { count, fields }
    }

    /// What the modes add to each block.
    #[inline(always)]
    pub(crate) fn at(&self, block: usize, amplitudes: &[f32]) -> [Axes; HALVES] {
        let mut sums = [Axes::default(); HALVES];
        let begin = block * self.count;
        let fields = self.fields.get(begin..begin + self.count).unwrap_or_default();
        for (field, z) in fields.iter().zip(amplitudes) {
            let z = Vec4::splat(*z);
            for half in 0..HALVES {
                for axis in 0..3 {
                    sums[half][axis] += field[half][axis] * z;
                }
            }
        }
        sums
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        size_of_val(self.fields.as_slice())
    }
}
