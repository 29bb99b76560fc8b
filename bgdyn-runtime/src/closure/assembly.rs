//! Levenberg and Marquardt's method for the positions of kinematic loops and wheels, from anywhere.

use nalgebra::{SMatrix, SVector};

use super::{Closing, LARGEST, all_positive};
use crate::Scalar;
use crate::singular::{BRANCHES, NOT_ASSEMBLED};

/// The attempts: the share of the way from the guess to a closed position at which one begins, and its number of
/// steps; 64 in all.
pub const ATTEMPTS: [(f64, usize); 3] = [(0.0, 28), (0.5, 18), (1.0, 18)];

/// The damping at the beginning, over the largest diagonal entry of J Jᵀ; its factors after a step that closes the
/// loops further, and after one that does not; the least one.
pub const DAMPING: [f64; 4] = [1e-3, 0.02, 8.0, 1e-22];

/// Largest residual, m or rad, after which one more step is exact to rounding, in scalars with the digits of `f64`;
/// in those with fewer.
pub const CLOSED: [f64; 2] = [1e-10, 1e-5];

/// Rows of one block of conditions, and its dependent velocities: their determinant tells the branch.
#[derive(Clone, Copy, Debug)]
pub struct BranchBlock {
    /// The rows.
    pub rows: &'static [usize],
    /// As many velocities of the open tree.
    pub columns: &'static [usize],
    /// Whether the determinant is positive on the branch of the mechanism.
    pub positive: bool,
    /// The index of its loop.
    pub closes: usize,
}

/// What positions are assembled to.
#[derive(Clone, Copy, Debug)]
pub struct Conditions<const NC: usize> {
    /// For each row, the index of its loop; `None` for a row that is no condition on positions.
    pub rows: [Option<usize>; NC],
    /// The blocks that tell the branch.
    pub blocks: &'static [BranchBlock],
    /// Velocities of the joints in loops with a position of their own, and these positions.
    pub joints: &'static [(usize, usize)],
}

/// The functions of a mechanism that assembly uses.
pub struct Mechanism<C, J, M> {
    /// Residuals of all rows at a position.
    pub residual: C,
    /// Rates of all rows for the velocities of the open tree at a position.
    pub jacobian: J,
    /// The position after constant velocities of the open tree.
    pub moved: M,
}

/// Changes the positions of the velocities that are `free` so that all loops close on the branch of the mechanism, each
/// step the shortest one for its damping. The first attempt begins at `ends.0`, the guess, further ones on the way to
/// `ends.1`, a closed position; together they have at most 64 steps. Where there is no such position, the error has the
/// first loop that remains open, with the cause [`crate::Cause::NotAssembled`], or is on another branch, with
/// [`crate::Cause::Branch`], at the end of the first attempt.
pub fn assemble<T, C, J, M, const NQ: usize, const NT: usize, const NC: usize>(
    ends: [SVector<T, NQ>; 2],
    conditions: &Conditions<NC>,
    free: &[bool; NT],
    of: &Mechanism<C, J, M>,
) -> Closing<SVector<T, NQ>>
where
    T: Scalar,
    C: Fn(&SVector<T, NQ>) -> SVector<T, NC>,
    J: Fn(&SVector<T, NQ>) -> SMatrix<T, NC, NT>,
    M: Fn(&SVector<T, NQ>, &SVector<T, NT>) -> SVector<T, NQ>,
{
    let [guess, closed] = ends;
    let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
    // Joints of several degrees of freedom have no straight way to another position: one attempt with all steps.
    let first = match conditions.joints.is_empty() {
        true => ATTEMPTS.iter().map(|(_, steps)| steps).sum(),
        false => ATTEMPTS[0].1,
    };
    let mut best = descend(guess, first, (conditions, free), of);
    let mut found = fits(&best, conditions, of);
    for (share, steps) in ATTEMPTS.into_iter().skip(1) {
        if conditions.joints.is_empty() || all_positive(found) {
            break;
        }
        let mut begin = guess;
        for &(velocity, position) in conditions.joints {
            let moves = free.get(velocity).copied().unwrap_or(false);
            if let (true, Some(q), Some(&to)) =
                (moves, begin.get_mut(position), closed.get(position))
            {
                *q = *q + (to - *q) * T::from_f64(share);
            }
        }
        let other = descend(begin, steps, (conditions, free), of);
        let other_fits = fits(&other, conditions, of);
        // A lane that was found stays.
        let takes = || zero.less(other_fits * (one - found));
        best = best.zip_map(&other, |old, new| T::select(takes(), new, old));
        found = found.max(other_fits);
    }
    let mut refused = T::none_refused();
    check(&best, conditions, of, |value, place| {
        value.checked_pivot(zero, place, &mut refused);
    });
    Closing {
        q: best,
        last: zero,
        refused,
    }
}

