//! The texts to a page: JSON objects with a "type". A number that is not finite is null.

use std::collections::BTreeMap;

use scene::{ChainSettings, Value};
use serde::Serialize;
use serde_json::json;

use super::VERSION;
use crate::inputs::NotDrawn;

/// What a page needs to know of the session before anything else.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Hello {
    pub(crate) namespace: String,
    pub(crate) body_frame: String,
    pub(crate) scene_frame: String,
    /// Sub-namespaces.
    pub(crate) devices: Vec<String>,
    pub(crate) probe_radius_m: f64,
    pub(crate) rate_hz: f64,
    pub(crate) full_scale_m: f64,
    pub(crate) force_scale_m_per_n: f64,
    pub(crate) displacement_scale: f64,
    /// Another one after each start of the node.
    pub(crate) boot_id: String,
}

/// One status of `/diagnostics`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct NodeHealth {
    /// Full name of the node and what of it: "/deformation: left".
    pub(crate) name: String,
    /// "ok", "warn", "error" or "stale".
    pub(crate) level: &'static str,
    pub(crate) summary: String,
    /// When it said so, s.
    pub(crate) stamp_s: f64,
    pub(crate) values: BTreeMap<String, String>,
}

/// One device as its driver and the graph show it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct DeviceHealth {
    pub(crate) name: String,
    pub(crate) operating_state: Option<String>,
    pub(crate) homed: bool,
    pub(crate) busy: bool,
    /// It takes the targets of a page.
    pub(crate) pointer: bool,
    /// A page moves it now.
    pub(crate) held: bool,
    /// The newest target is outside its workspace and is not followed, as its driver says.
    pub(crate) out_of_reach: bool,
    pub(crate) pose_age_s: Option<f64>,
    pub(crate) alive: bool,
    /// A frame that it speaks in and that nothing connects to the body.
    pub(crate) unplaced_frame: Option<String>,
}

/// A parameter that a page may set.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ShownParameter {
    pub(crate) name: String,
    pub(crate) value: Value,
    pub(crate) unit: String,
    pub(crate) min: Option<f64>,
    pub(crate) max: Option<f64>,
    /// `min` itself is not accepted.
    pub(crate) exclusive_min: bool,
    pub(crate) help: String,
    pub(crate) accepted: String,
    /// Full names of the nodes that have it.
    pub(crate) nodes: Vec<String>,
}

/// The first message.
pub(crate) fn hello(hello: &Hello) -> String {
    let mut text = json!(hello);
    text["type"] = json!("hello");
    text["protocol"] = json!(VERSION);
    text["version"] = json!(env!("CARGO_PKG_VERSION"));
    text.to_string()
}

/// The parallel chains; none in a scene without.
pub(crate) fn chains(settings: Option<&ChainSettings>) -> String {
    let chains = settings.map_or(&[][..], |settings| &settings.chains).iter().map(|chain| {
        json!({
            "rod_length_m": chain.rod_length_m,
            "angle_rad": chain.angle_rad,
            "ratio": chain.ratio,
            "units": chain.units,
            "normal_stiffness_n_per_m": chain.normal_stiffness_n_per_m,
            "tangential_stiffness_n_per_m": chain.tangential_stiffness_n_per_m,
            "tangential_growth": chain.tangential_growth,
            "weight": chain.weight,
            "pitch_m": chain.pitch_m,
        })
    });
    json!({
        "type": "chains",
        "device_independent": true,
        "formulation": settings.map(|settings| settings.formulation.to_string()),
        "chains": chains.collect::<Vec<_>>(),
    })
    .to_string()
}

/// What may be set.
pub(crate) fn parameters(parameters: &[ShownParameter]) -> String {
    let parameters = parameters.iter().map(|parameter| {
        let (value, kind) = value(&parameter.value);
        json!({
            "name": parameter.name,
            "value": value,
            "type": kind,
            "unit": parameter.unit,
            "min": parameter.min,
            "max": parameter.max,
            "exclusive_min": parameter.exclusive_min,
            "help": parameter.help,
            "accepted": parameter.accepted,
            "nodes": parameter.nodes,
        })
    });
    json!({ "type": "parameters", "parameters": parameters.collect::<Vec<_>>() }).to_string()
}

/// A value as JSON, and the name of its type.
fn value(value: &Value) -> (serde_json::Value, &'static str) {
    match value {
        Value::Bool(v) => (json!(v), "bool"),
        Value::Integer(v) => (json!(v), "integer"),
        Value::Double(v) => (json!(v), "double"),
        Value::String(v) => (json!(v), "string"),
        Value::BoolArray(v) => (json!(v), "bool_array"),
        Value::IntegerArray(v) => (json!(v), "integer_array"),
        Value::DoubleArray(v) => (json!(v), "double_array"),
        Value::StringArray(v) => (json!(v), "string_array"),
    }
}

/// How a `set_parameter` ended.
pub(crate) fn parameter_result(id: u64, outcome: Result<(), &str>) -> String {
    let reason = outcome.err().unwrap_or_default();
    json!({ "type": "parameter_result", "id": id, "ok": outcome.is_ok(), "reason": reason }).to_string()
}

/// The state of the session's nodes, devices and topics.
pub(crate) fn status(
    nodes: &[NodeHealth],
    devices: &[DeviceHealth],
    publishers: &BTreeMap<&'static str, usize>,
    pages: usize,
    not_drawn: NotDrawn,
) -> String {
    json!({
        "type": "status",
        "nodes": nodes,
        "devices": devices,
        "publishers": publishers,
        "pages": pages,
        "not_drawn": { "not_drawable": not_drawn.not_drawable, "other_mesh": not_drawn.other_mesh },
    })
    .to_string()
}

/// Whether a page may move a pointer device.
pub(crate) fn pointer(device: &str, outcome: Result<(), &str>) -> String {
    let reason = outcome.err().unwrap_or_default();
    json!({ "type": "pointer", "device": device, "granted": outcome.is_ok(), "reason": reason }).to_string()
}

/// Something a page said was not accepted.
pub(crate) fn refused(reason: &str) -> String {
    json!({ "type": "refused", "reason": reason }).to_string()
}

/// The answer to a ping.
pub(crate) fn pong(t: f64) -> String {
    json!({ "type": "pong", "t": t }).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> serde_json::Value {
        serde_json::from_str(text).unwrap()
    }

    #[test]
    fn a_parameter_is_shown_with_its_type_and_range() {
        let parameter = ShownParameter {
            name: "chains.ratio".to_owned(),
            value: Value::DoubleArray(vec![0.8]),
            unit: String::new(),
            min: Some(0.0),
            max: Some(1.0),
            exclusive_min: true,
            help: "Size of a unit.".to_owned(),
            accepted: "> 0 and < 1".to_owned(),
            nodes: vec!["/deformation".to_owned()],
        };
        let shown = &read(&parameters(&[parameter]))["parameters"][0];
        assert_eq!(shown["value"], json!([0.8]));
        assert_eq!((&shown["type"], &shown["max"]), (&json!("double_array"), &json!(1.0)));
    }

    #[test]
    fn a_refusal_says_why_and_a_success_does_not() {
        let failed = read(&parameter_result(3, Err("too stiff")));
        assert_eq!(
            (&failed["ok"], &failed["reason"], &failed["id"]),
            (&json!(false), &json!("too stiff"), &json!(3))
        );
        assert_eq!(read(&pointer("left", Ok(())))["granted"], json!(true));
        assert_eq!(read(&chains(None))["chains"], json!([]));
    }
}
