//! Whether the numbers make sense, what else the device reports, and what it says about itself.

use super::sampling::Series;
use super::timing::verdict;
use super::{Finding, Verdict};
use crate::Description;

/// A quaternion that is further from length 1 than this is no orientation.
const NORM: f64 = 1e-3;

/// Beginnings of the names of status numbers that count what went wrong on the way.
const TROUBLE: [&str; 5] = ["lost_", "refused_", "bad_", "stale_", "skipped_"];

pub(super) fn findings(description: &Description, series: &Series) -> Vec<Finding> {
    if series.ticks.is_empty() {
        return Vec::new();
    }
    let mut findings = vec![numbers(series), orientation(series)];
    findings.extend(line(description, series));
    findings.extend([homed(description, series), workspace(description, series)]);
    findings.extend(controls(description, series));
    findings.extend(status(description, series));
    findings
}

fn numbers(series: &Series) -> Finding {
    let broken = series.ticks.iter().filter(|tick| !tick.state.is_finite).count();
    Finding::new(
        "numbers",
        verdict(broken == 0, broken == 0),
        format!("{broken} of {} readings hold a NaN or an infinity", series.ticks.len()),
        "switch the device off and on again; correct its firmware if it is self-built",
    )
    .held_against("none")
    .with("not_finite", broken as f64)
}

fn orientation(series: &Series) -> Finding {
    let worst = series.ticks.iter().map(|tick| tick.state.norm_error).fold(0.0, f64::max);
    // NaN lies in no range; a reading with one is counted above too.
    let is_valid = series.ticks.iter().all(|tick| tick.state.norm_error <= NORM);
    let found = match series.ticks.iter().all(|tick| tick.state.is_identity) {
        true => "the identity all the time: the device does not measure it, or nothing turned".to_owned(),
        false => format!("unit quaternions to {worst:.1e}"),
    };
    Finding::new(
        "orientation",
        verdict(is_valid, is_valid),
        found,
        "home the device; correct its firmware if it is self-built",
    )
    .held_against("length 1 within 1e-3")
    .with("worst_norm_error", worst)
}

/// What was lost on the way, where the device counts it.
fn line(description: &Description, series: &Series) -> Option<Finding> {
    let counts: Vec<(&'static str, f64)> = description
        .status_names
        .iter()
        .enumerate()
        .filter(|(_, name)| TROUBLE.iter().any(|beginning| name.starts_with(beginning)))
        .map(|(index, &name)| {
            let [first, last] = series.status.map(|status| status[index]);
            (name, f64::from(last) - f64::from(first))
        })
        .collect();
    if counts.is_empty() {
        return None;
    }
    let is_clean = counts.iter().all(|(_, count)| *count == 0.0);
    let texts: Vec<String> =
        counts.iter().map(|(name, count)| format!("{} {count}", name.replace('_', " "))).collect();
    let finding = Finding::new(
        "line",
        verdict(is_clean, true),
        format!("{} in {:.1} s", texts.join(", "), series.seconds()),
        "shorten or shield the cable; for skipped commands raise serial.baud or take a smaller rate",
    );
    Some(Finding { numbers: counts, ..finding.held_against("none") })
}

fn homed(description: &Description, series: &Series) -> Finding {
    match (description.needs_homing, series.homed) {
        (_, false) => Finding::warning(
            "homed",
            "no: positions mean nothing yet, and its own weight cannot be carried",
            "home it: state_command `home` of the driver, or by hand as its maker says",
        ),
        (true, true) => Finding::ok("homed", "yes"),
        (false, true) => Finding::ok("homed", "yes, it needs no homing"),
    }
}

fn workspace(description: &Description, series: &Series) -> Finding {
    let workspace = &description.limits.workspace;
    let outside = series.ticks.iter().filter(|tick| !workspace.contains(tick.state.position)).count();
    let at = series.ticks.last().map_or(glam::DVec3::ZERO, |tick| tick.state.position);
    let [x, y, z] = (at * 1e3).to_array();
    let from_centre = at - workspace.centre;
    let edge_m = (workspace.radius_m - from_centre.truncate().length())
        .min(0.5 * workspace.height_m - from_centre.z.abs());
    Finding::new(
        "workspace",
        verdict(outside == 0, true),
        format!(
            "the handle is at {x:.1} {y:.1} {z:.1} mm, {:.1} mm {} the edge",
            edge_m.abs() * 1e3,
            if edge_m < 0.0 { "outside" } else { "inside" }
        ),
        "move the handle inside; if it is, home the device",
    )
    .held_against(format!(
        "inside all the time; it was outside in {outside} of {} readings",
        series.ticks.len()
    ))
    .with("x_m", at.x)
    .with("y_m", at.y)
    .with("z_m", at.z)
    .with("inside_by_m", edge_m)
}

/// Buttons and gripper, where there are any. Nobody has to press: what was seen is said.
fn controls(description: &Description, series: &Series) -> Vec<Finding> {
    let mut findings = Vec::new();
    if !description.buttons.is_empty() {
        let seen = series.ticks.iter().fold(0, |seen, tick| seen | tick.state.buttons);
        let pressed: Vec<&str> = description
            .buttons
            .iter()
            .enumerate()
            .filter(|(bit, _)| *bit < 32 && seen & (1 << bit) != 0)
            .map(|(_, name)| name.as_str())
            .collect();
        let what = if pressed.is_empty() { "none".to_owned() } else { pressed.join(", ") };
        findings.push(
            Finding::ok("buttons", format!("{}; pressed meanwhile: {what}", description.buttons.join(", ")))
                .with("pressed", f64::from(seen)),
        );
    }
    if description.has_gripper {
        let angles = || series.ticks.iter().filter_map(|tick| tick.state.gripper_rad);
        let (low, high) =
            angles().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), a| (low.min(a), high.max(a)));
        findings.push(match low <= high {
            true => Finding::ok("gripper", format!("opening {low:.3} to {high:.3} rad"))
                .with("from_rad", low)
                .with("to_rad", high),
            false => Finding::failure(
                "gripper",
                "the device says it has one but reports no angle",
                "connect the gripper's cable, then switch the device off and on again",
            ),
        });
    }
    findings
}

