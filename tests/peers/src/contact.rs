//! What a rigid flat disc touches.

use std::collections::BTreeMap;

use glam::DVec3;
use rhombus_chain::SurfaceMesh;

/// The vertices a rigid flat disc of `radius_m` touches that lies at `vertex` with the unit outward `normal`: ascending,
/// and always with `vertex` itself.
///
/// A vertex is touched when it lies within the radius of the site in the tangent plane, belongs to a face that looks
/// towards the disc, and lies no farther than the radius from the tangent plane: the near side. An unknown vertex touches
/// nothing.
#[must_use]
pub fn patch(surface: &SurfaceMesh, vertex: u32, normal: DVec3, radius_m: f64) -> Vec<u32> {
    let Some(disc) = Disc::new(surface, vertex, normal, radius_m) else {
        return Vec::new();
    };
    let corners = disc.faces(surface).flatten();
    let covered = corners.filter(|&corner| disc.covers(surface.vertices()[corner as usize]));
    let mut touched: Vec<u32> = covered.chain([vertex]).collect();
    touched.sort_unstable();
    touched.dedup();
    touched
}

/// A rigid flat disc.
struct Disc {
    site: DVec3,
    normal: DVec3,
    radius_m: f64,
}

impl Disc {
    fn new(surface: &SurfaceMesh, vertex: u32, normal: DVec3, radius_m: f64) -> Option<Self> {
        let &site = surface.vertices().get(vertex as usize)?;
        Some(Self { site, normal, radius_m })
    }

    fn covers(&self, point: DVec3) -> bool {
        let offset = point - self.site;
        let height = offset.dot(self.normal);
        let reach = self.radius_m * (1.0 + 1e-9);
        (offset - self.normal * height).length() <= reach && height.abs() <= reach
    }

    /// Corners of the faces that look towards it.
    fn faces<'a>(&self, surface: &'a SurfaceMesh) -> impl Iterator<Item = [u32; 3]> + use<'a> {
        let normal = self.normal;
        let faces = (0u32..).zip(surface.triangles());
        faces
            .filter(move |&(face, _)| surface.face_normal(face).dot(normal) > 0.0)
            .map(|(_, &corners)| corners)
    }
}

/// The points of a body on which a disc can act, numbered: the vertices that can move, then (elements of second order) the
/// middles of the surface's edges that can move.
pub(crate) struct ContactPoints {
    free: Vec<u32>,
    vertices: Vec<Option<u32>>,
    middles: BTreeMap<[u32; 2], u32>,
}

impl ContactPoints {
    /// The vertices that can move, and the middles of the edges given (ends ascending).
    pub(crate) fn new(fixed: &[bool], edges: impl IntoIterator<Item = [u32; 2]>) -> Self {
        let free: Vec<u32> =
            (0u32..).zip(fixed).filter(|&(_, &held)| !held).map(|(vertex, _)| vertex).collect();
        let mut vertices = vec![None; fixed.len()];
        for (number, &vertex) in (0u32..).zip(&free) {
            vertices[vertex as usize] = Some(number);
        }
        let mut middles: BTreeMap<[u32; 2], u32> = edges.into_iter().map(|edge| (edge, 0)).collect();
        for (number, middle) in (free.len() as u32..).zip(middles.values_mut()) {
            *middle = number;
        }
        Self { free, vertices, middles }
    }

    /// The points that are vertices: the first ones.
    pub(crate) fn vertices(&self) -> &[u32] {
        &self.free
    }

    /// The points that are middles of edges, in order, after the vertices.
    pub(crate) fn edges(&self) -> impl ExactSizeIterator<Item = [u32; 2]> + '_ {
        self.middles.keys().copied()
    }

    /// Number of points.
    pub(crate) fn len(&self) -> usize {
        self.free.len() + self.middles.len()
    }

    /// What the numbering takes, about.
    pub(crate) fn bytes(&self) -> u64 {
        let lists = size_of_val(&self.free[..]) + size_of_val(&self.vertices[..]);
        (lists + self.middles.len() * size_of::<([u32; 2], u32)>()) as u64
    }

    /// The points a disc touches.
    pub(crate) fn touched(
        &self,
        surface: &SurfaceMesh,
        vertex: u32,
        normal: DVec3,
        radius_m: f64,
    ) -> Vec<u32> {
        let touched = patch(surface, vertex, normal, radius_m);
        let mut points: Vec<u32> = touched
            .into_iter()
            .filter_map(|vertex| self.vertices.get(vertex as usize).copied().flatten())
            .collect();
        if self.middles.is_empty() {
            return points;
        }
        if let Some(disc) = Disc::new(surface, vertex, normal, radius_m) {
            let edges = disc.faces(surface).flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
            let middle = |[a, b]: [u32; 2]| {
                let at = (surface.vertices()[a as usize] + surface.vertices()[b as usize]) * 0.5;
                disc.covers(at).then(|| self.middles.get(&[a.min(b), a.max(b)]).copied()).flatten()
            };
            points.extend(edges.filter_map(middle));
        }
        points.sort_unstable();
        points.dedup();
        points
    }
}

#[cfg(test)]
mod tests {
    use super::{ContactPoints, patch};
    use crate::TetMesh;
    use glam::DVec3;

    #[test]
    fn a_disc_on_a_plate_touches_its_near_side_only() {
        let cells: Vec<f64> = (0..=8).map(|k| 0.005 * f64::from(k)).collect();
        let (surface, volume) = TetMesh::block(&cells, &cells, &[0.0, 0.004]);
        let site = DVec3::new(0.02, 0.02, 0.004);
        let vertex = (0u32..).zip(surface.vertices()).find(|(_, at)| at.distance(site) < 1e-12).unwrap().0;
        let touched = patch(&surface, vertex, DVec3::Z, 0.005);
        assert_eq!(touched.len(), 5, "the centre and its four neighbours");
        assert!(touched.contains(&vertex) && touched.is_sorted());
        assert!(touched.iter().all(|&v| surface.vertices()[v as usize].z == 0.004));
        assert_eq!(patch(&surface, vertex, DVec3::Z, 0.0), [vertex]);

        let edges = surface.triangles().iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let points = ContactPoints::new(&volume.fixed, edges.filter(|[a, b]| a < b));
        // Middles: 4 between the centre and its neighbours, 4 between neighbours or on diagonals of the centre's cells, at
        // half a diagonal.
        assert_eq!(points.touched(&surface, vertex, DVec3::Z, 0.005).len(), 5 + 8);
    }
}
