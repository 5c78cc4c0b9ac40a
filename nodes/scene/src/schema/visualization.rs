//! `visualization.*`: what RViz shows.

use super::{Check, DefaultValue, Kind, Length, Node, ParameterSpec};

const VIEWER: &[Node] = &[Node::Visualization];

pub(super) const PARAMETERS: &[ParameterSpec] = &[
    ParameterSpec {
        name: "visualization.rate",
        kind: Kind::Double,
        unit: "Hz",
        default: DefaultValue::Double(30.0),
        check: Check::Within(0.1, 240.0),
        length: Length::Any,
        live: true,
        owners: VIEWER,
        help: "Published markers.",
    },
    ParameterSpec {
        name: "visualization.full_scale",
        kind: Kind::Double,
        unit: "m",
        default: DefaultValue::Double(0.005),
        check: Check::Above(0.0),
        length: Length::Any,
        live: true,
        owners: VIEWER,
        help: "Displacement that gets the last colour of the scale.",
    },
    ParameterSpec {
        name: "visualization.force_scale",
        kind: Kind::Double,
        unit: "m/N",
        default: DefaultValue::Double(0.02),
        check: Check::Above(0.0),
        length: Length::Any,
        live: true,
        owners: VIEWER,
        help: "Length of the force arrow for each newton.",
    },
];
