//! Where vertices lie around a contact, and back from its frame into that of the body.

use glam::Vec4;

use crate::interaction::Impression;

use super::lanes::{Axes, dot, splat};
use super::tangent_frame;

/// As in `surface_field`, squared: where "away" loses its meaning.
const AWAY_FADES_BELOW_SQUARED: f32 = 0.2 * 0.2;

/// The contact's place, its normal, and the two vectors of its tangent frame.
pub(crate) struct ContactFrame {
    position: Axes,
    normal: Axes,
    first: Axes,
    second: Axes,
}

impl ContactFrame {
    pub(crate) fn new(impression: &Impression) -> Self {
        let [first, second] = tangent_frame(impression.normal);
        Self {
            position: splat(impression.position),
            normal: splat(impression.normal),
            first: splat(first),
            second: splat(second),
        }
    }

    /// Cosine and sine of the direction in which the vertices `at` lie: a unit vector, shorter behind a thin lobe, zero at
    /// the contact.
    #[inline(always)]
    pub(crate) fn direction(&self, at: &Axes) -> [Vec4; 2] {
        let position = &self.position;
        let offset = [at[0] - position[0], at[1] - position[1], at[2] - position[2]];
        let (x, y) = (dot(&offset, &self.first), dot(&offset, &self.second));
        let squared = (x * x + y * y).max(dot(&offset, &offset) * AWAY_FADES_BELOW_SQUARED);
        let scale = Vec4::from_array(squared.to_array().map(f32::sqrt));
        // At the contact x and y are zero.
        let inverse = Vec4::ONE / scale.max(Vec4::splat(f32::MIN_POSITIVE));
        [x * inverse, y * inverse]
    }

    /// The vectors that have these parts along the normal, the first and the second vector of the frame.
    #[inline(always)]
    pub(crate) fn in_body(&self, normal: Vec4, first: Vec4, second: Vec4) -> Axes {
        let along =
            |axis: usize| self.normal[axis] * normal + self.first[axis] * first + self.second[axis] * second;
        [along(0), along(1), along(2)]
    }
}