/// The device's own account of its health, as it is.
fn status(description: &Description, series: &Series) -> Option<Finding> {
    if description.status_names.is_empty() {
        return None;
    }
    let last = series.status[1];
    let numbers: Vec<(&'static str, f64)> =
        description.status_names.iter().zip(last).map(|(&name, value)| (name, f64::from(value))).collect();
    let texts: Vec<String> = numbers.iter().map(|(name, value)| format!("{name} {value}")).collect();
    let finding = Finding { numbers, ..Finding::ok("device_status", texts.join(", ")) };
    Some(Finding { verdict: Verdict::Ok, ..finding })
}

#[cfg(test)]
mod tests {
    use super::super::test_device::{TestDevice, series};
    use super::*;
    use crate::{Device, DeviceState};
    use glam::{DQuat, DVec3};
    use rhombus_chain::Pose;

    fn verdict_of(name: &str, description: &Description, state: DeviceState) -> Verdict {
        let findings = findings(description, &series((0..30).map(|_| state)));
        findings.iter().find(|finding| finding.name == name).unwrap().verdict
    }

    fn description() -> Description {
        TestDevice::default().description().clone()
    }

    #[test]
    fn a_quaternion_that_is_no_rotation_is_a_failure() {
        let with = |rotation| DeviceState::at_rest(Pose { rotation, ..Pose::IDENTITY });
        let turned = DQuat::from_rotation_x(1.0);
        for (rotation, expected) in [
            (DQuat::IDENTITY, Verdict::Ok),
            (turned, Verdict::Ok),
            (turned * 1.01, Verdict::Failure),
            (turned * f64::NAN, Verdict::Failure),
        ] {
            assert_eq!(verdict_of("orientation", &description(), with(rotation)), expected, "{rotation}");
        }
    }

    #[test]
    fn a_reading_that_is_no_number_is_a_failure_and_one_outside_a_warning() {
        let at = |translation| DeviceState::at_rest(Pose { translation, ..Pose::IDENTITY });
        assert_eq!(verdict_of("numbers", &description(), at(DVec3::NAN)), Verdict::Failure);
        assert_eq!(verdict_of("numbers", &description(), at(DVec3::X)), Verdict::Ok);
        assert_eq!(verdict_of("workspace", &description(), at(DVec3::X)), Verdict::Warning);
        assert_eq!(verdict_of("workspace", &description(), at(DVec3::ZERO)), Verdict::Ok);
    }

    #[test]
    fn what_the_device_counts_as_lost_is_told_by_how_much_it_grew() {
        let description = Description { status_names: &["states", "lost_states"], ..description() };
        let states = (0..30).map(|i| {
            let mut state = DeviceState::at_rest(Pose::IDENTITY);
            (state.status[0], state.status[1]) = (100 + i, 7 + i / 10);
            state
        });
        let finding = line(&description, &series(states)).unwrap();
        assert_eq!((finding.verdict, finding.numbers), (Verdict::Warning, vec![("lost_states", 2.0)]));
    }

    #[test]
    fn pressed_buttons_are_named() {
        let mut state = DeviceState::at_rest(Pose::IDENTITY);
        state.buttons = 0b10;
        let finding = &controls(&description(), &series((0..3).map(|_| state)))[0];
        assert!(finding.found.ends_with("pressed meanwhile: button2"), "{}", finding.found);
    }

    #[test]
    fn a_device_that_is_not_homed_is_a_warning() {
        let state = DeviceState { homed: false, ..DeviceState::at_rest(Pose::IDENTITY) };
        assert_eq!(verdict_of("homed", &description(), state), Verdict::Warning);
    }
}
