//! Runs of plants: from step to step and from event to event, with an account of the energy.
//!
//! An event is looked for at the end of a step; in long steps also at points of the dense output. It is
//! located by shorter steps of the method itself, so that the state there has the method's order,
//! whatever the order of the dense output. The step ends just behind the event. Events that change a mode
//! count when they fall, kinks in either direction. All that fall together are settled together.

mod events;

use bgdyn_runtime::{Scalar, System};
use nalgebra::SVector;

use crate::audit::{Audit, Ledger, quadrature};
use crate::control::Tolerance;
use crate::dense::Dense;
use crate::failure::{Failure, Reason};
use crate::method::Method;
use crate::plant::{Held, Plant};
use crate::rk4::Rk4;
use crate::scene::Scene;
use crate::solver::{Proposal, Solver};
use crate::space::{Of, Real, Space};

/// A plant at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment<Y: Space, M> {
    /// Time, s.
    pub t: Of<Y>,
    /// State: positions, velocities, first-order states.
    pub y: Y,
    /// Modes.
    pub modes: M,
}

type Time<P> = Of<<P as Plant>::State>;
type Failed<P> = Failure<<P as Plant>::State, <P as Plant>::Error>;
type Refused<P> = Reason<<P as Plant>::Error>;
type Proposed<P, M> = Proposal<<P as Plant>::State, <M as Method<<P as Plant>::State>>::Stages>;

/// Events within one call of [`Run::step`] at the most.
const EVENTS: usize = 64;

/// A joint that is held while a run goes on drifts by the errors of the method: it counts as at rest
/// up to this part of its velocity.
const DRIFT: f64 = 1e-6;

/// Whether modes agree with the state, the inputs and the parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Agreement {
    /// Nothing has looked yet: a run that begins.
    Unknown,
    /// Inputs or parameters may have changed since.
    Disturbed,
    /// They do.
    Settled,
}

/// A run of a plant by a method; [`Rk4`] where nothing else is said.
///
/// Modes are settled when the run begins and after [`Run::plant_mut`]: a joint that moves slips, one
/// at rest holds where it can, whatever the modes it begins with say.
///
/// A step ends at an event and goes on from there: at a change of a mode with the state after it, at
/// a kink so that the method keeps its order. Where a step fails the run stays at the last good
/// state.
#[derive(Debug)]
pub struct Run<P: Plant, M: Method<P::State> = Rk4> {
    plant: P,
    modes: P::Modes,
    solver: Solver<P::State, M>,
    /// Whether work is added up.
    audited: bool,
    ledger: Ledger<P::Entries>,
    /// Events that changed a mode, so far.
    pub events: usize,
    /// When the last of them was, s.
    pub last_event: Time<P>,
    /// Kinks that were passed, so far.
    pub kinks: usize,
    /// Events that followed each other in next to no time.
    crowded: usize,
    agreement: Agreement,
}

/// How many events a call may still meet.
struct Budget {
    events: usize,
    kinks: usize,
}

impl Budget {
    fn new() -> Self {
        Budget {
            events: EVENTS,
            kinks: EVENTS,
        }
    }
}

impl<
    'a,
    S,
    T: Real,
    const N: usize,
    const NM: usize,
    const NU: usize,
    const NE: usize,
    const NY: usize,
    const NP: usize,
> Run<Scene<'a, S, T, N, NM, NU, NE, NY, NP>, Rk4>
where
    S: System<T, N, NM, NU, NE, NY, NP>,
{
    /// From where the scene begins, by [`Rk4`].
    pub fn new(scene: &'a S) -> Self {
        Run::by(Rk4, Scene::new(scene), Self::begin(scene))
    }

    /// Where the scene begins, at t = 0.
    pub fn begin(scene: &S) -> Moment<SVector<T, N>, SVector<T, NM>> {
        let (y, modes) = scene.start();
        let t = T::from_f64(0.0);
        Moment { t, y, modes }
    }
}

