//! Computes the distance between two runs of a scene.

use super::run_table::Record;

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
    pub fn difference(&self, other: &Record) -> Option<Difference> {
        let columns = self.rows.first()?.values.len();
        let of = |column| self.difference_in(column, other);
        (0..columns).map(of).reduce(|most, one| {
            let further = one.share > most.share || (one.share.is_nan() && !most.share.is_nan());
            if further { one } else { most }
        })
    }

    fn difference_in(&self, column: usize, other: &Record) -> Difference {
        let values = self.rows.iter().map(|row| row.values[column]);
        let (low, high) = range(values);
        // A range that is only the rounding error of a constant value does not count.
        let scale = (high - low)
            .max(1e-9 * high.abs().max(low.abs()))
            .max(1e-15);
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
