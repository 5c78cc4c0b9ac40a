//! How far the model is from reference solutions, site by site, by the way a session takes: [`ContactLaw`], regional
//! stiffness and [`SurfaceField`].
//!
//! [`ContactLaw`]: rhombus_chain::ContactLaw

use glam::DVec3;
use rhombus_chain::{Body, Impression, SurfaceField, SurfaceMesh, SurfacePoint, Tissue};

use super::fitted::FitError;
use crate::reference::Reference;

/// Sites of a reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    /// Those that a calibration may use.
    Used,
    /// Those that only judge.
    HeldOut,
}

/// The model beside the reference at one site. Every error is a share: 0.02 is 2 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SiteError {
    /// Number of the site in the reference.
    pub site: usize,
    /// `|F - F_ref| / F_ref`.
    pub force_rel: f64,
    /// Relative L2 of the displacement vectors of all vertices within [`NEAR_M`] of the contact.
    pub near_rel_l2: f64,
    /// Relative L2 of the displacement vectors of all vertices.
    pub full_rel_l2: f64,
    /// The vertex with the largest error of its displacement vector ...
    pub worst_vertex: u32,
    /// ... and that error as a share of the depth.
    pub worst_rel: f64,
}

/// What counts as near the contact, m, straight.
pub const NEAR_M: f64 = 0.030;

/// Compares the model with the reference, as deep at each site as its contact is wide (its radius).
///
/// # Errors
/// The reference is of another mesh, or has several contacts at once.
pub fn at_sites(
    body: &Body,
    tissue: &Tissue,
    reference: &Reference,
    which: Which,
) -> Result<Vec<SiteError>, FitError> {
    let sites = match which {
        Which::Used => reference.used(),
        Which::HeldOut => reference.held_out(),
    };
    let Some(depth_m) = sites.first().map(|site| reference.sites[*site].contact_radius_m) else {
        return Ok(Vec::new());
    };
    at_depth(body, tissue, reference, &sites, depth_m)
}

/// Compares the model with the reference (scaled: it is linear) at some of its sites and one depth.
///
/// # Errors
/// As [`at_sites`]; a depth that is not finite or 0.
pub fn at_depth(
    body: &Body,
    tissue: &Tissue,
    reference: &Reference,
    sites: &[usize],
    depth_m: f64,
) -> Result<Vec<SiteError>, FitError> {
    reference.check_mesh(body.mesh()).map_err(|error| FitError::Data(error.to_string()))?;
    if depth_m == 0.0 {
        return Err(FitError::Input { name: "depth", value: depth_m, accepted: "a finite number, not 0" });
    }
    let mut field = SurfaceField::new(body, tissue);
    let mut moved = vec![DVec3::ZERO; body.mesh().vertices().len()];
    sites
        .iter()
        .map(|site| {
            let solution = &reference.sites[*site];
            let contact = one_contact(reference, *site)?;
            let at = at_vertex(body.mesh(), contact.vertex)
                .ok_or_else(|| FitError::Data(format!("no triangle has vertex {}", contact.vertex)))?;
            let response =
                tissue.law().at_depth(depth_m).map_err(|error| FitError::Data(error.to_string()))?;
            let factor = body.stiffness().map_or(1.0, |map| map.at(&at));
            let exact_n = contact.stiffness_n_per_m * depth_m;
            let impression = Impression {
                at,
                position: body.mesh().position(at),
                normal: body.mesh().normal(at),
                depth_m,
                lateral_m: DVec3::ZERO,
            };
            field.update(body, tissue, [impression]);
            moved.fill(DVec3::ZERO);
            for (vertex, displacement) in field.vertices().iter().zip(field.displacements()) {
                moved[*vertex as usize] = *displacement / depth_m;
            }
            let force_rel = ((factor * response.force_n - exact_n) / exact_n).abs();
            let is_near = |vertex: usize| body.mesh().vertices()[vertex].distance(contact.point) <= NEAR_M;
            let FieldError { near_rel_l2, full_rel_l2, worst_vertex, worst_rel } =
                field_error(&solution.displacement, moved.iter().copied(), is_near);
            Ok(SiteError { site: *site, force_rel, near_rel_l2, full_rel_l2, worst_vertex, worst_rel })
        })
        .collect()
}

/// The only contact of a site.
pub(super) fn one_contact(
    reference: &Reference,
    site: usize,
) -> Result<crate::reference::ReferenceContact, FitError> {
    match reference.sites[site].contacts[..] {
        [contact] => Ok(contact),
        ref contacts => Err(FitError::Data(format!(
            "{}: site {site} (from 0) has {} contacts at once; accepted: one",
            reference.file,
            contacts.len()
        ))),
    }
}

/// A vertex as a point of the surface.
pub(super) fn at_vertex(mesh: &SurfaceMesh, vertex: u32) -> Option<SurfacePoint> {
    mesh.triangles().iter().enumerate().find_map(|(face, corners)| {
        let corner = corners.iter().position(|corner| *corner == vertex)?;
        Some(SurfacePoint { face: face as u32, barycentric: DVec3::AXES[corner] })
    })
}

/// How far a field is from the exact one. Every error is a share.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldError {
    /// Relative L2 of the displacement vectors of the vertices that are near.
    pub near_rel_l2: f64,
    /// Relative L2 of all displacement vectors.
    pub full_rel_l2: f64,
    /// The vertex with the largest error of its displacement vector ...
    pub worst_vertex: u32,
    /// ... and that error as a share of the depth.
    pub worst_rel: f64,
}

/// Compares two fields, both displacements of all vertices for each metre of depth. `is_near`: whether a vertex is within
/// [`NEAR_M`] of the contact.
pub fn field_error(
    exact: &[DVec3],
    found: impl IntoIterator<Item = DVec3>,
    is_near: impl Fn(usize) -> bool,
) -> FieldError {
    let (mut near, mut near_all, mut full, mut full_all) = (0.0, 0.0, 0.0, 0.0);
    let (mut worst_vertex, mut worst) = (0, 0.0);
    for (vertex, (exact, found)) in exact.iter().zip(found).enumerate() {
        let (error, all) = ((found - *exact).length_squared(), exact.length_squared());
        full += error;
        full_all += all;
        if is_near(vertex) {
            near += error;
            near_all += all;
        }
        if error > worst {
            (worst_vertex, worst) = (vertex as u32, error);
        }
    }
    FieldError {
        near_rel_l2: (near / near_all).sqrt(),
        full_rel_l2: (full / full_all).sqrt(),
        worst_vertex,
        worst_rel: worst.sqrt(),
    }
}

/// The median of errors; 0 of none.
#[must_use]
pub fn median(mut errors: Vec<f64>) -> f64 {
    errors.sort_by(f64::total_cmp);
    match errors.len() {
        0 => 0.0,
        n if n % 2 == 1 => errors[n / 2],
        n => 0.5 * (errors[n / 2 - 1] + errors[n / 2]),
    }
}
