//! The compliance of the surface from finite elements, and the peers that multiply with it.

use faer::{Mat, Par};
use glam::{Mat3, Vec3};
use rayon::prelude::*;

use super::assembly::Nodes;
use super::element::Order;
use crate::compliance::{Compliance, Layout, NearMiddles};
use crate::product::{FullProduct, PatchColumns};
use crate::sparse_factor::SparseFactor;
use crate::{Job, Peer, SetupError};

/// Points whose unit forces are solved for at once.
const BLOCK: usize = 16;

/// The full product in every period.
pub(super) fn full(name: &'static str, job: &Job, order: Order) -> Result<Box<dyn Peer>, SetupError> {
    Ok(Box::new(FullProduct::new(name, job, surface_compliance(job, order, Layout::Rows)?)))
}

/// The columns of the touched points.
pub(super) fn patch(name: &'static str, job: &Job, order: Order) -> Result<Box<dyn Peer>, SetupError> {
    Ok(Box::new(PatchColumns::new(name, job, surface_compliance(job, order, Layout::Columns)?)))
}

/// Solves for unit forces on all points a disc can touch, blocks of them on all cores. The inverse of the stiffness is symmetric:
/// the answer to a force on a vertex is also that vertex's row.
fn surface_compliance(job: &Job, order: Order, layout: Layout) -> Result<Compliance, SetupError> {
    job.check()?;
    job.check_held()?;
    let free = job.fixed.iter().filter(|&&held| !held).count();
    // Second order has three middles for each vertex, about; counted when they are known.
    job.reserve(Compliance::bytes_for(free, free))?;
    let volume = job.tetrahedra()?;
    let nodes = Nodes::new(job, volume, order);
    let (points, unknowns) = nodes.contact_points(job);
    let dense = Compliance::bytes_for(free, points.len());
    job.reserve(dense)?;
    nodes.reserve(job, volume, 0)?;
    let mut near = NearMiddles::pairs(job, &points);
    let solving = (rayon::current_num_threads() * 2 * 3 * BLOCK * nodes.size() * size_of::<f64>()) as u64;
    let besides = (near.partners.len() * size_of::<Mat3>()) as u64 + solving;
    let factor = SparseFactor::new(nodes.size(), &nodes.assemble(volume, job.material), |factor_bytes| {
        nodes.reserve(job, volume, factor_bytes)?;
        job.reserve(dense + factor_bytes + besides)
    })?;
    let (vertices, middles) = unknowns.split_at(free);
    let mut numbers = vec![0.0f32; 9 * vertices.len() * unknowns.len()];
    let (length, taken) =
        if layout == Layout::Rows { (unknowns.len(), &unknowns[..]) } else { (free, vertices) };
    let block = 9 * length.max(1) * BLOCK;
    let (of_vertices, of_middles) = numbers.split_at_mut(9 * length * free);
    of_vertices.par_chunks_mut(block).zip(vertices.par_chunks(BLOCK)).for_each(|(lines, forced)| {
        copy(&unit_answers(&factor, nodes.size(), forced), taken, lines);
    });
    let mut of_middles: Vec<&mut [f32]> = of_middles.chunks_mut(block).collect();
    of_middles.resize_with(middles.len().div_ceil(BLOCK), Default::default);
    let blocks = of_middles.into_par_iter().zip(middles.par_chunks(BLOCK)).enumerate().map(
        |(number, (lines, forced))| {
            let answers = unit_answers(&factor, nodes.size(), forced);
            copy(&answers, taken, lines);
            let partners =
                near.starts[BLOCK * number..].windows(2).map(|ends| &near.partners[ends[0]..ends[1]]);
            let pairs = (0..forced.len())
                .zip(partners)
                .flat_map(|(own, others)| others.iter().map(move |&other| (own, other)));
            pairs
                .map(|(own, other)| block_of(&answers, middles[other as usize], 3 * own))
                .collect::<Vec<Mat3>>()
        },
    );
    near.blocks = blocks.collect::<Vec<_>>().concat();
    Ok(Compliance::new(points, layout, numbers, near))
}

/// Answers of all unknowns to unit forces on three unknowns after each of those given.
fn unit_answers(factor: &SparseFactor, size: usize, forced: &[usize]) -> Mat<f64> {
    let mut sides = Mat::<f64>::zeros(size, 3 * forced.len());
    for (point, &first) in forced.iter().enumerate() {
        for axis in 0..3 {
            sides[(first + axis, 3 * point + axis)] = 1.0;
        }
    }
    factor.solve(sides.as_mut(), Par::Seq);
    sides
}

/// Writes the answers of the points with the unknowns given, one line for each force; no line is asked for when there are none.
fn copy(answers: &Mat<f64>, unknowns: &[usize], lines: &mut [f32]) {
    for (line, answer) in lines.chunks_exact_mut(3 * unknowns.len().max(1)).zip(answers.col_iter()) {
        for (numbers, &first) in line.chunks_exact_mut(3).zip(unknowns) {
            for (axis, number) in numbers.iter_mut().enumerate() {
                *number = answer[first + axis] as f32;
            }
        }
    }
}

/// Answers of the three unknowns from `row` to the three forces from `column`.
fn block_of(answers: &Mat<f64>, row: usize, column: usize) -> Mat3 {
    let of = |j: usize| Vec3::from_array([0, 1, 2].map(|i| answers[(row + i, column + j)] as f32));
    Mat3::from_cols(of(0), of(1), of(2))
}
