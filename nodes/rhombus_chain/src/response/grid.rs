//! Where shapes are tabulated: fine at the contact, coarser with the distance, as shapes are that have long fallen off there.
//!
//! Steps have one size up to a distance and twice that size up to twice the distance, and so on. That is how single-precision
//! numbers are spaced, so the bits of `s + start` hold the step and the place in it.

use glam::Vec4;

use super::lanes::LANES;

/// Steps in which a distance doubles: 32. Linear between two nodes, an exponential is off by at most 1e-4 of its value at the
/// contact.
const BITS: u32 = 5;
/// `start` is at most this part of the length in which the steepest shape falls to 1/e.
const START: f64 = 0.5;
/// Bits of a number below those that tell the step.
const BELOW: u32 = f32::MANTISSA_DIGITS - 1 - BITS;
/// Distances are no more than this many times `start`.
const MOST_STARTS: f64 = 4096.0;

/// Distances `s`, m, at which there is a node. The first is 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    /// A power of two.
    start_m: f32,
    last: u32,
}

impl Grid {
    /// Nodes up to `reach_m` at least, as far apart as shapes need that change in `finest_m`.
    pub(crate) fn new(finest_m: f64, reach_m: f64) -> Self {
        let reach_m = reach_m.max(f64::from(f32::MIN_POSITIVE) * MOST_STARTS);
        let wanted_m = (START * finest_m).clamp(reach_m / MOST_STARTS, reach_m) as f32;
        let exponent = wanted_m.to_bits() >> (f32::MANTISSA_DIGITS - 1);
        let start_m = f32::from_bits(exponent << (f32::MANTISSA_DIGITS - 1));
        Self { start_m, last: ((reach_m as f32 + start_m).to_bits() - start_m.to_bits()) >> BELOW }
    }

    /// Number of nodes: one more than [`places`](Self::places) returns at most, and the one after it.
    pub(crate) fn nodes(&self) -> usize {
        self.last as usize + 2
    }

    /// Distance of a node, m.
    pub(crate) fn distance_m(&self, node: usize) -> f64 {
        f64::from(f32::from_bits(self.start_m.to_bits() + ((node as u32) << BELOW))) - f64::from(self.start_m)
    }

    /// The nodes before four distances, and how far each is on its way to the next, 0 to 1. Beyond the last step: its end.
    #[inline(always)]
    pub(crate) fn places(&self, s_m: Vec4) -> ([u32; LANES], Vec4) {
        let first = self.start_m.to_bits();
        let beyond = f32::from_bits(first + ((self.last + 1) << BELOW) - 1);
        let numbers = (s_m + Vec4::splat(self.start_m)).min(Vec4::splat(beyond)).to_array();
        let (mut nodes, mut parts) = ([0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            let bits = numbers[lane].to_bits();
            nodes[lane] = (bits - first) >> BELOW;
            parts[lane] = (bits & ((1 << BELOW) - 1)) as i32 as f32;
        }
        (nodes, Vec4::from_array(parts) * (1.0 / (1 << BELOW) as f32))
    }

    /// Size of a step at `s_m`, m, or a little more.
    pub(crate) fn step_m(&self, s_m: f32) -> f32 {
        (s_m + self.start_m) * (1.0 / (1 << BITS) as f32)
    }
}
