//! Positions of joints with quasi-velocities in a scene's state: which are coupled, rows of the Jacobian,
//! lengths of quaternions.

use bgdyn_runtime::Dd;

use super::{QuasiJoint, StateLayout};

/// Largest deviation of the length of a given quaternion from 1.
const LENGTH: f64 = 1e-6;

impl StateLayout {
    /// Returns the positions that are not the integrals of single velocities: their rates are q̇ = N(q) v.
    pub fn coupled(&self) -> Vec<usize> {
        let own = |p: &usize| self.positions[*p].coordinate.is_none();
        (0..self.nq()).filter(own).collect()
    }

    /// Returns the entry of row `i` and column `k` of (∂ẏ/∂y, ∂ẏ/∂t) from the columns of the function for the
    /// Jacobian, which have the rates of velocities and states, then those of coupled positions.
    pub fn jacobian_entry(&self, values: &[f64], i: usize, k: usize) -> f64 {
        let own = self.nv() + self.nx();
        let column = k * (own + self.coupled().len());
        match (i.checked_sub(self.nq()), self.positions.get(i)) {
            (Some(i), _) => values[column + i],
            (None, Some(position)) => match position.coordinate {
                Some(j) => f64::from(u8::from(k == self.nq() + j)),
                None => {
                    let before = self.positions[..i].iter();
                    let before = before.filter(|p| p.coordinate.is_none()).count();
                    values[column + own + before]
                }
            },
            (None, None) => 0.0,
        }
    }

    /// Divides every quaternion by its length. Returns the joints whose quaternions are not orientations: of a
    /// length other than 1 by more than 1e-6, or of length 0 where any length is allowed; with the length.
    pub fn unit_quaternions(&self, positions: &mut [Dd]) -> Vec<(&QuasiJoint, f64)> {
        let mut wrong = Vec::new();
        for joint in &self.quasi_joints {
            let Some(first) = joint.quaternion else {
                continue;
            };
            let squares = positions[first..first + 4].iter().map(|&x| x * x);
            let length = squares.fold(Dd::ZERO, |sum, x| sum + x).sqrt().to_f64();
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
            let squares = quaternion.iter().map(|&x| x * x);
            let length = squares.fold(Dd::ZERO, |sum, x| sum + x).sqrt();
            quaternion.iter_mut().for_each(|x| *x /= length);
        }
    }
}
