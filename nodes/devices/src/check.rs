//! What an open device is like: its rate, its noise, its orientation, its force path. Measured, not believed.
//!
//! [`run`] reads the device at the rate of a motor loop, first at rest and then while it commands small forces **to
//! motors that are off**, which times the force path and shows that the brakes hold. Motors are switched on only when
//! [`Settings`] say so; what they then get has passed the [`safety`](crate::safety) layer and is at most
//! [`LARGEST_FORCE_N`]. They are off when [`run`] returns, whatever happened.

mod brakes;
mod finding;
mod health;
mod identity;
mod noise;
mod pulses;
mod push;
mod sampling;
mod spread;
#[cfg(test)]
mod test_device;
mod timing;

use std::sync::atomic::AtomicBool;
use std::time::Duration;

use crate::{Description, Device, DeviceError, Scheduling, Wrench};
use pulses::Pulses;
use sampling::{End, Next, Series, sample};

pub use finding::{Finding, Verdict};

/// No larger force is commanded here, N. On a device with less than ten times as much it is a tenth of that.
pub const LARGEST_FORCE_N: f64 = 0.5;

/// What is measured, and for how long.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    rate_hz: f64,
    duration: Duration,
    forces: bool,
}

impl Settings {
    /// Readings in a second, 10 to 4000; the time at rest, 0.1 to 60 s; whether motors may be switched on.
    ///
    /// # Errors
    /// [`DeviceError::Setting`] for what is out of range.
    pub fn new(rate_hz: f64, duration: Duration, forces: bool) -> Result<Settings, DeviceError> {
        let refused = |name, value: String, accepted: &str| {
            Err(DeviceError::Setting { name, value, accepted: accepted.to_owned() })
        };
        if !(10.0..=4000.0).contains(&rate_hz) {
            return refused("rate", format!("{rate_hz} Hz"), "10 to 4000 Hz");
        }
        if !(0.1..=60.0).contains(&duration.as_secs_f64()) {
            return refused("seconds", format!("{} s", duration.as_secs_f64()), "0.1 to 60 s");
        }
        Ok(Settings { rate_hz, duration, forces })
    }
}

/// What the device says of itself, as findings.
pub fn identity(description: &Description) -> Vec<Finding> {
    identity::findings(description)
}

/// Whether the calling thread got what a motor loop needs.
pub fn scheduling(scheduling: &Scheduling) -> Finding {
    timing::scheduling(scheduling)
}

/// Measures. Stops early, with motors off, when `stop` becomes true. Takes the time of [`Settings`] and a second more,
/// seven with forces. The calling thread is the one that is timed.
pub fn run(device: &mut dyn Device, settings: &Settings, stop: &AtomicBool) -> Vec<Finding> {
    let description = device.description().clone();
    let rest =
        sample(device, settings.rate_hz, settings.duration, stop, |_, _, _| Next::Command(Wrench::ZERO));
    let mut findings = timing::findings(&rest);
    let noise = noise::Noise::of(&rest);
    findings.extend(noise::findings(noise.as_ref()));
    findings.extend(health::findings(&description, &rest));
    let mut goes_on = ended(&rest, "at rest", &mut findings);

    let force_n = test_force_n(&description);
    if let (true, Some(force_n)) = (goes_on, force_n) {
        let pulses = Pulses::quick(force_n);
        let dry = sample(device, settings.rate_hz, pulses.duration(), stop, |time_s, _, _| {
            Next::Command(Wrench::of_force(pulses.at(time_s)))
        });
        let finding = brakes::finding(&pulses, &dry, noise.as_ref());
        goes_on = finding.verdict != Verdict::Failure;
        findings.push(finding);
        goes_on &= ended(&dry, "during the dry run", &mut findings);
    }
    if settings.forces {
        match force_n {
            None => findings.push(Finding::ok("forces", "not tried: the device has no motors for a force")),
            Some(_) if !goes_on => {
                findings.push(Finding::warning(
                    "forces",
                    "not tried, because of the failure above",
                    "see to that first",
                ));
            }
            Some(force_n) => findings.extend(push::findings(device, settings, force_n, noise.as_ref(), stop)),
        }
    }
    if let Err(error) = device.disable() {
        findings.push(Finding::failure("motors_off", error.to_string(), "switch the device's power off"));
    }
    findings
}

/// How hard this device is pushed; none: not at all.
fn test_force_n(description: &Description) -> Option<f64> {
    description.limits.max_force_n.map(|largest_n| LARGEST_FORCE_N.min(0.1 * largest_n))
}

/// Whether sampling came to its end; otherwise one more finding says why not.
fn ended(series: &Series, when: &str, findings: &mut Vec<Finding>) -> bool {
    match &series.end {
        End::Whole => return true,
        End::Lost(error) => findings.push(Finding::failure(
            "connection",
            format!("{error}, {when}, after {:.2} s", series.seconds()),
            "check cable, power and the device's own service; then run this again",
        )),
        End::Stopped => findings.push(Finding::failure(
            "connection",
            format!("stopped {when}, after {:.2} s", series.seconds()),
            "run this again and let it come to its end",
        )),
        // Only where motors are on, and told there.
        End::Broken(_) => {}
    }
    false
}

