//! Judges a model on a motion: what is left of the efforts, and what the rest depends on.

use crate::prepare::Samples;

/// Bins of a residual over velocity or position, at most.
const BINS: usize = 20;
/// Rows of a bin, at least.
const BIN_ROWS: usize = 8;

/// What is left of a joint's efforts.
#[derive(Clone, Debug, PartialEq)]
pub struct JointResidual {
    /// Root mean square of the efforts, N·m or N.
    pub effort: f64,
    /// Root mean square of what is left.
    pub rms: f64,
    /// The share of its variance that the velocity explains: wrong friction.
    pub by_velocity: f64,
    /// The share of its variance that the position explains: cogging, springs.
    pub by_position: f64,
    /// The correlation of neighbouring rows.
    pub correlation: f64,
}

/// Judges predicted efforts, in the order of the samples.
pub fn judge(samples: &Samples, predicted: &[f64]) -> Vec<JointResidual> {
    (0..samples.joints)
        .map(|j| judge_joint(samples, predicted, j))
        .collect()
}

fn judge_joint(samples: &Samples, predicted: &[f64], j: usize) -> JointResidual {
    let own = |x: &[f64]| {
        x.iter()
            .skip(j)
            .step_by(samples.joints)
            .copied()
            .collect::<Vec<f64>>()
    };
    let (tau, predicted) = (own(&samples.tau), own(predicted));
    let rest: Vec<f64> = tau.iter().zip(&predicted).map(|(t, p)| t - p).collect();
    let square: f64 = rest.iter().map(|r| r * r).sum();
    let beside: f64 = rest.windows(2).map(|r| r[0] * r[1]).sum();
    JointResidual {
        effort: rms(&tau),
        rms: rms(&rest),
        by_velocity: explained(&own(&samples.v), &rest),
        by_position: explained(&own(&samples.q), &rest),
        correlation: if square > 0.0 { beside / square } else { 0.0 },
    }
}

/// Returns the root mean square.
pub fn rms(x: &[f64]) -> f64 {
    (x.iter().map(|x| x * x).sum::<f64>() / x.len().max(1) as f64).sqrt()
}

/// Returns the share of the variance of `y` that the mean in bins of equal counts over `x` explains, less what chance
/// explains.
fn explained(x: &[f64], y: &[f64]) -> f64 {
    let n = y.len();
    let bins = BINS.min(n / BIN_ROWS);
    if bins < 3 {
        return 0.0;
    }
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|a, b| x[*a].total_cmp(&x[*b]));
    let mean = y.iter().sum::<f64>() / n as f64;
    let total: f64 = y.iter().map(|y| (y - mean).powi(2)).sum();
    let between: f64 = order
        .chunks(n.div_ceil(bins))
        .map(|bin| {
            let own = bin.iter().map(|i| y[*i]).sum::<f64>() / bin.len() as f64;
            bin.len() as f64 * (own - mean).powi(2)
        })
        .sum();
    let chance = (bins - 1) as f64 / (n - 1) as f64;
    match total > 0.0 {
        true => ((between / total - chance) / (1.0 - chance)).max(0.0),
        false => 0.0,
    }
}
