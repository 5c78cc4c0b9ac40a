//! `simulated.*`: the scripted hand of the simulated backend.

use super::{Check, DefaultValue, Kind, Length, Node, ParameterSpec};

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
        live: false,
        owners: &[Node::HapticDevice],
        help,
    }
}

pub(super) const PARAMETERS: &[ParameterSpec] = &[
    number(
        "simulated.mass",
        "kg",
        0.3,
        Check::Above(0.0),
        "Mass of the hand and the moving parts of the device.",
    ),
    number(
        "simulated.stiffness",
        "N/m",
        500.0,
        Check::Above(0.0),
        "How stiffly the hand follows its intended path.",
    ),
    number(
        "simulated.damping",
        "N s/m",
        20.0,
        Check::AtLeast(0.0),
        "Damping between the hand and its intended path.",
    ),
    number(
        "simulated.depth",
        "m",
        0.008,
        Check::Within(0.0, 0.1),
        "How deep the hand intends to press; the tissue's force makes it less.",
    ),
    number(
        "simulated.pull",
        "m",
        0.007,
        Check::Within(0.0, 0.1),
        "How far the hand intends to pull the grasped surface outward.",
    ),
    number(
        "simulated.slide",
        "m",
        0.03,
        Check::Within(0.0, 0.5),
        "How far the hand intends to slide along the surface while it presses.",
    ),
    number(
        "simulated.period",
        "s",
        12.0,
        Check::Within(0.1, 3600.0),
        "Time for a press and a slide at one site and a grasp and a pull at the next; the motion repeats.",
    ),
];
