//! What every haptic device can do, whoever made it.

use std::time::Duration;

use glam::DVec3;
use rhombus_chain::Pose;

use crate::DeviceError;

/// The most joints of a device that are reported.
pub const MAX_JOINTS: usize = 8;
/// The most numbers that a device reports about its own health.
pub const MAX_STATUS: usize = 20;

/// One open haptic device. Positions, velocities and wrenches are in the device's own frame, which stands still.
///
/// A value of this type is a device that answers: opening is the constructor of the backend (see
/// [`Backend`](crate::Backend)), so there is no closed device to be careful with. After opening, the motors are off
/// until [`enable`](Device::enable). [`read`](Device::read) and [`command`](Device::command) are called in turn, once
/// for each period of the motor loop, from one thread. Dropping a device leaves its motors off.
pub trait Device: Send {
    /// What was opened. Constant while the device is open.
    fn description(&self) -> &Description;

    /// The handle as it is now. RT safe: no allocation, no lock, no waiting beyond the device's own transfer.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] when the device does not answer.
    fn read(&mut self) -> Result<DeviceState, DeviceError>;

    /// Sets the wrench on the hand, held until the next call or the device's own watchdog. The caller has checked that
    /// it is finite and within [`Description::limits`]. RT safe like [`read`](Device::read).
    ///
    /// # Errors
    /// [`DeviceError::Lost`] when the device does not take it; it may then still hold the wrench before.
    fn command(&mut self, wrench: &Wrench) -> Result<(), DeviceError>;

    /// Motors on, without a force. Waits for no mechanics.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] when the device does not confirm it.
    fn enable(&mut self) -> Result<(), DeviceError>;

    /// Takes the force away: motors off. May be called more than once, and after an error.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] when the device does not confirm it.
    fn disable(&mut self) -> Result<(), DeviceError>;

    /// Finds the device's reference position. May take seconds and move the handle; never called with a force commanded.
    /// Nothing else is served meanwhile, and it cannot be interrupted.
    ///
    /// # Errors
    /// What the device says.
    fn home(&mut self) -> Result<(), DeviceError> {
        Ok(())
    }

    /// Lets the device carry its own weight, or not.
    ///
    /// # Errors
    /// [`DeviceError::Unsupported`] where there is nothing to switch.
    fn set_gravity_compensation(&mut self, on: bool) -> Result<(), DeviceError> {
        let _ = on;
        Err(DeviceError::Unsupported { device: self.description().backend, what: "gravity compensation" })
    }
}

/// A force, a torque and a gripper force on the hand, in the device frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench {
    /// Force on the hand, N.
    pub force_n: DVec3,
    /// Torque on the hand, N m.
    pub torque_n_m: DVec3,
    /// Force of the gripper on the fingers, N; positive opens.
    pub gripper_force_n: f64,
}

impl Description {
    /// Whether there is no hardware: handle and hand are gone with the process.
    pub fn is_virtual(&self) -> bool {
        matches!(self.backend, "simulated" | "pointer")
    }
}

impl Wrench {
    /// No force at all.
    pub const ZERO: Wrench = Wrench { force_n: DVec3::ZERO, torque_n_m: DVec3::ZERO, gripper_force_n: 0.0 };

    /// A force without torque and gripper force.
    pub const fn of_force(force_n: DVec3) -> Wrench {
        Wrench { force_n, ..Wrench::ZERO }
    }

    /// Whether every number is finite. RT safe.
    pub fn is_finite(&self) -> bool {
        self.force_n.is_finite() && self.torque_n_m.is_finite() && self.gripper_force_n.is_finite()
    }
}

/// Which device it is, and what it has.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// The backend's name, as `device.backend` has it.
    pub backend: &'static str,
    /// The model, as its maker calls it.
    pub model: String,
    /// The serial number or id by which `device.serial` selects it.
    pub serial: String,
    /// Versions of firmware and SDK or service; empty where unknown.
    pub firmware: String,
    /// What it can reach and push with.
    pub limits: DeviceLimits,
    /// Topic names of the buttons; the place in the list is the bit in [`DeviceState::buttons`].
    pub buttons: Vec<String>,
    /// Names of the joints in [`DeviceState::joints`]; empty where joints are not reported.
    pub joints: Vec<String>,
    /// Whether the opening of a gripper is measured.
    pub has_gripper: bool,
    /// Whether positions mean something only after [`Device::home`].
    pub needs_homing: bool,
    /// After this time without a command the device itself takes the force away; none: it does not.
    pub watchdog: Option<Duration>,
    /// Names of the numbers in [`DeviceState::status`].
    pub status_names: &'static [&'static str],
}

