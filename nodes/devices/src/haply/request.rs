//! What is asked of the service: one JSON object for one answer.

use std::fmt::Write;

use glam::DVec3;

/// Asks for everything, configuration too.
pub(super) const EVERYTHING: &str = r#"{"session":{"force_render_full_state":{}}}"#;

/// The key under which `set_cursor_force` has its force. Services before 3.5 read `values`, 3.5 documents `vector`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Spelling {
    /// Since 3.5.
    Vector,
    /// Before.
    Values,
}

impl Spelling {
    /// The other one.
    pub(super) fn other(self) -> Spelling {
        match self {
            Spelling::Vector => Spelling::Values,
            Spelling::Values => Spelling::Vector,
        }
    }

    fn key(self) -> &'static str {
        match self {
            Spelling::Vector => "vector",
            Spelling::Values => "values",
        }
    }
}

/// A device's id as a JSON string, for the requests below.
pub(super) fn quoted(device_id: &str) -> String {
    serde_json::Value::from(device_id).to_string()
}

/// A force for one tick, N, in the service's frame, of the device with that [`quoted`] id. The buffer is used again.
pub(super) fn force(buffer: &mut String, id: &str, spelling: Spelling, force_n: DVec3) {
    buffer.clear();
    let DVec3 { x, y, z } = force_n;
    // Writing to a String cannot fail.
    let _ = write!(
        buffer,
        r#"{{"inverse3":[{{"device_id":{id},"commands":{{"set_cursor_force":{{"{}":{{"x":{x},"y":{y},"z":{z}}}}}}}}}]}}"#,
        spelling.key()
    );
}

/// No command for this tick, only the state: the device idles.
pub(super) fn probe(buffer: &mut String, id: &str) {
    buffer.clear();
    let _ = write!(buffer, r#"{{"inverse3":[{{"device_id":{id},"commands":{{"probe_position":{{}}}}}}]}}"#);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_request_is_the_json_that_the_service_documents() {
        let mut text = String::new();
        force(&mut text, &quoted("049D"), Spelling::Vector, DVec3::new(0.0, -1.5, 1e-7));
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        let expected = serde_json::json!({"inverse3": [{"device_id": "049D",
            "commands": {"set_cursor_force": {"vector": {"x": 0.0, "y": -1.5, "z": 1e-7}}}}]});
        // Numbers may be written as 0 or 0.0.
        let force = |json: &serde_json::Value, axis: &str| {
            json["inverse3"][0]["commands"]["set_cursor_force"]["vector"][axis].as_f64()
        };
        for axis in ["x", "y", "z"] {
            assert_eq!(force(&json, axis), force(&expected, axis));
        }
        assert_eq!(json["inverse3"][0]["device_id"], "049D");
        super::force(&mut text, &quoted("049D"), Spelling::Values, DVec3::ZERO);
        assert!(text.contains("\"values\"") && !text.contains("\"vector\""), "{text}");
        probe(&mut text, &quoted("049D"));
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(json["inverse3"][0]["commands"], serde_json::json!({"probe_position": {}}));
        let json: serde_json::Value = serde_json::from_str(EVERYTHING).unwrap();
        assert!(json["session"]["force_render_full_state"].is_object());
    }
}
