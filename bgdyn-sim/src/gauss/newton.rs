//! Solves the linear equations of a simplified Newton step.

use bgdyn_runtime::{Scalar, StateVector};

use crate::lu::Lu;
use crate::real::{Of, Real};

/// I − h A ⊗ J, factored by blocks: a lower factor with the blocks `lower` beside the diagonal and those
/// of `diagonal`, and an upper one with the identity on the diagonal and the blocks `upper`.
pub(super) struct Blocks<Y: StateVector, const S: usize> {
    diagonal: [Option<Lu<Y>>; S],
    /// Blocks beside the diagonal: those of the lower factor below it, those of the upper factor above it.
    beside: [[Y::Matrix; S]; S],
}

impl<Y: StateVector, const S: usize> Blocks<Y, S>
where
    Of<Y>: Real,
{
    /// Factors the matrix; `None` if a block on the diagonal is singular.
    pub(super) fn new(
        a: &[[Of<Y>; S]; S],
        h: Of<Y>,
        jacobian: &Y::Matrix,
        like: &Y,
    ) -> Option<Self> {
        let mut blocks: [[Y::Matrix; S]; S] = core::array::from_fn(|i| {
            core::array::from_fn(|j| shifted(i == j, h * a[i][j], jacobian, like))
        });
        let mut diagonal: [Option<Lu<Y>>; S] = [const { None }; S];
        for k in 0..S {
            let factors = Lu::new(blocks[k][k].clone(), like)?;
            for j in k + 1..S {
                factors.solve_columns(&mut blocks[k][j]);
                let right = blocks[k][j].clone();
                for i in k + 1..S {
                    let left = blocks[i][k].clone();
                    take_product(&mut blocks[i][j], &left, &right, like);
                }
            }
            diagonal[k] = Some(factors);
        }
        Some(Blocks {
            diagonal,
            beside: blocks,
        })
    }

    /// Replaces x by the solution for the right-hand side x.
    pub(super) fn solve(&self, x: &mut [Y; S]) {
        let minus = -Of::<Y>::from_f64(1.0);
        for k in 0..S {
            for j in 0..k {
                let known = x[j].mapped(&self.beside[k][j]);
                x[k].add(minus, &known);
            }
            if let Some(factors) = &self.diagonal[k] {
                factors.solve(&mut x[k]);
            }
        }
        for k in (0..S).rev() {
            for j in k + 1..S {
                let known = x[j].mapped(&self.beside[k][j]);
                x[k].add(minus, &known);
            }
        }
    }
}

/// Returns 1 or 0 on the diagonal, minus k·J.
fn shifted<Y: StateVector>(identity: bool, k: Of<Y>, jacobian: &Y::Matrix, like: &Y) -> Y::Matrix {
    let mut matrix = like.matrix();
    for (m, &j) in Y::columns_mut(&mut matrix)
        .iter_mut()
        .zip(Y::columns(jacobian))
    {
        *m = -(k * j);
    }
    if identity {
        let n = like.entries().len();
        for m in Y::columns_mut(&mut matrix).iter_mut().step_by(n + 1) {
            *m = *m + Of::<Y>::from_f64(1.0);
        }
    }
    matrix
}

/// Computes m ← m − left·right.
fn take_product<Y: StateVector>(m: &mut Y::Matrix, left: &Y::Matrix, right: &Y::Matrix, like: &Y) {
    let n = like.entries().len();
    let (left, right) = (Y::columns(left), Y::columns(right));
    let m = Y::columns_mut(m);
    for j in 0..n {
        for k in 0..n {
            let factor = right[j * n + k];
            for i in 0..n {
                m[j * n + i] = m[j * n + i] - left[k * n + i] * factor;
            }
        }
    }
}
