//! Position and orientation of one frame in another.

use std::ops::Mul;

use glam::{DQuat, DVec3};

/// Pose of a source frame in a target frame: `target_from_source`.
///
/// `scene_from_body.transform_point(point_in_body)` is the point in the scene frame, and
/// `scene_from_device = scene_from_body * body_from_device`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// Origin of the source frame in the target frame, m.
    pub translation: DVec3,
    /// Orientation of the source frame in the target frame; a unit quaternion.
    pub rotation: DQuat,
}

/// Why seven numbers are no pose.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum PoseError {
    /// A NaN or an infinity.
    #[error("pose [x, y, z, qx, qy, qz, qw]: entry {index} is {value}; every entry must be a finite number")]
    NonFinite {
        /// Index in the array, from 0.
        index: usize,
        /// The value received.
        value: f64,
    },
    /// A quaternion that is not a rotation.
    #[error("pose [x, y, z, qx, qy, qz, qw]: the quaternion's length is {norm}; accepted is 1 within 0.001")]
    NotUnit {
        /// Length of the quaternion received.
        norm: f64,
    },
}

impl Pose {
    /// Both frames coincide.
    pub const IDENTITY: Self = Self { translation: DVec3::ZERO, rotation: DQuat::IDENTITY };

    /// From `[x, y, z, qx, qy, qz, qw]` (m, quaternion as ROS orders it). RT safe.
    ///
    /// # Errors
    /// A NaN or infinite entry, or a quaternion whose length is not 1 within 1e-3. Inside that, it is normalised.
    pub fn from_array(array: [f64; 7]) -> Result<Self, PoseError> {
        const NORM_TOLERANCE: f64 = 1e-3;
        if let Some(index) = array.iter().position(|value| !value.is_finite()) {
            return Err(PoseError::NonFinite { index, value: array[index] });
        }
        let [x, y, z, qx, qy, qz, qw] = array;
        let quaternion = DQuat::from_xyzw(qx, qy, qz, qw);
        let norm = quaternion.length();
        if (norm - 1.0).abs() > NORM_TOLERANCE {
            return Err(PoseError::NotUnit { norm });
        }
        Ok(Self { translation: DVec3::new(x, y, z), rotation: quaternion * (1.0 / norm) })
    }

    /// `[x, y, z, qx, qy, qz, qw]`.
    pub fn to_array(&self) -> [f64; 7] {
        let (p, q) = (self.translation, self.rotation);
        [p.x, p.y, p.z, q.x, q.y, q.z, q.w]
    }

    /// `source_from_target`.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.conjugate();
        Self { translation: -(rotation * self.translation), rotation }
    }

    /// A point of the source frame, in the target frame. m.
    #[must_use]
    pub fn transform_point(&self, point_in_source: DVec3) -> DVec3 {
        self.translation + self.rotation * point_in_source
    }

    /// A direction, force or velocity of the source frame, in the target frame.
    #[must_use]
    pub fn rotate(&self, vector_in_source: DVec3) -> DVec3 {
        self.rotation * vector_in_source
    }
}

impl Default for Pose {
    fn default() -> Self {
        Self::IDENTITY
    }
}

/// `target_from_source = target_from_middle * middle_from_source`.
impl Mul for Pose {
    type Output = Self;

    fn mul(self, middle_from_source: Self) -> Self {
        Self {
            translation: self.transform_point(middle_from_source.translation),
            rotation: self.rotation * middle_from_source.rotation,
        }
    }
}
