//! Computes the distance between two runs of a scene.

use std::collections::BTreeMap;

use super::run_table::{Column, Record};

/// The part of the largest value of its unit below which a column's range counts as rounding error: the
/// components of a quaternion that stay zero, beside the others.
const ROUNDING: f64 = 1e-9;

/// The distance between two runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The index of the column with the largest distance.
    pub column: usize,
    /// Time of this distance, s.
    pub t: f64,
    /// The distance, in the column's unit.
    pub size: f64,
    /// The distance, relative to the range of the column in the run.
    pub share: f64,
}

impl Record {
    /// Returns the largest distance to another run of the same scene at the output points, relative to the
    /// columns' ranges; `None` without columns.
    pub fn difference(&self, other: &Record, columns: &[Column]) -> Option<Difference> {
        self.rows.first()?;
        let mut of_unit: BTreeMap<&str, f64> = BTreeMap::new();
        for (k, column) in columns.iter().enumerate() {
            let largest = of_unit.entry(column.unit).or_default();
            *largest = largest.max(self.largest(k));
        }
        let of = |column: usize| {
            let largest = of_unit.get(columns[column].unit);
            self.difference_in(column, other, largest.copied().unwrap_or_default())
        };
        (0..columns.len()).map(of).reduce(|most, one| {
            let further = one.share > most.share || (one.share.is_nan() && !most.share.is_nan());
            if further { one } else { most }
        })
    }

    /// Returns the largest absolute value of a column.
    fn largest(&self, column: usize) -> f64 {
        let values = self.rows.iter().map(|row| row.values[column].abs());
        values.fold(0.0, f64::max)
    }

    /// Returns the largest distance in a column; `largest` is the largest value of its unit.
    fn difference_in(&self, column: usize, other: &Record, largest: f64) -> Difference {
        let values = self.rows.iter().map(|row| row.values[column]);
        let (low, high) = range(values);
        // A range that is only the rounding error of a constant value does not count.
        let scale = (high - low).max(ROUNDING * largest).max(1e-15);
        let points = |record: &'_ Record| {
            let rows = record.rows.iter().filter(|row| !row.extra);
            rows.map(|row| (row.t, row.values[column]))
                .collect::<Vec<_>>()
        };
        let mut most = Difference {
            column,
            t: 0.0,
            size: 0.0,
            share: 0.0,
        };
        for ((t, a), (_, b)) in points(self).into_iter().zip(points(other)) {
            let size = (a - b).abs();
            if size > most.size || size.is_nan() {
                let share = size / scale;
                most = Difference {
                    t,
                    size,
                    share,
                    ..most
                };
            }
        }
        most
    }
}

/// Returns the smallest and largest of `values`.
pub(crate) fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    })
}
