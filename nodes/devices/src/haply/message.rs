//! What the service says: one JSON object that lists devices, each with its state and status, and now and then its
//! configuration (<https://docs.haply.co/inverseSDK/service/realtime/websocket-protocol>). Only what is used here is read;
//! everything else may be there or not.

use std::borrow::Cow;

use glam::{DQuat, DVec3};
use serde::Deserialize;

/// One message.
#[derive(Debug, Deserialize)]
pub(super) struct Message<'a> {
    session_id: Option<u64>,
    #[serde(borrow)]
    inverse3: Option<Vec<Arm<'a>>>,
    #[serde(borrow, default)]
    verse_grip: Vec<Grip<'a>>,
    #[serde(borrow, default)]
    wireless_verse_grip: Vec<Grip<'a>>,
    #[serde(borrow, default)]
    custom_verse_grip: Vec<Grip<'a>>,
}

impl<'a> Message<'a> {
    /// Reads a text. The error is for people.
    pub(super) fn parse(text: &'a str) -> Result<Message<'a>, String> {
        let message: Message<'a> = serde_json::from_str(text).map_err(|error| error.to_string())?;
        if message.session_id.is_none() && message.inverse3.is_none() {
            return Err("neither session_id nor inverse3 is in it".to_owned());
        }
        Ok(message)
    }

    /// The Inverse3 devices.
    pub(super) fn arms(&self) -> &[Arm<'a>] {
        self.inverse3.as_deref().unwrap_or_default()
    }

    /// The grips, each once: the service may list one among the wireless ones and among the custom ones.
    pub(super) fn grips(&self) -> Vec<&Grip<'a>> {
        let mut grips: Vec<&Grip<'a>> = Vec::new();
        for grip in self.all_grips() {
            if !grips.iter().any(|known| known.device_id == grip.device_id) {
                grips.push(grip);
            }
        }
        grips
    }

    /// The grip of that id.
    pub(super) fn grip(&self, id: &str) -> Option<&Grip<'a>> {
        self.all_grips().find(|grip| grip.device_id == id)
    }

    fn all_grips(&self) -> impl Iterator<Item = &Grip<'a>> {
        self.wireless_verse_grip.iter().chain(&self.custom_verse_grip).chain(&self.verse_grip)
    }
}

/// An Inverse3.
#[derive(Debug, Deserialize)]
pub(super) struct Arm<'a> {
    #[serde(borrow)]
    pub(super) device_id: Cow<'a, str>,
    #[serde(borrow)]
    pub(super) config: Option<ArmConfig<'a>>,
    #[serde(borrow, default)]
    pub(super) state: ArmState<'a>,
    #[serde(default)]
    pub(super) status: ArmStatus,
}

/// Its configuration: in the first message, and when all is asked for.
#[derive(Debug, Deserialize)]
pub(super) struct ArmConfig<'a> {
    #[serde(rename = "type", borrow)]
    pub(super) kind: Option<Cow<'a, str>>,
    #[serde(borrow)]
    pub(super) device_info: Option<DeviceInfo<'a>>,
    #[serde(borrow)]
    pub(super) port: Option<Cow<'a, str>>,
    #[serde(borrow)]
    pub(super) extended_firmware_version: Option<Cow<'a, str>>,
    /// Since service 3.5.
    #[serde(borrow)]
    pub(super) preset: Option<Cow<'a, str>>,
    #[serde(borrow, alias = "coordinate_system")]
    pub(super) basis: Option<Basis<'a>>,
}

/// Versions and the long id.
#[derive(Debug, Deserialize)]
pub(super) struct DeviceInfo<'a> {
    pub(super) major_version: Option<u64>,
    pub(super) minor_version: Option<u64>,
    #[serde(borrow)]
    pub(super) uuid: Option<Cow<'a, str>>,
}

/// Which axes the service is set to use.
#[derive(Debug, Deserialize)]
pub(super) struct Basis<'a> {
    #[serde(borrow)]
    pub(super) permutation: Option<Cow<'a, str>>,
}

