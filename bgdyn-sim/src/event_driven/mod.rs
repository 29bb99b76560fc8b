//! Rigid contacts from event to event: between two events each contact is open, sticks or slips.

mod equations;
mod error;
mod impact;
mod impulses;
mod jump;
mod modes;
mod poisson;
mod projection;
mod settle;
mod snapshot;
mod system;

pub use bgdyn_runtime::ImpactLaw;
use bgdyn_runtime::{HybridSystem, MOST_EVENT_CONTACTS, StateVector};

pub use self::equations::EventDriven;
pub use self::error::EventError;
pub use self::modes::{ContactMode, ContactModes, Jump};

use self::equations::{ErrorOf, PlantModes, closes};
use self::jump::{Cause, Next};
use self::modes::PerContact;
use self::snapshot::{Snapshot, contacts_of};
use crate::finite_differences::differences;
use crate::integrator::Integrator;
use crate::ode::Jacobian;
use crate::plant::{EventValues, FixedModes, Plant, Power, Time};
use crate::real::Real;
use crate::run::{HybridState, Run};
use crate::scene_plant::ScenePlant;

/// The values of events: two of each contact, then those of the plant.
#[derive(Clone, Debug)]
pub struct ContactEvents<V, T> {
    of_plant: V,
    number: usize,
    of_contacts: PerContact<[T; 2]>,
}

impl<V: EventValues<T>, T: Real> EventValues<T> for ContactEvents<V, T> {
    fn count(&self) -> usize {
        self.of_plant.count() + 2 * self.number
    }

    fn value(&self, event: usize) -> T {
        match event.checked_sub(2 * self.number) {
            None => self.of_contacts[event / 2][event % 2],
            Some(event) => self.of_plant.value(event),
        }
    }
}

impl<'a, S: HybridSystem<T>, T: Real> EventDriven<ScenePlant<'a, S, T>> {
    /// Returns a run of a scene from its start, by an integrator, with the scene's law of restitution.
    pub fn run<M: Integrator<S::State>>(scene: &'a S, integrator: M) -> Run<Self, M> {
        let HybridState { t, y, modes } = Run::begin(scene);
        let modes = ContactModes::open(modes);
        Run::by(
            integrator,
            EventDriven::new(ScenePlant::new(scene)),
            HybridState { t, y, modes },
        )
    }
}

