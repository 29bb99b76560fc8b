//! Exact reduction of large angles (Payne and Hanek 1983).
//!
//! A number is an integer times a power of two. Its product with the digits of 1/2π that affect the result
//! is a fraction of a turn in fixed point; whole turns overflow and are dropped.

use super::kernel::of_rest;
use super::lanes::SineLanes;
use crate::dd::{Turn, inverse_tau_digits};

/// Scalars with an exact reduction.
pub(crate) trait ExactReduction: SineLanes {
    /// Returns the quarter turn nearest to the finite angle `self` + `tail`, modulo 4, and the remaining
    /// angle in radians in two words.
    fn reduce_exactly(self, tail: Self) -> (u32, Self, Self);
    /// Returns n in the form of the argument of [`SineLanes::turned`].
    fn quarters(n: u32) -> Self;
    /// Returns whether the number is finite.
    fn finite(self) -> bool;
}

/// Returns sine and cosine of `angle` + `tail`, of any size; NaN if the angle is not finite.
#[cold]
#[inline(never)]
pub(super) fn sin_cos_reduced<T: ExactReduction>(angle: T, tail: T) -> (T, T) {
    if !angle.finite() {
        return (T::splat(f64::NAN), T::splat(f64::NAN));
    }
    let (n, r, low) = angle.reduce_exactly(tail);
    let (s, c) = of_rest(r, low);
    T::turned(T::quarters(n), s, c)
}

impl ExactReduction for f64 {
    fn reduce_exactly(self, tail: f64) -> (u32, f64, f64) {
        let turn = Turn::of_word(self).plus(Turn::of_word(tail));
        let (quarter, radians) = turn.split();
        (quarter as u32, radians.hi(), radians.lo())
    }
    fn quarters(n: u32) -> f64 {
        f64::from_bits(u64::from(n))
    }
    fn finite(self) -> bool {
        self.is_finite()
    }
}

/// 2π in units of 2⁻⁶¹.
const TAU: u64 = 0xc90f_daa2_2168_c234;
/// An eighth and a quarter of a turn, in units of 2⁻⁶⁴ turns.
const EIGHTH: u64 = 1 << 61;
const QUARTER: u64 = 1 << 62;

/// Returns the finite angle x without its whole turns, in units of 2⁻⁶⁴ turns. No `f32` is closer than
/// 2⁻³⁴ turns to a quarter turn, so that 64 digits leave 30.
fn turn_of(x: f32) -> u64 {
    let bits = x.to_bits();
    let mantissa = u64::from(bits & 0x7f_ffff | 0x80_0000);
    // |x| = mantissa · 2^exponent; subnormal numbers are less than one unit here.
    let exponent = ((bits >> 23) & 0xff) as i32 - 150;
    let high = inverse_tau_digits(exponent).wrapping_mul(mantissa);
    let low = (u128::from(inverse_tau_digits(exponent + 64)) * u128::from(mantissa)) >> 64;
    let turn = high.wrapping_add(low as u64);
    if x < 0.0 { turn.wrapping_neg() } else { turn }
}

/// Uses integers and `f32` only, for controllers without double precision.
impl ExactReduction for f32 {
    fn reduce_exactly(self, tail: f32) -> (u32, f32, f32) {
        let turn = turn_of(self).wrapping_add(turn_of(tail));
        let shifted = turn.wrapping_add(EIGHTH);
        let (quarter, rest) = (shifted / QUARTER, (shifted % QUARTER).wrapping_sub(EIGHTH));
        let negative = rest >> 63 == 1;
        let size = if negative { rest.wrapping_neg() } else { rest };
        // In units of 2⁻⁶¹ rad.
        let radians = ((u128::from(size) * u128::from(TAU)) >> 64) as u64;
        let zeros = radians.leading_zeros();
        let digits = radians.checked_shl(zeros).unwrap_or(0);
        let word = |from: u32| (digits << from >> 40) as u32 as f32;
        let unit = |from: u32| f32::from_bits((127 - 61 + 40 - from - zeros) << 23);
        let (r, low) = (word(0) * unit(0), word(24) * unit(24));
        let (r, low) = if negative { (-r, -low) } else { (r, low) };
        (quarter as u32, r, low)
    }
    fn quarters(n: u32) -> f32 {
        f32::from_bits(n)
    }
    fn finite(self) -> bool {
        self.is_finite()
    }
}
