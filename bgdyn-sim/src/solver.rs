//! Advances a state step by step: fixed or controlled steps, plain or compensated sums.

use bgdyn_runtime::{Scalar, StateVector};

use crate::control::{Controller, Tolerance, first_step};
use crate::dense::Dense;
use crate::failure::{Failure, Reason};
use crate::integrator::{Integrator, Start, Step};
use crate::ode::Ode;
use crate::real::{Of, Real, finite};

/// A step that may be taken.
#[derive(Clone, Debug)]
pub(crate) struct Proposal<Y: StateVector, S> {
    pub(crate) step: Step<Y, S>,
    /// Time and state where it leads, each with what its rounding leaves.
    pub(crate) t: (Of<Y>, Of<Y>),
    pub(crate) y: (Y, Option<Y>),
    /// Whether the state is where the step itself leads.
    smooth: bool,
}

/// An integration by a one-step method, where it is now.
///
/// With a [`Tolerance`] and a method that estimates its error the steps are controlled, otherwise
/// they are as long as [`Solver::advance`] says.
#[derive(Clone, Debug)]
pub struct Solver<Y: StateVector, M: Integrator<Y>> {
    integrator: M,
    t: Of<Y>,
    y: Y,
    /// What rounding has taken from the time.
    low_time: Of<Y>,
    /// What rounding has taken from the state; kept if sums are compensated.
    low: Option<Y>,
    /// The step that ended here, while the equation is the same.
    before: Option<Step<Y, M::Stages>>,
    control: Option<(Tolerance<Of<Y>>, Controller)>,
    /// The next controlled step.
    h: Option<Of<Y>>,
}

impl<Y: StateVector, M: Integrator<Y>> Solver<Y, M>
where
    Of<Y>: Real,
{
    /// From the state `y` at time `t`.
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

    /// With compensated sums (Kahan 1965): what rounding takes from the state when a step is added is
    /// kept in a second word, and added with the next one.
    #[must_use]
    pub fn compensated(mut self) -> Self {
        self.low = Some(self.y.zero());
        self
    }

    /// With controlled steps, where the method estimates its error.
    #[must_use]
    pub fn with_tolerance(mut self, tolerance: Tolerance<Of<Y>>) -> Self {
        let estimate = self.integrator.info().estimate;
        self.control = estimate.map(|estimate| (tolerance, Controller::new(estimate)));
        self
    }

    /// The integrator.
    pub fn integrator(&self) -> &M {
        &self.integrator
    }

    /// Time.
    pub fn t(&self) -> Of<Y> {
        self.t
    }

    /// State.
    pub fn y(&self) -> &Y {
        &self.y
    }

    /// What the state lacks for having been rounded, if sums are compensated: the state is
    /// [`Solver::y`] plus this, unevaluated.
    pub fn low(&self) -> Option<&Y> {
        self.low.as_ref()
    }

    /// Whether steps are controlled.
    pub fn is_controlled(&self) -> bool {
        self.control.is_some()
    }

    /// The state jumps, or its equation changes.
    pub fn restart(&mut self, y: Y) {
        self.low = self.low.as_ref().map(|_| y.zero());
        self.y = y;
        self.forget();
    }

    /// The clock shows `t`: an instant that lies within rounding of its own.
    pub(crate) fn set_clock(&mut self, t: Of<Y>) {
        (self.t, self.low_time) = (t, Of::<Y>::from_f64(0.0));
    }

    /// The equation changes: nothing of earlier steps holds any more.
    pub fn forget(&mut self) {
        self.before = None;
        if let Some((_, controller)) = &mut self.control {
            controller.restart();
        }
    }

    /// A failure here.
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

    /// One step: of the length `most`, or a controlled one no longer than that. Gives its length.
    ///
    /// # Errors
    /// With the reason, where the step fails; the solver stays where it was.
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

    /// [`Solver::advance`], with the states within the step.
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

    /// To the time `end`: one fixed step, or as many controlled ones as it takes.
    ///
    /// # Errors
    /// As [`Solver::advance`]; the solver stays at the end of the last step that succeeded.
    pub fn advance_to<O: Ode<State = Y>>(
        &mut self,
        ode: &O,
        end: Of<Y>,
    ) -> Result<(), Failure<Y, O::Error>> {
        while self.t < end {
            let left = (end - self.t) - self.low_time;
            let taken = self.advance(ode, left)?;
            if taken >= left {
                // Rounding must not leave a step of no length.
                self.set_clock(end);
            }
        }
        Ok(())
    }

    /// The step that [`Solver::advance`] would take.
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
            // A little more than the step rather than a tiny one after it.
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
                // A step cut short by its end says nothing against longer ones.
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

    /// A step of length `h`, whatever its error.
    pub(crate) fn attempt<O: Ode<State = Y>>(
        &self,
        ode: &O,
        h: Of<Y>,
    ) -> Result<Proposal<Y, M::Stages>, Reason<O::Error>> {
        let step = self.integrator.step(ode, &self.start(), h)?;
        let t = sum_in_two(self.t, self.low_time + h);
        let (mut y, low) = match &self.low {
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
        let smooth = !ode.project(&mut y);
        Ok(Proposal {
            step,
            t,
            y: (y, low),
            smooth,
        })
    }

    /// Takes a proposed step.
    pub(crate) fn take(&mut self, proposal: Proposal<Y, M::Stages>) {
        (self.t, self.low_time) = proposal.t;
        (self.y, self.low) = proposal.y;
        self.before = proposal.smooth.then_some(proposal.step);
    }

    /// States within a step that was proposed from here.
    pub(crate) fn dense<O: Ode<State = Y>>(
        &self,
        ode: &O,
        step: &Step<Y, M::Stages>,
    ) -> Result<Dense<Y>, Reason<O::Error>> {
        self.integrator.dense(ode, &self.start(), step)
    }
}

/// a + b rounded, and what rounding leaves (Knuth's two-sum).
pub(crate) fn sum_in_two<T: Scalar>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    let back = sum - a;
    (sum, (a - (sum - back)) + (b - back))
}
