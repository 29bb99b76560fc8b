//! The trait of plants: differential equations with modes, events and an energy account.

use core::fmt::Debug;

use bgdyn_runtime::{ContactMap, ImpactLaw, QuasiJoint, RigidContact, StateVector};

use crate::ode::{Jacobian, Ode};
use crate::real::Of;

/// Power that comes from outside and power that is lost, W, by entry.
#[derive(Clone, Debug, PartialEq)]
pub struct Power<E> {
    /// What comes from outside.
    pub supplied: E,
    /// What is lost.
    pub dissipated: E,
}

/// The values of a plant's events, in a fixed order.
pub trait EventValues<T>: Clone + Debug {
    /// Returns the number of events.
    fn count(&self) -> usize;

    /// Returns the value of an event.
    fn value(&self, event: usize) -> T;
}

impl<V: StateVector> EventValues<V::Scalar> for V {
    fn count(&self) -> usize {
        self.entries().len()
    }

    fn value(&self, event: usize) -> V::Scalar {
        self.entries()[event]
    }
}

/// Time, in the scalar of a plant's states.
pub(crate) type Time<P> = Of<<P as Plant>::State>;

/// A plant: between events an equation ẏ = f(t, y) with its modes held, at events a jump.
///
/// A compiled scene is one by way of [`crate::ScenePlant`]; a scene whose sizes are known at run time can
/// be one with `DVector`s.
pub trait Plant {
    /// The states.
    type State: StateVector;
    /// The modes.
    type Modes: Clone + Debug;
    /// One number per event.
    type Values: EventValues<Of<Self::State>>;
    /// One number per entry of the balance of power.
    type Entries: StateVector<Scalar = Of<Self::State>>;
    /// Why there may be no rates: a singular mass matrix.
    type Error: Debug;

    /// ẏ
    ///
    /// # Errors
    /// Where the rates do not exist.
    fn rates(
        &self,
        t: Time<Self>,
        y: &Self::State,
        modes: &Self::Modes,
    ) -> Result<Self::State, Self::Error>;

    /// Slopes of the rates; `None` where they are not known.
    fn jacobian(
        &self,
        t: Time<Self>,
        y: &Self::State,
        modes: &Self::Modes,
    ) -> Option<Result<Jacobian<Self::State>, Self::Error>> {
        let _ = (t, y, modes);
        None
    }

    /// How many components, the first ones, are positions.
    fn positions(&self) -> usize {
        0
    }

    /// The rates of the positions; the other components are not read.
    ///
    /// # Errors
    /// As [`Plant::rates`].
    fn position_rates(
        &self,
        t: Time<Self>,
        y: &Self::State,
        modes: &Self::Modes,
    ) -> Result<Self::State, Self::Error> {
        self.rates(t, y, modes)
    }

    /// The change of the positions in the time `h`, as [`Ode::position_change`].
    ///
    /// # Errors
    /// As [`Plant::rates`].
    fn position_change(
        &self,
        t: Time<Self>,
        y: &Self::State,
        modes: &Self::Modes,
        h: Time<Self>,
    ) -> Result<Self::State, Self::Error> {
        Ok(self.position_rates(t, y, modes)?.times(h))
    }

    /// The joints whose velocities are not the rates of their positions, as [`Ode::quasi_joints`].
    fn quasi_joints(&self) -> Option<&[QuasiJoint]> {
        None
    }

    /// Takes a state back onto the set of possible ones with these modes, as [`Ode::project`].
    ///
    /// # Errors
    /// As [`Ode::project`].
    fn project(
        &self,
        t: Time<Self>,
        y: &mut Self::State,
        modes: &Self::Modes,
    ) -> Result<bool, Self::Error> {
        let _ = (t, y, modes);
        Ok(false)
    }

    /// Takes a state in two words back onto the set of possible ones, as [`Ode::project_in_two`].
    ///
    /// # Errors
    /// As [`Ode::project`].
    fn project_in_two(
        &self,
        t: Time<Self>,
        (y, low): (&mut Self::State, &mut Self::State),
        modes: &Self::Modes,
    ) -> Result<bool, Self::Error> {
        let _ = low;
        self.project(t, y, modes)
    }

