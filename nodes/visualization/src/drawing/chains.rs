//! The rhombi of all chains at one contact: rods, springs and mass points.

use glam::DVec3;

use super::{Drawing, Key, Shape, Thing};
use crate::colour::Colour;
use crate::rhombi::{ChainShape, Rhombus, RowStart, row, spring};

/// A contact is surrounded by at least this many rows of units, and by no more than the other number.
const FEWEST_ROWS: usize = 4;
const MOST_ROWS: usize = 12;

/// Rods of the parallel chains, one after the other.
const RODS: [Colour; 4] = [
    Colour::rgb(0.20, 0.22, 0.26),
    Colour::rgb(0.10, 0.33, 0.50),
    Colour::rgb(0.34, 0.22, 0.48),
    Colour::rgb(0.12, 0.40, 0.32),
];
const MASS_POINTS: Colour = Colour::rgb(0.93, 0.93, 0.90);
const NORMAL_SPRING: Colour = Colour::rgb(0.20, 0.62, 0.95);
const TANGENTIAL_SPRING: Colour = Colour::rgb(0.35, 0.80, 0.40);

/// Widths as shares of a rod.
const ROD_WIDTH: f64 = 0.07;
const SPRING_WIDTH: f64 = 0.03;
const MASS_POINT_DIAMETER: f64 = 0.2;

/// A marker has one width, and the units of a chain shrink: units are drawn in this many classes, each half as wide as
/// the one before.
const SIZES: usize = 4;
/// Zigzags of a spring of each size: those of small units would be a smear, and most of the message.
const SPRING_TURNS: [u32; SIZES] = [3, 3, 1, 0];
/// Markers of one size: rods, springs, mass points.
const PARTS: usize = 3;

/// Number of rows around a contact of `chains` parallel chains: every chain as often as every other, unless there are
/// too many to draw.
pub(crate) fn rows(chains: usize) -> usize {
    match chains {
        0 => 0,
        1..=MOST_ROWS => chains * FEWEST_ROWS.div_ceil(chains),
        _ => MOST_ROWS,
    }
}

/// The chains at a contact: rods, springs and mass points of each size; nothing without a chain. `directions` are unit
/// vectors along the surface, one for each row; neighbouring rows show different chains.
pub(crate) fn chains(
    device: i32,
    frame_id: &str,
    shapes: &[ChainShape],
    contact_m: DVec3,
    normal: DVec3,
    directions: &[DVec3],
) -> Vec<Drawing> {
    let count = directions.len();
    if count == 0 || shapes.is_empty() {
        return Vec::new();
    }
    let longest_m = shapes.iter().map(|shape| shape.rod_length_m).fold(0.0, f64::max);
    let mut sizes: [Units; SIZES] = std::array::from_fn(|_| Units::default());
    sizes[0].mass_points_m.push(contact_m);
    for (i, direction) in directions.iter().copied().enumerate() {
        let chain = if count >= shapes.len() { i % shapes.len() } else { i * shapes.len() / count };
        let mut rod_m = shapes[chain].rod_length_m;
        for rhombus in row(&shapes[chain], &RowStart { contact_m, normal, direction }) {
            let size = size_of(rod_m / longest_m);
            let aside = normal.cross(direction);
            sizes[size].add(&rhombus, RODS[chain % RODS.len()], aside, SPRING_TURNS[size]);
            rod_m *= shapes[chain].ratio;
        }
    }
    let mut drawings = Vec::new();
    for (size, units) in sizes.into_iter().enumerate() {
        let rod_m = longest_m / f64::from(1 << size);
        let mut push = |part: usize, shape, points_m: Vec<DVec3>, colours| {
            if !points_m.is_empty() {
                // The numbers are small constants times the number of a device.
                let id = device * (SIZES * PARTS) as i32 + (PARTS * size + part) as i32;
                let key = Key { thing: Thing::Chains, id };
                let frame_id = frame_id.to_owned();
                drawings.push(Drawing { key, frame_id, shape, points_m, colour: MASS_POINTS, colours });
            }
        };
        push(0, Shape::Lines { width_m: ROD_WIDTH * rod_m }, units.rods.ends_m, units.rods.colours);
        push(1, Shape::Lines { width_m: SPRING_WIDTH * rod_m }, units.springs.ends_m, units.springs.colours);
        push(2, Shape::Spheres { diameter_m: MASS_POINT_DIAMETER * rod_m }, units.mass_points_m, Vec::new());
    }
    drawings
}

/// The class of a rod that is this share of the longest: 0 above a half, 1 above a quarter, and so on.
fn size_of(share: f64) -> usize {
    let halvings = (0..SIZES).take_while(|halvings| share <= 0.5 / f64::from(1 << halvings)).count();
    halvings.min(SIZES - 1)
}

/// Units of one size.
#[derive(Default)]
struct Units {
    rods: Strokes,
    springs: Strokes,
    mass_points_m: Vec<DVec3>,
}

