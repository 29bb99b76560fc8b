//! Operation counts of generated functions.

use core::fmt;
use core::ops::AddAssign;

/// The number of operations of each kind that a function executes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Multiplications.
    pub mul: usize,
    /// Additions and subtractions.
    pub add: usize,
    /// Divisions.
    pub div: usize,
    /// Square roots.
    pub sqrt: usize,
    /// Pairs of a sine and a cosine of one angle.
    pub sincos: usize,
    /// Comparisons, selections, minima and maxima, exponentials, checked pivots.
    pub other: usize,
}

impl Operations {
    /// Returns counts from an array in the order of the fields.
    pub const fn new([mul, add, div, sqrt, sincos, other]: [usize; 6]) -> Self {
        Operations {
            mul,
            add,
            div,
            sqrt,
            sincos,
            other,
        }
    }

    /// Returns the number of multiplications and additions, the usual measure to compare functions.
    pub fn total(&self) -> usize {
        self.mul + self.add
    }
}

impl AddAssign for Operations {
    fn add_assign(&mut self, b: Self) {
        self.mul += b.mul;
        self.add += b.add;
        self.div += b.div;
        self.sqrt += b.sqrt;
        self.sincos += b.sincos;
        self.other += b.other;
    }
}

impl fmt::Display for Operations {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} mul, {} add", self.mul, self.add)?;
        for (n, what) in [
            (self.div, "div"),
            (self.sqrt, "sqrt"),
            (self.sincos, "sincos"),
            (self.other, "other"),
        ] {
            if n > 0 {
                write!(f, ", {n} {what}")?;
            }
        }
        Ok(())
    }
}
