//! Arithmetic with twice the digits of f64, used once per chain at construction: one rounding in `q^2 e^(1/beta)`
//! becomes a million roundings in its power `n`, and this keeps them all below the last digit of the result.
//!
//! Dekker's algorithms (Numerische Mathematik 18, 1971) without fused multiply-add, so that every CPU gives the
//! same bits. A product with a factor above 1e300 is NaN.

/// The unevaluated sum `high + low`, with `low` below half a last digit of `high`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    pub(crate) const ONE: Self = Self { high: 1.0, low: 0.0 };

    /// `a * b` without rounding.
    pub(crate) fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        let (a_high, a_low) = split(a);
        let (b_high, b_low) = split(b);
        let low = ((a_high * b_high - high) + a_high * b_low + a_low * b_high) + a_low * b_low;
        Self { high, low }
    }

    /// `1 / a`.
    pub(crate) fn reciprocal(a: f64) -> Self {
        Self::ONE.divided_by(a)
    }

    /// Rounded to f64.
    pub(crate) fn value(self) -> f64 {
        self.high + self.low
    }

    pub(crate) fn plus(self, other: Self) -> Self {
        let high = self.high + other.high;
        let part = high - self.high;
        let error = (self.high - (high - part)) + (other.high - part);
        Self::renormalised(high, error + self.low + other.low)
    }

    pub(crate) fn times(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        let cross = self.high * other.low + self.low * other.high;
        Self::renormalised(product.high, product.low + cross)
    }

    fn divided_by(self, divisor: f64) -> Self {
        let quotient = self.high / divisor;
        let covered = Self::product(quotient, divisor);
        let rest = ((self.high - covered.high) - covered.low) + self.low;
        Self::renormalised(quotient, rest / divisor)
    }

    /// `e^self`, for arguments of magnitude up to 600.
    ///
    /// The argument is divided by 2^10, the Taylor series of the rest is exact to 1e-32 after 24 terms,
    /// and ten squarings undo the division.
    pub(crate) fn exp(self) -> Self {
        const HALVINGS: i32 = 10;
        let scale = libm::ldexp(1.0, -HALVINGS);
        let rest = Self { high: self.high * scale, low: self.low * scale };
        let mut power = Self::ONE;
        for term in (1..=24_u8).rev() {
            power = Self::ONE.plus(rest.times(power).divided_by(f64::from(term)));
        }
        for _ in 0..HALVINGS {
            power = power.times(power);
        }
        power
    }

    /// Moves what fits from `low` into `high`; needs `|high| >= |low|`.
    fn renormalised(high: f64, low: f64) -> Self {
        let sum = high + low;
        Self { high: sum, low: low - (sum - high) }
    }
}

/// Two halves of 26 digits each: their products are exact.
fn split(a: f64) -> (f64, f64) {
    const TWO_TO_27_PLUS_1: f64 = 134_217_729.0;
    let shifted = TWO_TO_27_PLUS_1 * a;
    let high = shifted - (shifted - a);
    (high, a - high)
}
