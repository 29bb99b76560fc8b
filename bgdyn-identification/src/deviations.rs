//! Deviations of the parameters: (AᵀA)⁻¹, and the sandwich form with sums over blocks of half a second in place of
//! single rows, for residuals that are correlated (White 1980; Newey and West 1987); the larger counts.

use nalgebra::{DMatrix, DVector};

use crate::fit::{Fit, residuals};
use crate::prepare::Samples;

/// Length of a block, s.
const BLOCK: f64 = 0.5;
/// A parameter is not seen if its deviation exceeds this share of it and of the largest of its kind.
pub const UNSEEN: f64 = 0.3;

/// Returns the meat of the sandwich, Σ_blocks (Σ e)(Σ e)ᵀ with e = Σ_j w² r a over the joints of a time, for columns that
/// are divided by the scales of the fit.
pub fn meat(samples: &Samples, columns: &DMatrix<f64>, tau: &[f64], fit: &Fit) -> DMatrix<f64> {
    let (p, n) = (columns.ncols(), samples.joints);
    let residual = residuals(columns, tau, &fit.values);
    let length = ((BLOCK / samples.step) as usize).max(1);
    let mut meat = DMatrix::zeros(p, p);
    for block in (0..samples.time.len()).step_by(length) {
        let mut sum = DVector::zeros(p);
        let rows = n * block..n * (block + length).min(samples.time.len());
        for i in rows {
            sum += columns.row(i).transpose() * (fit.weights[i].powi(2) * residual[i]);
        }
        for (x, scale) in sum.iter_mut().zip(&fit.scales) {
            *x = if *scale > 0.0 { *x / scale } else { 0.0 };
        }
        meat.ger(1.0, &sum, &sum, 1.0);
    }
    meat
}

/// Returns the deviation of each base parameter; infinite for those that the motion does not show.
pub fn deviations(fit: &Fit, meat: &DMatrix<f64>) -> Vec<f64> {
    let own = fit.r.select_columns(&fit.visible);
    let cov = (own.tr_mul(&own)).try_inverse();
    let mut deviations = vec![f64::INFINITY; fit.values.len()];
    let Some(cov) = cov else { return deviations };
    let meat = meat.select_rows(&fit.visible).select_columns(&fit.visible);
    let robust = &cov * meat * &cov;
    for (k, &c) in fit.visible.iter().enumerate() {
        deviations[c] = cov[(k, k)].max(robust[(k, k)]).sqrt() / fit.scales[c];
    }
    deviations
}

/// Returns whether a parameter is seen: its deviation is below 30 % of it, or of the largest of its kind.
pub fn is_seen(value: f64, deviation: f64, largest: f64) -> bool {
    deviation <= UNSEEN * value.abs().max(largest)
}
