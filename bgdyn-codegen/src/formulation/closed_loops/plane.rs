//! Vectors in the plane of a loop.

use std::ops::{Add, Sub};

use bgdyn_runtime::Dd;

use crate::expr::{Builder, Expr};
use crate::mechanism::closure::{PlaneVector, snapped};

/// A vector in the plane of a loop; also cosine and sine of an angle.
#[derive(Clone, Copy, Debug)]
pub(super) struct InPlane<'g>(pub [Expr<'g>; 2]);

impl<'g> InPlane<'g> {
    pub(super) fn zero(b: &'g Builder) -> Self {
        InPlane([b.zero(); 2])
    }

    pub(super) fn constant(b: &'g Builder, v: PlaneVector) -> Self {
        InPlane(v.map(|x| b.constant(x)))
    }

    /// Returns the vector times a number.
    pub(super) fn scale(self, k: Expr<'g>) -> Self {
        InPlane(self.0.map(|x| x * k))
    }

    /// Returns the vector turned by a right angle.
    pub(super) fn turned(self) -> Self {
        let [x, y] = self.0;
        InPlane([-y, x])
    }

    /// Returns the vector turned by the angle of another one, times its length.
    pub(super) fn along(self, direction: Self) -> Self {
        let ([x, y], [c, s]) = (self.0, direction.0);
        InPlane([x * c - y * s, x * s + y * c])
    }

    /// Returns the vector mirrored: an angle of the opposite sign.
    pub(super) fn mirrored(self) -> Self {
        let [x, y] = self.0;
        InPlane([x, -y])
    }

    pub(super) fn dot(self, other: Self) -> Expr<'g> {
        let ([x, y], [u, v]) = (self.0, other.0);
        x * u + y * v
    }

    /// Returns the component along the loop's axis of self × other.
    pub(super) fn cross(self, other: Self) -> Expr<'g> {
        let ([x, y], [u, v]) = (self.0, other.0);
        x * v - y * u
    }
}

impl Add for InPlane<'_> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let ([x, y], [u, v]) = (self.0, other.0);
        InPlane([x + u, y + v])
    }
}

impl Sub for InPlane<'_> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        let ([x, y], [u, v]) = (self.0, other.0);
        InPlane([x - u, y - v])
    }
}

/// Returns cosine and sine of an angle, with exact zeros and ones at quarter turns.
pub(super) fn direction(angle: Dd) -> PlaneVector {
    let (sin, cos) = angle.sin_cos();
    snapped([cos, sin])
}
