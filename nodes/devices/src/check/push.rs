//! The force path with motors that are on: whether the handle goes where it is pushed.

use std::sync::atomic::AtomicBool;

use super::noise::Noise;
use super::pulses::Pulses;
use super::sampling::{Broken, End, Next, Series, sample};
use super::{Finding, Settings, Verdict, ended};
use crate::safety::{CheckedSettings, SafetyError, SafetyLayer, SafetySettings};
use crate::source::{ForceOrigin, Wanted};
use crate::{Description, Device, MotorsOff, Wrench};

/// The safety layer's gate opens slowly; the pushes begin when it is open, s.
const RAMP_S: f64 = 2.0;
const BEGIN_S: f64 = 2.3;
/// Until here the hand may take the handle and move it.
const WATCHED_S: f64 = 2.2;
/// A handle that is faster or goes further is held by nobody.
const FASTEST_M_PER_S: f64 = 0.3;
const FURTHEST_M: f64 = 0.03;
/// Less than this along an axis, m, is no motion.
const FELT_M: f64 = 50e-6;

const HOLD: &str = "hold the handle loosely in one hand, away from its stops, and run this again";

/// Fewer commands than this in the watchdog's time leave no room for a late one.
const COMMANDS_PER_WATCHDOG: f64 = 3.0;

/// Switches the motors on, pushes to and fro along each axis, switches them off.
pub(super) fn findings(
    device: &mut dyn Device,
    settings: &Settings,
    force_n: f64,
    noise: Option<&Noise>,
    stop: &AtomicBool,
) -> Vec<Finding> {
    let description = device.description().clone();
    if let Some(slowest_hz) = too_slow(&description, settings.rate_hz) {
        let watchdog_ms = description.watchdog.unwrap_or_default().as_secs_f64() * 1e3;
        return vec![Finding::warning(
            "forces",
            format!(
                "not tried: at {} Hz the device's watchdog of {watchdog_ms} ms would strike",
                settings.rate_hz
            ),
            format!("take a --rate of {slowest_hz:.0} or more"),
        )];
    }
    match device.read() {
        Ok(state) if description.needs_homing && !state.homed => {
            return vec![Finding::warning("forces", "not tried: the device is not homed", "home it first")];
        }
        Ok(_) => {}
        Err(error) => return vec![Finding::failure("forces", error.to_string(), "")],
    }
    let safety = match safety(force_n, settings.rate_hz) {
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
        End::Broken(Broken { why, remedy }) => vec![Finding::failure("forces", why.clone(), *remedy)],
        End::Lost(_) | End::Stopped => Vec::new(),
    };
    ended(&series, "with motors on", &mut findings);
    if let Err(error) = off {
        findings.push(Finding::failure(
            "motors_off",
            format!("the motors did not confirm that they are off: {error}"),
            "switch the device's power off",
        ));
    }
    findings
}

/// The slowest rate at which this device's motors stay on; none: the rate is not slower.
fn too_slow(description: &Description, rate_hz: f64) -> Option<f64> {
    let slowest_hz = COMMANDS_PER_WATCHDOG / description.watchdog?.as_secs_f64();
    (rate_hz < slowest_hz).then(|| slowest_hz.ceil())
}

/// The passivity controller stays off: a push is there to do work on the hand, and it would take that back. Force, speed
/// and way are what bounds the work here, to 15 mJ at most.
fn safety(force_n: f64, rate_hz: f64) -> Result<CheckedSettings, SafetyError> {
    let settings = SafetySettings {
        max_force_n: force_n,
        max_torque_n_m: 0.0,
        max_gripper_force_n: 0.0,
        max_speed_m_per_s: FASTEST_M_PER_S,
        engage_ramp_s: RAMP_S,
        passivity: false,
        ..SafetySettings::default()
    };
    settings.checked(rate_hz, &["safety.passivity".to_owned()])
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
            let (reason, remedy) = reason(cause);
            return Next::Break(Broken {
                why: format!("the device switched its motors off: {reason}"),
                remedy,
            });
        }
        let started = time_s >= WATCHED_S;
        let went_m = if started { (position - *start.get_or_insert(position)).length() } else { 0.0 };
        if went_m > FURTHEST_M {
            let why = format!("the handle went {:.0} mm under {:.2} N", went_m * 1e3, safety.max_force_n);
            return Next::Break(Broken { why, remedy: HOLD });
        }
        let wanted = Wanted {
            wrench: Wrench::of_force(pulses.at(time_s)),
            origin: ForceOrigin::ServoForce,
            settled: true,
            ..Wanted::default()
        };
        let applied = layer.step(&wanted, state, true, now_ns);
        match applied.fault {
            Some(_) => {
                let why = format!("the handle was faster than {FASTEST_M_PER_S} m/s");
                Next::Break(Broken { why, remedy: HOLD })
            }
            None => Next::Command(applied.wrench),
        }
    })
}

/// Why, and what to do.
fn reason(cause: MotorsOff) -> (&'static str, &'static str) {
    const BUSY: &str = "see to the scheduling and to the load of this machine";
    const ITS_PAPERS: &str = "see what the device's maker says of its lights, then run this again";
    match cause {
        MotorsOff::Button => {
            ("the button that switches the forces on is not pressed", "press it, and run this again")
        }
        MotorsOff::Velocity => ("the handle was faster than it allows", HOLD),
        MotorsOff::Watchdog => ("no command came in its watchdog's time", BUSY),
        MotorsOff::Software => ("software said so", "end other programs that use the device"),
        MotorsOff::Usb => ("the cable was pulled", "connect the cable, and run this again"),
        MotorsOff::DeadMan => ("the dead man's switch is released", "hold it, and run this again"),
        MotorsOff::Emergency => ("its emergency stop is pressed", "release it, and run this again"),
        MotorsOff::Other => ("it does not say why", ITS_PAPERS),
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
