//! Which settings make sense, and which of them are safe for a hand.

use std::ops::Deref;

use thiserror::Error;

use super::SafetySettings;
use super::slew::share_of_limit;

/// Settings that passed. The only way to them is [`SafetySettings::checked`].
#[derive(Clone, Debug, PartialEq)]
pub struct CheckedSettings {
    settings: SafetySettings,
    unsafe_settings: Vec<String>,
    superfluous: Vec<String>,
}

impl CheckedSettings {
    /// What is set outside its safe range, one sentence each; for diagnostics, where it is shouted about.
    pub fn unsafe_settings(&self) -> &[String] {
        &self.unsafe_settings
    }

    /// Names in `unsafe.parameters` that allow nothing, because the value is safe; one sentence each.
    pub fn superfluous(&self) -> &[String] {
        &self.superfluous
    }
}

impl Deref for CheckedSettings {
    type Target = SafetySettings;

    fn deref(&self) -> &SafetySettings {
        &self.settings
    }
}

/// Why settings are refused.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SafetyError {
    /// A value that means nothing.
    #[error("{name} = {value}: accepted is {low} to {high} {unit}")]
    Senseless {
        /// The parameter.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The smallest accepted value.
        low: f64,
        /// The largest accepted value.
        high: f64,
        /// Unit of the three.
        unit: &'static str,
    },
    /// A value that would take protection away from the hand.
    #[error(
        "{name} = {value} is not safe for a hand ({why}): safe is {safe}; \
             who wants it all the same writes unsafe.parameters: [{name}]"
    )]
    Unsafe {
        /// The parameter.
        name: &'static str,
        /// Its value.
        value: String,
        /// The safe values, with their unit.
        safe: String,
        /// What the protection is for.
        why: &'static str,
    },
    /// A name in `unsafe.parameters` that is no safety parameter.
    #[error("unsafe.parameters: there is no safety parameter \"{name}\"; there are {known}")]
    UnknownName {
        /// The name.
        name: String,
        /// All names.
        known: String,
    },
}

/// One number: which values make sense and which are safe (both inclusive), and what for.
struct Range {
    name: &'static str,
    unit: &'static str,
    accepted: (f64, f64),
    safe: (f64, f64),
    why: &'static str,
    value: fn(&SafetySettings) -> f64,
}

impl Range {
    /// The safe values in words. `falls` is the parameter that the `least` value is for.
    fn safe_values(&self, falls: Option<&str>, least: Option<f64>, rate_hz: f64) -> String {
        let ((low, high), unit) = (self.safe, self.unit);
        let (Some(falls), Some(least)) = (falls, least) else {
            return format!("{low} to {high} {unit}").trim_end().to_owned();
        };
        let low = low.max(least.ceil());
        if low <= high {
            format!("{low} to {high} {unit} with this {falls} at {rate_hz} Hz, so that it is gone in 30 ms")
        } else {
            format!("none with this {falls} at {rate_hz} Hz: take a smaller {falls} or a larger device.rate")
        }
    }
}

const NO_FASTER: &str =
    "a force that changes faster is a blow; one that changes more slowly stays after it should be gone";
const LARGEST: &str = "devices for the fingers have 3 to 20 N; more moves an arm";
const LATE: &str = "the force must be gone within 50 ms of the last command that says so";

