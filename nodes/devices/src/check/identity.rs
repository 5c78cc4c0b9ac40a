//! What the device says of itself.

use super::Finding;
use crate::Description;

pub(super) fn findings(description: &Description) -> Vec<Finding> {
    let Description { backend, model, serial, firmware, .. } = description;
    let number = if serial.is_empty() { "no serial number".to_owned() } else { format!("serial {serial}") };
    let versions = if firmware.is_empty() { "the device does not say" } else { firmware };
    vec![
        Finding::ok("device", format!("{model}, backend {backend}, {number}")),
        Finding::ok("firmware", versions),
        limits(description),
        watchdog(description),
    ]
}

fn limits(description: &Description) -> Finding {
    let limits = &description.limits;
    let workspace = &limits.workspace;
    let mut parts = Vec::new();
    let mut numbers = Vec::new();
    for (value, name, key, unit) in [
        (limits.max_force_n, "force", "max_force_n", "N"),
        (limits.max_torque_n_m, "torque", "max_torque_n_m", "N m"),
        (limits.max_gripper_force_n, "gripper force", "max_gripper_force_n", "N"),
    ] {
        match value {
            Some(value) => {
                parts.push(format!("{name} {} {unit}", six_digits(value)));
                numbers.push((key, value));
            }
            None => parts.push(format!("no {name}")),
        }
    }
    let [radius_mm, height_mm] = [workspace.radius_m, workspace.height_m].map(|m| m * 1e3);
    parts.push(format!("workspace {radius_mm:.0} mm around, {height_mm:.0} mm high"));
    numbers.extend([("workspace_radius_m", workspace.radius_m), ("workspace_height_m", workspace.height_m)]);
    let is_usable = numbers.iter().all(|(_, value)| value.is_finite() && *value > 0.0);
    let found = parts.join(", ");
    let finding = match is_usable && workspace.centre.is_finite() {
        true => Finding::ok("limits", found),
        false => Finding::failure(
            "limits",
            found,
            "correct the device's own limits: nothing can be driven by these",
        ),
    };
    Finding { numbers, ..finding.held_against("each a finite number above 0") }
}

/// Limits come as single precision too: 0.4, not 0.4000000059604645.
fn six_digits(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

fn watchdog(description: &Description) -> Finding {
    let limits = &description.limits;
    let has_motors =
        [limits.max_force_n, limits.max_torque_n_m, limits.max_gripper_force_n].iter().any(Option::is_some);
    match description.watchdog {
        Some(time) => {
            let time_ms = time.as_secs_f64() * 1e3;
            Finding::new(
                "watchdog",
                if time_ms <= 50.0 { super::Verdict::Ok } else { super::Verdict::Warning },
                format!("the device itself takes the force away {time_ms} ms after the last command"),
                "set the device's watchdog to 50 ms or less; until then keep its power switch within reach",
            )
            .held_against("at most 50 ms")
            .with("watchdog_s", time.as_secs_f64())
        }
        None if has_motors && !description.is_virtual() => Finding::warning(
            "watchdog",
            "the device has none: a driver that is killed while it pushes leaves its force on",
            "keep the device's power switch within reach",
        ),
        None => Finding::ok("watchdog", "none, and none is needed: there is no motor"),
    }
}

#[cfg(test)]
mod tests {
    use super::super::Verdict;
    use super::super::test_device::TestDevice;
    use super::*;
    use crate::Device;
    use std::time::Duration;

    fn verdicts(description: &Description) -> [Verdict; 2] {
        let findings = findings(description);
        ["limits", "watchdog"].map(|name| findings.iter().find(|f| f.name == name).unwrap().verdict)
    }

    #[test]
    fn motors_without_a_watchdog_are_a_warning_and_a_device_without_motors_needs_none() {
        let mut description = TestDevice::default().description().clone();
        assert_eq!(verdicts(&description), [Verdict::Ok, Verdict::Ok]);
        description.watchdog = None;
        assert_eq!(verdicts(&description), [Verdict::Ok, Verdict::Warning]);
        description.watchdog = Some(Duration::from_millis(200));
        assert_eq!(verdicts(&description), [Verdict::Ok, Verdict::Warning]);
        description.limits.max_force_n = None;
        description.watchdog = None;
        assert_eq!(verdicts(&description), [Verdict::Ok, Verdict::Ok]);
    }

    #[test]
    fn limits_that_are_none_are_a_failure() {
        for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let mut description = TestDevice::default().description().clone();
            description.limits.max_force_n = Some(value);
            assert_eq!(verdicts(&description)[0], Verdict::Failure, "{value}");
            description.limits.max_force_n = Some(1.0);
            description.limits.workspace.radius_m = value;
            assert_eq!(verdicts(&description)[0], Verdict::Failure, "{value}");
        }
    }
}
