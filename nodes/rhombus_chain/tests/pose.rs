//! Poses compose as their names say, and refuse what is no pose.
#![allow(clippy::expect_used, reason = "a test whose case cannot be set up fails")]

use glam::DVec3;
use proptest::prelude::*;
use rhombus_chain::{Pose, PoseError};

fn poses() -> impl Strategy<Value = Pose> {
    let position = prop::array::uniform3(-10.0..10.0_f64);
    let quaternion = prop::array::uniform4(-1.0..1.0_f64)
        .prop_filter("a direction", |q| q.iter().map(|c| c * c).sum::<f64>() > 1e-3);
    (position, quaternion).prop_map(|([x, y, z], quaternion)| {
        let norm = quaternion.iter().map(|c| c * c).sum::<f64>().sqrt();
        let [qx, qy, qz, qw] = quaternion.map(|component| component / norm);
        Pose::from_array([x, y, z, qx, qy, qz, qw]).expect("a pose")
    })
}

proptest! {
    #[test]
    fn a_pose_after_its_inverse_changes_nothing(pose in poses(), point in prop::array::uniform3(-10.0..10.0_f64)) {
        let point = DVec3::from_array(point);
        prop_assert!(pose.inverse().transform_point(pose.transform_point(point)).distance(point) < 1e-13);
        prop_assert!((pose.inverse() * pose).transform_point(point).distance(point) < 1e-13);
    }

    #[test]
    fn poses_compose_from_right_to_left(a_from_b in poses(), b_from_c in poses(), point in prop::array::uniform3(-10.0..10.0_f64)) {
        let in_c = DVec3::from_array(point);
        let in_a = a_from_b.transform_point(b_from_c.transform_point(in_c));
        prop_assert!((a_from_b * b_from_c).transform_point(in_c).distance(in_a) < 1e-13);
        let direction = a_from_b.rotate(b_from_c.rotate(in_c));
        prop_assert!((a_from_b * b_from_c).rotate(in_c).distance(direction) < 1e-13);
    }

    #[test]
    fn a_pose_survives_its_array(pose in poses()) {
        let again = Pose::from_array(pose.to_array()).expect("a pose");
        prop_assert!(again.translation == pose.translation);
        prop_assert!(again.rotation.abs_diff_eq(pose.rotation, 1e-15));
    }
}

#[test]
fn a_quarter_turn_about_z_takes_x_to_y() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let pose = Pose::from_array([1.0, 2.0, 3.0, 0.0, 0.0, half, half]).expect("a pose");
    assert!(pose.rotate(DVec3::X).distance(DVec3::Y) < 1e-15);
    assert!(pose.transform_point(DVec3::X).distance(DVec3::new(1.0, 3.0, 3.0)) < 1e-15);
    assert_eq!(Pose::from_array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]), Ok(Pose::default()));
}

#[test]
fn a_quaternion_is_normalised_within_a_thousandth_and_refused_beyond() {
    let pose = Pose::from_array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.000_9]).expect("close enough");
    assert_eq!(pose, Pose::IDENTITY);
    for norm in [0.0, 0.998_9, 1.001_1, 1e200] {
        let refused = Pose::from_array([0.0, 0.0, 0.0, norm, 0.0, 0.0, 0.0]).expect_err("no rotation");
        assert!(matches!(refused, PoseError::NotUnit { .. }));
        assert!(refused.to_string().contains("accepted is 1 within 0.001"));
    }
}

#[test]
fn a_number_that_is_none_is_refused_by_its_place() {
    for index in 0..7 {
        let mut array = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
        array[index] = f64::NAN;
        let refused = Pose::from_array(array).expect_err("no pose").to_string();
        assert!(refused.contains(&format!("entry {index} is NaN")), "{refused}");
    }
}
