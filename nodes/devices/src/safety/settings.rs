//! The numbers of the safety layer.

/// What the safety layer keeps to. Plain data; [`checked`](SafetySettings::checked) makes it usable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SafetySettings {
    /// The largest force on the hand, N (`device.max_force`). The device's own limit holds as well.
    pub max_force_n: f64,
    /// The largest torque on the hand, N m (`device.max_torque`).
    pub max_torque_n_m: f64,
    /// The largest gripper force on the fingers, N (`device.max_gripper_force`).
    pub max_gripper_force_n: f64,
    /// The force changes no faster than this, N/s (`safety.slew`), and in no command by more than this times 2 ms.
    pub slew_n_per_s: f64,
    /// The torque changes no faster than this, N m/s (`safety.torque_slew`).
    pub torque_slew_n_m_per_s: f64,
    /// The gripper force changes no faster than this, N/s (`safety.gripper_slew`).
    pub gripper_slew_n_per_s: f64,
    /// The motors push a moving hand with no more than this, W (`safety.max_power`).
    pub max_power_w: f64,
    /// A handle that is faster is a fault, m/s (`safety.max_speed`).
    pub max_speed_m_per_s: f64,
    /// The engage gate opens after commands smaller than this, N (`safety.engage_force`) ...
    pub engage_force_n: f64,
    /// ... in so many periods in a row (`safety.engage_ticks`).
    pub engage_ticks: u32,
    /// Time in which the force then grows from nothing to what is wanted, s (`safety.engage_ramp`).
    pub engage_ramp_s: f64,
    /// A commanded force is used in full for this long, s (`safety.servo_validity`).
    pub servo_validity_s: f64,
    /// A contact law is used for this long after its pose, s, or shorter where it says so (`safety.law_validity`).
    pub law_validity_s: f64,
    /// Time in which the force of a source that is no longer valid falls to nothing, s (`safety.decay`).
    pub decay_s: f64,
    /// Whether the passivity controller acts on the contact law and on holding (`safety.passivity`). Energy is observed
    /// either way.
    pub passivity: bool,
    /// Whether it also acts on commanded wrenches (`safety.servo_passivity`), which then cannot guide or pull a hand.
    pub servo_passivity: bool,
    /// Over this distance to the edge of the workspace outward force fades, m (`safety.workspace_margin`).
    pub workspace_margin_m: f64,
    /// A ROS thread that was silent for this long is a fault, s (`safety.ros_timeout`).
    pub ros_timeout_s: f64,
}

impl Default for SafetySettings {
    fn default() -> SafetySettings {
        SafetySettings {
            max_force_n: 20.0,
            max_torque_n_m: 0.5,
            max_gripper_force_n: 8.0,
            slew_n_per_s: 2000.0,
            torque_slew_n_m_per_s: 50.0,
            gripper_slew_n_per_s: 1000.0,
            max_power_w: 10.0,
            max_speed_m_per_s: 1.5,
            engage_force_n: 0.2,
            engage_ticks: 5,
            engage_ramp_s: 2.0,
            servo_validity_s: 0.02,
            law_validity_s: 0.1,
            decay_s: 0.03,
            passivity: true,
            servo_passivity: false,
            workspace_margin_m: 0.005,
            ros_timeout_s: 1.0,
        }
    }
}
