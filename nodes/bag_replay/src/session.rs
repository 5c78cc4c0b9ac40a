//! The topics of a session, known before anybody publishes them.

use node_kit::topics::{self, Topic};
use r2r::QosProfile;

use crate::names::absolute;

/// A topic that a session has.
#[derive(Debug)]
pub(crate) struct SessionTopic {
    /// Absolute name.
    pub(crate) name: String,
    /// Such as `geometry_msgs/msg/PoseStamped`.
    pub(crate) type_name: String,
    /// As its publishers in this project offer it.
    pub(crate) qos: QosProfile,
}

/// Every topic of a session, with those of each device in the device's sub-namespace. What only viewers and logs need is
/// left out: it follows from the rest. A device's buttons have names of its own; see [`is_button`].
pub(crate) fn session_topics(namespace: &str, devices: &[String]) -> Vec<SessionTopic> {
    fn row<M>(name: String, topic: &Topic<M>) -> SessionTopic {
        SessionTopic { name, type_name: type_name_of::<M>(), qos: topic.qos() }
    }
    let mut rows = Vec::new();
    for device in devices {
        macro_rules! of_device {
            ($($topic:ident),+ $(,)?) => {
                $(rows.push(row(absolute(namespace, &topics::$topic.name_in(device)), &topics::$topic));)+
            };
        }
        of_device!(
            MEASURED_CP,
            MEASURED_CV,
            MEASURED_CF,
            SPATIAL_MEASURED_CF,
            BODY_MEASURED_CF,
            MEASURED_JS,
            GRIPPER_MEASURED_JS,
            OPERATING_STATE,
            STATE_COMMAND,
            EMERGENCY_STOP,
            HOLD,
            FREE,
            USE_GRAVITY_COMPENSATION,
            BODY_SET_CF_ORIENTATION_ABSOLUTE,
            GRASP,
            CLUTCH,
            SERVO_CF,
            SPATIAL_SERVO_CF,
            BODY_SERVO_CF,
            GRIPPER_SERVO_JF,
            CONTACT_LAW,
            CONTACT_STATE,
        );
    }
    macro_rules! of_session {
        ($($topic:ident),+ $(,)?) => {
            $(rows.push(row(absolute(namespace, topics::$topic.name()), &topics::$topic));)+
        };
    }
    of_session!(SURFACE_DISPLACEMENT, BODY_MESH, TF, TF_STATIC, DIAGNOSTICS);
    rows
}

/// Type of a button's topic.
pub(crate) const BUTTON_TYPE: &str = "sensor_msgs/msg/Joy";

/// As this project's drivers offer a button.
pub(crate) fn button_qos() -> QosProfile {
    topics::button("").qos()
}

/// Whether a topic of the graph is a button of one of the devices: a `Joy` right in the device's namespace, whatever the
/// device calls it.
pub(crate) fn is_button(namespace: &str, devices: &[String], name: &str, type_names: &[String]) -> bool {
    let Some((place, _)) = name.rsplit_once('/') else { return false };
    type_names.iter().any(|type_name| type_name == BUTTON_TYPE)
        && devices
            .iter()
            .any(|device| absolute(namespace, device.trim_end_matches('/')).trim_end_matches('/') == place)
}

/// "geometry_msgs/msg/PoseStamped" of r2r's type.
pub(crate) fn type_name_of<M>() -> String {
    let path = std::any::type_name::<M>();
    let words: Vec<&str> = path.rsplit("::").take(3).collect();
    words.into_iter().rev().collect::<Vec<_>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{Origin, Scene, Value};

    fn two() -> Vec<String> {
        vec!["left".to_owned(), "right".to_owned()]
    }

    #[test]
    fn each_device_has_its_topics_in_its_sub_namespace_and_no_name_comes_twice() {
        let mut names: Vec<_> = session_topics("/or", &two()).into_iter().map(|topic| topic.name).collect();
        assert!(names.contains(&"/or/left/measured_cp".to_owned()), "{names:?}");
        assert!(names.contains(&"/or/right/servo_cf".to_owned()), "{names:?}");
        assert!(names.contains(&"/or/surface_displacement".to_owned()), "{names:?}");
        assert!(names.contains(&"/tf_static".to_owned()), "{names:?}");
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count);
    }

    #[test]
    fn what_a_scene_announces_is_recorded_but_for_what_follows_from_the_rest() {
        let one = |name: &str, x| (format!("chains.{name}"), Value::DoubleArray(vec![x]));
        let mut values = vec![one("rod_length", 0.01), one("angle", 0.5), one("ratio", 0.8)];
        values.extend([one("normal_stiffness", 500.0), one("tangential_stiffness", 0.0)]);
        values.push(one("tangential_growth", 1.0));
        values.push(("chains.units".to_owned(), Value::IntegerArray(vec![3])));
        values.push(("body.mesh".to_owned(), Value::String("block".to_owned())));
        let planned = Scene::from_values(values, Origin::named("a test")).unwrap().plan().unwrap().topics;
        // A reader of pointer_target is a hand that the mouse may lead: a recorder is none, and poses say where it went.
        let follows =
            ["markers", "pointer_target", "~/transition_event", "/rosout", "/parameter_events", "/clock"];
        let mut expected: Vec<_> = planned
            .iter()
            .filter(|topic| !follows.contains(&topic.name.as_str()) && !topic.name.ends_with("_heard"))
            .map(|topic| (absolute("/", &topic.name), topic.message.replace('/', "/msg/")))
            .collect();
        let mut recorded: Vec<_> = session_topics("/", &[String::new()])
            .into_iter()
            .map(|topic| (topic.name, topic.type_name))
            .collect();
        expected.sort();
        recorded.sort();
        assert_eq!(recorded, expected);
    }

    #[test]
    fn a_button_is_a_joy_right_in_a_devices_namespace() {
        let joy = [BUTTON_TYPE.to_owned()];
        assert!(is_button("/or", &two(), "/or/left/coag", &joy));
        assert!(!is_button("/or", &two(), "/or/coag", &joy));
        assert!(!is_button("/or", &two(), "/or/left/pedals/coag", &joy));
        assert!(!is_button("/or", &two(), "/or/left/coag", &["std_msgs/msg/Bool".to_owned()]));
        assert!(is_button("/", &[String::new()], "/button", &joy));
        assert!(is_button("/or", &[String::new()], "/or/button", &joy));
        assert!(is_button("/or", &["/left".to_owned()], "/left/button", &joy));
    }
}
