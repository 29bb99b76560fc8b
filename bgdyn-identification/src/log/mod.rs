//! The table of a motion: time, positions and efforts of every joint.

mod names;
mod quality;
mod read;
mod sound;

pub use names::{ColumnNames, Quantity};
pub use quality::{Channel, Quality, quality};
pub use read::{Expected, UnitFactor, read};
pub use sound::unsound;

use crate::statistics::median;

/// A log, as read: SI units, time stamps as they are.
#[derive(Clone, Debug, PartialEq)]
pub struct Log {
    /// Time stamps, s, increasing.
    pub time: Vec<f64>,
    /// Positions by joint, rad or m.
    pub q: Vec<Vec<f64>>,
    /// Efforts by joint, N·m or N.
    pub tau: Vec<Vec<f64>>,
    /// The line of each row in the file, from 1.
    pub lines: Vec<usize>,
}

impl Log {
    /// Returns the steps of the time.
    fn steps(&self) -> Vec<f64> {
        self.time.windows(2).map(|t| t[1] - t[0]).collect()
    }

    /// Returns the median step, s.
    pub fn median_step(&self) -> f64 {
        median(self.steps())
    }

    /// Returns the robust deviation of the steps, of those without lost rows, relative to their median.
    pub fn jitter(&self) -> f64 {
        let step = self.median_step();
        let off = self.steps().into_iter().map(|s| (s - step).abs() / step);
        1.4826 * median(off.collect())
    }
}
