//! What all drawings have in common: axes, colours, and the SVG around them.

mod axis;
mod ticks;

pub use axis::{Axis, Scale};
pub use ticks::Ticks;

use anyhow::{Result, anyhow};
use plotters::coord::Shift;
use plotters::prelude::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea, RGBColor, SVGBackend};

/// Text and axes.
pub const INK: RGBColor = RGBColor(0x22, 0x26, 0x2b);
/// Grid lines.
pub const GRID: RGBColor = RGBColor(0xdf, 0xe3, 0xe8);
/// Behind everything.
pub const GROUND: RGBColor = RGBColor(0xff, 0xff, 0xff);
/// Readable on white and on near black, and apart for colour-blind eyes (after Okabe and Ito).
pub const PALETTE: [RGBColor; 14] = [
    RGBColor(0x1f, 0x7a, 0xc4),
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0x0b, 0x9e, 0x73),
    RGBColor(0xc8, 0x5f, 0xa0),
    RGBColor(0xdd, 0x99, 0x00),
    RGBColor(0x84, 0x6f, 0xd6),
    RGBColor(0x4f, 0xb0, 0xd8),
    RGBColor(0x8a, 0x8f, 0x96),
    RGBColor(0xa8, 0x6a, 0x2e),
    RGBColor(0x94, 0xb0, 0x2a),
    RGBColor(0xd8, 0x4a, 0x4a),
    RGBColor(0x2f, 0x94, 0x9a),
    RGBColor(0xa9, 0x52, 0xc4),
    RGBColor(0x6b, 0x7d, 0x3a),
];
/// plotters places everything on whole pixels: it is given this many for each pixel of the drawing.
pub const FINE: u32 = 4;

/// Where is drawn.
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
/// Why a drawing fails.
pub type DrawingError = DrawingAreaErrorKind<std::io::Error>;

/// An SVG document of so many pixels, on the ground and filled by `draw`, whose area has [`FINE`] pixels for each of them.
///
/// # Errors
/// What `draw` fails with.
pub fn svg(
    width: u32,
    height: u32,
    draw: impl FnOnce(&Area<'_>) -> Result<(), DrawingError>,
) -> Result<String> {
    let mut text = String::new();
    let fine = (FINE * width, FINE * height);
    let drawn = || -> Result<(), DrawingError> {
        let root = SVGBackend::with_string(&mut text, fine).into_drawing_area();
        root.fill(&GROUND)?;
        draw(&root)?;
        root.present()
    };
    drawn().map_err(|error| anyhow!("the figure cannot be drawn: {error}"))?;
    let size = |(width, height)| format!("width=\"{width}\" height=\"{height}\"");
    Ok(text.replacen(&size(fine), &size((width, height)), 1))
}
