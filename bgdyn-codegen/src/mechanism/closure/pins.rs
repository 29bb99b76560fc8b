//! Closed positions at which single positions of joints with several velocities are given.
//!
//! Such a position is no function of one velocity: along the way it is a condition beside the rows of the loops, with the
//! rates N(q), and all joints that are not given follow.

use bgdyn_runtime::Dd;

use super::way::Way;
use super::{Closure, LoopRow};
use crate::mechanism::Motion;
use crate::mechanism::joint::DoubleDouble;

/// A residual below this is that of a closed position.
const CLOSED: f64 = 1e-25;

/// The largest part of the way.
const LARGEST_PART: f64 = 1.0 / 32.0;

impl Closure {
    /// Moves closed positions to where those with these indices have their values, as far as the loops allow it along the
    /// `free` velocities. Returns whether the way leads there.
    pub(super) fn draw_to(
        &self,
        q: &mut [Dd],
        pins: &[(usize, Dd)],
        (rows, free): (&[LoopRow], &[usize]),
    ) -> bool {
        let from: Vec<Dd> = pins.iter().map(|&(p, _)| q[p]).collect();
        let closed = |q: &[Dd], share: f64| {
            let share = Dd::from_f64(share);
            let ends = pins.iter().zip(&from);
            let targets: Vec<(usize, Dd)> = ends
                .map(|(&(p, to), &from)| (p, from + (to - from) * share))
                .collect();
            let mut moved = q.to_vec();
            self.minimize(&mut moved, free, CLOSED, |q| {
                self.with_pins(rows, q, &targets)
            });
            (self.assemble(rows, &mut moved, free) <= CLOSED).then_some(moved)
        };
        let mut at = q.to_vec();
        let mut way = Way::new((self, rows, free), LARGEST_PART);
        let leads = way.go(&mut at, (0.0, 1.0), closed).is_ok();
        q.copy_from_slice(&at);
        leads
    }

    /// Returns values and rates of the rows, and of the differences between positions and their given values.
    fn with_pins(
        &self,
        rows: &[LoopRow],
        q: &[Dd],
        pins: &[(usize, Dd)],
    ) -> (Vec<Dd>, Vec<Vec<Dd>>) {
        let (mut residuals, mut rates) = self.values(rows, q);
        for &(p, target) in pins {
            residuals.push(q[p] - target);
            rates.push(self.rates_of_position(p, q));
        }
        (residuals, rates)
    }

    /// Returns the row of N(q) of a position of a joint with several velocities.
    fn rates_of_position(&self, p: usize, q: &[Dd]) -> Vec<Dd> {
        let mut row = vec![Dd::ZERO; self.positions.len()];
        let has = |joint: &&super::ChainStep| joint.degrees.positions.iter().any(|x| x.0 == p);
        let Some(joint) = self.compounds.iter().find(has) else {
            return row;
        };
        let Motion::Compound(motion) = joint.motion else {
            return row;
        };
        let positions = &joint.degrees.positions;
        let at: Vec<Dd> = positions.iter().map(|x| q[x.0]).collect();
        let own = positions.iter().position(|x| x.0 == p);
        let velocities = &joint.degrees.velocities;
        let constants = joint.degrees.constants(joint.axis);
        for (k, j) in velocities.iter().enumerate() {
            let unit = |i| if i == k { Dd::ONE } else { Dd::ZERO };
            let unit: Vec<Dd> = (0..velocities.len()).map(unit).collect();
            let rates = motion.position_rates(&constants, (&at, &unit), &DoubleDouble);
            row[j.0] = own.map_or(Dd::ZERO, |own| rates[own]);
        }
        row
    }
}
