//! What the nodes of one session share: frames, the devices' names, the clutch, the clock.

use super::{Check, DefaultValue, Kind, Length, Node, ParameterSpec};

pub(super) const PARAMETERS: &[ParameterSpec] = &[
    ParameterSpec {
        name: "scene.frame_id",
        kind: Kind::String,
        unit: "",
        default: DefaultValue::String("scene"),
        check: Check::FrameId,
        length: Length::Any,
        live: false,
        owners: &[Node::HapticDevice, Node::Deformation, Node::Visualization],
        help: "Frame in which body and devices stand; a leading / keeps the name out of the node's namespace.",
    },
    ParameterSpec {
        name: "devices",
        kind: Kind::StringArray,
        unit: "",
        default: DefaultValue::Strings(&[""]),
        check: Check::Any,
        length: Length::AtLeastOne,
        live: false,
        owners: &Node::ALL,
        help: "Sub-namespaces of the devices' topics, one entry for each device; \"\" is the node's own namespace. A driver \
               in one of them finds the session in front of it.",
    },
    ParameterSpec {
        name: "clutch.button",
        kind: Kind::String,
        unit: "",
        default: DefaultValue::String(""),
        check: Check::Any,
        length: Length::Any,
        live: false,
        owners: &[Node::HapticDevice],
        help: "Button of the device that freezes and re-indexes the motion while held; \"\" for none.",
    },
    ParameterSpec {
        name: "use_sim_time",
        kind: Kind::Bool,
        unit: "",
        default: DefaultValue::Bool(false),
        check: Check::Any,
        length: Length::Any,
        live: false,
        owners: &Node::ALL,
        help: "Stamp log, diagnostics and parameter events from /clock; a driver then follows commands with such stamps, too. \
               Poses, and all that answers them, keep the time of the device.",
    },
];
