//! The topics of a session: who tells whom, and which of them stay silent in a scene.

use crate::{Scene, topic};

/// A topic of the session.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlannedTopic {
    /// Name relative to the namespace of the session; a leading `/` is global.
    pub name: String,
    /// ROS message type, `package/Type`.
    pub message: &'static str,
    /// Who publishes.
    pub from: &'static str,
    /// Who of the session subscribes.
    pub to: &'static str,
    /// Whether messages flow.
    pub state: TopicState,
}

/// Whether messages flow on a topic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TopicState {
    /// They do.
    Active,
    /// The topic is there, nothing is published; the text says why.
    Silent(&'static str),
    /// Nobody publishes the topic; the text says why.
    Absent(&'static str),
}

/// Name, message, from, to.
type Row = (&'static str, &'static str, &'static str, &'static str);

/// One of each for every device.
const DEVICE: [Row; 23] = [
    (topic::MEASURED_CP, "geometry_msgs/PoseStamped", "haptic_device", "deformation, visualization"),
    ("measured_cv", "geometry_msgs/TwistStamped", "haptic_device", ""),
    ("measured_cf", "geometry_msgs/WrenchStamped", "haptic_device", ""),
    ("spatial/measured_cf", "geometry_msgs/WrenchStamped", "haptic_device", ""),
    ("body/measured_cf", "geometry_msgs/WrenchStamped", "haptic_device", ""),
    ("measured_js", "sensor_msgs/JointState", "haptic_device", ""),
    (topic::GRIPPER_MEASURED_JS, "sensor_msgs/JointState", "haptic_device", "deformation"),
    ("operating_state", "crtk_msgs/OperatingState", "haptic_device", "visualization"),
    ("state_command", "crtk_msgs/StringStamped", "anyone", "haptic_device"),
    ("emergency_stop", "std_msgs/Bool", "anyone", "haptic_device"),
    (topic::POINTER_TARGET, "geometry_msgs/PoseStamped", "visualization", "haptic_device"),
    ("hold", "std_msgs/Empty", "anyone", "haptic_device"),
    ("free", "std_msgs/Empty", "anyone", "haptic_device"),
    ("use_gravity_compensation", "std_msgs/Bool", "anyone", "haptic_device"),
    ("body/set_cf_orientation_absolute", "std_msgs/Bool", "anyone", "haptic_device"),
    (topic::GRASP, "std_msgs/Bool", "visualization, anyone", "deformation"),
    (topic::CLUTCH, "sensor_msgs/Joy", "haptic_device", "deformation"),
    (topic::SERVO_CF, "geometry_msgs/WrenchStamped", "deformation", "haptic_device, visualization"),
    ("spatial/servo_cf", "geometry_msgs/WrenchStamped", "anyone", "haptic_device"),
    ("body/servo_cf", "geometry_msgs/WrenchStamped", "anyone", "haptic_device"),
    ("gripper/servo_jf", "sensor_msgs/JointState", "anyone", "haptic_device"),
    (topic::CONTACT_LAW, "rhombus_haptics_msgs/ContactLaw", "deformation", "haptic_device"),
    (topic::CONTACT_STATE, "rhombus_haptics_msgs/ContactState", "deformation", "visualization"),
];

/// One for the session; `~` is the node that publishes.
const SESSION: [Row; 12] = [
    (topic::SURFACE_DISPLACEMENT, "rhombus_haptics_msgs/SurfaceDisplacement", "deformation", "visualization"),
    (topic::BODY_MESH, "shape_msgs/Mesh", "deformation", "visualization"),
    ("buttons_heard", "std_msgs/UInt64", "deformation", "bag_replay"),
    ("transforms_heard", "std_msgs/UInt64", "deformation", "bag_replay"),
    ("markers", "visualization_msgs/MarkerArray", "visualization", ""),
    ("~/transition_event", "lifecycle_msgs/TransitionEvent", "haptic_device", ""),
    ("/diagnostics", "diagnostic_msgs/DiagnosticArray", "every node", "visualization"),
    ("/rosout", "rcl_interfaces/Log", "every node", ""),
    ("/parameter_events", "rcl_interfaces/ParameterEvent", "every node", "visualization"),
    ("/clock", "rosgraph_msgs/Clock", "anyone", "every node"),
    (topic::TF, "tf2_msgs/TFMessage", "haptic_device, visualization", "deformation, visualization"),
    (topic::TF_STATIC, "tf2_msgs/TFMessage", "visualization", "deformation, visualization"),
];

pub(super) fn planned(scene: &Scene) -> Vec<PlannedTopic> {
    let devices = scene.session.devices.iter().flat_map(|device| {
        DEVICE.into_iter().map(move |(name, message, from, to)| {
            let name = match device.trim_end_matches('/') {
                "" => name.to_owned(),
                device => format!("{device}/{name}"),
            };
            (name, message, from, to)
        })
    });
    let session = SESSION.into_iter().map(|(name, message, from, to)| (name.to_owned(), message, from, to));
    devices
        .chain(session)
        .map(|(name, message, from, to)| {
            let state = state(scene, &name);
            PlannedTopic { name, message, from, to, state }
        })
        .collect()
}

fn state(scene: &Scene, topic: &str) -> TopicState {
    let is_virtual = scene.device.is_virtual();
    if topic.ends_with("gripper/servo_jf") && is_virtual {
        return TopicState::Absent("a simulated hand has no gripper with a motor");
    }
    match topic.rsplit('/').next().unwrap_or_default() {
        "use_gravity_compensation" if is_virtual => TopicState::Absent("a simulated hand has no weight"),
        "measured_js" if topic.ends_with("gripper/measured_js") && scene.device.backend == "pointer" => {
            TopicState::Absent("the pointer's hand has no gripper; it holds by grasp")
        }
        "pointer_target" if scene.device.backend != "pointer" => {
            TopicState::Absent("device.backend is not pointer")
        }
        "surface_displacement" if scene.surface.rate_hz <= 0.0 => TopicState::Absent("surface.rate is 0"),
        "buttons_heard" | "transforms_heard" if !scene.replay.lockstep => {
            TopicState::Absent("replay.lockstep is false")
        }
        "markers" if !scene.has_markers() => TopicState::Silent("visualization.rate is 0"),
        "clutch" if scene.session.clutch_button.is_none() => TopicState::Absent("clutch.button is \"\""),
        "clock" if !scene.session.use_sim_time => TopicState::Absent("use_sim_time is false"),
        _ => TopicState::Active,
    }
}
