//! Linear equations at the samples of a controller.

use bgdyn_runtime::Scalar;
use bgdyn_runtime::nalgebra::SMatrix;

use crate::real::Real;

/// Most terms of a power series: with ‖A h‖ ≤ 1/2 the term k is below 2⁻ᵏ/k!, 1e-40 for k = 30.
const TERMS: u32 = 40;

/// Most halvings of h.
const HALVINGS: u32 = 64;

/// Returns Φ and Γ of y(t + h) = Φ y(t) + Γ u for ẏ = A y + B u with a constant u: zero-order hold.
///
/// They are blocks of an exponential (Van Loan 1978), exp(h [[A, B], [0, 0]]) = [[Φ, Γ], [0, 1]]. With h/2ˢ, for which
/// ‖A h/2ˢ‖ ≤ 1/2 in the norm of row sums, it is a power series, Φ = Σ (A h)ᵏ/k! and Γ = Σ (A h)ᵏ/(k + 1)! · h B. Its
/// s squarings are Γ ← (Φ + 1) Γ, Φ ← Φ Φ. The errors are roundings of the scalar `T`, of each squaring too.
///
/// Where A or B is not finite, neither are Φ and Γ.
pub fn discretised<T: Real, const N: usize, const M: usize>(
    a: &SMatrix<T, N, N>,
    b: &SMatrix<T, N, M>,
    h: T,
) -> (SMatrix<T, N, N>, SMatrix<T, N, M>) {
    let number = |x: f64| T::from_f64(x);
    let mut size = row_sums(a) * h.abs().to_f64();
    let (mut step, mut halvings) = (h, 0);
    while size > 0.5 && halvings < HALVINGS {
        size *= 0.5;
        step = step * number(0.5);
        halvings += 1;
    }
    let one = identity::<T, N>();
    // Of Σ (A h)ᵏ/(k + 1)!: Φ = 1 + (A h) Σ.
    let (mut sum, mut term) = (one, one);
    for k in 1..=TERMS {
        term = scaled(&product(a, &term), step / number(f64::from(k + 1)));
        let before = sum;
        sum = added(&sum, &term);
        if sum == before {
            break;
        }
    }
    let mut phi = added(&one, &scaled(&product(a, &sum), step));
    let mut gamma = scaled(&product(&sum, b), step);
    for _ in 0..halvings {
        gamma = product(&added(&phi, &one), &gamma);
        phi = product(&phi, &phi);
    }
    (phi, gamma)
}

/// Returns the largest sum of a row's sizes.
fn row_sums<T: Real, const N: usize>(a: &SMatrix<T, N, N>) -> f64 {
    let row = |i: usize| (0..N).map(|j| a[(i, j)].abs().to_f64()).sum::<f64>();
    (0..N).map(row).fold(0.0, f64::max)
}

fn identity<T: Scalar, const N: usize>() -> SMatrix<T, N, N> {
    SMatrix::from_fn(|i, j| T::from_f64(if i == j { 1.0 } else { 0.0 }))
}

fn product<T: Scalar, const N: usize, const K: usize, const M: usize>(
    a: &SMatrix<T, N, K>,
    b: &SMatrix<T, K, M>,
) -> SMatrix<T, N, M> {
    SMatrix::from_fn(|i, j| {
        let terms = (0..K).map(|k| a[(i, k)] * b[(k, j)]);
        terms.fold(T::from_f64(0.0), |sum, term| sum + term)
    })
}

fn added<T: Scalar, const N: usize, const M: usize>(
    a: &SMatrix<T, N, M>,
    b: &SMatrix<T, N, M>,
) -> SMatrix<T, N, M> {
    a.zip_map(b, |a, b| a + b)
}

fn scaled<T: Scalar, const N: usize, const M: usize>(
    a: &SMatrix<T, N, M>,
    factor: T,
) -> SMatrix<T, N, M> {
    a.map(|x| x * factor)
}
