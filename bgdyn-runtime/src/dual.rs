//! Implementation of [`Scalar`] for dual numbers: derivatives that are exact except for rounding.
//!
//! Comparisons, minima, maxima, signs and pivots depend on the real part only, as `==` on these types
//! does. Real parts equal those of `f64` (or `f32`) bit for bit, except after a division: `num-dual`
//! multiplies by the reciprocal.

use nalgebra::{Const, SVector};
use num_dual::{Dual, Dual2, DualNum, DualVec, HyperDual};

use crate::sine;
use crate::singular::{failed, succeeded};
use crate::two_sum::exact_sum;
use crate::{Look, Scalar, Singular};

/// A component of dual numbers: `f64`, `f32`, or dual numbers again (for derivatives of higher order).
pub trait DualPart: Scalar<Mask = bool, Refused = Option<usize>> + DualNum + Copy {
    /// [`Scalar::sin_cos_sum`] for angles that are not in a slice.
    fn sin_cos_of_all(
        angles: impl Iterator<Item = Self> + Clone,
        offset: (f64, f64),
    ) -> (Self, Self);
}

macro_rules! float_part {
    ($($float:ident)*) => {$(
        impl DualPart for $float {
            fn sin_cos_of_all(
                angles: impl Iterator<Item = Self> + Clone,
                offset: (f64, f64),
            ) -> (Self, Self) {
                let (angle, tail) = exact_sum(angles, offset);
                sine::sin_cos(angle, tail)
            }
        }
    )*};
}

float_part!(f64 f32);

/// Value and first two derivatives of a function at the real part.
type Taylor<T> = [T; 3];

/// The chain rule.
trait Chain: Copy {
    type Part: DualPart;

    /// Applies a function to a dual number.
    fn chain(self, f: Taylor<Self::Part>) -> Self;
}

impl<T: DualPart> Chain for Dual<T> {
    type Part = T;

    fn chain(self, [f0, f1, _]: Taylor<T>) -> Self {
        Self::new(f0, self.eps * f1)
    }
}

impl<T: DualPart, const N: usize> Chain for DualVec<T, Const<N>> {
    type Part = T;

    fn chain(self, [f0, f1, _]: Taylor<T>) -> Self {
        Self::new(f0, self.eps * f1)
    }
}

impl<T: DualPart> Chain for Dual2<T> {
    type Part = T;

    fn chain(self, [f0, f1, f2]: Taylor<T>) -> Self {
        Self::new(f0, self.v1 * f1, self.v2 * f1 + self.v1 * self.v1 * f2)
    }
}

impl<T: DualPart> Chain for HyperDual<T> {
    type Part = T;

    fn chain(self, [f0, f1, f2]: Taylor<T>) -> Self {
        let mixed = self.eps1eps2 * f1 + self.eps1 * self.eps2 * f2;
        Self::new(f0, self.eps1 * f1, self.eps2 * f1, mixed)
    }
}

fn number<T: Scalar>(x: f64) -> T {
    T::from_f64(x)
}

macro_rules! dual_scalar {
    ($dual:ty $(, const $n:ident)?) => {
        impl<T: DualPart $(, const $n: usize)?> Scalar for $dual {
            type Mask = bool;
            type Refused = Option<usize>;
            type Singular<const M: usize> = Singular;

            fn from_f64(x: f64) -> Self {
                Self::from_re(number(x))
            }

            fn mul_add(self, b: Self, c: Self) -> Self {
                self * b + c
            }

            fn sqrt(self) -> Self {
                let f0 = Scalar::sqrt(self.re);
                let f1 = number::<T>(0.5) / f0;
                self.chain([f0, f1, -f1 / (self.re + self.re)])
            }

            fn sin_cos(self) -> (Self, Self) {
                let (s, c) = Scalar::sin_cos(self.re);
                (self.chain([s, c, -s]), self.chain([c, -s, -c]))
            }

            fn sin_cos_sum(angles: &[Self], offset: (f64, f64)) -> (Self, Self) {
                Self::sin_cos_of_all(angles.iter().copied(), offset)
            }

            fn exp(self) -> Self {
                let f = Scalar::exp(self.re);
                self.chain([f; 3])
            }

            fn ln(self) -> Self {
                let f1 = number::<T>(1.0) / self.re;
                self.chain([Scalar::ln(self.re), f1, -(f1 * f1)])
            }

            fn tanh(self) -> Self {
                let one = number::<T>(1.0);
                let f0 = Scalar::tanh(self.re);
                let f1 = (one - f0) * (one + f0);
                self.chain([f0, f1, -((f0 + f0) * f1)])
            }

            // The derivative at 0 is taken as 0.
            fn abs(self) -> Self {
                let (f0, f1) = (Scalar::abs(self.re), Scalar::sign(self.re));
                self.chain([f0, f1, number(0.0)])
            }

            fn min(self, other: Self) -> Self {
                let own = Scalar::less(self.re, other.re) || is_nan(self.re);
                if own { self } else { other }
            }

            fn max(self, other: Self) -> Self {
                let own = Scalar::less(other.re, self.re) || is_nan(self.re);
                if own { self } else { other }
            }

            fn sign(self) -> Self {
                Self::from_re(Scalar::sign(self.re))
            }

            fn less(self, other: Self) -> bool {
                Scalar::less(self.re, other.re)
            }

            fn select(mask: bool, a: Self, b: Self) -> Self {
                if mask { a } else { b }
            }

            fn none_refused() -> Option<usize> {
                None
            }

            fn checked_pivot(
                self,
                magnitude: Self,
                joint: usize,
                refused: &mut Option<usize>,
            ) -> Self {
                let _ = self.re.checked_pivot(magnitude.re, joint, refused);
                self
            }

            #[inline]
            fn succeeded<const M: usize>(
                accelerations: &SVector<Self, M>,
                refused: Option<usize>,
            ) -> bool {
                succeeded(accelerations, refused)
            }

            fn failed<const M: usize>(
                accelerations: SVector<Self, M>,
                refused: Option<usize>,
                names: &'static [&'static str],
                arguments: impl FnOnce(&mut Look<'_, Self>),
            ) -> Option<Singular> {
                failed(accelerations, refused, names, arguments)
            }
        }

        impl<T: DualPart $(, const $n: usize)?> DualPart for $dual {
            fn sin_cos_of_all(
                angles: impl Iterator<Item = Self> + Clone,
                offset: (f64, f64),
            ) -> (Self, Self) {
                let (s, c) = T::sin_cos_of_all(angles.clone().map(|x| x.re), offset);
                // The derivatives add. The real part of this sum is not used.
                let zero = <Self as Scalar>::from_f64(0.0);
                let sum = angles.fold(zero, |sum, x| sum + x);
                (sum.chain([s, c, -s]), sum.chain([c, -s, -c]))
            }
        }
    };
}

dual_scalar!(Dual<T>);
dual_scalar!(Dual2<T>);
dual_scalar!(HyperDual<T>);
dual_scalar!(DualVec<T, Const<N>>, const N);

#[allow(clippy::eq_op, reason = "NaN alone differs from itself")]
fn is_nan<T: DualPart>(x: T) -> bool {
    x != x
}
