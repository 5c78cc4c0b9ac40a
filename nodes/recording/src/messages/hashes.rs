//! The hashes that ROS 2 gives the types of this crate which a topic can have.

/// What every hash begins with: the first version of how they are computed.
const PREFIX: &str = "RIHS01_";
/// Hexadecimal digits of SHA-256.
const DIGITS: usize = 64;

const KNOWN: [(&str, &str); 14] = [
    ("geometry_msgs/msg/PoseStamped", "10f3786d7d40fd2b54367835614bff85d4ad3b5dab62bf8bca0cc232d73b4cd8"),
    (
        "geometry_msgs/msg/TransformStamped",
        "0a241f87d04668d94099cbb5ba11691d5ad32c2f29682e4eb5653424bd275206",
    ),
    ("geometry_msgs/msg/TwistStamped", "5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64"),
    ("geometry_msgs/msg/WrenchStamped", "8dc3deaf06b2ab281f9f9a742a8961c328ca7cec16e3fd6586d3a5c83fa78f77"),
    (
        "rhombus_haptics_msgs/msg/ContactLaw",
        "7fa61b932eed45862d219930900eb9ce72ab0c9a8be06b139b8ec7bf5c77fcd8",
    ),
    (
        "rhombus_haptics_msgs/msg/ContactState",
        "b4b232ef3f6d737724593f28e6ac6124f376d5feb6ec5331341acb0b9931c713",
    ),
    (
        "rhombus_haptics_msgs/msg/SurfaceDisplacement",
        "9c5b3c85ec58d8f74fb6c123c58305c3ed098e7569edae27c8fd9428862d422a",
    ),
    ("rosgraph_msgs/msg/Clock", "692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564"),
    ("sensor_msgs/msg/JointState", "a13ee3a330e346c9d87b5aa18d24e11690752bd33a0350f11c5882bc9179260e"),
    ("sensor_msgs/msg/Joy", "0d356c79cad3401e35ffeb75a96a96e08be3ef896b8b83841d73e890989372c5"),
    ("shape_msgs/msg/Mesh", "f2150b82d8ee7e8bc3f396a2b158aefb4b9a5510a474be271ba1268aebb55289"),
    ("std_msgs/msg/Bool", "feb91e995ff9ebd09c0cb3d2aed18b11077585839fb5db80193b62d74528f6c9"),
    ("std_msgs/msg/UInt64", "fbdc52018fc13755dce18024d1a671c856aa8b4aaf63adfb095b608f98e8c943"),
    ("tf2_msgs/msg/TFMessage", "e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"),
];

/// Whether a recorded hash is that of a type; `None` where it is no hash, or the type has none here.
///
/// # Errors
/// The hash that would be accepted.
pub(super) fn same_hash(type_name: &str, recorded: &str) -> Option<Result<(), String>> {
    let recorded = recorded.strip_prefix(PREFIX)?;
    let is_hash = recorded.len() == DIGITS && recorded.bytes().all(|digit| digit.is_ascii_hexdigit());
    let (_, known) = KNOWN.iter().find(|(known, _)| is_hash && *known == type_name)?;
    Some(if recorded.eq_ignore_ascii_case(known) { Ok(()) } else { Err(format!("{PREFIX}{known}")) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MessageDefinitions;
    use crate::messages::own_definition;

    /// Where there is no ROS 2, nothing is compared.
    #[test]
    fn hashes_are_those_of_the_ros_2_that_is_here() {
        let installed = MessageDefinitions::from_environment();
        for (type_name, known) in KNOWN {
            assert!(own_definition(type_name).is_some(), "{type_name} is not read");
            if let Ok(definition) = installed.get(type_name)
                && !definition.type_hash.is_empty()
            {
                assert_eq!(definition.type_hash, format!("{PREFIX}{known}"), "{type_name}");
            }
        }
    }
}