impl Units {
    fn add(&mut self, unit: &Rhombus, colour: Colour, aside: DVec3, turns: u32) {
        let Rhombus { tips, sides } = *unit;
        self.rods.add([tips[0], sides[0], tips[1], sides[1], tips[0]], colour);
        self.springs.add(spring(sides[0], sides[1], aside, turns), NORMAL_SPRING);
        self.springs.add(spring(tips[0], tips[1], aside, turns), TANGENTIAL_SPRING);
        self.mass_points_m.extend([tips[1], sides[0], sides[1]]);
    }
}

/// Lines with a colour each.
#[derive(Default)]
struct Strokes {
    ends_m: Vec<DVec3>,
    colours: Vec<Colour>,
}

impl Strokes {
    fn add(&mut self, corners: impl IntoIterator<Item = DVec3>, colour: Colour) {
        let mut corners = corners.into_iter();
        let Some(mut from) = corners.next() else { return };
        for to in corners {
            self.ends_m.extend([from, to]);
            self.colours.extend([colour; 2]);
            from = to;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::is_drawable;
    use crate::rhombi::Fan;

    fn shape(rod_length_m: f64) -> ChainShape {
        ChainShape { rod_length_m, angle_rad: 0.45, dl_1_m: -0.001, ratio: 0.5, units: 3 }
    }

    fn draw(shapes: &[ChainShape]) -> Vec<Drawing> {
        let directions = Fan::new().directions(DVec3::Z, rows(shapes.len()));
        chains(2, "base", shapes, DVec3::new(0.0, 0.0, -0.002), DVec3::Z, &directions)
    }

    /// Number of points of all markers of a part.
    fn points(drawings: &[Drawing], part: i32) -> usize {
        let of_part = drawings.iter().filter(|drawing| drawing.key.id % PARTS as i32 == part);
        of_part.map(|drawing| drawing.points_m.len()).sum()
    }

    #[test]
    fn every_unit_has_four_rods_two_springs_and_shares_its_mass_points() {
        let drawings = draw(&[shape(0.01)]);
        let units = 4 * 3;
        assert_eq!(points(&drawings, 0), 2 * 4 * units);
        // Zigzags of nine pieces in the first two units, of five in the third.
        assert_eq!(points(&drawings, 1), 4 * 2 * 2 * (9 + 9 + 5));
        assert_eq!(points(&drawings, 2), 1 + 3 * units);
        for drawing in drawings {
            assert!(drawing.points_m.iter().all(|point| is_drawable(*point)));
            assert!(drawing.colours.is_empty() || drawing.colours.len() == drawing.points_m.len());
        }
    }

    #[test]
    fn smaller_units_are_drawn_with_thinner_lines() {
        // Rods of 1, 1/2 and 1/4: a marker has one width.
        let drawings = draw(&[shape(0.01)]);
        let widths: Vec<(i32, f64)> = drawings
            .iter()
            .filter_map(|drawing| match drawing.shape {
                Shape::Lines { width_m } => Some((drawing.key.id - 2 * 12, width_m)),
                _ => None,
            })
            .collect();
        let (rod, spring) = (7e-4, 3e-4);
        let expected =
            [(0, rod), (1, spring), (3, rod / 2.0), (4, spring / 2.0), (6, rod / 4.0), (7, spring / 4.0)];
        assert_eq!(widths.len(), expected.len(), "{widths:?}");
        for ((id, width), (expected_id, expected_width)) in widths.into_iter().zip(expected) {
            assert_eq!(id, expected_id);
            assert!((width - expected_width).abs() < 1e-15);
        }
        assert_eq!([1.0, 0.51, 0.5, 0.26, 0.25, 0.125, 1e-9].map(size_of), [0, 0, 1, 1, 2, 3, 3]);
        assert_eq!(size_of(f64::NAN), 0);
    }

    #[test]
    fn every_chain_is_drawn_and_the_rows_stay_few() {
        assert_eq!([1, 2, 3, 4, 5, 12].map(rows), [4, 4, 6, 4, 5, 12]);
        assert_eq!([0, 13, 1000].map(rows), [0, 12, 12]);
        let shapes: Vec<ChainShape> = (1..=3).map(|i| shape(0.01 * f64::from(i))).collect();
        let drawings = draw(&shapes);
        let rods = drawings
            .iter()
            .filter(|drawing| drawing.key.id % 3 == 0)
            .flat_map(|rods| rods.points_m.chunks(2));
        let lengths: Vec<f64> = rods.map(|rod| rod[0].distance(rod[1])).collect();
        for shape in &shapes {
            assert!(lengths.iter().any(|length| (length - shape.rod_length_m).abs() < 1e-12));
        }
        let many: Vec<ChainShape> = (0..100).map(|_| shape(0.01)).collect();
        assert_eq!(points(&draw(&many), 0), 2 * 4 * 3 * MOST_ROWS);
    }

    #[test]
    fn rods_at_the_contact_start_at_the_pressed_point() {
        let drawings = draw(&[shape(0.01)]);
        let pressed = DVec3::new(0.0, 0.0, -0.002);
        assert_eq!((drawings[0].points_m[0], drawings[2].points_m[0]), (pressed, pressed));
    }
}
