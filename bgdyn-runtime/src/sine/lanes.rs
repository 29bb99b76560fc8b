//! The number types of the sine kernel: one float, or the lanes of a register.

use core::ops::{Add, Mul, Neg, Sub};

/// A polynomial k₀ + k₁x + k₂x² + … of one of the two lengths in use. In a loop over a slice, a compiler
/// that optimises for size would not treat the coefficients as constants, and `f32` would be converted
/// from `f64` at run time.
#[derive(Clone, Copy)]
pub enum Polynomial {
    /// Up to x².
    Three([f64; 3]),
    /// Up to x⁵.
    Six([f64; 6]),
}

/// Constants of the kernel for a scalar type.
#[derive(Clone, Copy)]
pub struct Coefficients {
    /// The first part of π/2, and the second if there are four parts.
    pub exact: (f64, Option<f64>),
    /// The part after these.
    pub middle: f64,
    /// The remaining part of π/2, rounded.
    pub last: f64,
    /// S in sin r = r + r³ S(r²).
    pub sine: Polynomial,
    /// C in cos r = 1 − r²/2 + r⁴ C(r²).
    pub cosine: Polynomial,
}

/// `f64`: parts of 37, 36 and 53 digits, for n up to 2¹⁶. Their sum is π/2 to 2⁻¹³⁰; no angle except 0 is
/// closer to a multiple of π/2 than 2⁻⁶⁰ (at 29 quarter turns).
///
/// The polynomials have the least relative error of their degree in |r| ≤ π/4 + 2⁻²⁰ (found by Remez's
/// exchange in 200 digits): 2⁻⁵⁷·⁹ for the sine, 2⁻⁶³·⁹ for the cosine.
const DOUBLE: Coefficients = Coefficients {
    exact: (1.570_796_326_792_333_3, None),
    middle: 2.563_344_151_583_955_8e-12,
    last: 1.056_299_906_698_742_8e-23,
    sine: Polynomial::Six([
        -0.166_666_666_666_666_3,
        0.008_333_333_333_322_118,
        -0.000_198_412_698_295_894_28,
        2.755_731_362_134_611_5e-6,
        -2.505_074_775_645_978_3e-8,
        1.589_622_977_567_075e-10,
    ]),
    cosine: Polynomial::Six([
        0.041_666_666_666_666_595,
        -0.001_388_888_888_887_305_6,
        2.480_158_728_885_159e-5,
        -2.755_731_417_926_196e-7,
        2.087_570_083_709_376_5e-9,
        -1.135_853_626_122_895_9e-11,
    ]),
};

/// `f32`: parts of 11, 11, 11 and 24 digits, for n up to 2¹³. Their sum is π/2 to 2⁻⁶³; no angle except 0
/// is closer to a multiple of π/2 than 2⁻²⁷ (at 161 quarter turns). A sum of angles can be closer: for
/// such a small sine (one in a million of sums constructed for it) the missing n 2⁻⁶³ is more than a unit.
///
/// The polynomials as for `f64`, in |r| ≤ π/4 + 2⁻¹⁰: 2⁻²⁸·⁰ for the sine, 2⁻³³·⁰ for the cosine.
const SINGLE: Coefficients = Coefficients {
    exact: (1.570_312_5, Some(0.000_483_751_296_997_070_3)),
    middle: 7.549_533_620_476_723e-8,
    last: 2.563_344_068_257_089_6e-12,
    sine: Polynomial::Three([
        -0.166_666_545_188,
        0.008_332_154_905_89,
        -0.000_195_144_732_882,
    ]),
    cosine: Polynomial::Three([
        0.041_666_645_523_1,
        -0.001_388_730_830_93,
        2.443_223_180_44e-5,
    ]),
};

/// One number, or the lanes of a register.
pub trait SineLanes:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// Angles up to this size, in radians, take the branch-free path.
    const LIMIT: f64;
    /// Rounding errors of sums of angles up to this size take the branch-free path: so much can be left of an
    /// angle beyond ±π/4.
    const TAIL_LIMIT: f64;
    /// 1.5·2^(digits − 1): numbers of this size are integers.
    const MAGIC: f64;
    /// Constants of the kernel.
    const COEFFICIENTS: Coefficients;

    /// Returns the value nearest to `x`, in all lanes.
    fn splat(x: f64) -> Self;
    /// Returns self · b + c, rounded once if the target has an instruction for it.
    fn fused(self, b: Self, c: Self) -> Self;
    /// Returns c − self · b, rounded as [`SineLanes::fused`].
    #[inline(always)]
    fn minus_product(self, b: Self, c: Self) -> Self {
        (-self).fused(b, c)
    }
    /// Returns whether all sizes are at most `limit`; that of NaN is not.
    fn all_below(self, limit: f64) -> bool;
    /// Returns whether all angles are within the limit; NaN is not.
    #[inline(always)]
    fn within(self) -> bool {
        self.all_below(Self::LIMIT)
    }
    /// Returns sine and cosine of r + n π/2 from those of r; the last two binary digits of n are the last
    /// two of `quarters`.
    fn turned(quarters: Self, s: Self, c: Self) -> (Self, Self);
}

/// Whether `f64` fuses a product and a sum here.
pub const FUSES: bool = cfg!(all(target_arch = "x86_64", target_feature = "fma"));

