//! `visualization.*`: what RViz shows.

use super::{Check, DefaultValue, Kind, Length, Node, ParameterSpec};

const VIEWER: &[Node] = &[Node::Visualization];

const fn number(
    name: &'static str,
    unit: &'static str,
    default: f64,
    check: Check,
    help: &'static str,
) -> ParameterSpec {
    ParameterSpec {
        name,
        kind: Kind::Double,
        unit,
        default: DefaultValue::Double(default),
        check,
        length: Length::Any,
        live: true,
        owners: VIEWER,
        help,
    }
}

pub(super) const PARAMETERS: &[ParameterSpec] = &[
    number(
        "visualization.rate",
        "Hz",
        30.0,
        Check::Within(0.0, 120.0),
        "Published markers and probe transforms; 0 publishes none. Nothing is drawn while nobody reads the markers.",
    ),
    number(
        "visualization.full_scale",
        "m",
        0.005,
        Check::Above(0.0),
        "Displacement that gets the last colour of the scale.",
    ),
    number(
        "visualization.displacement_scale",
        "",
        1.0,
        Check::Within(0.0, 100.0),
        "The surface is drawn displaced by this many times its displacement; colours show the true one.",
    ),
    number(
        "visualization.force_scale",
        "m/N",
        0.02,
        Check::Above(0.0),
        "Length of the force arrow for each newton.",
    ),
    ParameterSpec {
        name: "visualization.show_chains",
        kind: Kind::Bool,
        unit: "",
        default: DefaultValue::Bool(true),
        check: Check::Any,
        length: Length::Any,
        live: true,
        owners: VIEWER,
        help: "Draw rods, mass points and springs of the chains at each contact.",
    },
];
