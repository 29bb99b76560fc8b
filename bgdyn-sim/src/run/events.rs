//! Events within a step: detection, location, and the changes that follow.

use bgdyn_runtime::Scalar;

use super::state::{Budget, Proposed, Refused, Run};
use crate::failure::Reason;
use crate::integrator::Integrator;
use crate::plant::{EventValues, Plant, Time};
use crate::real::Real;
use crate::zero_crossing::first_passage;

/// The values of all events at the beginning of a step and just behind the first passage.
pub(super) struct Passed<V> {
    before: V,
    behind: V,
}

/// How far behind a kink a step ends, in multiples of what instants are told apart by. A mode changes at
/// once: every moment longer in the old one is an error of first order.
const BEHIND: f64 = 4.0;

/// How far an event's value is from passing through zero, negative or 0 once it has; `passed` whether
/// it has. `None` where its passage would be none: the rise of a value whose fall changes a mode.
fn passage<T: Real>(before: T, now: T, changes_mode: bool) -> Option<(T, bool)> {
    let zero = T::from_f64(0.0);
    if before >= zero {
        Some((now, now < zero))
    } else if changes_mode {
        None
    } else {
        Some((-now, now >= zero))
    }
}

impl<P: Plant, M: Integrator<P::State>> Run<P, M>
where
    Time<P>: Real,
{
    /// Values of the events at a moment with the modes as they are.
    fn values(&self, t: Time<P>, y: &P::State) -> Result<P::Values, Refused<P>> {
        let values = self.plant.events(t, y, &self.modes);
        values.map_err(Reason::Singular)
    }

    /// The least distance to a passage among the events for which `counts` holds, and whether one of
    /// them has passed.
    fn nearest(
        &self,
        before: &P::Values,
        now: &P::Values,
        budget: &Budget,
        counts: impl Fn(usize) -> bool,
    ) -> (Time<P>, bool) {
        let mut nearest = (Time::<P>::from_f64(f64::INFINITY), false);
        for e in (0..now.count()).filter(|&e| counts(e)) {
            let found = self.passage_of(e, before, now, budget);
            let Some((distance, passed)) = found else {
                continue;
            };
            nearest = (nearest.0.min(distance), nearest.1 || passed);
        }
        nearest
    }

    /// [`passage`] of one event; kinks do not count any more once there were too many.
    fn passage_of(
        &self,
        e: usize,
        before: &P::Values,
        now: &P::Values,
        budget: &Budget,
    ) -> Option<(Time<P>, bool)> {
        let changes = self.plant.changes_mode(e);
        let counts = changes || budget.kinks > 0;
        let found = passage(before.value(e), now.value(e), changes);
        found.filter(|_| counts)
    }

    /// The shorter step that ends just behind the first event, where there is one in the step
    /// proposed.
    #[expect(clippy::type_complexity, reason = "a step and what it passes")]
    pub(super) fn first_event(
        &self,
        whole: &Proposed<P, M>,
        budget: &Budget,
    ) -> Result<Option<(Proposed<P, M>, Passed<P::Values>)>, Refused<P>> {
        let before = self.values(self.t(), self.y())?;
        if before.count() == 0 {
            return Ok(None);
        }
        let [zero, one] = [0.0, 1.0].map(Time::<P>::from_f64);
        // Where to look first: in the part of the step that the dense output says.
        let (mut low, mut high, guess) = (zero, one, self.suspect(whole, &before, budget)?);
        let mut end = self.values(whole.t.0, &whole.y.0)?;
        if let Some((part, _)) = guess {
            let there = self.shorter(whole, part.1)?;
            let values = self.values(there.t.0, &there.y.0)?;
            if self.nearest(&before, &values, budget, |_| true).1 {
                (high, end) = (part.1, values);
            } else {
                low = part.1;
            }
        }
        if !self.nearest(&before, &end, budget, |_| true).1 {
            return Ok(None);
        }
        let suspects = |e: usize| {
            let found = self.passage_of(e, &before, &end, budget);
            found.is_some_and(|(_, passed)| passed)
        };
        let distance = |values: &P::Values| self.nearest(&before, values, budget, suspects);
        let start = match low == zero {
            true => before.clone(),
            false => {
                let there = self.shorter(whole, low)?;
                self.values(there.t.0, &there.y.0)?
            }
        };
        let ends = ((low, distance(&start).0), (high, distance(&end).0));
        let value = |theta| {
            let there = self.shorter(whole, theta)?;
            Ok(distance(&self.values(there.t.0, &there.y.0)?))
        };
        let width = self.resolution(whole);
        let at = first_passage(value, ends, guess.map(|(_, at)| at), width)?;
        let found = self.passed_at(whole, at, &before)?;
        let fell = |e| self.fell(e, &found.1);
        if (0..before.count()).any(fell) {
            return Ok(Some(found));
        }
        // On the kink itself rounding would choose the side whose slope is taken: a little behind it
        // every function sees the side that comes. A law is continuous there, so nothing is lost.
        let at = one.min(at + width * Time::<P>::from_f64(BEHIND));
        self.passed_at(whole, at, &before).map(Some)
    }

    /// The shorter step of this part of a proposed one's length, and the events' values at its ends.
    #[expect(clippy::type_complexity, reason = "a step and what it passes")]
    fn passed_at(
        &self,
        whole: &Proposed<P, M>,
        at: Time<P>,
        before: &P::Values,
    ) -> Result<(Proposed<P, M>, Passed<P::Values>), Refused<P>> {
        let there = self.shorter(whole, at)?;
        let behind = self.values(there.t.0, &there.y.0)?;
        let before = before.clone();
        Ok((there, Passed { before, behind }))
    }

    /// To which part of a step instants are told apart: a few roundings of the time.
    fn resolution(&self, whole: &Proposed<P, M>) -> Time<P> {
        let h = whole.step.h.abs();
        Time::<P>::EPSILON * Time::<P>::from_f64(4.0) * (self.t().abs().max(h) / h)
    }

    /// The part of a long step in which its dense output first shows an event, and where in it.
    #[expect(clippy::type_complexity, reason = "an interval and an instant")]
    fn suspect(
        &self,
        whole: &Proposed<P, M>,
        before: &P::Values,
        budget: &Budget,
    ) -> Result<Option<((Time<P>, Time<P>), Time<P>)>, Refused<P>> {
        let looks = self.solver.integrator().info().looks;
        if looks < 2 {
            return Ok(None);
        }
        let dense = self.solver.dense(&self.fixed_modes(), &whole.step)?;
        let values = |theta: Time<P>| {
            let t = dense.start() + theta * dense.length();
            self.values(t, &self.within(&dense, theta)?)
        };
        let number = |n: u32| Time::<P>::from_f64(n.into());
        let mut low = (number(0), before.clone());
        for look in 1..=looks {
            let theta = number(look) / number(looks);
            let now = values(theta)?;
            if !self.nearest(before, &now, budget, |_| true).1 {
                low = (theta, now);
                continue;
            }
            let suspects = |e: usize| {
                let found = self.passage_of(e, before, &now, budget);
                found.is_some_and(|(_, passed)| passed)
            };
            let distance = |values: &P::Values| self.nearest(before, values, budget, suspects);
            let ends = ((low.0, distance(&low.1).0), (theta, distance(&now).0));
            let value = |theta| Ok(distance(&values(theta)?));
            let at = first_passage(value, ends, None, self.resolution(whole))?;
            return Ok(Some(((low.0, theta), at)));
        }
        Ok(None)
    }

    /// The step from here of this part of a proposed one's length.
    fn shorter(
        &self,
        whole: &Proposed<P, M>,
        theta: Time<P>,
    ) -> Result<Proposed<P, M>, Refused<P>> {
        self.solver
            .attempt(&self.fixed_modes(), whole.step.h * theta)
    }

    /// State and modes after the events that a step has passed; `None` where all of them are kinks.
    #[expect(clippy::type_complexity, reason = "state and modes, where they jump")]
    pub(super) fn after(
        &self,
        step: &Proposed<P, M>,
        passed: &Passed<P::Values>,
        budget: &Budget,
    ) -> Result<Option<(P::State, P::Modes)>, Refused<P>> {
        let fell = |e| self.fell(e, passed);
        if !(0..passed.before.count()).any(fell) {
            return Ok(None);
        }
        let events = self.plant.most_events();
        if budget.events == 0 || self.zeno_count >= events {
            return Err(Reason::TooManyEvents { events });
        }
        let after = self.plant.change(step.t.0, &step.y.0, &self.modes, fell);
        after.map(Some).map_err(Reason::Singular)
    }

    /// Whether an event that changes a mode has passed.
    fn fell(&self, e: usize, passed: &Passed<P::Values>) -> bool {
        let zero = Time::<P>::from_f64(0.0);
        let (before, behind) = (passed.before.value(e), passed.behind.value(e));
        self.plant.changes_mode(e) && before >= zero && behind < zero
    }

    /// Counts what a step has passed.
    pub(super) fn count(&mut self, passed: &Passed<P::Values>, budget: &mut Budget) {
        let events = passed.before.count();
        let fell = (0..events).filter(|&e| self.fell(e, passed)).count();
        if fell > 0 {
            let apart = self.t() - self.last_event;
            let close = Time::<P>::EPSILON.sqrt() * self.t().abs();
            self.zeno_count = if apart < close {
                self.zeno_count + 1
            } else {
                0
            };
            budget.events -= 1;
            self.events += fell;
            self.last_event = self.t();
        } else {
            budget.kinks = budget.kinks.saturating_sub(1);
            self.kinks += 1;
        }
    }
}
