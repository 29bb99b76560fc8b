//! Scalars without lanes, and norms of their vectors.

use bgdyn_runtime::{Dd, Scalar, StateVector};

/// A scalar without lanes, which step control and iterations can compare.
pub trait Real: Scalar<Mask = bool> + PartialOrd {
    /// A bound on the relative rounding error of one operation.
    const EPSILON: Self;

    /// Returns the nearest `f64`.
    fn to_f64(self) -> f64;

    /// Returns whether the number is neither infinite nor NaN.
    fn is_finite(self) -> bool;
}

impl Real for f64 {
    const EPSILON: Self = f64::EPSILON;

    fn to_f64(self) -> f64 {
        self
    }

    fn is_finite(self) -> bool {
        f64::is_finite(self)
    }
}

impl Real for f32 {
    const EPSILON: Self = f32::EPSILON;

    fn to_f64(self) -> f64 {
        self.into()
    }

    fn is_finite(self) -> bool {
        f32::is_finite(self)
    }
}

impl Real for Dd {
    const EPSILON: Self = Dd::EPSILON;

    fn to_f64(self) -> f64 {
        Dd::to_f64(self)
    }

    fn is_finite(self) -> bool {
        Dd::is_finite(self)
    }
}

/// The scalar type of the vectors `Y`.
pub type Of<Y> = <Y as StateVector>::Scalar;

/// Returns the largest |x|ᵢ/sᵢ; a component whose scale is 0 counts only if it is not 0. NaN if a
/// component is NaN.
pub(crate) fn largest<Y: StateVector>(x: &Y, scale: &Y) -> Of<Y>
where
    Of<Y>: Real,
{
    let zero = Of::<Y>::from_f64(0.0);
    let ratios = x.entries().iter().zip(scale.entries());
    ratios.fold(zero, |most, (&x, &s)| {
        if x == zero {
            most
        } else {
            most.max(x.abs() / s)
        }
    })
}

/// Returns whether every component is finite.
pub(crate) fn finite<Y: StateVector>(x: &Y) -> bool
where
    Of<Y>: Real,
{
    x.entries().iter().all(|x| x.is_finite())
}
