//! Where the rods, mass points and springs of a chain are while it is stretched.
//!
//! The units hang together tip to tip along their tangential diagonals, in a row that leaves the contact in one direction
//! along the surface. Every unit is drawn as the model has it: rods of length `a q^(i-1)`, the angle `theta + d_theta`,
//! and between its two tips a difference in height of `dl_i`. All units have the same shape, so the row is a straight
//! line, and it is inclined such that its height above the contact after i units is `dl_1 + .. + dl_i`: the tip at the
//! contact is moved by the whole depth, the far end not at all.
//!
//! The surface itself is drawn with a constant pitch instead (a shrinking one would make every dent this cone), so it
//! lies below the row; the difference is the model's, not a fault of the drawing.

use glam::DVec3;
use rhombus_chain::Chain;

/// Units beyond which the movement is less than this share of the depth are not drawn.
const VISIBLE_SHARE: f64 = 0.02;
/// A row is never longer than this many units.
const MAX_UNITS: u32 = 48;

/// One chain in its present shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ChainShape {
    /// `a`: rods of the first unit.
    pub(crate) rod_length_m: f64,
    /// `theta + d_theta`: between a rod and the tangential diagonal, 0 to pi/2.
    pub(crate) angle_rad: f64,
    /// `dl_1`: normal stretch of the first unit, negative when pressed.
    pub(crate) dl_1_m: f64,
    /// `q`.
    pub(crate) ratio: f64,
    /// `n`.
    pub(crate) units: u32,
}

impl ChainShape {
    /// The chain at a depth, positive into the body.
    pub(crate) fn at_depth(chain: &Chain, depth_m: f64) -> ChainShape {
        let (rest, pressed) = (chain.parameters(), chain.response(-depth_m));
        ChainShape {
            rod_length_m: rest.rod_length_m,
            angle_rad: rest.angle_rad + pressed.d_theta_rad,
            dl_1_m: pressed.dl_1_m,
            ratio: rest.ratio,
            units: rest.units,
        }
    }
}

/// Where a row of units starts and where it goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RowStart {
    /// The displaced contact point.
    pub(crate) contact_m: DVec3,
    /// Unit vector out of the body.
    pub(crate) normal: DVec3,
    /// Unit vector along the surface, perpendicular to `normal`.
    pub(crate) direction: DVec3,
}

/// The mass points of one unit. Rods join each tip with each side; the springs are the two diagonals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rhombus {
    /// Tip towards the contact, and the one away from it: ends of the tangential diagonal.
    pub(crate) tips: [DVec3; 2],
    /// Ends of the normal diagonal: into the body, out of it.
    pub(crate) sides: [DVec3; 2],
}

/// The units that move visibly, from the contact on.
pub(crate) fn row(chain: &ChainShape, start: &RowStart) -> impl Iterator<Item = Rhombus> {
    let (sine, cosine) = (libm::sin(chain.angle_rad), libm::cos(chain.angle_rad));
    // Height gained for each length of a tangential diagonal. A unit pulled nearly straight is higher than it is long,
    // and then no inclination is enough: the row points straight down and its far end leaves the rest surface.
    let slope = (-chain.dl_1_m / (2.0 * chain.rod_length_m * cosine)).clamp(-1.0, 1.0);
    let level = ((1.0 - slope) * (1.0 + slope)).sqrt();
    let along = start.direction * level + start.normal * slope;
    let across = start.normal * level - start.direction * slope;

    let mut near = start.contact_m;
    let mut rod_m = chain.rod_length_m;
    (0..visible_units(chain.ratio, chain.units)).map(move |_| {
        let middle = near + along * (rod_m * cosine);
        let far = near + along * (2.0 * rod_m * cosine);
        let side = across * (rod_m * sine);
        let rhombus = Rhombus { tips: [near, far], sides: [middle - side, middle + side] };
        near = far;
        rod_m *= chain.ratio;
        rhombus
    })
}

/// Number of units whose inner tip moves by [`VISIBLE_SHARE`] of the depth or more: `(q^i - q^n) / (1 - q^n)` of it
/// after i units. It does not depend on the depth, so nothing pops up while pressing.
fn visible_units(ratio: f64, units: u32) -> u32 {
    let end = libm::pow(ratio, f64::from(units));
    let longest = units.min(MAX_UNITS);
    (1..longest)
        .find(|i| libm::pow(ratio, f64::from(*i)) - end < VISIBLE_SHARE * (1.0 - end))
        .unwrap_or(longest)
}

