//! Ratios of an angle, its sine and its cosine, accurate and differentiable also at the angle 0.
//!
//! Near 0 they are power series in the square of the angle, elsewhere quotients. Both are computed, and
//! one is selected. For the quotients, angles near 0 are replaced before, so that neither they nor their
//! derivatives become infinite.

use crate::Scalar;

/// A constant as the sum of two words.
type Words = (f64, f64);

/// Below this square of the angle (rad²) the series are used. Above it, sin(x)/x is below 1/2, and its
/// difference from 1 does not cancel.
const SWITCH: f64 = 4.0;
/// Number of terms of the series; at the switch the first omitted term is below 2⁻¹⁰⁶ of the sum.
const TERMS: usize = 18;
/// 1/2!, 1/4!, …
const EVEN: [Words; TERMS] = inverse_factorials(2);
/// 1/3!, 1/5!, …
const ODD: [Words; TERMS] = inverse_factorials(3);
/// 1/4!, 1/6!, …
const EVEN_FROM_FOUR: [Words; TERMS] = inverse_factorials(4);
/// 1/5!, 1/7!, …
const ODD_FROM_FIVE: [Words; TERMS] = inverse_factorials(5);

/// 1/6 without its first word.
const SIXTH_REST: f64 = 9.25185853854297e-18;

/// Number of halvings of the angle of [`arc_ratio`]. It is at most π/2 before and π/32 after them, with a
/// tangent below 0.1.
const HALVINGS: usize = 4;
/// 1/2ᵏ after k halvings.
const POWER: f64 = 1.0 / (1_u32 << HALVINGS) as f64;
/// Number of terms of the series of the arc tangent; the first omitted term is below 2⁻¹⁰⁶.
const ARC_TERMS: usize = 16;
/// 1, 1/3, 1/5, …
const ARC: [Words; ARC_TERMS] = odd_reciprocals();

/// Cosine of an angle x and ratios of sines and cosines to powers of x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sines<T> {
    /// cos x.
    pub cosine: T,
    /// sin(x)/x; 1 at 0.
    pub sine: T,
    /// (1 − cos x)/x²; 1/2 at 0.
    pub versine: T,
    /// (x − sin x)/x³; 1/6 at 0.
    pub excess: T,
}

impl<T: Scalar> Sines<T> {
    /// Returns the ratios for the angle whose square (rad²) is `square`: all are even functions.
    ///
    /// With ε the distance from 1 to the next number: up to 2 rad the ratios have relative errors, and the
    /// cosine an absolute one, below 2ε. Beyond, the angle is a rounded root: errors grow with the angle, and
    /// are absolute near the zeros of 1 − cos x and sin x.
    pub fn of_square(square: T) -> Self {
        let one = T::from_f64(1.0);
        let near = square.less(T::from_f64(SWITCH));
        let far = T::select(near, one, square);
        let angle = far.sqrt();
        let (s, c) = angle.sin_cos();
        let ratio = s / angle;
        let (versine, excess) = (series(&EVEN, square), series(&ODD, square));
        Self {
            cosine: T::select(near, one - square * versine, c),
            sine: T::select(near, one - square * excess, ratio),
            versine: T::select(near, versine, (one - c) / far),
            excess: T::select(near, excess, (one - ratio) / far),
        }
    }
}

/// Ratios of an angle x, its sine and cosine that the derivative of a group's exponential is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ExponentialSeries<T> {
    /// Those of lower order.
    sines: Sines<T>,
    /// (1/2 − (1 − cos x)/x²)/x²; 1/24 at 0.
    versine_rest: T,
    /// (1/6 − (x − sin x)/x³)/x²; 1/120 at 0.
    excess_rest: T,
}

impl<T: Scalar> ExponentialSeries<T> {
    /// Returns the ratios for the angle whose square (rad²) is `square`.
    pub(super) fn of_square(square: T) -> Self {
        let sines = Sines::of_square(square);
        let near = square.less(T::from_f64(SWITCH));
        let far = T::select(near, T::from_f64(1.0), square);
        let (half, sixth) = (T::from_f64(0.5), T::from_parts(1.0 / 6.0, SIXTH_REST));
        let rest = |whole: T, ratio: T, coefficients| {
            T::select(near, series(coefficients, square), (whole - ratio) / far)
        };
        Self {
            versine_rest: rest(half, sines.versine, &EVEN_FROM_FOUR),
            excess_rest: rest(sixth, sines.excess, &ODD_FROM_FIVE),
            sines,
        }
    }

