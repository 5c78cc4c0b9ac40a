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

/// Widths as shares of the longest rod.
const ROD_WIDTH: f64 = 0.07;
const SPRING_WIDTH: f64 = 0.03;
const MASS_POINT_DIAMETER: f64 = 0.2;
const SPRING_TURNS: u32 = 3;

/// Number of rows around a contact of `chains` parallel chains: every chain as often as every other, unless there are
/// too many to draw.
pub(crate) fn rows(chains: usize) -> usize {
    match chains {
        0 => 0,
        1..=MOST_ROWS => chains * FEWEST_ROWS.div_ceil(chains),
        _ => MOST_ROWS,
    }
}

/// The chains at a contact: rods, springs, mass points; nothing without a chain. `directions` are unit vectors along the surface, one for each
/// row; neighbouring rows show different chains.
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
    let mut rods = Strokes::default();
    let mut springs = Strokes::default();
    let mut mass_points = vec![contact_m];
    for (i, direction) in directions.iter().copied().enumerate() {
        let chain = if count >= shapes.len() { i % shapes.len() } else { i * shapes.len() / count };
        let aside = normal.cross(direction);
        for Rhombus { tips, sides } in row(&shapes[chain], &RowStart { contact_m, normal, direction }) {
            let colour = RODS[chain % RODS.len()];
            rods.add([tips[0], sides[0], tips[1], sides[1], tips[0]], colour);
            springs.add(spring(sides[0], sides[1], aside, SPRING_TURNS), NORMAL_SPRING);
            springs.add(spring(tips[0], tips[1], aside, SPRING_TURNS), TANGENTIAL_SPRING);
            mass_points.extend([tips[1], sides[0], sides[1]]);
        }
    }
    let rod_m = shapes.iter().map(|shape| shape.rod_length_m).fold(0.0, f64::max);
    let drawing = |part, shape, points_m, colours| Drawing {
        key: Key { thing: Thing::Chains, id: 3 * device + part },
        frame_id: frame_id.to_owned(),
        shape,
        points_m,
        colour: MASS_POINTS,
        colours,
    };
    vec![
        drawing(0, Shape::Lines { width_m: ROD_WIDTH * rod_m }, rods.ends_m, rods.colours),
        drawing(1, Shape::Lines { width_m: SPRING_WIDTH * rod_m }, springs.ends_m, springs.colours),
        drawing(2, Shape::Spheres { diameter_m: MASS_POINT_DIAMETER * rod_m }, mass_points, Vec::new()),
    ]
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

    #[test]
    fn every_unit_has_four_rods_two_springs_and_shares_its_mass_points() {
        let [rods, springs, mass_points] = <[Drawing; 3]>::try_from(draw(&[shape(0.01)])).unwrap();
        let units = 4 * 3;
        assert_eq!(rods.points_m.len(), 2 * 4 * units);
        assert_eq!(springs.points_m.len(), 2 * 2 * 9 * units);
        assert_eq!(mass_points.points_m.len(), 1 + 3 * units);
        assert_eq!((rods.key.id, springs.key.id, mass_points.key.id), (6, 7, 8));
        for drawing in [rods, springs, mass_points] {
            assert!(drawing.points_m.iter().all(|point| is_drawable(*point)));
            assert!(drawing.colours.is_empty() || drawing.colours.len() == drawing.points_m.len());
        }
    }

    #[test]
    fn every_chain_is_drawn_and_the_rows_stay_few() {
        assert_eq!([1, 2, 3, 4, 5, 12].map(rows), [4, 4, 6, 4, 5, 12]);
        assert_eq!([0, 13, 1000].map(rows), [0, 12, 12]);
        let shapes: Vec<ChainShape> = (1..=3).map(|i| shape(0.01 * f64::from(i))).collect();
        let lengths: Vec<f64> =
            draw(&shapes)[0].points_m.chunks(2).map(|rod| rod[0].distance(rod[1])).collect();
        for shape in &shapes {
            assert!(lengths.iter().any(|length| (length - shape.rod_length_m).abs() < 1e-12));
        }
        let many: Vec<ChainShape> = (0..100).map(|_| shape(0.01)).collect();
        assert_eq!(draw(&many)[0].points_m.len(), 2 * 4 * 3 * MOST_ROWS);
    }

    #[test]
    fn rods_at_the_contact_start_at_the_pressed_point() {
        let drawings = draw(&[shape(0.01)]);
        let pressed = DVec3::new(0.0, 0.0, -0.002);
        assert_eq!((drawings[0].points_m[0], drawings[2].points_m[0]), (pressed, pressed));
    }
}
