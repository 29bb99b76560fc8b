//! The error of a scene without rates in a state.

use std::fmt;

/// The error that a scene has no rates, or no values, in a state.
#[derive(Clone, PartialEq)]
pub struct Undefined {
    /// The coordinate or the first-order state.
    pub at: String,
    /// Whether the mass matrix is singular; otherwise the value is not finite.
    pub singular: bool,
}

impl fmt::Debug for Undefined {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.singular {
            true => write!(f, "the mass matrix is singular at `{}`", self.at),
            false => write!(
                f,
                "the rate of `{}` is not finite; a smaller step or a tolerance may help",
                self.at
            ),
        }
    }
}