impl<P: Plant> Plant for EventDriven<P>
where
    Time<P>: Real,
{
    type State = P::State;
    type Modes = PlantModes<P>;
    type Values = ContactEvents<P::Values, Time<P>>;
    type Entries = P::Entries;
    type Error = ErrorOf<P>;

    fn rates(
        &self,
        t: Time<P>,
        y: &P::State,
        modes: &Self::Modes,
    ) -> Result<P::State, Self::Error> {
        let rates = self.plant.rates(t, y, &modes.plant);
        let mut rates = rates.map_err(EventError::Plant)?;
        if closes(modes) {
            let snapshot = Snapshot::new(&self.plant, t, y, &modes.plant)?;
            let forces = self.forces_at(t, y, modes, (&snapshot, &rates))?;
            snapshot.push(&mut rates, &forces);
        }
        Ok(rates)
    }

    /// Those of the plant; with closed contacts finite differences of the rates.
    fn jacobian(
        &self,
        t: Time<P>,
        y: &P::State,
        modes: &Self::Modes,
    ) -> Option<Result<Jacobian<P::State>, Self::Error>> {
        if closes(modes) {
            let plant = self;
            return Some(differences(&FixedModes { plant, modes }, t, y));
        }
        let own = self.plant.jacobian(t, y, &modes.plant)?;
        Some(own.map_err(EventError::Plant))
    }

    fn positions(&self) -> usize {
        self.plant.positions()
    }

    fn position_rates(
        &self,
        t: Time<P>,
        y: &P::State,
        modes: &Self::Modes,
    ) -> Result<P::State, Self::Error> {
        let rates = self.plant.position_rates(t, y, &modes.plant);
        rates.map_err(EventError::Plant)
    }

    fn position_change(
        &self,
        t: Time<P>,
        y: &P::State,
        modes: &Self::Modes,
        h: Time<P>,
    ) -> Result<P::State, Self::Error> {
        let change = self.plant.position_change(t, y, &modes.plant, h);
        change.map_err(EventError::Plant)
    }

    fn project(
        &self,
        t: Time<P>,
        y: &mut P::State,
        modes: &Self::Modes,
    ) -> Result<bool, Self::Error> {
        let own = self.plant.project(t, y, &modes.plant);
        let own = own.map_err(EventError::Plant)?;
        Ok(closes(modes) && self.close(t, y, modes, Time::<P>::EPSILON)? || own)
    }

    fn project_in_two(
        &self,
        t: Time<P>,
        (y, low): (&mut P::State, &mut P::State),
        modes: &Self::Modes,
    ) -> Result<bool, Self::Error> {
        let own = self.plant.project_in_two(t, (y, low), &modes.plant);
        let own = own.map_err(EventError::Plant)?;
        Ok(closes(modes) && self.close(t, y, modes, Time::<P>::EPSILON)? || own)
    }

    /// Always, as closed contacts may drift.
    fn strays(&self, _: &P::State) -> bool {
        true
    }

    /// Of an open contact the gap and 1; of a closed one λ_n, and what the friction may grow by or the slip may fall by.
    fn events(
        &self,
        t: Time<P>,
        y: &P::State,
        modes: &Self::Modes,
    ) -> Result<Self::Values, Self::Error> {
        let of_plant = self.plant.events(t, y, &modes.plant);
        let contacts = contacts_of(&self.plant, t, y, &modes.plant)?;
        let forces = self.forces(t, y, modes)?;
        let of_contacts = core::array::from_fn(|c| {
            let (contact, force) = (contacts[c], forces[c]);
            let mode = modes.contacts[c];
            let first = match mode {
                ContactMode::Open => modes.closing[c].value(t, contact.gap),
                _ => force[2],
            };
            [first, mode.ends(contact.friction, force, contact.velocity)]
        });
        Ok(ContactEvents {
            of_plant: of_plant.map_err(EventError::Plant)?,
            number: self.plant.rigid_contacts(),
            of_contacts,
        })
    }

    fn changes_mode(&self, event: usize) -> bool {
        let of_plant = event.checked_sub(2 * self.plant.rigid_contacts());
        of_plant.is_none_or(|event| self.plant.changes_mode(event))
    }

    fn change(
        &self,
        t: Time<P>,
        y: &P::State,
        modes: &Self::Modes,
        fell: impl Fn(usize) -> bool,
    ) -> Result<(P::State, Self::Modes), Self::Error> {
        let first = 2 * self.plant.rigid_contacts();
        let changed = self
            .plant
            .change(t, y, &modes.plant, |event| fell(first + event));
        let (y, plant) = changed.map_err(EventError::Plant)?;
        let next = Next::new(self, t, &y, modes).with_modes(plant);
        next.after(&Cause::Events(&|c, which| fell(2 * c + which)))
    }

    fn jump_losses(&self, modes: &Self::Modes) -> impl Iterator<Item = (usize, Time<P>)> {
        let losses = modes.jump.losses;
        let own = (0..self.plant.rigid_contacts().min(MOST_EVENT_CONTACTS))
            .map(move |c| (self.plant.rigid_contact_entry(c), losses[c]));
        own.chain(self.plant.jump_losses(&modes.plant))
    }

    /// Impacts that follow each other faster and faster end by themselves.
    fn most_events(&self) -> usize {
        10_000
    }

    fn resolve_stiction(
        &self,
        t: Time<P>,
        y: &P::State,
        modes: &Self::Modes,
        rest: Time<P>,
    ) -> Result<Option<(P::State, Self::Modes)>, Self::Error> {
        let resolved = self.plant.resolve_stiction(t, y, &modes.plant, rest);
        let resolved = resolved.map_err(EventError::Plant)?;
        let next = match &resolved {
            Some((y, plant)) => Next::new(self, t, y, modes).with_modes(plant.clone()),
            None => Next::new(self, t, y, modes),
        };
        let (after, found) = next.after(&Cause::Outside)?;
        // Rounding and the direction of a slip are no changes.
        let kinds =
            |all: &PerContact<ContactMode<_>>| all.map(|mode| core::mem::discriminant(&mode));
        let same = resolved.is_none()
            && kinds(&found.contacts) == kinds(&modes.contacts)
            && found.jump == Jump::none();
        Ok((!same).then_some((after, found)))
    }

    fn next_corner(&self, t: Time<P>) -> Option<Time<P>> {
        self.plant.next_corner(t)
    }

    fn reached(&mut self, t: Time<P>, y: &P::State, modes: &Self::Modes) {
        self.plant.reached(t, y, &modes.plant);
    }

    fn nothing(&self) -> P::Entries {
        self.plant.nothing()
    }

    fn energy(
        &self,
        t: Time<P>,
        y: &P::State,
        modes: &Self::Modes,
    ) -> Result<P::Entries, Self::Error> {
        let energy = self.plant.energy(t, y, &modes.plant);
        energy.map_err(EventError::Plant)
    }

    /// That of the plant, and what friction takes: −λ·γ.
    fn power(
        &self,
        t: Time<P>,
        y: &P::State,
        modes: &Self::Modes,
    ) -> Result<Power<P::Entries>, Self::Error> {
        let power = self.plant.power(t, y, &modes.plant);
        let mut power = power.map_err(EventError::Plant)?;
        if closes(modes) {
            let contacts = contacts_of(&self.plant, t, y, &modes.plant)?;
            let forces = self.forces(t, y, modes)?;
            for c in 0..self.plant.rigid_contacts() {
                let entry = self.plant.rigid_contact_entry(c);
                let lost = &mut power.dissipated.entries_mut()[entry];
                for (&force, v) in forces[c].iter().zip(contacts[c].velocity) {
                    *lost = *lost - force * v;
                }
            }
        }
        Ok(power)
    }
}
