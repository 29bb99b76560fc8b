//! What an ascent raises: log det, with logarithms of the distances from the limits, so that it stays within them
//! (barriers).

use nalgebra::{DMatrix, DVector};

use super::ascent::Slope;
use super::grid::Grid;
use super::information::{Cotangent, Information, Sample};
use super::limits::{JointLimits, Keep, Points};
use super::series::{FourierSeries, PeriodicMotion, State};
use super::shape::Shape;

/// Rows of a period at least, and for each harmonic.
const ROWS: [usize; 2] = [60, 12];
/// Samples for each harmonic at which distances from the limits of joints count.
const CHECKED: usize = 32;
/// Distance from a plane, m, from which on it hardly pushes.
const NEAR: f64 = 0.1;
/// Step of central differences by positions.
const STEP: f64 = 1e-5;

/// Limits and planes.
pub struct Bounds<'a> {
    /// Names of the joints.
    pub names: Vec<String>,
    /// By joint.
    pub joints: &'a [JointLimits],
    /// Planes.
    pub keeps: &'a [Keep],
    /// Where the points are.
    pub points: &'a dyn Points,
}

/// The function that is raised.
pub struct Objective<'a> {
    /// What is raised.
    pub information: &'a Information<'a>,
    /// Free numbers.
    pub shape: &'a Shape,
    /// Where it may go.
    pub bounds: &'a Bounds<'a>,
    rows: Grid,
    checked: Grid,
    /// Weight μ of the barriers.
    pub barrier: f64,
}

impl<'a> Objective<'a> {
    /// Returns the objective of series with `harmonics` of `frequency`, rad/s, without barriers.
    pub fn new(
        information: &'a Information<'a>,
        shape: &'a Shape,
        bounds: &'a Bounds<'a>,
        harmonics: usize,
        frequency: f64,
    ) -> Self {
        let count = ROWS[0].max(ROWS[1] * harmonics);
        Objective {
            information,
            shape,
            bounds,
            rows: Grid::new(count, harmonics, frequency),
            checked: Grid::new(CHECKED * harmonics, harmonics, frequency),
            barrier: 0.0,
        }
    }

    /// Returns the count of rows of a period.
    pub fn count(&self) -> usize {
        self.rows.count()
    }

    /// Returns the states of the rows, with the rows of bodies.
    pub fn samples(&self, motion: &PeriodicMotion) -> Vec<Sample> {
        let states = (0..self.rows.count()).map(|i| self.rows.state(motion, i));
        self.information.samples(states.collect())
    }

    /// Returns the room for efforts without Coulomb friction, N·m or N, by joint, where there is a limit: that friction
    /// is counted in full at any speed, |τ| + F ≤ limit.
    pub(super) fn room(&self) -> Vec<Option<f64>> {
        let joints = self.bounds.joints.iter().zip(self.information.coulomb());
        joints
            .map(|(limits, coulomb)| limits.effort.map(|most| most - coulomb))
            .collect()
    }

    /// Returns whether efforts have limits.
    pub(super) fn has_efforts(&self) -> bool {
        self.bounds.joints.iter().any(|l| l.effort.is_some())
    }

    /// Returns the mean of the logarithms of what is left of each limit; `None` outside.
    fn left(&self, motion: &PeriodicMotion, samples: &[Sample]) -> Option<f64> {
        let mut sum = 0.0;
        for (series, limits) in motion.joints.iter().zip(self.bounds.joints) {
            for i in 0..self.checked.count() {
                let shares = parts(limits, self.checked.at(series, i));
                let own = shares.into_iter().map(left);
                sum += own.sum::<Option<f64>>()? / self.checked.count() as f64;
            }
        }
        let room = self.room();
        for sample in samples {
            let mut own = 0.0;
            if self.has_efforts() {
                let efforts = self.information.smooth_efforts(sample);
                for (effort, room) in efforts.iter().zip(&room) {
                    own += room.map_or(Some(0.0), |room| {
                        (room > 0.0).then(|| left(effort / room)).flatten()
                    })?;
                }
            }
            for keep in self.bounds.keeps {
                let distance = keep.distance(self.bounds.points, &sample.state.q);
                let left = (distance > 0.0).then(|| (distance / (NEAR + distance)).ln());
                own += left?;
            }
            sum += own / samples.len() as f64;
        }
        Some(sum)
    }

