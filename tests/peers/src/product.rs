//! The peers that have a dense surface compliance: as the full product, or with the columns of the touched points only.

use glam::DVec3;
use rhombus_chain::SurfaceMesh;

use crate::compliance::{Compliance, UnitContact};
use crate::{Job, Peer};

/// What both have: the compliance, and the contact at unit depth.
struct Touched {
    name: &'static str,
    surface: SurfaceMesh,
    contact_radius_m: f64,
    compliance: Compliance,
    contact: UnitContact,
    displacements: Vec<f32>,
}

impl Touched {
    fn new(name: &'static str, job: &Job, compliance: Compliance) -> Self {
        Self {
            name,
            surface: job.surface.clone(),
            contact_radius_m: job.contact_radius_m,
            displacements: vec![0.0; compliance.rows()],
            contact: UnitContact::default(),
            compliance,
        }
    }

    fn bytes(&self) -> u64 {
        let vector = size_of_val(&self.displacements[..]) as u64;
        self.compliance.bytes() + self.surface.memory_bytes() as u64 + vector
    }

    fn touch(&mut self, vertex: u32, normal: DVec3) {
        self.contact = self.compliance.touch(&self.surface, vertex, normal, self.contact_radius_m);
    }
}

/// u = C f with the whole matrix in every period: what a session pays that knows nothing about where the forces are.
pub(crate) struct FullProduct {
    touched: Touched,
    forces: Vec<f32>,
}

impl FullProduct {
    /// `compliance` is laid out in rows.
    pub(crate) fn new(name: &'static str, job: &Job, compliance: Compliance) -> Self {
        Self { forces: vec![0.0; compliance.columns()], touched: Touched::new(name, job, compliance) }
    }
}

impl Peer for FullProduct {
    fn name(&self) -> &'static str {
        self.touched.name
    }

    fn bytes(&self) -> u64 {
        self.touched.bytes() + size_of_val(&self.forces[..]) as u64
    }

    fn touch(&mut self, vertex: u32, normal: DVec3) {
        self.touched.touch(vertex, normal);
    }

    fn query(&mut self, depth_m: f64, displacements: &mut [DVec3]) -> f64 {
        let Touched { contact, compliance, displacements: scratch, .. } = &mut self.touched;
        self.forces.fill(0.0);
        for &(point, force) in &contact.forces {
            let force = (force * depth_m).as_vec3().to_array();
            self.forces[3 * point as usize..][..3].copy_from_slice(&force);
        }
        compliance.multiply(&self.forces, scratch, displacements);
        contact.stiffness_n_per_m * depth_m
    }
}

/// u = C f with the columns of the touched vertices only: all other forces are zero.
pub(crate) struct PatchColumns {
    touched: Touched,
    forces: Vec<(u32, DVec3)>,
}

impl PatchColumns {
    /// `compliance` is laid out in columns.
    pub(crate) fn new(name: &'static str, job: &Job, compliance: Compliance) -> Self {
        Self { touched: Touched::new(name, job, compliance), forces: Vec::new() }
    }
}

impl Peer for PatchColumns {
    fn name(&self) -> &'static str {
        self.touched.name
    }

    fn bytes(&self) -> u64 {
        self.touched.bytes()
    }

    fn touch(&mut self, vertex: u32, normal: DVec3) {
        self.touched.touch(vertex, normal);
        self.forces.clone_from(&self.touched.contact.forces);
    }

    fn query(&mut self, depth_m: f64, displacements: &mut [DVec3]) -> f64 {
        let Touched { contact, compliance, displacements: scratch, .. } = &mut self.touched;
        for ((_, now), &(_, unit)) in self.forces.iter_mut().zip(&contact.forces) {
            *now = unit * depth_m;
        }
        compliance.combine(&self.forces, scratch, displacements);
        contact.stiffness_n_per_m * depth_m
    }
}
