//! The trait of ordinary differential equations.

use core::fmt::Debug;

use bgdyn_runtime::StateVector;

use crate::real::Of;

/// The components of an equation's state.
pub type ScalarOf<O> = Of<<O as Ode>::State>;

/// Slopes of the rates.
#[derive(Clone, Debug)]
pub struct Jacobian<Y: StateVector> {
    /// ∂ẏ/∂y
    pub state: Y::Matrix,
    /// ∂ẏ/∂t
    pub time: Y,
}

/// ẏ = f(t, y)
///
/// A state may have more components than degrees of freedom (a unit quaternion has four for three):
/// its rates are then those of the components, along the set of possible states, and
/// [`Ode::project`] takes a state back onto that set. A step leaves it by no more than its own
/// error, so that the projection keeps the order.
pub trait Ode {
    /// The states.
    type State: StateVector;
    /// Why there may be no rates: a singular mass matrix.
    type Error: Debug;

    /// ẏ at time `t`.
    ///
    /// # Errors
    /// Where the rates do not exist.
    fn rates(&self, t: ScalarOf<Self>, y: &Self::State) -> Result<Self::State, Self::Error>;

    /// Slopes of the rates at time `t`; `None` where they are not known.
    fn jacobian(
        &self,
        t: ScalarOf<Self>,
        y: &Self::State,
    ) -> Option<Result<Jacobian<Self::State>, Self::Error>> {
        let _ = (t, y);
        None
    }

    /// How many components, the first ones, are positions: a semi-implicit step moves them by the
    /// velocities at its end.
    fn positions(&self) -> usize {
        0
    }

    /// The rates of the positions; the other components are not read. As [`Ode::rates`], where
    /// nothing cheaper is known.
    ///
    /// # Errors
    /// As [`Ode::rates`].
    fn position_rates(
        &self,
        t: ScalarOf<Self>,
        y: &Self::State,
    ) -> Result<Self::State, Self::Error> {
        self.rates(t, y)
    }

    /// Takes a state back onto the set of possible ones. Whether that changed it.
    fn project(&self, y: &mut Self::State) -> bool {
        let _ = y;
        false
    }
}

impl<O: Ode> Ode for &O {
    type State = O::State;
    type Error = O::Error;

    fn rates(&self, t: ScalarOf<O>, y: &O::State) -> Result<O::State, O::Error> {
        (**self).rates(t, y)
    }

    fn jacobian(
        &self,
        t: ScalarOf<O>,
        y: &O::State,
    ) -> Option<Result<Jacobian<O::State>, O::Error>> {
        (**self).jacobian(t, y)
    }

    fn positions(&self) -> usize {
        (**self).positions()
    }

    fn position_rates(&self, t: ScalarOf<O>, y: &O::State) -> Result<O::State, O::Error> {
        (**self).position_rates(t, y)
    }

    fn project(&self, y: &mut O::State) -> bool {
        (**self).project(y)
    }
}
