//! Finds structural zeros and constants by computing with patterns instead of numbers.
//!
//! A [`Modulus`] abstracts a number that depends on the coordinates: zero, constant, or varying with some
//! of them. Sums and products of patterns are sound: what is found to be zero or constant is so at every
//! q. A cancellation that needs a trigonometric identity can be missed.

use std::ops::{Add, Mul, Neg, Sub};

use bgdyn_runtime::Dd;

use crate::mechanism::CoordinateId;

/// A component of a transformer's modulus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Modulus {
    /// Zero at every q.
    Zero,
    /// The same at every q.
    Constant(Dd),
    /// Varies with the coordinates.
    Varying(Coordinates),
}

/// A set of coordinates, those that a modulus depends on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Coordinates([u64; 4]);

impl Coordinates {
    /// Number of coordinates that a set can distinguish; all later coordinates share one bit.
    const PLACES: usize = 256;

    /// Returns the set with one coordinate.
    pub fn one(j: CoordinateId) -> Self {
        let bit = j.0.min(Self::PLACES - 1);
        let mut words = [0; 4];
        words[bit / 64] = 1 << (bit % 64);
        Coordinates(words)
    }

    /// Returns whether it may contain `j`.
    pub fn contains(self, j: CoordinateId) -> bool {
        let bit = j.0.min(Self::PLACES - 1);
        self.0[bit / 64] >> (bit % 64) & 1 == 1
    }

    /// Returns the union of two sets.
    pub fn union(self, b: Self) -> Self {
        Coordinates(std::array::from_fn(|i| self.0[i] | b.0[i]))
    }
}

impl Modulus {
    /// Returns a constant, or `Zero` for 0.
    pub fn constant(x: Dd) -> Self {
        if x == Dd::ZERO {
            Modulus::Zero
        } else {
            Modulus::Constant(x)
        }
    }

    /// Returns whether it is zero at every q.
    pub fn is_zero(self) -> bool {
        self == Modulus::Zero
    }
}

impl Add for Modulus {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        match (self, b) {
            (Modulus::Zero, x) | (x, Modulus::Zero) => x,
            (Modulus::Constant(x), Modulus::Constant(y)) => {
                let sum = x + y;
                // The rounding error of an exact cancellation in double-double.
                let noise = (x.abs() + y.abs()) * Dd::from_f64(1e-29);
                if sum.abs() <= noise {
                    Modulus::Zero
                } else {
                    Modulus::Constant(sum)
                }
            }
            (Modulus::Varying(a), Modulus::Varying(b)) => Modulus::Varying(a.union(b)),
            (Modulus::Varying(a), _) | (_, Modulus::Varying(a)) => Modulus::Varying(a),
        }
    }
}

impl Neg for Modulus {
    type Output = Self;
    fn neg(self) -> Self {
        match self {
            Modulus::Constant(x) => Modulus::Constant(-x),
            other => other,
        }
    }
}

impl Sub for Modulus {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl Mul<Dd> for Modulus {
    type Output = Self;
    fn mul(self, k: Dd) -> Self {
        self * Modulus::constant(k)
    }
}

impl Mul for Modulus {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        match (self, b) {
            (Modulus::Zero, _) | (_, Modulus::Zero) => Modulus::Zero,
            (Modulus::Constant(x), Modulus::Constant(y)) => Modulus::constant(x * y),
            (Modulus::Varying(a), Modulus::Varying(b)) => Modulus::Varying(a.union(b)),
            (Modulus::Varying(a), _) | (_, Modulus::Varying(a)) => Modulus::Varying(a),
        }
    }
}