/// Calls `see` with a number for each row and then for each block of the branch, which is positive where the row holds
/// and on the branch; and with the place of its loop among the causes.
fn check<T, C, J, M, const NQ: usize, const NT: usize, const NC: usize>(
    q: &SVector<T, NQ>,
    conditions: &Conditions<NC>,
    of: &Mechanism<C, J, M>,
    mut see: impl FnMut(T, usize),
) where
    T: Scalar,
    C: Fn(&SVector<T, NQ>) -> SVector<T, NC>,
    J: Fn(&SVector<T, NQ>) -> SMatrix<T, NC, NT>,
{
    let tolerance = closed::<T>();
    let residual = (of.residual)(q);
    for (row, c) in conditions.rows.iter().zip(residual.iter()) {
        if let Some(closes) = row {
            see(tolerance - c.abs(), NOT_ASSEMBLED + NQ + closes);
        }
    }
    if conditions.blocks.is_empty() {
        return;
    }
    let jacobian = (of.jacobian)(q);
    for block in conditions.blocks {
        let determinant = determinant(&jacobian, block);
        let signed = if block.positive {
            determinant
        } else {
            -determinant
        };
        see(signed, BRANCHES + NQ + block.closes);
    }
}

/// Returns 1 where all rows hold on the branch of the mechanism, else 0.
fn fits<T, C, J, M, const NQ: usize, const NT: usize, const NC: usize>(
    q: &SVector<T, NQ>,
    conditions: &Conditions<NC>,
    of: &Mechanism<C, J, M>,
) -> T
where
    T: Scalar,
    C: Fn(&SVector<T, NQ>) -> SVector<T, NC>,
    J: Fn(&SVector<T, NQ>) -> SMatrix<T, NC, NT>,
{
    let zero = T::from_f64(0.0);
    let mut all = T::from_f64(1.0);
    check(q, conditions, of, |value, _| {
        all = T::select(zero.less(value), all, zero);
    });
    all
}

/// Returns the residual below which one more step is exact to rounding.
fn closed<T: Scalar>() -> T {
    let [fine, coarse] = CLOSED.map(T::from_f64);
    let (one, half) = (T::from_f64(1.0), T::from_f64(0.5));
    let kept = (one + fine) - one;
    T::select(kept.less(fine * half), coarse, fine)
}

/// Returns Levenberg and Marquardt's position after at most `steps` steps from `q`: x = −Jᵀ (J Jᵀ + μ 1)⁻¹ c, the
/// shortest of the x with the least |c + J x|² + μ |x|²; taken if |c| becomes less.
fn descend<T, C, J, M, const NQ: usize, const NT: usize, const NC: usize>(
    mut q: SVector<T, NQ>,
    steps: usize,
    (conditions, free): (&Conditions<NC>, &[bool; NT]),
    of: &Mechanism<C, J, M>,
) -> SVector<T, NQ>
where
    T: Scalar,
    C: Fn(&SVector<T, NQ>) -> SVector<T, NC>,
    J: Fn(&SVector<T, NQ>) -> SMatrix<T, NC, NT>,
    M: Fn(&SVector<T, NQ>, &SVector<T, NT>) -> SVector<T, NQ>,
{
    let number = T::from_f64;
    let (zero, one) = (number(0.0), number(1.0));
    let [mut damping, smaller, larger, least] = DAMPING.map(number);
    let mut residual = positions_only((of.residual)(&q), conditions);
    for _ in 0..steps {
        let worst = residual.iter().fold(zero, |most, c| most.max(c.abs()));
        let near = all_positive(closed::<T>() - worst);
        let mut jacobian = (of.jacobian)(&q);
        for (mut column, free) in jacobian.column_iter_mut().zip(free) {
            for (entry, row) in column.iter_mut().zip(&conditions.rows) {
                if row.is_none() || !free {
                    *entry = zero;
                }
            }
        }
        let mut x = shortest(&jacobian, &residual, damping);
        let largest = x.iter().fold(zero, |most, x| most.max(x.abs()));
        let scale = T::select(
            number(LARGEST).less(largest),
            number(LARGEST) / largest,
            one,
        );
        x = x.map(|x| x * scale);
        let moved = (of.moved)(&q, &x);
        let found = positions_only((of.residual)(&moved), conditions);
        let better = || square(&found).less(square(&residual));
        q = q.zip_map(&moved, |old, new| T::select(better(), new, old));
        damping = T::select(better(), (damping * smaller).max(least), damping * larger);
        residual = residual.zip_map(&found, |old, new| T::select(better(), new, old));
        if near {
            break;
        }
    }
    q
}

