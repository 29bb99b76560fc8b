//! Draws figures of rows with numbers: bars from zero, or dots on a logarithmic axis.
//!
//! Dots are used if the length of a bar would have no meaning.

use plotters::prelude::{Color, Rectangle};

use crate::format::short;
use crate::plot::{
    ALARM, Area, Axis, BLUE, Chart, Drawn, FAINT, GRID, INK, Marker, ORANGE, Panel, Stroke,
    VERMILION, at, bold, curve, draw, mark, px, right_aligned, text, with_tooltip, write,
};

/// A line.
pub(super) struct Line {
    pub label: String,
    /// A number for each column.
    pub values: Vec<Option<Number>>,
    /// The reason why the last column has no number.
    pub failed: Option<String>,
}

impl Line {
    /// Returns numbers without ranges.
    pub fn numbers<const N: usize>(values: [Option<f64>; N]) -> Vec<Option<Number>> {
        values.map(|value| value.map(Number::exact)).to_vec()
    }

    /// Returns the number in a column.
    pub fn value(&self, k: usize) -> Option<f64> {
        self.values[k].map(|number| number.value)
    }
}

/// A number, with the range of its measurements if it was measured.
#[derive(Clone, Copy)]
pub(super) struct Number {
    pub value: f64,
    pub range: Option<[f64; 2]>,
}

impl Number {
    /// Returns a number without a range.
    pub fn exact(value: f64) -> Self {
        Number { value, range: None }
    }

    /// Returns whether the ranges of two measured numbers overlap.
    fn overlaps(self, other: Number) -> bool {
        match (self.range, other.range) {
            (Some([a, b]), Some([c, d])) => a <= d && c <= b,
            _ => false,
        }
    }
}

/// A column.
pub(super) struct Column {
    /// Its quantity, and its reference or unit.
    pub title: [String; 2],
    pub shape: Shape,
}

impl Column {
    /// Returns a column of bars.
    pub fn bars(what: String, unit: String) -> Self {
        Column {
            title: [what, unit],
            shape: Shape::Bars,
        }
    }

