//! What all chains together do at a distance from the contact, from a table that is filled for each contact.
//!
//! The distance decides every shape `g_p` and every ramp `w_p`, so the sums over the chains are functions of the distance
//! alone. There are fewer nodes than vertices, and a vertex looks up one row, whatever the number of chains.

use glam::Vec4;

use crate::contact_shape::ContactShape;

use super::grid::Grid;
use super::{MOST_CHAINS, MOST_HARMONICS};

/// Waves around the contact: 1, cos, sin, cos 2 phi, sin 2 phi.
pub(crate) const MOST_WAVES: usize = 1 + 2 * MOST_HARMONICS;

/// Sums over the chains at one distance. For the constant: `sum g_p a_p0`, 0, 0, `sum g_p w_p c_p0`; for each wave:
/// `sum g_p w_p` times its coefficients along the normal, away and around, and 0.
pub(crate) type Row = [Vec4; MOST_WAVES];

/// The tables.
#[derive(Clone, Debug)]
pub(crate) struct Profiles {
    pub(crate) grid: Grid,
    chains: usize,
    /// `1 - q^(s/h)` and `w` at `s + r_c`, for each node and chain.
    drops: Vec<[f32; 2]>,
    rows: Vec<Row>,
}

/// One chain at the present contact: `1 / (1 - q^m)`, and its coefficients as a row has them.
#[derive(Clone, Copy, Default)]
struct ChainHere {
    scale: f32,
    rows: Row,
}

impl Profiles {
    /// For the chains of `shape` and arcs up to `longest_arc_m`.
    pub(crate) fn new(shape: &ContactShape, longest_arc_m: f64) -> Self {
        let chains = shape.chains().min(MOST_CHAINS);
        let grid = Grid::new(shape.finest_m(), shape.longest_chain_m().min(longest_arc_m));
        let mut drops = Vec::with_capacity(grid.nodes() * chains);
        for node in 0..grid.nodes() {
            let s_m = grid.distance_m(node);
            drops.extend((0..chains).map(|chain| {
                let ramp = (s_m + shape.contact_radius_m()) * shape.ramp_per_m(chain);
                [shape.drop(chain, s_m) as f32, ramp.min(1.0) as f32]
            }));
        }
        Self { grid, chains, drops, rows: vec![Row::default(); grid.nodes()] }
    }

    /// Fills the rows for a contact with the depth of `shape` and `coefficients`, P x (2 + 6 H). Real-time safe.
    #[inline(always)]
    pub(crate) fn fill<const WAVES: usize>(&mut self, shape: &ContactShape, coefficients: &[f32]) {
        let mut chains = [ChainHere::default(); MOST_CHAINS];
        let per_chain = 3 * WAVES - 1;
        for (chain, (here, numbers)) in
            chains.iter_mut().zip(coefficients.chunks_exact(per_chain)).enumerate()
        {
            let number = |place: usize| numbers.get(place).copied().unwrap_or_default();
            here.scale = shape.drop_scale(chain) as f32;
            here.rows[0] = Vec4::new(number(0), 0.0, 0.0, number(WAVES));
            for k in 1..WAVES {
                here.rows[k] = Vec4::new(number(k), number(WAVES + k), number(2 * WAVES + k - 1), 0.0);
            }
        }
        for (row, drops) in self.rows.iter_mut().zip(self.drops.chunks_exact(self.chains)) {
            let mut sums = [Vec4::ZERO; WAVES];
            for (here, [drop, ramp]) in chains.iter().zip(drops) {
                let g = (1.0 - drop * here.scale).max(0.0);
                if g > 0.0 {
                    let directed = Vec4::splat(g * ramp);
                    let mut by = [directed; WAVES];
                    // Past the ramps, which end near the contact, all is multiplied by the same.
                    if *ramp < 1.0 {
                        by[0] = Vec4::new(g, g, g, g * ramp);
                    }
                    for ((sum, row), by) in sums.iter_mut().zip(&here.rows).zip(by) {
                        *sum += *row * by;
                    }
                }
            }
            row[..WAVES].copy_from_slice(&sums);
        }
        // The contact moves by exactly DL, whatever the last digit of the shares' sum.
        if let Some(contact) = self.rows.first_mut() {
            contact[0].x = 1.0;
        }
    }

    /// Sum of a row, `part` of the way from `node` to the next, times 1 and the other `waves`.
    #[inline(always)]
    pub(crate) fn at<const WAVES: usize>(&self, node: u32, part: f32, waves: [f32; MOST_WAVES - 1]) -> Vec4 {
        let [low, high, ..] = &self.rows[node as usize..] else { return Vec4::ZERO };
        let (mut before, mut after) = (low[0], high[0]);
        for k in 1..WAVES {
            before += low[k] * waves[k - 1];
            after += high[k] * waves[k - 1];
        }
        before + (after - before) * part
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        size_of_val(self.drops.as_slice()) + size_of_val(self.rows.as_slice())
    }
}
