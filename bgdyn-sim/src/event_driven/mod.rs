//! Rigid contacts from event to event: between two events each contact is open, sticks or slips.

mod impact;
mod jump;
mod modes;
mod poisson;
mod projection;
mod settle;
mod snapshot;
mod system;

use core::fmt::Debug;

use bgdyn_runtime::{HybridSystem, MOST_EVENT_CONTACTS, Scalar as _, StateVector};

pub use self::impact::ImpactLaw;
pub use self::modes::{ContactMode, ContactModes, Jump};

use self::jump::{Cause, Next};
use self::snapshot::{PerContact, Snapshot, contacts_at};
use crate::finite_differences::differences;
use crate::integrator::Integrator;
use crate::ode::Jacobian;
use crate::plant::{EventValues, FixedModes, Plant, Power, Time};
use crate::real::Real;
use crate::run::{HybridState, Run};
use crate::scene_plant::ScenePlant;

/// A plant whose rigid contacts are solved from event to event, with any integrator: at most 8
/// ([`MOST_EVENT_CONTACTS`]).
///
/// Between events each contact has a [`ContactMode`], and the forces λ of all are those of the linear equations γ̇_n = 0 where a
/// contact is closed, γ̇_t = 0 where it sticks and λ_t = −μ λ_n γ_t/|γ_t| where it slips; of redundant contacts those of least
/// norm. Then the plant is smooth, and runs have the order of their integrator. Events are: a gap falls to 0; λ_n falls to 0;
/// |λ_t| reaches μ λ_n; a slip ends. At each event the modes of all touching contacts are found at once, from Coulomb's cones
/// for accelerations (Glocker 2001; Acary and Brogliato 2008, chapter 8).
///
/// Impacts are jumps by impulses of all contacts that touch, by an [`ImpactLaw`]. A series of impacts that would end within
/// 1e-2 √ε s (1.5e-10 s in `f64`) is over at once, and the contact is closed. What impacts and friction take is in the balance of energy. Positions
/// and velocities of closed contacts are put right at the end of a step, in the metric of M.
///
/// ```
/// use bgdyn_sim::{Dop853, EventDriven, Tolerance};
///
/// bgdyn::bgdyn!("../specs/contact/hopper_hops.scene.yaml");
///
/// let scene = hopper_hops::HopperHops::<f64>::default();
/// let mut run = EventDriven::run(&scene, Dop853).with_tolerance(Tolerance { absolute: 1e-10, relative: 1e-10 });
/// run.step(0.5).expect("it hops");
/// assert!(run.audit().drift().abs() < 1e-8);
/// ```
#[derive(Clone, Debug)]
pub struct EventDriven<P> {
    /// The plant with its contacts.
    pub plant: P,
    /// The law of restitution.
    pub law: ImpactLaw,
}

/// Why there are no rates or modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EventError<E> {
    /// The plant has none.
    Plant(E),
    /// Painlevé's paradox: a contact slips, and no finite force keeps it from overlapping. Only an impulse does, which
    /// [`crate::Moreau`] finds.
    Paradox {
        /// The contact, in the order of the plant's.
        contact: usize,
    },
    /// No modes fulfil all inequalities to rounding.
    NoModes,
    /// There are more contacts than this solver takes.
    TooManyContacts {
        /// The number of contacts.
        number: usize,
    },
}

impl<E: core::fmt::Debug> core::fmt::Display for EventError<E> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Plant(error) => write!(f, "{error:?}"),
            Self::Paradox { contact } => write!(
                f,
                "contact {contact} slips, and no finite force keeps it from overlapping (Painlevé's paradox); `moreau` finds an impulse"
            ),
            Self::NoModes => f.write_str(
                "no choice of open, sticking and slipping contacts fulfils all conditions; `moreau` may go on",
            ),
            Self::TooManyContacts { number } => write!(
                f,
                "{number} rigid contacts are more than the {MOST_EVENT_CONTACTS} that are solved from event to event; `moreau` takes more"
            ),
        }
    }
}

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
    /// Returns a run of a scene from its start, by an integrator, with Newton's law of restitution.
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

