//! Plants behind a pointer (trait objects), so that one copy of an integrator serves all scenes of equal dimensions.
//!
//! The rates are compiled code; the indirect call takes a nanosecond more.

use std::rc::Rc;

use bgdyn_runtime::{ContactMap, FixedVector, ImpactLaw, QuasiJoint, RigidContact};
use bgdyn_sim::{Jacobian, Of, Plant, Power, StateVector};
use nalgebra::SVector;

use crate::integrate::Measured;

/// The functions that integrators call of a plant with states `Y`, modes `M` and events `E`, without
/// associated types.
pub(crate) trait PlantObject<Y: StateVector, M, E> {
    fn rates(&self, t: Of<Y>, y: &Y, modes: &M) -> Result<Y, String>;
    fn jacobian(&self, t: Of<Y>, y: &Y, modes: &M) -> Option<Result<Jacobian<Y>, String>>;
    fn positions(&self) -> usize;
    fn position_rates(&self, t: Of<Y>, y: &Y, modes: &M) -> Result<Y, String>;
    fn position_change(&self, t: Of<Y>, y: &Y, modes: &M, h: Of<Y>) -> Result<Y, String>;
    fn quasi_joints(&self) -> Option<&[QuasiJoint]>;
    fn project(&self, t: Of<Y>, y: &mut Y, modes: &M) -> Result<bool, String>;
    fn project_in_two(&self, t: Of<Y>, y: (&mut Y, &mut Y), modes: &M) -> Result<bool, String>;
    fn strays(&self, y: &Y) -> bool;
    fn events(&self, t: Of<Y>, y: &Y, modes: &M) -> Result<E, String>;
    fn changes_mode(&self, event: usize) -> bool;
    fn change(
        &self,
        t: Of<Y>,
        y: &Y,
        modes: &M,
        fell: &dyn Fn(usize) -> bool,
    ) -> Result<(Y, M), String>;
    fn resolve_stiction(
        &self,
        t: Of<Y>,
        y: &Y,
        modes: &M,
        rest: Of<Y>,
    ) -> Result<Option<(Y, M)>, String>;
    fn next_corner(&self, t: Of<Y>) -> Option<Of<Y>>;
    fn rigid_contacts(&self) -> usize;
    fn impact_law(&self) -> ImpactLaw;
    fn rigid_contact_states(
        &self,
        t: Of<Y>,
        y: &Y,
        modes: &M,
        contacts: &mut [RigidContact<Of<Y>>],
    ) -> Result<(), String>;
    fn rigid_contact_maps(
        &self,
        t: Of<Y>,
        y: &Y,
        modes: &M,
        maps: &mut [Option<ContactMap<Y>>],
    ) -> Result<(), String>;
    fn rigid_contact_biases(
        &self,
        t: Of<Y>,
        y: &Y,
        modes: &M,
        biases: &mut [[Of<Y>; 3]],
    ) -> Result<(), String>;
    fn measured(&self, t: Of<Y>, y: &Y, modes: &M) -> Vec<Of<Y>>;
}

/// Converts an error of the rates to the name in it, in quotes.
fn with_text_error<X, E: std::fmt::Debug>(result: Result<X, E>) -> Result<X, String> {
    result.map_err(|e| {
        let text = format!("{e:?}");
        let named = text.split('"').nth(1).map(str::to_owned);
        named.unwrap_or(text)
    })
}

impl<P: Measured> PlantObject<P::State, P::Modes, P::Values> for P {
    fn rates(&self, t: Of<P::State>, y: &P::State, modes: &P::Modes) -> Result<P::State, String> {
        with_text_error(Plant::rates(self, t, y, modes))
    }

    fn jacobian(
        &self,
        t: Of<P::State>,
        y: &P::State,
        modes: &P::Modes,
    ) -> Option<Result<Jacobian<P::State>, String>> {
        Plant::jacobian(self, t, y, modes).map(with_text_error)
    }

    fn positions(&self) -> usize {
        Plant::positions(self)
    }

    fn position_rates(
        &self,
        t: Of<P::State>,
        y: &P::State,
        modes: &P::Modes,
    ) -> Result<P::State, String> {
        with_text_error(Plant::position_rates(self, t, y, modes))
    }

