//! The error of a calibrated body in words: by region, at sites that a fit did not use.

use glam::DVec3;
use rhombus_chain::SurfaceMesh;
use scene::RegionError;

use crate::calibrate::errors::{SiteError, median};

/// The errors at one site; shares of 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Judged {
    /// The vertex.
    pub(super) vertex: usize,
    /// Relative L2 of the whole field ...
    pub(super) field: f64,
    /// ... and of that near the contact.
    pub(super) near: f64,
    /// Relative error of the force.
    pub(super) force: f64,
}

/// Within so many contact radii of a held vertex a site is near where the body is held.
const NEAR_HELD: f64 = 4.0;
/// With less tissue behind it, in contact radii, a site is thin.
const THIN: f64 = 6.0;
/// Where the mean of the normals within so many contact radii is shorter than this, the surface turns as fast as on a ball
/// of about three contact radii: an edge.
const AROUND: f64 = 2.0;
const EDGED: f64 = 0.9;

/// Names of the regions.
const HELD: &str = "near where it is held";
const THIN_OR_EDGED: &str = "thin or edged";
const ELSEWHERE: &str = "elsewhere";
const ALL: &str = "all";
/// The sites of a reference that judges.
const REFERENCE: &str = "reference sites";

/// Where errors were found: each site in the first region that it belongs to, and all together.
pub(super) fn by_region(
    mesh: &SurfaceMesh,
    held: &[bool],
    contact_radius_m: f64,
    sites: &[Judged],
) -> Vec<RegionError> {
    let region = |site: &Judged| {
        if distance_to(mesh, held, site.vertex) < NEAR_HELD * contact_radius_m {
            HELD
        } else if thickness(mesh, site.vertex) < THIN * contact_radius_m
            || evenness(mesh, site.vertex, AROUND * contact_radius_m) < EDGED
        {
            THIN_OR_EDGED
        } else {
            ELSEWHERE
        }
    };
    let regions: Vec<&str> = sites.iter().map(region).collect();
    [HELD, THIN_OR_EDGED, ELSEWHERE, ALL]
        .into_iter()
        .filter_map(|name| {
            let here = sites.iter().zip(&regions).filter(|(_, region)| name == ALL || **region == name);
            summary(name, here.map(|(site, _)| *site).collect())
        })
        .collect()
}

/// The same of sites that a reference holds out.
pub(super) fn at_reference(sites: &[SiteError]) -> Option<RegionError> {
    let judged = |site: &SiteError| Judged {
        vertex: site.site,
        field: site.full_rel_l2,
        near: site.near_rel_l2,
        force: site.force_rel,
    };
    summary(REFERENCE, sites.iter().map(judged).collect())
}

fn summary(name: &str, sites: Vec<Judged>) -> Option<RegionError> {
    let of = |part: fn(&Judged) -> f64| {
        let all: Vec<f64> = sites.iter().map(part).collect();
        let largest = all.iter().copied().fold(0.0, f64::max);
        [median(all), largest]
    };
    (!sites.is_empty()).then(|| RegionError {
        region: name.to_owned(),
        sites: sites.len(),
        field: of(|site| site.field),
        near_field: of(|site| site.near),
        force: of(|site| site.force),
    })
}

fn distance_to(mesh: &SurfaceMesh, held: &[bool], vertex: usize) -> f64 {
    let point = mesh.vertices()[vertex];
    let held = mesh.vertices().iter().zip(held).filter(|(_, held)| **held);
    held.map(|(other, _)| other.distance(point)).fold(f64::INFINITY, f64::min)
}

/// Tissue behind a vertex against its normal, m.
fn thickness(mesh: &SurfaceMesh, vertex: usize) -> f64 {
    let (from, along) = (mesh.vertices()[vertex], -mesh.vertex_normals()[vertex]);
    let others = mesh.triangles().iter().enumerate().filter(|(_, t)| !t.contains(&(vertex as u32)));
    others.filter_map(|(face, _)| hit(from, along, mesh.corners(face as u32))).fold(f64::INFINITY, f64::min)
}

/// How far along a ray a triangle is, m (T. Moller and B. Trumbore, Journal of Graphics Tools 2, 1997).
fn hit(from: DVec3, along: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (u, v) = (b - a, c - a);
    let across = along.cross(v);
    let volume = u.dot(across);
    if volume == 0.0 {
        return None;
    }
    let offset = from - a;
    let turned = offset.cross(u);
    let (beta, gamma) = (offset.dot(across) / volume, along.dot(turned) / volume);
    let distance = v.dot(turned) / volume;
    (beta >= 0.0 && gamma >= 0.0 && beta + gamma <= 1.0 && distance > 0.0).then_some(distance)
}

/// Length of the mean normal around a vertex: 1 on a plane.
fn evenness(mesh: &SurfaceMesh, vertex: usize, within_m: f64) -> f64 {
    let (point, normal) = (mesh.vertices()[vertex], mesh.vertex_normals()[vertex]);
    let (mut sum, mut area) = (DVec3::ZERO, 0.0);
    for ((other, turned), weight) in
        mesh.vertices().iter().zip(mesh.vertex_normals()).zip(mesh.vertex_areas())
    {
        // The other side of a thin place is no part of this one.
        if other.distance(point) <= within_m && turned.dot(normal) > -0.5 {
            sum += *turned * *weight;
            area += weight;
        }
    }
    if area > 0.0 { sum.length() / area } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{BodyKind, generate};

    #[test]
    fn sites_of_a_block_fall_into_the_region_where_they_are() {
        let shape = generate::body(BodyKind::Block, 1500);
        let mesh = SurfaceMesh::new(shape.vertices, shape.triangles).unwrap();
        let held: Vec<bool> = mesh.vertex_normals().iter().map(|n| n.z < -0.7).collect();
        let [low, high] = mesh.extents();
        let nearest = |point: DVec3| {
            let distance = |vertex: &usize| mesh.vertices()[*vertex].distance(point);
            (0..mesh.vertices().len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap()
        };
        let middle = (low + high) / 2.0;
        let top = nearest(DVec3::new(middle.x, middle.y, high.z));
        let edge = nearest(DVec3::new(middle.x, high.y, high.z));
        let side = nearest(DVec3::new(middle.x, high.y, low.z + 0.2 * (high.z - low.z)));
        let thick = high.z - low.z;
        assert!((thickness(&mesh, top) - thick).abs() < 1e-9);
        let radius_m = 0.06 * thick;
        let site = |vertex, field| Judged { vertex, field, near: 0.5 * field, force: 0.1 * field };
        let found = by_region(&mesh, &held, radius_m, &[site(top, 0.1), site(edge, 0.3), site(side, 0.2)]);
        let of = |name: &str| found.iter().find(|region| region.region == name).map(|region| region.field);
        assert_eq!(of(HELD), Some([0.2, 0.2]));
        assert_eq!(of(THIN_OR_EDGED), Some([0.3, 0.3]));
        assert_eq!(of(ELSEWHERE), Some([0.1, 0.1]));
        assert_eq!(of(ALL), Some([0.2, 0.3]));
    }
}
