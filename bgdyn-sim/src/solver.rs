//! Advances a state step by step: fixed or controlled steps, plain or compensated sums.

use bgdyn_runtime::{ImpactLaw, MOST_CONTACTS, Scalar as _, StateVector};

use crate::control::{Controller, Tolerance, first_step};
use crate::dense::Dense;
use crate::failure::{Failure, Reason};
use crate::integrator::{Integrator, Start, Step};
use crate::ode::Ode;
use crate::real::{Of, Real, finite};
use crate::two_sum::sum_in_two;

/// A step that the solver can accept.
#[derive(Clone, Debug)]
pub(crate) struct Proposal<Y: StateVector, S> {
    pub(crate) step: Step<Y, S>,
    /// Time and state at the end of the step, each with its rounding error.
    pub(crate) t: (Of<Y>, Of<Y>),
    pub(crate) y: (Y, Option<Y>),
    /// Whether the state is that of the step, without projection.
    smooth: bool,
}

/// Integrates an equation step by step.
///
/// With a [`Tolerance`] and an integrator that estimates its error, the steps are controlled; otherwise
/// [`Solver::advance`] takes steps of the given length.
#[derive(Clone, Debug)]
pub struct Solver<Y: StateVector, M: Integrator<Y>> {
    integrator: M,
    t: Of<Y>,
    y: Y,
    /// Rounding error of the time.
    low_time: Of<Y>,
    /// Rounding error of the state, with compensated sums.
    low: Option<Y>,
    /// The previous step, if its equation was the same.
    before: Option<Step<Y, M::Stages>>,
    control: Option<(Tolerance<Of<Y>>, Controller)>,
    /// Length of the next controlled step.
    h: Option<Of<Y>>,
}

