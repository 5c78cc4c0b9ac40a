//! Geometric sums over the units of a chain. Every term is positive and every sum is built by doubling the number
//! of its terms, so nothing cancels: neither for `q -> 1`, nor for `q^2 e^(1/beta)` on either side of 1, nor for 10^6 units.

use crate::double_double::DoubleDouble;

/// Sums that turn the first unit's quantities into the chain's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ChainSums {
    /// `S_n = 1 + q + .. + q^(n-1)`: depth at the contact for each metre of `dl_1` (10).
    pub(crate) elongation: f64,
    /// `1 + q^2 + .. + q^(2(n-1))`: stored energy of the normal springs (13).
    pub(crate) normal: f64,
    /// `1 + r + .. + r^(n-1)`, `r = q^2 e^(1/beta)`: stored energy of the tangential springs (12).
    /// `None`: above 1e280, on the brink of overflow.
    pub(crate) tangential: Option<f64>,
}

impl ChainSums {
    /// `units >= 1`, `0 < ratio < 1`, `growth` = beta > 0.
    pub(crate) fn new(ratio: f64, units: u32, growth: f64) -> Self {
        let square = DoubleDouble::product(ratio, ratio);
        Self {
            elongation: geometric_sum(DoubleDouble::product(ratio, 1.0), units).unwrap_or(f64::INFINITY),
            normal: geometric_sum(square, units).unwrap_or(f64::INFINITY),
            tangential: if units == 1 { Some(1.0) } else { tangential_sum(square, units, growth) },
        }
    }
}

fn tangential_sum(square: DoubleDouble, units: u32, growth: f64) -> Option<f64> {
    /// `e^600 = 4e260`: a second unit that is stiffer than the first by more than this is no spring.
    const LARGEST_EXPONENT: f64 = 600.0;
    if 1.0 / growth > LARGEST_EXPONENT {
        return None;
    }
    geometric_sum(square.times(DoubleDouble::reciprocal(growth).exp()), units)
}

/// `1 + r + .. + r^(n-1)` from the binary digits of `n`, the highest first: with `m` terms known,
/// `2m` terms are `sum (1 + r^m)` and one more is `1 + r sum`. `None` when it exceeds 1e280.
fn geometric_sum(r: DoubleDouble, n: u32) -> Option<f64> {
    const LARGEST_SUM: f64 = 1e280;
    let mut sum = DoubleDouble::ONE;
    let mut power = r;
    for digit in (0..n.ilog2()).rev() {
        sum = sum.plus(sum.times(power));
        power = power.times(power);
        if (n >> digit) & 1 == 1 {
            sum = DoubleDouble::ONE.plus(sum.times(r));
            power = power.times(r);
        }
        // A power that overflowed is NaN here, and so is the sum that would need it.
        if sum.value().is_nan() || sum.value() > LARGEST_SUM {
            return None;
        }
    }
    Some(sum.value())
}
