//! PCMFS, the point collocation-based method of finite spheres: equilibrium at scattered points around the contact.
//!
//! S. De, J. Kim, Y.-J. Lim and M. A. Srinivasan, "The point collocation-based method of finite spheres (PCMFS) for real time
//! surgery simulation", Computers and Structures 83(17-18), 2005, 1515-1525. As published: displacements are sums of
//! moving least squares functions on spheres ([`shape`]), equilibrium and boundary conditions hold at the spheres'
//! centres ([`collocation`]), spheres are laid out only within a zone of influence around the tool, and nothing moves
//! at its rim and beyond. The zone's equations are solved for the tool's displacement, to which the answer is proportional.
//!
//! Ours, where they leave it open or where theirs does not carry over from one tool point on a smooth surface:
//! - the contact is a disc: displacement is given along its normal at all spheres under it. The force is the sum over
//!   its surface vertices of normal traction times vertex area (published: the entry of one point);
//! - polynomials of second order, since those of first order cannot represent a change of strain;
//! - least squares, with equilibrium on the surface too, see [`collocation`]: without it the answers here are useless;
//! - spacing h is the mean edge of the surface, but not less than the contact radius; the zone's radius is 6 h. Centres: surface
//!   vertices, the contact's first, each at least 0.6 h from those before it; then points of a cubic lattice inside the
//!   body, as far from them. Radius of the spheres: 2.5 h, or the first of 3, 3.5 and 4 h with which
//!   the functions exist at every centre. If none does, or the answer is not finite, the contact has no answer: zero force, and
//!   the disc alone moves.
//!
//! The force is the weak side of collocation: the pressure under a disc's edge has no bound, and is sampled at few points.

mod collocation;
mod shape;

use glam::DVec3;
use rhombus_chain::SurfaceMesh;

use crate::lem::{Lattice, mean_edge_m};
use crate::{Job, Peer, PeerKind, SetupError, patch};
use collocation::{Condition, Lame, solve};
use shape::Spheres;

/// Radius of the zone of influence, in spacings.
const ZONE: f64 = 6.0;
/// Centres are at least this far apart, in spacings.
const APART: f64 = 0.6;
/// Radii of the spheres that are tried, in spacings.
const RADII: [f64; 4] = [2.5, 3.0, 3.5, 4.0];

/// In the list of all peers.
pub(crate) const KIND: PeerKind = PeerKind {
    name: "PCMFS",
    citation: "De, Kim, Lim and Srinivasan, The point collocation-based method of finite spheres (PCMFS) for real time surgery \
               simulation, Computers and Structures 83(17-18), 2005",
    setup: |job| Ok(Box::new(Pcmfs::new(job)?)),
};

/// Finite spheres around the contact.
pub(crate) struct Pcmfs {
    surface: SurfaceMesh,
    fixed: Vec<bool>,
    contact_radius_m: f64,
    lame: Lame,
    spacing_m: f64,
    /// Displacement of each surface vertex for each metre of depth.
    per_depth: Vec<DVec3>,
    stiffness_n_per_m: f64,
    spheres: usize,
}

impl Pcmfs {
    /// Chooses the spacing.
    ///
    /// # Errors
    /// An unusable job, or one that does not fit.
    pub(crate) fn new(job: &Job) -> Result<Self, SetupError> {
        job.check()?;
        let (lambda_pa, mu_pa) = job.material.lame_pa();
        let vertices = job.surface.vertices().len();
        // A full zone: a ball of cells, and as many vertices on its disc; the matrix and its factors.
        let most = (4.0 / 3.0 * ZONE * ZONE * ZONE + ZONE * ZONE / (APART * APART)) * std::f64::consts::PI;
        let matrices = 2 * 8 * (9.0 * most * most) as u64;
        job.reserve(matrices + (vertices * 64 + job.surface.memory_bytes()) as u64)?;
        Ok(Self {
            surface: job.surface.clone(),
            fixed: job.fixed.to_vec(),
            contact_radius_m: job.contact_radius_m,
            lame: Lame { lambda_pa, mu_pa },
            spacing_m: mean_edge_m(job.surface).max(job.contact_radius_m),
            per_depth: vec![DVec3::ZERO; vertices],
            stiffness_n_per_m: 0.0,
            spheres: 0,
        })
    }

