//! From what the SDK writes to a pose, or a word on why it is none. RT safe.

use glam::{DMat3, DQuat, DVec3};
use rhombus_chain::Pose;

/// No handle of these devices gets farther than this from the device's middle, m: beyond, the answer is garbage.
const FARTHEST_M: f64 = 1.0;

/// How far a row's length or a product of two rows may be from a rotation's.
const TOLERANCE: f64 = 1e-3;

/// The pose of a position and a rotation matrix, its rows first as the SDK has them.
pub(super) fn pose(position: [f64; 3], rows: [[f64; 3]; 3]) -> Result<Pose, &'static str> {
    let translation = DVec3::from_array(position);
    if !translation.is_finite() {
        return Err("its position is not a finite number");
    }
    if translation.abs().max_element() > FARTHEST_M {
        return Err("its position is more than 1 m away from its middle");
    }
    let matrix = DMat3::from_cols_array_2d(&rows).transpose();
    // Not below the tolerance, rather than above it: NaN is refused too.
    let products = matrix * matrix.transpose() - DMat3::IDENTITY;
    let close = |column: DVec3| column.abs().max_element() < TOLERANCE && column.is_finite();
    if !(close(products.x_axis) && close(products.y_axis) && close(products.z_axis)) {
        return Err("its orientation frame is not a rotation");
    }
    if matrix.determinant() < 0.0 {
        return Err("its orientation frame is mirrored");
    }
    Ok(Pose { translation, rotation: DQuat::from_mat3(&matrix).normalize() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const UPRIGHT: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    #[test]
    fn the_rows_are_rows() {
        // A quarter turn about z takes x to y: its first column is y.
        let quarter = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let pose = pose([0.0; 3], quarter).unwrap();
        assert!((pose.rotation * DVec3::X).abs_diff_eq(DVec3::Y, 1e-12));
    }

    #[test]
    fn what_is_no_pose_says_why() {
        for (position, rows, word) in [
            ([f64::NAN, 0.0, 0.0], UPRIGHT, "finite"),
            ([0.0, f64::INFINITY, 0.0], UPRIGHT, "finite"),
            ([0.0, 0.0, -3.0], UPRIGHT, "1 m"),
            ([0.0; 3], [[0.0; 3]; 3], "rotation"),
            ([0.0; 3], [[f64::NAN; 3]; 3], "rotation"),
            ([0.0; 3], [[1.0, 0.0, f64::NAN], UPRIGHT[1], UPRIGHT[2]], "rotation"),
            ([0.0; 3], [[1.01, 0.0, 0.0], UPRIGHT[1], UPRIGHT[2]], "rotation"),
            ([0.0; 3], [[-1.0, 0.0, 0.0], UPRIGHT[1], UPRIGHT[2]], "mirrored"),
        ] {
            let error = pose(position, rows).unwrap_err();
            assert!(error.contains(word), "{error}");
        }
    }

    proptest! {
        #[test]
        fn every_rotation_comes_back(x in -1.0..1.0f64, y in -1.0..1.0f64, z in -1.0..1.0f64, w in 0.1..1.0f64) {
            let rotation = DQuat::from_xyzw(x, y, z, w).normalize();
            let rows = DMat3::from_quat(rotation).transpose().to_cols_array_2d();
            let pose = pose([0.0; 3], rows).unwrap();
            prop_assert!(pose.rotation.dot(rotation).abs() > 1.0 - 1e-12);
        }
    }
}
