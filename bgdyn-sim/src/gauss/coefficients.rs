//! Coefficients of the Gauss–Legendre methods for any number of stages.
//!
//! With the shifted Legendre polynomials P̄ₖ(x) = √(2k+1) Pₖ(2x − 1), Wᵢₖ = P̄ₖ(cᵢ) and the weights B,
//! A = W X Wᵀ B, where X is ½ in its corner and ±1/(2√(4k² − 1)) beside its diagonal (Hairer, Wanner,
//! Solving Ordinary Differential Equations II, IV.5). All are computed in double-double and rounded once.

use bgdyn_runtime::Dd;

use crate::lu;
use crate::real::Real;

/// Times c, weights a of the stages, weights b of the step, and d with b = Aᵀ d.
#[derive(Clone, Debug)]
pub(super) struct Coefficients<T, const S: usize> {
    pub(super) c: [T; S],
    pub(super) a: [[Split<T>; S]; S],
    pub(super) b: [Split<T>; S],
    pub(super) d: [T; S],
}

/// A coefficient in two parts: a multiple of 2⁻¹⁰, and the remainder.
///
/// A rounded coefficient has the same error in every step, so the energy drifts. The first part is exact,
/// and the rounding of the second is a thousand times smaller (Hairer, McLachlan, Razakarivony, Achieving
/// Brouwer's law with implicit Runge–Kutta methods, 2008).
#[derive(Clone, Copy, Debug)]
pub(super) struct Split<T> {
    pub(super) short: T,
    pub(super) rest: T,
}

impl<T: Real> Split<T> {
    fn new(x: Dd) -> Self {
        let short = libm::round(x.to_f64() * 1024.0) / 1024.0;
        let rest = x - Dd::from_f64(short);
        Split {
            short: T::from_f64(short),
            rest: T::from_parts(rest.hi(), rest.lo()),
        }
    }

    /// Returns the sum of both parts, rounded.
    pub(super) fn whole(self) -> T {
        self.short + self.rest
    }
}

fn number(k: usize) -> Dd {
    // Exact, because the numbers of stages are small.
    Dd::from_f64(k as f64)
}

/// Returns the Legendre polynomials P₀ … P_{S−1} at x, P_S, and the derivative of P_S.
fn legendre<const S: usize>(x: Dd) -> ([Dd; S], Dd, Dd) {
    let mut lower = [Dd::ONE; S];
    let (mut last, mut now) = (Dd::ZERO, Dd::ONE);
    for k in 0..S {
        lower[k] = now;
        // (k + 1) Pₖ₊₁ = (2k + 1) x Pₖ − k Pₖ₋₁
        let next = (number(2 * k + 1) * x * now - number(k) * last) / number(k + 1);
        (last, now) = (now, next);
    }
    let slope = number(S) * (last - x * now) / (Dd::ONE - x * x);
    (lower, now, slope)
}

impl<T: Real, const S: usize> Coefficients<T, S> {
    pub(super) fn new() -> Self {
        let half = Dd::from_f64(0.5);
        let mut c = [Dd::ZERO; S];
        let mut b = [Dd::ZERO; S];
        let mut w = [[Dd::ZERO; S]; S];
        for i in 0..S {
            // The zeros of P_S by Newton's method.
            let angle = Dd::PI * (number(S - i) - Dd::from_f64(0.25)) / (number(S) + half);
            let mut x = angle.sin_cos().1;
            for _ in 0..8 {
                let (_, value, slope) = legendre::<S>(x);
                x -= value / slope;
            }
            let (lower, _, slope) = legendre::<S>(x);
            c[i] = half + half * x;
            b[i] = Dd::ONE / ((Dd::ONE - x * x) * slope * slope);
            for k in 0..S {
                w[i][k] = number(2 * k + 1).sqrt() * lower[k];
            }
        }
        let a = stage_weights(&w, &b);
        let d = step_weights(&a, b);
        let rounded = |x: Dd| T::from_parts(x.hi(), x.lo());
        Coefficients {
            c: c.map(rounded),
            a: a.map(|row| row.map(Split::new)),
            b: b.map(Split::new),
            d: d.map(rounded),
        }
    }
}

/// Returns A = W X Wᵀ B.
fn stage_weights<const S: usize>(w: &[[Dd; S]; S], b: &[Dd; S]) -> [[Dd; S]; S] {
    let half = Dd::from_f64(0.5);
    let mut a = [[Dd::ZERO; S]; S];
    for i in 0..S {
        for j in 0..S {
            let mut sum = half * w[i][0] * w[j][0];
            for k in 1..S {
                let beside = half / number(4 * k * k - 1).sqrt();
                sum += beside * (w[i][k] * w[j][k - 1] - w[i][k - 1] * w[j][k]);
            }
            a[i][j] = sum * b[j];
        }
    }
    a
}

/// Solves Aᵀ d = b: d are the weights of the stages' displacements in the step.
fn step_weights<const S: usize>(a: &[[Dd; S]; S], b: [Dd; S]) -> [Dd; S] {
    // The rows of A are the columns of Aᵀ. A is regular, so the factors always exist.
    let mut transposed = *a;
    let mut pivots = [0; S];
    let mut d = b;
    lu::factor(transposed.as_flattened_mut(), &mut pivots, S);
    lu::solve(transposed.as_flattened(), &pivots, &mut d);
    d
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks the integrals of polynomials from 0 to cᵢ and over the whole step: C(S) and B(2S).
    fn conditions<const S: usize>() {
        let k = Coefficients::<Dd, S>::new();
        let power = |x: Dd, n: usize| (0..n).fold(Dd::ONE, |p, _| p * x);
        for n in 1..=2 * S {
            let whole = (0..S).fold(Dd::ZERO, |sum, j| {
                sum + k.b[j].whole() * power(k.c[j], n - 1)
            });
            let off = whole - Dd::ONE / number(n);
            assert!(off.abs() < Dd::from_f64(1e-30), "B({n}) of {S}: {off}");
        }
        for (i, n) in (0..S).flat_map(|i| (1..=S).map(move |n| (i, n))) {
            let part = (0..S).fold(Dd::ZERO, |sum, j| {
                sum + k.a[i][j].whole() * power(k.c[j], n - 1)
            });
            let off = part - power(k.c[i], n) / number(n);
            assert!(
                off.abs() < Dd::from_f64(1e-30),
                "C({n}) of {S}, stage {i}: {off}"
            );
        }
        for j in 0..S {
            let back = (0..S).fold(Dd::ZERO, |sum, i| sum + k.d[i] * k.a[i][j].whole());
            assert!(
                (back - k.b[j].whole()).abs() < Dd::from_f64(1e-29),
                "d of {S}"
            );
        }
    }

    #[test]
    fn order_conditions_hold_in_double_double() {
        conditions::<1>();
        conditions::<2>();
        conditions::<3>();
        conditions::<4>();
        conditions::<6>();
        let three = Coefficients::<f64, 3>::new();
        assert!((three.c[0] - (0.5 - 15.0_f64.sqrt() / 10.0)).abs() < 1e-16);
    }
}
