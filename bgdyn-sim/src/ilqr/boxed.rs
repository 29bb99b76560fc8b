//! The minimum of a quadratic function in a box, by Newton steps projected onto it (Bertsekas 1982; Tassa, Mansard and
//! Todorov 2014).

use super::rows::inner;
use crate::real::Real;

/// Most iterations.
const ITERATIONS: usize = 20;
/// Most halvings of a projected step.
const HALVINGS: usize = 10;

/// The lower factor of a positive definite matrix, with the rows of clamped components those of the unit matrix.
pub(super) struct Factor<T, const N: usize> {
    /// L, row by row, with zeros above the diagonal.
    pub(super) rows: [[T; N]; N],
    /// 1/L_ii.
    pub(super) reciprocals: [T; N],
}

impl<T: Real, const N: usize> Factor<T, N> {
    /// Factors the rows and columns of the free components; `None` if a pivot is not positive.
    ///
    /// Row by row of Lᵀ: the multiples of a row are taken from all rows below it, over their whole length, because loops
    /// of constant length become vector instructions. Entries left of the diagonal are not read.
    #[inline]
    pub(super) fn new(matrix: &[[T; N]; N], free: &[bool; N]) -> Option<Self> {
        let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
        let mut upper = *matrix;
        for i in 0..N {
            if !free[i] {
                upper[i] = core::array::from_fn(|j| if i == j { one } else { zero });
                upper.iter_mut().take(i).for_each(|row| row[i] = zero);
            }
        }
        let (mut reciprocals, mut sound) = ([one; N], true);
        for k in 0..N {
            let pivot = upper[k][k];
            sound &= pivot > zero && pivot.is_finite();
            reciprocals[k] = one / pivot.sqrt();
            let row = upper[k].map(|x| x * reciprocals[k]);
            upper[k] = row;
            for i in k + 1..N {
                let factor = -row[i];
                upper[i] = core::array::from_fn(|j| factor.mul_add(row[j], upper[i][j]));
            }
        }
        let entry = |i: usize, j: usize| if j <= i { upper[j][i] } else { zero };
        let rows = core::array::from_fn(|i| core::array::from_fn(|j| entry(i, j)));
        sound.then_some(Factor { rows, reciprocals })
    }

    /// Returns the solution of L Lᵀ x = b.
    fn solve(&self, b: &[T; N]) -> [T; N] {
        let mut x = *b;
        for i in 0..N {
            let rest = (0..i).fold(x[i], |rest, k| (-self.rows[i][k]).mul_add(x[k], rest));
            x[i] = rest * self.reciprocals[i];
        }
        for i in (0..N).rev() {
            let rest = (i + 1..N).fold(x[i], |rest, k| (-self.rows[k][i]).mul_add(x[k], rest));
            x[i] = rest * self.reciprocals[i];
        }
        x
    }
}

/// The minimum in the box.
pub(super) struct BoxMinimum<T, const N: usize> {
    /// Its place.
    pub(super) at: [T; N],
    /// Components that are not held by a bound.
    pub(super) free: [bool; N],
    /// The factor of the matrix of the free components.
    pub(super) factor: Factor<T, N>,
}

/// Returns slope·x + ½ xᵀ matrix x.
fn value<T: Real, const N: usize>(matrix: &[[T; N]; N], slope: &[T; N], x: &[T; N]) -> T {
    let half = T::from_f64(0.5);
    let bent = matrix.each_ref().map(|row| half * inner(row, x));
    inner(&core::array::from_fn(|i| slope[i] + bent[i]), x)
}

/// Minimises slope·x + ½ xᵀ matrix x; in a box, from `lower` to `upper`, if there is one. `None` if the matrix of the
/// free components is not positive definite.
#[inline]
pub(super) fn minimize<T: Real, const N: usize>(
    matrix: &[[T; N]; N],
    slope: &[T; N],
    room: Option<&[[T; N]; 2]>,
) -> Option<BoxMinimum<T, N>> {
    match room {
        Some(room) => minimize_in_box(matrix, slope, room),
        None => {
            let free = [true; N];
            let factor = Factor::new(matrix, &free)?;
            let at = factor.solve(&slope.map(|x| -x));
            Some(BoxMinimum { at, free, factor })
        }
    }
}

/// [`minimize`] in a box. A component is held where it is at a bound and the slope pushes it outwards; the others take a
/// Newton step, projected onto the box. The minimum is found when a whole step leaves the same components held.
fn minimize_in_box<T: Real, const N: usize>(
    matrix: &[[T; N]; N],
    slope: &[T; N],
    [lower, upper]: &[[T; N]; 2],
) -> Option<BoxMinimum<T, N>> {
    let zero = T::from_f64(0.0);
    let clamp = |i: usize, x: T| x.max(lower[i]).min(upper[i]);
    let mut x: [T; N] = core::array::from_fn(|i| clamp(i, zero));
    let mut result: Option<(BoxMinimum<T, N>, bool)> = None;
    for _ in 0..ITERATIONS {
        let gradient: [T; N] = core::array::from_fn(|i| slope[i] + inner(&matrix[i], &x));
        let free: [bool; N] = core::array::from_fn(|i| {
            !((x[i] <= lower[i] && gradient[i] > zero)
                || (x[i] >= upper[i] && gradient[i] < zero)
                || lower[i] == upper[i])
        });
        if let Some((least, true)) = &result
            && least.free == free
        {
            break;
        }
        let factor = Factor::new(matrix, &free)?;
        let towards = core::array::from_fn(|i| if free[i] { -gradient[i] } else { zero });
        let newton = factor.solve(&towards);
        let (at, whole) = projected(matrix, slope, &x, &newton, clamp);
        x = at;
        result = Some((BoxMinimum { at, free, factor }, whole));
    }
    result.map(|(least, _)| least)
}

/// Returns the first point on the projected way along the step that lowers the value, from the whole step on; and
/// whether there is nothing to come: the whole step is inside the box, or no part of it lowers the value.
fn projected<T: Real, const N: usize>(
    matrix: &[[T; N]; N],
    slope: &[T; N],
    x: &[T; N],
    step: &[T; N],
    clamp: impl Fn(usize, T) -> T,
) -> ([T; N], bool) {
    let whole: [T; N] = core::array::from_fn(|i| x[i] + step[i]);
    if (0..N).all(|i| clamp(i, whole[i]) == whole[i]) {
        return (whole, true);
    }
    let here = value(matrix, slope, x);
    let mut share = T::from_f64(1.0);
    for _ in 0..HALVINGS {
        let there = core::array::from_fn(|i| clamp(i, share.mul_add(step[i], x[i])));
        if value(matrix, slope, &there) < here {
            return (there, false);
        }
        share = share * T::from_f64(0.5);
    }
    (*x, true)
}
