//! From tetrahedra to one sparse stiffness matrix of the nodes that can move.

use std::collections::BTreeMap;

use faer::sparse::Triplet;
use glam::DVec3;

use super::element::{EDGES, Order, stiffness};
use crate::sparse_factor::Entry;
use crate::{Job, Material, SetupError, TetMesh};

/// Marks a node that is held.
const HELD: u32 = u32::MAX;

/// The nodes of a body of one order, and which of them can move.
pub(crate) struct Nodes {
    order: Order,
    /// Middle nodes by their edge (ends ascending), numbered after the corners.
    middles: BTreeMap<[u32; 2], u32>,
    /// For each node its number among those that can move, or [`HELD`]. Unknown `3 number + axis` is its displacement.
    place: Vec<u32>,
    moving: usize,
}

impl Nodes {
    /// Numbers the nodes. Held are the job's fixed vertices, and the middles of edges of faces with three fixed vertices.
    pub(crate) fn new(job: &Job, volume: &TetMesh, order: Order) -> Self {
        let mut middles = BTreeMap::new();
        if order == Order::Second {
            for tet in &volume.tets {
                for [a, b] in EDGES {
                    middles.insert(edge(tet[a], tet[b]), 0);
                }
            }
            for (number, middle) in (volume.nodes.len() as u32..).zip(middles.values_mut()) {
                *middle = number;
            }
        }
        let mut place = vec![0; volume.nodes.len() + middles.len()];
        for (node, _) in place.iter_mut().zip(job.fixed).filter(|&(_, &fixed)| fixed) {
            *node = HELD;
        }
        let held = |&&[a, b, c]: &&[u32; 3]| [a, b, c].iter().all(|&vertex| job.fixed[vertex as usize]);
        for &[a, b, c] in job.surface.triangles().iter().filter(held) {
            for ends in [edge(a, b), edge(b, c), edge(c, a)] {
                if let Some(&middle) = middles.get(&ends) {
                    place[middle as usize] = HELD;
                }
            }
        }
        let mut moving = 0;
        for node in place.iter_mut().filter(|node| **node != HELD) {
            *node = moving;
            moving += 1;
        }
        Self { order, middles, place, moving: moving as usize }
    }

    /// Number of unknowns, three for each node that can move.
    pub(crate) fn size(&self) -> usize {
        3 * self.moving
    }

    /// The first unknown of a node, if it can move.
    pub(crate) fn unknown(&self, node: u32) -> Option<usize> {
        self.place.get(node as usize).filter(|&&number| number != HELD).map(|&number| 3 * number as usize)
    }

    /// The node in the middle of an edge, of second order.
    pub(crate) fn middle(&self, a: u32, b: u32) -> Option<u32> {
        self.middles.get(&edge(a, b)).copied()
    }

    /// What the numbering takes, about.
    pub(crate) fn bytes(&self) -> u64 {
        (size_of_val(&self.place[..]) + self.middles.len() * size_of::<([u32; 2], u32)>()) as u64
    }

    /// The lower triangle of the stiffness matrix, N/m; entries at the same place add up.
    pub(crate) fn assemble(&self, volume: &TetMesh, material: Material) -> Vec<Entry> {
        let mut entries = Vec::with_capacity(self.entries(volume));
        let mut blocks = Vec::new();
        for tet in &volume.tets {
            let corners: [DVec3; 4] = tet.map(|node| volume.nodes[node as usize]);
            stiffness(self.order, corners, material, &mut blocks);
            let mut unknowns: Vec<Option<usize>> = tet.iter().map(|&node| self.unknown(node)).collect();
            if self.order == Order::Second {
                let middles = EDGES.map(|[a, b]| self.middle(tet[a], tet[b]));
                unknowns.extend(middles.map(|middle| middle.and_then(|node| self.unknown(node))));
            }
            let pairs = unknowns.iter().flat_map(|&row| unknowns.iter().map(move |&column| (row, column)));
            for (pair, block) in pairs.zip(&blocks) {
                let (Some(row), Some(column)) = pair else { continue };
                for j in 0..3 {
                    for i in 0..3 {
                        if row + i >= column + j {
                            entries.push(Triplet::new(
                                (row + i) as u32,
                                (column + j) as u32,
                                block.col(j)[i],
                            ));
                        }
                    }
                }
            }
        }
        entries
    }

    /// At most so many entries are assembled.
    fn entries(&self, volume: &TetMesh) -> usize {
        let nodes = if self.order == Order::First { 4 } else { 10 };
        volume.tets.len() * (3 * nodes) * (3 * nodes + 1) / 2
    }

    /// Refuses a body whose matrix would not fit, before it is assembled: its entries, and once more sorted.
    ///
    /// # Errors
    /// [`SetupError::DoesNotFit`].
    pub(crate) fn reserve(&self, job: &Job, volume: &TetMesh, besides_bytes: u64) -> Result<(), SetupError> {
        job.reserve(besides_bytes + 2 * (self.entries(volume) * size_of::<Entry>()) as u64)
    }
}

fn edge(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
