//! Exponential, logarithm and hyperbolic tangent of double-doubles.

use super::constants::{INVERSE_FACTORIAL, LN_2_PARTS, LN_2_REST, LOG2_E};
use super::number::Dd;

/// Above `EXP_MAX` the exponential is infinite; below `EXP_MIN` it is smaller than any `f64`.
const EXP_MAX: f64 = 710.0;
const EXP_MIN: f64 = -746.0;
/// The series of the exponential is used up to this size: slightly more than half of ln 2.
const REDUCED: f64 = 0.35;
/// From this size on, a hyperbolic tangent is 1 to 2⁻¹¹⁵.
const TANH_ONE: f64 = 40.0;

/// Returns eˣ − 1 by its Taylor series, for |x| ≤ 0.35, with a small *relative* error.
fn reduced_exp_m1(x: Dd) -> Dd {
    let series = (2..25)
        .rev()
        .fold(Dd::ZERO, |sum, n| INVERSE_FACTORIAL[n] + x * sum);
    x + x * x * series
}

impl Dd {
    /// Returns e to the power of `self`, with a relative error of about 2⁻¹⁰⁴.
    pub fn exp(self) -> Self {
        if self.is_nan() {
            return self;
        }
        if self.hi > EXP_MAX {
            return Self::INFINITY;
        }
        if self.hi < EXP_MIN {
            return Self::ZERO;
        }
        let twos = libm::rint(self.hi * LOG2_E);
        let [first, second] = LN_2_PARTS.map(|part| Self::from_f64(twos * part));
        let rest = self - first - second - LN_2_REST * Self::from_f64(twos);
        (Self::ONE + reduced_exp_m1(rest)).scale(twos as i32)
    }

    /// Returns the natural logarithm with a relative error of about 2⁻¹⁰⁴; −∞ for 0, NaN for negative
    /// numbers.
    pub fn ln(self) -> Self {
        if self.hi.is_nan() || self.hi <= 0.0 || self.hi == f64::INFINITY {
            return Self::from_f64(libm::log(self.hi));
        }
        // self = 2^twos · (1 + z) with 1 + z between √½ and √2.
        let mut twos = libm::ilogb(self.hi);
        let mut rest = self.scale(-twos);
        if rest.hi > core::f64::consts::SQRT_2 {
            rest = rest.half();
            twos += 1;
        }
        let z = rest - Self::ONE;
        // Newton: ln(1 + z) = guess + ln(1 + c), and c is no larger than the guess's rounding error.
        let guess = Self::from_f64(libm::log1p(z.hi));
        let guessed = reduced_exp_m1(guess);
        let c = (z - guessed) / (Self::ONE + guessed);
        let log = guess + (c - Self::from_f64(0.5 * c.hi * c.hi));
        let twos = f64::from(twos);
        let [first, second] = LN_2_PARTS.map(|part| Self::from_f64(twos * part));
        first + (second + (LN_2_REST * Self::from_f64(twos) + log))
    }

    /// Returns the hyperbolic tangent with a relative error of about 2⁻¹⁰⁴.
    pub fn tanh(self) -> Self {
        let size = self.abs();
        let two = Self::from_f64(2.0);
        let tanh = if size.hi > TANH_ONE {
            Self::ONE
        } else if 2.0 * size.hi < REDUCED {
            let e = reduced_exp_m1(size + size);
            e / (e + two)
        } else {
            let e = (-(size + size)).exp();
            (Self::ONE - e) / (Self::ONE + e)
        };
        if self.hi.is_sign_negative() {
            -tanh
        } else {
            tanh
        }
    }
}
