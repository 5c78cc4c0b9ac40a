//! Which vertices a rigid flat disc touches.

use glam::DVec3;
use rhombus_chain::SurfaceMesh;

/// The vertices a rigid flat disc of `radius_m` touches that lies at `vertex` with the unit outward `normal`: ascending,
/// and always with `vertex` itself.
///
/// A vertex is touched when it lies within the radius of the site in the tangent plane, belongs to a face that looks
/// towards the disc, and lies no deeper than the radius below the tangent plane: the near side. An unknown vertex touches
/// nothing.
#[must_use]
pub fn patch(surface: &SurfaceMesh, vertex: u32, normal: DVec3, radius_m: f64) -> Vec<u32> {
    let Some(&site) = surface.vertices().get(vertex as usize) else {
        return Vec::new();
    };
    let within = |corner: u32| {
        let offset = surface.vertices()[corner as usize] - site;
        let height = offset.dot(normal);
        (offset - normal * height).length() <= radius_m * (1.0 + 1e-9) && height >= -radius_m
    };
    let mut touched = vec![vertex];
    for (face, corners) in (0u32..).zip(surface.triangles()) {
        if surface.face_normal(face).dot(normal) > 0.0 {
            touched.extend(corners.iter().copied().filter(|&corner| within(corner)));
        }
    }
    touched.sort_unstable();
    touched.dedup();
    touched
}

#[cfg(test)]
mod tests {
    use super::patch;
    use crate::TetMesh;
    use glam::DVec3;

    #[test]
    fn a_disc_on_a_plate_touches_its_near_side_only() {
        let cells: Vec<f64> = (0..=8).map(|k| 0.005 * f64::from(k)).collect();
        let (surface, _) = TetMesh::block(&cells, &cells, &[0.0, 0.004]);
        let site = DVec3::new(0.02, 0.02, 0.004);
        let vertex = (0u32..).zip(surface.vertices()).find(|(_, at)| at.distance(site) < 1e-12).unwrap().0;
        let touched = patch(&surface, vertex, DVec3::Z, 0.005);
        assert_eq!(touched.len(), 5, "the centre and its four neighbours");
        assert!(touched.contains(&vertex) && touched.is_sorted());
        assert!(touched.iter().all(|&v| surface.vertices()[v as usize].z == 0.004));
        assert_eq!(patch(&surface, vertex, DVec3::Z, 0.0), [vertex]);
    }
}
