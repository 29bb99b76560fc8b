//! Runs of plants, from step to step and from event to event, with an energy account.
//!
//! An event is looked for at the end of a step; in long steps also at points of the dense output. It is
//! located by shorter steps of the method itself, so that the state there has the method's order,
//! whatever the order of the dense output. The step ends just behind the event. Events that change a mode
//! count when they fall, kinks in either direction. All joints at rest are decided together.
//!
//! A step ends just before a corner of an input; the next one begins at the corner.

mod corners;
mod events;
mod state;

use bgdyn_runtime::Scalar;

pub use self::state::{HybridState, Run};

use self::state::{Budget, Failed, Proposed, Refused};
use crate::audit::{Ledger, quadrature};
use crate::dense::Dense;
use crate::failure::Reason;
use crate::integrator::Integrator;
use crate::plant::{FixedModes, Plant, Time};
use crate::real::Real;

impl<P: Plant, M: Integrator<P::State>> Run<P, M>
where
    Time<P>: Real,
{
    /// On by `h`, s: one fixed step or as many controlled ones as it takes, from event to event where
    /// there are any.
    ///
    /// # Errors
    /// Where the plant cannot go on.
    pub fn step(&mut self, h: Time<P>) -> Result<(), Failed<P>> {
        // What rounding leaves of a step is no step.
        let rest = h * Time::<P>::EPSILON * Time::<P>::from_f64(4096.0);
        let mut budget = Budget::new(self.plant.most_events());
        let mut left = h;
        while rest < left {
            let piece = self.piece(left, &mut budget, false);
            left = left - piece.map_err(|reason| self.solver.failure(reason))?.0;
        }
        Ok(())
    }

    /// One step of the method, no longer than `most`, or up to the first event in it. Gives the
    /// states within; they are interpolated, and [`Plant::project`] makes possible states of them.
    ///
    /// # Errors
    /// Where the plant cannot go on.
    pub fn advance_densely(&mut self, most: Time<P>) -> Result<Dense<P::State>, Failed<P>> {
        let piece = self.piece(most, &mut Budget::new(self.plant.most_events()), true);
        let (h, dense) = piece.map_err(|reason| self.solver.failure(reason))?;
        let here = || Dense::new(self.t(), h, self.y(), [const { None }; 7]);
        Ok(dense.unwrap_or_else(here))
    }

    /// A step of the length `most` or a controlled one, up to the first corner of an input or event in it:
    /// by how much time went on and, if wanted or needed, the states within.
    #[expect(clippy::type_complexity, reason = "a length and what lies within")]
    fn piece(
        &mut self,
        most: Time<P>,
        budget: &mut Budget,
        densely: bool,
    ) -> Result<(Time<P>, Option<Dense<P::State>>), Refused<P>> {
        let skipped = self.reach_corner();
        self.agree()?;
        if self.audited && !self.ledger.is_open() {
            let energy = self.plant.energy(self.t(), self.y(), &self.modes);
            self.ledger.note(energy.map_err(Reason::Singular)?);
        }
        let ode = FixedModes {
            plant: &self.plant,
            modes: &self.modes,
        };
        let most = self.up_to_corner(most);
        let mut proposal = self.solver.propose(&ode, most)?;
        let found = self.first_event(&proposal, budget)?;
        let passed = found.map(|(shorter, passed)| {
            proposal = shorter;
            passed
        });
        let dense = if densely || self.audited {
            Some(self.solver.dense(&self.fixed_modes(), &proposal.step)?)
        } else {
            None
        };
        let after = match &passed {
            Some(passed) => self.after(&proposal, passed, budget)?,
            None => None,
        };
        let ledger = self.booked(&proposal, dense.as_ref(), after.as_ref())?;
        // Nothing can fail from here on.
        let h = proposal.step.h;
        self.contacts = self
            .solver
            .integrator()
            .contact_step(&proposal.step.stages)
            .copied();
        self.solver.take(proposal);
        self.ledger = ledger;
        if let Some((y, modes)) = after {
            self.modes = modes;
            self.solver.restart(y);
        } else if passed.is_some() {
            self.solver.forget();
        }
        if let Some(passed) = passed {
            self.count(&passed, budget);
        }
        Ok((skipped + h + self.reach_corner(), dense))
    }

    /// The state in a part of a step, as a possible one.
    pub(super) fn within(
        &self,
        dense: &Dense<P::State>,
        theta: Time<P>,
    ) -> Result<P::State, Refused<P>> {
        let mut y = dense.at(theta);
        let t = dense.start() + theta * dense.length();
        let possible = self.plant.project(t, &mut y, &self.modes);
        possible.map_err(Reason::Singular)?;
        Ok(y)
    }

    /// The account with the work of a step, and the energy after it.
    fn booked(
        &self,
        step: &Proposed<P, M>,
        dense: Option<&Dense<P::State>>,
        after: Option<&(P::State, P::Modes)>,
    ) -> Result<Ledger<P::Entries>, Refused<P>> {
        let mut ledger = self.ledger.clone();
        let Some(dense) = dense.filter(|_| self.audited) else {
            return Ok(ledger);
        };
        let h = dense.length();
        for (at, weight) in quadrature(self.solver.integrator().info().order) {
            let theta: Time<P> = at.to();
            let t = dense.start() + theta * h;
            let power = self
                .plant
                .power(t, &self.within(dense, theta)?, &self.modes);
            ledger.add(
                weight.to::<Time<P>>() * h,
                &power.map_err(Reason::Singular)?,
            );
        }
        if let Some((_, modes)) = after {
            for (entry, loss) in self.plant.jump_losses(modes) {
                ledger.lose(entry, loss);
            }
        }
        if let Some(contacts) = self.solver.integrator().contact_step(&step.step.stages) {
            for (c, &loss) in contacts
                .losses
                .iter()
                .enumerate()
                .take(self.plant.rigid_contacts())
            {
                ledger.lose(self.plant.rigid_contact_entry(c), loss);
            }
        }
        let (y, modes) = match after {
            Some((y, modes)) => (y, modes),
            None => (&step.y.0, &self.modes),
        };
        let energy = self.plant.energy(step.t.0, y, modes);
        ledger.note(energy.map_err(Reason::Singular)?);
        Ok(ledger)
    }
}