    /// Returns a column of dots on a logarithmic axis.
    pub fn dots(what: String, unit: &str) -> Self {
        Column {
            title: [what, format!("{unit}, logarithmic")],
            shape: Shape::Dots,
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Shape {
    /// Bars from zero.
    Bars,
    /// Dots on a logarithmic axis.
    Dots,
}

/// A figure of such lines.
pub(super) struct Bars {
    pub title: String,
    pub columns: Vec<Column>,
    pub lines: Vec<Line>,
    /// Whether the first line is the reference for the others.
    pub compared: bool,
}

const WIDTH: u32 = 1000;
const MARGIN: f64 = 24.0;
const TOP: u32 = 98;
const ROW: u32 = 30;
/// Widths for labels, for the numbers behind bars and dots, and between columns.
const LABELS: f64 = 190.0;
const NUMBERS: f64 = 62.0;
const GAP: f64 = 26.0;
/// Number of letters that fit beside a column.
const LETTERS: usize = 24;

impl Bars {
    pub fn draw(&self) -> String {
        let logarithmic = self.columns.iter().any(|c| c.shape == Shape::Dots);
        let below = if logarithmic { 30 } else { 14 };
        let height = TOP + ROW * self.lines.len() as u32 + below;
        let svg = draw((WIDTH, height), |area| {
            write(area, (MARGIN, 27.0), &self.title, text(17, INK))?;
            self.labels(area)?;
            for k in 0..self.columns.len() {
                self.column(area, k, below)?;
            }
            self.failures(area)
        });
        // The reasons of failures are shortened in the drawing.
        let reasons = self.lines.iter().filter_map(|line| line.failed.as_ref());
        reasons.fold(svg, |svg, why| {
            let (shown, whole) = self.failure(why);
            with_tooltip(&svg, &shown, &whole)
        })
    }

    /// Returns the distance between columns, and their width.
    fn columns(&self) -> (f64, f64) {
        let all = f64::from(WIDTH) - 2.0 * MARGIN - LABELS + GAP;
        let distance = all / self.columns.len() as f64;
        (distance, distance - GAP)
    }

    fn labels(&self, area: &Area<'_>) -> Drawn {
        for (i, line) in self.lines.iter().enumerate() {
            let top = f64::from(TOP + ROW * i as u32);
            let ends = [at(MARGIN, top), at(f64::from(WIDTH) - MARGIN, top)];
            curve(area, ends, Stroke::new(GRID, 1.0))?;
            let style = match self.compared && i == 0 {
                true => right_aligned(bold(13, INK)),
                false => right_aligned(text(13, INK)),
            };
            let place = (MARGIN + LABELS - 16.0, top + 15.0);
            write(area, place, &line.label, style)?;
        }
        Ok(())
    }

    fn column(&self, area: &Area<'_>, k: usize, below: u32) -> Drawn {
        let (distance, width) = self.columns();
        let left = MARGIN + LABELS + distance * k as f64;
        let [what, unit] = &self.columns[k].title;
        let above = f64::from(TOP);
        write(area, (left, above - 33.0), what, text(14, INK))?;
        write(area, (left, above - 14.0), unit, text(11, FAINT))?;
        let rows = Axis::rows(self.lines.len());
        let right = f64::from(WIDTH) - (left + width - NUMBERS);
        let panel = |x: Axis, below: u32| {
            let sides = [left as u32, right as u32, TOP, below];
            Panel::new("", x, rows.clone()).sides(sides).draw(area)
        };
        let numbers = self.lines.iter().map(|line| line.values[k]);
        match self.columns[k].shape {
            Shape::Bars => {
                let most = numbers.flatten().map(end).fold(f64::MIN_POSITIVE, f64::max);
                self.bars(area, k, &panel(Axis::linear(0.0, most, 1).bare(), below)?)
            }
            Shape::Dots => {
                let values = numbers.flatten().map(|x| x.value);
                self.dots(area, k, &panel(Axis::decades(values, 4), below)?)
            }
        }
    }

    /// Returns the numbers of a column, with the middles of their rows.
    fn numbers(&self, k: usize) -> impl Iterator<Item = (f64, Number)> {
        let lines = self.lines.iter().enumerate();
        lines.filter_map(move |(i, line)| Some((i as f64 + 0.5, line.values[k]?)))
    }

    fn bars(&self, area: &Area<'_>, k: usize, chart: &Chart<'_>) -> Drawn {
        let inside = chart.plotting_area();
        for (y, x) in self.numbers(k) {
            let bar = [(0.0, y - 0.25), (x.value, y + 0.25)];
            inside.draw(&Rectangle::new(bar, BLUE.filled()))?;
            if let Some([low, high]) = x.range {
                // A colour that is visible on bars and next to them.
                let whisker = Stroke::new(ORANGE, 1.0);
                curve(inside, [(low, y), (high, y)], whisker)?;
                for x in [low, high] {
                    curve(inside, [(x, y - 0.13), (x, y + 0.13)], whisker)?;
                }
            }
        }
        let first = self.lines.first().and_then(|line| line.values[k]);
        let first = first.filter(|_| self.compared);
        if let Some(x) = first {
            let ends = [(x.value, 1.0), (x.value, self.lines.len() as f64)];
            curve(inside, ends, Stroke::new(INK, 1.0).dashed(4.0, 3.0))?;
        }
        for (y, x) in self.numbers(k) {
            // Text is not placed on the dashed line.
            let place = |x: f64| chart.backend_coord(&(x, y));
            let (own, height) = place(end(x));
            let (beyond, _) = first.map_or((0, 0), |x| place(x.value));
            let crossed = own < beyond && own + px(NUMBERS as u32) as i32 > beyond;
            let from = if crossed { beyond } else { own } + px(6) as i32;
            let same = y > 1.0 && first.is_some_and(|first| first.overlaps(x));
            let words = format!("{}{}", if same { "≈ " } else { "" }, number(x.value));
            area.draw_text(&words, &text(13, INK), (from, height))?;
        }
        Ok(())
    }

    fn dots(&self, area: &Area<'_>, k: usize, chart: &Chart<'_>) -> Drawn {
        let least = chart.x_range().start;
        for (y, x) in self.numbers(k).map(|(y, x)| (y, x.value)) {
            let drawn = x > 0.0 && x.is_finite();
            let place = (if drawn { x } else { least }, y);
            if drawn {
                mark(chart.plotting_area(), place, Marker::Disc, VERMILION)?;
            }
            let (left, height) = chart.backend_coord(&place);
            let (colour, beside) = if drawn { (INK, px(10)) } else { (FAINT, 0) };
            let style = text(13, colour);
            area.draw_text(&short(x), &style, (left + beside as i32, height))?;
        }
        Ok(())
    }

    /// Writes the reasons in the last column.
    fn failures(&self, area: &Area<'_>) -> Drawn {
        let left = f64::from(WIDTH) - MARGIN - self.columns().1 + 8.0;
        for (i, line) in self.lines.iter().enumerate() {
            let Some(why) = &line.failed else { continue };
            let place = (left, f64::from(TOP + ROW * i as u32) + 15.0);
            write(area, place, &self.failure(why).0, text(11, ALARM))?;
        }
        Ok(())
    }

    /// Returns a reason, shortened if there is no space, and the whole text.
    fn failure(&self, why: &str) -> (String, String) {
        let letters = (LETTERS as f64 * (self.columns().1 / 170.0).max(1.0)) as usize;
        let whole = format!("failed: {why}");
        match whole.chars().count() > letters {
            true => (
                whole.chars().take(letters - 1).chain(['…']).collect(),
                whole,
            ),
            false => (whole.clone(), whole),
        }
    }
}

/// Returns the right end of a bar with its range.
fn end(x: Number) -> f64 {
    x.range.map_or(x.value, |[_, high]| high.max(x.value))
}

/// Prints a number; integers below a million with all digits.
fn number(x: f64) -> String {
    match x.fract() == 0.0 && x.abs() < 1e6 {
        true => format!("{x}"),
        false => short(x),
    }
}
