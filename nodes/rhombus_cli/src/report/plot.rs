//! Draws a figure as SVG.
//!
//! An SVG file stands on a white ground. In the page, style.css gives ink, ground and grid the colours of the reader's scheme:
//! they are the only things drawn in these three colours.

use anyhow::Result;
use plotters::element::{Drawable, PointCollection};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters_backend::{BackendCoord, DrawingErrorKind};
use rhombus_cli::drawing::{self, Area, DrawingError, FINE, GRID, INK, PALETTE, Ticks};

use super::figure::{Figure, Line, Marker, Point, Series};

const WIDTH: u32 = 800;
const PLOT_HEIGHT: u32 = 440;
const LEGEND_LINE: u32 = 22;
const LEGEND_COLUMNS: u32 = 2;
const TEXT: u32 = 15;
/// Around the plot, and what its labels take.
const MARGIN: u32 = 12;
const MARGIN_RIGHT: u32 = 24;
const X_LABELS: u32 = 48;
const Y_LABELS: u32 = 72;
/// Width by height of what the axes enclose, for a figure with one scale.
pub(crate) const ASPECT: f64 =
    (WIDTH - MARGIN - MARGIN_RIGHT - Y_LABELS) as f64 / (PLOT_HEIGHT - 2 * MARGIN - X_LABELS) as f64;
const LINE: u32 = 2 * FINE;

type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Ticks, Ticks>>;

/// The figure as a whole SVG document.
///
/// # Errors
/// An axis without extent.
pub(crate) fn svg(figure: &Figure) -> Result<String> {
    let shown: Vec<&Series> = figure.series.iter().filter(|series| !series.name.is_empty()).collect();
    let height = PLOT_HEIGHT + (shown.len() as u32).div_ceil(LEGEND_COLUMNS) * LEGEND_LINE + 8;
    drawing::svg(WIDTH, height, |root| {
        let (plot, legend) = root.split_vertically(FINE * PLOT_HEIGHT);
        draw_plot(&plot, figure)?;
        draw_legend(&legend, &shown)
    })
}

fn draw_plot(area: &Area, figure: &Figure) -> Result<(), DrawingError> {
    let drawable = || figure.series.iter().flat_map(|series| &series.points).filter(|p| figure.draws(p));
    let with_ends = |value: f64, spread: Option<(f64, f64)>| {
        let (low, high) = spread.unwrap_or((value, value));
        [value, low, high]
    };
    let x = Ticks::new(&figure.x, drawable().flat_map(|p| with_ends(p.x, p.x_spread)));
    let y = Ticks::new(&figure.y, drawable().flat_map(|p| with_ends(p.y, p.y_spread)));
    let mut chart = ChartBuilder::on(area)
        .margin(MARGIN * FINE)
        .margin_right(MARGIN_RIGHT * FINE)
        .x_label_area_size(X_LABELS * FINE)
        .y_label_area_size(Y_LABELS * FINE)
        .build_cartesian_2d(x.clone(), y.clone())?;
    let ink = ("sans-serif", TEXT * FINE).into_font().color(&INK);
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(GRID.stroke_width(FINE))
        .axis_style(INK.stroke_width(FINE))
        .label_style(ink.clone())
        .axis_desc_style(ink)
        .set_all_tick_mark_size(5 * FINE)
        .x_labels(100)
        .y_labels(100)
        .x_desc(&figure.x.label)
        .y_desc(&figure.y.label)
        .draw()?;
    for series in &figure.series {
        draw_series(&mut chart, series, figure, (&x, &y))?;
    }
    Ok(())
}