    fn position_change(
        &self,
        t: Of<P::State>,
        y: &P::State,
        modes: &P::Modes,
        h: Of<P::State>,
    ) -> Result<P::State, String> {
        with_text_error(Plant::position_change(self, t, y, modes, h))
    }

    fn quasi_joints(&self) -> Option<&[QuasiJoint]> {
        Plant::quasi_joints(self)
    }

    fn project(&self, t: Of<P::State>, y: &mut P::State, modes: &P::Modes) -> Result<bool, String> {
        with_text_error(Plant::project(self, t, y, modes))
    }

    fn project_in_two(
        &self,
        t: Of<P::State>,
        y: (&mut P::State, &mut P::State),
        modes: &P::Modes,
    ) -> Result<bool, String> {
        with_text_error(Plant::project_in_two(self, t, y, modes))
    }

    fn strays(&self, y: &P::State) -> bool {
        Plant::strays(self, y)
    }

    fn events(&self, t: Of<P::State>, y: &P::State, modes: &P::Modes) -> Result<P::Values, String> {
        with_text_error(Plant::events(self, t, y, modes))
    }

    fn changes_mode(&self, event: usize) -> bool {
        Plant::changes_mode(self, event)
    }

    fn change(
        &self,
        t: Of<P::State>,
        y: &P::State,
        modes: &P::Modes,
        fell: &dyn Fn(usize) -> bool,
    ) -> Result<(P::State, P::Modes), String> {
        with_text_error(Plant::change(self, t, y, modes, fell))
    }

    fn resolve_stiction(
        &self,
        t: Of<P::State>,
        y: &P::State,
        modes: &P::Modes,
        rest: Of<P::State>,
    ) -> Result<Option<(P::State, P::Modes)>, String> {
        with_text_error(Plant::resolve_stiction(self, t, y, modes, rest))
    }

    fn next_corner(&self, t: Of<P::State>) -> Option<Of<P::State>> {
        Plant::next_corner(self, t)
    }

    fn rigid_contacts(&self) -> usize {
        Plant::rigid_contacts(self)
    }

    fn impact_law(&self) -> ImpactLaw {
        Plant::impact_law(self)
    }

    fn rigid_contact_states(
        &self,
        t: Of<P::State>,
        y: &P::State,
        modes: &P::Modes,
        contacts: &mut [RigidContact<Of<P::State>>],
    ) -> Result<(), String> {
        with_text_error(Plant::rigid_contact_states(self, t, y, modes, contacts))
    }

    fn rigid_contact_maps(
        &self,
        t: Of<P::State>,
        y: &P::State,
        modes: &P::Modes,
        maps: &mut [Option<ContactMap<P::State>>],
    ) -> Result<(), String> {
        with_text_error(Plant::rigid_contact_maps(self, t, y, modes, maps))
    }

    fn rigid_contact_biases(
        &self,
        t: Of<P::State>,
        y: &P::State,
        modes: &P::Modes,
        biases: &mut [[Of<P::State>; 3]],
    ) -> Result<(), String> {
        with_text_error(Plant::rigid_contact_biases(self, t, y, modes, biases))
    }

    fn measured(&self, t: Of<P::State>, y: &P::State, modes: &P::Modes) -> Vec<Of<P::State>> {
        Measured::measured(self, t, y, modes)
    }
}

/// A plant behind a pointer.
pub(crate) struct DynPlant<Y, M, E>(pub Rc<dyn PlantObject<Y, M, E>>);

impl<Y, M, E> Clone for DynPlant<Y, M, E> {
    fn clone(&self) -> Self {
        DynPlant(Rc::clone(&self.0))
    }
}

