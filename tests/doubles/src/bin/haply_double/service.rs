//! The service: what is connected to it, what it says, what it obeys.

use std::io;
use std::sync::{Mutex, PoisonError};

use devices::{Workspace, Wrench};
use glam::{DQuat, DVec3};
use rhombus_doubles::{Event, Motors, PressingHand, Record, Signals, monotonic_ns};
use serde_json::{Value, json};

use crate::options::Options;

/// Time between two steps of the hand.
pub(crate) const STEP_NS: u64 = 500_000;
const WORKSPACE: Workspace = Workspace { centre: DVec3::ZERO, radius_m: 0.4, height_m: 0.8 };

/// The grip turns about the service's y (forward) with this speed, rad/s, and has its buttons a and c pressed.
const GRIP_TURNS_RAD_PER_S: f64 = 0.5;

/// The recorded device.
pub(crate) struct Handle {
    pub(crate) hand: PressingHand,
    pub(crate) motors: Motors,
}

/// The service with all that is connected to it.
pub(crate) struct Service {
    pub(crate) options: Options,
    pub(crate) signals: Signals,
    pub(crate) handle: Mutex<Handle>,
    pub(crate) begin_ns: u64,
}

impl Service {
    /// Begins with the hand at rest and the motors off.
    pub(crate) fn new(options: Options, signals: Signals) -> Result<Service, Box<dyn std::error::Error>> {
        let motors = Motors::new(Some(options.tick), Record::create(options.record.as_deref())?);
        let hand = PressingHand::new(options.hand, WORKSPACE, STEP_NS as f64 * 1e-9)?;
        let handle = Mutex::new(Handle { hand, motors });
        Ok(Service { options, signals, handle, begin_ns: monotonic_ns() })
    }

    /// The recorded device.
    pub(crate) fn handle(&self) -> std::sync::MutexGuard<'_, Handle> {
        self.handle.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What goes wrong after so many messages were sent; empty: nothing.
    pub(crate) fn fault(&self, sent: usize) -> &str {
        if sent >= self.options.fault_after { &self.options.fault } else { "" }
    }

    /// The force that a message has for the recorded device; none: the device is to idle.
    fn force(&self, request: &Value) -> Option<DVec3> {
        let id = self.options.devices.first()?;
        let arm = request["inverse3"].as_array()?.iter().find(|arm| arm["device_id"] == id.as_str())?;
        let key = if self.options.is_3_5 { "vector" } else { "values" };
        let force = &arm["commands"]["set_cursor_force"][key];
        Some(DVec3::new(force["x"].as_f64()?, force["y"].as_f64()?, force["z"].as_f64()?))
    }

    /// Does what a message asks for. `commands`: whether its session is one that commands the device, and with a message
    /// without a force lets it idle; of the others a question is only a question.
    pub(crate) fn obey(&self, request: &Value, commands: &mut bool) -> io::Result<()> {
        let now_ns = monotonic_ns();
        let mut handle = self.handle();
        match self.force(request) {
            Some(force_n) if !self.signals.unplugged() => {
                *commands = true;
                if !handle.motors.are_on() {
                    handle.motors.enable(now_ns)?;
                }
                handle.motors.command(now_ns, Wrench::of_force(force_n))
            }
            _ if std::mem::take(commands) && handle.motors.are_on() => handle.motors.off(now_ns, Event::Off),
            _ => Ok(()),
        }
    }

    /// What is said about all devices.
    pub(crate) fn inventory(&self, with_config: bool, sent: usize) -> String {
        let arms: Vec<Value> = self
            .options
            .devices
            .iter()
            .filter(|_| !self.signals.unplugged() && self.fault(sent) != "no-device")
            .map(|id| self.arm(id, with_config, sent))
            .collect();
        let since_s = (monotonic_ns() - self.begin_ns) as f64 * 1e-9;
        let q = DQuat::from_rotation_y(GRIP_TURNS_RAD_PER_S * since_s);
        let grips: Vec<Value> = self
            .options
            .grips
            .iter()
            .map(|id| {
                json!({"device_id": id, "status": {"ready": true, "connected": true, "awake": true}, "state": {
                    "battery_level": 0.5, "hall": 16,
                    "orientation": {"x": q.x, "y": q.y, "z": q.z, "w": q.w},
                    "buttons": {"a": true, "b": false, "c": true}}})
            })
            .collect();
        let text = json!({"session_id": 7, "inverse3": arms, "verse_grip": [], "wireless_verse_grip": grips,
            "custom_verse_grip": grips})
        .to_string();
        match self.fault(sent) {
            "not-json" => "<html>".to_owned(),
            "other-json" => r#"{"name":"device-connected","category":"device"}"#.to_owned(),
            "legacy" => r#"{"inverse3":{"049D":{"state":{}}}}"#.to_owned(),
            "half" => text[..text.len() / 2].to_owned(),
            "no-number" => {
                text.replace("\"cursor_position\":{\"x\":", "\"cursor_position\":{\"x\":\"NaN\",\"w\":")
            }
            "too-large" => {
                text.replace("\"cursor_position\":{\"x\":", "\"cursor_position\":{\"x\":1e999,\"w\":")
            }
            _ => text,
        }
    }

    fn arm(&self, id: &str, with_config: bool, sent: usize) -> Value {
        let mut handle = self.handle();
        let is_recorded = self.options.devices.first().is_some_and(|first| first == id);
        let force_n =
            if is_recorded { handle.motors.wrench(monotonic_ns()).unwrap_or_default() } else { Wrench::ZERO };
        let is_on = is_recorded && handle.motors.are_on() && self.fault(sent) != "idle";
        let vector = |v: DVec3| json!({"x": v.x, "y": v.y, "z": v.z});
        let mut arm = json!({
            "device_id": id,
            "state": {
                "cursor_position": vector(handle.hand.position()),
                "cursor_velocity": vector(handle.hand.velocity()),
                "angular_position": {"a0": 0.0, "a1": 0.0, "a2": 0.0},
                "body_orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0},
                "control_domain": if is_on { "cartesian" } else { "undefined" },
                "control_mode": if is_on { "force" } else { "idle" },
            },
            "status": {"calibrated": self.fault(sent) != "uncalibrated", "in_use": is_on,
                "power_supply": self.fault(sent) != "no-power", "ready": true, "started": true},
        });
        if self.options.is_3_5 {
            arm["state"]["current_cursor_force"] = vector(force_n.force_n);
        }
        if with_config {
            let axes = if self.fault(sent) == "basis" { "XZY" } else { "XYZ" };
            arm["config"] = json!({"type": "inverse3", "port": "/dev/ttyACM0", "handedness": "right",
                "device_info": {"major_version": 7, "minor_version": 4, "id": id, "device_type": 4,
                    "uuid": format!("9AB19C4B5E655E32B4F00F8A59FD{id}")},
                "extended_firmware_version": "8C20FDC8", "basis": {"permutation": axes}});
            if self.options.is_3_5 {
                arm["config"]["preset"] = json!("defaults");
            }
        }
        arm
    }
}
