//! The errors of an invariant along a run, by tenths of its steps.

use crate::reference::larger;

/// Errors in the tenths of a number of steps.
#[derive(Clone, Debug)]
pub(crate) struct Tenths {
    steps: u32,
    /// Largest errors.
    largest: [f64; 10],
    /// Mean errors.
    means: [f64; 10],
}

impl Tenths {
    /// Returns the errors of a run of so many steps, none yet.
    pub fn new(steps: u32) -> Self {
        Tenths {
            steps,
            largest: [0.0; 10],
            means: [0.0; 10],
        }
    }

    /// Adds the error after step `i`, counted from 1.
    pub fn add(&mut self, i: u32, error: f64) {
        let tenth = (10 * u64::from(i - 1) / u64::from(self.steps)) as usize;
        self.largest[tenth] = larger(self.largest[tenth], error.abs());
        self.means[tenth] += 10.0 * error / f64::from(self.steps);
    }

    /// Returns the largest error; NaN if there is one.
    pub fn most(&self) -> f64 {
        self.largest.iter().copied().fold(0.0, larger)
    }

    /// Returns the largest error of the last tenth, in units of that of the first.
    pub fn grown(&self) -> f64 {
        self.largest[9] / self.largest[0]
    }

    /// Returns the spread of the means.
    pub fn spread(&self) -> f64 {
        let most = self.means.iter().fold(f64::NEG_INFINITY, |m, &x| m.max(x));
        self.means
            .iter()
            .fold(0.0, |spread, &x| spread.max(most - x))
    }
}
