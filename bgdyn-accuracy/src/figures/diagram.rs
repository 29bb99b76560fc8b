//! Draws the diagram of error against time, both on logarithmic axes.

use plotters::prelude::{Color, Rectangle};

use crate::configuration::StepControl;
use crate::plot::{
    ALARM, Area, Axis, Chart, Drawn, FAINT, INK, Marker, Panel, RGBColor, Sign, Stroke, at, curve,
    draw, mark, right_aligned, sign, text, write,
};
use crate::row::Row;

/// A curve.
pub(super) struct Series<'a> {
    pub label: String,
    /// A second line of the legend.
    pub note: String,
    /// Whether that line is a warning.
    pub alarming: bool,
    pub stroke: Stroke,
    pub marker: Marker,
    /// The rows, from the coarsest to the finest.
    pub rows: Vec<&'a Row>,
}

/// A diagram of work and precision.
pub(super) struct Diagram<'a> {
    pub title: String,
    pub x: String,
    pub y: String,
    /// The size of the motion of the output.
    pub size: f64,
    /// Errors below this are rounding in `f64`.
    pub floor: f64,
    pub series: Vec<Series<'a>>,
}

const WIDTH: u32 = 1000;
/// Height of the axes with their labels.
const HEIGHT: u32 = 568;
/// Left edge of the frame, and the margin above it.
const LEFT: f64 = 92.0;
const TOP: f64 = 84.0;
/// Height of the strip for failures, above the frame.
const STRIP: f64 = 65.0;
const LEGEND: f64 = 722.0;
const ENTRY: f64 = 37.0;
/// Colour of this strip.
const FAILED: RGBColor = RGBColor(253, 240, 234);

impl Diagram<'_> {
    pub fn draw(&self) -> String {
        let legend = (TOP + ENTRY * self.series.len() as f64) as u32 + 10;
        draw((WIDTH, HEIGHT.max(legend)), |area| {
            write(area, (24.0, 27.0), &self.title, text(17, INK))?;
            let chart = self.axes(area)?;
            for series in &self.series {
                self.curve(area, &chart, series)?;
            }
            self.legend(area)
        })
    }

    /// Draws the axes, with ranges that include all points, and the lines of reference.
    fn axes<'a>(&self, area: &Area<'a>) -> Drawn<Chart<'a>> {
        let rows = || self.series.iter().flat_map(|s| &s.rows);
        let times = rows().filter(|r| r.holds()).filter_map(|r| r.ns);
        let failures: Vec<f64> = self.series.iter().flat_map(failures).collect();
        let x = Axis::decades(times.chain(failures.iter().copied()), 9);
        let errors = rows().filter(|r| r.holds()).filter_map(|r| r.error);
        let errors = errors.map(|error| self.shown(error));
        let y = Axis::decades(errors.chain([self.size]), 10);
        let sides = [LEFT as u32, WIDTH - 690, TOP as u32, 48];
        let panel = Panel::new("", x.label(&self.x), y.label(&self.y)).sides(sides);
        let chart = panel.draw(&area.split_vertically(10 * HEIGHT).0)?;
        let ([left, right], low) = (ends(&chart), chart.y_range().start);
        for (value, what) in [
            (self.size, "as large as the motion"),
            (self.floor, "rounding of f64"),
        ] {
            if value > 1.05 * low {
                let line = Stroke::new(FAINT, 1.0).dashed(6.0, 4.0);
                let (_, y) = chart.backend_coord(&(1.0, value));
                curve(area, [(left, y), (right, y)], line)?;
                let (dx, dy) = at(4.0, 9.0);
                let style = right_aligned(text(11, FAINT));
                area.draw_text(what, &style, (right - dx, y - dy))?;
            }
        }
        if !failures.is_empty() {
            let (_, top) = at(0.0, STRIP - 11.0);
            let (_, bottom) = at(0.0, STRIP + 11.0);
            let strip = [(left, top), (right, bottom)];
            area.draw(&Rectangle::new(strip, FAILED.filled()))?;
            let style = right_aligned(text(13, ALARM));
            write(area, (LEFT - 8.0, STRIP), "failed", style)?;
        }
        Ok(chart)
    }

    /// Returns an error as it is drawn: far below rounding they are all the same.
    fn shown(&self, error: f64) -> f64 {
        error.max(0.3 * self.floor)
    }

    /// Draws a curve with its points, and its failures above.
    fn curve(&self, area: &Area<'_>, chart: &Chart<'_>, series: &Series<'_>) -> Drawn {
        let held = series.rows.iter().filter(|r| r.holds());
        let point = |r: &&Row| Some((r.ns?, self.shown(r.error?)));
        let points: Vec<(f64, f64)> = held.filter_map(point).collect();
        let inside = chart.plotting_area();
        curve(inside, points.iter().copied(), series.stroke)?;
        for point in points {
            mark(inside, point, series.marker, series.stroke.colour)?;
        }
        for time in failures(series) {
            let (x, _) = chart.backend_coord(&(time, 1.0));
            let (_, y) = at(0.0, STRIP);
            mark(area, (x, y), Marker::Cross, series.stroke.colour)?;
        }
        Ok(())
    }

    fn legend(&self, area: &Area<'_>) -> Drawn {
        for (i, series) in self.series.iter().enumerate() {
            let y = TOP + 6.0 + ENTRY * i as f64;
            let none = !series.rows.iter().any(|r| r.holds());
            let what = match none {
                true => Sign::Points(Marker::Cross, series.stroke.colour),
                false => Sign::Curve(series.stroke, series.marker),
            };
            sign(area, (LEGEND, y), what)?;
            let label = (LEGEND + 44.0, y - 1.0);
            write(area, label, &series.label, text(14, INK))?;
            let (note, colour) = match none {
                true => ("no run follows the motion", ALARM),
                false if series.alarming => (series.note.as_str(), ALARM),
                false => (series.note.as_str(), FAINT),
            };
            let style = text(11, colour);
            write(area, (LEGEND + 44.0, y + 15.0), note, style)?;
        }
        Ok(())
    }
}

/// Returns the left and right end of a chart's frame, in the drawing's units.
fn ends(chart: &Chart<'_>) -> [i32; 2] {
    let (x, _) = chart.plotting_area().get_pixel_range();
    [x.start, x.end]
}

/// Returns the times at which failed runs are drawn: that of the nearest successful run, multiplied by the
/// ratio of their steps. A failed tolerance has no such ratio and is drawn at that run's time.
fn failures(series: &Series<'_>) -> impl Iterator<Item = f64> {
    let held = series.rows.iter().filter(|r| r.holds());
    let first = held
        .clone()
        .next()
        .and_then(|r| Some((r.step_control, r.ns?)));
    let failed = series.rows.iter().filter(|r| !r.holds());
    failed.filter_map(move |r| match (first?, r.step_control) {
        ((StepControl::Step(h), ns), StepControl::Step(failed)) => Some(ns * h / failed),
        ((_, ns), _) => Some(ns),
    })
}