/// A spring as a zigzag: the corners from one end to the other, both included, in the plane of `aside`.
pub(crate) fn spring(from: DVec3, to: DVec3, aside: DVec3, turns: u32) -> impl Iterator<Item = DVec3> {
    /// Straight piece at each end, and width to each side, as shares of the length.
    const STRAIGHT: f64 = 0.15;
    const WIDTH: f64 = 0.06;
    let width_m = WIDTH * from.distance(to);
    let corners = 2 * turns;
    let zigzag = (0..corners).map(move |corner| {
        let along = STRAIGHT + (1.0 - 2.0 * STRAIGHT) * (f64::from(corner) + 0.5) / f64::from(corners);
        let side = if corner % 2 == 0 { width_m } else { -width_m };
        from.lerp(to, along) + aside * side
    });
    [from, from.lerp(to, STRAIGHT)].into_iter().chain(zigzag).chain([from.lerp(to, 1.0 - STRAIGHT), to])
}

/// Directions in which the rows of a contact leave it: a fan around the normal that turns with the contact as little
/// as possible, so that the picture does not spin while the probe slides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fan {
    first: DVec3,
}

impl Fan {
    /// Starts towards x, or y where the normal is x.
    pub(crate) fn new() -> Fan {
        Fan { first: DVec3::X }
    }

