//! Sine and cosine of angles of any size: the branch-free kernel, or exact reduction for large angles.

use super::kernel::sin_cos_in_range;
use super::lanes::SineLanes;
use super::large;
use crate::two_sum::two_sum;

/// Numbers with a sine of angles of any size.
pub(crate) trait AnySize: SineLanes {
    /// Returns sine and cosine of `self` + `tail` if not all of them are within the limits: each angle is
    /// reduced exactly and separately.
    fn sin_cos_large(self, tail: Self) -> (Self, Self);
}

/// Returns sine and cosine of angle + tail; `tail` is the rounding error of a sum of angles.
#[inline(always)]
pub(crate) fn sin_cos<T: AnySize>(angle: T, tail: Option<T>) -> (T, T) {
    if angle.within() && tail.is_none_or(|tail| tail.all_below(T::TAIL_LIMIT)) {
        sin_cos_in_range(angle, tail)
    } else {
        angle.sin_cos_large(tail.unwrap_or(T::splat(0.0)))
    }
}

macro_rules! scalars {
    ($($float:ident),+) => {$(
        impl AnySize for $float {
            #[cold]
            fn sin_cos_large(self, tail: Self) -> (Self, Self) {
                // The sum of three terms can be small where a partial sum was large.
                let (angle, tail) = two_sum(self, tail);
                if angle.within() {
                    sin_cos_in_range(angle, Some(tail))
                } else {
                    large::sin_cos_reduced(angle, tail)
                }
            }
        }
    )+};
}
scalars!(f64, f32);

#[cfg(any(feature = "wide", target_arch = "x86_64", target_arch = "aarch64"))]
macro_rules! lanes {
    ($($lanes:ident),+) => {$(
        impl AnySize for wide::$lanes {
            #[cold]
            fn sin_cos_large(self, tail: Self) -> (Self, Self) {
                let (mut s, mut c) = (self.to_array(), tail.to_array());
                for (s, c) in s.iter_mut().zip(&mut c) {
                    (*s, *c) = sin_cos(*s, Some(*c));
                }
                (Self::new(s), Self::new(c))
            }
        }
    )+};
}
#[cfg(any(feature = "wide", target_arch = "x86_64", target_arch = "aarch64"))]
lanes!(f64x2, f64x4, f64x8, f32x4, f32x8, f32x16);
