//! How a device stands to the body, for hands that are not real and have to find it.

use devices::Workspace;
use glam::DVec3;
use rhombus_chain::{Body, Pose};
use scene::Scene;

/// How the device stands to the body: `device_point = base_from_body * body_point / motion_scale`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placement {
    /// From the body frame to the frame of the device's base, without the motion scale.
    pub(crate) base_from_body: Pose,
    /// Motion in the scene for each metre of motion of the device.
    pub(crate) motion_scale: f64,
}

impl Placement {
    /// As the scene's parameters say.
    pub(crate) fn new(scene: &Scene) -> Placement {
        Placement {
            base_from_body: scene.device.scene_from_device.inverse() * scene.body.scene_from_body,
            motion_scale: scene.device.motion_scale,
        }
    }

    /// A point of the body frame, in the device frame. m.
    pub(crate) fn to_device(self, point_in_body: DVec3) -> DVec3 {
        self.base_from_body.transform_point(point_in_body) / self.motion_scale
    }

    /// Height (device z, m) of what is highest of the body within the reach of the device; negative infinity when nothing is.
    pub(crate) fn top_m(self, body: &Body, workspace: &Workspace) -> f64 {
        let points = body.mesh().vertices().iter().map(|&vertex| self.to_device(vertex));
        points
            .filter(|point| point.truncate().length() <= workspace.radius_m)
            .map(|point| point.z)
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// A place in the workspace over the middle of the body, `clearance_m` (in the scene) above its top.
    #[cfg(feature = "pointer")]
    pub(crate) fn above(self, body: &Body, workspace: &Workspace, clearance_m: f64) -> DVec3 {
        let [low, high] = body.mesh().extents();
        let middle = self.to_device(0.5 * (low + high));
        let top_m = self.top_m(body, workspace);
        let height_m = if top_m.is_finite() { top_m + clearance_m / self.motion_scale } else { 0.0 };
        workspace.nearest(middle.with_z(height_m))
    }
}

#[cfg(feature = "pointer")]
#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;
    use rhombus_chain::SurfaceMesh;

    const WORKSPACE: Workspace = devices::hand::LIMITS.workspace;

    fn block() -> Body {
        let shape = scene::generate::body(scene::BodyKind::Block, 500);
        Body::new(SurfaceMesh::new(shape.vertices, shape.triangles).unwrap())
    }

    #[test]
    fn a_hand_that_is_not_led_yet_waits_over_the_body_clear_of_it() {
        let body = block();
        let turned =
            Pose { translation: DVec3::new(0.03, 0.0, -0.05), rotation: DQuat::from_rotation_x(3.0) };
        for (base_from_body, motion_scale) in [(Pose::IDENTITY, 1.0), (turned, 1.0), (turned, 2.0)] {
            let placement = Placement { base_from_body, motion_scale };
            let at = placement.above(&body, &WORKSPACE, 0.02);
            assert!(WORKSPACE.contains(at), "{at}");
            let in_body = base_from_body.inverse().transform_point(at * motion_scale);
            let distance_m = body.index().closest(body.mesh(), in_body, 1.0).unwrap().1;
            assert!(
                !body.index().encloses(body.mesh(), in_body) && distance_m > 0.015,
                "{at}: {distance_m} m"
            );
        }
    }

    #[test]
    fn a_body_out_of_reach_leaves_it_in_the_workspace() {
        let far = Pose { translation: DVec3::new(5.0, 0.0, -3.0), rotation: DQuat::IDENTITY };
        let placement = Placement { base_from_body: far, motion_scale: 1.0 };
        assert!(WORKSPACE.contains(placement.above(&block(), &WORKSPACE, 0.02) * (1.0 - 1e-12)));
    }
}
