//! S-chain, the shape-retaining chain linked model: rigid elements that drag their neighbours.
//!
//! J. Park, S.-Y. Kim, S.-W. Son and D.-S. Kwon, "Shape retaining chain linked model for real-time volume haptic rendering",
//! IEEE/ACM SIGGRAPH Symposium on Volume Visualization and Graphics 2002; S.-Y. Kim, J. Park and D.-S. Kwon, "The real-time
//! haptic simulation of a biomedical volumetric object with shape-retaining chain linked model", IEICE Trans. Inf. and Syst.
//! E88-D(5), 2005, 1012-1020. As published:
//!
//! - every voxel of the body is a chain element, linked to its six nearest neighbours;
//! - an element follows the contact; what its links to the next elements cannot take up within their limit is passed on, as
//!   if a chain were pulled or pushed. So the element m links away moves by `max(d - m limit, 0)`: the surface looks like a cone;
//! - the force on the hand is proportional to the number of elements that are displaced.
//!
//! Ours, where this leaves it open, or where only the abstracts and later descriptions of these papers were at hand:
//! - one limit for all six directions and both signs (the papers distinguish limits inside and outside of a link; a
//!   contact pressed along one line never meets both), all elements move along the contact's normal;
//! - an element that has moved by less than the limit counts by that share. So the number is the total length taken up in
//!   units of the limit, equals the count whenever d is a multiple of the limit, and has no steps;
//! - the lattice's pitch is the mean edge of the surface; a surface vertex moves with the elements around it (trilinear), the
//!   elements at held vertices never move;
//! - the two numbers the method ties to no elastic constant are chosen once on a half-space of such elements, at a depth of
//!   1 mm ([`MATCHED_DEPTH_M`]), under this contact: the limit is the best least-squares fit of the surface within
//!   30 mm to that under a flat punch, `u = (2/pi) asin(a/r) d`; the force for each element gives the punch's
//!   `2 E a d/(1 - nu^2)`, a no smaller than the radius of one element. In three dimensions the number of displaced
//!   elements grows faster than depth: the force is right at that depth on a half-space, and too small before and too
//!   large beyond it.

mod elements;

use glam::DVec3;
use rhombus_chain::SurfaceMesh;

use crate::lem::mean_edge_m;
use crate::{Job, Peer, PeerKind, SetupError, patch};
use elements::{Elements, Links, UNREACHED};

/// The depth at which the method is matched to an elastic half-space, m.
pub const MATCHED_DEPTH_M: f64 = 1e-3;
/// How far from the contact the surface is matched, m.
const MATCHED_FIELD_M: f64 = 30e-3;

/// In the list of all peers.
pub(crate) const KIND: PeerKind = PeerKind {
    name: "S-chain",
    citation: "Kim, Park and Kwon, The real-time haptic simulation of a biomedical volumetric object \
    with shape-retaining chain linked model, IEICE Trans. Inf. & Syst. E88-D(5), 2005",
    setup: |job| Ok(Box::new(SChain::new(job)?)),
};

/// Chain elements inside the body.
pub struct SChain {
    surface: SurfaceMesh,
    fixed: Vec<bool>,
    contact_radius_m: f64,
    elements: Elements,
    around: Vec<[(u32, f32); 8]>,
    laws: Laws,
    links: Links,
    touched: Vec<u32>,
    normal: DVec3,
}

/// The method's two numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Laws {
    /// What one link takes up before it passes motion on, m.
    limit_m: f64,
    /// Force for each displaced element, N.
    force_per_element_n: f64,
}

/// How many elements are displaced by `depth_m`, the outermost by the share of the limit that they have moved.
fn displaced(counts: &[u32], depth_m: f64, limit_m: f64) -> f64 {
    let reach = depth_m / limit_m;
    let layer = |(m, &count): (u32, &u32)| f64::from(count) * (reach - f64::from(m)).clamp(0.0, 1.0);
    (0u32..).zip(counts).map(layer).sum()
}