impl<Y, M, E> Plant for DynPlant<Y, M, E>
where
    Y: FixedVector,
    M: FixedVector,
    E: FixedVector<Scalar = Of<Y>>,
{
    type State = Y;
    type Modes = M;
    type Values = E;
    // Runs have no energy account here.
    type Entries = SVector<Of<Y>, 0>;
    type Error = String;

    fn rates(&self, t: Of<Y>, y: &Y, modes: &M) -> Result<Y, String> {
        self.0.rates(t, y, modes)
    }

    fn jacobian(&self, t: Of<Y>, y: &Y, modes: &M) -> Option<Result<Jacobian<Y>, String>> {
        self.0.jacobian(t, y, modes)
    }

    fn positions(&self) -> usize {
        self.0.positions()
    }

    fn position_rates(&self, t: Of<Y>, y: &Y, modes: &M) -> Result<Y, String> {
        self.0.position_rates(t, y, modes)
    }

    fn position_change(&self, t: Of<Y>, y: &Y, modes: &M, h: Of<Y>) -> Result<Y, String> {
        self.0.position_change(t, y, modes, h)
    }

    fn quasi_joints(&self) -> Option<&[QuasiJoint]> {
        self.0.quasi_joints()
    }

    fn project(&self, t: Of<Y>, y: &mut Y, modes: &M) -> Result<bool, String> {
        self.0.project(t, y, modes)
    }

    fn project_in_two(&self, t: Of<Y>, y: (&mut Y, &mut Y), modes: &M) -> Result<bool, String> {
        self.0.project_in_two(t, y, modes)
    }

    fn strays(&self, y: &Y) -> bool {
        self.0.strays(y)
    }

    fn events(&self, t: Of<Y>, y: &Y, modes: &M) -> Result<E, String> {
        // A scene without events is not evaluated.
        match E::LEN {
            0 => Ok(E::zero_vector()),
            _ => self.0.events(t, y, modes),
        }
    }

    fn changes_mode(&self, event: usize) -> bool {
        self.0.changes_mode(event)
    }

    fn change(
        &self,
        t: Of<Y>,
        y: &Y,
        modes: &M,
        fell: impl Fn(usize) -> bool,
    ) -> Result<(Y, M), String> {
        self.0.change(t, y, modes, &fell)
    }

    fn resolve_stiction(
        &self,
        t: Of<Y>,
        y: &Y,
        modes: &M,
        rest: Of<Y>,
    ) -> Result<Option<(Y, M)>, String> {
        self.0.resolve_stiction(t, y, modes, rest)
    }

    fn next_corner(&self, t: Of<Y>) -> Option<Of<Y>> {
        self.0.next_corner(t)
    }

    fn rigid_contacts(&self) -> usize {
        self.0.rigid_contacts()
    }

    fn impact_law(&self) -> ImpactLaw {
        self.0.impact_law()
    }

    fn rigid_contact_states(
        &self,
        t: Of<Y>,
        y: &Y,
        modes: &M,
        contacts: &mut [RigidContact<Of<Y>>],
    ) -> Result<(), String> {
        self.0.rigid_contact_states(t, y, modes, contacts)
    }

    fn rigid_contact_maps(
        &self,
        t: Of<Y>,
        y: &Y,
        modes: &M,
        maps: &mut [Option<ContactMap<Y>>],
    ) -> Result<(), String> {
        self.0.rigid_contact_maps(t, y, modes, maps)
    }

    fn rigid_contact_biases(
        &self,
        t: Of<Y>,
        y: &Y,
        modes: &M,
        biases: &mut [[Of<Y>; 3]],
    ) -> Result<(), String> {
        self.0.rigid_contact_biases(t, y, modes, biases)
    }

    fn nothing(&self) -> Self::Entries {
        FixedVector::zero_vector()
    }

    fn energy(&self, _: Of<Y>, _: &Y, _: &M) -> Result<Self::Entries, String> {
        Ok(self.nothing())
    }

    fn power(&self, _: Of<Y>, _: &Y, _: &M) -> Result<Power<Self::Entries>, String> {
        Ok(Power {
            supplied: self.nothing(),
            dissipated: self.nothing(),
        })
    }
}

impl<Y, M, E> Measured for DynPlant<Y, M, E>
where
    Y: FixedVector,
    M: FixedVector,
    E: FixedVector<Scalar = Of<Y>>,
{
    fn measured(&self, t: Of<Y>, y: &Y, modes: &M) -> Vec<Of<Y>> {
        self.0.measured(t, y, modes)
    }
}