/// Returns a · b + c with the fused instruction if the target has one; never by a call.
#[inline(always)]
fn fused_f64(a: f64, b: f64, c: f64) -> f64 {
    #[cfg(all(target_arch = "x86_64", target_feature = "fma"))]
    {
        use safe_arch::{fused_mul_add_m128d_s, get_f64_from_m128d_s, set_m128d_s};
        let [a, b, c] = [a, b, c].map(set_m128d_s);
        get_f64_from_m128d_s(fused_mul_add_m128d_s(a, b, c))
    }
    #[cfg(not(all(target_arch = "x86_64", target_feature = "fma")))]
    {
        a * b + c
    }
}

/// As [`fused_f64`].
#[inline(always)]
fn fused_f32(a: f32, b: f32, c: f32) -> f32 {
    #[cfg(all(target_arch = "x86_64", target_feature = "fma"))]
    {
        use safe_arch::{fused_mul_add_m128_s, get_f32_from_m128_s, set_m128_s};
        let [a, b, c] = [a, b, c].map(set_m128_s);
        get_f32_from_m128_s(fused_mul_add_m128_s(a, b, c))
    }
    #[cfg(not(all(target_arch = "x86_64", target_feature = "fma")))]
    {
        a * b + c
    }
}

/// If the last digit of n is set (mask of ones), sine and cosine are swapped. The second last digit of n
/// is the sign of the sine, that of n + 1 the sign of the cosine.
macro_rules! quarter_turns {
    ($n:ident, $s:ident, $c:ident, $zero:expr, $one:expr, $two:expr, $to_sign:literal) => {{
        let swapped = $zero - ($n & $one);
        let (sin, cos) = (
            ($s & !swapped) | ($c & swapped),
            ($c & !swapped) | ($s & swapped),
        );
        (
            sin ^ (($n & $two) << $to_sign),
            cos ^ ((($n + $one) & $two) << $to_sign),
        )
    }};
}

macro_rules! scalar_lanes {
    ($float:ident, $bits:ident, $limit:literal, $tail_limit:expr, $magic:literal, $coefficients:ident, $fused:ident, $to_sign:literal) => {
        impl SineLanes for $float {
            const LIMIT: f64 = $limit;
            const TAIL_LIMIT: f64 = $tail_limit;
            const MAGIC: f64 = $magic;
            const COEFFICIENTS: Coefficients = $coefficients;

            #[inline(always)]
            fn splat(x: f64) -> Self {
                x as $float
            }
            #[inline(always)]
            fn fused(self, b: Self, c: Self) -> Self {
                $fused(self, b, c)
            }
            #[inline(always)]
            fn all_below(self, limit: f64) -> bool {
                self.abs() <= limit as $float
            }
            #[inline(always)]
            fn turned(quarters: Self, s: Self, c: Self) -> (Self, Self) {
                use core::num::Wrapping as W;
                let [n, s, c] = [quarters, s, c].map(|x| W(x.to_bits()));
                let (zero, one, two): (W<$bits>, W<$bits>, W<$bits>) = (W(0), W(1), W(2));
                let (s, c) = quarter_turns!(n, s, c, zero, one, two, $to_sign);
                ($float::from_bits(s.0), $float::from_bits(c.0))
            }
        }
    };
}
scalar_lanes!(
    f64,
    u64,
    1e5,
    1.0 / 2_097_152.0,
    6_755_399_441_055_744.0,
    DOUBLE,
    fused_f64,
    62
);
scalar_lanes!(
    f32,
    u32,
    1e4,
    1.0 / 2048.0,
    12_582_912.0,
    SINGLE,
    fused_f32,
    30
);

#[cfg(any(feature = "wide", target_arch = "x86_64", target_arch = "aarch64"))]
macro_rules! register_lanes {
    ($($lanes:ident of $float:ident, $bits:ident, $to_sign:literal;)*) => {$(
        impl SineLanes for wide::$lanes {
            const LIMIT: f64 = <$float as SineLanes>::LIMIT;
            const TAIL_LIMIT: f64 = <$float as SineLanes>::TAIL_LIMIT;
            const MAGIC: f64 = <$float as SineLanes>::MAGIC;
            const COEFFICIENTS: Coefficients = <$float as SineLanes>::COEFFICIENTS;

            #[inline(always)]
            fn splat(x: f64) -> Self {
                wide::$lanes::splat(x as $float)
            }
            #[inline(always)]
            fn fused(self, b: Self, c: Self) -> Self {
                self.mul_add(b, c)
            }
            #[inline(always)]
            fn all_below(self, limit: f64) -> bool {
                self.abs().simd_le(wide::$lanes::splat(limit as $float)).all()
            }
            #[inline(always)]
            fn turned(quarters: Self, s: Self, c: Self) -> (Self, Self) {
                let n = bytemuck::cast::<_, wide::$bits>(quarters);
                let [zero, one, two] = [0, 1, 2].map(wide::$bits::splat);
                let odd: Self = bytemuck::cast(zero - (n & one));
                let (s, c) = (odd.select(c, s), odd.select(s, c));
                let [s, c] = [s, c].map(bytemuck::cast::<_, wide::$bits>);
                let (s, c) = (s ^ ((n & two) << $to_sign), c ^ (((n + one) & two) << $to_sign));
                (bytemuck::cast(s), bytemuck::cast(c))
            }
        }
    )*};
}
#[cfg(any(feature = "wide", target_arch = "x86_64", target_arch = "aarch64"))]
register_lanes! {
    f64x2 of f64, u64x2, 62_u32;
    f64x4 of f64, u64x4, 62_u32;
    f64x8 of f64, u64x8, 62_u32;
    f32x4 of f32, u32x4, 30_u32;
    f32x8 of f32, u32x8, 30_u32;
    f32x16 of f32, u32x16, 30_u32;
}
