//! What a figure shows; how it is drawn is `plot`'s business.

pub(crate) use rhombus_cli::drawing::Axis;

use super::table::{Cell, Table};

/// Series over two axes.
#[derive(Clone, Debug)]
pub(crate) struct Figure {
    /// The horizontal axis.
    pub(crate) x: Axis,
    /// The vertical axis.
    pub(crate) y: Axis,
    /// What is drawn, in the order of the legend.
    pub(crate) series: Vec<Series>,
}

/// One entry of the legend.
#[derive(Clone, Debug)]
pub(crate) struct Series {
    /// Its name.
    pub(crate) name: String,
    /// In the order in which they are joined.
    pub(crate) points: Vec<Point>,
    /// How points are joined.
    pub(crate) line: Line,
    /// How points are marked.
    pub(crate) marker: Marker,
    /// Number in the palette (taken modulo its size); equal numbers, equal colours.
    pub(crate) colour: usize,
}

/// A point of a series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point {
    /// On the horizontal axis.
    pub(crate) x: f64,
    /// On the vertical axis.
    pub(crate) y: f64,
    /// Spread of `x`, drawn as a bar: low, high.
    pub(crate) x_spread: Option<(f64, f64)>,
    /// Spread of `y`, drawn as a bar: low, high.
    pub(crate) y_spread: Option<(f64, f64)>,
}

/// How the points of a series are joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Line {
    /// Not at all.
    None,
    /// By a line.
    Solid,
    /// By a dashed line.
    Dashed,
    /// Every three are the corners of a filled triangle.
    Faces,
}

/// How the points of a series are marked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Marker {
    /// Not at all.
    None,
    /// Filled circle.
    Circle,
    /// Empty circle.
    Ring,
    /// Filled triangle.
    Triangle,
    /// Filled square.
    Square,
    /// Diagonal cross.
    Cross,
    /// Filled square that touches its neighbours of the next grid point: for maps. The size is in pixels.
    Tile(u32),
}

impl Point {
    /// A point without spread.
    pub(crate) fn new(x: f64, y: f64) -> Self {
        Self { x, y, x_spread: None, y_spread: None }
    }
}

impl Series {
    /// A line without marks.
    pub(crate) fn line(name: &str, colour: usize, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let points = points.into_iter().map(|(x, y)| Point::new(x, y)).collect();
        Self { name: name.to_owned(), points, line: Line::Solid, marker: Marker::None, colour }
    }

    /// The same with a dashed line.
    pub(crate) fn dashed(self) -> Self {
        Self { line: Line::Dashed, ..self }
    }

    /// The same with marked points.
    pub(crate) fn marked(self, marker: Marker) -> Self {
        Self { marker, ..self }
    }

    /// The same with points that are not joined.
    pub(crate) fn scattered(self, marker: Marker) -> Self {
        Self { marker, line: Line::None, ..self }
    }
}

impl Figure {
    /// Every plotted number.
    pub(crate) fn points(&self) -> Table {
        let (x, y) = (self.x.label.as_str(), self.y.label.as_str());
        let columns = ["x low", "x high", "y low", "y high"].map(|name| (name, ""));
        let mut table = Table::new([("series", ""), (x, ""), (y, "")].into_iter().chain(columns));
        for series in &self.series {
            for point in &series.points {
                let ends = |spread: Option<(f64, f64)>| {
                    [Cell::maybe(spread.map(|s| s.0)), Cell::maybe(spread.map(|s| s.1))]
                };
                let own = [series.name.as_str().into(), point.x.into(), point.y.into()];
                table.push(own.into_iter().chain(ends(point.x_spread)).chain(ends(point.y_spread)));
            }
        }
        table
    }

    /// Points that cannot be drawn: not finite, or at or below zero on a logarithmic axis.
    pub(crate) fn undrawn(&self) -> usize {
        self.series.iter().flat_map(|series| &series.points).filter(|p| !self.draws(p)).count()
    }

    /// Whether a point has a place on the axes.
    pub(crate) fn draws(&self, point: &Point) -> bool {
        self.x.scale.has(point.x) && self.y.scale.has(point.y)
    }
}
