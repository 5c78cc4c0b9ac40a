//! The diagnostics of the operating state: what the motors may do, why they may not, and what the device says of itself.

use devices::{CheckedSettings, Description, ForceOrigin, ForceSource, MotorStatus, OperatingState, Sample};
use node_kit::{Level, Log, Status};

/// What does not change while the device is open.
pub(crate) struct OperatingReport {
    device: Vec<(&'static str, String)>,
    status_names: &'static [&'static str],
    unsafe_settings: Vec<String>,
    /// What is worth a warning at the start and no more.
    remarks: Vec<String>,
}

impl OperatingReport {
    pub(crate) fn new(
        description: &Description,
        safety: &CheckedSettings,
        followed: ForceSource,
    ) -> OperatingReport {
        let watchdog = match description.watchdog {
            Some(time) => format!("{:.1}", time.as_secs_f64() * 1e3),
            None => "none".to_owned(),
        };
        let limit = |limit: Option<f64>| limit.map_or("no motors".to_owned(), |limit| limit.to_string());
        OperatingReport {
            device: vec![
                ("backend", description.backend.to_owned()),
                ("model", description.model.clone()),
                ("serial", description.serial.clone()),
                ("firmware", description.firmware.clone()),
                ("device_max_force_n", limit(description.limits.max_force_n)),
                ("device_max_torque_n_m", limit(description.limits.max_torque_n_m)),
                ("device_watchdog_ms", watchdog),
                ("passivity", passivity(safety, followed).to_owned()),
            ],
            status_names: description.status_names,
            unsafe_settings: safety.unsafe_settings().to_vec(),
            remarks: safety.superfluous().iter().cloned().chain(unwatched(description)).collect(),
        }
    }

    /// Says once what is set to less than safe.
    pub(crate) fn warn(&self, log: &Log) {
        for text in self.unsafe_settings.iter().chain(&self.remarks) {
            log.warn(text);
        }
    }

    /// The status now. A fault is an error; so are settings that are not safe for a hand, as long as they hold. What keeps
    /// motors that are off from being enabled is a warning.
    pub(crate) fn status(&self, motor: MotorStatus, newest: Option<&Sample>) -> Status {
        let summary = match motor.fault.or(motor.barred_by) {
            Some(cause) => format!("{}: {cause}", motor.operating),
            None => motor.operating.to_string(),
        };
        let (level, summary) = match (motor.operating, self.unsafe_settings.as_slice()) {
            (OperatingState::Fault, _) => (Level::Error, summary),
            (_, [first, ..]) => (Level::Error, format!("{summary}; {first}")),
            _ if motor.barred_by.is_some() => (Level::Warn, summary),
            _ => (Level::Ok, summary),
        };
        let mut status = Status::new(level, "operating state", summary)
            .with("state", motor.operating)
            .with("fault", motor.fault.map_or(String::new(), |cause| cause.to_string()))
            .with("barred_by", motor.barred_by.map_or(String::new(), |cause| cause.to_string()))
            .with("is_homed", motor.is_homed)
            .with("is_busy", motor.is_busy)
            .with("unsafe_parameters", self.unsafe_settings.join(" | "));
        if let Some(sample) = newest {
            status = self.with_sample(status, sample);
        }
        self.device.iter().fold(status, |status, (key, value)| status.with(*key, value))
    }

    fn with_sample(&self, status: Status, sample: &Sample) -> Status {
        let millijoules = |joules: f64| format!("{:.3}", 1e3 * joules);
        let status = status
            .with("force_source", source(sample.origin))
            .with("limits_hit", sample.limits_hit.names().collect::<Vec<_>>().join(", "))
            .with("net_energy_mj", millijoules(sample.energy.given_j))
            .with("largest_energy_deficit_mj", millijoules(sample.energy.largest_deficit_j))
            .with("passivity_dissipation_mj", millijoules(sample.energy.dissipated_j));
        self.status_names
            .iter()
            .zip(sample.state.status)
            .fold(status, |status, (name, value)| status.with(format!("device_{name}"), value))
    }
}

/// A device that holds the last force of a driver that was killed. A virtual one is gone with the driver.
fn unwatched(description: &Description) -> Option<String> {
    let holds = description.limits.max_force_n.is_some() && description.watchdog.is_none();
    (holds && !description.is_virtual()).then(|| {
        format!(
            "{} has no watchdog of its own: if this process is killed, the device keeps its last force; switch it off then",
            description.model
        )
    })
}

/// On what the passivity controller acts.
fn passivity(safety: &CheckedSettings, followed: ForceSource) -> &'static str {
    match (safety.passivity, safety.servo_passivity, followed) {
        (false, ..) => "off",
        (true, true, _) => "on",
        (true, false, ForceSource::ContactLaw) => "on for the contact law and hold, off for servo_cf",
        (true, false, ForceSource::ServoForce) => {
            "off for servo_cf, which the motors follow: its client may give the hand energy, unless safety.servo_passivity is set"
        }
    }
}

fn source(origin: ForceOrigin) -> &'static str {
    match origin {
        ForceOrigin::Nobody => "nobody",
        ForceOrigin::ContactLaw => "contact_law",
        ForceOrigin::ServoForce => "servo_cf",
        ForceOrigin::Hold => "hold",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use devices::simulated;
    use devices::{FaultCause, SafetySettings};

    fn report(safety: SafetySettings, unsafe_parameters: &[&str]) -> OperatingReport {
        let names: Vec<String> = unsafe_parameters.iter().map(|&name| name.to_owned()).collect();
        let description = Description {
            backend: "simulated",
            model: "hand".to_owned(),
            serial: String::new(),
            firmware: String::new(),
            limits: simulated::LIMITS,
            buttons: Vec::new(),
            joints: Vec::new(),
            has_gripper: true,
            needs_homing: false,
            watchdog: None,
            status_names: &["power"],
        };
        OperatingReport::new(&description, &safety.checked(1000.0, &names).unwrap(), ForceSource::ServoForce)
    }

    fn text(report: &OperatingReport, operating: OperatingState, fault: Option<FaultCause>) -> String {
        format!("{:?}", report.status(MotorStatus { operating, fault, ..MotorStatus::default() }, None))
    }

    #[test]
    fn a_fault_is_an_error_with_its_cause_and_the_way_out() {
        let report = report(SafetySettings::default(), &[]);
        assert!(text(&report, OperatingState::Paused, None).contains("level: Ok"));
        let fault = text(&report, OperatingState::Fault, Some(FaultCause::Velocity));
        assert!(fault.contains("level: Error") && fault.contains("FAULT: the handle was faster"), "{fault}");
    }

    #[test]
    fn what_keeps_the_motors_off_is_a_warning_without_a_fault() {
        let report = report(SafetySettings::default(), &[]);
        let pressed = MotorStatus { barred_by: Some(FaultCause::EmergencyStop), ..MotorStatus::default() };
        let text = format!("{:?}", report.status(pressed, None));
        assert!(text.contains("level: Warn") && text.contains("DISABLED: emergency stop"), "{text}");
    }

    #[test]
    fn settings_that_are_not_safe_are_an_error_in_every_state() {
        let reckless = SafetySettings { passivity: false, ..SafetySettings::default() };
        let report = report(reckless, &["safety.passivity"]);
        for state in [OperatingState::Disabled, OperatingState::Enabled] {
            let text = text(&report, state, None);
            assert!(text.contains("level: Error") && text.contains("UNSAFE: safety.passivity"), "{text}");
        }
    }
}