    /// The spheres' centres around a site, with their conditions at unit depth.
    fn centres(&self, site: DVec3, normal: DVec3, touched: &[u32]) -> (Vec<DVec3>, Vec<Condition>) {
        let h = self.spacing_m;
        let rim = |at: DVec3| at.distance(site) > (ZONE - 0.8) * h;
        let mut centres: Vec<DVec3> = Vec::new();
        let mut conditions = Vec::new();
        let mut add = |at: DVec3, condition: Condition| {
            let known = |other: &DVec3| other.distance_squared(at) < (APART * h) * (APART * h);
            if at.distance(site) <= ZONE * h && !centres.iter().any(known) {
                centres.push(at);
                conditions.push(if rim(at) { Condition::Moved(DVec3::ZERO) } else { condition });
            }
        };
        let vertices = 0..self.surface.vertices().len();
        let under_disc = touched.iter().map(|&vertex| vertex as usize);
        for vertex in under_disc.chain(vertices) {
            let (at, own) = (self.surface.vertices()[vertex], self.surface.vertex_normals()[vertex]);
            let pressed = touched.binary_search(&(vertex as u32)).is_ok();
            let condition = match (self.fixed[vertex], pressed) {
                (true, _) => Condition::Moved(DVec3::ZERO),
                (false, true) => Condition::Pressed { normal: own, disc: normal, along_m: -1.0 },
                (false, false) => Condition::Loaded { normal: own, traction_pa: DVec3::ZERO },
            };
            add(at, condition);
        }
        let lattice = Lattice::around(&self.surface, site, normal, h);
        for (line, pieces) in lattice.pieces(&self.surface).iter().enumerate() {
            let foot = lattice.origin
                + (lattice.axes[0] * (line % lattice.size[0]) as f64
                    + lattice.axes[1] * (line / lattice.size[0]) as f64)
                    * h;
            for piece in pieces {
                let [from, to] = piece.from_to_m.map(|height| height / h);
                let mut level = from.max(-ZONE).ceil();
                while level < to.min(ZONE) {
                    add(foot + lattice.axes[2] * (level * h), Condition::Inside);
                    level += 1.0;
                }
            }
        }
        (centres, conditions)
    }

    /// Force per metre of depth and displacements per metre, into `per_depth`; nothing when there is no answer.
    fn respond(&mut self, site: DVec3, normal: DVec3, touched: &[u32]) -> Option<f64> {
        let (centres, conditions) = self.centres(site, normal, touched);
        self.spheres = centres.len();
        let mut spheres = Spheres { centres, radius_m: 0.0 };
        let u = RADII.iter().find_map(|radius| {
            spheres.radius_m = radius * self.spacing_m;
            solve(&spheres, &conditions, self.spacing_m, self.lame)
        })?;
        if !u.iter().all(|u| u.is_finite()) {
            return None;
        }
        for (vertex, to) in self.per_depth.iter_mut().enumerate() {
            let at = self.surface.vertices()[vertex];
            if self.fixed[vertex] || at.distance(site) > ZONE * self.spacing_m {
                continue;
            }
            let functions = spheres.at(at).unwrap_or_default();
            *to = functions.iter().map(|one| u[one.sphere] * one.value).sum();
        }
        let mut force = 0.0;
        for &vertex in touched {
            let vertex = vertex as usize;
            let own = self.surface.vertex_normals()[vertex];
            let functions = spheres.at(self.surface.vertices()[vertex])?;
            let traction: DVec3 =
                functions.iter().map(|one| self.lame.traction(one, own) * u[one.sphere]).sum();
            force -= traction.dot(normal) * self.surface.vertex_areas()[vertex];
        }
        Some(force)
    }
}

