//! One rhombus unit: four rods, two diagonals. Equations (4) to (9) of the paper.
//!
//! A unit of any size is described by its *stretch* `e = dl / (2 a) = sin x - sin theta`, which all units of a chain share.
//! With the sine known, everything the force needs is algebra: no transcendental function is called, and nothing cancels
//! for a small stretch or for an angle close to either end of (0, pi/2).

/// A unit at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rhombus {
    pub(crate) sine: f64,
    pub(crate) cosine: f64,
    pub(crate) tangent: f64,
    /// `1 - sin theta`, the largest stretch geometry allows, with all its digits near pi/2.
    pub(crate) largest_stretch: f64,
}

/// A stretched unit, `x = theta + d_theta`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StretchedRhombus {
    pub(crate) stretch: f64,
    /// `sin x` (5).
    pub(crate) sine: f64,
    /// `cos x` (5).
    pub(crate) cosine: f64,
    /// `t = tan(theta + d_theta/2)`, so that `dw = -t dl` (7).
    pub(crate) mean_tangent: f64,
    /// `cos x + cos theta`.
    pub(crate) cosines: f64,
}

impl Rhombus {
    /// `angle_rad` in (0, pi/2).
    pub(crate) fn new(angle_rad: f64) -> Self {
        let sine = libm::sin(angle_rad);
        let cosine = libm::cos(angle_rad);
        Self { sine, cosine, tangent: sine / cosine, largest_stretch: cosine * cosine / (1.0 + sine) }
    }

    /// The unit at a stretch inside `-sin theta .. 1 - sin theta`.
    ///
    /// ```text
    /// cos x = sqrt((1 - sin x)(1 + sin x)),    tan((theta + x)/2) = (sin theta + sin x) / (cos theta + cos x)
    /// ```
    #[inline]
    pub(crate) fn stretched(&self, stretch: f64) -> StretchedRhombus {
        let sine = self.sine + stretch;
        let cosine = ((self.largest_stretch - stretch) * (1.0 + sine)).sqrt();
        let cosines = self.cosine + cosine;
        StretchedRhombus { stretch, sine, cosine, mean_tangent: (self.sine + sine) / cosines, cosines }
    }

    /// The stretch at which `x` has this cosine and this `1 - cos x`; two numbers, so that the
    /// difference of the sines keeps its digits at both ends of `[0, pi/2]`.
    pub(crate) fn stretch_at(&self, cosine: f64, versine: f64) -> f64 {
        const STEEP: f64 = 0.7;
        let sine = (versine * (1.0 + cosine)).sqrt();
        if sine < STEEP { sine - self.sine } else { self.largest_stretch - cosine * cosine / (1.0 + sine) }
    }
}

impl StretchedRhombus {
    /// `tan x`.
    #[inline]
    pub(crate) fn tangent(&self) -> f64 {
        self.sine / self.cosine
    }

    /// `tan(d_theta/2) = (sin x - sin theta) / (cos x + cos theta)`.
    #[inline]
    fn half_turn_tangent(&self) -> f64 {
        self.stretch / self.cosines
    }

    /// `d_theta = asin(sin theta + e) - theta`.
    #[inline]
    pub(crate) fn d_theta(&self) -> f64 {
        2.0 * libm::atan(self.half_turn_tangent())
    }

    /// `sin(d_theta)`.
    #[inline]
    pub(crate) fn turn_sine(&self) -> f64 {
        let half = self.half_turn_tangent();
        2.0 * half / (1.0 + half * half)
    }

    /// `sin(d_theta) - d_theta`, by its series where the difference would lose digits.
    ///
    /// With `h = tan(d_theta/2)`: `2 h / (1 + h^2) - 2 atan(h) = -2 h (2/3 h^2 - 4/5 h^4 + 6/7 h^6 - ..)`.
    #[inline]
    pub(crate) fn sine_excess(&self) -> f64 {
        /// `h^2` up to which the terms below reach the last digit: a turn of 0.2 rad.
        const SERIES_UP_TO: f64 = 0.01;
        const TERMS: [f64; 8] =
            [16.0 / 17.0, 14.0 / 15.0, 12.0 / 13.0, 10.0 / 11.0, 8.0 / 9.0, 6.0 / 7.0, 4.0 / 5.0, 2.0 / 3.0];
        let half = self.half_turn_tangent();
        let square = half * half;
        if square > SERIES_UP_TO {
            return self.turn_sine() - self.d_theta();
        }
        let series = TERMS.into_iter().fold(0.0, |series, term| term - square * series);
        -2.0 * half * square * series
    }
}
