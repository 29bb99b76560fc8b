//! Axes: ranges, scales, ticks and their texts.

use std::ops::Range;

use plotters::coord::ranged1d::{
    BoldPoints, KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter,
};
use plotters::coord::types::RangedCoordf64;

use bgdyn_runtime::Digits;

use crate::format::number;

/// The size of numbers up to which a range is drawn as it is; smaller ones than its reciprocal are zero.
const LARGEST: f64 = 1e250;

/// An axis: its range, its scale, its ticks, its label.
///
/// Points beyond the range are drawn at its ends.
#[derive(Clone, Debug)]
pub struct Axis {
    scale: Scale,
    /// Ends of the axis, in the numbers that the scale makes of values.
    low: f64,
    high: f64,
    /// Values, and the texts beside them.
    ticks: Vec<(f64, String)>,
    /// Whether a line through the panel marks each tick.
    pub(super) lines: bool,
    /// The text along the axis.
    pub(super) label: String,
}

#[derive(Clone, Copy, Debug)]
enum Scale {
    /// (value − offset)/10^exponent.
    Linear { offset: f64, exponent: i32 },
    /// log₁₀ of the value.
    Log,
}

impl Scale {
    fn of(self, value: f64) -> f64 {
        match self {
            Scale::Linear { offset, exponent } => (value - offset) / 10_f64.powi(exponent),
            Scale::Log => value.log10(),
        }
    }

    fn value(self, number: f64) -> f64 {
        match self {
            Scale::Linear { offset, exponent } => offset + number * 10_f64.powi(exponent),
            Scale::Log => 10_f64.powf(number),
        }
    }
}

impl Axis {
    fn new(scale: Scale, low: f64, high: f64, ticks: Vec<(f64, String)>) -> Self {
        Axis {
            scale,
            low,
            high,
            ticks,
            lines: matches!(scale, Scale::Log),
            label: String::new(),
        }
    }

    /// Returns an axis from `low` to `high`, with at most `most` ticks.
    ///
    /// Large and small numbers are shown in units of a power of ten, and a small range of large numbers
    /// from an offset: [`Axis::quantity`] and [`Axis::unit`] state them.
    pub fn linear(low: f64, high: f64, most: usize) -> Self {
        let size = low.abs().max(high.abs());
        let change = high - low;
        // No more digits than the range has use for: numbers are shown as differences from it.
        let digits = (size / change).log10().ceil();
        let offset = match change > 1e-12 * size && change < 1e-3 * size {
            true => Digits::new(low, digits as usize)
                .to_string()
                .parse()
                .unwrap_or(0.0),
            false => 0.0,
        };
        let shown = if offset == 0.0 { size } else { change };
        let exponent = match shown {
            0.0 => 0,
            _ if (0.01..1e4).contains(&shown) => 0,
            _ => 3 * (shown.log10() / 3.0).floor() as i32,
        };
        let scale = Scale::Linear { offset, exponent };
        let (low, high) = (scale.of(low), scale.of(high));
        let ticks = linear_ticks(low, high, most).into_iter();
        let ticks = ticks.map(|(number, text)| (scale.value(number), text));
        Axis::new(scale, low, high, ticks.collect())
    }

    /// Returns a linear axis over values, with a margin at both ends and at most `most` ticks. Values that
    /// are no finite numbers are left out.
    pub fn around(values: impl IntoIterator<Item = f64>, most: usize) -> Self {
        let (low, high) =
            ends(values.into_iter().filter(|x| x.abs() < LARGEST)).unwrap_or_default();
        let size = low.abs().max(high.abs());
        if size < 1.0 / LARGEST {
            return Axis::linear(-0.5, 0.5, most);
        }
        let margin = match high - low <= 1e-12 * size {
            true => 0.1 * size,
            false => 0.08 * (high - low),
        };
        Axis::linear(low - margin, high + margin, most)
    }

    /// Returns a logarithmic axis from `low` to `high`, with at most `most` ticks.
    pub fn log(low: f64, high: f64, most: usize) -> Self {
        let (low, high) = (low.log10(), high.log10());
        Axis::new(Scale::Log, low, high, log_ticks(low, high, most))
    }

