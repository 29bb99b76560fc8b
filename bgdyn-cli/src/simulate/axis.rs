//! Axes of plots: ranges, scales, tick labels.

use super::report::short;

/// Values larger than this, or smaller than its reciprocal, are not shown.
pub(super) const LARGEST: f64 = 1e250;

/// The conversion of values to numbers of an axis: (value − offset)/10^exponent.
pub(super) struct Axis {
    offset: f64,
    exponent: i32,
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Axis {
    /// Returns an axis for values in this range, with a margin on both sides.
    pub(super) fn new((low, high): (f64, f64)) -> Self {
        let (low, high) = if low <= high { (low, high) } else { (0.0, 0.0) };
        let size = low.abs().max(high.abs());
        let (low, high, size) = match size < 1.0 / LARGEST {
            true => (0.0, 0.0, 0.0),
            false => (low, high, size),
        };
        // A small change of a large value is shown as a difference.
        let change = high - low;
        let flat = change <= 1e-12 * size;
        let offset = if !flat && change < 1e-3 * size {
            low
        } else {
            0.0
        };
        let shown = if offset == 0.0 { size } else { change };
        let exponent = match shown {
            0.0 => 0,
            _ if (0.01..1e4).contains(&shown) => 0,
            _ => 3 * (shown.log10() / 3.0).floor() as i32,
        };
        let scale = 10_f64.powi(exponent);
        let (low, high) = ((low - offset) / scale, (high - offset) / scale);
        let span = match flat {
            true => (0.2 * size / scale).max(if size == 0.0 { 1.0 } else { 0.0 }),
            false => high - low,
        };
        let margin = if flat { 0.5 * span } else { 0.08 * span };
        Axis {
            offset,
            exponent,
            low: low - margin,
            high: high + margin,
        }
    }

    /// Returns the same without a margin, for time.
    pub(super) fn tight(low: f64, high: f64) -> Self {
        let axis = Axis::new((low, high));
        Axis {
            low: axis.of(low),
            high: axis.of(high),
            ..axis
        }
    }

    /// Returns round numbers on the axis, at most `most`, with their labels.
    pub(super) fn ticks(&self, most: usize) -> Vec<(f64, String)> {
        let span = self.high - self.low;
        let least = span / most as f64;
        let power = 10_f64.powi(least.log10().floor() as i32);
        let steps = [1.0, 2.0, 5.0, 10.0].map(|k| k * power);
        let step = steps.into_iter().find(|s| *s >= least);
        let step = step.unwrap_or(10.0 * power);
        let decimals = (-step.log10().floor()).clamp(0.0, 12.0) as usize;
        // A number at an end of the axis is included in spite of rounding.
        let (first, last) = (self.low / step - 1e-9, self.high / step + 1e-9);
        let counts = first.ceil() as i64..=last.floor() as i64;
        let tick = |k: i64| (k as f64 * step, number(k as f64 * step, decimals));
        counts.map(tick).collect()
    }

    pub(super) fn of(&self, value: f64) -> f64 {
        (value - self.offset) / 10_f64.powi(self.exponent)
    }

    pub(super) fn title(&self, name: &str) -> String {
        let sign = if self.offset < 0.0 { '+' } else { '−' };
        match self.offset {
            0.0 => name.to_owned(),
            offset => format!("{name} {sign} {}", short(offset.abs())),
        }
    }

    pub(super) fn label(&self, unit: &str) -> String {
        match (self.exponent, unit) {
            (0, unit) => unit.to_owned(),
            (e, "") => format!("1e{e}"),
            (e, unit) => format!("1e{e} {unit}"),
        }
    }
}

/// Prints a number with at most this number of decimals.
fn number(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    let text = match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => &text,
    };
    let text = if text == "-0" { "0" } else { text };
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_numbers_on_the_axis() {
        for range in [
            (0.0, 5.0),
            (-1.2e-5, 3.4e-5),
            (1e6, 1e6 + 1.0),
            (2.0, 2.0),
            (-7e9, 4e8),
        ] {
            let axis = Axis::new(range);
            let ticks = axis.ticks(6);
            assert!((2..=7).contains(&ticks.len()), "{range:?}: {ticks:?}");
            for (x, text) in &ticks {
                assert!(*x >= axis.low - 1e-9 && *x <= axis.high + 1e-9);
                let shown: f64 = text.replace('−', "-").parse().expect("a number");
                assert!(
                    (shown - x).abs() <= 1e-9 * x.abs().max(1e-3),
                    "{x} is shown as {text}"
                );
            }
            let words: std::collections::BTreeSet<_> = ticks.iter().map(|t| &t.1).collect();
            assert_eq!(words.len(), ticks.len(), "{ticks:?}");
        }
        let time: Vec<String> = Axis::tight(0.0, 5.0)
            .ticks(9)
            .into_iter()
            .map(|t| t.1)
            .collect();
        assert_eq!(time, ["0", "1", "2", "3", "4", "5"]);
    }
}
