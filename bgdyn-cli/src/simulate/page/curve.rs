//! Encodes a quantity over time as compact text.

use serde::Serialize;

use super::super::difference::range;
use super::super::run_table::Column;

/// Number of levels in a curve's range.
pub(super) const LEVELS: f64 = 1e5;
/// Larger values are not shown.
const LARGEST: f64 = 1e250;

/// Values over time: integers from 0 to [`LEVELS`] over their range, `None` for values that are not
/// finite.
#[derive(Serialize)]
pub(super) struct Curve {
    name: String,
    unit: &'static str,
    low: f64,
    high: f64,
    counts: Vec<Option<u32>>,
}

impl Curve {
    pub(super) fn new(column: &Column, values: impl Iterator<Item = f64>) -> Self {
        let values: Vec<f64> = values.collect();
        let shown = |x: &f64| x.is_finite() && x.abs() < LARGEST;
        let (low, high) = range(values.iter().copied().filter(shown));
        let (low, high) = if low <= high { (low, high) } else { (0.0, 0.0) };
        let span = high - low;
        let count = |x: &f64| {
            let part = if span > 0.0 { (x - low) / span } else { 0.0 };
            shown(x).then(|| (LEVELS * part).round() as u32)
        };
        Curve {
            name: column.name.clone(),
            unit: column.unit,
            low,
            high,
            counts: values.iter().map(count).collect(),
        }
    }
}
