//! Colours, and the scale from displacement to colour.

/// An opaque or translucent colour, sRGB, each part 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Colour {
    pub(crate) r: f32,
    pub(crate) g: f32,
    pub(crate) b: f32,
    pub(crate) a: f32,
}

impl Colour {
    /// An opaque colour.
    pub(crate) const fn rgb(r: f32, g: f32, b: f32) -> Colour {
        Colour { r, g, b, a: 1.0 }
    }
}

/// Steps of the scale; more would not be told apart.
const STEPS: usize = 256;

/// OKLab (Ottosson 2020) lightness, green-red and blue-yellow of the scale's corners: from the dark red of an organ at
/// rest to a pale yellow. Lightness rises in equal steps, so that more displacement is always seen as more, in print
/// without colour and with any colour vision.
const CORNERS: [[f32; 3]; 6] = [
    [0.370, 0.0770, 0.0359],
    [0.486, 0.0932, 0.0674],
    [0.602, 0.0881, 0.1049],
    [0.718, 0.0619, 0.1366],
    [0.834, 0.0186, 0.1388],
    [0.950, -0.0148, 0.0837],
];

/// The scale from nothing (0) to everything (1).
#[derive(Clone, Debug)]
pub(crate) struct ColourScale {
    steps: [Colour; STEPS],
}

impl ColourScale {
    pub(crate) fn new() -> ColourScale {
        ColourScale {
            steps: std::array::from_fn(|step| {
                let along = step as f32 / (STEPS - 1) as f32 * (CORNERS.len() - 1) as f32;
                let corner = (along as usize).min(CORNERS.len() - 2);
                let share = along - corner as f32;
                let part = |i: usize| CORNERS[corner][i] * (1.0 - share) + CORNERS[corner + 1][i] * share;
                srgb_from_oklab([part(0), part(1), part(2)])
            }),
        }
    }

    /// The colour of a share; below 0 and above 1 the ends of the scale, NaN is 0.
    pub(crate) fn at(&self, share: f64) -> Colour {
        // A float that is too large, too small or NaN saturates in `as`.
        self.steps[((share * (STEPS - 1) as f64).round() as usize).min(STEPS - 1)]
    }
}

fn srgb_from_oklab([lightness, a, b]: [f32; 3]) -> Colour {
    let cube = |x: f32| x * x * x;
    let l = cube(lightness + 0.396_337_78 * a + 0.215_803_76 * b);
    let m = cube(lightness - 0.105_561_346 * a - 0.063_854_17 * b);
    let s = cube(lightness - 0.089_484_18 * a - 1.291_485_5 * b);
    Colour::rgb(
        encoded(4.076_741_7 * l - 3.307_711_6 * m + 0.230_969_94 * s),
        encoded(-1.268_438 * l + 2.609_757_4 * m - 0.341_319_38 * s),
        encoded(-0.004_196_086_3 * l - 0.703_418_6 * m + 1.707_614_7 * s),
    )
}

/// The sRGB value of a linear one (IEC 61966-2-1).
fn encoded(linear: f32) -> f32 {
    let encoded = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    encoded.clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance (ITU-R BT.709).
    fn luminance(colour: Colour) -> f32 {
        let linear = |x: f32| if x <= 0.040_45 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) };
        0.2126 * linear(colour.r) + 0.7152 * linear(colour.g) + 0.0722 * linear(colour.b)
    }

    #[test]
    fn more_displacement_is_always_lighter() {
        let scale = ColourScale::new();
        for step in 1..STEPS {
            let (before, after) = (luminance(scale.steps[step - 1]), luminance(scale.steps[step]));
            assert!(after > before, "step {step}: {before} then {after}");
        }
        assert!(luminance(scale.at(1.0)) > 10.0 * luminance(scale.at(0.0)));
    }

    #[test]
    fn the_scale_stays_inside_the_colours_a_screen_has() {
        for corner in CORNERS {
            let colour = srgb_from_oklab(corner);
            for part in [colour.r, colour.g, colour.b] {
                assert!(part > 0.0 && part < 1.0, "{corner:?} is {colour:?}");
            }
        }
    }

    #[test]
    fn values_beyond_the_scale_get_its_ends() {
        let scale = ColourScale::new();
        assert_eq!(scale.at(7.0), scale.at(1.0));
        assert_eq!(scale.at(f64::INFINITY), scale.at(1.0));
        assert_eq!(scale.at(-1.0), scale.at(0.0));
        assert_eq!(scale.at(f64::NAN), scale.at(0.0));
    }
}
