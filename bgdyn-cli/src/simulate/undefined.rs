//! The error of a scene without rates in a state.

use std::fmt;

/// The error that a scene has no rates, or no values, in a state.
#[derive(Clone, PartialEq)]
pub struct Undefined {
    /// The coordinate, the first-order state or the loop.
    pub at: String,
    /// The cause.
    pub cause: UndefinedCause,
}

/// The cause of a missing rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UndefinedCause {
    /// The mass matrix is singular.
    Singular,
    /// A loop is at a singular position.
    Loop,
    /// A loop is out of reach.
    OutOfReach,
    /// The value is not finite.
    NotFinite,
}

impl fmt::Debug for Undefined {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.cause {
            UndefinedCause::Singular => write!(f, "the mass matrix is singular at `{}`", self.at),
            UndefinedCause::Loop => write!(
                f,
                "the loop `{}` is at a singular position, or does not close",
                self.at
            ),
            UndefinedCause::OutOfReach => write!(
                f,
                "the loop `{}` is out of reach, or at the end of its reach",
                self.at
            ),
            UndefinedCause::NotFinite => write!(
                f,
                "the rate of `{}` is not finite; a smaller step or a tolerance may help",
                self.at
            ),
        }
    }
}
