//! Hyperbolic tangent in `f64`, `f32` and SIMD lanes, with equal bits and without a branch.
//!
//! tanh |x| = −t/(2 + t) with t = e^y − 1 and y = −2|x|, which has no cancellation. As for the exponential of most libraries
//! (Cody and Waite 1980), y = n ln 2 + r with |r| ≤ ln(2)/2, and t = 2ⁿ (eʳ − 1) + (2ⁿ − 1), where eʳ − 1 = r + r²/2 + r³ Q(r).
//! Errors are below two units in the last place; `tests/numbers/tanh.rs` measures them.

use core::ops::Div;

use crate::sine::SineLanes;

/// Constants for a scalar type.
#[derive(Clone, Copy)]
pub(crate) struct Constants {
    /// Arguments from this size on have the tangent ±1.
    bound: f64,
    /// ln 2 in two parts: n times the first is exact.
    ln_2: (f64, f64),
    /// Q, with the least relative error of eʳ − 1 for its degree (found by Lawson's iteration in 50 digits).
    polynomial: ExponentialPolynomial,
}

/// A polynomial by its number of coefficients, the constant first.
#[derive(Clone, Copy)]
enum ExponentialPolynomial {
    Five([f64; 5]),
    Ten([f64; 10]),
}

/// `f64`: the first part of ln 2 has 44 digits, for n down to −58; the polynomial's error is 2⁻⁶¹·⁷.
const DOUBLE: Constants = Constants {
    bound: 20.0,
    ln_2: (0.693_147_180_559_890_3, 5.497_923_018_708_371e-14),
    polynomial: ExponentialPolynomial::Ten([
        0.166_666_666_666_666_77,
        0.041_666_666_666_666_58,
        0.008_333_333_333_322_163,
        0.001_388_888_888_894_254_7,
        0.000_198_412_698_849_283_02,
        2.480_158_719_846_151e-5,
        2.755_724_531_216_963e-6,
        2.755_738_685_131_983e-7,
        2.510_867_904_982_424e-8,
        2.087_896_561_938_087_7e-9,
    ]),
};

/// `f32`: the first part has 17 digits, for n down to −29; 2⁻³¹·³.
const SINGLE: Constants = Constants {
    bound: 10.0,
    ln_2: (0.693_145_751_953_125, 1.428_606_820_309_417_3e-6),
    polynomial: ExponentialPolynomial::Five([
        0.166_666_662_993_083_97,
        0.041_666_482_709_116_055,
        0.008_333_419_615_501_637,
        0.001_393_324_467_121_830_6,
        0.000_198_241_269_972_418_73,
    ]),
};

/// One number, or the lanes of a register.
pub(crate) trait TanhLanes: SineLanes + Div<Output = Self> {
    /// Constants of the type.
    const CONSTANTS: Constants;

    /// Returns the absolute value, but at most `bound`; NaN stays.
    fn size_within(self, bound: f64) -> Self;
    /// Returns the absolute value with the sign of `other`.
    fn with_sign_of(self, other: Self) -> Self;
    /// Returns 2ⁿ for a number [`SineLanes::MAGIC`] + n.
    fn power_of_two(self) -> Self;
}

/// Returns the hyperbolic tangent.
#[inline]
pub(crate) fn tanh<P: TanhLanes>(x: P) -> P {
    let Constants {
        bound,
        ln_2,
        polynomial,
    } = P::CONSTANTS;
    let y = P::splat(-2.0) * x.size_within(bound);
    // Adding 1.5·2^52 (or 2^23) rounds to a whole number and leaves it in the low digits.
    let magic = P::splat(P::MAGIC);
    let whole = y.fused(P::splat(core::f64::consts::LOG2_E), magic);
    let n = whole - magic;
    // n times the first part is exact, and so is the difference; `low` is the rounding error of r.
    let high = n.minus_product(P::splat(ln_2.0), y);
    let taken = n * P::splat(ln_2.1);
    let r = high - taken;
    let low = (high - r) - taken;
    let square = r * r;
    let tail = square.fused(P::splat(0.5), r.fused(low, low));
    let small = (r * square).fused(evaluated(r, polynomial), tail);
    // t + missed = (2ⁿ − 1) + 2ⁿ (eʳ − 1), where 2ⁿ − 1 is 0 or the larger part, and 2 + t = sum − missed.
    let (scale, one, two) = (whole.power_of_two(), P::splat(1.0), P::splat(2.0));
    let (whole_part, rest) = (scale - one, scale * (r + small));
    let t = whole_part + rest;
    let missed = (whole_part - t) + rest;
    let sum = two + t;
    let more = ((two - sum) + t) + missed;
    let quotient = -t / sum;
    // What the rounded parts lack, over 2 + t = 2/(1 + quotient).
    let lack = quotient.minus_product(more, -missed);
    let half = P::splat(0.5);
    lack.fused(half.fused(quotient, half), quotient)
        .with_sign_of(x)
}

