//! Finite elements for a contact that stays: its answer is solved for when it begins, then scaled by the depth.

use faer::{Mat, Par};
use glam::DVec3;
use rhombus_chain::SurfaceMesh;

use super::assembly::Nodes;
use super::element::Order;
use crate::compliance::press;
use crate::contact::ContactPoints;
use crate::sparse_factor::SparseFactor;
use crate::{Job, Peer, SetupError};

/// The answer of one contact.
pub(super) fn fixed(name: &'static str, job: &Job, order: Order) -> Result<Box<dyn Peer>, SetupError> {
    Ok(Box::new(FixedContact::new(name, job, order)?))
}

struct FixedContact {
    name: &'static str,
    surface: SurfaceMesh,
    contact_radius_m: f64,
    factor: SparseFactor,
    points: ContactPoints,
    /// For each contact point, its first unknown; and how many unknowns there are.
    unknowns: Vec<usize>,
    size: usize,
    /// For each surface vertex, m per m of depth.
    unit: Vec<DVec3>,
    stiffness_n_per_m: f64,
}

impl FixedContact {
    fn new(name: &'static str, job: &Job, order: Order) -> Result<Self, SetupError> {
        job.check()?;
        job.check_held()?;
        let volume = job.tetrahedra()?;
        let nodes = Nodes::new(job, volume, order);
        nodes.reserve(job, volume, 0)?;
        let factor =
            SparseFactor::new(nodes.size(), &nodes.assemble(volume, job.material), |factor_bytes| {
                nodes.reserve(job, volume, factor_bytes)
            })?;
        let (points, unknowns) = nodes.contact_points(job);
        Ok(Self {
            name,
            surface: job.surface.clone(),
            contact_radius_m: job.contact_radius_m,
            size: nodes.size(),
            factor,
            points,
            unknowns,
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
            + self.points.bytes()
            + size_of_val(&self.unknowns[..]) as u64
            + self.surface.memory_bytes() as u64
            + size_of_val(&self.unit[..]) as u64
    }

    fn touch(&mut self, vertex: u32, normal: DVec3) {
        let touched = self.points.touched(&self.surface, vertex, normal, self.contact_radius_m);
        let firsts: Vec<usize> = touched.into_iter().map(|point| self.unknowns[point as usize]).collect();
        let mut answers = Mat::<f64>::zeros(self.size, firsts.len());
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
        for (&vertex, &first) in self.points.vertices().iter().zip(&self.unknowns) {
            let columns = pressed.iter().enumerate();
            self.unit[vertex as usize] = columns.map(|(column, &force)| answer(first, column) * -force).sum();
        }
    }

    fn query(&mut self, depth_m: f64, displacements: &mut [DVec3]) -> f64 {
        for (displacement, &unit) in displacements.iter_mut().zip(&self.unit) {
            *displacement = unit * depth_m;
        }
        self.stiffness_n_per_m * depth_m
    }
}
