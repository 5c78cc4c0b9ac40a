//! A liver-like organ: a large right lobe, a thin left tip, a domed upper side, a flat underside, a sharp front edge.

use glam::DVec3;

use super::round::RoundBody;

/// About 0.20 m from the right side (-x) to the left tip (+x), front +y, up +z.
///
/// A point `(x, y, z)` of the unit ball goes to
///
/// ```text
///     X = L x
///     Y = W(x) y + C x^2                                 narrower to the left, tip curving forward
///     Z = H(x, y) (z + A z^2) + D(x, y)                  domed above (1 + A), flat below (1 - A), thin at the front
/// ```
///
/// with `L, W, H > 0` and `A < 1/2`, so that every line is invertible in its own variable.
pub(super) struct Liver;

const HALF_LENGTH_M: f64 = 0.100;
const DOME: f64 = 0.36;
const FORWARD_M: f64 = 0.012;

impl Liver {
    /// Half depth from back to front, m.
    fn half_width(x: f64) -> f64 {
        0.072 - 0.028 * to_the_left(x)
    }

    /// Height scale, m: falls to the left and to the front, with the groove between the lobes.
    fn height(x: f64, y: f64) -> f64 {
        let lobes = 0.056 - 0.037 * to_the_left(x);
        let front = 1.0 - 0.22 * y;
        let groove = 1.0 - 0.14 * libm::exp(-square((x - 0.30) / 0.14));
        lobes * front * groove
    }

    /// How far the middle surface is lifted, m: the left lobe lies a little higher, the right lobe hangs down behind.
    fn lift(x: f64, y: f64) -> f64 {
        0.010 * to_the_left(x) + 0.006 * y - 0.004 * x * x
    }
}

impl RoundBody for Liver {
    fn body_from_ball(&self, p: DVec3) -> DVec3 {
        let domed = p.z * (1.0 + DOME * p.z);
        DVec3::new(
            HALF_LENGTH_M * p.x,
            Liver::half_width(p.x) * p.y + FORWARD_M * p.x * p.x,
            Liver::height(p.x, p.y) * domed + Liver::lift(p.x, p.y),
        )
    }

    fn ball_from_body(&self, q: DVec3) -> DVec3 {
        let x = (q.x / HALF_LENGTH_M).clamp(-1.0, 1.0);
        let y = ((q.y - FORWARD_M * x * x) / Liver::half_width(x)).clamp(-1.0, 1.0);
        let domed = (q.z - Liver::lift(x, y)) / Liver::height(x, y);
        // z + A z^2 = domed, the root that is 0 at 0; beyond the ball the square root would leave the reals.
        let z = (-1.0 + (1.0 + 4.0 * DOME * domed).max(0.0).sqrt()) / (2.0 * DOME);
        DVec3::new(x, y, z)
    }
}

/// 0 on the right, 1 on the left, smooth between.
fn to_the_left(x: f64) -> f64 {
    1.0 / (1.0 + libm::exp(-(x - 0.15) / 0.22))
}

fn square(x: f64) -> f64 {
    x * x
}