/// A state, modes and errors of a plant with contacts.
type ModesOf<P> = ContactModes<<P as Plant>::Modes, Time<P>>;
type ErrorOf<P> = EventError<<P as Plant>::Error>;

impl<P: Plant> EventDriven<P>
where
    Time<P>: Real,
{
    /// Returns the plant with Newton's law of restitution.
    pub fn new(plant: P) -> Self {
        let law = ImpactLaw::default();
        EventDriven { plant, law }
    }

    /// Returns the forces of the contacts, N along (x, y, normal) of each.
    ///
    /// # Errors
    /// If there are none.
    pub fn forces(
        &self,
        t: Time<P>,
        y: &P::State,
        modes: &ModesOf<P>,
    ) -> Result<[[Time<P>; 3]; MOST_EVENT_CONTACTS], ErrorOf<P>> {
        if !closes(modes) {
            return Ok([[Time::<P>::from_f64(0.0); 3]; MOST_EVENT_CONTACTS]);
        }
        let rates = self.plant.rates(t, y, &modes.plant);
        let snapshot = Snapshot::new(&self.plant, t, y, &modes.plant)?;
        self.forces_at(t, y, modes, (&snapshot, &rates.map_err(EventError::Plant)?))
    }

    /// Returns the forces with what is known of the state: its contacts and the rates without forces.
    fn forces_at(
        &self,
        t: Time<P>,
        y: &P::State,
        modes: &ModesOf<P>,
        (snapshot, rates): (&Snapshot<P::State>, &P::State),
    ) -> Result<PerContact<[Time<P>; 3]>, ErrorOf<P>> {
        let accelerations = self.accelerations(t, y, &modes.plant, (snapshot, rates))?;
        snapshot
            .forces(&modes.contacts, &accelerations)
            .map_err(|contact| EventError::Paradox { contact })
    }

    /// Returns the accelerations of the contacts with the given rates: γ̇ = J v̇ + J̇ v.
    fn accelerations(
        &self,
        t: Time<P>,
        y: &P::State,
        modes: &P::Modes,
        (snapshot, rates): (&Snapshot<P::State>, &P::State),
    ) -> Result<PerContact<[Time<P>; 3]>, ErrorOf<P>> {
        let mut all = [[Time::<P>::from_f64(0.0); 3]; MOST_EVENT_CONTACTS];
        self.plant
            .rigid_contact_biases(t, y, modes, &mut all[..snapshot.number])
            .map_err(EventError::Plant)?;
        for (c, bias) in all.iter_mut().enumerate().take(snapshot.number) {
            for (sum, part) in bias.iter_mut().zip(snapshot.along(c, rates)) {
                *sum = *sum + part;
            }
        }
        Ok(all)
    }
}

/// Returns whether a contact is closed.
fn closes<M, T: Real>(modes: &ContactModes<M, T>) -> bool {
    modes.contacts.iter().any(|mode| mode.is_closed())
}

/// Returns the gap, m, below which surfaces touch: what rounding of the positions leaves.
fn touching<P: Plant>(plant: &P, y: &P::State) -> Time<P>
where
    Time<P>: Real,
{
    let one = Time::<P>::from_f64(1.0);
    let positions = &y.entries()[..plant.positions()];
    let size = positions.iter().fold(one, |most, x| most.max(x.abs()));
    Time::<P>::EPSILON * Time::<P>::from_f64(64.0) * size
}

impl<P: Plant> Plant for EventDriven<P>
where
    Time<P>: Real,
{
    type State = P::State;
    type Modes = ModesOf<P>;
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
        let contacts = contacts_at(&self.plant, t, y, &modes.plant)?;
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
            let contacts = contacts_at(&self.plant, t, y, &modes.plant)?;
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
