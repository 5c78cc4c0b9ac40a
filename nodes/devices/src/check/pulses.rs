//! Small smooth pushes along each axis, to and fro, with rests between them; and what came of them.

use std::time::Duration;

use glam::DVec3;

use super::sampling::Series;

const AXES: [DVec3; 3] = [DVec3::X, DVec3::Y, DVec3::Z];
/// To and fro along three axes.
const COUNT: usize = 6;

/// A plan of forces over time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pulses {
    force_n: f64,
    begin_s: f64,
    push_s: f64,
    rest_s: f64,
}

impl Pulses {
    /// For motors that are off: 0.9 s.
    pub(super) fn quick(force_n: f64) -> Pulses {
        Pulses { force_n, begin_s: 0.0, push_s: 0.1, rest_s: 0.05 }
    }

    /// For a hand to feel: after `begin_s`, 2.4 s.
    pub(super) fn felt(force_n: f64, begin_s: f64) -> Pulses {
        Pulses { force_n, begin_s, push_s: 0.2, rest_s: 0.2 }
    }

    pub(super) fn duration(&self) -> Duration {
        Duration::try_from_secs_f64(self.begin_s + COUNT as f64 * (self.rest_s + self.push_s))
            .unwrap_or_default()
    }

    /// The force at a time since the beginning, N. Each push rises from nothing and falls back without a step.
    pub(super) fn at(&self, time_s: f64) -> DVec3 {
        let Some((index, share)) = self.push(time_s) else { return DVec3::ZERO };
        let bump = share * (1.0 - share);
        self.direction(index) * self.force_n * 16.0 * bump * bump
    }

    fn direction(&self, index: usize) -> DVec3 {
        let sign = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
        AXES[index / 2] * sign
    }

    /// Which push, and how far it has come, 0 to 1; none during a rest.
    fn push(&self, time_s: f64) -> Option<(usize, f64)> {
        let since_s = time_s - self.begin_s;
        if since_s < 0.0 {
            return None;
        }
        let index = (since_s / (self.rest_s + self.push_s)).floor();
        let share = (since_s - index * (self.rest_s + self.push_s) - self.rest_s) / self.push_s;
        ((0.0..1.0).contains(&share) && index < COUNT as f64).then_some((index as usize, share))
    }

    /// How far the handle went along each axis with the force on it, m, to and fro averaged: positive when it followed.
    /// None: the readings do not cover every push.
    pub(super) fn response_m(&self, series: &Series) -> Option<DVec3> {
        let mut sums = [DVec3::ZERO; COUNT];
        let mut counts = [0.0; COUNT];
        let mut starts: [Option<DVec3>; COUNT] = [None; COUNT];
        let mut before = series.ticks.first()?.state.position;
        for tick in series.ticks.iter().filter(|tick| tick.state.is_finite) {
            let position = tick.state.position;
            match self.push(tick.due_ns as f64 * 1e-9) {
                Some((index, _)) => {
                    let start = *starts[index].get_or_insert(before);
                    sums[index] += position - start;
                    counts[index] += 1.0;
                }
                None => before = position,
            }
        }
        if counts.contains(&0.0) {
            return None;
        }
        let along = |index: usize| (sums[index] / counts[index]).dot(self.direction(index));
        Some(DVec3::from_array([0, 2, 4].map(|index| 0.5 * (along(index) + along(index + 1)))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_force_is_larger_than_the_largest_and_none_steps() {
        let pulses = Pulses::felt(0.5, 1.0);
        let step_s = 1e-4;
        let mut last = DVec3::ZERO;
        let mut impulse = DVec3::ZERO;
        let mut largest = DVec3::ZERO;
        for tick in 0..40_000 {
            let force = pulses.at(f64::from(tick) * step_s);
            assert!(
                force.length() <= 0.5 && (force - last).length() <= 0.5 * 16.0 * step_s,
                "{tick}: {force}"
            );
            (last, impulse, largest) = (force, impulse + force * step_s, largest.max(force));
        }
        assert!(impulse.length() < 1e-9, "{impulse}");
        assert!((largest - DVec3::splat(0.5)).abs().max_element() < 1e-6, "{largest}");
        assert_eq!(pulses.at(0.5), DVec3::ZERO);
        assert_eq!(last, DVec3::ZERO, "over at the end");
    }
}
