//! What every haptic device can do, whoever made it.

use glam::DVec3;
use rhombus_chain::Pose;
use thiserror::Error;

/// One open haptic device. All positions, velocities and forces are in the device's own frame, which stands still.
///
/// A value of this type is a device that answers: opening is the constructor of the backend (see
/// [`Backend`](crate::Backend)), so there is no closed device to be careful with. [`read`](Device::read) and
/// [`command`](Device::command) are called in turn, once for each period of the motor loop, from one thread.
pub trait Device: Send {
    /// The backend and, where there is one, the model.
    fn name(&self) -> &str;

    /// What the device can reach and push with. Constant while the device is open.
    fn limits(&self) -> DeviceLimits;

    /// The handle as it is now. RT safe: no allocation, no lock, no waiting beyond the device's own transfer.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] when the device does not answer.
    fn read(&mut self) -> Result<DeviceState, DeviceError>;

    /// Sets the force on the hand, held until the next call. The caller has checked that it is finite and within
    /// [`DeviceLimits::max_force_n`]. RT safe like [`read`](Device::read).
    ///
    /// # Errors
    /// [`DeviceError::Lost`] when the device does not take it; it may then still hold the force before.
    fn command(&mut self, force_n: DVec3) -> Result<(), DeviceError>;

    /// Takes the force away for good: motors off. May be called more than once, and after an error.
    ///
    /// # Errors
    /// [`DeviceError::Lost`] when the device does not confirm it.
    fn disable(&mut self) -> Result<(), DeviceError>;
}

/// The handle at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviceState {
    /// Pose of the handle in the device frame.
    pub pose: Pose,
    /// Velocity of the handle's origin, m/s.
    pub linear_velocity_m_per_s: DVec3,
    /// Angular velocity of the handle, rad/s.
    pub angular_velocity_rad_per_s: DVec3,
    /// Opening angle of the gripper; none when the device has no gripper.
    pub gripper_rad: Option<f64>,
    /// Pressed buttons, one bit each; bit 0 is the device's first button.
    pub buttons: u32,
    /// Time of the sample on the device's own clock, which starts anywhere and never goes back.
    pub device_time_ns: u64,
}

impl DeviceState {
    /// Whether every number is finite. A state that is not must not reach a force computation. RT safe.
    pub fn is_finite(&self) -> bool {
        self.pose.translation.is_finite()
            && self.pose.rotation.is_finite()
            && self.linear_velocity_m_per_s.is_finite()
            && self.angular_velocity_rad_per_s.is_finite()
            && self.gripper_rad.is_none_or(f64::is_finite)
    }
}

/// What a device can reach and push with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeviceLimits {
    /// The largest force the device may be asked for, N.
    pub max_force_n: f64,
    /// Where the handle can be.
    pub workspace: Workspace,
}

/// Where a handle can be: a cylinder around the device frame's origin, its axis along z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Workspace {
    /// Radius, m.
    pub radius_m: f64,
    /// Height, m: z goes from minus to plus half of it.
    pub height_m: f64,
}

impl Workspace {
    /// Whether a point is inside. RT safe.
    pub fn contains(&self, point: DVec3) -> bool {
        point.truncate().length() <= self.radius_m && point.z.abs() <= 0.5 * self.height_m
    }
}

/// What can go wrong with a device.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum DeviceError {
    /// A setting that the backend cannot work with.
    #[error("{name} = {value}: accepted is {accepted}")]
    Setting {
        /// The setting, by its parameter name.
        name: &'static str,
        /// What it was.
        value: f64,
        /// What it may be, with its unit.
        accepted: &'static str,
    },
    /// The device stopped answering.
    #[error("lost the {device} device: {reason}")]
    Lost {
        /// The backend.
        device: &'static str,
        /// What failed.
        reason: &'static str,
    },
}
