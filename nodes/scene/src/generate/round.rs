//! Surfaces that are a smooth image of the unit sphere, with any number of vertices.

use glam::DVec3;

use super::{Shape, relax, rings};

/// A smooth, invertible map of space that turns the unit sphere into a body's surface. Being invertible everywhere is
/// what keeps the surface from meeting itself.
pub(super) trait RoundBody {
    /// Image of a point of the unit ball, m.
    fn body_from_ball(&self, point_in_ball: DVec3) -> DVec3;
    /// The inverse.
    fn ball_from_body(&self, point_in_body: DVec3) -> DVec3;
}

/// A sphere.
pub(super) struct Ball {
    pub(super) radius_m: f64,
}

impl RoundBody for Ball {
    fn body_from_ball(&self, point_in_ball: DVec3) -> DVec3 {
        point_in_ball * self.radius_m
    }

    fn ball_from_body(&self, point_in_body: DVec3) -> DVec3 {
        point_in_body / self.radius_m
    }
}

/// Relaxation steps. From 10 on the edge lengths hardly change.
const STEPS: usize = 20;

/// Rings of vertices around the long axis, then relaxed to even, well-shaped triangles.
pub(super) fn generate(body: &impl RoundBody, vertices: usize) -> Shape {
    let (on_sphere, triangles) = rings::triangulate(body, vertices);
    let positions = on_sphere.iter().map(|p| body.body_from_ball(*p)).collect();
    let mut surface = relax::Surface::new(positions, triangles);
    for _ in 0..STEPS {
        surface.flip_to_delaunay();
        // Pulled towards the middle of its neighbours a vertex leaves the surface a little; back in the ball,
        // projection to the sphere is a division.
        surface.smooth(|pulled| {
            let direction = body.ball_from_body(pulled).normalize_or(DVec3::X);
            body.body_from_ball(direction)
        });
    }
    surface.flip_to_delaunay();
    surface.into_shape()
}
