//! Motions that show nothing, and efforts with the wrong sign.

use nalgebra::{DVector, Matrix5, Vector5};

use crate::fault::LogFault;
use crate::log::Quality;
use crate::model::{Model, Unknown};
use crate::prepare::Samples;

/// Below this speed, rad/s or m/s, a joint is at rest.
const STILL: f64 = 2e-3;
/// A factor of the file's efforts below this one is a wrong sign.
const WRONG: f64 = -0.3;

/// Returns the faults of a prepared motion.
pub fn suspect(
    model: &Model<'_>,
    samples: &Samples,
    quality: &Quality,
    unknowns: usize,
) -> Vec<LogFault> {
    let n = samples.joints;
    let mut faults = Vec::new();
    let fastest = samples.v.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    if fastest < STILL {
        let message = format!(
            "no joint moves: the fastest has {} rad/s or m/s",
            crate::fault::short(fastest)
        );
        let help =
            "a log at rest shows weights only: record a motion that moves all joints at once";
        faults.push(LogFault::whole("nothing-excited", message).with_help(help));
    }
    if samples.tau.len() < 2 * unknowns {
        let message = format!(
            "{} rows of the log leave {} independent equations for {unknowns} unknowns",
            quality.rows,
            samples.tau.len()
        );
        let help = "record a longer motion, or raise --cut";
        faults.push(LogFault::whole("too-short", message).with_help(help));
    }
    if !faults.is_empty() {
        return faults;
    }
    let all = model.unknowns();
    let file = DVector::from_iterator(
        all.len(),
        all.iter().map(|u| match u {
            Unknown::Link(..) => model.file(*u),
            Unknown::Joint(..) => 0.0,
        }),
    );
    let predicted = &samples.rows * file;
    let factors: Vec<Option<f64>> = (0..n).map(|j| factor(samples, &predicted, j)).collect();
    let wrong: Vec<usize> = (0..n)
        .filter(|j| factors[*j].is_some_and(|f| f < WRONG))
        .collect();
    if !wrong.is_empty() {
        let names: Vec<String> = wrong
            .iter()
            .map(|&j| {
                format!(
                    "`{}` ({})",
                    model.joints[j].name,
                    crate::fault::short(factors[j].unwrap_or(0.0))
                )
            })
            .collect();
        let all = if wrong.len() == n {
            ""
        } else {
            " at some joints"
        };
        let message = format!(
            "the efforts are those of the negative model{all}; factor of the file's efforts: {}",
            names.join(", ")
        );
        let help = "change the sign of these columns, or of position and effort together where an axis points the other way";
        faults.push(LogFault::whole("wrong-sign", message).with_help(help));
    }
    faults
}

/// Returns α of τ = α τ_file + b v + c sign v + d + e a by least squares, if α is found to a fifth or so.
fn factor(samples: &Samples, predicted: &DVector<f64>, j: usize) -> Option<f64> {
    let n = samples.joints;
    let columns = samples.rows.ncols();
    let joint = |c: usize| columns - 4 * n + c * n + j;
    let (mut normal, mut right, mut square) = (Matrix5::zeros(), Vector5::zeros(), 0.0);
    let rows: Vec<usize> = (j..samples.tau.len()).step_by(n).collect();
    let row = |i: usize| {
        Vector5::new(
            predicted[i],
            samples.rows[(i, joint(0))],
            samples.rows[(i, joint(1))],
            samples.rows[(i, joint(2))],
            samples.rows[(i, joint(3))],
        )
    };
    let scales = rows.iter().fold(Vector5::zeros(), |s: Vector5<f64>, &i| {
        s + row(i).component_mul(&row(i))
    });
    let scales = scales.map(|s| if s > 0.0 { 1.0 / s.sqrt() } else { 0.0 });
    for &i in &rows {
        let x = row(i).component_mul(&scales);
        normal += x * x.transpose();
        right += x * samples.tau[i];
        square += samples.tau[i].powi(2);
    }
    let inverse = (normal + Matrix5::identity() * 1e-9).try_inverse()?;
    let solved = inverse * right;
    let left = (square - solved.dot(&right)).max(0.0) / rows.len() as f64;
    let deviation = (inverse[(0, 0)] * left).sqrt();
    (deviation < 0.2 * solved[0].abs()).then(|| solved[0] * scales[0])
}
