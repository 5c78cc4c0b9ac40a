//! `simulated.*`: the scripted hand of the simulated backend.

use super::{Check, DefaultValue, Kind, Length, Node, ParameterSpec};

const fn number(
    name: &'static str,
    unit: &'static str,
    default: f64,
    check: Check,
    live: bool,
    help: &'static str,
) -> ParameterSpec {
    ParameterSpec {
        name,
        kind: Kind::Double,
        unit,
        default: DefaultValue::Double(default),
        check,
        length: Length::Any,
        live,
        owners: &[Node::HapticDevice],
        help,
    }
}

pub(super) const PARAMETERS: &[ParameterSpec] = &[
    number("simulated.mass", "kg", 0.2, Check::Above(0.0), false, "Mass of hand and handle."),
    number(
        "simulated.stiffness",
        "N/m",
        800.0,
        Check::Above(0.0),
        false,
        "How stiffly the hand follows its intended path.",
    ),
    number(
        "simulated.damping",
        "N s/m",
        15.0,
        Check::AtLeast(0.0),
        false,
        "Damping between the hand and its intended path.",
    ),
    number(
        "simulated.depth",
        "m",
        0.006,
        Check::Within(0.0, 0.1),
        true,
        "How deep the hand intends to press; the tissue's force makes it less.",
    ),
    number(
        "simulated.pull",
        "m",
        0.005,
        Check::Within(0.0, 0.1),
        true,
        "How far the hand intends to pull the grasped surface outward.",
    ),
    number(
        "simulated.slide",
        "m",
        0.015,
        Check::Within(0.0, 0.5),
        true,
        "How far the hand intends to slide along the surface while it presses.",
    ),
    number(
        "simulated.period",
        "s",
        5.0,
        Check::Within(0.1, 3600.0),
        false,
        "Time for one approach, press, slide, grasp and pull at one site.",
    ),
];
