//! Draws the golden and the computed signal of each topic over time, and their difference below.
//!
//! The drawing follows the reader's scheme: in a dark one, ink, ground and grid change their colours.

use anyhow::Result;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use recording::{Bin, Outcome, Signal, TopicOutcome, Verdict};

use super::text;
use crate::drawing::{self, Area, Axis, DrawingError, FINE, GRID, INK, PALETTE, Ticks};

const WIDTH: u32 = 900;
const TITLE: u32 = 34;
const SIGNALS: u32 = 190;
const DIFFERENCE: u32 = 130;
const TIME: u32 = 48;
const TEXT: u32 = 14;
/// Under the computed line, and wider, so that both are seen where they agree.
const GOLDEN: (RGBColor, u32) = (PALETTE[4], 6);
const COMPUTED: (RGBColor, u32) = (PALETTE[0], 2);
const DIFFER: (RGBColor, u32) = (PALETTE[3], 2);
const DIVERGENCE: RGBColor = PALETTE[10];
/// A hole in a signal is wider than so many of its usual steps.
const HOLE: i64 = 4;
/// Larger numbers have no place on an axis with others.
const LARGEST: f64 = 1e100;

/// What the drawing changes in a dark scheme.
const DARK: &str = "<style>@media (prefers-color-scheme: dark) { rect[fill=\"#FFFFFF\"] { fill: #14171b } \
    [stroke=\"#22262B\"] { stroke: #e6e9ed } [fill=\"#22262B\"] { fill: #e6e9ed } [stroke=\"#DFE3E8\"] { stroke: #343b44 } }</style>\n";

type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Ticks, Ticks>>;
type Ends = Option<(f64, f64)>;
/// Which values of a bin are drawn, and their colour and width.
type Series = (fn(&Bin) -> Ends, (RGBColor, u32));

/// A topic with something to draw.
struct Panel<'a> {
    topic: &'a TopicOutcome,
    signal: &'a Signal,
    /// Whether the difference is more than nothing.
    differs: bool,
}

/// The part of the time axis that is drawn.
#[derive(Clone, Copy)]
struct Span {
    start_ns: i64,
    end_ns: i64,
}

/// The signals of all topics that have one, as a whole SVG document.
///
/// # Errors
/// When the drawing library refuses.
pub fn svg(outcome: &Outcome) -> Result<String> {
    let panels: Vec<Panel<'_>> = outcome.topics.iter().filter_map(Panel::of).collect();
    let Some(span) = Span::of(&panels) else {
        let svg = drawing::svg(WIDTH, TITLE, |root| {
            line(root, (12, TITLE / 2), "No force, depth or displacement was compared: nothing to draw.", INK)
        })?;
        return Ok(with_scheme(&svg));
    };
    let height = TITLE + panels.iter().map(Panel::height).sum::<u32>();
    let svg = drawing::svg(WIDTH, height, |root| {
        let (head, mut rest) = root.split_vertically(FINE * TITLE);
        legend(&head)?;
        for panel in &panels {
            let (own, below) = rest.split_vertically(FINE * panel.height());
            panel.draw(&own, span)?;
            rest = below;
        }
        Ok(())
    })?;
    Ok(with_scheme(&svg))
}

fn with_scheme(svg: &str) -> String {
    svg.replacen(">\n<rect", &format!(">\n{DARK}<rect"), 1)
}

impl<'a> Panel<'a> {
    fn of(topic: &'a TopicOutcome) -> Option<Self> {
        let signal = topic.signal.as_ref().filter(|signal| !signal.bins.is_empty())?;
        let differs = signal.bins.iter().filter_map(|bin| bin.difference).any(|ends| ends != (0.0, 0.0));
        Some(Self { topic, signal, differs })
    }

    fn height(&self) -> u32 {
        TITLE + SIGNALS + TIME + if self.differs { DIFFERENCE } else { 0 }
    }

    fn draw(&self, area: &Area<'_>, span: Span) -> Result<(), DrawingError> {
        let Signal { quantity, unit, bins } = self.signal;
        let (title, rest) = area.split_vertically(FINE * TITLE);
        let verdict = match (&self.topic.verdict, self.topic.fields.is_empty()) {
            (Verdict::Same, true) => "same",
            (Verdict::Same, false) => "same within the tolerance",
            (verdict, _) => verdict.word(),
        };
        line(&title, (12, TITLE / 2 + 4), &format!("{}: {verdict}", self.topic.name), INK)?;
        let golden = |bin: &Bin| bin.golden;
        let computed = |bin: &Bin| bin.computed;
        let difference = |bin: &Bin| bin.difference;
        let scale = Scaled::of(bins.iter().flat_map(|bin| [bin.golden, bin.computed]), unit);
        let marked = self.topic.first.as_ref().map(|first| first.stamp_ns);
        if !self.differs {
            let label = format!("{quantity} [{}]", scale.unit);
            return chart(
                &rest,
                bins,
                span,
                &scale,
                (&label, true),
                &[(golden, GOLDEN), (computed, COMPUTED)],
                marked,
            );
        }
        let (upper, lower) = rest.split_vertically(FINE * SIGNALS);
        let label = format!("{quantity} [{}]", scale.unit);
        chart(
            &upper,
            bins,
            span,
            &scale,
            (&label, false),
            &[(golden, GOLDEN), (computed, COMPUTED)],
            marked,
        )?;
        let scale = Scaled::of(bins.iter().map(|bin| bin.difference), unit);
        let label = format!("difference [{}]", scale.unit);
        chart(&lower, bins, span, &scale, (&label, true), &[(difference, DIFFER)], marked)
    }
}

