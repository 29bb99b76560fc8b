//! The triangle R of a least-squares problem, updated block by block: rows of any number need R only.

use nalgebra::{DMatrix, DVector};

/// Rows that are added at once.
const BLOCK: usize = 256;

/// R of [A y], with AᵀA = RᵀR.
#[derive(Clone, Debug)]
pub struct Triangle {
    /// R and Qᵀy in one matrix.
    r: DMatrix<f64>,
    waiting: DMatrix<f64>,
    filled: usize,
}

impl Triangle {
    /// Returns the triangle of no rows.
    pub fn new(columns: usize) -> Self {
        Triangle {
            r: DMatrix::zeros(columns + 1, columns + 1),
            waiting: DMatrix::zeros(BLOCK, columns + 1),
            filled: 0,
        }
    }

    /// Adds a row, times its weight.
    pub fn push(&mut self, row: impl Iterator<Item = f64>, y: f64, weight: f64) {
        let last = self.waiting.ncols() - 1;
        for (c, x) in row.enumerate() {
            self.waiting[(self.filled, c)] = weight * x;
        }
        self.waiting[(self.filled, last)] = weight * y;
        self.filled += 1;
        if self.filled == BLOCK {
            self.reduce();
        }
    }

    /// Replaces R by that of R with the waiting rows under it (Householder).
    fn reduce(&mut self) {
        let n = self.r.ncols();
        let mut stacked = DMatrix::zeros(n + self.filled, n);
        stacked.rows_mut(0, n).copy_from(&self.r);
        let rows = self.waiting.rows(0, self.filled);
        stacked.rows_mut(n, self.filled).copy_from(&rows);
        self.r = stacked.qr().r();
        self.filled = 0;
    }

    /// Returns R and Qᵀy.
    pub fn finish(mut self) -> (DMatrix<f64>, DVector<f64>) {
        self.reduce();
        let p = self.r.ncols() - 1;
        let r = self.r.view((0, 0), (p, p)).into();
        let y = self.r.view((0, p), (p, 1)).column(0).into();
        (r, y)
    }
}
