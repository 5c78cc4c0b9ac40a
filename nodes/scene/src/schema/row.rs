//! Rows of the table that one node reads, once, at its start.

use super::{Check, DefaultValue, Kind, Length, Node, ParameterSpec};

const fn row(
    name: &'static str,
    kind: Kind,
    unit: &'static str,
    default: DefaultValue,
    check: Check,
    help: &'static str,
) -> ParameterSpec {
    let owners = &[Node::HapticDevice];
    ParameterSpec { name, kind, unit, default, check, length: Length::Any, live: false, owners, help }
}

/// A number of the device driver.
pub(super) const fn number(
    name: &'static str,
    unit: &'static str,
    default: f64,
    check: Check,
    help: &'static str,
) -> ParameterSpec {
    row(name, Kind::Double, unit, DefaultValue::Double(default), check, help)
}

/// An integer of the device driver.
pub(super) const fn integer(
    name: &'static str,
    default: i64,
    check: Check,
    help: &'static str,
) -> ParameterSpec {
    row(name, Kind::Integer, "", DefaultValue::Integer(default), check, help)
}

/// A text of the device driver.
pub(super) const fn text(name: &'static str, default: &'static str, help: &'static str) -> ParameterSpec {
    row(name, Kind::String, "", DefaultValue::String(default), Check::Any, help)
}

/// A switch of the device driver.
pub(super) const fn switch(name: &'static str, default: bool, help: &'static str) -> ParameterSpec {
    row(name, Kind::Bool, "", DefaultValue::Bool(default), Check::Any, help)
}