impl Span {
    fn of(panels: &[Panel<'_>]) -> Option<Self> {
        let bins = || panels.iter().flat_map(|panel| &panel.signal.bins);
        let start_ns = bins().map(|bin| bin.start_ns).min()?;
        let end_ns = bins().map(|bin| bin.end_ns).max()?;
        Some(Self { start_ns, end_ns })
    }

    /// Seconds since the begin.
    fn seconds(self, stamp_ns: i64) -> f64 {
        (i128::from(stamp_ns) - i128::from(self.start_ns)) as f64 / 1e9
    }

    fn axis(self, is_named: bool) -> Axis {
        let label = format!("time since stamp {} s [s]", text::stamp(self.start_ns));
        let end = self.seconds(self.end_ns);
        Axis::linear(if is_named { &label } else { "" }).within(-0.01 * end, 1.01 * end)
    }
}

/// A unit in which the numbers are neither long nor small.
struct Scaled {
    factor: f64,
    unit: String,
}

impl Scaled {
    fn of(ends: impl Iterator<Item = Ends>, unit: &str) -> Self {
        let sizes = ends.flatten().flat_map(|(low, high)| [low.abs(), high.abs()]);
        let largest = sizes.filter(|size| *size < LARGEST).fold(0.0, f64::max);
        let prefixes = [(1.0, ""), (1e3, "m"), (1e6, "µ"), (1e9, "n"), (1e12, "p")];
        let fitting = prefixes.into_iter().find(|(factor, _)| largest == 0.0 || largest * factor >= 0.5);
        match fitting {
            Some((factor, prefix)) => Self { factor, unit: format!("{prefix}{unit}") },
            None => {
                let exponent = -(largest.log10().floor() as i32);
                let exponent = exponent.clamp(0, 300);
                Self { factor: 10_f64.powi(exponent), unit: format!("1e-{exponent} {unit}") }
            }
        }
    }

    fn ends(&self, ends: Ends) -> Ends {
        let (low, high) = ends?;
        let (low, high) = (low * self.factor, high * self.factor);
        (low.abs() < LARGEST && high.abs() < LARGEST).then_some((low, high))
    }
}

fn chart(
    area: &Area<'_>,
    bins: &[Bin],
    span: Span,
    scale: &Scaled,
    (label, with_time): (&str, bool),
    series: &[Series],
    marked_ns: Option<i64>,
) -> Result<(), DrawingError> {
    let values = || series.iter().flat_map(|(ends, _)| bins.iter().filter_map(|bin| scale.ends(ends(bin))));
    let x = Ticks::new(&span.axis(with_time), std::iter::empty());
    let y = Ticks::new(&Axis::linear(label).divided(4.0), values().flat_map(|(low, high)| [low, high]));
    let ink = ("sans-serif", TEXT * FINE).into_font().color(&INK);
    let mut chart = ChartBuilder::on(area)
        .margin(4 * FINE)
        .margin_right(24 * FINE)
        .x_label_area_size(if with_time { (TIME - 4) * FINE } else { 4 * FINE })
        .y_label_area_size(84 * FINE)
        .build_cartesian_2d(x, y.clone())?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID.stroke_width(FINE))
        .axis_style(INK.stroke_width(FINE))
        .label_style(ink.clone())
        .axis_desc_style(ink)
        .set_all_tick_mark_size(4 * FINE)
        .x_labels(if with_time { 100 } else { 0 })
        .y_labels(100)
        .x_desc(if with_time { span.axis(true).label } else { String::new() })
        .y_desc(label)
        .draw()?;
    if let Some(marked_ns) = marked_ns {
        mark(&mut chart, span.seconds(marked_ns), &y)?;
    }
    for (ends, (colour, width)) in series {
        for run in runs(bins, *ends) {
            let ends =
                run.iter().filter_map(|bin| Some((span.seconds(bin.start_ns), scale.ends(ends(bin))?)));
            let mut places: Vec<(f64, f64)> =
                ends.flat_map(|(time, (low, high))| [(time, low), (time, high)]).collect();
            places.dedup();
            let style = colour.stroke_width(width * FINE);
            if let [place] = places[..] {
                chart.draw_series([Circle::new(place, (width + 1) * FINE, style.filled())])?;
            } else {
                chart.draw_series(LineSeries::new(places, style))?;
            }
        }
    }
    Ok(())
}

