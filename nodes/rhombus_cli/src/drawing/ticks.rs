//! Where an axis is divided, and what stands there.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

use super::axis::{Axis, Scale};

/// The drawn range of an axis and its divisions. Places are the values, or their decimal logarithms.
#[derive(Clone, Debug, PartialEq)]
pub struct Ticks {
    scale: Scale,
    /// Places of the ends.
    range: (f64, f64),
    /// Place and label of each division.
    divisions: Vec<(f64, String)>,
}

impl Ticks {
    /// For the values that are to be drawn on `axis`.
    pub fn new(axis: &Axis, values: impl Iterator<Item = f64>) -> Self {
        let scale = axis.scale;
        let range = match axis.range {
            Some((low, high)) => (scale.place(low), scale.place(high)),
            None => padded(values.map(|value| scale.place(value)).filter(|place| place.is_finite())),
        };
        let divisions = match scale {
            Scale::Linear => linear(range, axis.divisions),
            Scale::Log => logarithmic(range),
        };
        Self { scale, range, divisions }
    }

    /// Whether a value lies in the drawn range.
    pub fn shows(&self, value: f64) -> bool {
        (self.range.0..=self.range.1).contains(&self.scale.place(value))
    }
}

/// The axis as plotters asks for it.
impl Ranged for Ticks {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        let (low, high) = self.range;
        let along = (self.scale.place(*value) - low) / (high - low);
        from + (along * f64::from(to - from)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        let few = hint.max_num_points().min(self.divisions.len());
        self.divisions[..few].iter().map(|(place, _)| self.scale.value(*place)).collect()
    }

    fn range(&self) -> Range<f64> {
        self.scale.value(self.range.0)..self.scale.value(self.range.1)
    }
}

impl ValueFormatter<f64> for Ticks {
    fn format_ext(&self, value: &f64) -> String {
        let place = self.scale.place(*value);
        let nearer =
            |a: &&(f64, String), b: &&(f64, String)| (a.0 - place).abs().total_cmp(&(b.0 - place).abs());
        self.divisions.iter().min_by(nearer).map_or_else(String::new, |(_, label)| label.clone())
    }
}

impl Scale {
    fn place(self, value: f64) -> f64 {
        match self {
            Scale::Linear => value,
            Scale::Log => value.log10(),
        }
    }

    fn value(self, place: f64) -> f64 {
        match self {
            Scale::Linear => place,
            Scale::Log => libm::exp10(place),
        }
    }
}

/// The range of some places with a margin of 4 % at both ends.
fn padded(places: impl Iterator<Item = f64>) -> (f64, f64) {
    let start = (f64::INFINITY, f64::NEG_INFINITY);
    let (low, high) = places.fold(start, |(low, high), place| (low.min(place), high.max(place)));
    if low > high {
        return (0.0, 1.0);
    }
    let margin = if high > low { 0.04 * (high - low) } else { 0.5 * high.abs().max(1e-3) };
    (low - margin, high + margin)
}

/// About so many divisions, from 0.6 to 1.3 times as many, in steps of 1, 2 or 5 times a power of ten.
fn linear((low, high): (f64, f64), divisions: f64) -> Vec<(f64, String)> {
    let rough = (high - low) / divisions;
    let decade = rough.log10().floor();
    let power = 10_f64.powi(decade as i32);
    let (factor, extra) = match rough / power {
        x if x <= 1.0 => (1.0, 0.0),
        x if x <= 2.0 => (2.0, 0.0),
        x if x <= 5.0 => (5.0, 0.0),
        _ => (1.0, 1.0),
    };
    let step = factor * 10_f64.powi((decade + extra) as i32);
    let decimals = (-(decade + extra)).max(0.0) as usize;
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    let label = |value: f64| {
        if decimals > 4 || value.abs() >= 1e5 {
            format!("{value:.1e}")
        } else {
            format!("{value:.decimals$}")
        }
    };
    // One division more than a screen has pixels means that the range is empty but for rounding.
    (first..=last.min(first.saturating_add(1000)))
        .map(|i| {
            let value = i as f64 * step;
            (value, label(value))
        })
        .collect()
}

/// Powers of ten, every one or every few; below two and a half decades 2 and 5 as well.
fn logarithmic((low, high): (f64, f64)) -> Vec<(f64, String)> {
    const MOST_LABELS: f64 = 9.0;
    let between = if high - low < 2.5 { &[1.0, 2.0, 5.0][..] } else { &[1.0] };
    let every = ((high - low) / MOST_LABELS).ceil().max(1.0) as i64;
    let decades = (low.floor() as i64..=high.ceil() as i64).filter(|decade| decade % every == 0);
    decades
        .flat_map(|decade| {
            let place = move |factor: &f64| (decade as f64 + factor.log10(), power_label(*factor, decade));
            between.iter().map(place)
        })
        .filter(|(place, _)| (low..=high).contains(place))
        .collect()
}

/// `factor 10^decade`, as people write it.
fn power_label(factor: f64, decade: i64) -> String {
    if (-3..=0).contains(&decade) {
        return format!("{:.*}", -decade as usize, factor * 10_f64.powi(decade as i32));
    }
    if (1..=4).contains(&decade) {
        return format!("{}", factor * 10_f64.powi(decade as i32));
    }
    let superscript = |digit: char| match digit {
        '-' => '⁻',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        other => char::from_u32(other as u32 - '0' as u32 + '⁰' as u32).unwrap_or(other),
    };
    let exponent: String = decade.to_string().chars().map(superscript).collect();
    if factor > 1.0 { format!("{factor}·10{exponent}") } else { format!("10{exponent}") }
}

#[cfg(test)]
mod tests {
    use super::{Axis, Ticks};

    fn labels(axis: &Axis, values: &[f64]) -> Vec<String> {
        Ticks::new(axis, values.iter().copied()).divisions.into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn divisions_are_round_numbers() {
        assert_eq!(
            labels(&Axis::linear("").within(0.0, 1.0), &[]),
            ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]
        );
        assert_eq!(
            labels(&Axis::linear("").within(-20.0, 20.0), &[]),
            ["-20", "-15", "-10", "-5", "0", "5", "10", "15", "20"]
        );
        assert_eq!(
            labels(&Axis::log("").within(0.01, 1e5), &[]),
            ["0.01", "0.1", "1", "10", "100", "1000", "10000", "10⁵"]
        );
        assert_eq!(labels(&Axis::log("").within(1.0, 10.0), &[]), ["1", "2", "5", "10"]);
        assert_eq!(labels(&Axis::log("").within(1e-13, 1e-10), &[]), ["10⁻¹³", "10⁻¹²", "10⁻¹¹", "10⁻¹⁰"]);
    }

    #[test]
    fn an_axis_has_room_for_every_value_that_can_be_drawn_and_none_for_others() {
        let ticks = Ticks::new(&Axis::log(""), [0.0, 1.0, 1000.0, f64::NAN].into_iter());
        assert!(ticks.range.0 < 0.0 && ticks.range.0 > -0.5 && ticks.range.1 > 3.0 && ticks.range.1 < 3.5);
        assert!(!labels(&Axis::linear(""), &[7.0]).is_empty(), "a single value");
        assert!(labels(&Axis::linear(""), &[]).len() > 1, "no value");
    }
}
