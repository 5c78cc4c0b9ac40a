//! `simulated.*`: the scripted hand of the simulated backend; mass, stiffness and damping are those of the pointer's hand too.

use super::row::number;
use super::{Check, ParameterSpec};

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
    number(
        "simulated.noise",
        "m",
        0.0,
        Check::Within(0.0, 0.01),
        "Standard deviation of the noise on measured positions.",
    ),
    number(
        "simulated.quantisation",
        "m",
        0.0,
        Check::Within(0.0, 0.01),
        "Measured positions are multiples of this; 0 measures exactly.",
    ),
    number(
        "simulated.dropout",
        "",
        0.0,
        Check::WithinBelow(0.0, 1.0),
        "Share of readings that repeat the one before.",
    ),
    number(
        "simulated.latency",
        "s",
        0.0,
        Check::Within(0.0, 1.0),
        "Readings are this old, in whole periods of the motor loop.",
    ),
];
