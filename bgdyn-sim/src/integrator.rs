//! The trait of integrators: one-step methods for ẏ = f(t, y).

use core::fmt::Debug;

use bgdyn_runtime::{Scalar as _, StateVector};

use crate::contact_step::ContactStep;
use crate::dense::Dense;
use crate::failure::Reason;
use crate::ode::{Ode, ScalarOf};
use crate::real::Of;

/// Properties of an integrator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IntegratorInfo {
    /// Name in scenes: `rk4`.
    pub name: &'static str,
    /// Order p: halving the step divides the error of a run by 2ᵖ.
    pub order: u32,
    /// The power of the step to which its estimate of a step's error is proportional; `None` for
    /// integrators without an estimate, which take fixed steps only.
    pub estimate: Option<u32>,
    /// Number of parts into which a step is divided in the search for events: long steps have more.
    pub looks: u32,
    /// Whether the integrator reads the slopes of the rates, [`Ode::jacobian`].
    pub reads_jacobian: bool,
}

/// A step that an integrator has tried.
#[derive(Clone, Debug)]
pub struct Step<Y: StateVector, S> {
    /// Length of the step.
    pub h: Of<Y>,
    /// y(t + h) − y(t)
    pub change: Y,
    /// Data of the integrator about the step.
    pub stages: S,
}

/// The start of a step.
#[derive(Clone, Debug)]
pub struct Start<'a, Y: StateVector, S> {
    /// Time.
    pub t: Of<Y>,
    /// State.
    pub y: &'a Y,
    /// The previous step of the same equation, if any.
    pub before: Option<&'a Step<Y, S>>,
}

/// The rates at the end of a step, or the reason why they do not exist.
type Tried<T, O> = Result<T, Reason<<O as Ode>::Error>>;

/// A one-step integrator for states `Y`.
pub trait Integrator<Y: StateVector> {
    /// Data of a step for its error estimate, its dense output and the next step.
    type Stages: Clone + Debug;

    /// Returns the properties of the integrator.
    fn info(&self) -> IntegratorInfo;

    /// Returns whether it conserves quadratic invariants such as the length of a quaternion to rounding.
    /// States are then projected only where they stray from their manifold.
    fn keeps_lengths(&self) -> bool {
        false
    }

    /// Returns whether it solves for the impulses of rigid contacts ([`Ode::rigid_contacts`]). Others refuse equations with some.
    fn solves_contacts(&self) -> bool {
        false
    }

    /// Returns the rigid contacts in a step, of an integrator that solves for their impulses.
    fn contact_step<'s>(&self, stages: &'s Self::Stages) -> Option<&'s ContactStep<Of<Y>>> {
        let _ = stages;
        None
    }

    /// Computes a step of length `h`.
    ///
    /// # Errors
    /// If the rates do not exist, or the integrator's equations cannot be solved.
    fn step<O: Ode<State = Y>>(
        &self,
        ode: &O,
        from: &Start<'_, Y, Self::Stages>,
        h: Of<Y>,
    ) -> Tried<Step<Y, Self::Stages>, O>;

    /// Returns the estimate of a step's error in units of the tolerance, where `scale` is the tolerance by
    /// component; 1 is the largest accepted value. `None` for integrators without an estimate.
    fn error(&self, step: &Step<Y, Self::Stages>, scale: &Y) -> Option<Of<Y>> {
        let _ = (step, scale);
        None
    }

    /// Returns the states within a step. The default is Hermite's cubic through both ends.
    ///
    /// # Errors
    /// If the rates do not exist.
    fn dense<O: Ode<State = Y>>(
        &self,
        ode: &O,
        from: &Start<'_, Y, Self::Stages>,
        step: &Step<Y, Self::Stages>,
    ) -> Tried<Dense<Y>, O> {
        hermite(ode, from.t, from.y, step.h, &step.change)
    }
}

/// Returns Hermite's cubic over a step from `y` by `change`.
pub(crate) fn hermite<O: Ode>(
    ode: &O,
    t: ScalarOf<O>,
    y: &O::State,
    h: ScalarOf<O>,
    change: &O::State,
) -> Tried<Dense<O::State>, O> {
    let one = Of::<O::State>::from_f64(1.0);
    let first = ode.rates(t, y).map_err(Reason::Singular)?;
    let last = ode
        .rates(t + h, &y.plus(one, change))
        .map_err(Reason::Singular)?;
    Ok(Dense::new(t, h, y, Dense::cubic(h, change, &first, &last)))
}
