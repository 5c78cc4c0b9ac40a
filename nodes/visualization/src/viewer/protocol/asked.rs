//! What a page may say, and the door at which everything else stays outside.

use glam::DVec3;
use serde::Deserialize;

use crate::drawing::is_drawable;

/// A message from a page is not longer than this, bytes.
pub(crate) const MAX_FRAME: usize = 64 * 1024;

/// What a page asks for.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(tag = "type", rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum Asked {
    /// Give a parameter another value, on every node that has it.
    SetParameter { id: u64, name: String, value: serde_json::Value },
    /// Let this page move a pointer device.
    PointerTake { device: String },
    /// And no more.
    PointerRelease { device: String },
    /// Where its hand is to go, m in the body's frame, and whether it holds the surface.
    PointerTarget { device: String, sequence: u64, position: [f64; 3], grasp: bool },
    /// Answer with the same number.
    Ping { t: f64 },
}

impl Asked {
    /// One message.
    ///
    /// # Errors
    /// Why it is none, with what would be accepted.
    pub(crate) fn read(text: &str) -> Result<Asked, String> {
        if text.len() > MAX_FRAME {
            return Err(format!("{} bytes; at most {MAX_FRAME} are accepted", text.len()));
        }
        let asked: Asked = serde_json::from_str(text)
            .map_err(|error| format!("{error}; one JSON object of the protocol is accepted"))?;
        match &asked {
            Asked::PointerTarget { position, .. } if !is_drawable(DVec3::from_array(*position)) => {
                Err(format!("position is {position:?}; finite numbers in metres are accepted"))
            }
            _ => Ok(asked),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn every_message_of_the_protocol_is_read() {
        let read = |text: &str| Asked::read(text).unwrap();
        let value = serde_json::json!([500.0]);
        assert_eq!(
            read(r#"{"type":"set_parameter","id":7,"name":"chains.normal_stiffness","value":[500.0]}"#),
            Asked::SetParameter { id: 7, name: "chains.normal_stiffness".to_owned(), value }
        );
        assert_eq!(
            read(
                r#"{"type":"pointer_target","device":"","sequence":3,"position":[0,0.01,-1e-3],"grasp":true}"#
            ),
            Asked::PointerTarget {
                device: String::new(),
                sequence: 3,
                position: [0.0, 0.01, -0.001],
                grasp: true
            }
        );
        assert_eq!(
            read(r#"{"type":"pointer_take","device":"left"}"#),
            Asked::PointerTake { device: "left".to_owned() }
        );
        assert_eq!(read(r#"{"type":"ping","t":123.4}"#), Asked::Ping { t: 123.4 });
    }

    #[test]
    fn what_is_no_message_is_refused_with_a_reason() {
        for text in [
            "",
            "null",
            "[]",
            r#"{"type":"shutdown"}"#,
            r#"{"type":"ping"}"#,
            r#"{"type":"ping","t":1e999}"#,
            r#"{"type":"ping","t":1,"u":2}"#,
            r#"{"type":"set_parameter","id":-1,"name":"x","value":0}"#,
            r#"{"type":"pointer_target","device":"","sequence":1,"position":[0,0],"grasp":false}"#,
            r#"{"type":"pointer_target","device":"","sequence":1,"position":[0,0,1e300],"grasp":false}"#,
        ] {
            let reason = Asked::read(text).unwrap_err();
            assert!(reason.contains("accepted"), "{text}: {reason}");
        }
        let deep = "[".repeat(40_000);
        assert!(Asked::read(&deep).is_err());
        assert!(Asked::read(&" ".repeat(MAX_FRAME + 1)).unwrap_err().contains("65537"));
    }

    proptest! {
        #[test]
        fn any_text_is_a_message_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..300)) {
            let _ = Asked::read(&String::from_utf8_lossy(&bytes));
        }

        #[test]
        fn any_pieces_of_a_message_are_a_message_or_an_error(pieces in prop::collection::vec(
            prop::sample::select(vec![
                "{", "}", "[", "]", ",", ":", "\"type\"", "\"pointer_target\"", "\"position\"", "1", "-0",
                "1e400", "NaN", "null", "\"device\"", "\"\"", "\"sequence\"", "true", "\"grasp\"", "\\u0000", "\"ping\"", "\"t\"",
            ]), 0..40))
        {
            if let Ok(Asked::PointerTarget { position, .. }) = Asked::read(&pieces.concat()) {
                prop_assert!(position.iter().all(|x| x.is_finite()));
            }
        }
    }
}
