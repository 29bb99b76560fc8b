//! What a motion may do: limits of joints, and frames that stay on one side of planes.

use super::series::{FourierSeries, PeriodicMotion, State};

/// Limits of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointLimits {
    /// Least and largest position, rad or m.
    pub position: [f64; 2],
    /// Largest speed, rad/s or m/s.
    pub speed: f64,
    /// Largest acceleration, rad/s² or m/s².
    pub acceleration: f64,
    /// Largest effort, N·m or N, where there is a limit.
    pub effort: Option<f64>,
}

impl JointLimits {
    /// Returns the middle of the range.
    pub fn middle(&self) -> f64 {
        0.5 * (self.position[0] + self.position[1])
    }

    /// Returns half of the range.
    pub fn half(&self) -> f64 {
        0.5 * (self.position[1] - self.position[0])
    }

    /// Returns the shares of the limits of position, speed and acceleration that a series uses at most, between samples
    /// too: above 1 it exceeds one.
    pub fn shares(&self, series: &FourierSeries, frequency: f64) -> [f64; 3] {
        let [q, v, a] = series.extremes(frequency);
        let size = |[low, high]: [f64; 2]| high.max(-low);
        [
            size([q[0] - self.middle(), q[1] - self.middle()]) / self.half(),
            size(v) / self.speed,
            size(a) / self.acceleration,
        ]
    }

    /// Returns the factor of the motion about the centre with which it touches the first limit.
    pub fn room(&self, series: &FourierSeries, frequency: f64) -> f64 {
        let [q, v, a] = series.extremes(frequency);
        let up = (self.position[1] - series.centre) / (q[1] - series.centre);
        let down = (series.centre - self.position[0]) / (series.centre - q[0]);
        let fast = self.speed / v[1].max(-v[0]);
        let steep = self.acceleration / a[1].max(-a[0]);
        up.min(down).min(fast).min(steep)
    }
}

/// Gives the points of the world, m, that are kept on one side of planes.
pub trait Points {
    /// Returns the position of a point, by its index, at positions `q`.
    fn point(&self, index: usize, q: &[f64]) -> [f64; 3];
}

/// A point that stays on one side of a plane: `side` · (coordinate − `level`) > 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Keep {
    /// As it was written.
    pub name: String,
    /// Index of the point.
    pub point: usize,
    /// 0, 1, 2: x, y, z of the world.
    pub axis: usize,
    /// 1 above, −1 below.
    pub side: f64,
    /// m
    pub level: f64,
}

impl Keep {
    /// Returns the distance from the plane, m, positive on the right side.
    pub fn distance(&self, points: &dyn Points, q: &[f64]) -> f64 {
        self.side * (points.point(self.point, q)[self.axis] - self.level)
    }
}

/// The smallest values of smooth functions along a motion: of `samples` for each harmonic, less an eighth of the second
/// difference beside, the most by which the parabola through three samples goes on within half a step. An estimate: no
/// strict bound.
pub fn least(
    motion: &PeriodicMotion,
    samples: usize,
    of: &mut dyn FnMut(State) -> Vec<f64>,
) -> Vec<f64> {
    let harmonics = motion.joints.first().map_or(1, |s| s.sine.len());
    let count = samples * harmonics;
    let step = motion.period() / count as f64;
    let all: Vec<Vec<f64>> = (0..count).map(|i| of(motion.at(i as f64 * step))).collect();
    let at = |k: usize, i: usize| {
        let (before, x, after) = (
            all[(i + count - 1) % count][k],
            all[i][k],
            all[(i + 1) % count][k],
        );
        x - (before - 2.0 * x + after).abs() / 8.0
    };
    let smallest = |k: usize| (0..count).map(|i| at(k, i)).fold(f64::INFINITY, f64::min);
    (0..all[0].len()).map(smallest).collect()
}
