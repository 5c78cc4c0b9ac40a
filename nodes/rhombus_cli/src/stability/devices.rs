//! Haptic devices by name, with what is published about them.
//!
//! Makers do not publish the damping of their devices; what is published is the largest stiffness a device is fit to
//! render when its own driver closes the loop. The damping at which that stiffness is just passive,
//! `b = K T/2` at the device's rate, is what a device is credited with here: it stands for all that damps the device in
//! the hand, friction included. Real devices often stay stable beyond the passive limit thanks to friction
//! (Diolaiti, Niemeyer, Barbagli, Salisbury, "Stability of Haptic Rendering: Discretization, Quantization, Time Delay, and
//! Coulomb Effects", IEEE Transactions on Robotics 22(2), 2006), so this is on the side of caution only as far as the
//! published stiffness is. The rate is the highest that its source names: a higher rate means less damping for the same stiffness.

/// What is published about a device.
pub(super) struct Published {
    /// What `--device` calls it.
    pub(super) name: &'static str,
    /// Largest stiffness it is fit to render, N/m.
    largest_stiffness_n_per_m: f64,
    /// The rate that was taken for it, Hz.
    pub(super) rate_hz: f64,
    /// Where the figures come from.
    pub(super) source: &'static str,
}

impl Published {
    /// `K T/2`, N s/m.
    pub(super) fn damping_n_s_per_m(&self) -> f64 {
        0.5 * self.largest_stiffness_n_per_m / self.rate_hz
    }
}

/// The simulated device of the scene: its damping is `simulated.damping`, its rate `device.rate`.
pub(super) const SIMULATED: &str = "simulated";

/// Stiffness: the specifications of the CHAI3D library, CPhantomDevices.cpp. Rate: assumed, no publication was read for it.
const PHANTOM: &str =
    "largest stiffness: CHAI3D (7c76b1f) src/devices/CPhantomDevices.cpp; rate: 1 kHz, assumed";
/// Stiffness: the specifications of the CHAI3D library, CDeltaDevices.cpp. Rate: the sample interval of 0.5 ms that the ROS 2
/// node set ricmua/ros_force_dimension recommends.
const FORCE_DIMENSION: &str = "largest stiffness: CHAI3D (7c76b1f) src/devices/CDeltaDevices.cpp; rate: 2 kHz as ros_force_dimension recommends";
/// Stiffness: as above. Rate: Novint Technologies, "How the Novint Falcon works", 28 May 2008.
const NOVINT: &str = "largest stiffness: CHAI3D (7c76b1f) src/devices/CDeltaDevices.cpp; rate: 1 kHz, Novint Technologies 2008";

/// In the order in which an error lists them.
pub(super) const DEVICES: [Published; 10] = [
    device("falcon", 3000.0, 1000.0, NOVINT),
    device("omega.x", 5000.0, 2000.0, FORCE_DIMENSION),
    device("delta.3", 5000.0, 2000.0, FORCE_DIMENSION),
    device("sigma.7", 4000.0, 2000.0, FORCE_DIMENSION),
    device("lambda.7", 8000.0, 2000.0, FORCE_DIMENSION),
    device("touch", 400.0, 1000.0, PHANTOM),
    device("phantom-omni", 700.0, 1000.0, PHANTOM),
    device("phantom-desktop", 1000.0, 1000.0, PHANTOM),
    device("phantom-premium-1.5-6dof", 800.0, 1000.0, PHANTOM),
    device("phantom-premium-3.0-6dof", 1000.0, 1000.0, PHANTOM),
];

const fn device(
    name: &'static str,
    largest_stiffness_n_per_m: f64,
    rate_hz: f64,
    source: &'static str,
) -> Published {
    Published { name, largest_stiffness_n_per_m, rate_hz, source }
}

/// The device of that name, if it is not the simulated one.
///
/// # Errors
/// A name that is not in the table; the message lists those that are.
pub(super) fn published(name: &str) -> Result<Option<&'static Published>, String> {
    if name == SIMULATED {
        return Ok(None);
    }
    DEVICES.iter().find(|device| device.name == name).map(Some).ok_or_else(|| {
        let names: Vec<&str> = DEVICES.iter().map(|device| device.name).collect();
        format!("accepted: {SIMULATED} (with simulated.damping of the scene), {}", names.join(", "))
    })
}
