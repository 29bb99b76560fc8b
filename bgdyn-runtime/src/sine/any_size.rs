//! Sine and cosine of angles of any size: the branch-free kernel, or exact reduction for large angles.

use super::kernel::sin_cos_in_range;
use super::lanes::SineLanes;
use super::large;

/// Numbers with a sine of angles of any size.
pub(crate) trait AnySize: SineLanes {
    /// Returns sine and cosine of `self` + `tail` if not all angles are within the limit: each angle is
    /// reduced exactly and separately.
    fn sin_cos_large(self, tail: Self) -> (Self, Self);
}

/// Returns sine and cosine of angle + tail; `tail` is the rounding error of a sum of angles.
#[inline(always)]
pub(crate) fn sin_cos<T: AnySize>(angle: T, tail: Option<T>) -> (T, T) {
    if angle.within() {
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
                large::sin_cos_reduced(self, tail)
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