    /// Whether a state is off the set of possible ones by more than rounding, as [`Ode::strays`].
    fn strays(&self, y: &Self::State) -> bool {
        let _ = y;
        true
    }

    /// The number of rigid contacts, as [`Ode::rigid_contacts`].
    fn rigid_contacts(&self) -> usize {
        0
    }

    /// The law of restitution at impacts, for [`EventDriven`](crate::EventDriven).
    fn impact_law(&self) -> ImpactLaw {
        ImpactLaw::Newton
    }

    /// The entry of the balance of power to which each rigid contact belongs.
    fn rigid_contact_entry(&self, contact: usize) -> usize {
        contact
    }

    /// The state of each rigid contact, as [`Ode::rigid_contact_states`].
    ///
    /// # Errors
    /// As [`Plant::rates`].
    fn rigid_contact_states(
        &self,
        t: Time<Self>,
        y: &Self::State,
        modes: &Self::Modes,
        contacts: &mut [RigidContact<Time<Self>>],
    ) -> Result<(), Self::Error> {
        let _ = (t, y, modes, contacts);
        Ok(())
    }

    /// How rigid contacts and velocities act on each other, as [`Ode::rigid_contact_maps`].
    ///
    /// # Errors
    /// As [`Plant::rates`].
    fn rigid_contact_maps(
        &self,
        t: Time<Self>,
        y: &Self::State,
        modes: &Self::Modes,
        maps: &mut [Option<ContactMap<Self::State>>],
    ) -> Result<(), Self::Error> {
        let _ = (t, y, modes, maps);
        Ok(())
    }

    /// Writes the accelerations γ̇ of each rigid contact at v̇ = 0, m/s² along (x, y, normal): J̇ v and the motion of what is
    /// prescribed.
    ///
    /// # Errors
    /// As [`Plant::rates`].
    fn rigid_contact_biases(
        &self,
        t: Time<Self>,
        y: &Self::State,
        modes: &Self::Modes,
        biases: &mut [[Time<Self>; 3]],
    ) -> Result<(), Self::Error> {
        let _ = (t, y, modes, biases);
        Ok(())
    }

    /// Values whose passage through zero is an event.
    ///
    /// # Errors
    /// As [`Plant::rates`].
    fn events(
        &self,
        t: Time<Self>,
        y: &Self::State,
        modes: &Self::Modes,
    ) -> Result<Self::Values, Self::Error>;

    /// Whether an event may change a mode: the fall of its value through zero does. Of others the
    /// passage in either direction is a kink of the law.
    fn changes_mode(&self, event: usize) -> bool;

    /// The state and the modes after the events for which `fell` holds.
    ///
    /// # Errors
    /// As [`Plant::rates`].
    fn change(
        &self,
        t: Time<Self>,
        y: &Self::State,
        modes: &Self::Modes,
        fell: impl Fn(usize) -> bool,
    ) -> Result<(Self::State, Self::Modes), Self::Error>;

    /// The energy that entries of the balance of power lose in the jump that led to these modes, J: at impacts.
    fn jump_losses(&self, modes: &Self::Modes) -> impl Iterator<Item = (usize, Time<Self>)> {
        let _ = modes;
        core::iter::empty()
    }

    /// The largest number of events in one call of [`crate::Run::step`], and of events that follow each other within
    /// the rounding of time. More are chattering.
    fn most_events(&self) -> usize {
        64
    }

    /// State and modes that agree with each other, the inputs and the parameters: what moves slips
    /// the way it moves, what is at rest holds where it can. `rest` says up to which part of its
    /// velocity a joint counts as at rest. Nothing where state and modes agree as they are, and for
    /// plants whose modes need no such agreement.
    ///
    /// [`crate::Run`] asks for it at its beginning and after every change from outside.
    ///
    /// # Errors
    /// As [`Plant::rates`].
    #[expect(clippy::type_complexity, reason = "state and modes, where they change")]
    fn resolve_stiction(
        &self,
        t: Time<Self>,
        y: &Self::State,
        modes: &Self::Modes,
        rest: Time<Self>,
    ) -> Result<Option<(Self::State, Self::Modes)>, Self::Error> {
        let _ = (t, y, modes, rest);
        Ok(None)
    }

