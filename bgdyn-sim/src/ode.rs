//! The trait of ordinary differential equations.

use core::fmt::Debug;

use bgdyn_runtime::{ContactMap, ImpactLaw, QuasiJoint, RigidContact, StateVector};

use crate::real::Of;

/// The scalar type of an equation's state.
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
/// A state may have more components than degrees of freedom (a unit quaternion has four for three). Its
/// rates are then those of the components, tangent to the manifold of valid states, and [`Ode::project`]
/// projects a state onto that manifold. A step leaves the manifold by no more than its own error, so the
/// projection preserves the order.
pub trait Ode {
    /// The type of the states.
    type State: StateVector;
    /// The error of missing rates: a singular mass matrix.
    type Error: Debug;

    /// Returns ẏ at time `t`.
    ///
    /// # Errors
    /// If the rates do not exist.
    fn rates(&self, t: ScalarOf<Self>, y: &Self::State) -> Result<Self::State, Self::Error>;

    /// Returns the slopes of the rates at time `t`; `None` if they are not available.
    fn jacobian(
        &self,
        t: ScalarOf<Self>,
        y: &Self::State,
    ) -> Option<Result<Jacobian<Self::State>, Self::Error>> {
        let _ = (t, y);
        None
    }

    /// Returns the number of positions, the first components: a semi-implicit step advances them with the
    /// velocities at its end.
    fn positions(&self) -> usize {
        0
    }

    /// Returns the rates of the positions; the other components are not read. The default is
    /// [`Ode::rates`].
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

    /// Returns the change of the positions in the time `h` at the velocities of `y`; the other components
    /// are not read. The default is h times [`Ode::position_rates`]; where velocities are constant in axes
    /// that rotate, it is the exact motion.
    ///
    /// # Errors
    /// As [`Ode::rates`].
    fn position_change(
        &self,
        t: ScalarOf<Self>,
        y: &Self::State,
        h: ScalarOf<Self>,
    ) -> Result<Self::State, Self::Error> {
        Ok(self.position_rates(t, y)?.times(h))
    }

    /// Returns the joints whose velocities are not the rates of their positions; those of all others are. `None`, the default,
    /// if the positions have other rates.
    fn quasi_joints(&self) -> Option<&[QuasiJoint]> {
        None
    }

    /// Projects a state at time `t` onto the manifold of valid states. Returns whether that changed it.
    ///
    /// # Errors
    /// If there is no valid state nearby: a loop does not close.
    fn project(&self, t: ScalarOf<Self>, y: &mut Self::State) -> Result<bool, Self::Error> {
        let _ = (t, y);
        Ok(false)
    }

    /// Projects a state in two words, y + low unevaluated. The default projects the first word. Returns
    /// whether that changed it.
    ///
    /// # Errors
    /// As [`Ode::project`].
    fn project_in_two(
        &self,
        t: ScalarOf<Self>,
        y: &mut Self::State,
        low: &mut Self::State,
    ) -> Result<bool, Self::Error> {
        let _ = low;
        self.project(t, y)
    }

    /// Returns whether a state is off the manifold by more than the rounding errors of many steps. Only then
    /// the states of integrators that remain on it ([`crate::Integrator::keeps_lengths`]) are projected.
    fn strays(&self, y: &Self::State) -> bool {
        let _ = y;
        true
    }

    /// Returns the number of rigid contacts, at most [`MOST_CONTACTS`](bgdyn_runtime::MOST_CONTACTS). The rates do not know
    /// them: only integrators that solve for their impulses ([`crate::Integrator::solves_contacts`]) accept equations with some.
    fn rigid_contacts(&self) -> usize {
        0
    }

    /// Returns the law of restitution at impacts. Integrators that solve for impulses know Newton's.
    fn impact_law(&self) -> ImpactLaw {
        ImpactLaw::Newton
    }

    /// Writes the state of each rigid contact.
    ///
    /// # Errors
    /// As [`Ode::rates`].
    fn rigid_contact_states(
        &self,
        t: ScalarOf<Self>,
        y: &Self::State,
        contacts: &mut [RigidContact<ScalarOf<Self>>],
    ) -> Result<(), Self::Error> {
        let _ = (t, y, contacts);
        Ok(())
    }

    /// Writes how each rigid contact and the velocities act on each other.
    ///
    /// # Errors
    /// As [`Ode::rates`].
    fn rigid_contact_maps(
        &self,
        t: ScalarOf<Self>,
        y: &Self::State,
        maps: &mut [Option<ContactMap<Self::State>>],
    ) -> Result<(), Self::Error> {
        let _ = (t, y, maps);
        Ok(())
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

    fn position_change(
        &self,
        t: ScalarOf<O>,
        y: &O::State,
        h: ScalarOf<O>,
    ) -> Result<O::State, O::Error> {
        (**self).position_change(t, y, h)
    }

    fn quasi_joints(&self) -> Option<&[QuasiJoint]> {
        (**self).quasi_joints()
    }

    fn project(&self, t: ScalarOf<O>, y: &mut O::State) -> Result<bool, Self::Error> {
        (**self).project(t, y)
    }

    fn project_in_two(
        &self,
        t: ScalarOf<O>,
        y: &mut O::State,
        low: &mut O::State,
    ) -> Result<bool, Self::Error> {
        (**self).project_in_two(t, y, low)
    }

    fn strays(&self, y: &O::State) -> bool {
        (**self).strays(y)
    }

    fn rigid_contacts(&self) -> usize {
        (**self).rigid_contacts()
    }

    fn impact_law(&self) -> ImpactLaw {
        (**self).impact_law()
    }

    fn rigid_contact_states(
        &self,
        t: ScalarOf<O>,
        y: &O::State,
        contacts: &mut [RigidContact<ScalarOf<O>>],
    ) -> Result<(), O::Error> {
        (**self).rigid_contact_states(t, y, contacts)
    }

    fn rigid_contact_maps(
        &self,
        t: ScalarOf<O>,
        y: &O::State,
        maps: &mut [Option<ContactMap<O::State>>],
    ) -> Result<(), O::Error> {
        (**self).rigid_contact_maps(t, y, maps)
    }
}
