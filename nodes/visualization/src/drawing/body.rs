//! The surface of the body, deformed and coloured by displacement.

use super::{Drawing, Key, Shape, Thing};
use crate::colour::{Colour, ColourScale};
use crate::surface::BodySurface;

/// The surface in its frame. Displacements are drawn `displacement_scale` times as large; the last colour of the scale
/// stands for a true displacement of `full_scale_m`.
pub(crate) fn body(
    surface: &BodySurface,
    frame_id: &str,
    colours: &ColourScale,
    full_scale_m: f64,
    displacement_scale: f64,
) -> Drawing {
    let (positions, vertex_colours): (Vec<_>, Vec<_>) = surface
        .vertices(displacement_scale)
        .map(|(position_m, displacement_m)| (position_m, colours.at(displacement_m / full_scale_m)))
        .unzip();
    let corners = || surface.triangles().iter().flatten().map(|vertex| *vertex as usize);
    Drawing {
        key: Key { thing: Thing::Body, id: 0 },
        frame_id: frame_id.to_owned(),
        shape: Shape::Triangles,
        points_m: corners().map(|vertex| positions[vertex]).collect(),
        colour: Colour::rgb(1.0, 1.0, 1.0),
        colours: corners().map(|vertex| vertex_colours[vertex]).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn square() -> BodySurface {
        let corners = vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
        BodySurface::new(corners, vec![[0, 1, 2], [0, 2, 3]], 1).unwrap()
    }

    #[test]
    fn every_triangle_of_the_mesh_is_drawn_with_its_deformed_corners() {
        let mut surface = square();
        surface.displace(1, vec![2], vec![0.0, 0.0, -0.5]).unwrap();
        let drawing = body(&surface, "body", &ColourScale::new(), 0.5, 1.0);
        assert_eq!(drawing.points_m.len(), 3 * surface.triangles().len());
        assert_eq!(drawing.colours.len(), drawing.points_m.len());
        let low = DVec3::new(1.0, 1.0, -0.5);
        assert_eq!(drawing.points_m, [DVec3::ZERO, DVec3::X, low, DVec3::ZERO, low, DVec3::Y]);
    }

    #[test]
    fn colour_follows_the_true_displacement_whatever_the_drawn_scale() {
        let (mut surface, scale) = (square(), ColourScale::new());
        surface.displace(1, vec![2], vec![0.0, 0.0, -0.25]).unwrap();
        for displacement_scale in [0.0, 1.0, 10.0] {
            let drawing = body(&surface, "body", &scale, 0.5, displacement_scale);
            assert_eq!((drawing.colours[0], drawing.colours[2]), (scale.at(0.0), scale.at(0.5)));
        }
    }
}
