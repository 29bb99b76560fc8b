//! Corners of the inputs: instants known beforehand at which a table bends, so that a rate of it jumps.
//!
//! A step that passed one would average both sides. So it ends a few roundings of the time before the corner,
//! where every stage still sees the side that goes; then the clock is put on the corner, and the next step sees
//! the side that comes. In these roundings the state changes by less than its own.

use bgdyn_runtime::Scalar;

use super::state::{Agreement, Run};
use crate::integrator::Integrator;
use crate::plant::{Plant, Time};
use crate::real::Real;

/// How far before a corner a step ends, in roundings of the time.
const BEFORE: f64 = 4.0;

impl<P: Plant, M: Integrator<P::State>> Run<P, M>
where
    Time<P>: Real,
{
    /// `most`, or less so that a step from here ends just before the next corner.
    pub(super) fn up_to_corner(&self, most: Time<P>) -> Time<P> {
        let Some(corner) = self.plant.next_corner(self.t()) else {
            return most;
        };
        most.min((corner - self.t()) - self.roundings(corner, BEFORE))
    }

    /// Puts the clock on a corner that lies within rounding ahead, where stiction is then resolved anew.
    /// Several corners may lie there. Gives by how much time went on.
    pub(super) fn reach_corner(&mut self) -> Time<P> {
        let mut skipped = Time::<P>::from_f64(0.0);
        while let Some(corner) = self.plant.next_corner(self.t()) {
            let ahead = corner - self.t();
            if ahead > self.roundings(corner, 2.0 * BEFORE) {
                break;
            }
            self.solver.set_clock(corner);
            self.solver.forget();
            if self.agreement == Agreement::Reached {
                self.agreement = Agreement::Disturbed;
            }
            self.reached();
            skipped = skipped + ahead;
        }
        skipped
    }

    /// Lets the plant do what happens now from outside.
    pub(super) fn reached(&mut self) {
        let (t, y) = (self.solver.t(), self.solver.y());
        self.plant.reached(t, y, &self.modes);
    }

    /// So many roundings of the time around a corner.
    fn roundings(&self, corner: Time<P>, count: f64) -> Time<P> {
        let largest = self.t().abs().max(corner.abs());
        Time::<P>::EPSILON * Time::<P>::from_f64(count) * largest
    }
}
