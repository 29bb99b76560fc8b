//! Implementation of [`Scalar`] for double-doubles.

use nalgebra::SVector;

use super::number::Dd;
use crate::singular::{failed, note_refused, succeeded};
use crate::{Look, Scalar, Singular};

impl Scalar for Dd {
    type Mask = bool;
    type Refused = Option<usize>;
    type Singular<const N: usize> = Singular;

    fn from_f64(x: f64) -> Self {
        Self { hi: x, lo: 0.0 }
    }

    fn from_parts(hi: f64, lo: f64) -> Self {
        Self::new(hi, lo)
    }

    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }

    fn sqrt(self) -> Self {
        Self::sqrt(self)
    }

    fn sin_cos(self) -> (Self, Self) {
        Self::sin_cos(self)
    }

    fn sin_cos_sum(angles: &[Self], offset: (f64, f64)) -> (Self, Self) {
        Self::sin_cos_of_sum(angles, Self::new(offset.0, offset.1))
    }

    fn exp(self) -> Self {
        Self::exp(self)
    }

    fn ln(self) -> Self {
        Self::ln(self)
    }

    fn tanh(self) -> Self {
        Self::tanh(self)
    }

    fn abs(self) -> Self {
        Self::abs(self)
    }

    fn min(self, other: Self) -> Self {
        Self::min(self, other)
    }

    fn max(self, other: Self) -> Self {
        Self::max(self, other)
    }

    fn sign(self) -> Self {
        Self::from_f64(self.hi.sign())
    }

    fn less(self, other: Self) -> bool {
        self < other
    }

    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }

    fn none_refused() -> Option<usize> {
        None
    }

    fn checked_pivot(self, magnitude: Self, joint: usize, refused: &mut Option<usize>) -> Self {
        // These comparisons also refuse a NaN on either side.
        let ok = self > Self::ZERO && self > magnitude * Self::EPSILON && self < Self::INFINITY;
        note_refused(ok, joint, refused);
        self
    }

    #[inline]
    fn succeeded<const N: usize>(accelerations: &SVector<Self, N>, refused: Option<usize>) -> bool {
        succeeded(accelerations, refused)
    }

    fn failed<const N: usize>(
        accelerations: SVector<Self, N>,
        refused: Option<usize>,
        names: &'static [&'static str],
        arguments: impl FnOnce(&mut Look<'_, Self>),
    ) -> Option<Singular> {
        failed(accelerations, refused, names, arguments)
    }
}