impl Laws {
    /// Matched on a half-space, see the module.
    fn matched(job: &Job, pitch_m: f64) -> Self {
        let radius_m = job.contact_radius_m.max(pitch_m / std::f64::consts::PI.sqrt());
        let half = ((job.contact_radius_m + MATCHED_FIELD_M) / pitch_m).ceil().max(3.0) as usize;
        let space = Elements::half_space(half, pitch_m);
        let mut links = Links::default();
        let top = |x: usize, y: usize| space.number([x, y, half]);
        let aside = |x: usize, y: usize| (x as f64 - half as f64).hypot(y as f64 - half as f64) * pitch_m;
        let cells = || (0..=2 * half).flat_map(|y| (0..=2 * half).map(move |x| (x, y)));
        let touched = |&(x, y): &(usize, usize)| aside(x, y) <= job.contact_radius_m * (1.0 + 1e-9);
        space.walk(cells().filter(touched).map(|(x, y)| top(x, y)), &mut links);
        let surface: Vec<(f64, f64)> = cells()
            .filter(|at| !touched(at) && aside(at.0, at.1) <= job.contact_radius_m + MATCHED_FIELD_M)
            .map(|(x, y)| {
                let punch = 2.0 / std::f64::consts::PI * (radius_m / aside(x, y)).min(1.0).asin();
                (f64::from(links.of_cell[top(x, y)]), punch)
            })
            .collect();
        let misfit = |reach: f64| {
            surface.iter().map(|(m, punch)| ((1.0 - m / reach).max(0.0) - punch).powi(2)).sum::<f64>()
        };
        // Links that move at the matched depth, by twentieths; the half-space holds as many.
        let candidates =
            (20..=20 * u32::try_from(half).unwrap_or(u32::MAX / 20)).map(|k| f64::from(k) / 20.0);
        let reach = candidates.min_by(|a, b| misfit(*a).total_cmp(&misfit(*b))).unwrap_or(1.0);
        let limit_m = MATCHED_DEPTH_M / reach;
        let nu = job.material.poisson;
        let punch_n = 2.0 * job.material.young_pa * radius_m * MATCHED_DEPTH_M / (1.0 - nu * nu);
        Self { limit_m, force_per_element_n: punch_n / displaced(&links.counts, MATCHED_DEPTH_M, limit_m) }
    }
}

impl SChain {
    /// Fills the body with elements and matches the two numbers.
    ///
    /// # Errors
    /// An unusable job, or one that does not fit.
    pub fn new(job: &Job) -> Result<Self, SetupError> {
        job.check()?;
        let pitch_m = mean_edge_m(job.surface);
        let vertices = job.surface.vertices().len();
        let for_vertices = vertices * (size_of::<[(u32, f32); 8]>() + 1) + job.surface.memory_bytes();
        job.reserve(Elements::needed_bytes(job.surface, pitch_m) + for_vertices as u64)?;
        let elements = Elements::inside(job.surface, job.fixed, pitch_m);
        let around = job.surface.vertices().iter().map(|&at| elements.around(at)).collect();
        Ok(Self {
            surface: job.surface.clone(),
            fixed: job.fixed.to_vec(),
            contact_radius_m: job.contact_radius_m,
            laws: Laws::matched(job, pitch_m),
            elements,
            around,
            links: Links::default(),
            touched: Vec::new(),
            normal: DVec3::Z,
        })
    }

    /// What one link takes up before it passes motion on, m.
    #[must_use]
    pub fn limit_m(&self) -> f64 {
        self.laws.limit_m
    }

    /// Force for each displaced element, N.
    #[must_use]
    pub fn force_per_element_n(&self) -> f64 {
        self.laws.force_per_element_n
    }
}

impl Peer for SChain {
    fn name(&self) -> &'static str {
        KIND.name
    }

    fn bytes(&self) -> u64 {
        let cells = self.elements.len() * 8;
        (cells + size_of_val(self.around.as_slice()) + self.fixed.len() + self.surface.memory_bytes()) as u64
    }

    fn touch(&mut self, vertex: u32, normal: DVec3) {
        self.normal = normal;
        self.touched = patch(&self.surface, vertex, normal, self.contact_radius_m);
        self.touched.retain(|&vertex| !self.fixed[vertex as usize]);
        let cells = self
            .touched
            .iter()
            .map(|&vertex| self.elements.nearest(self.surface.vertices()[vertex as usize]));
        self.elements.walk(cells, &mut self.links);
    }

    fn query(&mut self, depth_m: f64, displacements: &mut [DVec3]) -> f64 {
        let deep = depth_m.abs();
        let moved = |cell: u32| match self.links.of_cell.get(cell as usize) {
            Some(&away) if away != UNREACHED => (deep - f64::from(away) * self.laws.limit_m).max(0.0),
            _ => 0.0,
        };
        let along = -self.normal * depth_m.signum();
        for ((to, around), &held) in displacements.iter_mut().zip(&self.around).zip(&self.fixed) {
            let share: f64 = around.iter().map(|&(cell, weight)| f64::from(weight) * moved(cell)).sum();
            *to = if held { DVec3::ZERO } else { along * share };
        }
        for &vertex in &self.touched {
            displacements[vertex as usize] = -self.normal * depth_m;
        }
        let number = displaced(&self.links.counts, deep, self.laws.limit_m);
        self.laws.force_per_element_n * number * depth_m.signum()
    }
}

