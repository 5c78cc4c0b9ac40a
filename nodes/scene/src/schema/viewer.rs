//! `viewer.*`: the page that the visualization node serves to browsers.

use super::{Check, DefaultValue, Kind, Length, Node, ParameterSpec};

const fn row(
    name: &'static str,
    kind: Kind,
    unit: &'static str,
    default: DefaultValue,
    check: Check,
    live: bool,
    help: &'static str,
) -> ParameterSpec {
    let owners = &[Node::Visualization];
    ParameterSpec { name, kind, unit, default, check, length: Length::Any, live, owners, help }
}

pub(super) const PARAMETERS: &[ParameterSpec] = &[
    row(
        "viewer.enabled",
        Kind::Bool,
        "",
        DefaultValue::Bool(true),
        Check::Any,
        false,
        "Serve the page. Nothing is computed for it while no browser shows it.",
    ),
    row(
        "viewer.address",
        Kind::String,
        "",
        DefaultValue::String("127.0.0.1"),
        Check::FrameId,
        false,
        "Address or host name that the page is served at; 0.0.0.0 lets every machine of the network see and press.",
    ),
    row(
        "viewer.port",
        Kind::Integer,
        "",
        DefaultValue::Integer(8080),
        Check::Within(0.0, 65_535.0),
        false,
        "TCP port of the page; 0 takes any that is free.",
    ),
    row(
        "viewer.rate",
        Kind::Double,
        "Hz",
        DefaultValue::Double(60.0),
        Check::Within(1.0, 120.0),
        true,
        "Updates sent to each page.",
    ),
    row(
        "viewer.max_pages",
        Kind::Integer,
        "",
        DefaultValue::Integer(16),
        Check::Within(1.0, 256.0),
        false,
        "Pages that are served at once; one more is told so.",
    ),
];
