//! Positions of a scene: their rates, their change in a step, and the way back to valid ones, with unit
//! quaternions and closed loops.

use bgdyn_runtime::closure::close_from;
use bgdyn_sim::{Plant, quasi_joints};
use nalgebra::DVector;

use super::plant::{Evaluated, Evaluation, Numbers};

impl Evaluated<'_> {
    /// Returns the rates of the positions at y; the other components are not rates.
    pub(super) fn rates_of_positions(&self, t: f64, y: &Numbers, modes: &Numbers) -> Numbers {
        let mut rates = y.clone();
        match self.own_position_rates(t, y, modes) {
            Some(own) => rates.as_mut_slice()[..own.len()].copy_from_slice(&own),
            None => {
                let (joints, nq) = (&self.functions.quasi_joints, self.positions());
                quasi_joints::position_rates(joints, nq, y.as_slice(), rates.as_mut_slice());
            }
        }
        rates
    }

    /// Returns the change of the positions in the time `h` at the velocities of y.
    pub(super) fn change_of_positions(
        &self,
        t: f64,
        y: &Numbers,
        modes: &Numbers,
        h: f64,
    ) -> Numbers {
        let mut change = y.clone();
        match self.own_position_rates(t, y, modes) {
            Some(own) => {
                let of_change = change.iter_mut().zip(own);
                of_change.for_each(|(x, rate)| *x = h * rate);
            }
            None => {
                let (joints, nq) = (&self.functions.quasi_joints, self.positions());
                quasi_joints::position_change(joints, nq, y.as_slice(), h, change.as_mut_slice());
            }
        }
        change
    }

    /// Scales quaternions to length 1 and closes loops. Returns whether there are such.
    pub(super) fn put_right(&self, y: &mut Numbers) -> Evaluation<bool> {
        let normalized = quasi_joints::normalize(&self.functions.quasi_joints, y.as_mut_slice());
        Ok(self.close(y)? || normalized)
    }

    /// Does the same for a state in two words. The dependent positions of loops are closed in the first word.
    pub(super) fn put_right_in_two(&self, y: &mut Numbers, low: &mut Numbers) -> Evaluation<bool> {
        let joints = &self.functions.quasi_joints;
        let normalized =
            quasi_joints::normalize_in_two(joints, y.as_mut_slice(), low.as_mut_slice());
        let before = y.clone();
        let closed = self.close(y)?;
        for ((low, y), before) in low.iter_mut().zip(y.iter()).zip(&before) {
            if y != before {
                *low = 0.0;
            }
        }
        Ok(closed || normalized)
    }

    /// Returns the rates of all positions of a scene with constraints; `None` for other scenes.
    fn own_position_rates(&self, t: f64, y: &Numbers, modes: &Numbers) -> Option<Vec<f64>> {
        let rates = self.functions.position_rates.as_ref()?;
        Some(rates.value(&self.arguments(t, y, modes)).0)
    }

    /// Closes the loops in a state. Returns whether there are loops.
    fn close(&self, y: &mut Numbers) -> Evaluation<bool> {
        let Some(closing) = &self.functions.closing else {
            return Ok(false);
        };
        let layout = &self.system.scene.layout;
        let modes = DVector::zeros(layout.modes.len());
        let step = |y: &Numbers| -> Numbers {
            let (step, _) = closing.step.value(&self.arguments(0.0, y, &modes));
            step.into()
        };
        let first = layout.nv() + layout.nx();
        let closed = close_from(y.clone(), &closing.dependents, first, step);
        let refused = closed.refused;
        *y = closed.or_nan(&closing.dependents, &[]);
        refused.map_or(Ok(true), |i| Err(self.refused(i)))
    }
}
