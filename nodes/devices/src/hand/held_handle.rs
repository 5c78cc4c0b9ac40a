//! A handle in a hand: what the devices that are not there have in common.

use glam::DVec3;
use rhombus_chain::Pose;

use super::wrist::Wrist;
use super::{Aim, Hand, HandSettings, LIMITS};
use crate::{Description, DeviceError, DeviceState, Wrench};

/// A handle that is held. Its clock is the number of periods that were advanced; motors that are off are not felt.
#[derive(Clone, Debug)]
pub(crate) struct HeldHandle {
    period_s: f64,
    hand: Hand,
    wrist: Wrist,
    periods: u64,
    feels: bool,
}

impl HeldHandle {
    /// At rest at `position` (device frame, m), not turned, the motors off.
    ///
    /// # Errors
    /// [`DeviceError::Setting`] names the parameter that is no mechanics.
    pub(crate) fn new(
        settings: HandSettings,
        period_s: f64,
        position: DVec3,
    ) -> Result<HeldHandle, DeviceError> {
        let hand = Hand::new(settings, period_s, position)?;
        let (steps, step_s) = hand.steps();
        Ok(HeldHandle { period_s, hand, wrist: Wrist::new(steps, step_s), periods: 0, feels: false })
    }

    /// The description of a device with such a handle, without buttons and gripper.
    pub(crate) fn description(backend: &'static str, model: &str) -> Description {
        Description {
            backend,
            model: model.to_owned(),
            serial: String::new(),
            firmware: String::new(),
            limits: LIMITS,
            buttons: Vec::new(),
            joints: ["x", "y", "z"].map(str::to_owned).to_vec(),
            has_gripper: false,
            needs_homing: false,
            watchdog: None,
            status_names: &[],
        }
    }

    /// Periods so far. RT safe.
    #[cfg(feature = "simulated")]
    pub(crate) fn commands(&self) -> u64 {
        self.periods
    }

    /// Their time, s. RT safe.
    pub(crate) fn time_s(&self) -> f64 {
        self.periods as f64 * self.period_s
    }

    /// Where it is, device frame, m. RT safe.
    #[cfg(feature = "pointer")]
    pub(crate) fn position(&self) -> DVec3 {
        self.hand.position()
    }

    /// Motors on or off. RT safe.
    pub(crate) fn feel(&mut self, on: bool) {
        self.feels = on;
    }

    /// One period under a constant wrench, with the hand where `aim_at` says, s since the period began. RT safe.
    pub(crate) fn advance(&mut self, wrench: &Wrench, aim_at: impl Fn(f64) -> Aim) {
        let felt = self.felt(wrench);
        self.hand.advance(felt.force_n, &LIMITS.workspace, aim_at);
        self.turn(felt);
    }

    /// One period under a constant wrench, of a hand that has let go of the place and only slows the handle down. RT safe.
    #[cfg(feature = "pointer")]
    pub(crate) fn coast(&mut self, wrench: &Wrench) {
        let felt = self.felt(wrench);
        self.hand.coast(felt.force_n, &LIMITS.workspace);
        self.turn(felt);
    }

    /// The handle as it is. RT safe.
    pub(crate) fn state(&self) -> DeviceState {
        let position = self.hand.position();
        let pose = Pose { translation: position, rotation: self.wrist.orientation() };
        let mut state = DeviceState {
            linear_velocity_m_per_s: self.hand.velocity(),
            angular_velocity_rad_per_s: self.wrist.angular_velocity_rad_per_s(),
            device_time_ns: (self.time_s() * 1e9).round() as u64,
            ..DeviceState::at_rest(pose)
        };
        state.joints[..3].copy_from_slice(&position.to_array());
        state
    }

    fn felt(&self, wrench: &Wrench) -> Wrench {
        if self.feels { *wrench } else { Wrench::ZERO }
    }

    fn turn(&mut self, felt: Wrench) {
        self.wrist.advance(felt.torque_n_m);
        self.periods += 1;
    }
}
