//! Draws the diagram of error against time, both on logarithmic axes.

use crate::configuration::StepControl;
use crate::row::Row;
use crate::svg::{ALARM, Anchor, Drawing, FAINT, GRID, INK, Marker};

/// A curve.
pub(super) struct Series<'a> {
    pub label: String,
    /// A second line of the legend.
    pub note: String,
    /// Whether that line is a warning.
    pub alarming: bool,
    pub colour: &'static str,
    pub marker: Marker,
    pub dashes: &'static str,
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

const WIDTH: f64 = 1000.0;
const LEFT: f64 = 92.0;
const RIGHT: f64 = 690.0;
const TOP: f64 = 84.0;
const BOTTOM: f64 = 520.0;
/// Height of the strip for failures, above the plot.
const STRIP: f64 = 66.0;
const LEGEND: f64 = 722.0;
const ENTRY: f64 = 37.0;

/// A logarithmic axis over whole decades.
struct Axis {
    low: i32,
    high: i32,
    from: f64,
    to: f64,
}

impl Axis {
    fn new(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let logs = values.filter(|x| *x > 0.0 && x.is_finite()).map(f64::log10);
        let (low, high) = logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
            (l.min(x), h.max(x))
        });
        let (low, high) = if low <= high {
            (low, high)
        } else {
            (-1.0, 0.0)
        };
        let (low, high) = ((low - 0.05).floor() as i32, (high + 0.05).ceil() as i32);
        Axis {
            low,
            high: high.max(low + 1),
            from,
            to,
        }
    }

    fn at(&self, value: f64) -> f64 {
        let low = f64::from(self.low);
        let part = (value.log10().max(low) - low) / f64::from(self.high - self.low);
        self.from + part.min(1.0) * (self.to - self.from)
    }

    /// Returns the decades with a label, at most as many as fit.
    fn decades(&self, most: i32) -> impl Iterator<Item = i32> {
        let every = ((self.high - self.low + most - 1) / most).max(1);
        (self.low..=self.high).filter(move |k| k % every == 0)
    }
}

/// Prints 10^k.
fn decade(k: i32) -> String {
    match k {
        -2..=4 => crate::format::number(10_f64.powi(k)),
        _ => format!("1e{k}"),
    }
}

impl Diagram<'_> {
    pub fn draw(&self) -> String {
        let legend = TOP + ENTRY * self.series.len() as f64 + 10.0;
        let mut d = Drawing::new(WIDTH, (BOTTOM + 66.0).max(legend));
        d.text((24.0, 32.0), 17, INK, Anchor::Start, &self.title);
        let (x, y) = self.axes();
        self.frame(&mut d, &x, &y);
        for series in &self.series {
            curve(&mut d, series, &x, &y, self.floor);
        }
        self.legend(&mut d);
        d.finish()
    }

    /// Returns the axes, with ranges that include all points.
    fn axes(&self) -> (Axis, Axis) {
        let rows = || {
            self.series
                .iter()
                .flat_map(|s| &s.rows)
                .filter(|r| r.holds())
        };
        let times = rows().filter_map(|r| r.ns);
        let failures = self.series.iter().flat_map(failures);
        let x = Axis::new(times.chain(failures), LEFT, RIGHT);
        let least = 0.3 * self.floor;
        let errors = rows().filter_map(|r| r.error).map(|e| e.max(least));
        let y = Axis::new(errors.chain([self.size]), BOTTOM, TOP);
        (x, y)
    }

    fn frame(&self, d: &mut Drawing, x: &Axis, y: &Axis) {
        for k in x.decades(9) {
            let at = x.at(10_f64.powi(k));
            d.line((at, TOP), (at, BOTTOM), GRID, "");
            d.text((at, BOTTOM + 20.0), 13, INK, Anchor::Middle, &decade(k));
        }
        for k in y.decades(10) {
            let at = y.at(10_f64.powi(k));
            d.line((LEFT, at), (RIGHT, at), GRID, "");
            d.text((LEFT - 8.0, at + 4.0), 13, INK, Anchor::End, &decade(k));
        }
        d.line((LEFT, BOTTOM), (RIGHT, BOTTOM), INK, "");
        d.line((LEFT, TOP), (LEFT, BOTTOM), INK, "");
        d.text(
            (0.5 * (LEFT + RIGHT), BOTTOM + 46.0),
            14,
            INK,
            Anchor::Middle,
            &self.x,
        );
        d.upright((24.0, 0.5 * (TOP + BOTTOM)), 14, &self.y);
        for (value, what) in [
            (self.size, "as large as the motion"),
            (self.floor, "rounding of f64"),
        ] {
            let at = y.at(value);
            if at < BOTTOM - 2.0 {
                d.line((LEFT, at), (RIGHT, at), FAINT, "6 4");
                d.text((RIGHT - 4.0, at - 5.0), 12, FAINT, Anchor::End, what);
            }
        }
        if self.series.iter().flat_map(failures).next().is_some() {
            d.rectangle((LEFT, STRIP - 12.0), (RIGHT - LEFT, 22.0), "#fdf0ea");
            d.text((LEFT - 8.0, STRIP + 3.0), 13, ALARM, Anchor::End, "failed");
        }
    }

    fn legend(&self, d: &mut Drawing) {
        for (i, series) in self.series.iter().enumerate() {
            let y = TOP + 6.0 + ENTRY * i as f64;
            let none = !series.rows.iter().any(|r| r.holds());
            let (from, to) = ((LEGEND, y), (LEGEND + 34.0, y));
            if none {
                d.marker((LEGEND + 17.0, y), Marker::Cross, series.colour);
            } else {
                d.curve(&[from, to], series.colour, series.dashes);
                d.marker((LEGEND + 17.0, y), series.marker, series.colour);
            }
            d.text(
                (LEGEND + 44.0, y + 4.0),
                14,
                INK,
                Anchor::Start,
                &series.label,
            );
            let (note, colour) = match none {
                true => ("no run follows the motion", ALARM),
                false if series.alarming => (series.note.as_str(), ALARM),
                false => (series.note.as_str(), FAINT),
            };
            d.text((LEGEND + 44.0, y + 19.0), 11, colour, Anchor::Start, note);
        }
    }
}

/// Draws a curve with its points, and its failures above.
fn curve(d: &mut Drawing, series: &Series<'_>, x: &Axis, y: &Axis, floor: f64) {
    let held = series.rows.iter().filter(|r| r.holds());
    let point = |r: &&Row| Some((x.at(r.ns?), y.at(r.error?.max(0.3 * floor))));
    let points: Vec<(f64, f64)> = held.filter_map(point).collect();
    d.curve(&points, series.colour, series.dashes);
    for &point in &points {
        d.marker(point, series.marker, series.colour);
    }
    for time in failures(series) {
        d.marker((x.at(time), STRIP - 1.0), Marker::Cross, series.colour);
    }
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
