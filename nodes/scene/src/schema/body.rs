//! `body.*`: what is touched, and where it stands.

use super::{Check, DefaultValue, Kind, Length, Node, ParameterSpec};

const USERS: &[Node] = &[Node::HapticDevice, Node::Deformation, Node::Visualization];

pub(super) const PARAMETERS: &[ParameterSpec] = &[
    ParameterSpec {
        name: "body.mesh",
        kind: Kind::String,
        unit: "",
        default: DefaultValue::String("liver"),
        check: Check::Any,
        length: Length::Any,
        live: false,
        owners: &[Node::HapticDevice, Node::Deformation],
        help: "Rest surface: an OBJ file (relative to the YAML file, absolute, or package://rhombus_haptics/...), or \"liver\" or \"block\", which are generated.",
    },
    ParameterSpec {
        name: "body.scale",
        kind: Kind::Double,
        unit: "",
        default: DefaultValue::Double(1.0),
        check: Check::Above(0.0),
        length: Length::Any,
        live: false,
        owners: &[Node::HapticDevice, Node::Deformation],
        help: "Factor on the mesh's coordinates that makes them metres (0.001 for a mesh in millimetres).",
    },
    ParameterSpec {
        name: "body.stiffness_map",
        kind: Kind::String,
        unit: "",
        default: DefaultValue::String(""),
        check: Check::Any,
        length: Length::Any,
        live: false,
        owners: &[Node::Deformation, Node::Visualization],
        help: "CSV file with a factor on the contact law for each vertex of the mesh (path as body.mesh); \"\": the law is the same everywhere.",
    },
    ParameterSpec {
        name: "body.response",
        kind: Kind::String,
        unit: "",
        default: DefaultValue::String(""),
        check: Check::Any,
        length: Length::Any,
        live: false,
        owners: &[Node::Deformation, Node::Visualization],
        help: "Calibrated body (path as body.mesh): how the surface answers in each direction, and its own stiffness map; \"\": the chains are the same in all directions.",
    },
    ParameterSpec {
        name: "body.frame_id",
        kind: Kind::String,
        unit: "",
        default: DefaultValue::String("body"),
        check: Check::FrameId,
        length: Length::Any,
        live: false,
        owners: USERS,
        help: "Frame of the rest surface; a leading / keeps the name out of the node's namespace.",
    },
    ParameterSpec {
        name: "body.pose",
        kind: Kind::DoubleArray,
        unit: "m",
        default: DefaultValue::Doubles(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
        check: Check::Pose,
        length: Length::Exactly(7),
        live: false,
        owners: USERS,
        help: "Pose of the body in the scene frame: x y z qx qy qz qw.",
    },
];
