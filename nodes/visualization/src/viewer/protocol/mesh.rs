//! MESH: the rest surface, and how stiff it is where.

use super::{Kind, message, put_u32, put_vector};
use crate::surface::BodySurface;

/// The rest surface; `factors` has one stiffness factor for each vertex, where there is a map.
pub(crate) fn mesh(sequence: u32, surface: &BodySurface, factors: Option<&[f32]>) -> Vec<u8> {
    let (rest_m, triangles) = (surface.rest_m(), surface.triangles());
    let mut mesh = message(Kind::Mesh, sequence, 16 * (1 + rest_m.len()) + 12 * triangles.len());
    put_u32(&mut mesh, surface.topology_version());
    // A mesh message has at most 2^32 entries.
    put_u32(&mut mesh, rest_m.len() as u32);
    put_u32(&mut mesh, triangles.len() as u32);
    put_u32(&mut mesh, u32::from(factors.is_some()));
    rest_m.iter().for_each(|position| put_vector(&mut mesh, *position));
    triangles.iter().flatten().for_each(|corner| put_u32(&mut mesh, *corner));
    for factor in factors.unwrap_or_default() {
        mesh.extend_from_slice(&factor.to_le_bytes());
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn a_mesh_has_its_counts_then_positions_corners_and_factors() {
        let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        let surface = BodySurface::new(corners, vec![[0, 1, 2]], 0xabcd).unwrap();
        let bytes = mesh(5, &surface, Some(&[1.0, 2.0, 0.5]));
        assert_eq!(bytes.len(), 8 + 16 + 36 + 12 + 12);
        assert_eq!(bytes[..8], [1, 0, 0, 0, 5, 0, 0, 0]);
        let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        assert_eq!([number(8), number(12), number(16), number(20)], [0xabcd, 3, 1, 1]);
        let float = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        assert_eq!([float(24 + 12), float(24 + 28)], [1.0, 1.0], "x of vertex 1, y of vertex 2");
        assert_eq!([number(60), number(64), number(68)], [0, 1, 2]);
        assert_eq!([float(72), float(76), float(80)], [1.0, 2.0, 0.5]);
        assert_eq!(mesh(5, &surface, None).len(), bytes.len() - 12);
    }
}
