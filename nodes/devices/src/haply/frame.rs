//! The service's frame and the device frame.
//!
//! The service (<https://docs.haply.co/inverseSDK/service>, "Coordinate System Convention"): right-handed, x right,
//! y forward, z up, origin on the mounting plate. The device frame has REP 103's axes: x forward, y left, z up. So one is
//! the other turned by a quarter about z.

use glam::{DQuat, DVec3};

/// A vector of the service in the device frame.
pub(super) fn device_from_service(v: DVec3) -> DVec3 {
    DVec3::new(v.y, -v.x, v.z)
}

/// A vector of the device frame in the service's.
pub(super) fn service_from_device(v: DVec3) -> DVec3 {
    DVec3::new(-v.y, v.x, v.z)
}

/// An orientation of the service in the device frame. A handle that the service does not see turned is not turned here
/// either: the axes of the handle itself change as those of the frame do.
pub(super) fn device_orientation_from_service(q: DQuat) -> DQuat {
    let axis = device_from_service(DVec3::new(q.x, q.y, q.z));
    DQuat::from_xyzw(axis.x, axis.y, axis.z, q.w)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forward_is_the_services_y_and_left_is_against_its_x() {
        assert_eq!(device_from_service(DVec3::Y), DVec3::X);
        assert_eq!(device_from_service(-DVec3::X), DVec3::Y);
        assert_eq!(device_from_service(DVec3::Z), DVec3::Z);
        assert_eq!(service_from_device(DVec3::X), DVec3::Y);
    }

    #[test]
    fn there_and_back_again_changes_nothing() {
        let v = DVec3::new(0.1, -0.2, 0.3);
        assert_eq!(device_from_service(service_from_device(v)), v);
        assert_eq!(service_from_device(device_from_service(v)), v);
    }

    #[test]
    fn turning_a_vector_is_the_same_in_either_frame() {
        let q = DQuat::from_xyzw(0.5, -0.1, 0.3, 0.7).normalize();
        let v = DVec3::new(0.4, 0.2, -0.9);
        let turned = device_orientation_from_service(q) * device_from_service(v);
        assert!((turned - device_from_service(q * v)).length() < 1e-12);
        assert_eq!(device_orientation_from_service(DQuat::IDENTITY), DQuat::IDENTITY);
    }
}