    /// Returns a logarithmic axis over whole decades around values, with at most `most` ticks. Values that
    /// are not positive are left out.
    pub fn decades(values: impl IntoIterator<Item = f64>, most: usize) -> Self {
        let logs = values.into_iter().map(f64::log10);
        let (low, high) = ends(logs.filter(|x| x.is_finite())).unwrap_or((-1.0, 0.0));
        let (low, high) = ((low - 0.05).floor(), (high + 0.05).ceil());
        Axis::new(Scale::Log, low, high, log_ticks(low, high, most))
    }

    /// Returns a vertical axis of this number of rows, the first on top: row i is from i to i + 1. It has
    /// no ticks.
    pub fn rows(count: usize) -> Self {
        Axis::linear(0.0, count as f64, 1).bare().reversed()
    }

    /// Returns the axis without its ticks; a horizontal axis is not drawn then.
    pub fn bare(self) -> Self {
        let ticks = Vec::new();
        Axis { ticks, ..self }
    }

    pub(super) fn is_bare(&self) -> bool {
        self.ticks.is_empty()
    }

    /// Returns the axis with a text along it.
    pub fn label(self, label: impl Into<String>) -> Self {
        let label = label.into();
        Axis { label, ..self }
    }

    /// Returns the axis in the other direction: its numbers grow to the left, or downwards.
    pub fn reversed(self) -> Self {
        let (low, high) = (self.high, self.low);
        Axis { low, high, ..self }
    }

    /// Returns the axis with a line through the panel at each tick; logarithmic axes and vertical ones
    /// have them.
    pub fn lines(self) -> Self {
        let lines = true;
        Axis { lines, ..self }
    }

    /// Returns the name of the quantity that the numbers show: the name, less the axis's offset.
    pub fn quantity(&self, name: &str) -> String {
        match self.scale {
            Scale::Linear { offset, .. } if offset != 0.0 => {
                let sign = if offset < 0.0 { '+' } else { '−' };
                let offset = Digits::shortest(offset.abs()).plain(-3..7);
                format!("{name} {sign} {offset}")
            }
            _ => name.to_owned(),
        }
    }

    /// Returns the unit of the numbers: the unit with the axis's power of ten.
    pub fn unit(&self, unit: &str) -> String {
        match self.scale {
            Scale::Linear { exponent, .. } if exponent != 0 => {
                format!("{} {unit}", power(exponent)).trim_end().to_owned()
            }
            _ => unit.to_owned(),
        }
    }
}

impl Ranged for Axis {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        let part = (self.scale.of(*value) - self.low) / (self.high - self.low);
        from + (part.clamp(0.0, 1.0) * f64::from(to - from)).round() as i32
    }

    fn key_points<H: KeyPointHint>(&self, hint: H) -> Vec<f64> {
        // Lines between the ticks are not drawn.
        match hint.weight().allow_light_points() {
            true => Vec::new(),
            false => self.ticks.iter().map(|tick| tick.0).collect(),
        }
    }

    fn range(&self) -> Range<f64> {
        self.scale.value(self.low)..self.scale.value(self.high)
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        let tick = self.ticks.iter().find(|tick| tick.0 == *value);
        tick.map_or(String::new(), |tick| tick.1.clone())
    }
}

/// Returns the smallest and the largest value.
fn ends(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let pairs = values.map(|x| (x, x));
    pairs.reduce(|(low, high), (x, _)| (low.min(x), high.max(x)))
}

/// Returns round numbers from `low` to `high`, at most `most`, with their texts.
fn linear_ticks(low: f64, high: f64, most: usize) -> Vec<(f64, String)> {
    let numbers = RangedCoordf64::from(low..high).key_points(BoldPoints(most));
    // 0.3, not 0.30000000000000004; 0, not −0.
    let round = numbers.into_iter().map(|x| (x * 1e9).round() / 1e9 + 0.0);
    let text = |x: f64| {
        Digits::shortest(x)
            .plain(-4..7)
            .to_string()
            .replace('-', "−")
    };
    round.map(|x| (x, text(x))).collect()
}