fn draw_series(
    chart: &mut Chart,
    series: &Series,
    figure: &Figure,
    (x, y): (&Ticks, &Ticks),
) -> Result<(), DrawingError> {
    let colour = colour(series);
    let inside = |point: &&Point| figure.draws(point) && x.shows(point.x) && y.shows(point.y);
    for run in series.points.split(|point| !inside(&point)).filter(|run| !run.is_empty()) {
        let places = run.iter().map(|point| (point.x, point.y));
        match series.line {
            Line::None => {}
            Line::Solid => {
                chart.draw_series(LineSeries::new(places, colour.stroke_width(LINE)))?;
            }
            Line::Dashed => {
                chart.draw_series(DashedLineSeries::new(
                    places,
                    6 * FINE,
                    4 * FINE,
                    colour.stroke_width(LINE),
                ))?;
            }
            Line::Faces => {
                let faces = run.chunks_exact(3).map(|corners| {
                    let corners: Vec<(f64, f64)> =
                        corners.iter().map(|corner| (corner.x, corner.y)).collect();
                    Polygon::new(corners, colour.filled())
                });
                chart.draw_series(faces)?;
            }
        }
    }
    for point in series.points.iter().filter(inside) {
        let place = (point.x, point.y);
        let across = point.x_spread.map(|(low, high)| [(low, place.1), (high, place.1)]);
        let along = point.y_spread.map(|(low, high)| [(place.0, low), (place.0, high)]);
        let bars = across.into_iter().chain(along);
        let inside = bars.filter(|ends| ends.iter().all(|(px, py)| x.shows(*px) && y.shows(*py)));
        chart.draw_series(inside.map(|ends| PathElement::new(ends, colour.stroke_width(FINE))))?;
        chart.draw_series(mark(place, series))?;
    }
    Ok(())
}

/// Name and look of each series, in two columns below the plot.
fn draw_legend(area: &Area, shown: &[&Series]) -> Result<(), DrawingError> {
    let fine = |(x, y): (u32, u32)| ((x * FINE) as i32, (y * FINE) as i32);
    let style = ("sans-serif", TEXT * FINE).into_font().color(&INK).pos(Pos::new(HPos::Left, VPos::Center));
    for (index, series) in (0..).zip(shown) {
        let left = 30 + index % LEGEND_COLUMNS * (WIDTH - 30) / LEGEND_COLUMNS;
        let middle = index / LEGEND_COLUMNS * LEGEND_LINE + LEGEND_LINE / 2;
        let dashes: &[(u32, u32)] = match series.line {
            Line::None | Line::Faces => &[],
            Line::Solid => &[(0, 28)],
            Line::Dashed => &[(0, 6), (11, 17), (22, 28)],
        };
        for (from, to) in dashes {
            let ends = [fine((left + from, middle)), fine((left + to, middle))];
            area.draw(&PathElement::new(ends, colour(series).stroke_width(LINE)))?;
        }
        if series.line == Line::Faces {
            let corners = [fine((left + 4, middle - 6)), fine((left + 24, middle + 6))];
            area.draw(&Rectangle::new(corners, colour(series).filled()))?;
        }
        if let Some(mark) = mark(fine((left + 14, middle)), series) {
            area.draw(&mark)?;
        }
        area.draw(&Text::new(series.name.clone(), fine((left + 36, middle)), style.clone()))?;
    }
    Ok(())
}

/// The mark of a series at a place.
fn mark<'b, C: Clone + 'static>(place: C, series: &Series) -> Option<DynElement<'static, SVGBackend<'b>, C>> {
    const RADIUS: u32 = 4 * FINE;
    let style = colour(series).stroke_width(LINE);
    Some(match series.marker {
        Marker::None => return None,
        Marker::Circle => Circle::new(place, RADIUS, style.filled()).into_dyn(),
        Marker::Ring => Circle::new(place, RADIUS, style).into_dyn(),
        Marker::Triangle => TriangleMarker::new(place, RADIUS + 2 * FINE, style.filled()).into_dyn(),
        Marker::Cross => Cross::new(place, RADIUS, style).into_dyn(),
        Marker::Square => Square { place, half: RADIUS, style }.into_dyn(),
        Marker::Tile(size) => Square { place, half: size * FINE / 2, style }.into_dyn(),
    })
}

/// A filled square of so many pixels at a place of the axes, which plotters does not have.
struct Square<C> {
    place: C,
    half: u32,
    style: ShapeStyle,
}

impl<'a, C> PointCollection<'a, C> for &'a Square<C> {
    type Point = &'a C;
    type IntoIter = std::iter::Once<&'a C>;

    fn point_iter(self) -> Self::IntoIter {
        std::iter::once(&self.place)
    }
}

impl<C, DB: DrawingBackend> Drawable<DB> for Square<C> {
    fn draw<I: Iterator<Item = BackendCoord>>(
        &self,
        places: I,
        backend: &mut DB,
        _: (u32, u32),
    ) -> Result<(), DrawingErrorKind<DB::ErrorType>> {
        let half = self.half as i32;
        for (x, y) in places {
            backend.draw_rect((x - half, y - half), (x + half, y + half), &self.style, true)?;
        }
        Ok(())
    }
}

fn colour(series: &Series) -> RGBColor {
    PALETTE[series.colour % PALETTE.len()]
}
