//! `chains.*`: the contact law and the shape of the surface around a contact; one array entry for each parallel chain.

use super::{Check, DefaultValue, Kind, Length, Node, ParameterSpec};

const USERS: &[Node] = &[Node::Deformation, Node::Visualization];

const fn per_chain(
    name: &'static str,
    unit: &'static str,
    default: DefaultValue,
    check: Check,
    live: bool,
    help: &'static str,
) -> ParameterSpec {
    ParameterSpec {
        name,
        kind: Kind::DoubleArray,
        unit,
        default,
        check,
        length: Length::PerChain,
        live,
        owners: USERS,
        help,
    }
}

pub(super) const PARAMETERS: &[ParameterSpec] = &[
    ParameterSpec {
        name: "chains.formulation",
        kind: Kind::String,
        unit: "",
        default: DefaultValue::String("energy"),
        check: Check::OneOf(&["energy", "published"]),
        length: Length::Any,
        live: false,
        owners: USERS,
        help: "Force law of all chains: what the springs store (energy) or what the paper printed (published).",
    },
    per_chain(
        "chains.rod_length",
        "m",
        DefaultValue::Required,
        Check::Above(0.0),
        false,
        "a: length of a rod of the first unit.",
    ),
    per_chain(
        "chains.angle",
        "rad",
        DefaultValue::Required,
        Check::Between(0.0, std::f64::consts::FRAC_PI_2),
        false,
        "theta: angle at rest between a rod and the tangential diagonal.",
    ),
    per_chain(
        "chains.ratio",
        "",
        DefaultValue::Required,
        Check::Between(0.0, 1.0),
        false,
        "q: each unit is smaller than the one before by this factor.",
    ),
    ParameterSpec {
        name: "chains.units",
        kind: Kind::IntegerArray,
        unit: "",
        default: DefaultValue::Required,
        check: Check::Within(1.0, 1e6),
        length: Length::PerChain,
        live: false,
        owners: USERS,
        help: "n: number of units of the chain.",
    },
    per_chain(
        "chains.normal_stiffness",
        "N/m",
        DefaultValue::Required,
        Check::Above(0.0),
        true,
        "k_n: normal spring of the first unit.",
    ),
    per_chain(
        "chains.tangential_stiffness",
        "N/m",
        DefaultValue::Required,
        Check::AtLeast(0.0),
        true,
        "k_t: tangential spring of the first unit.",
    ),
    per_chain(
        "chains.tangential_growth",
        "",
        DefaultValue::Required,
        Check::Above(0.0),
        true,
        "beta: the tangential spring grows by e^(1/beta) from unit to unit.",
    ),
    per_chain(
        "chains.weight",
        "",
        DefaultValue::Computed("1/P for each of P chains"),
        Check::Above(0.0),
        true,
        "w: share of the chain in the surface's shape; the shares sum to 1 and do not change the force.",
    ),
    per_chain(
        "chains.pitch",
        "m",
        DefaultValue::Computed("2 a cos(theta)"),
        Check::Above(0.0),
        true,
        "h: arc length along the surface that one unit covers.",
    ),
];
