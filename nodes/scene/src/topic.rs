//! Names of topics that the model hears and speaks on, relative to its namespace or that of a device.

/// Pose of the device's handle.
pub const MEASURED_CP: &str = "measured_cp";
/// Opening of the gripper.
pub const GRIPPER_MEASURED_JS: &str = "gripper/measured_js";
/// Hold the surface.
pub const GRASP: &str = "grasp";
/// Let the hand move without the probe.
pub const CLUTCH: &str = "clutch";
/// Where the hand of a pointer device is asked to go.
pub const POINTER_TARGET: &str = "pointer_target";
/// Force on the hand.
pub const SERVO_CF: &str = "servo_cf";
/// What a motor loop needs until the next force.
pub const CONTACT_LAW: &str = "contact_law";
/// The contact.
pub const CONTACT_STATE: &str = "contact_state";
/// How far the surface is from rest; one for the session, as the next.
pub const SURFACE_DISPLACEMENT: &str = "surface_displacement";
/// The rest surface.
pub const BODY_MESH: &str = "body_mesh";
/// Transforms that move.
pub const TF: &str = "/tf";
/// Transforms that stay.
pub const TF_STATIC: &str = "/tf_static";

/// The absolute name of a topic: relative names stand in the namespace of the node ("/" for none).
pub fn absolute(namespace: &str, name: &str) -> String {
    if name.starts_with('/') {
        name.to_owned()
    } else {
        format!("{}/{name}", namespace.trim_end_matches('/'))
    }
}

/// The absolute name of a device's topic. `device` is the device's sub-namespace; "" is the node's own.
pub fn of_device(namespace: &str, device: &str, name: &str) -> String {
    match device.trim_end_matches('/') {
        "" => absolute(namespace, name),
        device => absolute(namespace, &format!("{device}/{name}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_devices_topics_stand_in_its_sub_namespace_and_absolute_names_where_they_say() {
        assert_eq!(of_device("/", "", MEASURED_CP), "/measured_cp");
        assert_eq!(of_device("/or", "left/", MEASURED_CP), "/or/left/measured_cp");
        assert_eq!(of_device("/or", "/arm", MEASURED_CP), "/arm/measured_cp");
        assert_eq!(absolute("/or/", TF), "/tf");
        assert_eq!(absolute("/or/", GRASP), "/or/grasp");
    }
}
