//! Reference solutions on any mesh of the same body, and how far an answer is from them.

use glam::DVec3;
use rhombus_chain::{Body, SurfaceIndex, SurfaceMesh};
use rhombus_cli::calibrate::errors::{self, NEAR_M};
use rhombus_cli::reference::Reference;

/// What a body answers at one site, at unit depth.
#[derive(Clone)]
pub(crate) struct TruthSite {
    /// Number of the site in the reference.
    pub(crate) site: usize,
    /// The site, m.
    pub(crate) point: DVec3,
    /// Unit outward normal there.
    pub(crate) normal: DVec3,
    /// Vertex of this mesh nearest to the site.
    pub(crate) vertex: u32,
    /// Force on the hand for each metre of depth, N/m.
    pub(crate) stiffness_n_per_m: f64,
    /// Displacement of each vertex for each metre of depth.
    pub(crate) displacement: Vec<DVec3>,
    /// Which vertices are within [`NEAR_M`] of the site.
    near: Vec<bool>,
}

/// Distance of an answer from the truth; shares, 0.02 is 2 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Distance {
    /// Of the force.
    pub(crate) force: f64,
    /// Relative L2 of all vertices' displacement vectors.
    pub(crate) full: f64,
    /// Relative L2 within 30 mm of the site.
    pub(crate) near: f64,
    /// Of the worst vertex, as a share of the depth.
    pub(crate) worst: f64,
}

/// The sites `wanted` of a reference on the vertices of `mesh`. A vertex that is not one of the reference's gets the
/// displacement of the closest point of its surface, interpolated on the triangle. Sites with several contacts are left out.
pub(crate) fn on(
    mesh: &SurfaceMesh,
    reference: &Reference,
    surface: &Body,
    wanted: &[usize],
) -> Vec<TruthSite> {
    let places: Vec<_> = mesh
        .vertices()
        .iter()
        .map(|&vertex| surface.index().closest(surface.mesh(), vertex, f64::INFINITY).map(|(at, _)| at))
        .collect();
    let index = SurfaceIndex::new(mesh);
    wanted
        .iter()
        .filter_map(|&site| {
            let solution = &reference.sites[site];
            let [contact] = solution.contacts[..] else { return None };
            let displacement = places
                .iter()
                .map(|place| {
                    let Some(at) = place else { return DVec3::ZERO };
                    let corners = surface.mesh().triangles()[at.face as usize];
                    let [a, b, c] = corners.map(|corner| solution.displacement[corner as usize]);
                    a * at.barycentric.x + b * at.barycentric.y + c * at.barycentric.z
                })
                .collect();
            let (at, _) = index.closest(mesh, contact.point, f64::INFINITY)?;
            let corners = mesh.triangles()[at.face as usize];
            let apart = |corner: &u32| mesh.vertices()[*corner as usize].distance(contact.point);
            let vertex = corners.into_iter().min_by(|a, b| apart(a).total_cmp(&apart(b)))?;
            let near = mesh.vertices().iter().map(|at| at.distance(contact.point) <= NEAR_M).collect();
            Some(TruthSite {
                site,
                point: contact.point,
                normal: contact.normal,
                vertex,
                stiffness_n_per_m: contact.stiffness_n_per_m,
                displacement,
                near,
            })
        })
        .collect()
}

impl TruthSite {
    /// How far a force (along the normal) and a field at some depth are from this site.
    pub(crate) fn distance(&self, depth_m: f64, force_n: f64, field: &[DVec3]) -> Distance {
        let found = field.iter().map(|&moved| moved / depth_m);
        let error = errors::field_error(&self.displacement, found, |vertex| self.near[vertex]);
        let exact_n = self.stiffness_n_per_m * depth_m;
        Distance {
            force: ((force_n - exact_n) / exact_n).abs(),
            full: error.full_rel_l2,
            near: error.near_rel_l2,
            worst: error.worst_rel,
        }
    }
}

/// One part of a distance.
pub(crate) type Part = fn(&Distance) -> f64;

/// Distances at several sites.
#[derive(Clone, Debug)]
pub(crate) struct Score(pub(crate) Vec<(usize, Distance)>);

impl Score {
    /// The median of one part over the sites.
    pub(crate) fn median(&self, part: Part) -> f64 {
        errors::median(self.0.iter().map(|(_, distance)| part(distance)).collect())
    }

    /// The largest of one part over the sites.
    pub(crate) fn worst(&self, part: Part) -> f64 {
        self.0.iter().map(|(_, distance)| part(distance)).fold(0.0, f64::max)
    }
}
