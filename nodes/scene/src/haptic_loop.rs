//! The loop between hand and contact law, as a scene sets it up.

use rhombus_chain::stability::HapticLoop;

use crate::Scene;

impl Scene {
    /// Rate, delay and damping of the scene's device.
    ///
    /// A simulated hand has the damping `simulated.damping`; of any other the scene knows none. Motors that follow the
    /// contact law evaluate it for the position of their own period: no delay along the normal. A force from `servo_cf`
    /// answers the position of an earlier period: one period at the least, and whatever the transport takes beyond that.
    pub fn haptic_loop(&self) -> HapticLoop {
        let device = &self.device;
        HapticLoop {
            rate_hz: device.rate_hz,
            delay_s: if device.force_source == "servo_cf" { 1.0 / device.rate_hz } else { 0.0 },
            damping_n_s_per_m: device.is_virtual().then_some(self.simulated.damping_n_s_per_m),
            rendered_damping_n_s_per_m: 0.0,
        }
    }
}