impl<P: Plant, M: Method<P::State>> Run<P, M>
where
    Time<P>: Real,
{
    /// From a moment, by a method.
    pub fn by(method: M, plant: P, from: Moment<P::State, P::Modes>) -> Self {
        Run {
            ledger: Ledger::new(plant.nothing()),
            plant,
            modes: from.modes,
            solver: Solver::new(method, from.t, from.y),
            audited: true,
            events: 0,
            last_event: Time::<P>::from_f64(0.0),
            kinks: 0,
            crowded: 0,
            agreement: Agreement::Unknown,
        }
    }

    /// With compensated sums, as [`Solver::compensated`].
    #[must_use]
    pub fn compensated(mut self) -> Self {
        self.solver = self.solver.compensated();
        self
    }

    /// With controlled steps, where the method estimates its error.
    #[must_use]
    pub fn with_tolerance(mut self, tolerance: Tolerance<Time<P>>) -> Self {
        self.solver = self.solver.with_tolerance(tolerance);
        self
    }

    /// Without the account of work, which costs evaluations of the power in each step.
    #[must_use]
    pub fn unaudited(mut self) -> Self {
        self.audited = false;
        self
    }

    /// Time, s.
    pub fn t(&self) -> Time<P> {
        self.solver.t()
    }

    /// State.
    pub fn y(&self) -> &P::State {
        self.solver.y()
    }

    /// The state's second word, as [`Solver::low`].
    pub fn low(&self) -> Option<&P::State> {
        self.solver.low()
    }

    /// Modes.
    pub fn modes(&self) -> &P::Modes {
        &self.modes
    }

    /// The plant.
    pub fn plant(&self) -> &P {
        &self.plant
    }

    /// The plant, to change its given inputs or its parameters. Modes are settled before the next
    /// step.
    pub fn plant_mut(&mut self) -> &mut P {
        self.solver.forget();
        if self.agreement == Agreement::Settled {
            self.agreement = Agreement::Disturbed;
        }
        &mut self.plant
    }

    /// Where the energy went since the start.
    pub fn audit(&self) -> Audit<P::Entries> {
        self.ledger.audit()
    }

    fn held(&self) -> Held<'_, P> {
        Held {
            plant: &self.plant,
            modes: &self.modes,
        }
    }

    /// Settles the modes now, where the next step would: for those who look at them before.
    ///
    /// # Errors
    /// Where the plant has no rates in this state.
    pub fn settle(&mut self) -> Result<(), Failed<P>> {
        let settled = self.settle_modes();
        settled.map_err(|reason| self.solver.failure(reason))
    }

    fn settle_modes(&mut self) -> Result<(), Refused<P>> {
        let rest = match self.agreement {
            Agreement::Settled => return Ok(()),
            Agreement::Unknown => Time::<P>::from_f64(0.0),
            Agreement::Disturbed => Time::<P>::from_f64(DRIFT),
        };
        let found = self.plant.settled(self.t(), self.y(), &self.modes, rest);
        if let Some((y, modes)) = found.map_err(Reason::Singular)? {
            self.modes = modes;
            self.solver.restart(y);
            if self.agreement == Agreement::Disturbed {
                self.events += 1;
                self.last_event = self.t();
            }
        }
        self.agreement = Agreement::Settled;
        Ok(())
    }

    /// On by `h`, s: one fixed step or as many controlled ones as it takes, from event to event where
    /// there are any.
    ///
    /// # Errors
    /// Where the plant cannot go on.
    pub fn step(&mut self, h: Time<P>) -> Result<(), Failed<P>> {
        // What rounding leaves of a step is no step.
        let rest = h * Time::<P>::EPSILON * Time::<P>::from_f64(4096.0);
        let mut budget = Budget::new();
        let mut left = h;
        while rest < left {
            let piece = self.piece(left, &mut budget, false);
            left = left - piece.map_err(|reason| self.solver.failure(reason))?.0;
        }
        Ok(())
    }

    /// One step of the method, no longer than `most`, or up to the first event in it. Gives the
    /// states within.
    ///
    /// # Errors
    /// Where the plant cannot go on.
    pub fn advance_densely(&mut self, most: Time<P>) -> Result<Dense<P::State>, Failed<P>> {
        let piece = self.piece(most, &mut Budget::new(), true);
        let (h, dense) = piece.map_err(|reason| self.solver.failure(reason))?;
        let here = || Dense::new(self.t(), h, self.y(), [const { None }; 7]);
        Ok(dense.unwrap_or_else(here))
    }

    /// A step of the length `most` or a controlled one, up to the first event in it: its length and,
    /// if wanted or needed, the states within.
    #[expect(clippy::type_complexity, reason = "a length and what lies within")]
    fn piece(
        &mut self,
        most: Time<P>,
        budget: &mut Budget,
        densely: bool,
    ) -> Result<(Time<P>, Option<Dense<P::State>>), Refused<P>> {
        self.settle_modes()?;
        if self.audited && !self.ledger.is_open() {
            let energy = self.plant.energy(self.t(), self.y(), &self.modes);
            self.ledger.note(energy.map_err(Reason::Singular)?);
        }
        let held = Held {
            plant: &self.plant,
            modes: &self.modes,
        };
        let mut proposal = self.solver.propose(&held, most)?;
        let found = self.first_event(&proposal, budget)?;
        let passed = found.map(|(shorter, passed)| {
            proposal = shorter;
            passed
        });
        let dense = if densely || self.audited {
            Some(self.solver.dense(&self.held(), &proposal.step)?)
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
        Ok((h, dense))
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
        for (at, weight) in quadrature(self.solver.method().facts().order) {
            let theta: Time<P> = at.to();
            let t = dense.start() + theta * h;
            let power = self.plant.power(t, &dense.at(theta), &self.modes);
            ledger.add(
                weight.to::<Time<P>>() * h,
                &power.map_err(Reason::Singular)?,
            );
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