impl Peer for Pcmfs {
    fn name(&self) -> &'static str {
        KIND.name
    }

    fn bytes(&self) -> u64 {
        let own = size_of_val(self.per_depth.as_slice()) + self.fixed.len() + self.surface.memory_bytes();
        let size = 3 * self.spheres;
        (own + 2 * 8 * size * size) as u64
    }

    fn touch(&mut self, vertex: u32, normal: DVec3) {
        let Some(&site) = self.surface.vertices().get(vertex as usize) else {
            return;
        };
        let mut touched = patch(&self.surface, vertex, normal, self.contact_radius_m);
        touched.retain(|&vertex| !self.fixed[vertex as usize]);
        self.per_depth.fill(DVec3::ZERO);
        self.stiffness_n_per_m = self.respond(site, normal, &touched).unwrap_or(0.0);
        for &vertex in &touched {
            let u = &mut self.per_depth[vertex as usize];
            *u -= normal * (1.0 + u.dot(normal));
        }
    }

    fn query(&mut self, depth_m: f64, displacements: &mut [DVec3]) -> f64 {
        for (to, &unit) in displacements.iter_mut().zip(&self.per_depth) {
            *to = unit * depth_m;
        }
        self.stiffness_n_per_m * depth_m
    }
}

#[cfg(test)]
mod tests {
    use super::Pcmfs;
    use crate::{Job, Material, Peer, SetupError, TetMesh};
    use glam::DVec3;

    fn with_block(limit: u64, mut run: impl FnMut(Job, u32)) {
        let cells = |count: u32| (0..=count).map(|k| 0.005 * f64::from(k)).collect::<Vec<f64>>();
        let (surface, volume) = TetMesh::block(&cells(12), &cells(12), &cells(6));
        let top = DVec3::new(0.03, 0.03, 0.03);
        let site = (0u32..).zip(surface.vertices()).find(|(_, at)| at.distance(top) < 1e-12).unwrap().0;
        let job = Job {
            surface: &surface,
            volume: None,
            fixed: &volume.fixed,
            material: Material { young_pa: 10e3, poisson: 0.3 },
            contact_radius_m: 0.005,
            memory_limit_bytes: limit,
        };
        run(job, site);
    }

    #[test]
    fn a_pressed_block_answers_symmetrically_and_only_within_the_zone() {
        with_block(u64::MAX, |job, site| {
            let mut body = Pcmfs::new(&job).unwrap();
            body.touch(site, DVec3::Z);
            let vertices = job.surface.vertices();
            let mut field = vec![DVec3::ZERO; vertices.len()];
            let force = body.query(1e-3, &mut field);
            assert!(force > 0.0);
            let at = |x: f64, y: f64| {
                let place = DVec3::new(x, y, 0.03);
                let vertex = vertices.iter().position(|at| at.distance(place) < 1e-9).unwrap();
                field[vertex]
            };
            assert!((at(0.03, 0.03).z + 1e-3).abs() < 1e-9);
            let beside = [at(0.04, 0.03), at(0.02, 0.03), at(0.03, 0.04), at(0.03, 0.02)];
            assert!(beside.iter().all(|u| u.z < 0.0 && u.z > -1e-3), "{beside:?}");
            assert!(
                beside.iter().all(|u| (u.z - beside[0].z).abs() < 1e-3 * beside[0].z.abs()),
                "{beside:?}"
            );
            assert_eq!(body.query(2e-3, &mut field), 2.0 * force);
            let zone =
                |(at, u): (&DVec3, &DVec3)| at.distance(DVec3::splat(0.03)) <= 0.0361 || *u == DVec3::ZERO;
            assert!(vertices.iter().zip(&field).all(zone));
        });
    }

    #[test]
    fn too_little_memory_is_refused() {
        with_block(1000, |job, _| assert!(matches!(Pcmfs::new(&job), Err(SetupError::DoesNotFit { .. }))));
    }
}