/// Evaluates a polynomial in pairs of terms, which shortens the chain of dependent steps.
#[inline(always)]
fn evaluated<P: TanhLanes>(x: P, polynomial: ExponentialPolynomial) -> P {
    let pair = |constant, linear| x.fused(P::splat(linear), P::splat(constant));
    let square = x * x;
    match polynomial {
        ExponentialPolynomial::Five([a, b, c, d, e]) => {
            let high = P::splat(e).fused(square, pair(c, d));
            high.fused(square, pair(a, b))
        }
        ExponentialPolynomial::Ten([a, b, c, d, e, f, g, h, i, j]) => {
            let fourth = square * square;
            let low = pair(c, d).fused(square, pair(a, b));
            let middle = pair(g, h).fused(square, pair(e, f));
            pair(i, j).fused(fourth, middle).fused(fourth, low)
        }
    }
}

macro_rules! scalars {
    ($($float:ident of $bits:ident, $constants:ident, $exponent:literal;)*) => {$(
        impl TanhLanes for $float {
            const CONSTANTS: Constants = $constants;

            #[inline(always)]
            fn size_within(self, bound: f64) -> Self {
                let (size, bound) = (self.abs(), bound as $float);
                if size > bound { bound } else { size }
            }

            #[inline(always)]
            fn with_sign_of(self, other: Self) -> Self {
                let sign = other.to_bits() & (1 << ($bits::BITS - 1));
                $float::from_bits(self.abs().to_bits() | sign)
            }

            #[inline(always)]
            fn power_of_two(self) -> Self {
                let (n, one): ($bits, $float) = (self.to_bits() << $exponent, 1.0);
                $float::from_bits(one.to_bits().wrapping_add(n))
            }
        }
    )*};
}
scalars! {
    f64 of u64, DOUBLE, 52;
    f32 of u32, SINGLE, 23;
}

#[cfg(feature = "wide")]
macro_rules! lanes {
    ($($lanes:ident of $float:ident, $bits:ident, $exponent:literal;)*) => {$(
        impl TanhLanes for wide::$lanes {
            const CONSTANTS: Constants = <$float as TanhLanes>::CONSTANTS;

            #[inline(always)]
            fn size_within(self, bound: f64) -> Self {
                let (size, bound) = (self.abs(), <Self as SineLanes>::splat(bound));
                size.simd_gt(bound).select(bound, size)
            }

            #[inline(always)]
            fn with_sign_of(self, other: Self) -> Self {
                self.abs() | (other & <Self as SineLanes>::splat(-0.0))
            }

            #[inline(always)]
            fn power_of_two(self) -> Self {
                let n = bytemuck::cast::<_, wide::$bits>(self) << $exponent;
                let one = <Self as SineLanes>::splat(1.0);
                bytemuck::cast(bytemuck::cast::<_, wide::$bits>(one) + n)
            }
        }
    )*};
}
#[cfg(feature = "wide")]
lanes! {
    f64x2 of f64, u64x2, 52_u32;
    f64x4 of f64, u64x4, 52_u32;
    f64x8 of f64, u64x8, 52_u32;
    f32x4 of f32, u32x4, 23_u32;
    f32x8 of f32, u32x8, 23_u32;
    f32x16 of f32, u32x16, 23_u32;
}