/// The bins that have such a value, without those that only the other series has, cut at holes.
fn runs(bins: &[Bin], ends: fn(&Bin) -> Ends) -> Vec<Vec<Bin>> {
    let own: Vec<Bin> = bins.iter().filter(|bin| ends(bin).is_some()).copied().collect();
    let step = |one: &Bin, next: &Bin| next.start_ns.saturating_sub(one.start_ns);
    let mut steps: Vec<i64> = own.array_windows().map(|[one, next]| step(one, next)).collect();
    steps.sort_unstable();
    let usual = steps.get(steps.len() / 2).copied().unwrap_or(i64::MAX);
    let together = |one: &Bin, next: &Bin| step(one, next) <= usual.saturating_mul(HOLE);
    own.chunk_by(together).map(<[Bin]>::to_vec).collect()
}

/// The first divergence, from the bottom to the top.
fn mark(chart: &mut Chart<'_, '_>, seconds: f64, y: &Ticks) -> Result<(), DrawingError> {
    let range = plotters::coord::ranged1d::Ranged::range(y);
    let ends = [(seconds, range.start), (seconds, range.end)];
    let style = DIVERGENCE.stroke_width(2 * FINE);
    chart.draw_series(DashedLineSeries::new(ends, 6 * FINE, 4 * FINE, style))?;
    Ok(())
}

fn legend(area: &Area<'_>) -> Result<(), DrawingError> {
    let entries = [
        ("golden", GOLDEN, 110),
        ("computed", COMPUTED, 130),
        ("computed - golden", DIFFER, 190),
        ("first divergence", (DIVERGENCE, 2), 0),
    ];
    let mut left = 12;
    for (name, (colour, width), step) in entries {
        let middle = TITLE / 2;
        let ends = [(left, middle), (left + 28, middle)].map(fine);
        let style = colour.stroke_width(width * FINE);
        if name == "first divergence" {
            let dashes = [(0, 6), (11, 17), (22, 28)];
            for (from, to) in dashes {
                area.draw(&PathElement::new([(left + from, middle), (left + to, middle)].map(fine), style))?;
            }
        } else {
            area.draw(&PathElement::new(ends, style))?;
        }
        line(area, (left + 36, middle), name, INK)?;
        left += step;
    }
    Ok(())
}

fn line(area: &Area<'_>, place: (u32, u32), text: &str, colour: RGBColor) -> Result<(), DrawingError> {
    let style = ("sans-serif", TEXT * FINE).into_font().color(&colour);
    area.draw(&Text::new(text.to_owned(), fine(place), style.pos(Pos::new(HPos::Left, VPos::Center))))
}

fn fine((x, y): (u32, u32)) -> (i32, i32) {
    ((x * FINE) as i32, (y * FINE) as i32)
}

#[cfg(test)]
mod tests {
    use super::super::text::sample;
    use super::svg;
    use recording::{Outcome, Signal};

    fn drawn(signals: Vec<Signal>) -> String {
        let mut outcome: Outcome = sample::outcome();
        outcome.topics.truncate(signals.len());
        for (topic, signal) in outcome.topics.iter_mut().zip(signals) {
            topic.signal = Some(signal);
        }
        svg(&outcome).unwrap()
    }

    #[test]
    fn both_signals_are_drawn_and_their_difference_where_there_is_one() {
        let wave = |ms: u32| f64::from(ms % 100) * 0.01;
        let differing = (0..500).map(|ms| (wave(ms), wave(ms) + if ms > 300 { 1e-4 } else { 0.0 }));
        let equal = (0..500).map(|ms| (wave(ms), wave(ms)));
        let text = drawn(vec![sample::signal("N", differing), sample::signal("N", equal)]);
        assert_eq!(text.matches("difference [").count(), 1);
        assert!(text.contains("difference [mN]") || text.contains("difference [µN]"), "a unit that fits");
        assert!(text.contains("/servo_cf: different") && text.contains("/contact_state: same"));
        assert!(text.contains("time since stamp 10.000000000 s [s]"));
        assert!(text.contains("prefers-color-scheme: dark"));
    }

    #[test]
    fn signals_without_values_or_with_one_value_or_impossible_ones_are_drawn() {
        let nothing = sample::signal("N", std::iter::empty());
        assert!(drawn(vec![nothing]).contains("nothing to draw"));
        for values in [
            vec![(0.0, 0.0)],
            vec![(5.0, 5.0); 50],
            vec![(f64::INFINITY, 1.0), (1.0, f64::NEG_INFINITY)],
            vec![(1e300, -1e300), (1e-300, 5e-324)],
            vec![(1e-20, 2e-20); 3],
        ] {
            let text = drawn(vec![sample::signal("N", values.iter().copied())]);
            assert!(text.contains("/servo_cf: different") && !text.contains("NaN"), "{values:?}");
        }
    }

    #[test]
    fn stamps_at_both_ends_of_time_have_a_place() {
        let mut signal = sample::signal("N", [(1.0, 1.0), (2.0, 2.0)].into_iter());
        signal.bins[0].start_ns = i64::MIN;
        signal.bins[1].end_ns = i64::MAX;
        assert!(drawn(vec![signal]).contains("</svg>"));
    }
}
