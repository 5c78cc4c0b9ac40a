//! A device that is not there: a delta-like handle with a hand on it that follows a script and feels the force.

mod flaws;
mod plan;
mod script;

pub use crate::hand::{HandSettings, LIMITS};
pub use flaws::Flaws;
pub use plan::{Motion, Site, press_slide_grasp_pull};
pub use script::{Phase, Script, ScriptError, Segment, Target};

use crate::hand::HeldHandle;
use crate::{Description, Device, DeviceError, DeviceState, Wrench};
use flaws::Measurement;

/// What a simulated device is made from.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The mechanics of hand and handle.
    pub hand: HandSettings,
    /// What the hand means to do.
    pub script: Script,
    /// Time between two commands, s: the motor loop's period.
    pub period_s: f64,
    /// What is wrong with the readings.
    pub flaws: Flaws,
}

/// The simulated device. Its clock is the number of commands it got: [`read`](Device::read) looks at the handle,
/// [`command`](Device::command) lets one period pass under that force. So the same forces give the same motion, bit
/// for bit, however late the loop is. Motors that are off leave the hand to itself.
#[derive(Clone, Debug)]
pub struct SimulatedDevice {
    description: Description,
    script: Script,
    handle: HeldHandle,
    measurement: Option<Measurement>,
}

impl SimulatedDevice {
    /// A hand at rest where its script begins.
    ///
    /// # Errors
    /// [`DeviceError::Setting`] names the parameter that is no mechanics.
    pub fn open(settings: Settings) -> Result<SimulatedDevice, DeviceError> {
        let Settings { hand, script, period_s, flaws } = settings;
        let handle = HeldHandle::new(hand, period_s, script.at(0.0).position)?;
        let description = Description {
            buttons: vec!["button1".to_owned(), "button2".to_owned()],
            has_gripper: true,
            ..HeldHandle::description("simulated", "scripted hand on a delta")
        };
        let mut device = SimulatedDevice { description, script, handle, measurement: None };
        device.measurement = Measurement::new(flaws, period_s, device.truth())?;
        Ok(device)
    }

    /// What the hand is doing. RT safe.
    pub fn target(&self) -> Target {
        self.script.at(self.handle.time_s())
    }

    /// The handle as it really is. RT safe.
    fn truth(&self) -> DeviceState {
        DeviceState { gripper_rad: Some(self.target().gripper_rad), ..self.handle.state() }
    }
}

impl Device for SimulatedDevice {
    fn description(&self) -> &Description {
        &self.description
    }

    fn read(&mut self) -> Result<DeviceState, DeviceError> {
        Ok(self.measurement.as_ref().map_or_else(|| self.truth(), Measurement::reading))
    }

    fn command(&mut self, wrench: &Wrench) -> Result<(), DeviceError> {
        let (script, start_s) = (&self.script, self.handle.time_s());
        self.handle.advance(wrench, |since_s| script.at(start_s + since_s).aim());
        let truth = self.measurement.is_some().then(|| self.truth());
        if let (Some(measurement), Some(truth)) = (&mut self.measurement, truth) {
            measurement.measure(self.handle.commands(), truth);
        }
        Ok(())
    }

    fn enable(&mut self) -> Result<(), DeviceError> {
        self.handle.feel(true);
        Ok(())
    }

