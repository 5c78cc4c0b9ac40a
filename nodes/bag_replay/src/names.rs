//! Names: of topics in a namespace, of the session's topics, of recordings.

use std::time::{Duration, SystemTime, UNIX_EPOCH};

use node_kit::topics::{self, Topic};
use r2r::QosProfile;

/// A topic that a session has: what is known of it before anybody publishes it.
pub(crate) struct SessionTopic {
    /// Absolute name.
    pub(crate) name: String,
    /// Such as `geometry_msgs/msg/PoseStamped`.
    pub(crate) type_name: &'static str,
    /// As its publishers in this project offer it.
    pub(crate) qos: QosProfile,
}

/// Every topic of a session, with those of each device in the device's sub-namespace. What only viewers and logs need is
/// left out: it follows from the rest.
pub(crate) fn session_topics(namespace: &str, devices: &[String]) -> Vec<SessionTopic> {
    fn row<M>(name: String, topic: &Topic<M>, type_name: &'static str) -> SessionTopic {
        SessionTopic { name, type_name, qos: topic.qos() }
    }
    let mut rows = Vec::new();
    for device in devices {
        macro_rules! of_device {
            ($($topic:ident: $type_name:literal),+ $(,)?) => {
                $(rows.push(row(absolute(namespace, &topics::$topic.name_in(device)), &topics::$topic, $type_name));)+
            };
        }
        of_device!(
            MEASURED_CP: "geometry_msgs/msg/PoseStamped",
            MEASURED_CV: "geometry_msgs/msg/TwistStamped",
            MEASURED_CF: "geometry_msgs/msg/WrenchStamped",
            GRIPPER_MEASURED_JS: "sensor_msgs/msg/JointState",
            GRASP: "std_msgs/msg/Bool",
            CLUTCH: "sensor_msgs/msg/Joy",
            SERVO_CF: "geometry_msgs/msg/WrenchStamped",
            CONTACT_LAW: "rhombus_haptics_msgs/msg/ContactLaw",
            CONTACT_STATE: "rhombus_haptics_msgs/msg/ContactState",
        );
    }
    macro_rules! of_session {
        ($($topic:ident: $type_name:literal),+ $(,)?) => {
            $(rows.push(row(absolute(namespace, topics::$topic.name()), &topics::$topic, $type_name));)+
        };
    }
    of_session!(
        SURFACE_DISPLACEMENT: "rhombus_haptics_msgs/msg/SurfaceDisplacement",
        BODY_MESH: "shape_msgs/msg/Mesh",
        TF: "tf2_msgs/msg/TFMessage",
        TF_STATIC: "tf2_msgs/msg/TFMessage",
        DIAGNOSTICS: "diagnostic_msgs/msg/DiagnosticArray",
    );
    rows
}

/// `name` as the graph knows it: relative names stand in the node's namespace.
pub(crate) fn absolute(namespace: &str, name: &str) -> String {
    if name.starts_with('/') {
        name.to_owned()
    } else {
        format!("{}/{name}", namespace.trim_end_matches('/'))
    }
}

/// Whether an absolute name is one that ROS accepts for a topic: words of letters, digits and `_` behind a `/` each.
pub(crate) fn is_topic(name: &str) -> bool {
    let is_word = |word: &str| {
        word.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
            && word.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
    };
    name.strip_prefix('/').is_some_and(|words| words.split('/').all(is_word))
}

/// Name of a recording that got none: namespace, date and time of day (UTC), so that two sessions side by side and two
/// sessions after each other differ.
pub(crate) fn by_time(namespace: &str, now: SystemTime) -> String {
    let since_epoch = now.duration_since(UNIX_EPOCH).unwrap_or(Duration::ZERO).as_secs();
    let (days, second) = (since_epoch / 86_400, since_epoch % 86_400);
    let (year, month, day) = date(days);
    let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
    let time = format!("{year:04}-{month:02}-{day:02}_{hour:02}-{minute:02}-{second:02}");
    let namespace = namespace.trim_matches('/').replace('/', "_");
    if namespace.is_empty() { time } else { format!("{namespace}_{time}") }
}