    /// Adds the slopes of the barriers of joints.
    fn push(&self, motion: &PeriodicMotion, slopes: &mut [FourierSeries]) {
        let joints = motion.joints.iter().zip(self.bounds.joints).zip(slopes);
        for ((series, limits), slope) in joints {
            let scales = [limits.half(), limits.speed, limits.acceleration];
            for i in 0..self.checked.count() {
                let shares = parts(limits, self.checked.at(series, i));
                let factor = self.barrier / self.checked.count() as f64;
                let by: [f64; 3] =
                    std::array::from_fn(|d| factor * steepness(shares[d]) / scales[d]);
                self.checked.pull(i, by, slope);
            }
        }
    }

    /// Returns the slopes of the barriers by efforts at a state.
    fn push_of_efforts(&self, sample: &Sample) -> DVector<f64> {
        let n = self.bounds.joints.len();
        if !self.has_efforts() {
            return DVector::zeros(n);
        }
        let efforts = self.information.smooth_efforts(sample);
        let factor = self.barrier / self.rows.count() as f64;
        let room = self.room();
        DVector::from_fn(n, |j, _| {
            room[j].map_or(0.0, |room| factor * steepness(efforts[j] / room) / room)
        })
    }

    /// Adds the slopes of the barriers of planes by positions at a state.
    fn push_of_planes(&self, state: &State, by_state: &mut [[f64; 3]]) {
        let factor = self.barrier / self.rows.count() as f64;
        for keep in self.bounds.keeps {
            let distance = keep.distance(self.bounds.points, &state.q);
            let steep = factor * (1.0 / distance - 1.0 / (NEAR + distance));
            for (j, slope) in by_state.iter_mut().enumerate() {
                let at = |step: f64| {
                    let mut q = state.q.clone();
                    q[j] += step;
                    keep.distance(self.bounds.points, &q)
                };
                slope[0] += steep * (at(STEP) - at(-STEP)) / (2.0 * STEP);
            }
        }
    }
}

impl Slope for Objective<'_> {
    fn value(&self, x: &DVector<f64>) -> Option<f64> {
        let motion = self.shape.motion(x);
        let samples = self.samples(&motion);
        let left = self.left(&motion, &samples)?;
        Some(self.information.value(&samples)? + self.barrier * left)
    }

    fn slope(&self, x: &DVector<f64>) -> Option<DVector<f64>> {
        let motion = self.shape.motion(x);
        let samples = self.samples(&motion);
        let zero = |series: &FourierSeries| FourierSeries {
            centre: 0.0,
            ..series.scaled(0.0)
        };
        let mut slopes: Vec<FourierSeries> = motion.joints.iter().map(zero).collect();
        let rows: Vec<DMatrix<f64>> = self.information.cotangents(&samples)?;
        for (i, (sample, rows)) in samples.iter().zip(rows).enumerate() {
            let efforts = self.push_of_efforts(sample);
            let by = Cotangent { rows, efforts };
            let mut found = self.information.slopes(sample, &by);
            self.push_of_planes(&sample.state, &mut found);
            for (slope, by) in slopes.iter_mut().zip(found) {
                self.rows.pull(i, by, slope);
            }
        }
        self.push(&motion, &mut slopes);
        Some(self.shape.slopes(&slopes))
    }
}

/// Returns position, velocity and acceleration as signed shares of their limits.
fn parts(limits: &JointLimits, [q, v, a]: [f64; 3]) -> [f64; 3] {
    [
        (q - limits.middle()) / limits.half(),
        v / limits.speed,
        a / limits.acceleration,
    ]
}

/// Returns log (1 − x²), what is left of a limit; `None` beyond it.
fn left(share: f64) -> Option<f64> {
    let left = 1.0 - share * share;
    (left > 0.0).then(|| left.ln())
}

/// Returns the derivative of [`left`].
fn steepness(share: f64) -> f64 {
    -2.0 * share / (1.0 - share * share)
}