/// Every number; `safety.passivity` is the one that is none.
const RANGES: [Range; 16] = [
    Range {
        name: "device.max_force",
        unit: "N",
        accepted: (0.0, 100.0),
        safe: (0.0, 40.0),
        why: LARGEST,
        value: |s| s.max_force_n,
    },
    Range {
        name: "device.max_torque",
        unit: "N m",
        accepted: (0.0, 10.0),
        safe: (0.0, 2.0),
        why: "more turns a wrist against its will",
        value: |s| s.max_torque_n_m,
    },
    Range {
        name: "device.max_gripper_force",
        unit: "N",
        accepted: (0.0, 100.0),
        safe: (0.0, 20.0),
        why: "fingers are between the jaws",
        value: |s| s.max_gripper_force_n,
    },
    Range {
        name: "safety.slew",
        unit: "N/s",
        accepted: (10.0, 1e6),
        safe: (400.0, 4000.0),
        why: NO_FASTER,
        value: |s| s.slew_n_per_s,
    },
    Range {
        name: "safety.torque_slew",
        unit: "N m/s",
        accepted: (0.2, 1e5),
        safe: (10.0, 100.0),
        why: NO_FASTER,
        value: |s| s.torque_slew_n_m_per_s,
    },
    Range {
        name: "safety.gripper_slew",
        unit: "N/s",
        accepted: (4.0, 1e6),
        safe: (160.0, 4000.0),
        why: NO_FASTER,
        value: |s| s.gripper_slew_n_per_s,
    },
    Range {
        name: "safety.max_power",
        unit: "W",
        accepted: (0.01, 1e4),
        safe: (0.01, 30.0),
        why: "20 N at 1.5 m/s are 30 W: a larger limit never acts",
        value: |s| s.max_power_w,
    },
    Range {
        name: "safety.max_speed",
        unit: "m/s",
        accepted: (0.05, 100.0),
        safe: (0.05, 3.0),
        why: "a faster handle is out of control, and strikes",
        value: |s| s.max_speed_m_per_s,
    },
    Range {
        name: "safety.engage_force",
        unit: "N",
        accepted: (0.001, 100.0),
        safe: (0.001, 0.5),
        why: "the force must not begin in the middle of a push",
        value: |s| s.engage_force_n,
    },
    Range {
        name: "safety.engage_ticks",
        unit: "",
        accepted: (0.0, 1e5),
        safe: (3.0, 1e5),
        why: "the force must not begin in the middle of a push",
        value: |s| f64::from(s.engage_ticks),
    },
    Range {
        name: "safety.engage_ramp",
        unit: "s",
        accepted: (0.0, 60.0),
        safe: (0.5, 60.0),
        why: "a force that begins at once surprises the hand",
        value: |s| s.engage_ramp_s,
    },
    Range {
        name: "safety.servo_validity",
        unit: "s",
        accepted: (0.001, 10.0),
        safe: (0.001, 0.02),
        why: LATE,
        value: |s| s.servo_validity_s,
    },
    Range {
        name: "safety.law_validity",
        unit: "s",
        accepted: (0.001, 10.0),
        safe: (0.001, 0.2),
        why: "the hand has moved on, and an old law pushes where the body no longer is",
        value: |s| s.law_validity_s,
    },
    Range {
        name: "safety.decay",
        unit: "s",
        accepted: (0.0, 10.0),
        safe: (0.0, 0.03),
        why: LATE,
        value: |s| s.decay_s,
    },
    Range {
        name: "safety.workspace_margin",
        unit: "m",
        accepted: (0.0, 0.1),
        safe: (0.001, 0.1),
        why: "the device must not be driven against its mechanical stops",
        value: |s| s.workspace_margin_m,
    },
    Range {
        name: "safety.ros_timeout",
        unit: "s",
        accepted: (0.05, 60.0),
        safe: (0.05, 2.0),
        why: "who does not spin does not hear an emergency stop either",
        value: |s| s.ros_timeout_s,
    },
];

/// Time in which the largest force must be able to fall to nothing, s: the decay that a hand is promised, 20 ms after the
/// last command at the latest.
const LONGEST_FALL_S: f64 = 0.03;

/// What limits the slew from below: the parameter whose largest value has to go in [`LONGEST_FALL_S`], and that value.
fn falls(settings: &SafetySettings, slew: &str) -> Option<(&'static str, f64)> {
    match slew {
        "safety.slew" => Some(("device.max_force", settings.max_force_n)),
        "safety.torque_slew" => Some(("device.max_torque", settings.max_torque_n_m)),
        "safety.gripper_slew" => Some(("device.max_gripper_force", settings.max_gripper_force_n)),
        _ => None,
    }
}

const PASSIVITY: &str = "safety.passivity";
const PASSIVITY_WHY: &str = "a stiff contact that is answered late drives the hand";

