//! Sums, products, quotients and square roots of double-doubles.
//!
//! The building blocks are those of Dekker (1971) and Knuth; the sum and the product are
//! `AccurateDWPlusDW` and `DWTimesDW` of Joldes, Muller and Popescu, "Tight and rigorous error
//! bounds for basic building blocks of double-word arithmetic" (2017).

use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use super::number::Dd;

/// Returns 2^`n`, for −1022 ≤ `n` ≤ 1023.
const fn power_of_two(n: i64) -> f64 {
    f64::from_bits(((n + 1023) as u64) << 52)
}

/// Sums and products of numbers above this size are computed at a smaller scale.
const HUGE: f64 = power_of_two(1020);
/// Below this size the low word of a product is outside of the exponent range.
const PRODUCT_MIN: f64 = power_of_two(-960);
/// Between these sizes a factor can be split, and a quotient or a square root needs no scaling.
const LARGE: f64 = power_of_two(990);
const SMALL: f64 = power_of_two(-900);

impl Dd {
    /// Returns the exact sum `hi + lo` of any two `f64` (if `lo` is within the exponent range).
    pub const fn new(hi: f64, lo: f64) -> Self {
        two_sum(hi, lo)
    }
}

/// Returns `a + b` exactly, for any order of their sizes (Knuth's two-sum).
#[inline]
pub(super) const fn two_sum(a: f64, b: f64) -> Dd {
    let hi = a + b;
    if !hi.is_finite() {
        return Dd { hi, lo: 0.0 };
    }
    let back = hi - a;
    let lo = (a - (hi - back)) + (b - back);
    // The subtraction can overflow only near f64::MAX; then compute at half the size.
    if lo.is_finite() {
        return Dd { hi, lo };
    }
    let (a, b) = (a * 0.5, b * 0.5);
    let half = a + b;
    let back = half - a;
    Dd {
        hi,
        lo: ((a - (half - back)) + (b - back)) * 2.0,
    }
}

/// Returns `a + b` exactly, where |`a`| ≥ |`b`|, or `a` is 0 (Dekker's fast two-sum).
#[inline]
const fn quick_two_sum(a: f64, b: f64) -> Dd {
    let hi = a + b;
    if !hi.is_finite() {
        return Dd { hi, lo: 0.0 };
    }
    Dd {
        hi,
        lo: b - (hi - a),
    }
}

/// Returns the upper 26 bits of `a` and the rest (Veltkamp).
#[inline]
fn split(a: f64) -> (f64, f64) {
    let t = 134_217_729.0 * a; // 2²⁷ + 1
    let hi = t - (t - a);
    (hi, a - hi)
}

/// Returns the rounding error of the product `p` of `a` and `b`, neither larger than [`LARGE`] (Dekker).
#[inline]
fn product_error(a: f64, b: f64, p: f64) -> f64 {
    let (a_hi, a_lo) = split(a);
    let (b_hi, b_lo) = split(b);
    ((a_hi * b_hi - p) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo
}

impl Dd {
    /// Returns `self · 2ⁿ`, exact except for overflow and underflow.
    pub(super) fn scale(self, n: i32) -> Self {
        let hi = libm::scalbn(self.hi, n);
        let lo = if hi.is_finite() {
            libm::scalbn(self.lo, n)
        } else {
            0.0
        };
        quick_two_sum(hi, lo)
    }

    /// Returns `self · 0.5`, exact except for underflow.
    pub(super) fn half(self) -> Self {
        Self {
            hi: self.hi * 0.5,
            lo: self.lo * 0.5,
        }
    }

    /// Returns `self · b`, for one word `b`; the factors and the product must not exceed [`LARGE`].
    fn times(self, b: f64) -> Self {
        let p = self.hi * b;
        quick_two_sum(p, product_error(self.hi, b, p) + self.lo * b)
    }

    /// Returns the square root; NaN for negative numbers.
    pub fn sqrt(self) -> Self {
        let hi = crate::sqrt::sqrt_f64(self.hi);
        if !hi.is_finite() || hi == 0.0 {
            return Self::from_f64(hi);
        }
        if self.hi < SMALL || self.hi > LARGE {
            let even = libm::ilogb(self.hi) & !1;
            return self.scale(-even).sqrt().scale(even / 2);
        }
        // One Newton step, whose error is the square of that of `hi`.
        let square = hi * hi;
        let rest = self
            - Self {
                hi: square,
                lo: product_error(hi, hi, square),
            };
        quick_two_sum(hi, rest.hi / (2.0 * hi))
    }
}

impl Add for Dd {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let (a, b) = (self, other);
        if !a.hi.is_finite() || !b.hi.is_finite() {
            return Self {
                hi: a.hi + b.hi,
                lo: 0.0,
            };
        }
        if a.hi.abs() > HUGE || b.hi.abs() > HUGE {
            return (a.scale(-8) + b.scale(-8)).scale(8);
        }
        let high = two_sum(a.hi, b.hi);
        let low = two_sum(a.lo, b.lo);
        let sum = quick_two_sum(high.hi, high.lo + low.hi);
        quick_two_sum(sum.hi, sum.lo + low.lo)
    }
}

impl Sub for Dd {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Dd {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self, other);
        let p = a.hi * b.hi;
        // Zeros, infinities and NaN give the result of `f64`.
        if a.hi == 0.0 || b.hi == 0.0 || !a.hi.is_finite() || !b.hi.is_finite() {
            return Self { hi: p, lo: 0.0 };
        }
        let plain =
            a.hi.abs() < LARGE && b.hi.abs() < LARGE && p.abs() < HUGE && p.abs() > PRODUCT_MIN;
        if !plain {
            let (na, nb) = (libm::ilogb(a.hi), libm::ilogb(b.hi));
            return (a.scale(-na) * b.scale(-nb)).scale(na + nb);
        }
        let cross = a.hi * b.lo + (a.lo * b.hi + a.lo * b.lo);
        quick_two_sum(p, product_error(a.hi, b.hi, p) + cross)
    }
}

impl Div for Dd {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let (a, b) = (self, other);
        let q1 = a.hi / b.hi;
        // Zeros, infinities and NaN give the result of `f64`.
        if a.hi == 0.0 || b.hi == 0.0 || !a.hi.is_finite() || !b.hi.is_finite() {
            return Self { hi: q1, lo: 0.0 };
        }
        let safe = |x: f64| x.abs() > SMALL && x.abs() < LARGE;
        if !(safe(a.hi) && safe(b.hi) && safe(q1)) {
            let (na, nb) = (libm::ilogb(a.hi), libm::ilogb(b.hi));
            return (a.scale(-na) / b.scale(-nb)).scale(na - nb);
        }
        // Long division, one word at a time.
        let rest = a - b.times(q1);
        let q2 = rest.hi / b.hi;
        let rest = rest - b.times(q2);
        let q3 = rest.hi / b.hi;
        let q = quick_two_sum(q1, q2);
        quick_two_sum(q.hi, q.lo + q3)
    }
}

impl Neg for Dd {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self {
            hi: -self.hi,
            lo: -self.lo,
        }
    }
}

impl AddAssign for Dd {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Dd {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl MulAssign for Dd {
    #[inline]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl DivAssign for Dd {
    fn div_assign(&mut self, other: Self) {
        *self = *self / other;
    }
}
