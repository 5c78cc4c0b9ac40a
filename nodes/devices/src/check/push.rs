//! The force path with motors that are on: whether the handle goes where it is pushed.

use std::sync::atomic::AtomicBool;

use super::noise::Noise;
use super::pulses::Pulses;
use super::sampling::{End, Next, Series, sample};
use super::{Finding, Settings, Verdict, ended};
use crate::safety::{CheckedSettings, SafetyError, SafetyLayer, SafetySettings};
use crate::source::{ForceOrigin, Wanted};
use crate::{Description, Device, MotorsOff, Wrench};

/// The safety layer's gate opens slowly; the pushes begin when it is open, s.
const RAMP_S: f64 = 2.0;
const BEGIN_S: f64 = 2.3;
/// A handle that is faster or goes further is held by nobody.
const FASTEST_M_PER_S: f64 = 0.3;
const FURTHEST_M: f64 = 0.03;
/// Less than this along an axis, m, is no motion.
const FELT_M: f64 = 50e-6;

const HOLD: &str = "hold the handle loosely in one hand, away from its stops, and run this again";

/// Switches the motors on, pushes to and fro along each axis, switches them off.
pub(super) fn findings(
    device: &mut dyn Device,
    settings: &Settings,
    force_n: f64,
    noise: Option<&Noise>,
    stop: &AtomicBool,
) -> Vec<Finding> {
    let description = device.description().clone();
    match device.read() {
        Ok(state) if description.needs_homing && !state.homed => {
            return vec![Finding::warning("forces", "not tried: the device is not homed", "home it first")];
        }
        Ok(_) => {}
        Err(error) => return vec![Finding::failure("forces", error.to_string(), "")],
    }
    let safety = match safety(force_n) {
        Ok(safety) => safety,
        Err(error) => return vec![Finding::failure("forces", error.to_string(), "")],
    };
    let pulses = Pulses::felt(force_n, BEGIN_S);
    if let Err(error) = device.enable() {
        return vec![Finding::failure(
            "forces",
            format!("the motors cannot be switched on: {error}"),
            "see the device's emergency stop, its power supply, and the button that allows forces",
        )];
    }
    let series = push(device, &description, &safety, &pulses, settings, stop);
    // What is left of the force is at most the largest of the pushes, and its own end is smooth.
    let off = device.command(&Wrench::ZERO).and_then(|()| device.disable());
    let mut findings = match &series.end {
        End::Whole => vec![judge(&pulses, force_n, &series, noise)],
        End::Broken(why) => vec![Finding::failure("forces", why.clone(), HOLD)],
        End::Lost(_) | End::Stopped => Vec::new(),
    };
    if !matches!(series.end, End::Broken(_)) {
        ended(&series, "with motors on", &mut findings);
    }
    if let Err(error) = off {
        findings.push(Finding::failure(
            "motors_off",
            format!("the motors did not confirm that they are off: {error}"),
            "switch the device's power off",
        ));
    }
    findings
}

/// The passivity controller stays off: a push is there to do work on the hand, and it would take that back. Force, speed
/// and way are what bounds the work here, to 15 mJ at most.
fn safety(force_n: f64) -> Result<CheckedSettings, SafetyError> {
    let settings = SafetySettings {
        max_force_n: force_n,
        max_speed_m_per_s: FASTEST_M_PER_S,
        engage_ramp_s: RAMP_S,
        passivity: false,
        ..SafetySettings::default()
    };
    settings.checked(&["safety.passivity".to_owned()])
}

fn push(
    device: &mut dyn Device,
    description: &Description,
    safety: &CheckedSettings,
    pulses: &Pulses,
    settings: &Settings,
    stop: &AtomicBool,
) -> Series {
    let mut layer = SafetyLayer::new(safety, &description.limits, 1.0 / settings.rate_hz);
    let mut start = None;
    sample(device, settings.rate_hz, pulses.duration(), stop, |time_s, state, now_ns| {
        if !state.is_finite() {
            return Next::Command(layer.step_blind(now_ns).wrench);
        }
        let position = state.pose.translation;
        if let Some(cause) = state.motors_off {
            return Next::Break(format!("the device switched its motors off: {}", reason(cause)));
        }
        // Until the pushes begin, the hand may take the handle.
        let started = time_s >= BEGIN_S - RAMP_S.min(0.1);
        let went_m = if started { (position - *start.get_or_insert(position)).length() } else { 0.0 };
        if went_m > FURTHEST_M {
            return Next::Break(format!(
                "the handle went {:.0} mm under {:.2} N",
                went_m * 1e3,
                safety.max_force_n
            ));
        }
        let wanted = Wanted {
            wrench: Wrench::of_force(pulses.at(time_s)),
            origin: ForceOrigin::ServoForce,
            settled: true,
            ..Wanted::default()
        };
        let applied = layer.step(&wanted, state, true, now_ns);
        match applied.fault {
            Some(_) => Next::Break(format!("the handle was faster than {FASTEST_M_PER_S} m/s")),
            None => Next::Command(applied.wrench),
        }
    })
}

fn reason(cause: MotorsOff) -> &'static str {
    match cause {
        MotorsOff::Button => "the button that switches the forces on is not pressed",
        MotorsOff::Velocity => "the handle was faster than it allows",
        MotorsOff::Watchdog => "no command came in its watchdog's time",
        MotorsOff::Software => "software said so",
        MotorsOff::Usb => "the cable was pulled",
        MotorsOff::DeadMan => "the dead man's switch is released",
        MotorsOff::Emergency => "its emergency stop is pressed",
        MotorsOff::Other => "it does not say why",
    }
}

fn judge(pulses: &Pulses, force_n: f64, series: &Series, noise: Option<&Noise>) -> Finding {
    let Some(response) = pulses.response_m(series) else {
        return Finding::warning("forces", "too few readings came during the pushes", "take a larger --rate");
    };
    let noise_m = noise.map_or(0.0, |noise| noise.deviation_m.max_element());
    let felt_m = FELT_M.max(3.0 * noise_m);
    let axes = |wrong: &dyn Fn(f64) -> bool| {
        let named = ["x", "y", "z"].into_iter().zip(response.to_array()).filter(|(_, went_m)| wrong(*went_m));
        named.map(|(name, _)| name).collect::<Vec<_>>().join(", ")
    };
    let (against, unmoved) = (axes(&|went_m| went_m < -felt_m), axes(&|went_m| went_m.abs() <= felt_m));
    let [x, y, z] = (response * 1e3).to_array();
    let went = format!("pushed by {force_n:.2} N the handle went {x:.3} {y:.3} {z:.3} mm along x y z");
    let finding = if !against.is_empty() {
        let remedy = "do not use the device: its force or its position has the wrong sign, or the handle was moved by \
                      hand; if it was, run this again";
        Finding::new("forces", Verdict::Failure, format!("{went}, against the force along {against}"), remedy)
    } else if !unmoved.is_empty() {
        let remedy = "hold the handle loosely; if it still does not move, that motor or its cable is dead";
        Finding::new("forces", Verdict::Warning, format!("{went}, not noticeably along {unmoved}"), remedy)
    } else {
        Finding::ok("forces", went)
    };
    finding
        .held_against(format!("more than {:.3} mm with the force", felt_m * 1e3))
        .with("force_n", force_n)
        .with("along_x_m", response.x)
        .with("along_y_m", response.y)
        .with("along_z_m", response.z)
}
