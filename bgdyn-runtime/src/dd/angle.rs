//! Sine and cosine of double-double angles and of exact sums of angles.
//!
//! An angle is converted to a fraction of a turn in fixed point: each of its words is multiplied by the
//! digits of 1/2π that affect the result (Payne and Hanek 1983). In this form angles of any size add
//! without rounding, and whole turns overflow and are dropped.

use super::constants::{INVERSE_FACTORIAL, INVERSE_TAU, TAU};
use super::number::Dd;

/// Number of words of a fraction of a turn.
const WORDS: usize = 5;
/// An eighth and a quarter of a turn, in the highest word.
const EIGHTH: u64 = 1 << 61;
const QUARTER: u64 = 1 << 62;
/// Below this angle (radians, just under π/4) the series need no reduction.
const REDUCED: f64 = 0.785;
/// Below this angle (radians) fixed point would lose relative accuracy.
const TINY: f64 = 1.0 / (1_u64 << 63) as f64;

/// A fraction of a turn in [0, 1), with 320 binary digits, the highest word first.
#[derive(Clone, Copy)]
pub(crate) struct Turn([u64; WORDS]);

impl Turn {
    const ZERO: Self = Self([0; WORDS]);

    /// Returns the finite angle `x` in radians without its whole turns; the error is less than 2⁻²⁶⁷
    /// turns, downwards.
    pub(crate) fn of_word(x: f64) -> Self {
        let bits = x.to_bits();
        let biased = (bits >> 52) & 0x7ff;
        let fraction = bits & ((1 << 52) - 1);
        let mantissa = if biased == 0 {
            fraction
        } else {
            fraction | 1 << 52
        };
        let exponent = biased.max(1) as i32 - 1075;
        // |x| = mantissa · 2^exponent: multiply the digits of 2^exponent/2π after the point by the
        // mantissa.
        let mut words = [0; WORDS];
        let mut carry = 0_u128;
        for (i, word) in words.iter_mut().enumerate().rev() {
            let digits = inverse_tau_digits(exponent + 64 * i as i32);
            let product = u128::from(digits) * u128::from(mantissa) + carry;
            *word = product as u64;
            carry = product >> 64;
        }
        if x < 0.0 {
            Self(words).negated()
        } else {
            Self(words)
        }
    }

    fn of(x: Dd) -> Self {
        Self::of_word(x.hi).plus(Self::of_word(x.lo))
    }

    pub(crate) fn plus(self, other: Self) -> Self {
        let mut sum = self;
        let mut carry = 0_u128;
        for i in (0..WORDS).rev() {
            let total = u128::from(sum.0[i]) + u128::from(other.0[i]) + carry;
            sum.0[i] = total as u64;
            carry = total >> 64;
        }
        sum
    }

    fn negated(self) -> Self {
        let mut one = Self::ZERO;
        one.0[WORDS - 1] = 1;
        Self(self.0.map(|word| !word)).plus(one)
    }

    /// Returns the quarter turn nearest to the angle, modulo 4, and the remaining angle in radians, in
    /// ±π/4.
    pub(crate) fn split(self) -> (u64, Dd) {
        let mut rest = self;
        rest.0[0] = rest.0[0].wrapping_add(EIGHTH);
        let quarter = rest.0[0] / QUARTER;
        rest.0[0] = (rest.0[0] % QUARTER).wrapping_sub(EIGHTH);
        let negative = rest.0[0] >> 63 == 1;
        if negative {
            rest = rest.negated();
        }
        let radians = rest.to_dd() * TAU;
        (quarter, if negative { -radians } else { radians })
    }

    /// Returns the fraction, to 106 significant digits or more.
    fn to_dd(self) -> Dd {
        let Some(first) = self.0.iter().position(|&word| word != 0) else {
            return Dd::ZERO;
        };
        let word = |i: usize| self.0.get(first + i).copied().unwrap_or(0);
        let shift = word(0).leading_zeros();
        // Take 128 digits without leading zeros and divide them into 53 and 75.
        let digits = (u128::from(word(0)) << 64 | u128::from(word(1))) << shift
            | (u128::from(word(2)) << shift) >> 64;
        let (hi, lo) = (digits >> 75, digits & ((1 << 75) - 1));
        Dd::new(libm::scalbn(hi as f64, -53), libm::scalbn(lo as f64, -128))
            .scale(-(64 * first as i32 + shift as i32))
    }

    fn sin_cos(self) -> (Dd, Dd) {
        let (quarter, radians) = self.split();
        let (s, c) = reduced_sin_cos(radians);
        match quarter {
            0 => (s, c),
            1 => (c, -s),
            2 => (-s, -c),
            _ => (-c, s),
        }
    }
}

/// Returns 64 binary digits of 1/2π, starting after the `start`-th digit after the point; digits before
/// the point are zero.
pub(crate) fn inverse_tau_digits(start: i32) -> u64 {
    let word = |i: i32| {
        usize::try_from(i)
            .ok()
            .and_then(|i| INVERSE_TAU.get(i))
            .copied()
            .unwrap_or(0)
    };
    let (first, shift) = (start.div_euclid(64), start.rem_euclid(64));
    let pair = u128::from(word(first)) << 64 | u128::from(word(first + 1));
    ((pair << shift) >> 64) as u64
}

/// Returns sine and cosine by their Taylor series, for |x| ≤ π/4.
fn reduced_sin_cos(x: Dd) -> (Dd, Dd) {
    let square = x * x;
    // Sums 1/first! − x²/(first + 2)! + …, 13 terms.
    let series = |first: usize| {
        (0..13).rev().fold(Dd::ZERO, |sum, i| {
            INVERSE_FACTORIAL[first + 2 * i] - square * sum
        })
    };
    let sin = x - x * square * series(3);
    let cos = Dd::ONE - (square.half() - square * square * series(4));
    (sin, cos)
}

impl Dd {
    /// Returns sine and cosine of an angle in radians, of any size, with errors of a few 2⁻¹⁰⁶.
    pub fn sin_cos(self) -> (Self, Self) {
        if !self.is_finite() {
            return (Self::NAN, Self::NAN);
        }
        if self.hi == 0.0 {
            return (self, Self::ONE); // keeps the sign of zero
        }
        if self.hi.abs() < REDUCED {
            return reduced_sin_cos(self);
        }
        Turn::of(self).sin_cos()
    }

    /// Returns sine and cosine of the exact sum of angles in radians, of any size, with errors of a few
    /// 2⁻¹⁰⁶.
    pub(super) fn sin_cos_of_sum(angles: &[Self], offset: Self) -> (Self, Self) {
        if let ([angle], true) = (angles, offset == Self::ZERO) {
            return angle.sin_cos();
        }
        let all = || angles.iter().copied().chain([offset]);
        if all().any(|angle| !angle.is_finite()) {
            return (Self::NAN, Self::NAN);
        }
        if all().all(|angle| angle.hi.abs() < TINY) {
            return all().fold(Self::ZERO, |sum, angle| sum + angle).sin_cos();
        }
        all()
            .fold(Turn::ZERO, |sum, angle| sum.plus(Turn::of(angle)))
            .sin_cos()
    }
}