/// The handle at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviceState {
    /// Pose of the handle in the device frame.
    pub pose: Pose,
    /// Velocity of the handle's origin, m/s.
    pub linear_velocity_m_per_s: DVec3,
    /// Angular velocity of the handle in the device frame, rad/s.
    pub angular_velocity_rad_per_s: DVec3,
    /// Opening angle of the gripper; none when the device has no gripper.
    pub gripper_rad: Option<f64>,
    /// Pressed buttons, one bit each; bit 0 is the device's first button.
    pub buttons: u32,
    /// Joint positions, rad or m, as many as [`Description::joints`] names.
    pub joints: [f64; MAX_JOINTS],
    /// Whether the position is referenced.
    pub homed: bool,
    /// Why the device itself keeps its motors off although it was enabled; none: it does not.
    pub motors_off: Option<MotorsOff>,
    /// The device's own account of its health, by [`Description::status_names`].
    pub status: [i32; MAX_STATUS],
    /// Time of the sample on the device's own clock, which starts anywhere and never goes back.
    pub device_time_ns: u64,
}

impl DeviceState {
    /// A handle at rest at `pose`, homed, with nothing else to say.
    pub fn at_rest(pose: Pose) -> DeviceState {
        DeviceState {
            pose,
            linear_velocity_m_per_s: DVec3::ZERO,
            angular_velocity_rad_per_s: DVec3::ZERO,
            gripper_rad: None,
            buttons: 0,
            joints: [0.0; MAX_JOINTS],
            homed: true,
            motors_off: None,
            status: [0; MAX_STATUS],
            device_time_ns: 0,
        }
    }

    /// Whether every number is finite. A state that is not must not reach a force computation. RT safe.
    pub fn is_finite(&self) -> bool {
        self.pose.translation.is_finite()
            && self.pose.rotation.is_finite()
            && self.linear_velocity_m_per_s.is_finite()
            && self.angular_velocity_rad_per_s.is_finite()
            && self.gripper_rad.is_none_or(f64::is_finite)
            && self.joints.iter().all(|joint| joint.is_finite())
    }
}

/// Why a device keeps its motors off by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotorsOff {
    /// The button that switches the forces on is not pressed.
    Button,
    /// The handle was faster than the device allows.
    Velocity,
    /// No command came in time.
    Watchdog,
    /// Software said so.
    Software,
    /// The cable was pulled.
    Usb,
    /// The dead man's switch was released.
    DeadMan,
    /// The device's own emergency stop.
    Emergency,
    /// Another reason of the device.
    Other,
}

/// What a device can reach and push with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviceLimits {
    /// The largest force the device may be asked for, N; none: it has no motors.
    pub max_force_n: Option<f64>,
    /// The largest torque, N m; none: the wrist has no motors.
    pub max_torque_n_m: Option<f64>,
    /// The largest gripper force, N; none: the gripper has no motor.
    pub max_gripper_force_n: Option<f64>,
    /// Where the handle can be.
    pub workspace: Workspace,
}

/// Where a handle can be: a cylinder, its axis along the device frame's z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Workspace {
    /// Middle of the cylinder in the device frame, m.
    pub centre: DVec3,
    /// Radius, m.
    pub radius_m: f64,
    /// Height, m: from minus to plus half of it around the centre.
    pub height_m: f64,
}

impl Workspace {
    /// Whether a point is inside. RT safe.
    pub fn contains(&self, point: DVec3) -> bool {
        let at = point - self.centre;
        at.truncate().length() <= self.radius_m && at.z.abs() <= 0.5 * self.height_m
    }

    /// The point of the workspace that is nearest to a finite one, however far away that is. RT safe.
    pub fn nearest(&self, point: DVec3) -> DVec3 {
        let far = 1e3 * (self.radius_m + self.height_m);
        let mut at = point - self.centre;
        let largest = at.abs().max_element();
        if largest > far {
            // Squares of what is larger might overflow.
            at = at / largest * far;
        }
        let half_height_m = 0.5 * self.height_m;
        let across = at.truncate().clamp_length_max(self.radius_m);
        self.centre + across.extend(at.z.clamp(-half_height_m, half_height_m))
    }
}

/// What a backend finds.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Listed {
    /// The devices.
    pub found: Vec<Found>,
    /// Why more may be there than were found.
    pub problems: Vec<DeviceError>,
}

impl From<Vec<Found>> for Listed {
    fn from(found: Vec<Found>) -> Listed {
        Listed { found, problems: Vec::new() }
    }
}

/// A device that is connected, opened or not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// The backend.
    pub backend: &'static str,
    /// What `device.serial` selects it by.
    pub serial: String,
    /// One line for people: model, port, what is known.
    pub what: String,
}