    /// The first instant after `t`, s, at which an input bends or jumps: a point of a table. [`crate::Run`]
    /// ends a step there and resolves stiction anew. `None` where there is none.
    fn next_corner(&self, t: Time<Self>) -> Option<Time<Self>> {
        let _ = t;
        None
    }

    /// Does what happens at an instant from outside: controllers sample. [`crate::Run`] calls it at its beginning and
    /// at each [`Plant::next_corner`], where its clock is. What it changes acts from this instant on.
    fn reached(&mut self, t: Time<Self>, y: &Self::State, modes: &Self::Modes) {
        let _ = (t, y, modes);
    }

    /// Nothing, for every entry of the balance of power.
    fn nothing(&self) -> Self::Entries;

    /// Energy stored, J, by entry.
    ///
    /// # Errors
    /// As [`Plant::rates`].
    fn energy(
        &self,
        t: Time<Self>,
        y: &Self::State,
        modes: &Self::Modes,
    ) -> Result<Self::Entries, Self::Error>;

    /// Power, W, by entry.
    ///
    /// # Errors
    /// As [`Plant::rates`].
    fn power(
        &self,
        t: Time<Self>,
        y: &Self::State,
        modes: &Self::Modes,
    ) -> Result<Power<Self::Entries>, Self::Error>;
}

/// A plant between two events: the equation with its modes held.
#[derive(Debug)]
pub struct FixedModes<'a, P: Plant> {
    /// The plant.
    pub plant: &'a P,
    /// Its modes.
    pub modes: &'a P::Modes,
}

impl<P: Plant> Ode for FixedModes<'_, P> {
    type State = P::State;
    type Error = P::Error;

    fn rates(&self, t: Time<P>, y: &P::State) -> Result<P::State, P::Error> {
        self.plant.rates(t, y, self.modes)
    }

    fn jacobian(&self, t: Time<P>, y: &P::State) -> Option<Result<Jacobian<P::State>, P::Error>> {
        self.plant.jacobian(t, y, self.modes)
    }

    fn positions(&self) -> usize {
        self.plant.positions()
    }

    fn position_rates(&self, t: Time<P>, y: &P::State) -> Result<P::State, P::Error> {
        self.plant.position_rates(t, y, self.modes)
    }

    fn position_change(&self, t: Time<P>, y: &P::State, h: Time<P>) -> Result<P::State, P::Error> {
        self.plant.position_change(t, y, self.modes, h)
    }

    fn quasi_joints(&self) -> Option<&[QuasiJoint]> {
        self.plant.quasi_joints()
    }

    fn project(&self, t: Time<P>, y: &mut P::State) -> Result<bool, Self::Error> {
        self.plant.project(t, y, self.modes)
    }

    fn project_in_two(
        &self,
        t: Time<P>,
        y: &mut P::State,
        low: &mut P::State,
    ) -> Result<bool, Self::Error> {
        self.plant.project_in_two(t, (y, low), self.modes)
    }

    fn strays(&self, y: &P::State) -> bool {
        self.plant.strays(y)
    }

    fn impact_law(&self) -> ImpactLaw {
        self.plant.impact_law()
    }

    fn rigid_contacts(&self) -> usize {
        self.plant.rigid_contacts()
    }

    fn rigid_contact_states(
        &self,
        t: Time<P>,
        y: &P::State,
        contacts: &mut [RigidContact<Time<P>>],
    ) -> Result<(), P::Error> {
        self.plant.rigid_contact_states(t, y, self.modes, contacts)
    }

    fn rigid_contact_maps(
        &self,
        t: Time<P>,
        y: &P::State,
        maps: &mut [Option<ContactMap<P::State>>],
    ) -> Result<(), P::Error> {
        self.plant.rigid_contact_maps(t, y, self.modes, maps)
    }
}
