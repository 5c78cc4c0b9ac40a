//! Points and weights on triangles: far from the source, near it, and with the source in a corner.

use glam::DVec3;

/// A point of the unit triangle: weights of the corners, and its share of the area.
pub(super) type Point = ([f64; 3], f64);

/// A triangle is divided while the source is nearer to its centroid than this many of its longest edges.
const NEAR: f64 = 1.5;
/// From this many longest edges the three-point rule does.
const FAR: f64 = 5.0;
/// Divisions of a triangle at most: 4⁶ parts.
const DEPTH: u32 = 6;

/// Exact for quadratic functions.
const THREE: [Point; 3] = {
    let (a, b) = (2.0 / 3.0, 1.0 / 6.0);
    [([a, b, b], 1.0 / 3.0), ([b, a, b], 1.0 / 3.0), ([b, b, a], 1.0 / 3.0)]
};

/// Radon's rule, exact to degree five.
const SEVEN: [Point; 7] = {
    let (a, b, v) = (0.059_715_871_789_769_82, 0.470_142_064_105_115_1, 0.132_394_152_788_506_2);
    let (c, d, w) = (0.797_426_985_353_087_3, 0.101_286_507_323_456_3, 0.125_939_180_544_827_1);
    [
        ([1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0], 0.225),
        ([a, b, b], v),
        ([b, a, b], v),
        ([b, b, a], v),
        ([c, d, d], w),
        ([d, c, d], w),
        ([d, d, c], w),
    ]
};

/// Gauss' rule of six points on 0..1: place and weight.
const GAUSS: [(f64, f64); 6] = [
    (0.033_765_242_898_423_99, 0.085_662_246_189_585_17),
    (0.169_395_306_766_867_74, 0.180_380_786_524_069_3),
    (0.380_690_406_958_401_5, 0.233_956_967_286_345_52),
    (0.619_309_593_041_598_5, 0.233_956_967_286_345_52),
    (0.830_604_693_233_132_3, 0.180_380_786_524_069_3),
    (0.966_234_757_101_576, 0.085_662_246_189_585_17),
];

/// Calls `each` with points for a source off the triangle, dense where the source is near.
pub(super) fn off(corners: [DVec3; 3], source: DVec3, each: &mut impl FnMut(Point)) {
    let whole = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    divide(corners, source, whole, DEPTH, each);
}

fn divide(corners: [DVec3; 3], source: DVec3, part: [[f64; 3]; 3], depth: u32, each: &mut impl FnMut(Point)) {
    let at = |weights: [f64; 3]| corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
    let [a, b, c] = part.map(at);
    let size = a.distance(b).max(b.distance(c)).max(c.distance(a));
    let distance = source.distance((a + b + c) / 3.0);
    if distance < NEAR * size && depth > 0 {
        let middle = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| 0.5 * (a[k] + b[k]));
        let [a, b, c] = part;
        let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
        for quarter in [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]] {
            divide(corners, source, quarter, depth - 1, each);
        }
        return;
    }
    let share = 0.25f64.powi((DEPTH - depth) as i32);
    let rule: &[Point] = if distance < FAR * size { &SEVEN } else { &THREE };
    for &(weights, weight) in rule {
        each((
            [0, 1, 2].map(|k| (0..3).map(|corner| part[corner][k] * weights[corner]).sum()),
            weight * share,
        ));
    }
}

/// Calls `each` with points for a source in corner `corner`: Duffy's transformation, whose shares vanish there as the distance.
pub(super) fn in_corner(corner: usize, each: &mut impl FnMut(Point)) {
    for (s, weight_s) in GAUSS {
        for (t, weight_t) in GAUSS {
            let mut weights = [0.0; 3];
            weights[corner] = 1.0 - s;
            weights[(corner + 1) % 3] = s * (1.0 - t);
            weights[(corner + 2) % 3] = s * t;
            each((weights, 2.0 * s * weight_s * weight_t));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{in_corner, off};
    use glam::DVec3;

    #[test]
    fn shares_of_every_rule_add_up_to_the_triangle() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::new(0.3, 0.8, 0.0)];
        for source in [DVec3::new(0.4, 0.2, 0.01), DVec3::new(1.0, 1.0, 2.0), DVec3::splat(9.0)] {
            let mut sums = [0.0; 4];
            off(corners, source, &mut |(weights, share)| {
                sums[3] += share;
                (0..3).for_each(|k| sums[k] += weights[k] * share);
            });
            assert!((sums[3] - 1.0).abs() < 1e-12);
            assert!((0..3).all(|k| (sums[k] - 1.0 / 3.0).abs() < 1e-12));
        }
    }

    #[test]
    fn one_over_the_distance_to_a_corner_is_integrated() {
        // Over the right triangle with legs 1 and the source at the right angle: sqrt(2) ln(1 + sqrt(2)).
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let mut sum = 0.0;
        in_corner(0, &mut |(weights, share)| {
            let at = corners[1] * weights[1] + corners[2] * weights[2];
            sum += 0.5 * share / at.length();
        });
        let exact = 2f64.sqrt() * (1.0 + 2f64.sqrt()).ln();
        assert!((sum - exact).abs() < 2e-5, "{sum} {exact}");
    }
}