#[cfg(test)]
mod tests {
    use super::test_device::TestDevice;
    use super::*;
    use crate::{MotorsOff, Workspace};
    use glam::DVec3;

    fn check(device: &mut TestDevice, forces: bool) -> Vec<Finding> {
        let settings = Settings::new(400.0, Duration::from_millis(100), forces).unwrap();
        run(device, &settings, &AtomicBool::new(false))
    }

    /// The verdict on one thing, and the text; none when it was not judged.
    fn on<'a>(findings: &'a [Finding], name: &str) -> Option<(Verdict, &'a str)> {
        findings.iter().find(|finding| finding.name == name).map(|finding| (finding.verdict, &*finding.found))
    }

    fn verdict(findings: &[Finding], name: &str) -> Verdict {
        on(findings, name).unwrap().0
    }

    #[test]
    fn a_good_device_passes_without_its_motors() {
        let mut device = TestDevice::default();
        let findings = check(&mut device, false);
        for name in
            ["position_noise", "velocity_noise", "numbers", "orientation", "homed", "workspace", "brakes"]
        {
            assert_eq!(verdict(&findings, name), Verdict::Ok, "{name}: {findings:?}");
        }
        assert_eq!(on(&findings, "forces"), None);
        assert_eq!((device.enables, device.largest_n), (0, 0.0));
    }

    #[test]
    fn motors_that_push_although_they_are_off_are_a_failure_and_are_not_switched_on() {
        let mut device = TestDevice { brakes_fail: true, ..TestDevice::default() };
        let findings = check(&mut device, true);
        assert_eq!(verdict(&findings, "brakes"), Verdict::Failure);
        assert_eq!(verdict(&findings, "forces"), Verdict::Warning);
        assert_eq!(device.enables, 0);
    }

    #[test]
    fn with_forces_the_handle_follows_and_no_force_is_larger_than_a_tenth_of_what_it_can() {
        let mut device = TestDevice::default();
        device.description.limits.max_force_n = Some(2.0);
        let findings = check(&mut device, true);
        assert_eq!(verdict(&findings, "forces"), Verdict::Ok, "{findings:?}");
        assert_eq!((device.enables, device.enabled), (1, false));
        assert!(device.largest_n > 0.15 && device.largest_n <= 0.2, "{}", device.largest_n);
    }

    #[test]
    fn an_axis_with_the_wrong_sign_is_a_failure_and_a_dead_one_a_warning() {
        for (compliance, expected, axis) in [
            (DVec3::new(2e-3, -2e-3, 2e-3), Verdict::Failure, "along y"),
            (DVec3::new(2e-3, 2e-3, 0.0), Verdict::Warning, "along z"),
        ] {
            let findings = check(&mut TestDevice { compliance, ..TestDevice::default() }, true);
            let (verdict, text) = on(&findings, "forces").unwrap();
            assert!(verdict == expected && text.ends_with(axis), "{verdict:?} {text}");
        }
    }

    #[test]
    fn a_handle_that_nobody_holds_and_motors_that_go_off_end_the_pushes() {
        let mut free = TestDevice { compliance: DVec3::splat(0.1), ..TestDevice::default() };
        let findings = check(&mut free, true);
        let (verdict, text) = on(&findings, "forces").unwrap();
        assert!(verdict == Verdict::Failure && text.starts_with("the handle w"), "{text}");
        assert!(!free.enabled);

        let mut button = TestDevice { motors_off: Some(MotorsOff::Button), ..TestDevice::default() };
        let findings = check(&mut button, true);
        let (verdict, text) = on(&findings, "forces").unwrap();
        assert!(verdict == Verdict::Failure && text.contains("button"), "{text}");
        assert!(!button.enabled);
    }

    #[test]
    fn a_device_that_is_not_homed_or_has_no_motors_is_not_pushed() {
        let mut motorless = TestDevice::default();
        motorless.description.limits.max_force_n = None;
        let findings = check(&mut motorless, true);
        assert_eq!((verdict(&findings, "forces"), on(&findings, "brakes")), (Verdict::Ok, None));
        assert_eq!(motorless.enables, 0);
    }

    #[test]
    fn a_device_that_goes_is_a_failure_wherever_it_goes() {
        for (lost_after, when) in [(5, "at rest"), (45, "during the dry run"), (500, "with motors on")] {
            let mut device = TestDevice { lost_after, ..TestDevice::default() };
            let findings = check(&mut device, true);
            let (verdict, text) = on(&findings, "connection").unwrap();
            assert!(
                verdict == Verdict::Failure && text.contains("the cable is out") && text.contains(when),
                "{text}"
            );
            assert!(!device.enabled);
        }
    }

    #[test]
    fn the_devices_own_rate_is_that_of_new_readings() {
        let findings = check(&mut TestDevice { repeats: 4, ..TestDevice::default() }, false);
        let finding = findings.iter().find(|finding| finding.name == "device_rate").unwrap();
        // One in four readings is new, however many the loop got done.
        let rate = findings.iter().find(|finding| finding.name == "loop_rate").unwrap().numbers[0].1;
        let share = finding.numbers[0].1 / rate;
        assert!(finding.verdict == Verdict::Warning && (0.15..0.4).contains(&share), "{share} {findings:?}");
        let silent = check(&mut TestDevice { repeats: u64::MAX, ..TestDevice::default() }, false);
        assert_eq!(verdict(&silent, "device_rate"), Verdict::Failure);
    }

    #[test]
    fn at_a_rate_that_lets_the_watchdog_strike_the_motors_stay_off() {
        let mut device = TestDevice::default();
        let settings = Settings::new(100.0, Duration::from_millis(100), true).unwrap();
        let findings = run(&mut device, &settings, &AtomicBool::new(false));
        let forces = findings.iter().find(|finding| finding.name == "forces").unwrap();
        assert!(forces.verdict == Verdict::Warning && forces.remedy.contains("150"), "{forces:?}");
        assert_eq!(device.enables, 0);
    }

    #[test]
    fn a_stop_from_outside_leaves_the_motors_off() {
        let mut device = TestDevice::default();
        let settings = Settings::new(400.0, Duration::from_millis(100), true).unwrap();
        let findings = run(&mut device, &settings, &AtomicBool::new(true));
        let (verdict, text) = on(&findings, "connection").unwrap();
        assert!(verdict == Verdict::Failure && text.starts_with("stopped at rest"), "{text}");
        assert!(device.enables == 0 && on(&findings, "loop_rate").is_none());
    }

    #[test]
    fn settings_out_of_range_are_refused_by_name() {
        for (rate_hz, seconds, name) in
            [(9.0, 1.0, "rate"), (f64::NAN, 1.0, "rate"), (1000.0, 61.0, "seconds")]
        {
            let error =
                Settings::new(rate_hz, Duration::try_from_secs_f64(seconds).unwrap(), false).unwrap_err();
            assert!(matches!(error, DeviceError::Setting { name: named, .. } if named == name), "{error}");
        }
    }

    #[test]
    fn a_handle_at_the_edge_of_its_workspace_is_not_pushed_out_of_it() {
        let workspace = Workspace { centre: DVec3::new(0.0995, 0.0, 0.0), radius_m: 0.1, height_m: 0.2 };
        let mut device = TestDevice::default();
        device.description.limits.workspace = workspace;
        let findings = check(&mut device, true);
        assert_ne!(verdict(&findings, "forces"), Verdict::Failure, "{findings:?}");
    }

    #[cfg(feature = "simulated")]
    #[test]
    fn the_noise_of_a_simulated_device_is_measured_as_it_was_set() {
        use crate::simulated::{
            Flaws, HandSettings, Phase, Script, Segment, Settings as Simulated, SimulatedDevice,
        };
        let deviation_m = |flaws: Flaws| {
            let rest = Segment {
                phase: Phase::Hold,
                duration_s: 1.0,
                path: vec![DVec3::splat(4e-4)],
                gripper_rad: 0.5,
            };
            let hand = HandSettings { mass_kg: 0.3, stiffness_n_per_m: 500.0, damping_n_s_per_m: 20.0 };
            let script = Script::new(vec![rest]).unwrap();
            let mut device =
                SimulatedDevice::open(Simulated { hand, script, period_s: 1e-3, flaws }).unwrap();
            let settings = Settings::new(1000.0, Duration::from_secs(1), false).unwrap();
            let findings = run(&mut device, &settings, &AtomicBool::new(false));
            let noise = findings.into_iter().find(|finding| finding.name == "position_noise").unwrap();
            assert!(noise.numbers.contains(&("moved_m", 0.0)), "{noise:?}");
            ["deviation_x_m", "deviation_y_m", "deviation_z_m"]
                .map(|name| noise.numbers.iter().find(|number| number.0 == name).unwrap().1)
        };
        for noise_m in [20e-6, 200e-6] {
            // A deviation from several hundred readings is known to a few percent.
            for measured in deviation_m(Flaws { noise_m, ..Flaws::default() }) {
                assert!((measured / noise_m - 1.0).abs() < 0.2, "{measured} of {noise_m}");
            }
        }
        assert!(deviation_m(Flaws::default()).into_iter().all(|measured| measured < 1e-15));
        // Noise that is far below a step of the quantisation makes no reading differ; noise far above is as it was.
        let (noise_m, step_m) = (100e-6, 20e-6);
        let expected = (noise_m * noise_m + step_m * step_m / 12.0f64).sqrt();
        for measured in deviation_m(Flaws { noise_m, quantisation_m: step_m, ..Flaws::default() }) {
            assert!((measured / expected - 1.0).abs() < 0.2, "{measured} of {expected}");
        }
        assert_eq!(deviation_m(Flaws { noise_m: 1e-6, quantisation_m: 1e-3, ..Flaws::default() }), [0.0; 3]);
    }
}
