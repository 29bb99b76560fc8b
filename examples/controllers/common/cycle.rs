//! The path: poses joined by quintic legs.
//!
//! A leg from a to b in the time T is a + (b − a)·s(t/T) with s(x) = 10x³ − 15x⁴ + 6x⁵: the only quintic
//! that starts and ends at rest, without acceleration. So the whole path has continuous accelerations, and
//! the required torques have no steps.

use super::Joints;

/// The action of the gripper at the end of a leg.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gripper {
    /// No action.
    Keeps,
    /// Grips the part.
    Takes,
    /// Releases the part.
    Releases,
}

/// One leg of the path.
pub struct Leg<const N: usize> {
    /// Its purpose.
    pub name: &'static str,
    /// Its end.
    pub to: Joints<N>,
    /// Its duration, s.
    pub seconds: f64,
    /// The action at its end.
    pub gripper: Gripper,
}

impl<const N: usize> Leg<N> {
    /// Returns a leg to `to` without a gripper action.
    pub fn new(name: &'static str, to: Joints<N>, seconds: f64) -> Self {
        Leg {
            name,
            to,
            seconds,
            gripper: Gripper::Keeps,
        }
    }

    /// Adds a gripper action at the end of the leg.
    pub fn then(self, gripper: Gripper) -> Self {
        Leg { gripper, ..self }
    }
}

/// The desired motion at one time.
#[derive(Clone, Copy, Debug)]
pub struct Wanted<const N: usize> {
    /// Positions.
    pub q: Joints<N>,
    /// Velocities.
    pub v: Joints<N>,
    /// Accelerations.
    pub a: Joints<N>,
}

/// Legs one after the other.
pub struct Cycle<const N: usize> {
    /// The start of the first leg.
    pub start: Joints<N>,
    /// The legs.
    pub legs: Vec<Leg<N>>,
}

impl<const N: usize> Cycle<N> {
    /// Returns the duration of all legs, s.
    pub fn seconds(&self) -> f64 {
        self.legs.iter().map(|leg| leg.seconds).sum()
    }

    /// Returns the time of this gripper action, s.
    pub fn time_of(&self, gripper: Gripper) -> Option<f64> {
        let index = self.legs.iter().position(|leg| leg.gripper == gripper)?;
        Some(self.legs[..=index].iter().map(|leg| leg.seconds).sum())
    }

    /// Returns the time interval in which the part is carried, s.
    pub fn carried(&self) -> (f64, f64) {
        let end = self.seconds();
        let taken = self.time_of(Gripper::Takes).unwrap_or(end);
        (taken, self.time_of(Gripper::Releases).unwrap_or(end))
    }

    /// Returns the desired motion at time `t`; at rest in the last pose after the end.
    pub fn at(&self, t: f64) -> Wanted<N> {
        let (mut from, mut begin) = (self.start, 0.0);
        for leg in &self.legs {
            if t < begin + leg.seconds {
                let x = (t - begin) / leg.seconds;
                let way = leg.to - from;
                let s = x * x * x * (10.0 + x * (6.0 * x - 15.0));
                let rate = 30.0 * x * x * (x - 1.0) * (x - 1.0) / leg.seconds;
                let curvature =
                    60.0 * x * (x - 1.0) * (2.0 * x - 1.0) / (leg.seconds * leg.seconds);
                return Wanted {
                    q: from + way * s,
                    v: way * rate,
                    a: way * curvature,
                };
            }
            begin += leg.seconds;
            from = leg.to;
        }
        Wanted {
            q: from,
            v: Joints::zeros(),
            a: Joints::zeros(),
        }
    }
}
