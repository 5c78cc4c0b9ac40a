//! How still the readings are while the handle is.

use glam::DVec3;

use super::sampling::Series;
use super::timing::verdict;
use super::{Finding, Verdict};

/// A force of 0.05 N, which a hand just feels, is this far on a contact of 1000 N/m; 1 N is a failure.
const GOOD_M: f64 = 50e-6;
const USABLE_M: f64 = 1e-3;
/// A device damping of 10 N s/m makes 0.1 N of it.
const GOOD_M_PER_S: f64 = 0.01;

/// Fewer new readings tell nothing about noise.
const FEWEST: usize = 20;
/// The time is cut into so many pieces: their means wander when the handle is moved.
const PIECES: usize = 10;
/// A mean of noise alone stays within so many of its own standard deviations, ...
const WANDER: f64 = 8.0;
/// ... and less than this, m, is no motion at all.
const STILL_M: f64 = 20e-6;

/// Of the new readings, per axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Noise {
    /// Standard deviation of the position, m: about its mean or, where the handle was moved, from one reading to the
    /// next.
    pub(super) deviation_m: DVec3,
    pub(super) peak_to_peak_m: DVec3,
    pub(super) velocity_m_per_s: DVec3,
    /// How far the handle was moved, m; none: it was still.
    pub(super) moved_m: Option<f64>,
    /// How many readings.
    pub(super) readings: usize,
}

impl Noise {
    /// None: too few new readings.
    pub(super) fn of(series: &Series) -> Option<Noise> {
        let readings: Vec<_> = series.distinct().map(|tick| tick.state).collect();
        if readings.len() < FEWEST {
            return None;
        }
        let positions: Vec<DVec3> = readings.iter().map(|reading| reading.position).collect();
        let velocities: Vec<DVec3> = readings.iter().map(|reading| reading.velocity).collect();
        // Second differences: what an even motion adds is not in them.
        let bends: Vec<DVec3> =
            positions.windows(3).map(|three| three[0] - 2.0 * three[1] + three[2]).collect();
        let step_m = mean(bends.iter().map(|bend| bend * bend / 6.0)).map(f64::sqrt);
        let piece = positions.len() / PIECES;
        let means: Vec<DVec3> =
            positions.chunks_exact(piece).map(|piece| mean(piece.iter().copied())).collect();
        let wandered = extent(&means);
        let allowed = (step_m * (WANDER / (piece as f64).sqrt())).max(DVec3::splat(STILL_M));
        let moved = wandered.cmpgt(allowed).any();
        Some(Noise {
            deviation_m: if moved { step_m } else { deviation(&positions) },
            peak_to_peak_m: extent(&positions),
            velocity_m_per_s: deviation(&velocities),
            moved_m: moved.then(|| wandered.length()),
            readings: readings.len(),
        })
    }
}

fn mean(values: impl ExactSizeIterator<Item = DVec3>) -> DVec3 {
    let count = values.len();
    values.sum::<DVec3>() / count as f64
}

fn deviation(values: &[DVec3]) -> DVec3 {
    let middle = mean(values.iter().copied());
    mean(values.iter().map(|value| (value - middle) * (value - middle))).map(f64::sqrt)
}

fn extent(values: &[DVec3]) -> DVec3 {
    let (low, high) = values.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), value| {
        (low.min(*value), high.max(*value))
    });
    high - low
}

