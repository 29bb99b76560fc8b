//! The state of a run between two steps: plant, modes, solver and energy account.

use bgdyn_runtime::{HybridSystem, Scalar, StateVector};

use crate::audit::{Audit, Ledger};
use crate::contact_step::ContactStep;
use crate::control::Tolerance;
use crate::failure::{Failure, Reason};
use crate::integrator::Integrator;
use crate::plant::{FixedModes, Plant, Time};
use crate::real::{Of, Real};
use crate::rk4::Rk4;
use crate::scene_plant::ScenePlant;
use crate::solver::{Proposal, Solver};

/// Time, state and modes of a plant at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HybridState<Y: StateVector, M> {
    /// Time, s.
    pub t: Of<Y>,
    /// State: positions, velocities, first-order states.
    pub y: Y,
    /// Modes.
    pub modes: M,
}

pub(super) type Failed<P> = Failure<<P as Plant>::State, <P as Plant>::Error>;
pub(super) type Refused<P> = Reason<<P as Plant>::Error>;
pub(super) type Proposed<P, M> =
    Proposal<<P as Plant>::State, <M as Integrator<<P as Plant>::State>>::Stages>;

/// Kinks within one call of [`Run::step`] that end a step; more are passed over.
const MOST_KINKS: usize = 64;

/// A joint that is held while a run goes on drifts by the errors of the method: it counts as at rest
/// up to this part of its velocity.
const DRIFT: f64 = 1e-6;

/// Whether modes agree with the state, the inputs and the parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Agreement {
    /// Nothing has looked yet: a run that begins.
    Unknown,
    /// Inputs or parameters may have changed since.
    Disturbed,
    /// They do.
    Reached,
}

/// A run of a plant by a method; [`Rk4`] where nothing else is said.
///
/// When the run begins and after [`Run::plant_mut`] the modes are made to agree with the state: a joint
/// that moves slips, one at rest holds where it can, whatever the modes it begins with say.
///
/// A step ends at an event and goes on from there: at a change of a mode with the state after it, at
/// a kink so that the method keeps its order. Where a step fails the run stays at the last good
/// state.
#[derive(Debug)]
pub struct Run<P: Plant, M: Integrator<P::State> = Rk4> {
    pub(super) plant: P,
    pub(super) modes: P::Modes,
    pub(super) solver: Solver<P::State, M>,
    /// Whether work is added up.
    pub(super) audited: bool,
    pub(super) ledger: Ledger<P::Entries>,
    /// Events that changed a mode, so far.
    pub events: usize,
    /// When the last of them was, s.
    pub last_event: Time<P>,
    /// Kinks that were passed, so far.
    pub kinks: usize,
    /// Events that followed each other in next to no time.
    pub(super) zeno_count: usize,
    pub(super) agreement: Agreement,
    /// The rigid contacts in the last step.
    pub(super) contacts: Option<ContactStep<Time<P>>>,
}

/// How many events a call may still meet.
pub(super) struct Budget {
    pub(super) events: usize,
    pub(super) kinks: usize,
}

impl Budget {
    pub(super) fn new(events: usize) -> Self {
        Budget {
            events,
            kinks: MOST_KINKS,
        }
    }
}

impl<'a, S: HybridSystem<T>, T: Real> Run<ScenePlant<'a, S, T>, Rk4> {
    /// From where the scene begins, by [`Rk4`].
    pub fn new(scene: &'a S) -> Self {
        Run::by(Rk4, ScenePlant::new(scene), Self::begin(scene))
    }

    /// Where the scene begins, at t = 0.
    pub fn begin(scene: &S) -> HybridState<S::State, S::Modes> {
        let (y, modes) = scene.start();
        let t = T::from_f64(0.0);
        HybridState { t, y, modes }
    }
}

impl<P: Plant, M: Integrator<P::State>> Run<P, M>
where
    Time<P>: Real,
{
    /// From a state at a time, by an integrator.
    pub fn by(integrator: M, plant: P, from: HybridState<P::State, P::Modes>) -> Self {
        Run {
            ledger: Ledger::new(plant.nothing()),
            plant,
            modes: from.modes,
            solver: Solver::new(integrator, from.t, from.y),
            audited: true,
            events: 0,
            last_event: Time::<P>::from_f64(0.0),
            kinks: 0,
            zeno_count: 0,
            agreement: Agreement::Unknown,
            contacts: None,
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

    /// The plant, to change its given inputs or its parameters. Which joints hold is decided
    /// anew before the next step.
    pub fn plant_mut(&mut self) -> &mut P {
        self.solver.forget();
        if self.agreement == Agreement::Reached {
            self.agreement = Agreement::Disturbed;
        }
        &mut self.plant
    }

    /// The impulses and losses of the rigid contacts in the last step, of a method that solves for them.
    pub fn contact_step(&self) -> Option<&ContactStep<Time<P>>> {
        self.contacts.as_ref()
    }

    /// Where the energy went since the start.
    pub fn audit(&self) -> Audit<P::Entries> {
        self.ledger.audit()
    }

    pub(super) fn fixed_modes(&self) -> FixedModes<'_, P> {
        FixedModes {
            plant: &self.plant,
            modes: &self.modes,
        }
    }

    /// Decides now which joints hold, where the next step would: for those who look at the modes before.
    ///
    /// # Errors
    /// Where the plant has no rates in this state.
    pub fn resolve_stiction(&mut self) -> Result<(), Failed<P>> {
        let resolved = self.agree();
        resolved.map_err(|reason| self.solver.failure(reason))
    }

    /// Makes the modes agree with the state, where they may not.
    pub(super) fn agree(&mut self) -> Result<(), Refused<P>> {
        let rest = match self.agreement {
            Agreement::Reached => return Ok(()),
            Agreement::Unknown => {
                self.reached();
                Time::<P>::from_f64(0.0)
            }
            Agreement::Disturbed => Time::<P>::from_f64(DRIFT),
        };
        let found = self
            .plant
            .resolve_stiction(self.t(), self.y(), &self.modes, rest);
        if let Some((y, modes)) = found.map_err(Reason::Singular)? {
            self.modes = modes;
            self.solver.restart(y);
            if self.agreement == Agreement::Disturbed {
                self.events += 1;
                self.last_event = self.t();
            }
        }
        self.agreement = Agreement::Reached;
        Ok(())
    }
}
