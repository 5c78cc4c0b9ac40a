//! From the service's message to the state of the handle.

use glam::{DQuat, DVec3};
use rhombus_chain::Pose;

use super::frame::{device_from_service, device_orientation_from_service};
use super::message::{Arm, Grip, Message};
use crate::{DeviceState, MAX_STATUS, MotorsOff};

/// What [`Description::status_names`](crate::Description::status_names) says here; -1 where the service says nothing.
pub(super) const STATUS_NAMES: &[&str] = &[
    "calibrated",
    "in_use",
    "power_supply",
    "ready",
    "started",
    // 0 idle, 1 position, 2 force.
    "control_mode",
    "grip_ready",
    "grip_awake",
    "grip_battery_percent",
];
/// Topic names of a grip's buttons.
pub(super) const BUTTONS: [&str; 4] = ["a", "b", "c", "home"];

/// Time constant of the angular velocity's filter, s. The service gives orientations only.
const TURNING_FILTER_S: f64 = 0.01;
/// The device is held to have taken its motors off itself when it says idle for so long although it gets forces.
const IDLE_AFTER_NS: u64 = 100_000_000;

/// Makes readings, each from one message and the one before.
#[derive(Debug)]
pub(super) struct Reader {
    device_id: String,
    grip_id: Option<String>,
    orientation: DQuat,
    turning_rad_per_s: DVec3,
    last_ns: u64,
    /// Since when the device has said idle although it got forces.
    idle_since_ns: Option<u64>,
}

impl Reader {
    pub(super) fn new(device_id: String, grip_id: Option<String>) -> Reader {
        Reader {
            device_id,
            grip_id,
            orientation: DQuat::IDENTITY,
            turning_rad_per_s: DVec3::ZERO,
            last_ns: 0,
            idle_since_ns: None,
        }
    }

    /// The state in a message that arrived at `now_ns`; `forced`: it answers a request with a force.
    pub(super) fn state(
        &mut self,
        message: &Message,
        now_ns: u64,
        forced: bool,
    ) -> Result<DeviceState, &'static str> {
        let arm = message
            .arms()
            .iter()
            .find(|arm| arm.device_id == self.device_id)
            .ok_or("its service lists the device no more: it was unplugged or switched off")?;
        let position = arm.state.cursor_position.ok_or("its service gives no position")?;
        let velocity = arm.state.cursor_velocity.map_or(DVec3::ZERO, DVec3::from);
        let grip = self.grip_id.as_deref().and_then(|id| message.grip(id));
        self.turn(grip, now_ns);
        let pose =
            Pose { translation: device_from_service(DVec3::from(position)), rotation: self.orientation };
        let state = DeviceState {
            linear_velocity_m_per_s: device_from_service(velocity),
            angular_velocity_rad_per_s: self.turning_rad_per_s,
            buttons: grip.map_or(0, buttons),
            homed: arm.status.calibrated != Some(false),
            motors_off: self.motors_off(arm, now_ns, forced),
            status: status(arm, grip),
            device_time_ns: now_ns,
            ..DeviceState::at_rest(pose)
        };
        if state.is_finite() { Ok(state) } else { Err("its service gives positions that are no numbers") }
    }

    /// Follows the grip. One that sleeps or is out of reach keeps its last orientation.
    fn turn(&mut self, grip: Option<&Grip>, now_ns: u64) {
        let since_s = now_ns.saturating_sub(self.last_ns) as f64 * 1e-9;
        let first = std::mem::replace(&mut self.last_ns, now_ns) == 0;
        let seen = grip.and_then(|grip| grip.state.orientation?.rotation());
        let Some(orientation) = seen.map(device_orientation_from_service) else {
            self.turning_rad_per_s = DVec3::ZERO;
            return;
        };
        if !first && since_s > 0.0 {
            let turned = rotation_vector(orientation * self.orientation.conjugate());
            let share = since_s / (since_s + TURNING_FILTER_S);
            self.turning_rad_per_s += share * (turned / since_s - self.turning_rad_per_s);
        }
        self.orientation = orientation;
    }

    fn motors_off(&mut self, arm: &Arm, now_ns: u64, forced: bool) -> Option<MotorsOff> {
        if arm.status.power_supply == Some(false) || arm.status.calibrated == Some(false) {
            return Some(MotorsOff::Other);
        }
        let idle = forced && arm.state.control_mode.as_deref() == Some("idle");
        if !idle {
            self.idle_since_ns = None;
            return None;
        }
        let since_ns = *self.idle_since_ns.get_or_insert(now_ns);
        (now_ns.saturating_sub(since_ns) >= IDLE_AFTER_NS).then_some(MotorsOff::Other)
    }
}

/// The rotation vector, the short way round.
fn rotation_vector(q: DQuat) -> DVec3 {
    if q.w < 0.0 { (-q).to_scaled_axis() } else { q.to_scaled_axis() }
}

fn buttons(grip: &Grip) -> u32 {
    let all = grip.state.buttons.unwrap_or_default();
    let pressed = [all.a || grip.state.button == Some(true), all.b, all.c, all.home];
    pressed.iter().enumerate().fold(0, |bits, (bit, &pressed)| bits | u32::from(pressed) << bit)
}

fn status(arm: &Arm, grip: Option<&Grip>) -> [i32; MAX_STATUS] {
    let flag = |flag: Option<bool>| flag.map_or(-1, i32::from);
    let mode = match arm.state.control_mode.as_deref() {
        Some("idle") => 0,
        Some("position") => 1,
        Some("force") => 2,
        _ => -1,
    };
    let battery = grip.and_then(|grip| grip.state.battery_level).map_or(-1, |level| (level * 100.0) as i32);
    let known = [
        flag(arm.status.calibrated),
        flag(arm.status.in_use),
        flag(arm.status.power_supply),
        flag(arm.status.ready),
        flag(arm.status.started),
        mode,
        flag(grip.and_then(|grip| grip.status.ready)),
        flag(grip.and_then(|grip| grip.status.awake)),
        battery,
    ];
    let mut status = [0; MAX_STATUS];
    status[..known.len()].copy_from_slice(&known);
    status
}
