//! `device.*`: the haptic device, whatever its backend.

use super::{Check, DefaultValue, Kind, Length, Node, ParameterSpec};

const DRIVER: &[Node] = &[Node::HapticDevice];
const DRIVER_AND_MODEL: &[Node] = &[Node::HapticDevice, Node::Deformation];
const EVERYBODY: &[Node] = &[Node::HapticDevice, Node::Deformation, Node::Visualization];

pub(super) const PARAMETERS: &[ParameterSpec] = &[
    ParameterSpec {
        name: "device.backend",
        kind: Kind::String,
        unit: "",
        default: DefaultValue::String("simulated"),
        check: Check::OneOf(&["simulated"]),
        length: Length::Any,
        live: false,
        owners: DRIVER,
        help: "What stands behind the driver; simulated is a scripted hand that feels the force.",
    },
    ParameterSpec {
        name: "device.frame_id",
        kind: Kind::String,
        unit: "",
        default: DefaultValue::String("device_base"),
        check: Check::FrameId,
        length: Length::Any,
        live: false,
        owners: EVERYBODY,
        help: "Frame of the device's poses; a leading / keeps the name out of the node's namespace.",
    },
    ParameterSpec {
        name: "device.scene_from_device",
        kind: Kind::DoubleArray,
        unit: "m",
        default: DefaultValue::Doubles(&[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
        check: Check::Pose,
        length: Length::Exactly(7),
        live: false,
        owners: EVERYBODY,
        help: "Pose of the device's base in the scene frame: x y z qx qy qz qw.",
    },
    ParameterSpec {
        name: "device.motion_scale",
        kind: Kind::Double,
        unit: "",
        default: DefaultValue::Double(1.0),
        check: Check::Within(0.001, 1000.0),
        length: Length::Any,
        live: false,
        owners: DRIVER_AND_MODEL,
        help: "Motion in the scene for each metre of motion of the device.",
    },
    ParameterSpec {
        name: "device.rate",
        kind: Kind::Double,
        unit: "Hz",
        default: DefaultValue::Double(1000.0),
        check: Check::Within(10.0, 4000.0),
        length: Length::Any,
        live: false,
        owners: DRIVER,
        help: "Rate of the motor loop and of measured_cp.",
    },
    ParameterSpec {
        name: "device.max_force",
        kind: Kind::Double,
        unit: "N",
        default: DefaultValue::Double(20.0),
        check: Check::Within(0.0, 100.0),
        length: Length::Any,
        live: true,
        owners: DRIVER,
        help: "The force on the hand is never larger than this.",
    },
];