/// Returns values between two powers of ten, at most `most`: whole decades, or, if there are few, the
/// numbers 1, 2, 5 in each.
fn log_ticks(low: f64, high: f64, most: usize) -> Vec<(f64, String)> {
    let (first, last) = ((low - 1e-9).ceil() as i32, (high + 1e-9).floor() as i32);
    let plain = (-3..=4).contains(&first) && (-3..=4).contains(&last);
    let fine = (first - 1..=last).flat_map(|k| [1.0, 2.0, 5.0].map(|m| m * 10_f64.powi(k)));
    let inside = |x: &f64| (low - 1e-9..=high + 1e-9).contains(&x.log10());
    let fine: Vec<f64> = fine.filter(inside).collect();
    if plain && fine.len() <= most && last - first < 3 {
        let round = |x: f64| (number(x).parse().unwrap_or(x), number(x));
        return fine.into_iter().map(round).collect();
    }
    let every = ((last - first) / most as i32 + 1).max(1);
    let tick = |k: i32| match plain {
        true => (10_f64.powi(k), number(10_f64.powi(k))),
        false => (10_f64.powi(k), power(k)),
    };
    let shown = (first..=last).filter(|k| k % every == 0);
    shown.map(tick).collect()
}

/// Prints ten to an integer power: `10⁻⁶`.
fn power(exponent: i32) -> String {
    let raised = |c: char| match c.to_digit(10) {
        Some(digit) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize],
        None => '⁻',
    };
    let digits = exponent.to_string();
    format!("10{}", digits.chars().map(raised).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_numbers_on_the_axis() {
        for (low, high) in [
            (0.0, 5.0),
            (-1.2e-5, 3.4e-5),
            (1e6, 1e6 + 1.0),
            (2.0, 2.0),
            (0.0, 0.0),
            (-7e9, 4e8),
        ] {
            let axis = Axis::around([low, high], 6);
            let count = axis.ticks.len();
            assert!((2..=7).contains(&count), "{axis:?}");
            for (value, text) in &axis.ticks {
                let x = axis.scale.of(*value);
                assert!(x >= axis.low - 1e-6 && x <= axis.high + 1e-6, "{axis:?}");
                let shown: f64 = text.replace('−', "-").parse().expect("a number");
                assert!((shown - x).abs() <= 1e-6 * x.abs().max(1e-3), "{axis:?}");
            }
            let texts: std::collections::BTreeSet<_> = axis.ticks.iter().map(|t| &t.1).collect();
            assert_eq!(texts.len(), count, "{axis:?}");
            // The margins leave both values inside, in their order.
            let [from, to] = [low, high].map(|value| axis.map(&value, (0, 1000)));
            assert!(0 < from && to < 1000, "{axis:?}: {from}, {to}");
            assert_eq!(from < to, low < high, "{axis:?}: {from}, {to}");
        }
    }

    fn texts(axis: &Axis) -> Vec<&str> {
        axis.ticks.iter().map(|tick| tick.1.as_str()).collect()
    }

    #[test]
    fn numbers_have_the_shortest_text() {
        assert_eq!(
            texts(&Axis::linear(0.0, 5.0, 9)),
            ["0", "1", "2", "3", "4", "5"]
        );
        assert_eq!(
            texts(&Axis::decades([0.02, 30.0], 9)),
            ["0.01", "0.1", "1", "10", "100"]
        );
        assert_eq!(
            texts(&Axis::decades([2e-9, 3e-6], 9)),
            ["10⁻⁹", "10⁻⁸", "10⁻⁷", "10⁻⁶", "10⁻⁵"]
        );
        assert_eq!(texts(&Axis::log(0.9, 25.0, 9)), ["1", "2", "5", "10", "20"]);
    }

    #[test]
    fn a_small_range_of_large_numbers_has_an_offset() {
        let axis = Axis::around([1e6, 1e6 + 1.0], 6);
        assert_eq!(axis.quantity("x"), "x − 1000000");
        assert_eq!(Axis::linear(0.0, 2e5, 6).unit("Pa"), "10³ Pa");
    }

    #[test]
    fn values_beyond_the_range_are_drawn_at_its_ends() {
        let axis = Axis::decades([1e-3, 1.0], 9);
        assert_eq!(
            [0.0, 1e-9, 1e9].map(|x| axis.map(&x, (10, 90))),
            [10, 10, 90]
        );
    }
}
