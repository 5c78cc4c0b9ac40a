//! Probe, proxy and force of one device.

use glam::DVec3;

use super::{Drawing, Key, Shape, Thing};
use crate::colour::Colour;

const PROBE: Colour = Colour::rgb(0.62, 0.68, 0.76);
/// While the clutch holds it still.
const CLUTCHED: Colour = Colour { a: 0.4, ..PROBE };
const PROXY: Colour = Colour::rgb(0.10, 0.75, 0.85);
const FORCE: Colour = Colour::rgb(0.13, 0.47, 0.90);
/// A chain is past its guard.
const SATURATED: Colour = Colour::rgb(0.86, 0.10, 0.32);

/// An arrow shorter than this would be a dot.
const SHORTEST_ARROW_M: f64 = 1e-4;

/// The probe at its true size.
pub(crate) fn probe(device: i32, frame_id: &str, centre_m: DVec3, radius_m: f64, clutched: bool) -> Drawing {
    let colour = if clutched { CLUTCHED } else { PROBE };
    sphere(Key { thing: Thing::Probe, id: device }, frame_id, centre_m, 2.0 * radius_m, colour)
}

/// The contact point on the rest surface: a dot, smaller than the probe.
pub(crate) fn proxy(device: i32, frame_id: &str, point_m: DVec3, probe_radius_m: f64) -> Drawing {
    sphere(Key { thing: Thing::Proxy, id: device }, frame_id, point_m, 0.6 * probe_radius_m, PROXY)
}

/// The force on the hand, as an arrow from the probe's centre; none when it is too short to see.
pub(crate) fn force(
    device: i32,
    frame_id: &str,
    probe_m: DVec3,
    arrow_m: DVec3,
    probe_radius_m: f64,
    saturated: bool,
) -> Option<Drawing> {
    let length_m = arrow_m.length();
    (length_m >= SHORTEST_ARROW_M).then(|| Drawing {
        key: Key { thing: Thing::Force, id: device },
        frame_id: frame_id.to_owned(),
        shape: Shape::Arrow {
            shaft_m: 0.4 * probe_radius_m,
            head_m: 0.9 * probe_radius_m,
            head_length_m: (1.4 * probe_radius_m).min(0.5 * length_m),
        },
        points_m: vec![probe_m, probe_m + arrow_m],
        colour: if saturated { SATURATED } else { FORCE },
        colours: Vec::new(),
    })
}

fn sphere(key: Key, frame_id: &str, centre_m: DVec3, diameter_m: f64, colour: Colour) -> Drawing {
    Drawing {
        key,
        frame_id: frame_id.to_owned(),
        shape: Shape::Sphere { diameter_m },
        points_m: vec![centre_m],
        colour,
        colours: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_arrow_starts_at_the_probe_and_a_dot_is_no_arrow() {
        let arrow = force(0, "base", DVec3::ONE, DVec3::Z * 0.04, 0.005, false).unwrap();
        assert_eq!(arrow.points_m, [DVec3::ONE, DVec3::new(1.0, 1.0, 1.04)]);
        assert!(force(0, "base", DVec3::ONE, DVec3::ZERO, 0.005, false).is_none());
    }

    #[test]
    fn the_probe_is_drawn_at_its_size() {
        let drawing = probe(3, "base", DVec3::Z, 0.005, false);
        assert_eq!(drawing.shape, Shape::Sphere { diameter_m: 0.01 });
        assert_eq!((drawing.points_m, drawing.key.id), (vec![DVec3::Z], 3));
    }
}