#[cfg(test)]
mod tests {
    use super::{Laws, MATCHED_DEPTH_M, SChain, displaced};
    use crate::{Job, Material, Peer, SetupError, TetMesh};
    use glam::DVec3;

    fn with_block(size_m: [f64; 3], limit: u64, mut run: impl FnMut(Job)) {
        let cells = |length: f64| (0..=10).map(|k| 0.1 * length * f64::from(k)).collect::<Vec<_>>();
        let (surface, volume) = TetMesh::block(&cells(size_m[0]), &cells(size_m[1]), &cells(size_m[2]));
        run(Job {
            surface: &surface,
            volume: None,
            fixed: &volume.fixed,
            material: Material { young_pa: 10e3, poisson: 0.45 },
            contact_radius_m: 0.005,
            memory_limit_bytes: limit,
        });
    }

    #[test]
    fn a_straight_chain_moves_as_many_elements_as_limits_fit_into_the_depth() {
        let one_after_the_other = [1u32; 50];
        for (depth, number) in [(0.0, 0.0), (1e-3, 1.0), (7e-3, 7.0), (7.5e-3, 7.5), (1.0, 50.0)] {
            assert!((displaced(&one_after_the_other, depth, 1e-3) - number).abs() < 1e-12);
        }
    }

    #[test]
    fn displacement_falls_by_one_limit_for_each_link_and_ends_where_it_is_used_up() {
        with_block([0.06, 0.06, 0.04], u64::MAX, |job| {
            let mut body = SChain::new(&job).unwrap();
            let surface = job.surface;
            let top = DVec3::new(0.03, 0.03, 0.04);
            let site = (0u32..).zip(surface.vertices()).find(|(_, at)| at.distance(top) < 1e-12).unwrap().0;
            body.touch(site, DVec3::Z);
            let mut field = vec![DVec3::ZERO; surface.vertices().len()];
            let limit = body.limit_m();
            let cell = |m: usize| body.elements.nearest(top - DVec3::Z * body.elements_pitch() * m as f64);
            let below: Vec<u16> = (0..4).map(|m| body.links.of_cell[cell(m)]).collect();
            assert_eq!(below, [0, 1, 2, 3]);
            let force = body.query(2.5 * limit, &mut field);
            assert!(force > 0.0);
            assert!((field[site as usize].z + 2.5 * limit).abs() < 1e-15);
            assert!(field.iter().all(|u| u.z <= 0.0 && u.z >= -2.5 * limit - 1e-15 && u.x == 0.0));
            let far = |(at, u): (&DVec3, &DVec3)| at.distance(top) < 0.03 || *u == DVec3::ZERO;
            assert!(surface.vertices().iter().zip(&field).all(far));
            assert_eq!(body.query(-2.5 * limit, &mut field), -force, "pulling mirrors pressing");
        });
    }

    #[test]
    fn at_the_matched_depth_a_half_space_has_the_force_of_a_flat_punch() {
        with_block([0.2, 0.2, 0.1], u64::MAX, |job| {
            let job = Job { fixed: job.fixed, ..job };
            let mut body = SChain::new(&job).unwrap();
            let top = DVec3::new(0.1, 0.1, 0.1);
            let site =
                (0u32..).zip(job.surface.vertices()).find(|(_, at)| at.distance(top) < 1e-12).unwrap().0;
            body.touch(site, DVec3::Z);
            let mut field = vec![DVec3::ZERO; job.surface.vertices().len()];
            let force = body.query(MATCHED_DEPTH_M, &mut field);
            let pitch = body.elements_pitch();
            assert!(pitch > 0.005, "the disc touches one element, as in the match");
            let punch = 2.0 * 10e3 * (pitch / std::f64::consts::PI.sqrt()) / (1.0 - 0.45 * 0.45);
            assert!((force / (punch * MATCHED_DEPTH_M) - 1.0).abs() < 1e-9, "{force}");
            assert_eq!(Laws::matched(&job, pitch), body.laws);
        });
    }

    #[test]
    fn too_little_memory_is_refused() {
        let refused = |job: Job| assert!(matches!(SChain::new(&job), Err(SetupError::DoesNotFit { .. })));
        with_block([0.06, 0.06, 0.04], 1000, refused);
    }

    impl SChain {
        fn elements_pitch(&self) -> f64 {
            crate::lem::mean_edge_m(&self.surface)
        }
    }
}
