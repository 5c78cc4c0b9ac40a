//! The bulge outside the boundary (MODEL section 4): part of the volume that a contact displaces comes out
//! around it.

use glam::DVec3;

use crate::contact_shape::ContactShape;
use crate::mesh::SurfaceMesh;
use crate::parameters::Spread;

/// `e = c b` along the vertex normals, c such that `sum A_v e_v = -kappa sum A_v u_v`.
#[derive(Clone, Debug)]
pub(crate) struct Expansion {
    kappa: f64,
    /// `b` at each vertex of the present contact.
    bumps: Vec<f64>,
    /// Sum of `A_v b_v` and of `A_v u_v`.
    bump_m2: f64,
    displaced_m3: f64,
}

impl Expansion {
    /// `None` for kappa = 0: nothing is computed then.
    pub(crate) fn new(kappa: f64, vertices: usize) -> Option<Self> {
        (kappa > 0.0).then(|| Self {
            kappa,
            bumps: Vec::with_capacity(vertices),
            bump_m2: 0.0,
            displaced_m3: 0.0,
        })
    }

    pub(crate) fn begin(&mut self) {
        self.bumps.clear();
        self.bump_m2 = 0.0;
        self.displaced_m3 = 0.0;
    }

    /// Takes note of a vertex of rest area `area_m2` at `s` (a ring number for rings) that is displaced by
    /// `normal_m`.
    pub(crate) fn note(&mut self, shape: &ContactShape, spread: Spread, s: f64, normal_m: f64, area_m2: f64) {
        let bump = match spread {
            Spread::Geodesic => shape.bump(s),
            Spread::Rings => shape.bump_at_ring(s),
        };
        self.bumps.push(bump);
        self.bump_m2 += area_m2 * bump;
        self.displaced_m3 += area_m2 * normal_m;
    }

    /// Adds the bulge to the displacements of the noted vertices.
    pub(crate) fn add(&self, mesh: &SurfaceMesh, vertices: &[u32], displacements: &mut [DVec3]) {
        if self.bump_m2 <= 0.0 {
            return; // no vertex lies there
        }
        let height_m = -self.kappa * self.displaced_m3 / self.bump_m2;
        for ((&vertex, displacement), &bump) in vertices.iter().zip(displacements).zip(&self.bumps) {
            *displacement += mesh.vertex_normals()[vertex as usize] * (height_m * bump);
        }
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        self.bumps.capacity() * size_of::<f64>()
    }
}
