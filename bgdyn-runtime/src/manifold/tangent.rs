//! Derivatives of the exponential of a group along the tangent, from the matrix of its bracket.
//!
//! With A the matrix of y ↦ \[d, y\], q∘exp(d) moves by exp(−A) δq + φ(−A) δd for small displacements δq of q and
//! changes δd of d, φ(X) = (exp X − 1)/X. For rotations and twists A (A² + x²)² = 0 with the angle x of d, so that φ is
//! a polynomial of degree 4 in A.

use super::functions::ExponentialSeries;
use crate::Scalar;

/// A square matrix, column by column.
pub(crate) type Columns<T, const N: usize> = [[T; N]; N];

/// Returns (∂/∂q, ∂/∂d) of q∘exp(d) along the tangent: exp(−A) and φ(−A). `bracket` is A, `square` the square of the
/// angle of d, rad².
pub(super) fn integration_maps<T: Scalar, const N: usize>(
    bracket: &Columns<T, N>,
    square: T,
) -> [Columns<T, N>; 2] {
    let [c1, c2, c3, c4] = ExponentialSeries::of_square(square).coefficients();
    // Horner's rule: 1 − A (c1 − A (c2 − A (c3 − A c4))).
    let mut phi = multiple_of_one(c4);
    for c in [c3, c2, c1, T::from_f64(1.0)] {
        phi = multiple_of_one_minus(c, &product(bracket, &phi));
    }
    let exponential = multiple_of_one_minus(T::from_f64(1.0), &product(bracket, &phi));
    [exponential, phi]
}

/// Returns the columns of y ↦ x × y.
pub(super) fn cross_columns<T: Scalar>([x, y, z]: [T; 3]) -> Columns<T, 3> {
    let zero = T::from_f64(0.0);
    [[zero, z, -y], [-z, zero, x], [y, -x, zero]]
}

fn multiple_of_one<T: Scalar, const N: usize>(c: T) -> Columns<T, N> {
    let zero = T::from_f64(0.0);
    core::array::from_fn(|j| core::array::from_fn(|i| if i == j { c } else { zero }))
}

fn multiple_of_one_minus<T: Scalar, const N: usize>(c: T, a: &Columns<T, N>) -> Columns<T, N> {
    let mut difference = multiple_of_one(c);
    for (to, from) in difference.iter_mut().flatten().zip(a.iter().flatten()) {
        *to = *to - *from;
    }
    difference
}

fn product<T: Scalar, const N: usize>(a: &Columns<T, N>, b: &Columns<T, N>) -> Columns<T, N> {
    b.map(|column| {
        let mut sum = [T::from_f64(0.0); N];
        for (of_a, y) in a.iter().zip(column) {
            for (sum, &x) in sum.iter_mut().zip(of_a) {
                *sum = x.mul_add(y, *sum);
            }
        }
        sum
    })
}
