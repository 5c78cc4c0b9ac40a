//! From tetrahedra to one sparse stiffness matrix of the nodes that can move.

use std::collections::BTreeMap;

use faer::sparse::Triplet;
use glam::DVec3;

use super::element::{EDGES, Order, stiffness};
use crate::contact::ContactPoints;
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

    /// The first unknown of the node in the middle of an edge, if it has one that can move.
    fn middle(&self, a: u32, b: u32) -> Option<usize> {
        self.middles.get(&edge(a, b)).and_then(|&node| self.unknown(node))
    }

    /// The points a disc can touch: all nodes on the surface that can move. And the first unknown of each.
    pub(crate) fn contact_points(&self, job: &Job) -> (ContactPoints, Vec<usize>) {
        let sides = job.surface.triangles().iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let free = sides.filter(|&[a, b]| a < b && self.middle(a, b).is_some());
        let points = ContactPoints::new(job.fixed, free);
        let vertices = points.vertices().iter().filter_map(|&vertex| self.unknown(vertex));
        let middles = points.edges().filter_map(|[a, b]| self.middle(a, b));
        let unknowns = vertices.chain(middles).collect();
        (points, unknowns)
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
                unknowns.extend(EDGES.map(|[a, b]| self.middle(tet[a], tet[b])));
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

#[cfg(test)]
mod tests {
    use super::{Nodes, Order};
    use crate::{Job, Material, TetMesh};
    use glam::{DMat3, DVec3};

    const MATERIAL: Material = Material { young_pa: 3.0, poisson: 0.3 };

    /// A block of distorted cells; stored energy, and the largest force on an inner node, for a displacement of all nodes.
    fn energy_and_inner_force(order: Order, displacement: impl Fn(DVec3) -> DVec3) -> (f64, f64) {
        let side = [-0.5, -0.2, 0.1, 0.5];
        let (surface, mut volume) = TetMesh::block(&side, &side, &side);
        for at in &mut volume.nodes[surface.vertices().len()..] {
            *at += DVec3::new(0.03, -0.02, 0.04) * (2.0 * at.x + at.y) * (1.0 - at.z);
        }
        let free = vec![false; volume.surface_vertices];
        let job = Job {
            surface: &surface,
            volume: Some(&volume),
            fixed: &free,
            material: MATERIAL,
            contact_radius_m: 0.0,
            memory_limit_bytes: u64::MAX,
        };
        let nodes = Nodes::new(&job, &volume, order);
        let mut u = vec![0.0; nodes.size()];
        let mut inner = vec![true; nodes.size()];
        let ends = |[a, b]: [u32; 2]| (volume.nodes[a as usize] + volume.nodes[b as usize]) * 0.5;
        let middles = nodes.middles.iter().map(|(&edge, &node)| (node, ends(edge)));
        for (node, at) in (0u32..).zip(volume.nodes.iter().copied()).chain(middles) {
            let first = nodes.unknown(node).unwrap();
            u[first..first + 3].copy_from_slice(&displacement(at).to_array());
            inner[first..first + 3].fill(at.abs().max_element() < 0.5 - 1e-9);
        }
        let mut force = vec![0.0; u.len()];
        for entry in nodes.assemble(&volume, MATERIAL) {
            let (row, column) = (entry.row as usize, entry.col as usize);
            force[row] += entry.val * u[column];
            if row != column {
                force[column] += entry.val * u[row];
            }
        }
        let energy = 0.5 * force.iter().zip(&u).map(|(force, u)| force * u).sum::<f64>();
        let largest = force.iter().zip(inner).filter(|&(_, inner)| inner).map(|(force, _)| force.abs());
        (energy, largest.fold(0.0, f64::max))
    }

    #[test]
    fn a_uniform_strain_stores_its_energy_exactly_and_leaves_inner_nodes_at_rest() {
        let strain = DMat3::from_cols_array(&[0.3, 0.1, -0.2, 0.1, -0.4, 0.05, -0.2, 0.05, 0.2]);
        let (lambda, mu) = MATERIAL.lame_pa();
        let trace = strain.x_axis.x + strain.y_axis.y + strain.z_axis.z;
        let squares: f64 = strain.to_cols_array().iter().map(|entry| entry * entry).sum();
        let exact = 0.5 * lambda * trace * trace + mu * squares;
        for order in [Order::First, Order::Second] {
            let (energy, force) = energy_and_inner_force(order, |at| strain * at + DVec3::new(1.0, 2.0, 3.0));
            assert!(
                (energy / exact - 1.0).abs() < 1e-12 && force < 1e-12,
                "{order:?}: {energy} {exact} {force}"
            );
        }
    }

    #[test]
    fn pure_bending_is_exact_in_second_order_and_too_stiff_in_first() {
        // u = (x z, -nu y z, -(x² + nu (z² - y²)) / 2): curvature 1 about y, stress E z along x, energy E I / 2, I = 1/12.
        let bend = |at: DVec3| {
            let nu = MATERIAL.poisson;
            DVec3::new(
                at.x * at.z,
                -nu * at.y * at.z,
                -0.5 * (at.x * at.x + nu * (at.z * at.z - at.y * at.y)),
            )
        };
        let exact = MATERIAL.young_pa / 24.0;
        let (first, _) = energy_and_inner_force(Order::First, bend);
        let (second, force) = energy_and_inner_force(Order::Second, bend);
        assert!((second / exact - 1.0).abs() < 1e-12 && force < 1e-12, "{second} {exact} {force}");
        assert!(first > 1.1 * exact, "{first} {exact}");
    }
}
