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
    /// `None`: it overflows.
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
/// `2m` terms are `sum (1 + r^m)` and one more is `1 + r sum`. `None` when it overflows.
fn geometric_sum(r: DoubleDouble, n: u32) -> Option<f64> {
    let mut sum = DoubleDouble::ONE;
    let mut power = r;
    for digit in (0..n.ilog2()).rev() {
        sum = sum.plus(sum.times(power));
        power = power.times(power);
        if (n >> digit) & 1 == 1 {
            sum = DoubleDouble::ONE.plus(sum.times(r));
            power = power.times(r);
        }
    }
    // A power that overflowed is NaN, and so is every sum that needed it.
    let sum = sum.value();
    sum.is_finite().then_some(sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Term by term from the smallest end, with the rounding of every product and sum carried along.
    fn term_by_term(r: DoubleDouble, n: u32) -> f64 {
        let mut sum = DoubleDouble::ONE;
        for _ in 1..n {
            sum = DoubleDouble::ONE.plus(sum.times(r));
        }
        sum.value()
    }

    #[test]
    fn doubling_gives_what_adding_term_by_term_gives() {
        let growths = [0.3, 0.999_999, 1.0 - f64::EPSILON / 2.0, 1.0, 1.0 + f64::EPSILON, 1.000_3];
        for r in growths.map(|r| DoubleDouble::product(r, 1.0)) {
            for n in (1..=70).chain([127, 128, 129, 1000, 65_537, 999_999, 1_000_000]) {
                assert_eq!(geometric_sum(r, n), Some(term_by_term(r, n)), "r = {r:?}, n = {n}");
            }
        }
    }

    #[test]
    fn powers_of_two_are_summed_exactly() {
        for n in 1..=53 {
            assert_eq!(
                geometric_sum(DoubleDouble::product(2.0, 1.0), n),
                Some(libm::exp2(f64::from(n)) - 1.0)
            );
        }
    }

    #[test]
    fn a_growth_that_the_ratio_nearly_undoes_keeps_its_digits_over_a_million_units() {
        // From 120 digits: beta is 1 / ln(0.9^-2) as f64 rounds it, and q^2 e^(1/beta) = 1 - 2.4e-17.
        let sums = ChainSums::new(0.9, 1_000_000, 4.745610790514953);
        assert_eq!(sums.tangential, Some(999_999.999_988_129));
        // q = 1 - 2^-53: all but one term short of n.
        let sums = ChainSums::new(1.0 - f64::EPSILON / 2.0, 1_000_000, 1e6);
        assert_eq!(sums.elongation, 999_999.999_944_488_9);
    }

    #[test]
    fn what_a_machine_cannot_hold_is_no_number() {
        assert_eq!(ChainSums::new(0.9, 2, 1e-3).tangential, None);
        assert_eq!(ChainSums::new(0.9, 2, 1e-310).tangential, None);
        assert_eq!(ChainSums::new(0.99, 1_000_000, 10.0).tangential, None);
        assert_eq!(ChainSums::new(0.9, 1, 1e-310).tangential, Some(1.0));
        assert!(ChainSums::new(0.9, 700, 1.0).tangential.is_some());
        assert_eq!(ChainSums::new(0.9, 900, 1.0).tangential, None);
        assert_eq!(ChainSums::new(1e-200, 1_000_000, 1e-2).tangential, Some(1.0));
    }
}
