//! From the scene to the settings of the motor loop. What is not safe for a hand is refused here.

use anyhow::{Result, anyhow};
use devices::{MotorSettings, SafetySettings};
use scene::Scene;

/// Real-time priority of the motor loop: the middle, as robot controllers take it.
const FIFO_PRIORITY: i32 = 50;

/// How the scene wants the motors driven.
pub(crate) fn motor_settings(scene: &Scene) -> Result<MotorSettings> {
    let device = &scene.device;
    let parameters = scene.parameters();
    Ok(MotorSettings {
        rate_hz: device.rate_hz,
        fifo_priority: FIFO_PRIORITY,
        cpu: device.cpu,
        source: device.force_source.parse().map_err(|text: String| anyhow!(text))?,
        safety: safety_settings(scene)?.checked(device.rate_hz, parameters.texts("unsafe.parameters")?)?,
        enable_at_start: device.enable_at_start,
        gravity_compensation: device.gravity_compensation,
    })
}

fn safety_settings(scene: &Scene) -> Result<SafetySettings> {
    let (device, parameters) = (&scene.device, scene.parameters());
    Ok(SafetySettings {
        max_force_n: device.max_force_n,
        max_torque_n_m: device.max_torque_n_m,
        max_gripper_force_n: device.max_gripper_force_n,
        slew_n_per_s: parameters.double("safety.slew")?,
        torque_slew_n_m_per_s: parameters.double("safety.torque_slew")?,
        gripper_slew_n_per_s: parameters.double("safety.gripper_slew")?,
        max_power_w: parameters.double("safety.max_power")?,
        max_speed_m_per_s: parameters.double("safety.max_speed")?,
        engage_force_n: parameters.double("safety.engage_force")?,
        // The schema has checked the range.
        engage_ticks: u32::try_from(parameters.integer("safety.engage_ticks")?).unwrap_or(u32::MAX),
        engage_ramp_s: parameters.double("safety.engage_ramp")?,
        servo_validity_s: parameters.double("safety.servo_validity")?,
        law_validity_s: parameters.double("safety.law_validity")?,
        decay_s: parameters.double("safety.decay")?,
        passivity: parameters.bool("safety.passivity")?,
        servo_passivity: parameters.bool("safety.servo_passivity")?,
        workspace_margin_m: parameters.double("safety.workspace_margin")?,
        ros_timeout_s: parameters.double("safety.ros_timeout")?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::{Origin, Value};

    fn settings(values: &[(&str, Value)]) -> Result<MotorSettings> {
        let values = values.iter().map(|(name, value)| ((*name).to_owned(), value.clone()));
        motor_settings(&Scene::from_values(values, Origin::named("a test"))?)
    }

    #[test]
    fn the_defaults_of_the_parameters_are_those_of_the_safety_layer() {
        assert_eq!(*settings(&[]).unwrap().safety, SafetySettings::default());
    }

    #[test]
    fn what_takes_protection_away_is_refused_unless_it_is_named() {
        let slew = ("safety.slew", Value::Double(1e5));
        let refusal = settings(std::slice::from_ref(&slew)).unwrap_err().to_string();
        assert!(refusal.contains("safety.slew") && refusal.contains("unsafe.parameters"), "{refusal}");
        let named = ("unsafe.parameters", Value::StringArray(vec!["safety.slew".to_owned()]));
        let accepted = settings(&[slew, named]).unwrap().safety;
        assert_eq!((accepted.slew_n_per_s, accepted.unsafe_settings().len()), (1e5, 1));
    }
}
