//! What makes measurements of a real device worse than the truth, each switched on by itself.
//!
//! The random numbers are a function of the reading's number alone, so the same forces give the same readings, bit for bit.

use std::collections::VecDeque;
use std::f64::consts::TAU;

use glam::DVec3;

use crate::{DeviceError, DeviceState};

/// What is wrong with the readings; by default nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Flaws {
    /// Standard deviation of the noise on each coordinate of positions, m, >= 0 (`simulated.noise`). Velocities have none.
    pub noise_m: f64,
    /// Positions are multiples of this, m; 0: exact (`simulated.quantisation`).
    pub quantisation_m: f64,
    /// Share of readings that repeat the one before, its time too, 0 <= and < 1 (`simulated.dropout`).
    pub dropout: f64,
    /// Age of readings, s, rounded to whole periods, 0 to 1 (`simulated.latency`).
    pub latency_s: f64,
}

impl Flaws {
    fn check(&self) -> Result<(), DeviceError> {
        let length = "a finite number >= 0 [m]";
        for (name, value, is_fine, accepted) in [
            ("simulated.noise", self.noise_m, self.noise_m >= 0.0, length),
            ("simulated.quantisation", self.quantisation_m, self.quantisation_m >= 0.0, length),
            ("simulated.dropout", self.dropout, (0.0..1.0).contains(&self.dropout), "0 <= and < 1"),
            ("simulated.latency", self.latency_s, (0.0..=1.0).contains(&self.latency_s), "0 to 1 [s]"),
        ] {
            if !(is_fine && value.is_finite()) {
                return Err(DeviceError::Setting {
                    name,
                    value: value.to_string(),
                    accepted: accepted.to_owned(),
                });
            }
        }
        Ok(())
    }
}

/// Readings that are worse than the truth.
#[derive(Clone, Debug)]
pub(super) struct Measurement {
    flaws: Flaws,
    /// Readings are this many periods old.
    delay: usize,
    /// The truth of the last periods, the oldest first; its memory is taken when opening.
    past: VecDeque<DeviceState>,
    reading: DeviceState,
}

impl Measurement {
    /// None when nothing is wrong with the readings: then the truth is read, at no cost.
    ///
    /// # Errors
    /// [`DeviceError::Setting`] names the parameter.
    pub(super) fn new(
        flaws: Flaws,
        period_s: f64,
        truth: DeviceState,
    ) -> Result<Option<Measurement>, DeviceError> {
        flaws.check()?;
        if flaws == Flaws::default() {
            return Ok(None);
        }
        let delay = (flaws.latency_s / period_s).round() as usize;
        let mut past = VecDeque::with_capacity(delay + 2);
        past.push_back(truth);
        let reading = flawed(&flaws, truth, 0);
        Ok(Some(Measurement { flaws, delay, past, reading }))
    }

    /// Measures the truth at the reading of that number, which goes up by one each period. RT safe.
    pub(super) fn measure(&mut self, number: u64, truth: DeviceState) {
        self.past.push_back(truth);
        if self.past.len() > self.delay + 1 {
            self.past.pop_front();
        }
        if uniform(number, 0) < self.flaws.dropout {
            return;
        }
        if let Some(late) = self.past.front() {
            self.reading = flawed(&self.flaws, *late, number);
        }
    }

    /// The newest reading. RT safe.
    pub(super) fn reading(&self) -> DeviceState {
        self.reading
    }
}

fn flawed(flaws: &Flaws, mut state: DeviceState, number: u64) -> DeviceState {
    let mut position = state.pose.translation;
    if flaws.noise_m > 0.0 {
        let [x, y] = normal_pair(number, 1);
        let [z, _] = normal_pair(number, 3);
        position += flaws.noise_m * DVec3::new(x, y, z);
    }
    if flaws.quantisation_m > 0.0 {
        position = (position / flaws.quantisation_m).round() * flaws.quantisation_m;
    }
    state.pose.translation = position;
    state.joints[..3].copy_from_slice(&position.to_array());
    state
}

/// Two independent numbers of mean 0 and standard deviation 1 (Box and Muller).
fn normal_pair(number: u64, stream: u64) -> [f64; 2] {
    // 1 - u is never zero.
    let radius = (-2.0 * libm::log(1.0 - uniform(number, stream))).sqrt();
    let angle = TAU * uniform(number, stream + 1);
    [radius * libm::cos(angle), radius * libm::sin(angle)]
}