pub(super) fn findings(noise: Option<&Noise>) -> Vec<Finding> {
    const HOLD_STILL: &str = "let go of the handle, or lay it down, and run this again";
    let Some(noise) = noise else {
        return vec![Finding::warning(
            "position_noise",
            "not measured: fewer than 20 new readings",
            "take a longer --seconds, or see to the device's rate",
        )];
    };
    let [x, y, z] = (noise.deviation_m * 1e6).to_array();
    let [px, py, pz] = (noise.peak_to_peak_m * 1e6).to_array();
    let mut found =
        format!("standard deviation {x:.1} {y:.1} {z:.1} um, peak to peak {px:.1} {py:.1} {pz:.1} um");
    let largest_m = noise.deviation_m.max_element();
    let mut state = verdict(largest_m <= GOOD_M, largest_m <= USABLE_M);
    let mut remedy = "keep the sensors' cables away from motors; see the device's power supply and its earth";
    if let Some(moved_m) = noise.moved_m {
        found += &format!(
            "; the handle was moved by {:.2} mm, so the deviation is from reading to reading",
            moved_m * 1e3
        );
        state = state.max(Verdict::Warning);
        if state == Verdict::Warning {
            remedy = HOLD_STILL;
        }
    }
    let mut position = Finding::new("position_noise", state, found, remedy)
        .held_against("deviation at most 50 um; more than 1 mm is a failure")
        .with("readings", noise.readings as f64);
    for (name, value) in [
        ("deviation_x_m", noise.deviation_m.x),
        ("deviation_y_m", noise.deviation_m.y),
        ("deviation_z_m", noise.deviation_m.z),
        ("peak_to_peak_x_m", noise.peak_to_peak_m.x),
        ("peak_to_peak_y_m", noise.peak_to_peak_m.y),
        ("peak_to_peak_z_m", noise.peak_to_peak_m.z),
        ("moved_m", noise.moved_m.unwrap_or(0.0)),
    ] {
        position = position.with(name, value);
    }

    let [x, y, z] = (noise.velocity_m_per_s * 1e3).to_array();
    let is_quiet = noise.velocity_m_per_s.max_element() <= GOOD_M_PER_S;
    let remedy = if noise.moved_m.is_some() {
        HOLD_STILL
    } else {
        "let the device's firmware or SDK filter its velocity"
    };
    let velocity = Finding::new(
        "velocity_noise",
        verdict(is_quiet, true),
        format!("standard deviation {x:.2} {y:.2} {z:.2} mm/s"),
        remedy,
    )
    .held_against("at most 10 mm/s")
    .with("deviation_x_m_per_s", noise.velocity_m_per_s.x)
    .with("deviation_y_m_per_s", noise.velocity_m_per_s.y)
    .with("deviation_z_m_per_s", noise.velocity_m_per_s.z);
    vec![position, velocity]
}

#[cfg(test)]
mod tests {
    use super::super::test_device::series;
    use super::*;
    use crate::DeviceState;
    use rhombus_chain::Pose;

    /// Uniform in -1..1, from a fixed seed.
    fn uniform(state: &mut u64) -> f64 {
        *state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (*state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn noisy(amplitude_m: DVec3, drift_m: f64) -> Noise {
        let mut seed = 5;
        let states = (0..2000).map(|i| {
            let noise = DVec3::new(uniform(&mut seed), uniform(&mut seed), uniform(&mut seed)) * amplitude_m;
            let drift = DVec3::Z * drift_m * f64::from(i) / 2000.0;
            let mut state = DeviceState::at_rest(Pose { translation: noise + drift, ..Pose::IDENTITY });
            state.linear_velocity_m_per_s = noise * 100.0;
            state
        });
        Noise::of(&series(states)).unwrap()
    }

    #[test]
    fn uniform_noise_has_its_textbook_deviation_and_extent() {
        let amplitude = DVec3::new(10e-6, 20e-6, 40e-6);
        let noise = noisy(amplitude, 0.0);
        let expected = amplitude / 3f64.sqrt();
        assert!(((noise.deviation_m - expected) / expected).abs().max_element() < 0.03, "{noise:?}");
        assert!(
            ((noise.peak_to_peak_m - 2.0 * amplitude) / amplitude).abs().max_element() < 0.02,
            "{noise:?}"
        );
        assert!((noise.velocity_m_per_s - 100.0 * noise.deviation_m).abs().max_element() < 1e-12);
        assert_eq!((noise.moved_m, noise.readings), (None, 2000));
    }

    #[test]
    fn a_handle_that_is_moved_is_said_to_be_and_its_noise_stays_the_same() {
        let (still, moved) = (noisy(DVec3::splat(30e-6), 0.0), noisy(DVec3::splat(30e-6), 0.02));
        assert!((moved.moved_m.unwrap() - 0.018).abs() < 0.001, "{moved:?}");
        assert!(((moved.deviation_m - still.deviation_m) / still.deviation_m).abs().max_element() < 0.05);
        assert_eq!(findings(Some(&still))[0].verdict, Verdict::Ok);
        let finding = &findings(Some(&moved))[0];
        assert!(finding.verdict == Verdict::Warning && finding.found.contains("moved by 18"), "{finding:?}");
    }

    #[test]
    fn a_still_and_silent_position_has_no_noise() {
        let noise = noisy(DVec3::ZERO, 0.0);
        assert_eq!(
            (noise.deviation_m, noise.peak_to_peak_m, noise.moved_m),
            (DVec3::ZERO, DVec3::ZERO, None)
        );
    }

    #[test]
    fn more_noise_than_a_hand_can_bear_is_a_failure_and_too_few_readings_tell_nothing() {
        let verdict = |amplitude_m: f64| findings(Some(&noisy(DVec3::splat(amplitude_m), 0.0)))[0].verdict;
        assert_eq!(verdict(80e-6), Verdict::Ok);
        assert_eq!(verdict(100e-6), Verdict::Warning);
        assert_eq!(verdict(2e-3), Verdict::Failure);
        let few = series((0..19).map(|_| DeviceState::at_rest(Pose::IDENTITY)));
        assert_eq!(Noise::of(&few), None);
    }
}
