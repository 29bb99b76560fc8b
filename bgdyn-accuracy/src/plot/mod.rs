//! Plots with axes as SVG, for light and dark pages: the crate `plotters` with one look for all of them.
//!
//! [`draw`] makes a drawing. [`Panel`] draws axes in an area of it and returns their chart. [`curve`],
//! [`mark`] and the elements of `plotters` take data coordinates in the chart's
//! [`plotting_area`](ChartContext::plotting_area), and [`at`] positions in pixels in other areas.
//!
//! ```
//! use bgdyn_accuracy::plot::{Axis, BLUE, Panel, Stroke, curve, draw};
//!
//! let points = [(0.0, 1.0), (1.0, 1e-3), (2.0, 1e-6)];
//! let svg = draw((400, 250), |area| {
//!     let x = Axis::linear(0.0, 2.0, 5).label("time, s");
//!     let y = Axis::decades(points.map(|p| p.1), 8).label("error, m");
//!     let chart = Panel::new("A run", x, y).draw(area)?;
//!     curve(chart.plotting_area(), points, BLUE.into())
//! });
//! assert!(svg.contains("10⁻⁶"));
//! ```

mod axis;
mod legend;
mod panel;
mod style;

use plotters::coord::Shift;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::{
    Cartesian2d, ChartContext, DrawingArea, IntoDrawingArea, SVGBackend, WHITE,
};

use crate::dark::with_dark_mode;
use crate::format::escaped;

pub use axis::Axis;
pub use legend::{Sign, legend, name_ends, sign};
pub use panel::{Panel, place_in};
pub use plotters;
pub use plotters::style::RGBColor;
pub use style::{
    ALARM, BLUE, FAINT, GREEN, GRID, INK, Marker, ORANGE, PURPLE, SKY, Stroke, VERMILION, bold,
    centred, curve, mark, right_aligned, text, write,
};

/// A part of a drawing. Units are those of [`px`].
pub type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// The axes of a panel.
pub type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<Axis, Axis>>;

/// What drawing returns.
pub type Drawn<T = ()> = Result<T, DrawingAreaErrorKind<std::io::Error>>;

/// Returns the SVG text of a drawing with this width and height in pixels, on a white ground; dark pages
/// get its dark counterpart.
pub fn draw(size: (u32, u32), body: impl FnOnce(&Area<'_>) -> Drawn) -> String {
    let mut svg = String::new();
    let whole = |svg| -> Drawn {
        let root = SVGBackend::with_string(svg, (px(size.0), px(size.1))).into_drawing_area();
        root.fill(&WHITE)?;
        body(&root)?;
        root.present()
    };
    // Only files have errors, and fonts that the SVG text would contain.
    whole(&mut svg).expect("a drawing that is kept as text");
    // What every shape and text would repeat.
    let font = " font-family=\"sans-serif\"";
    let svg = svg.replace(" opacity=\"1\"", "").replace(font, "");
    // The view box retains the units.
    let root = |unit| {
        format!(
            "<svg width=\"{}\" height=\"{}\"",
            unit * size.0,
            unit * size.1
        )
    };
    let shown = format!("{}{font}", root(1));
    with_dark_mode(&svg.replacen(&root(FINE), &shown, 1))
}

/// Units per pixel: `plotters` has whole ones.
const FINE: u32 = 10;

/// Converts whole pixels to the drawing's units.
pub const fn px(pixels: u32) -> u32 {
    FINE * pixels
}

/// Converts a position in pixels, x to the right and y down, to the drawing's units.
pub fn at(x: f64, y: f64) -> (i32, i32) {
    let fine = |x: f64| (f64::from(FINE) * x).round() as i32;
    (fine(x), fine(y))
}

/// Gives a text in the drawing a tooltip: the first one that reads `shown` and has none.
pub fn with_tooltip(svg: &str, shown: &str, tooltip: &str) -> String {
    // As `plotters` writes it.
    let quoted = |words: &str| {
        escaped(words)
            .replace('"', "&quot;")
            .replace('\'', "&apos;")
    };
    let [shown, tooltip] = [shown, tooltip].map(quoted);
    let titled = format!(">\n<title>{tooltip}</title>{shown}\n</text>");
    svg.replacen(&format!(">\n{shown}\n</text>"), &titled, 1)
}
