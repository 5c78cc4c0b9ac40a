//! What the sites of a reference say about one shape for all of them: averages over narrow rings of arc length.
//!
//! With `n` the contact normal and `r` the direction away from the contact in its tangent plane the model moves a vertex by
//! `G(arc) n + T(arc) r`; the two are perpendicular, so the squared error of the vector is that of its parts along `n` and
//! `r` plus a constant. A vertex at a site counts with
//!
//! ```text
//! w = 1 / sum_near |u|^2  (within 30 mm of the contact)  +  0.1 / sum_all |u|^2
//! ```
//!
//! so that the weighted sum is the squared relative error near the contact plus a tenth of the full one. The averages
//! themselves are the best such shape there is, and what they leave is the least that any number of chains can leave:
//!
//! ```text
//! 1 - sum_rings ((sum w u.n)^2 / sum w + (sum w u.r)^2 / sum w |r|^2) / sites,     w near the contact only
//! ```

use glam::DVec3;
use rhombus_chain::{ArcLengths, SurfaceMesh};

use super::errors::{NEAR_M, at_vertex};
use super::shape::ShapePoint;
use crate::reference::{Reference, ReferenceContact};

/// The averages, and what they leave.
pub(super) struct Rings {
    pub(super) points: Vec<ShapePoint>,
    /// The least root of the mean squared relative error near the contacts that one shape can leave.
    pub(super) least_near: f64,
}

/// Share of the full field's error beside the near field's.
const FULL: f64 = 0.1;

/// Rings for each contact radius.
const RINGS: f64 = 10.0;

/// Sums over vertices.
#[derive(Clone, Copy, Default)]
struct Sums {
    weight: f64,
    arc: f64,
    normal: f64,
    tangential_weight: f64,
    tangential: f64,
}

impl Sums {
    fn add(&mut self, weight: f64, arc_m: f64, displacement: DVec3, normal: DVec3, away: DVec3) {
        self.weight += weight;
        self.arc += weight * arc_m;
        self.normal -= weight * displacement.dot(normal);
        // (T |r| - u.r/|r|)^2 = |r|^2 (T - u.r/|r|^2)^2
        self.tangential_weight += weight * away.length_squared();
        self.tangential += weight * displacement.dot(away);
    }

    /// What the averages explain of the sum of squares.
    fn explained(&self) -> f64 {
        let part = |sum: f64, weight: f64| if weight > 0.0 { sum * sum / weight } else { 0.0 };
        part(self.normal, self.weight) + part(self.tangential, self.tangential_weight)
    }

    fn point(&self, sites: f64) -> ShapePoint {
        ShapePoint {
            arc_m: self.arc / self.weight,
            normal: self.normal / self.weight,
            tangential: (self.tangential_weight > 0.0).then(|| self.tangential / self.tangential_weight),
            weight: self.weight / sites,
            tangential_weight: self.tangential_weight / sites,
        }
    }
}

impl Rings {
    /// Of the given sites, which have one contact each.
    pub(super) fn new(
        reference: &Reference,
        mesh: &SurfaceMesh,
        sites: &[usize],
        contacts: &[ReferenceContact],
        radius_m: f64,
    ) -> Self {
        let mut arcs = ArcLengths::new(mesh);
        // All vertices, and the near ones alone.
        let mut rings: Vec<[Sums; 2]> = Vec::new();
        for (site, contact) in sites.iter().zip(contacts) {
            let exact = &reference.sites[*site].displacement;
            let offset = |vertex: usize| mesh.vertices()[vertex] - contact.point;
            let is_near = |vertex: usize| offset(vertex).length() <= NEAR_M;
            let all: f64 = exact.iter().map(|u| u.length_squared()).sum();
            let near: f64 =
                exact.iter().enumerate().filter(|(v, _)| is_near(*v)).map(|(_, u)| u.length_squared()).sum();
            let Some(at) = at_vertex(mesh, contact.vertex) else { continue };
            let normal = mesh.normal(at);
            arcs.solve(mesh, at, f64::MAX);
            for (vertex, arc_m) in arcs.iter() {
                let vertex = vertex as usize;
                let near_weight = if is_near(vertex) { 1.0 / near } else { 0.0 };
                let away = away(offset(vertex), normal);
                let ring = (arc_m / radius_m * RINGS) as usize;
                if rings.len() <= ring {
                    rings.resize(ring + 1, [Sums::default(); 2]);
                }
                rings[ring][0].add(near_weight + FULL / all, arc_m, exact[vertex], normal, away);
                rings[ring][1].add(near_weight, arc_m, exact[vertex], normal, away);
            }
        }
        let sites = sites.len() as f64;
        let explained: f64 = rings.iter().map(|[_, near]| near.explained()).sum();
        Self {
            points: rings
                .iter()
                .filter(|[all, _]| all.weight > 0.0)
                .map(|[all, _]| all.point(sites))
                .collect(),
            least_near: (1.0 - explained / sites).max(0.0).sqrt(),
        }
    }
}

/// The direction the model calls away: of unit length, shorter behind a thin lobe (MODEL section 4).
fn away(offset: DVec3, normal: DVec3) -> DVec3 {
    let in_plane = offset - normal * offset.dot(normal);
    let scale = in_plane.length().max(0.2 * offset.length());
    if scale > 0.0 { in_plane / scale } else { DVec3::ZERO }
}