/// Its state.
#[derive(Debug, Default, Deserialize)]
pub(super) struct ArmState<'a> {
    /// m.
    pub(super) cursor_position: Option<Vector>,
    /// m/s.
    pub(super) cursor_velocity: Option<Vector>,
    /// N; since service 3.5.
    pub(super) current_cursor_force: Option<Vector>,
    #[serde(borrow)]
    pub(super) control_mode: Option<Cow<'a, str>>,
}

/// Its status.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
pub(super) struct ArmStatus {
    pub(super) calibrated: Option<bool>,
    pub(super) in_use: Option<bool>,
    pub(super) power_supply: Option<bool>,
    pub(super) ready: Option<bool>,
    pub(super) started: Option<bool>,
}

/// A grip of any kind.
#[derive(Debug, Deserialize)]
pub(super) struct Grip<'a> {
    #[serde(borrow)]
    pub(super) device_id: Cow<'a, str>,
    #[serde(default)]
    pub(super) state: GripState,
    #[serde(default)]
    pub(super) status: GripStatus,
}

/// Its state.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
pub(super) struct GripState {
    pub(super) orientation: Option<Quaternion>,
    pub(super) buttons: Option<Buttons>,
    /// The one button of the wired grip.
    pub(super) button: Option<bool>,
    /// 0 to 1.
    pub(super) battery_level: Option<f64>,
}

/// Its status.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
pub(super) struct GripStatus {
    pub(super) ready: Option<bool>,
    pub(super) awake: Option<bool>,
}

/// The buttons of a grip.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
pub(super) struct Buttons {
    #[serde(default)]
    pub(super) a: bool,
    #[serde(default)]
    pub(super) b: bool,
    #[serde(default)]
    pub(super) c: bool,
    #[serde(default)]
    pub(super) home: bool,
}

/// Three numbers.
#[derive(Clone, Copy, Debug, Deserialize)]
pub(super) struct Vector {
    x: f64,
    y: f64,
    z: f64,
}

impl From<Vector> for DVec3 {
    fn from(v: Vector) -> DVec3 {
        DVec3::new(v.x, v.y, v.z)
    }
}

/// An orientation.
#[derive(Clone, Copy, Debug, Deserialize)]
pub(super) struct Quaternion {
    x: f64,
    y: f64,
    z: f64,
    w: f64,
}

impl Quaternion {
    /// A rotation; none when the numbers are not one, as those of a grip that sleeps.
    pub(super) fn rotation(self) -> Option<DQuat> {
        let q = DQuat::from_xyzw(self.x, self.y, self.z, self.w);
        let length = q.length();
        (0.9..=1.1).contains(&length).then(|| q / length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_message_of_another_kind_of_service_is_refused() {
        for text in [
            "",
            "[]",
            "{}",
            "7",
            "{\"name\":\"device-connected\"}",
            "{\"inverse3\":{\"049D\":{}}}",
            "{\"inver",
        ] {
            assert!(Message::parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn numbers_that_are_none_are_refused() {
        for x in ["\"0.1\"", "null", "1e999", "NaN", "[0]"] {
            let text = format!(
                "{{\"inverse3\":[{{\"device_id\":\"1\",\"state\":{{\"cursor_position\":{{\"x\":{x},\"y\":0,\"z\":0}}}}}}]}}"
            );
            assert!(Message::parse(&text).is_err(), "{x}");
        }
    }

    #[test]
    fn a_grip_that_is_listed_twice_is_one() {
        let text = r#"{"session_id":1,"wireless_verse_grip":[{"device_id":"A"}],"custom_verse_grip":[{"device_id":"A"},
            {"device_id":"B"}]}"#;
        let message = Message::parse(text).unwrap();
        let ids: Vec<&str> = message.grips().iter().map(|grip| &*grip.device_id).collect();
        assert_eq!(ids, ["A", "B"]);
    }

    proptest! {
        #[test]
        fn no_text_makes_the_reader_fall_over(text in ".{0,200}") {
            let _ = Message::parse(&text);
        }
    }
}
