//! The compliance of the surface from finite elements, and the peers that multiply with it.

use faer::{Mat, Par};
use rayon::prelude::*;

use super::assembly::Nodes;
use super::element::Order;
use crate::compliance::{Compliance, Layout};
use crate::product::{FullProduct, PatchColumns};
use crate::sparse_factor::SparseFactor;
use crate::{Job, Peer, SetupError};

/// Unit forces solved for at once.
const BLOCK: usize = 48;

/// The full product in every period.
pub(super) fn full(name: &'static str, job: &Job, order: Order) -> Result<Box<dyn Peer>, SetupError> {
    Ok(Box::new(FullProduct::new(name, job, surface_compliance(job, order, Layout::Rows)?)))
}

/// The columns of the touched vertices.
pub(super) fn patch(name: &'static str, job: &Job, order: Order) -> Result<Box<dyn Peer>, SetupError> {
    Ok(Box::new(PatchColumns::new(name, job, surface_compliance(job, order, Layout::Columns)?)))
}

/// Solves for a unit force on every free unknown of the surface, blocks of them on all cores. The matrix is symmetric, so
/// either layout is the same numbers.
fn surface_compliance(job: &Job, order: Order, layout: Layout) -> Result<Compliance, SetupError> {
    job.check()?;
    let free = Compliance::free_vertices(job.fixed);
    let dense = Compliance::bytes_for(free.len());
    job.reserve(dense)?;
    let volume = job.tetrahedra()?;
    let nodes = Nodes::new(job, volume, order);
    nodes.reserve(job, volume, 0)?;
    let blocks_bytes = (rayon::current_num_threads() * 2 * BLOCK * nodes.size() * size_of::<f64>()) as u64;
    let factor = SparseFactor::new(nodes.size(), &nodes.assemble(volume, job.material), |factor_bytes| {
        nodes.reserve(job, volume, factor_bytes)?;
        job.reserve(dense + factor_bytes + blocks_bytes)
    })?;
    let unknowns: Vec<usize> =
        free.iter().filter_map(|&vertex| nodes.unknown(vertex)).flat_map(|first| first..first + 3).collect();
    let mut numbers = vec![0.0f32; unknowns.len().pow(2)];
    numbers.par_chunks_mut(BLOCK * unknowns.len().max(1)).zip(unknowns.par_chunks(BLOCK)).for_each(
        |(lines, forced)| {
            let mut sides = Mat::<f64>::zeros(nodes.size(), forced.len());
            for (column, &unknown) in forced.iter().enumerate() {
                sides[(unknown, column)] = 1.0;
            }
            factor.solve(sides.as_mut(), Par::Seq);
            for (line, column) in lines.chunks_exact_mut(unknowns.len()).zip(sides.col_iter()) {
                for (number, &unknown) in line.iter_mut().zip(&unknowns) {
                    *number = column[unknown] as f32;
                }
            }
        },
    );
    Ok(Compliance::new(job.fixed, layout, numbers))
}
