//! A scene with all or some of its effects, for measuring the cost of each.

use std::fmt;

use crate::configuration::RunError;

/// The time of one call: measured, or estimated.
pub enum Call {
    /// Makes this number of calls.
    Compiled(Box<dyn Fn(usize)>),
    /// Estimated time from the operations, ns.
    Estimated(f64),
}

/// A scene with all effects, or some of them, whose costs are measured.
pub struct Priced {
    /// The effects of the scene: `all`, `all but friction`.
    pub effects: String,
    /// Multiplications, additions, divisions, roots, sines (a pair of sine and cosine is one) and
    /// others of one call of `derivative`.
    pub operations: usize,
    /// One call of `derivative`.
    pub call: Call,
    /// Returns the steps of [`STEPS_METHOD`](crate::STEPS_METHOD) from the start to this time, s.
    pub steps: Box<dyn Fn(f64) -> Result<usize, RunError>>,
}

/// Prints all fields except the closures.
impl fmt::Debug for Priced {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Priced")
            .field("effects", &self.effects)
            .field("operations", &self.operations)
            .finish_non_exhaustive()
    }
}
