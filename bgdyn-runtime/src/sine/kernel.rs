//! The branch-free kernel of sine and cosine: reduction by parts of π/2, then two polynomials.

use super::lanes::{Coefficients, Polynomial, SineLanes};

/// Returns sine and cosine of `angle` + `tail`, for an angle within [`SineLanes::LIMIT`] and a tail within
/// [`SineLanes::TAIL_LIMIT`].
#[inline(always)]
pub fn sin_cos_in_range<P: SineLanes>(angle: P, tail: Option<P>) -> (P, P) {
    let (quarters, r, low) = reduced(angle, tail);
    let (s, c) = of_rest(r, low);
    P::turned(quarters, s, c)
}

/// Returns n, with its last two binary digits at the end of the significand, and angle + tail − n π/2
/// as r + low.
#[inline(always)]
fn reduced<P: SineLanes>(angle: P, tail: Option<P>) -> (P, P, P) {
    let Coefficients {
        exact,
        middle,
        last,
        ..
    } = P::COEFFICIENTS;
    // Adding 1.5·2^52 (or 2^23) rounds to a whole number and leaves it in the low digits.
    let magic = P::splat(P::MAGIC);
    let quarters = angle.fused(P::splat(core::f64::consts::FRAC_2_PI), magic);
    let n = quarters - magic;
    // n times these parts is exact, and so are the differences: the result has at most as many digits as a
    // number can have.
    let mut rest = n.minus_product(P::splat(exact.0), angle);
    if let Some(part) = exact.1 {
        rest = n.minus_product(P::splat(part), rest);
    }
    let part = P::splat(middle);
    let Some(tail) = tail else {
        // n times the middle part is exact, and it is available as early as the rest: a fused operation
        // saves no time. The difference is exact if the rest is smaller; otherwise this is Dekker's sum,
        // and `error` is its rounding error.
        let taken = n * part;
        let difference = rest - taken;
        let error = (rest - difference) - taken;
        let low = n.minus_product(P::splat(last), error);
        return (quarters, difference, low);
    };
    // Subtract n times the middle part minus the tail: the tail is available as early as n, and the rest
    // does not wait for it. It can be far larger than the rest, so `left` is the rounding error of
    // `taken`, and `error` that of the difference.
    let taken = n.fused(part, -tail);
    let difference = rest - taken;
    let left = n.fused(part, -taken) - tail;
    let error = ((rest - difference) - taken) - left;
    let low = n.minus_product(P::splat(last), error);
    (quarters, difference, low)
}

/// Returns sine and cosine of r + low, |r| ≤ π/4.
///
/// sin r = r + r³ S(r²), cos r = 1 − r²/2 + r⁴ C(r²). The large terms are added last, so that only their
/// roundings matter; the rounding error of 1 − r²/2 is added separately.
#[inline(always)]
pub(super) fn of_rest<P: SineLanes>(r: P, low: P) -> (P, P) {
    let Coefficients { sine, cosine, .. } = P::COEFFICIENTS;
    let (one, half) = (P::splat(1.0), P::splat(0.5));
    let square = r * r;
    let (s, c) = (polynomial(square, sine), polynomial(square, cosine));
    let halved = half * square;
    let small = (r * square).fused(s, halved.minus_product(low, low));
    let rounded = one - halved;
    let rest = (one - rounded) - halved;
    // Not fused: `low` is available late, and a difference takes less time.
    let tiny = (square * square).fused(c, rest - r * low);
    (r + small, rounded + tiny)
}

/// Evaluates the polynomial in pairs of terms, which halves the number of dependent steps.
#[inline(always)]
fn polynomial<P: SineLanes>(x: P, coefficients: Polynomial) -> P {
    let square = x * x;
    let pair = |constant, linear| x.fused(P::splat(linear), P::splat(constant));
    match coefficients {
        Polynomial::Three([a, b, c]) => P::splat(c).fused(square, pair(a, b)),
        Polynomial::Six([a, b, c, d, e, f]) => {
            let high = pair(e, f).fused(square, pair(c, d));
            high.fused(square, pair(a, b))
        }
    }
}