/// Year, month and day of a number of days since 1970 in the Gregorian calendar. Years are counted from March, so that
/// the leap day comes last.
fn date(days: u64) -> (u64, u64, u64) {
    const DAYS_OF_400_YEARS: u64 = 146_097;
    // From 0000-03-01.
    let days = days + 719_468;
    let era = days / DAYS_OF_400_YEARS;
    let day_of_era = days % DAYS_OF_400_YEARS;
    let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month_from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month_from_march + 2) / 5 + 1;
    let month = if month_from_march < 10 { month_from_march + 3 } else { month_from_march - 9 };
    (era * 400 + year_of_era + u64::from(month <= 2), month, day)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn relative_names_stand_in_the_namespace_and_absolute_ones_do_not() {
        assert_eq!(absolute("/", "measured_cp"), "/measured_cp");
        assert_eq!(absolute("/left", "gripper/measured_js"), "/left/gripper/measured_js");
        assert_eq!(absolute("/left", "/tf"), "/tf");
    }

    #[test]
    fn a_topic_is_words_behind_slashes() {
        for name in ["/tf", "/left/measured_cp", "/_hidden/a1"] {
            assert!(is_topic(name), "{name:?}");
        }
        for name in ["tf", "/", "/a/", "//a", "/1a", "/white space", "/~/a", "/a-b"] {
            assert!(!is_topic(name), "{name:?}");
        }
    }

    #[test]
    fn each_device_has_its_topics_in_its_sub_namespace_and_no_name_comes_twice() {
        let devices = ["left".to_owned(), "right".to_owned()];
        let mut names: Vec<_> = session_topics("/or", &devices).into_iter().map(|topic| topic.name).collect();
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
    fn the_types_written_here_are_those_of_the_topics() {
        fn type_of<M>(_: &Topic<M>) -> &'static str {
            std::any::type_name::<M>()
        }
        let expected = [
            type_of(&topics::MEASURED_CP),
            type_of(&topics::MEASURED_CV),
            type_of(&topics::MEASURED_CF),
            type_of(&topics::GRIPPER_MEASURED_JS),
            type_of(&topics::GRASP),
            type_of(&topics::CLUTCH),
            type_of(&topics::SERVO_CF),
            type_of(&topics::CONTACT_LAW),
            type_of(&topics::CONTACT_STATE),
            type_of(&topics::SURFACE_DISPLACEMENT),
            type_of(&topics::BODY_MESH),
            type_of(&topics::TF),
            type_of(&topics::TF_STATIC),
            type_of(&topics::DIAGNOSTICS),
        ];
        let rows = session_topics("/", &[String::new()]);
        assert_eq!(rows.len(), expected.len());
        for (row, rust) in rows.iter().zip(expected) {
            assert!(
                rust.ends_with(&row.type_name.replace('/', "::")),
                "{}: {} is {rust}",
                row.name,
                row.type_name
            );
        }
    }

    #[test]
    fn dates_agree_with_the_calendar() {
        let name = |seconds| by_time("/", UNIX_EPOCH + Duration::from_secs(seconds));
        assert_eq!(name(0), "1970-01-01_00-00-00");
        assert_eq!(name(951_782_399), "2000-02-28_23-59-59");
        assert_eq!(name(951_782_400), "2000-02-29_00-00-00");
        assert_eq!(name(951_868_800), "2000-03-01_00-00-00");
        assert_eq!(name(1_735_689_599), "2024-12-31_23-59-59");
        assert_eq!(name(1_735_689_600), "2025-01-01_00-00-00");
        assert_eq!(by_time("/or/left", UNIX_EPOCH), "or_left_1970-01-01_00-00-00");
    }
}