/// Returns the residuals with zero for rows that are no conditions on positions.
fn positions_only<T: Scalar, const NC: usize>(
    mut residual: SVector<T, NC>,
    conditions: &Conditions<NC>,
) -> SVector<T, NC> {
    for (c, row) in residual.iter_mut().zip(&conditions.rows) {
        if row.is_none() {
            *c = T::from_f64(0.0);
        }
    }
    residual
}

fn square<T: Scalar, const N: usize>(x: &SVector<T, N>) -> T {
    x.iter().fold(T::from_f64(0.0), |sum, &x| sum + x * x)
}

/// Returns −Jᵀ (J Jᵀ + μ 1)⁻¹ c, by L D Lᵀ; μ is `damping` times the largest diagonal entry of J Jᵀ, or `damping`.
fn shortest<T: Scalar, const NT: usize, const NC: usize>(
    jacobian: &SMatrix<T, NC, NT>,
    residual: &SVector<T, NC>,
    damping: T,
) -> SVector<T, NT> {
    let zero = T::from_f64(0.0);
    let mut a = [[zero; NC]; NC];
    for column in jacobian.column_iter() {
        for (row, &x) in a.iter_mut().zip(column.iter()) {
            for (entry, &y) in row.iter_mut().zip(column.iter()) {
                *entry = x.mul_add(y, *entry);
            }
        }
    }
    let largest = (0..NC).fold(zero, |most, i| most.max(a[i][i]));
    let largest = T::select(zero.less(largest), largest, T::from_f64(1.0));
    let mut y = [zero; NC];
    for (y, &c) in y.iter_mut().zip(residual.iter()) {
        *y = c;
    }
    for i in 0..NC {
        a[i][i] = a[i][i] + damping * largest;
    }
    for k in 0..NC {
        for i in k + 1..NC {
            let factor = a[i][k] / a[k][k];
            for j in k + 1..NC {
                a[i][j] = a[i][j] - factor * a[k][j];
            }
            y[i] = y[i] - factor * y[k];
        }
    }
    for k in (0..NC).rev() {
        for j in k + 1..NC {
            y[k] = y[k] - a[k][j] * y[j];
        }
        y[k] = y[k] / a[k][k];
    }
    let mut x = SVector::<T, NT>::from_element(zero);
    for (x, column) in x.iter_mut().zip(jacobian.column_iter()) {
        let along = column.iter().zip(&y);
        *x = -along.fold(zero, |sum, (&b, &y)| sum + b * y);
    }
    x
}

/// Returns a number with the sign of the determinant of a block, by Householder's reflections: the product of the
/// lengths of the columns that are left, and of the signs of their first entries. Beside the block the matrix is 1.
fn determinant<T: Scalar, const NT: usize, const NC: usize>(
    jacobian: &SMatrix<T, NC, NT>,
    block: &BranchBlock,
) -> T {
    let (zero, one) = (T::from_f64(0.0), T::from_f64(1.0));
    let mut a = [[zero; NC]; NC];
    for (i, row) in a.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            let own = block.rows.get(i).zip(block.columns.get(j));
            let inside = own.and_then(|(&r, &c)| jacobian.get((r, c)).copied());
            *entry = inside.unwrap_or(if i == j { one } else { zero });
        }
    }
    let mut found = one;
    for k in 0..NC {
        if k + 1 >= block.rows.len() {
            // The last column of the block is one number.
            return if k < block.rows.len() {
                found * a[k][k]
            } else {
                found
            };
        }
        let length = (k..NC).fold(zero, |sum, i| sum + a[i][k] * a[i][k]).sqrt();
        let sign = T::select(a[k][k].less(zero), -one, one);
        found = found * sign * length;
        // v = column + sign · length · e_k, H = 1 − 2 v vᵀ / vᵀv
        let mut v = [zero; NC];
        for i in k..NC {
            v[i] = a[i][k];
        }
        v[k] = v[k] + sign * length;
        let half = length * (length + a[k][k].abs());
        for j in k + 1..NC {
            let along = (k..NC).fold(zero, |sum, i| sum + v[i] * a[i][j]);
            for i in k..NC {
                a[i][j] = a[i][j] - v[i] * (along / half);
            }
        }
    }
    found
}