/// 0 <= and < 1, by the reading's number and what it is for: SplitMix64's mixing of a counter.
fn uniform(number: u64, stream: u64) -> f64 {
    const STREAMS: u64 = 8;
    let mut bits = number.wrapping_mul(STREAMS).wrapping_add(stream + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^= bits >> 31;
    (bits >> 11) as f64 / (1u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;
    use rhombus_chain::Pose;

    const COUNT: u64 = 40_000;

    /// The truth: moves along x by a micrometre a period.
    fn truth(number: u64) -> DeviceState {
        let translation = DVec3::new(number as f64 * 1e-6, 0.01, -0.02);
        let mut state = DeviceState::at_rest(Pose { translation, rotation: DQuat::IDENTITY });
        state.joints[..3].copy_from_slice(&translation.to_array());
        state.device_time_ns = number * 1_000_000;
        state
    }

    fn readings(flaws: Flaws) -> Vec<DeviceState> {
        let mut measurement = Measurement::new(flaws, 1e-3, truth(0)).unwrap().unwrap();
        let mut readings = vec![measurement.reading()];
        for number in 1..COUNT {
            measurement.measure(number, truth(number));
            readings.push(measurement.reading());
        }
        readings
    }

    #[test]
    fn nothing_wrong_costs_nothing() {
        assert!(Measurement::new(Flaws::default(), 1e-3, truth(0)).unwrap().is_none());
    }

    #[test]
    fn noise_has_no_mean_and_the_standard_deviation_it_was_given_and_repeats() {
        let flaws = Flaws { noise_m: 1e-4, ..Flaws::default() };
        let readings = readings(flaws);
        let errors: Vec<DVec3> =
            (0..).zip(&readings).map(|(n, r)| r.pose.translation - truth(n).pose.translation).collect();
        let mean = errors.iter().sum::<DVec3>() / COUNT as f64;
        let variance = errors.iter().map(|e| (*e - mean) * (*e - mean)).sum::<DVec3>() / COUNT as f64;
        let product = errors.iter().map(|e| e.x * e.y).sum::<f64>() / COUNT as f64;
        assert!(mean.abs().max_element() < 4e-4 / (COUNT as f64).sqrt(), "{mean}");
        for axis in variance.to_array() {
            assert!((axis.sqrt() / 1e-4 - 1.0).abs() < 0.02, "{variance}");
        }
        assert!(product.abs() < 4e-8 / (COUNT as f64).sqrt(), "axes are independent: {product}");
        assert_eq!(readings, self::readings(flaws));
        assert!(readings.iter().all(|r| r.joints[..3] == r.pose.translation.to_array()));
    }

    #[test]
    fn quantised_positions_are_the_nearest_multiples() {
        for (number, reading) in (0..).zip(readings(Flaws { quantisation_m: 3e-5, ..Flaws::default() })) {
            let steps = reading.pose.translation / 3e-5;
            assert!((steps - steps.round()).length() < 1e-6);
            let error = reading.pose.translation - truth(number).pose.translation;
            assert!(error.abs().max_element() <= 1.5e-5 + 1e-12);
        }
    }

    #[test]
    fn a_dropped_reading_is_the_one_before_with_its_time() {
        let readings = readings(Flaws { dropout: 0.25, ..Flaws::default() });
        let mut dropped = 0;
        for (number, pair) in (1..).zip(readings.windows(2)) {
            if pair[1] == pair[0] {
                dropped += 1;
            } else {
                assert_eq!(pair[1], truth(number));
            }
        }
        let share = f64::from(dropped) / COUNT as f64;
        assert!((share - 0.25).abs() < 0.01, "{share}");
    }

    #[test]
    fn late_readings_are_the_truth_of_whole_periods_ago() {
        for (number, reading) in (0u64..).zip(readings(Flaws { latency_s: 0.0071, ..Flaws::default() })) {
            assert_eq!(reading, truth(number.saturating_sub(7)));
        }
    }

    #[test]
    fn what_is_no_flaw_is_refused_by_its_parameter() {
        let none = Flaws::default();
        for (flaws, name) in [
            (Flaws { noise_m: -1e-3, ..none }, "simulated.noise"),
            (Flaws { quantisation_m: f64::NAN, ..none }, "simulated.quantisation"),
            (Flaws { dropout: 1.0, ..none }, "simulated.dropout"),
            (Flaws { latency_s: f64::INFINITY, ..none }, "simulated.latency"),
        ] {
            let text = Measurement::new(flaws, 1e-3, truth(0)).err().unwrap().to_string();
            assert!(text.contains(name), "{text}");
        }
    }
}