impl<Y: StateVector, M: Integrator<Y>> Solver<Y, M>
where
    Of<Y>: Real,
{
    /// Returns a solver at the state `y` and the time `t`.
    pub fn new(integrator: M, t: Of<Y>, y: Y) -> Self {
        Solver {
            integrator,
            t,
            y,
            low_time: Of::<Y>::from_f64(0.0),
            low: None,
            before: None,
            control: None,
            h: None,
        }
    }

    /// Uses compensated sums (Kahan 1965): the rounding error of adding a step to the state is stored in a
    /// second word, and added with the next step.
    #[must_use]
    pub fn compensated(mut self) -> Self {
        self.low = Some(self.y.zero());
        self
    }

    /// Controls the steps if the integrator estimates its error.
    #[must_use]
    pub fn with_tolerance(mut self, tolerance: Tolerance<Of<Y>>) -> Self {
        let estimate = self.integrator.info().estimate;
        self.control = estimate.map(|estimate| (tolerance, Controller::new(estimate)));
        self
    }

    /// Returns the integrator.
    pub fn integrator(&self) -> &M {
        &self.integrator
    }

    /// Returns the time.
    pub fn t(&self) -> Of<Y> {
        self.t
    }

    /// Returns the state.
    pub fn y(&self) -> &Y {
        &self.y
    }

    /// Returns the rounding error of the state with compensated sums: the state is [`Solver::y`] plus
    /// this, unevaluated.
    pub fn low(&self) -> Option<&Y> {
        self.low.as_ref()
    }

    /// Returns whether steps are controlled.
    pub fn is_controlled(&self) -> bool {
        self.control.is_some()
    }

    /// Restarts at a new state, after a jump of the state or a change of the equation.
    pub fn restart(&mut self, y: Y) {
        self.low = self.low.as_ref().map(|_| y.zero());
        self.y = y;
        self.forget();
    }

    /// Sets the time to `t`, which differs from it by rounding only.
    pub(crate) fn set_clock(&mut self, t: Of<Y>) {
        (self.t, self.low_time) = (t, Of::<Y>::from_f64(0.0));
    }

    /// Discards data of earlier steps, because the equation has changed.
    pub fn forget(&mut self) {
        self.before = None;
        if let Some((_, controller)) = &mut self.control {
            controller.restart();
        }
    }

    /// Returns a failure at the current time and state.
    pub(crate) fn failure<E>(&self, reason: Reason<E>) -> Failure<Y, E> {
        Failure {
            t: self.t,
            y: self.y.clone(),
            reason,
        }
    }

    fn start(&self) -> Start<'_, Y, M::Stages> {
        Start {
            t: self.t,
            y: &self.y,
            before: self.before.as_ref(),
        }
    }

    /// Takes one step: of the length `most`, or a controlled one that is not longer. Returns its length.
    ///
    /// # Errors
    /// The reason, if the step fails; the solver does not move.
    pub fn advance<O: Ode<State = Y>>(
        &mut self,
        ode: &O,
        most: Of<Y>,
    ) -> Result<Of<Y>, Failure<Y, O::Error>> {
        let proposal = self.propose(ode, most);
        let proposal = proposal.map_err(|reason| self.failure(reason))?;
        let h = proposal.step.h;
        self.take(proposal);
        Ok(h)
    }

    /// Takes a step as [`Solver::advance`] does, and returns the states within it.
    ///
    /// # Errors
    /// As [`Solver::advance`].
    pub fn advance_densely<O: Ode<State = Y>>(
        &mut self,
        ode: &O,
        most: Of<Y>,
    ) -> Result<Dense<Y>, Failure<Y, O::Error>> {
        let proposal = self.propose(ode, most);
        let proposal = proposal.map_err(|reason| self.failure(reason))?;
        let dense = self.dense(ode, &proposal.step);
        let dense = dense.map_err(|reason| self.failure(reason))?;
        self.take(proposal);
        Ok(dense)
    }

    /// Advances to the time `end`, by one fixed step or by several controlled ones.
    ///
    /// # Errors
    /// As [`Solver::advance`]; the solver remains at the end of the last successful step.
    pub fn advance_to<O: Ode<State = Y>>(
        &mut self,
        ode: &O,
        end: Of<Y>,
    ) -> Result<(), Failure<Y, O::Error>> {
        while self.t < end {
            let left = (end - self.t) - self.low_time;
            let taken = self.advance(ode, left)?;
            if taken >= left {
                // Set the time exactly: rounding must not leave a step of length zero.
                self.set_clock(end);
            }
        }
        Ok(())
    }

    /// Computes the step that [`Solver::advance`] would take.
    pub(crate) fn propose<O: Ode<State = Y>>(
        &mut self,
        ode: &O,
        most: Of<Y>,
    ) -> Result<Proposal<Y, M::Stages>, Reason<O::Error>> {
        let Some((tolerance, mut controller)) = self.control else {
            return self.attempt(ode, most);
        };
        let mut h = match self.h {
            Some(h) => h,
            None => {
                let order = self.integrator.info().order;
                let first = first_step(ode, (self.t, &self.y), &tolerance, order, most);
                first.map_err(Reason::Singular)?
            }
        };
        let resolved = Of::<Y>::EPSILON * Of::<Y>::from_f64(16.0) * self.t.abs();
        let least = resolved.max(Of::<Y>::from_f64(1e-300));
        let mut error = controller.last();
        loop {
            // Take a slightly longer step instead of a tiny one at the end.
            let shortened = h * Of::<Y>::from_f64(1.01) >= most;
            let length = if shortened { most } else { h };
            let tried = self.attempt(ode, length);
            let judged = match &tried {
                Ok(proposal) => {
                    let scale = tolerance.scale(&self.y, &proposal.y.0);
                    error = self
                        .integrator
                        .error(&proposal.step, &scale)
                        .map_or(0.0, Real::to_f64);
                    controller.judge(error)
                }
                Err(_) => (false, controller.failed()),
            };
            let (accepted, ratio) = judged;
            let next = length * Of::<Y>::from_f64(ratio);
            if (shortened || length > least) && accepted {
                // A step that was shortened to end at `most` does not limit the next step.
                self.h = Some(if shortened { next.max(h) } else { next });
                self.control = Some((tolerance, controller));
                return tried;
            }
            if next <= least || length <= least {
                let h = next.to_f64();
                return tried.and(Err(Reason::StepTooSmall { h, error }));
            }
            h = next;
        }
    }

    /// Computes a step of length `h`, for any error.
    pub(crate) fn attempt<O: Ode<State = Y>>(
        &self,
        ode: &O,
        h: Of<Y>,
    ) -> Result<Proposal<Y, M::Stages>, Reason<O::Error>> {
        let most = if self.integrator.solves_contacts() {
            MOST_CONTACTS
        } else {
            0
        };
        if ode.rigid_contacts() > most {
            return Err(Reason::RigidContacts);
        }
        if most > 0 && ode.impact_law() != ImpactLaw::Newton {
            return Err(Reason::ImpactLaw);
        }
        let step = self.integrator.step(ode, &self.start(), h)?;
        let t = sum_in_two(self.t, self.low_time + h);
        let (mut y, mut low) = match &self.low {
            None => (self.y.plus(Of::<Y>::from_f64(1.0), &step.change), None),
            Some(low) => {
                let mut y = self.y.clone();
                let mut rest = low.plus(Of::<Y>::from_f64(1.0), &step.change);
                for (y, rest) in y.entries_mut().iter_mut().zip(rest.entries_mut()) {
                    (*y, *rest) = sum_in_two(*y, *rest);
                }
                (y, Some(rest))
            }
        };
        if !finite(&y) {
            return Err(Reason::NotFinite);
        }
        let projected = (!self.integrator.keeps_lengths() || ode.strays(&y))
            && match &mut low {
                None => ode.project(t.0, &mut y),
                Some(low) => ode.project_in_two(t.0, &mut y, low),
            }
            .map_err(Reason::Singular)?;
        let smooth = !projected;
        Ok(Proposal {
            step,
            t,
            y: (y, low),
            smooth,
        })
    }

    /// Accepts a proposed step.
    pub(crate) fn take(&mut self, proposal: Proposal<Y, M::Stages>) {
        (self.t, self.low_time) = proposal.t;
        (self.y, self.low) = proposal.y;
        // Impulses are a good guess for the next ones also after a projection.
        let continues = proposal.smooth || self.integrator.solves_contacts();
        self.before = continues.then_some(proposal.step);
    }

    /// Returns the states within a proposed step.
    pub(crate) fn dense<O: Ode<State = Y>>(
        &self,
        ode: &O,
        step: &Step<Y, M::Stages>,
    ) -> Result<Dense<Y>, Reason<O::Error>> {
        self.integrator.dense(ode, &self.start(), step)
    }
}
