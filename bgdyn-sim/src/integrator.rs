//! The trait of integrators: one-step methods for ẏ = f(t, y).

use core::fmt::Debug;

use bgdyn_runtime::{Scalar as _, StateVector};

use crate::dense::Dense;
use crate::failure::Reason;
use crate::ode::{Ode, ScalarOf};
use crate::real::Of;

/// What is known of an integrator beforehand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct IntegratorInfo {
    /// Its name in scenes: `rk4`.
    pub name: &'static str,
    /// Its order p: halving the step divides the error by 2ᵖ.
    pub order: u32,
    /// The power of the step with which its estimate of a step's error falls; `None` where it has no
    /// estimate and takes fixed steps only.
    pub estimate: Option<u32>,
    /// Into how many parts a step is divided to look for events: long steps hold more.
    pub looks: u32,
    /// Whether it reads the slopes of the rates, [`Ode::jacobian`].
    pub reads_jacobian: bool,
}

/// A step that a method has tried.
#[derive(Clone, Debug)]
pub struct Step<Y: StateVector, S> {
    /// Its length.
    pub h: Of<Y>,
    /// y(t + h) − y(t)
    pub change: Y,
    /// What the method keeps of it.
    pub stages: S,
}

/// Where a step begins.
#[derive(Clone, Debug)]
pub struct Start<'a, Y: StateVector, S> {
    /// Time.
    pub t: Of<Y>,
    /// State.
    pub y: &'a Y,
    /// The step of the same equation that ended here, if there was one.
    pub before: Option<&'a Step<Y, S>>,
}

/// The rates at the end of a step, or why there are none.
type Tried<T, O> = Result<T, Reason<<O as Ode>::Error>>;

/// A one-step method on states `Y`.
pub trait Integrator<Y: StateVector> {
    /// What a step leaves behind for its error, its dense output and the next step.
    type Stages: Clone + Debug;

    /// What is known of it beforehand.
    fn info(&self) -> IntegratorInfo;

    /// A step of length `h`.
    ///
    /// # Errors
    /// Where the rates do not exist, or the method's equations cannot be solved.
    fn step<O: Ode<State = Y>>(
        &self,
        ode: &O,
        from: &Start<'_, Y, Self::Stages>,
        h: Of<Y>,
    ) -> Tried<Step<Y, Self::Stages>, O>;

    /// Estimate of a step's error in units of the tolerance, `scale` by component; 1 is just
    /// allowed. `None` where the method has no estimate.
    fn error(&self, step: &Step<Y, Self::Stages>, scale: &Y) -> Option<Of<Y>> {
        let _ = (step, scale);
        None
    }

    /// States within a step. Hermite's cubic through both ends where a method has nothing better.
    ///
    /// # Errors
    /// Where the rates do not exist.
    fn dense<O: Ode<State = Y>>(
        &self,
        ode: &O,
        from: &Start<'_, Y, Self::Stages>,
        step: &Step<Y, Self::Stages>,
    ) -> Tried<Dense<Y>, O> {
        hermite(ode, from.t, from.y, step.h, &step.change)
    }
}

/// Hermite's cubic over a step from `y` by `change`.
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