    /// Follow the contact: `count` unit vectors perpendicular to the unit vector `normal`, equally spaced.
    pub(crate) fn directions(&mut self, normal: DVec3, count: usize) -> Vec<DVec3> {
        let first = [self.first, DVec3::X, DVec3::Y]
            .into_iter()
            .map(|reference| reference.reject_from_normalized(normal))
            .find(|tangent| tangent.length_squared() > 0.01)
            .unwrap_or(DVec3::Z)
            .normalize_or_zero();
        self.first = first;
        let second = normal.cross(first);
        (0..count)
            .map(|i| {
                let angle_rad = std::f64::consts::TAU * i as f64 / count as f64;
                first * libm::cos(angle_rad) + second * libm::sin(angle_rad)
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use rhombus_chain::{ChainParameters, Formulation};

    /// A chain stretched by a share of what its geometry allows (negative: pressed), and its rest angle.
    fn stretched(rod_length_m: f64, theta: f64, share: f64, ratio: f64, units: u32) -> ChainShape {
        let sine = libm::sin(theta);
        let dl_1_m = 2.0 * rod_length_m * share * if share < 0.0 { sine } else { 1.0 - sine };
        let angle_rad = libm::asin(sine + dl_1_m / (2.0 * rod_length_m));
        ChainShape { rod_length_m, angle_rad, dl_1_m, ratio, units }
    }

    fn start() -> RowStart {
        let normal = DVec3::new(0.6, 0.0, 0.8);
        RowStart { contact_m: DVec3::new(0.05, -0.02, 0.11), normal, direction: DVec3::new(0.8, 0.0, -0.6) }
    }

    proptest! {
        #[test]
        fn every_rod_keeps_its_length(
            rod in 1e-3..0.1f64, theta in 0.05..1.5f64, share in -0.98..0.98f64, ratio in 0.3..0.999f64, units in 1..200u32,
        ) {
            let mut length = rod;
            for rhombus in row(&stretched(rod, theta, share, ratio, units), &start()) {
                for tip in rhombus.tips {
                    for side in rhombus.sides {
                        prop_assert!((tip.distance(side) - length).abs() < 1e-12, "{} for {length}", tip.distance(side));
                    }
                }
                length *= ratio;
            }
        }

        #[test]
        fn every_tip_is_as_high_as_the_model_has_its_unit(
            rod in 1e-3..0.1f64, theta in 0.05..1.5f64, share in -0.98..0.5f64, ratio in 0.3..0.999f64, units in 1..200u32,
        ) {
            let chain = stretched(rod, theta, share, ratio, units);
            prop_assume!(chain.dl_1_m.abs() <= 2.0 * rod * libm::cos(chain.angle_rad));
            let mut height = 0.0;
            let mut dl = chain.dl_1_m;
            for rhombus in row(&chain, &start()) {
                height -= dl;
                dl *= ratio;
                let found = (rhombus.tips[1] - start().contact_m).dot(start().normal);
                prop_assert!((found - height).abs() < 1e-12, "{found} for {height}");
            }
        }

        #[test]
        fn rows_leave_the_contact_along_the_surface(x in -1.0..1.0f64, y in -1.0..1.0f64, z in -1.0..1.0f64, count in 1..9usize) {
            let normal = DVec3::new(x, y, z).normalize_or(DVec3::X);
            for direction in Fan::new().directions(normal, count) {
                prop_assert!(direction.dot(normal).abs() < 1e-12);
                prop_assert!((direction.length() - 1.0).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn units_are_stretched_as_the_model_stretches_them_and_add_up_to_the_depth() {
        let parameters = ChainParameters {
            rod_length_m: 0.01,
            angle_rad: std::f64::consts::FRAC_PI_6,
            ratio: 0.8,
            units: 12,
            normal_stiffness_n_per_m: 500.0,
            tangential_stiffness_n_per_m: 100.0,
            tangential_growth: 10.0,
            weight: 1.0,
            pitch_m: 0.02,
        };
        let chain = Chain::new(0, Formulation::Energy, &parameters).unwrap();
        let shape = ChainShape::at_depth(&chain, 0.006);
        // Golden values of the model: dl_1 and d_theta.
        assert!((shape.dl_1_m - -0.0012885483697159).abs() < 1e-15);
        assert!((shape.angle_rad - (parameters.angle_rad - 0.0729245035346008)).abs() < 1e-12);
        let sum: f64 = (0..12).map(|i| shape.dl_1_m * 0.8_f64.powi(i)).sum();
        assert!((sum + 0.006).abs() < 1e-15);
    }

    #[test]
    fn the_whole_row_lifts_its_end_back_to_the_rest_surface() {
        // Six units of 0.5: the last one that is left out moves less than 2 % of the depth.
        let chain = stretched(0.01, 0.5, -0.6, 0.5, 40);
        let rhombi: Vec<Rhombus> = row(&chain, &start()).collect();
        let depth = -chain.dl_1_m / (1.0 - 0.5);
        assert_eq!(rhombi.len(), 6);
        assert_eq!(rhombi[0].tips[0], start().contact_m);
        let risen = (rhombi[5].tips[1] - start().contact_m).dot(start().normal);
        assert!(risen > 0.98 * depth && risen < depth, "{risen} of {depth}");
    }

    #[test]
    fn units_share_their_mass_points() {
        let rhombi: Vec<Rhombus> = row(&stretched(0.01, 0.8, -0.3, 0.9, 30), &start()).collect();
        assert!(rhombi.windows(2).all(|pair| pair[0].tips[1] == pair[1].tips[0]));
    }

    #[test]
    fn a_long_chain_is_cut_and_a_single_unit_is_always_drawn() {
        assert_eq!(visible_units(0.999_999, 1_000_000), MAX_UNITS);
        assert_eq!(visible_units(0.01, 5), 1);
        assert_eq!(visible_units(0.9, 1), 1);
    }

    #[test]
    fn a_unit_pulled_straight_gives_no_nan() {
        let mut chain = stretched(0.01, 1.2, 1.0, 0.9, 30);
        chain.angle_rad = std::f64::consts::FRAC_PI_2;
        assert!(
            row(&chain, &start()).all(|rhombus| rhombus.tips[1].is_finite() && rhombus.sides[0].is_finite())
        );
    }

    #[test]
    fn a_spring_starts_and_ends_at_its_mass_points() {
        let corners: Vec<DVec3> = spring(DVec3::ZERO, DVec3::X, DVec3::Y, 3).collect();
        assert_eq!((corners[0], corners[corners.len() - 1]), (DVec3::ZERO, DVec3::X));
        assert_eq!(corners.len(), 10);
        assert!(corners.windows(2).all(|pair| pair[1].x > pair[0].x));
    }

    #[test]
    fn the_fan_does_not_spin_while_the_contact_slides() {
        let mut fan = Fan::new();
        let mut last: Option<DVec3> = None;
        for step in 0..=200 {
            let angle = f64::from(step) * 0.02;
            let normal = DVec3::new(libm::sin(angle), 0.1, libm::cos(angle)).normalize_or_zero();
            let first = fan.directions(normal, 3)[0];
            if let Some(last) = last {
                assert!(first.distance(last) < 0.03, "step {step}");
            }
            last = Some(first);
        }
    }
}
