//! Positions of joints with quasi-velocities in a scene's state.
//!
//! The file finds which are coupled, their rows of the Jacobian, and lengths of quaternions.

use bgdyn_runtime::{self as runtime, Dd};

use super::{QuasiJoint, StateLayout};

/// Largest deviation of the length of a given quaternion from 1.
const LENGTH: f64 = 1e-6;

impl StateLayout {
    /// Returns the positions that are not the integrals of single velocities: their rates are q̇ = N(q) v.
    pub fn coupled(&self) -> Vec<usize> {
        let own = |p: &usize| self.positions[*p].coordinate.is_none();
        (0..self.nq()).filter(own).collect()
    }

    /// Returns (∂ẏ/∂y, ∂ẏ/∂t) row by row, from the columns of the function for the Jacobian, which have the
    /// rates of velocities and states, then those of coupled positions.
    pub fn jacobian_rows(&self, values: &[f64]) -> Vec<Vec<f64>> {
        let own = self.nv() + self.nx();
        let columns = self.nq() + own + 1;
        let coupled = self.positions.iter().filter(|p| p.coordinate.is_none());
        let length = own + coupled.count();
        let row = |at: usize| (0..columns).map(|k| values[k * length + at]).collect();
        let mut next = own;
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(columns - 1);
        for position in &self.positions {
            rows.push(match position.coordinate {
                Some(j) => {
                    let unit = |k| f64::from(u8::from(k == self.nq() + j));
                    (0..columns).map(unit).collect()
                }
                None => {
                    next += 1;
                    row(next - 1)
                }
            });
        }
        rows.extend((0..own).map(row));
        rows
    }

    /// Divides every quaternion by its length. Returns the joints whose quaternions are not orientations: of a
    /// length other than 1 by more than 1e-6, or of length 0 where any length is allowed; with the length.
    pub fn unit_quaternions(&self, positions: &mut [Dd]) -> Vec<(&QuasiJoint, f64)> {
        let mut wrong = Vec::new();
        for joint in &self.quasi_joints {
            let Some(first) = joint.quaternion else {
                continue;
            };
            let length = length(&positions[first..first + 4]).to_f64();
            let sound = match joint.any_length {
                true => length > 0.0 && length.is_finite(),
                false => (length - 1.0).abs() <= LENGTH,
            };
            if !sound {
                wrong.push((joint, length));
            }
        }
        if wrong.is_empty() {
            self.normalize(positions);
        }
        wrong
    }

    /// Divides every quaternion by its length.
    pub fn normalize(&self, positions: &mut [Dd]) {
        for first in self.quasi_joints.iter().filter_map(|j| j.quaternion) {
            let quaternion = &mut positions[first..first + 4];
            let length = length(quaternion);
            quaternion.iter_mut().for_each(|x| *x /= length);
        }
    }
}

fn length(quaternion: &[Dd]) -> Dd {
    let squares = quaternion.iter().map(|&x| x * x);
    squares.fold(Dd::ZERO, |sum, x| sum + x).sqrt()
}

impl QuasiJoint {
    /// Returns whether all its velocities are part of the state: none follows from others.
    pub fn is_independent(&self, layout: &StateLayout) -> bool {
        self.coordinates.len() == self.in_state(layout).velocities()
    }

    /// Returns it by its components in the state: positions first, then velocities.
    pub fn in_state(&self, layout: &StateLayout) -> runtime::QuasiJoint {
        runtime::QuasiJoint {
            kind: self.kind,
            position: self.positions.start,
            velocity: layout.nq() + self.coordinates.start,
        }
    }
}