    fn disable(&mut self) -> Result<(), DeviceError> {
        self.handle.feel(false);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn device() -> SimulatedDevice {
        flawed_device(Flaws::default())
    }

    fn flawed_device(flaws: Flaws) -> SimulatedDevice {
        let site = |x| Site { point: DVec3::new(x, 0.0, 0.0), normal: DVec3::Z, slide: vec![] };
        let script = press_slide_grasp_pull(&[site(-0.02), site(0.02)], &Motion::default()).unwrap();
        let hand = HandSettings { mass_kg: 0.3, stiffness_n_per_m: 500.0, damping_n_s_per_m: 20.0 };
        let mut device = SimulatedDevice::open(Settings { hand, script, period_s: 1e-3, flaws }).unwrap();
        device.enable().unwrap();
        device
    }

    /// The depth in a wall z < 0 felt by the default probe, and the wall's force.
    fn wall(state: &DeviceState, stiffness_n_per_m: f64) -> (f64, DVec3) {
        let depth_m = (Motion::default().probe_radius_m - state.pose.translation.z).max(0.0);
        (depth_m, DVec3::Z * stiffness_n_per_m * depth_m)
    }

    #[test]
    fn the_force_pushes_the_hand_back_so_that_it_goes_less_deep_than_it_means_to() {
        let mut device = device();
        let mut deepest_m = 0.0f64;
        for _ in 0..12_000 {
            let state = device.read().unwrap();
            let (depth_m, force_n) = wall(&state, 300.0);
            deepest_m = deepest_m.max(depth_m);
            device.command(&Wrench::of_force(force_n)).unwrap();
        }
        // Static balance of 500 N/m against 300 N/m: 5/8 of the intended depth.
        let balance_m = Motion::default().depth_m * 500.0 / 800.0;
        assert!((deepest_m - balance_m).abs() < 0.03 * balance_m, "{deepest_m}");
    }

    #[test]
    fn the_same_forces_give_the_same_motion_bit_for_bit() {
        let run = || {
            let mut device = device();
            let mut states = Vec::new();
            for _ in 0..3000 {
                let state = device.read().unwrap();
                device.command(&Wrench::of_force(wall(&state, 250.0).1)).unwrap();
                states.push(state);
            }
            states
        };
        assert_eq!(run(), run());
    }

    #[test]
    fn nothing_moves_without_a_command() {
        let mut device = device();
        assert_eq!(device.read().unwrap(), device.read().unwrap());
    }

    #[test]
    fn motors_that_are_off_leave_the_hand_to_itself() {
        let (mut pushed, mut left) = (device(), device());
        pushed.disable().unwrap();
        let push = Wrench { force_n: DVec3::splat(5.0), torque_n_m: DVec3::splat(0.1), gripper_force_n: 1.0 };
        for _ in 0..500 {
            pushed.command(&push).unwrap();
            left.command(&Wrench::ZERO).unwrap();
            assert_eq!(pushed.read(), left.read());
        }
        pushed.enable().unwrap();
        pushed.command(&push).unwrap();
        left.command(&Wrench::ZERO).unwrap();
        assert_ne!(pushed.read(), left.read());
    }

    #[test]
    fn a_torque_turns_the_handle_and_moves_it_not() {
        let (mut turned, mut left) = (device(), device());
        let torque = Wrench { torque_n_m: DVec3::new(0.1, 0.0, 0.0), ..Wrench::ZERO };
        for _ in 0..1000 {
            turned.command(&torque).unwrap();
            left.command(&Wrench::ZERO).unwrap();
        }
        let (turned, left) = (turned.read().unwrap(), left.read().unwrap());
        assert_eq!(turned.pose.translation, left.pose.translation);
        assert!((turned.pose.rotation.to_scaled_axis() - DVec3::X * 0.1).length() < 1e-6);
        assert_eq!(left.pose.rotation, glam::DQuat::IDENTITY);
    }

    #[test]
    fn flaws_change_what_is_read_and_not_what_happens() {
        let all = Flaws { noise_m: 1e-4, quantisation_m: 1e-5, dropout: 0.2, latency_s: 0.003 };
        let (mut flawed, mut ideal) = (flawed_device(all), device());
        for tick in 0..2000 {
            let push = Wrench::of_force(DVec3::Z * f64::from(tick % 7));
            flawed.command(&push).unwrap();
            ideal.command(&push).unwrap();
            assert_eq!(flawed.truth(), ideal.read().unwrap());
            assert_eq!(flawed.read(), flawed.read(), "reading twice is the same");
        }
        assert_ne!(flawed.read(), ideal.read());
    }
}
