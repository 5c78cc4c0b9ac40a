//! `surface.*`, `probe.*`, `grasp.*`: how the surface follows a contact, and what touches it.

use super::{Check, DefaultValue, Kind, Length, Node, ParameterSpec};

const MODEL: &[Node] = &[Node::Deformation];

const fn number(
    name: &'static str,
    unit: &'static str,
    default: f64,
    check: Check,
    live: bool,
    owners: &'static [Node],
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
        owners,
        help,
    }
}

pub(super) const PARAMETERS: &[ParameterSpec] = &[
    number(
        "surface.cutoff",
        "",
        0.05,
        Check::WithinBelow(0.0, 1.0),
        true,
        MODEL,
        "Units whose angle changes by less than this share of the rest angle are not moved: the boundary.",
    ),
    number(
        "surface.expansion",
        "",
        0.0,
        Check::Within(0.0, 1.0),
        true,
        MODEL,
        "kappa: share of the displaced volume that bulges outward beyond the boundary; 0 computes none.",
    ),
    ParameterSpec {
        name: "surface.spread",
        kind: Kind::String,
        unit: "",
        default: DefaultValue::String("geodesic"),
        check: Check::OneOf(&["geodesic", "rings"]),
        length: Length::Any,
        live: false,
        owners: MODEL,
        help: "Distance from the contact: arc length along the surface, or mesh rings (for comparison only).",
    },
    number(
        "surface.rate",
        "Hz",
        60.0,
        Check::Within(0.0, 1000.0),
        true,
        MODEL,
        "Published surface displacements, counted by stamps; 0 computes and publishes none.",
    ),
    number(
        "probe.radius",
        "m",
        0.005,
        Check::Above(0.0),
        false,
        &[Node::HapticDevice, Node::Deformation, Node::Visualization],
        "Radius of the spherical probe.",
    ),
    number(
        "probe.contact_radius",
        "m",
        0.0,
        Check::AtLeast(0.0),
        true,
        MODEL,
        "r_c: radius of the surface around the contact that moves with it by the full depth.",
    ),
    number(
        "grasp.lateral",
        "",
        0.5,
        Check::AtLeast(0.0),
        true,
        MODEL,
        "Lateral stiffness of a grasp as a share of the contact law's stiffness at rest.",
    ),
    number(
        "grasp.close_below",
        "rad",
        0.2,
        Check::Any,
        true,
        MODEL,
        "The gripper of gripper/measured_js holds the surface below this angle.",
    ),
];
