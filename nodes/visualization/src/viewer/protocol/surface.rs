//! SURFACE: how far each moved vertex is from rest.

use super::{Kind, message, put_f64, put_u32};
use crate::surface::BodySurface;

/// The displacement as it was heard, with the stamp of its newest pose.
pub(crate) fn surface(sequence: u32, surface: &BodySurface, stamp_s: f64) -> Vec<u8> {
    let (vertices, displacement_m) = surface.displaced();
    let mut moved = message(Kind::Surface, sequence, 16 * (1 + vertices.len()));
    put_u32(&mut moved, surface.topology_version());
    // A message lists at most 2^32 vertices.
    put_u32(&mut moved, vertices.len() as u32);
    put_f64(&mut moved, stamp_s);
    vertices.iter().for_each(|vertex| put_u32(&mut moved, *vertex));
    displacement_m.iter().for_each(|number| moved.extend_from_slice(&number.to_le_bytes()));
    moved
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn a_surface_lists_the_moved_vertices_with_the_bits_that_were_heard() {
        let mut body = BodySurface::new(vec![DVec3::ZERO; 4], vec![[0, 1, 2]], 9).unwrap();
        body.displace(9, vec![3], vec![0.1, -0.2, 0.3]).unwrap();
        let bytes = surface(1, &body, 12.5);
        assert_eq!(bytes.len(), 8 + 16 + 4 + 12);
        assert_eq!(bytes[..8], [2, 0, 0, 0, 1, 0, 0, 0]);
        assert_eq!(bytes[8..16], [9, 0, 0, 0, 1, 0, 0, 0]);
        assert_eq!(bytes[16..24], 12.5_f64.to_le_bytes());
        assert_eq!(bytes[24..28], [3, 0, 0, 0]);
        assert_eq!(bytes[32..36], (-0.2_f32).to_le_bytes());
    }
}
