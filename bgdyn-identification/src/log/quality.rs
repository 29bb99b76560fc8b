//! What a log is worth: rate, jitter, lost rows, ranges, rest, steps of the encoders.

use super::Log;
use crate::model::JointPart;

/// Steps longer than so many median ones have lost rows.
const LOST: f64 = 1.5;

/// The quality of a log.
#[derive(Clone, Debug, PartialEq)]
pub struct Quality {
    /// Number of rows.
    pub rows: usize,
    /// Rows per second.
    pub rate: f64,
    /// Robust deviation of the steps, relative.
    pub jitter: f64,
    /// Lost rows.
    pub lost: usize,
    /// Joints.
    pub joints: Vec<Channel>,
}

/// A joint of a log.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// Its name.
    pub name: String,
    /// The range of its positions, rad or m.
    pub range: [f64; 2],
    /// Its limits in the file.
    pub limits: [Option<f64>; 2],
    /// The share of the time at which its position does not change.
    pub rest: f64,
    /// The smallest change of its position.
    pub step: f64,
}

/// Returns the quality of a log.
pub fn quality(log: &Log, joints: &[JointPart]) -> Quality {
    let step = log.median_step();
    let lost = log.steps().into_iter().filter(|s| *s > LOST * step);
    let lost = lost.map(|s| (s / step).round() as usize - 1).sum();
    let channels = joints.iter().zip(&log.q);
    Quality {
        rows: log.time.len(),
        rate: 1.0 / step,
        jitter: log.jitter(),
        lost,
        joints: channels.map(|(joint, q)| channel(joint, q)).collect(),
    }
}

fn channel(joint: &JointPart, q: &[f64]) -> Channel {
    let changes = q.windows(2).map(|q| (q[1] - q[0]).abs());
    // Decimals of a table are no steps: changes below 1e-9 are rounding.
    let moved: Vec<f64> = changes.filter(|d| *d > 1e-9).collect();
    let rest = 1.0 - moved.len() as f64 / q.len().saturating_sub(1).max(1) as f64;
    Channel {
        name: joint.name.clone(),
        range: [
            q.iter().copied().fold(f64::INFINITY, f64::min),
            q.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        ],
        limits: joint.range,
        rest,
        step: moved.into_iter().fold(f64::INFINITY, f64::min),
    }
}
