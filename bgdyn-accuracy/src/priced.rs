//! A scene with all or some of its effects, for measuring the cost of each.

use std::fmt;

use crate::configuration::RunError;

/// What one call takes: measured, or known beforehand.
pub enum Call {
    /// Makes so many calls.
    Compiled(Box<dyn Fn(usize)>),
    /// ns, an estimate from the operations.
    Estimated(f64),
}

/// A scene with all effects, or all but some, whose costs are asked for.
pub struct Priced {
    /// The effects of the scene: `all`, `all but friction`.
    pub effects: String,
    /// Multiplications, additions, divisions, roots, sines (a pair of sine and cosine is one) and
    /// others of one call of `derivative`.
    pub operations: usize,
    /// One call of `derivative`.
    pub call: Call,
    /// Steps of [`STEPS_METHOD`](crate::STEPS_METHOD) from the start to this time, s.
    pub steps: Box<dyn Fn(f64) -> Result<usize, RunError>>,
}

/// Without the closures.
impl fmt::Debug for Priced {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Priced")
            .field("effects", &self.effects)
            .field("operations", &self.operations)
            .finish_non_exhaustive()
    }
}
