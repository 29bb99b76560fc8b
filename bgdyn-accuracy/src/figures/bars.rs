//! Draws figures of rows with numbers: bars from zero, or dots on a logarithmic axis.
//!
//! Dots are used if the length of a bar would have no meaning.

use crate::format::short;
use crate::svg::{ALARM, Anchor, Drawing, FAINT, GRID, INK, Marker};

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
    pub scale: Scale,
}

impl Column {
    /// Returns a column of bars.
    pub fn bars(what: String, unit: String) -> Self {
        Column {
            title: [what, unit],
            scale: Scale::Linear,
        }
    }

    /// Returns a column of dots on a logarithmic axis.
    pub fn dots(what: String, unit: &str) -> Self {
        Column {
            title: [what, format!("{unit}, logarithmic")],
            scale: Scale::Log,
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Scale {
    /// Bars from zero.
    Linear,
    /// Dots.
    Log,
}

/// A figure of such lines.
pub(super) struct Bars {
    pub title: String,
    pub columns: Vec<Column>,
    pub lines: Vec<Line>,
    /// Whether the first line is the reference for the others.
    pub compared: bool,
}

const WIDTH: f64 = 1000.0;
const MARGIN: f64 = 24.0;
const TOP: f64 = 104.0;
const PITCH: f64 = 30.0;
const THICK: f64 = 15.0;
/// Widths for labels, and for the numbers behind bars and dots.
const LABELS: f64 = 190.0;
const NUMBERS: f64 = 62.0;
/// Space between two columns.
const GAP: f64 = 26.0;
const BAR: &str = "#0072b2";
const DOT: &str = "#d55e00";
/// Colour of the ranges of measured numbers: visible on bars and next to them.
const WHISKER: &str = "#e69f00";
/// Number of letters that fit beside a column.
const LETTERS: usize = 24;

impl Bars {
    pub fn draw(&self) -> String {
        let logarithmic = self.columns.iter().any(|c| c.scale == Scale::Log);
        let bottom = TOP + PITCH * self.lines.len() as f64;
        let mut d = Drawing::new(WIDTH, bottom + if logarithmic { 30.0 } else { 14.0 });
        d.text((MARGIN, 32.0), 17, INK, Anchor::Start, &self.title);
        for (i, line) in self.lines.iter().enumerate() {
            let y = TOP + PITCH * i as f64;
            d.line((MARGIN, y - 6.0), (WIDTH - MARGIN, y - 6.0), GRID, "");
            let at = (MARGIN + LABELS - 16.0, y + 13.0);
            match self.compared && i == 0 {
                true => d.bold(at, 13, INK, Anchor::End, &line.label),
                false => d.text(at, 13, INK, Anchor::End, &line.label),
            }
        }
        let count = self.columns.len() as f64;
        let width = (WIDTH - 2.0 * MARGIN - LABELS + GAP) / count - GAP;
        for (k, column) in self.columns.iter().enumerate() {
            let from = MARGIN + LABELS + (width + GAP) * k as f64;
            let [what, unit] = &column.title;
            d.text((from, TOP - 34.0), 14, INK, Anchor::Start, what);
            d.text((from, TOP - 16.0), 12, FAINT, Anchor::Start, unit);
            let ends = (from, from + width - NUMBERS);
            match column.scale {
                Scale::Linear => self.bars(&mut d, k, ends),
                Scale::Log => self.dots(&mut d, k, ends),
            }
        }
        self.failures(&mut d, width);
        d.finish()
    }

    /// Returns the numbers of a column, with the heights of their lines.
    fn numbers(&self, k: usize) -> impl Iterator<Item = (f64, Number)> {
        let lines = self.lines.iter().enumerate();
        lines.filter_map(move |(i, line)| Some((TOP + PITCH * i as f64, line.values[k]?)))
    }

    fn bars(&self, d: &mut Drawing, k: usize, (from, to): (f64, f64)) {
        let end = |x: Number| x.range.map_or(x.value, |[_, high]| high.max(x.value));
        let most = self.numbers(k).map(|(_, x)| end(x)).fold(0.0, f64::max);
        let place = |x: f64| from + (to - from) * x.max(0.0) / most.max(f64::MIN_POSITIVE);
        for (y, x) in self.numbers(k) {
            let length = (place(x.value) - from).max(1.0);
            d.rectangle((from, y), (length, THICK), BAR);
            if let Some([low, high]) = x.range {
                let (low, high, y) = (place(low), place(high), y + THICK / 2.0);
                d.line((low, y), (high, y), WHISKER, "");
                for x in [low, high] {
                    d.line((x, y - 4.0), (x, y + 4.0), WHISKER, "");
                }
            }
        }
        let bottom = TOP + PITCH * self.lines.len() as f64 - 6.0;
        let first = self.lines.first().and_then(|line| line.values[k]);
        let first = first.filter(|_| self.compared);
        if let Some(x) = first {
            let at = place(x.value);
            d.line((at, TOP + PITCH - 6.0), (at, bottom), INK, "4 3");
        }
        for (y, x) in self.numbers(k) {
            // Text is not placed on the dashed line.
            let beyond = first.map_or(0.0, |x| place(x.value));
            let own = place(end(x));
            let crossed = own < beyond && own + NUMBERS > beyond;
            let at = (if crossed { beyond } else { own } + 6.0, y + 12.5);
            let same = y > TOP && first.is_some_and(|first| first.overlaps(x));
            let text = format!("{}{}", if same { "≈ " } else { "" }, number(x.value));
            d.text(at, 13, INK, Anchor::Start, &text);
        }
        d.line((from, TOP - 6.0), (from, bottom), FAINT, "");
    }

    fn dots(&self, d: &mut Drawing, k: usize, (from, to): (f64, f64)) {
        let values = self.numbers(k).map(|(_, x)| x.value);
        let logs = values.filter(|x| *x > 0.0 && x.is_finite()).map(f64::log10);
        let (low, high) = logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
            (l.min(x), h.max(x))
        });
        let (low, high) = match low <= high {
            true => (
                low.floor() as i32,
                (high.ceil() as i32).max(low.floor() as i32 + 1),
            ),
            false => (-1, 0),
        };
        let span = f64::from(high - low);
        let place = |log: f64| from + (to - from) * (log - f64::from(low)) / span;
        let bottom = TOP + PITCH * self.lines.len() as f64 - 6.0;
        let every = (high - low + 3) / 4;
        for power in (low..=high).filter(|p| (p - low) % every == 0) {
            let at = place(f64::from(power));
            d.line((at, TOP - 6.0), (at, bottom), GRID, "");
            let text = match power {
                -2..=3 => format!("{}", 10_f64.powi(power)),
                _ => format!("1e{power}"),
            };
            d.text((at, bottom + 16.0), 11, FAINT, Anchor::Middle, &text);
        }
        d.line((from, bottom), (to, bottom), FAINT, "");
        for (y, x) in self.numbers(k).map(|(y, x)| (y, x.value)) {
            if x > 0.0 && x.is_finite() {
                let at = place(x.log10());
                d.marker((at, y + 8.0), Marker::Circle, DOT);
                d.text((at + 10.0, y + 12.5), 13, INK, Anchor::Start, &short(x));
            } else {
                d.text((from, y + 12.5), 13, FAINT, Anchor::Start, &short(x));
            }
        }
    }

    /// Draws the reasons in the last column, shortened if there is no space; the tooltip shows the whole
    /// text.
    fn failures(&self, d: &mut Drawing, width: f64) {
        let from = WIDTH - MARGIN - width;
        let letters = (LETTERS as f64 * (width / 170.0).max(1.0)) as usize;
        for (i, line) in self.lines.iter().enumerate() {
            let Some(why) = &line.failed else { continue };
            let whole = format!("failed: {why}");
            let shown = match whole.chars().count() > letters {
                true => whole.chars().take(letters - 1).chain(['…']).collect(),
                false => whole.clone(),
            };
            let at = (from, TOP + PITCH * i as f64 + 12.5);
            d.group(&whole);
            d.text(at, 12, ALARM, Anchor::Start, &shown);
            d.end_group();
        }
    }
}

/// Prints a number; integers below a million with all digits.
fn number(x: f64) -> String {
    match x.fract() == 0.0 && x.abs() < 1e6 {
        true => format!("{x}"),
        false => short(x),
    }
}