    /// Returns c₁ … c₄ of (exp A − 1)/A = 1 + c₁ A + c₂ A² + c₃ A³ + c₄ A⁴ for matrices with A (A² + x²)² = 0: brackets
    /// of rotations and of twists (Barfoot and Furgale 2014, with the quotients in a form without cancellation at 0).
    pub(super) fn coefficients(&self) -> [T; 4] {
        let half = T::from_f64(0.5);
        let Sines {
            sine,
            versine,
            excess,
            ..
        } = self.sines;
        let (b, c) = (self.versine_rest, self.excess_rest);
        [
            versine + versine - half * sine,
            half * (T::from_f64(5.0) * excess - versine),
            half * (excess - (b + b)),
            half * (b - T::from_f64(3.0) * c),
        ]
    }
}

/// Returns sin(x)/x for an angle x in radians; 1 at 0.
pub fn sine_ratio<T: Scalar>(x: T) -> T {
    let one = T::from_f64(1.0);
    let square = x * x;
    let near = square.less(T::from_f64(SWITCH));
    let far = T::select(near, one, x);
    let (s, _) = far.sin_cos();
    T::select(near, one - square * series(&ODD, square), s / far)
}

/// Returns x/sin(x) of the angle x in [0, π/2] with the cosine `cosine` and the square of the sine
/// `square`; 1 at 0. Their rounding errors must be small: `square + cosine²` = 1.
///
/// There is no root or reciprocal of a number that can vanish, and no selection.
pub fn arc_ratio<T: Scalar>(square: T, cosine: T) -> T {
    let (half, one) = (T::from_f64(0.5), T::from_f64(1.0));
    // With xₖ = x/2ᵏ: cos xₖ from cos xₖ₋₁, sin xₖ = sin x/(2ᵏ cos x₁ … cos xₖ).
    let (last, product) = (0..HALVINGS).fold((cosine, one), |(cosine, product), _| {
        let halved = (half * (one + cosine)).sqrt();
        (halved, product * halved)
    });
    // x/sin x = 2ᵏ (xₖ/tan xₖ) (tan xₖ/sin x).
    let share = one / (product * last);
    let tangent = T::from_f64(POWER) * share;
    share * series(&ARC, square * (tangent * tangent))
}

/// Returns c₀ − c₁ x + c₂ x² − …
fn series<T: Scalar, const K: usize>(coefficients: &[Words; K], x: T) -> T {
    let minus = -x;
    let zero = T::from_f64(0.0);
    coefficients.iter().rev().fold(zero, |sum, &(hi, lo)| {
        sum.mul_add(minus, T::from_parts(hi, lo))
    })
}

/// Returns 1/first!, 1/(first + 2)!, …
const fn inverse_factorials(first: u32) -> [Words; TERMS] {
    let mut all = [(0.0, 0.0); TERMS];
    let (mut value, mut n, mut k) = ((1.0, 0.0), 1, 0);
    while k < TERMS {
        while n < first + 2 * k as u32 {
            n += 1;
            value = divided(value, n);
        }
        all[k] = value;
        k += 1;
    }
    all
}

/// Returns 1, 1/3, 1/5, …
const fn odd_reciprocals() -> [Words; ARC_TERMS] {
    let mut all = [(0.0, 0.0); ARC_TERMS];
    let mut k = 0;
    while k < ARC_TERMS {
        all[k] = divided((1.0, 0.0), 2 * k as u32 + 1);
        k += 1;
    }
    all
}

/// Returns (hi + lo)/n for an n below 2¹¹.
const fn divided((hi, lo): Words, n: u32) -> Words {
    let n = n as f64;
    let quotient = hi / n;
    // Two halves of the quotient, whose products with n are exact.
    let upper = f64::from_bits(quotient.to_bits() >> 27 << 27);
    let lower = quotient - upper;
    let rest = ((hi - upper * n) - lower * n + lo) / n;
    let sum = quotient + rest;
    (sum, rest - (sum - quotient))
}
