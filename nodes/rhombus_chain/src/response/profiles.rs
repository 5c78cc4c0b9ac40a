//! The shapes of all chains at once, from a table: `g_p(s) = max(1 - (1 - q^(s/h)) / (1 - q^m), 0)`.
//!
//! What depends on the place, `1 - q^(s/h)`, is tabulated once; what depends on the depth, `1 - q^m`, is a factor.

use crate::contact_shape::ContactShape;

use super::MOST_CHAINS;

/// Steps of the table for each length in which the steepest chain falls to 1/e: off by at most 1.3e-4 of the value there.
const STEPS_PER_FALL: f64 = 32.0;
/// Steps of the table, at least and at most.
const STEPS: (f64, f64) = (64.0, 65_536.0);

/// `1 - q^(s/h)` of each chain at equidistant `s`, linear in between.
#[derive(Clone, Debug)]
pub(crate) struct Profiles {
    chains: usize,
    steps: usize,
    steps_per_m: f32,
    /// (steps + 2) x P.
    drops: Vec<f32>,
    /// One over the arc in which what has a direction rises from its zero at the contact, for each chain.
    pub(crate) ramps_per_m: [f32; MOST_CHAINS],
    /// `1 / (1 - q^m)`, for each chain.
    scales: [f32; MOST_CHAINS],
}

impl Profiles {
    /// Those of `shape`, for arcs up to `longest_arc_m`.
    pub(crate) fn new(shape: &ContactShape, longest_arc_m: f64) -> Self {
        let chains = shape.chains().min(MOST_CHAINS);
        let reach_m = shape.longest_chain_m().min(longest_arc_m);
        let wanted = STEPS_PER_FALL * reach_m / shape.steepest_fall_m();
        let steps = wanted.clamp(STEPS.0, STEPS.1) as usize;
        let step_m = reach_m / steps as f64;
        let mut drops = Vec::with_capacity((steps + 2) * chains);
        for step in 0..steps + 2 {
            drops.extend((0..chains).map(|chain| shape.drop(chain, step as f64 * step_m) as f32));
        }
        let mut profiles = Self {
            chains,
            steps,
            steps_per_m: (1.0 / step_m) as f32,
            drops,
            ramps_per_m: [0.0; MOST_CHAINS],
            scales: [1.0; MOST_CHAINS],
        };
        for (chain, ramp) in profiles.ramps_per_m.iter_mut().enumerate().take(chains) {
            *ramp = shape.ramp_per_m(chain) as f32;
        }
        profiles.set_depth(shape);
        profiles
    }

    /// Takes over how far the boundary of `shape` reaches at its present depth.
    pub(crate) fn set_depth(&mut self, shape: &ContactShape) {
        for (chain, scale) in self.scales.iter_mut().enumerate().take(self.chains) {
            *scale = shape.drop_scale(chain) as f32;
        }
    }

    /// `g_p` of every chain at `s`, m.
    #[inline(always)]
    pub(crate) fn at(&self, s_m: f32, shapes: &mut [f32; MOST_CHAINS]) {
        let steps = (s_m * self.steps_per_m).min(self.steps as f32);
        let (step, part) = (steps as usize, steps.fract());
        let begin = step * self.chains;
        // Two rows: there are steps + 2, and step <= steps.
        let rows = &self.drops[begin..begin + 2 * self.chains];
        let (low, high) = rows.split_at(self.chains);
        for ((shape, (low, high)), scale) in shapes.iter_mut().zip(low.iter().zip(high)).zip(&self.scales) {
            *shape = (1.0 - (low + part * (high - low)) * scale).max(0.0);
        }
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        size_of_val(self.drops.as_slice())
    }
}