impl SafetySettings {
    /// Checks every number, for a motor loop of `rate_hz`; what is not safe passes only when its parameter is named in
    /// `unsafe_parameters`. An empty name there is none: `[""]` is how a parameter file writes an empty list.
    ///
    /// A slew limit is safe when the largest force falls to nothing within 30 ms, in a slow loop with its steps of 2 ms.
    ///
    /// # Errors
    /// The first number that makes no sense or is not safe, or a name that no parameter has.
    pub fn checked(self, rate_hz: f64, unsafe_parameters: &[String]) -> Result<CheckedSettings, SafetyError> {
        let allowed = |name: &str| unsafe_parameters.iter().any(|allowed| allowed == name);
        for name in unsafe_parameters.iter().filter(|name| !name.is_empty()) {
            if !RANGES.iter().any(|range| range.name == name) && name != PASSIVITY {
                let mut known: Vec<&str> = RANGES.iter().map(|range| range.name).collect();
                known.push(PASSIVITY);
                return Err(SafetyError::UnknownName { name: name.clone(), known: known.join(", ") });
            }
        }
        let mut checked =
            CheckedSettings { settings: self, unsafe_settings: Vec::new(), superfluous: Vec::new() };
        for range in &RANGES {
            let value = (range.value)(&self);
            let (low, high) = range.accepted;
            // A value that is not a number is in no range.
            if !(low..=high).contains(&value) {
                return Err(SafetyError::Senseless { name: range.name, value, low, high, unit: range.unit });
            }
            let falls = falls(&self, range.name);
            let least = falls.map(|(_, largest)| largest / (LONGEST_FALL_S * share_of_limit(1.0 / rate_hz)));
            let is_safe = (range.safe.0..=range.safe.1).contains(&value) && least.is_none_or(|l| value >= l);
            checked.judge(range.name, is_safe, allowed(range.name), || SafetyError::Unsafe {
                name: range.name,
                value: format!("{value} {}", range.unit).trim_end().to_owned(),
                safe: range.safe_values(falls.map(|(name, _)| name), least, rate_hz),
                why: range.why,
            })?;
        }
        checked.judge(PASSIVITY, self.passivity, allowed(PASSIVITY), || SafetyError::Unsafe {
            name: PASSIVITY,
            value: "false".to_owned(),
            safe: "true".to_owned(),
            why: PASSIVITY_WHY,
        })?;
        Ok(checked)
    }
}

