//! Finite elements for a contact that stays: its answer is solved for when it begins, then scaled by the depth.

use faer::{Mat, Par};
use glam::DVec3;
use rhombus_chain::SurfaceMesh;

use super::assembly::Nodes;
use super::element::Order;
use crate::compliance::press;
use crate::sparse_factor::SparseFactor;
use crate::{Job, Peer, SetupError, patch};

/// The answer of one contact.
pub(super) fn fixed(name: &'static str, job: &Job, order: Order) -> Result<Box<dyn Peer>, SetupError> {
    Ok(Box::new(FixedContact::new(name, job, order)?))
}

struct FixedContact {
    name: &'static str,
    surface: SurfaceMesh,
    contact_radius_m: f64,
    factor: SparseFactor,
    nodes: Nodes,
    /// For each surface vertex, m per m of depth.
    unit: Vec<DVec3>,
    stiffness_n_per_m: f64,
}

impl FixedContact {
    fn new(name: &'static str, job: &Job, order: Order) -> Result<Self, SetupError> {
        job.check()?;
        let volume = job.tetrahedra()?;
        let nodes = Nodes::new(job, volume, order);
        nodes.reserve(job, volume, 0)?;
        let factor =
            SparseFactor::new(nodes.size(), &nodes.assemble(volume, job.material), |factor_bytes| {
                nodes.reserve(job, volume, factor_bytes)
            })?;
        Ok(Self {
            name,
            surface: job.surface.clone(),
            contact_radius_m: job.contact_radius_m,
            factor,
            nodes,
            unit: vec![DVec3::ZERO; job.fixed.len()],
            stiffness_n_per_m: 0.0,
        })
    }
}

impl Peer for FixedContact {
    fn name(&self) -> &'static str {
        self.name
    }

    fn bytes(&self) -> u64 {
        self.factor.bytes()
            + self.nodes.bytes()
            + self.surface.memory_bytes() as u64
            + size_of_val(&self.unit[..]) as u64
    }

    fn touch(&mut self, vertex: u32, normal: DVec3) {
        let touched = patch(&self.surface, vertex, normal, self.contact_radius_m);
        let firsts: Vec<usize> = touched.into_iter().filter_map(|node| self.nodes.unknown(node)).collect();
        let mut answers = Mat::<f64>::zeros(self.nodes.size(), firsts.len());
        for (column, &first) in firsts.iter().enumerate() {
            for axis in 0..3 {
                answers[(first + axis, column)] = normal[axis];
            }
        }
        self.factor.solve(answers.as_mut(), Par::rayon(0));
        let answer = |first: usize, column: usize| {
            DVec3::new(answers[(first, column)], answers[(first + 1, column)], answers[(first + 2, column)])
        };
        let pressed = press(firsts.len(), |i, j| answer(firsts[i], j).dot(normal));
        self.stiffness_n_per_m = pressed.iter().sum();
        for (vertex, unit) in (0u32..).zip(&mut self.unit) {
            let Some(first) = self.nodes.unknown(vertex) else { continue };
            *unit = pressed.iter().enumerate().map(|(column, &force)| answer(first, column) * -force).sum();
        }
    }

    fn query(&mut self, depth_m: f64, displacements: &mut [DVec3]) -> f64 {
        for (displacement, &unit) in displacements.iter_mut().zip(&self.unit) {
            *displacement = unit * depth_m;
        }
        self.stiffness_n_per_m * depth_m
    }
}
