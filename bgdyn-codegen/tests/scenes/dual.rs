//! Dual numbers over double-double: exact derivatives of evaluated functions, independent of the
//! generator's differentiation.

use std::ops::{Add, Div, Mul, Neg, Sub};

use bgdyn_runtime::{Dd, Look, Scalar};
use nalgebra::SVector;

/// A value and its slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual {
    pub value: Dd,
    pub slope: Dd,
}

/// A number with a slope.
pub fn dual(value: Dd, slope: Dd) -> Dual {
    Dual { value, slope }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        dual(self.value + b.value, self.slope + b.slope)
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        dual(self.value - b.value, self.slope - b.slope)
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        let slope = self.slope * b.value + self.value * b.slope;
        dual(self.value * b.value, slope)
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        let value = self.value / b.value;
        dual(value, (self.slope - value * b.slope) / b.value)
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        dual(-self.value, -self.slope)
    }
}

impl Scalar for Dual {
    type Mask = bool;
    type Refused = Option<usize>;
    type Singular<const N: usize> = ();

    fn from_f64(x: f64) -> Self {
        dual(Dd::from_f64(x), Dd::ZERO)
    }
    fn from_parts(hi: f64, lo: f64) -> Self {
        dual(Dd::new(hi, lo), Dd::ZERO)
    }
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        dual(root, self.slope / (root + root))
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sine, cosine) = self.value.sin_cos();
        (
            dual(sine, cosine * self.slope),
            dual(cosine, -sine * self.slope),
        )
    }
    fn sin_cos_sum(angles: &[Self], offset: (f64, f64)) -> (Self, Self) {
        let sum = angles.iter().fold(Dd::ZERO, |sum, a| sum + a.slope);
        let values: Vec<Dd> = angles.iter().map(|a| a.value).collect();
        let (sine, cosine) = Dd::sin_cos_sum(&values, offset);
        (dual(sine, cosine * sum), dual(cosine, -sine * sum))
    }
    fn exp(self) -> Self {
        let value = self.value.exp();
        dual(value, value * self.slope)
    }
    fn ln(self) -> Self {
        dual(self.value.ln(), self.slope / self.value)
    }
    fn tanh(self) -> Self {
        let value = self.value.tanh();
        dual(value, (Dd::ONE - value * value) * self.slope)
    }
    fn abs(self) -> Self {
        if self.value < Dd::ZERO { -self } else { self }
    }
    fn min(self, other: Self) -> Self {
        if self.value < other.value {
            self
        } else {
            other
        }
    }
    fn max(self, other: Self) -> Self {
        if other.value < self.value {
            self
        } else {
            other
        }
    }
    fn sign(self) -> Self {
        dual(Scalar::sign(self.value), Dd::ZERO)
    }
    fn less(self, other: Self) -> bool {
        self.value < other.value
    }
    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }
    fn none_refused() -> Option<usize> {
        None
    }
    fn checked_pivot(self, magnitude: Self, joint: usize, refused: &mut Option<usize>) -> Self {
        let value = self.value.checked_pivot(magnitude.value, joint, refused);
        dual(value, self.slope)
    }
    fn succeeded<const N: usize>(_: &SVector<Self, N>, refused: Option<usize>) -> bool {
        refused.is_none()
    }

    fn failed<const N: usize>(
        _: SVector<Self, N>,
        _: Option<usize>,
        _: &'static [&'static str],
        _: impl FnOnce(&mut Look<'_, Self>),
    ) -> Option<()> {
        Some(())
    }
}