impl CheckedSettings {
    fn judge(
        &mut self,
        name: &str,
        is_safe: bool,
        allowed: bool,
        refusal: impl FnOnce() -> SafetyError,
    ) -> Result<(), SafetyError> {
        match (is_safe, allowed) {
            (true, false) => {}
            (true, true) => self
                .superfluous
                .push(format!("unsafe.parameters names {name}, whose value is safe: take it out")),
            (false, false) => return Err(refusal()),
            (false, true) => {
                if let SafetyError::Unsafe { name, value, safe, why } = refusal() {
                    self.unsafe_settings.push(format!("UNSAFE: {name} = {value}; safe is {safe} ({why})"));
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(names: &[&str]) -> Vec<String> {
        names.iter().map(|&name| name.to_owned()).collect()
    }

    /// Settings that switch protections off, with the parameter that does it.
    fn reckless() -> Vec<(SafetySettings, &'static str)> {
        let safe = SafetySettings::default();
        vec![
            (SafetySettings { max_force_n: 41.0, ..safe }, "device.max_force"),
            (
                SafetySettings { max_torque_n_m: 3.0, torque_slew_n_m_per_s: 100.0, ..safe },
                "device.max_torque",
            ),
            (SafetySettings { max_gripper_force_n: 30.0, ..safe }, "device.max_gripper_force"),
            (SafetySettings { slew_n_per_s: 1e5, ..safe }, "safety.slew"),
            (SafetySettings { slew_n_per_s: 100.0, ..safe }, "safety.slew"),
            // 20 N in 33 ms, 0.5 N m in 33 ms, 8 N in 32 ms: longer than the decay.
            (SafetySettings { slew_n_per_s: 600.0, ..safe }, "safety.slew"),
            (SafetySettings { torque_slew_n_m_per_s: 15.0, ..safe }, "safety.torque_slew"),
            (SafetySettings { gripper_slew_n_per_s: 250.0, ..safe }, "safety.gripper_slew"),
            (SafetySettings { torque_slew_n_m_per_s: 1e3, ..safe }, "safety.torque_slew"),
            (SafetySettings { gripper_slew_n_per_s: 1e5, ..safe }, "safety.gripper_slew"),
            (SafetySettings { max_power_w: 1000.0, ..safe }, "safety.max_power"),
            (SafetySettings { max_speed_m_per_s: 100.0, ..safe }, "safety.max_speed"),
            (SafetySettings { engage_force_n: 20.0, ..safe }, "safety.engage_force"),
            (SafetySettings { engage_ticks: 0, ..safe }, "safety.engage_ticks"),
            (SafetySettings { engage_ramp_s: 0.0, ..safe }, "safety.engage_ramp"),
            (SafetySettings { servo_validity_s: 0.1, ..safe }, "safety.servo_validity"),
            (SafetySettings { law_validity_s: 1.0, ..safe }, "safety.law_validity"),
            (SafetySettings { decay_s: 0.5, ..safe }, "safety.decay"),
            (SafetySettings { workspace_margin_m: 0.0, ..safe }, "safety.workspace_margin"),
            (SafetySettings { ros_timeout_s: 30.0, ..safe }, "safety.ros_timeout"),
            (SafetySettings { passivity: false, ..safe }, "safety.passivity"),
        ]
    }

    #[test]
    fn the_defaults_are_safe() {
        let checked = SafetySettings::default().checked(1000.0, &names(&[""])).unwrap();
        assert_eq!(*checked, SafetySettings::default());
        assert!(checked.unsafe_settings().is_empty() && checked.superfluous().is_empty());
    }

    #[test]
    fn a_setting_that_takes_protection_away_is_refused_with_the_way_to_have_it_all_the_same() {
        for (settings, name) in reckless() {
            let message = settings.checked(1000.0, &[]).unwrap_err().to_string();
            assert!(message.starts_with(&format!("{name} = ")), "{message}");
            assert!(message.contains("safe is "), "{message}");
            assert!(message.ends_with(&format!("unsafe.parameters: [{name}]")), "{message}");
        }
    }

    #[test]
    fn named_as_unsafe_it_passes_and_is_told_in_words() {
        for (settings, name) in reckless() {
            let checked = settings.checked(1000.0, &names(&["", name])).unwrap();
            assert_eq!(*checked, settings);
            let [told] = checked.unsafe_settings() else { panic!("{:?}", checked.unsafe_settings()) };
            assert!(told.starts_with(&format!("UNSAFE: {name} = ")), "{told}");
            assert!(checked.superfluous().is_empty());
        }
    }

    #[test]
    fn a_slew_limit_is_safe_when_the_largest_force_is_gone_within_the_decay_time() {
        let safe = SafetySettings::default();
        let is_safe = |settings: SafetySettings, rate_hz| settings.checked(rate_hz, &[]).is_ok();
        assert!(is_safe(SafetySettings { max_force_n: 12.0, slew_n_per_s: 400.0, ..safe }, 1000.0));
        assert!(!is_safe(SafetySettings { max_force_n: 12.1, slew_n_per_s: 400.0, ..safe }, 1000.0));
        // A slow loop comes to 2 of its 5 ms in each period: 40 N fall at 0.4 of the limit.
        let strong = SafetySettings { max_force_n: 40.0, ..safe };
        assert!(is_safe(strong, 1000.0) && is_safe(strong, 4000.0) && !is_safe(strong, 200.0));
        assert!(is_safe(SafetySettings { slew_n_per_s: 3400.0, ..strong }, 200.0));
        let message = strong.checked(200.0, &[]).unwrap_err().to_string();
        assert!(message.contains("3334 to 4000 N/s with this device.max_force at 200 Hz"), "{message}");
        // Where no slew limit is safe the way out is another one.
        let strong = SafetySettings { max_torque_n_m: 2.0, torque_slew_n_m_per_s: 100.0, ..safe };
        let message = strong.checked(200.0, &[]).unwrap_err().to_string();
        assert!(message.contains("a smaller device.max_torque or a larger device.rate"), "{message}");
    }

    #[test]
    fn naming_one_parameter_allows_no_other() {
        for (settings, name) in reckless() {
            let other = if name == "safety.slew" { "safety.decay" } else { "safety.slew" };
            assert!(settings.checked(1000.0, &names(&[other])).unwrap_err().to_string().contains(name));
        }
    }

    #[test]
    fn a_safe_value_that_is_named_is_a_warning_and_an_unknown_name_an_error() {
        let checked = SafetySettings::default().checked(1000.0, &names(&["safety.slew"])).unwrap();
        assert!(checked.superfluous()[0].contains("safety.slew"));
        assert!(checked.unsafe_settings().is_empty());
        let message =
            SafetySettings::default().checked(1000.0, &names(&["safety.slow"])).unwrap_err().to_string();
        assert!(message.contains("\"safety.slow\"") && message.contains("safety.passivity"), "{message}");
    }

    #[test]
    fn a_number_without_sense_is_refused_even_when_it_is_named() {
        let all: Vec<String> = RANGES.iter().map(|range| range.name.to_owned()).collect();
        for value in [f64::NAN, f64::INFINITY, -1.0] {
            for settings in [
                SafetySettings { max_force_n: value, ..SafetySettings::default() },
                SafetySettings { slew_n_per_s: value, ..SafetySettings::default() },
                SafetySettings { servo_validity_s: value, ..SafetySettings::default() },
                SafetySettings { max_speed_m_per_s: value, ..SafetySettings::default() },
            ] {
                assert!(matches!(settings.checked(1000.0, &all), Err(SafetyError::Senseless { .. })));
            }
        }
    }
}
