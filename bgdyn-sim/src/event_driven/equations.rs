//! The equation of a plant with its contacts in their modes: forces and accelerations.

use bgdyn_runtime::{ImpactLaw, MOST_EVENT_CONTACTS, Scalar as _, StateVector};

use super::error::EventError;
use super::modes::{ContactModes, PerContact};
use super::snapshot::Snapshot;
use crate::plant::{Plant, Time};
use crate::real::Real;

/// A plant whose rigid contacts are solved from event to event, with any integrator: at most 8
/// ([`MOST_EVENT_CONTACTS`]).
///
/// Between events each contact has a [`ContactMode`](super::ContactMode), and the forces λ of all are those of the linear
/// equations γ̇_n = 0 where a contact is closed, γ̇_t = 0 where it sticks and λ_t = −μ λ_n γ_t/|γ_t| where it slips; of
/// redundant contacts those of least norm. Then the plant is smooth, and runs have the order of their integrator. Events are:
/// a gap falls to 0; λ_n falls to 0; |λ_t| reaches μ λ_n; a slip ends. At each event the modes of all touching contacts are
/// found at once, from Coulomb's cones for accelerations (Glocker 2001; Acary and Brogliato 2008, chapter 8).
///
/// Impacts are jumps by impulses of all contacts that touch, by an [`ImpactLaw`]. A series of impacts that would end within
/// 1e-2 √ε s (1.5e-10 s in `f64`) is over at once, and the contact is closed. What impacts and friction take is in the balance
/// of energy. Positions and velocities of closed contacts are put right at the end of a step, in the metric of M.
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

/// The modes of a plant with its contacts.
pub(super) type PlantModes<P> = ContactModes<<P as Plant>::Modes, Time<P>>;
/// The errors of a plant with its contacts.
pub(super) type ErrorOf<P> = EventError<<P as Plant>::Error>;

impl<P: Plant> EventDriven<P>
where
    Time<P>: Real,
{
    /// Returns the plant with its law of restitution ([`Plant::impact_law`]).
    pub fn new(plant: P) -> Self {
        let law = plant.impact_law();
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
        modes: &PlantModes<P>,
    ) -> Result<[[Time<P>; 3]; MOST_EVENT_CONTACTS], ErrorOf<P>> {
        if !closes(modes) {
            return Ok([[Time::<P>::from_f64(0.0); 3]; MOST_EVENT_CONTACTS]);
        }
        let rates = self.plant.rates(t, y, &modes.plant);
        let snapshot = Snapshot::new(&self.plant, t, y, &modes.plant)?;
        self.forces_at(t, y, modes, (&snapshot, &rates.map_err(EventError::Plant)?))
    }

    /// Returns the forces with what is known of the state: its contacts and the rates without forces.
    pub(super) fn forces_at(
        &self,
        t: Time<P>,
        y: &P::State,
        modes: &PlantModes<P>,
        (snapshot, rates): (&Snapshot<P::State>, &P::State),
    ) -> Result<PerContact<[Time<P>; 3]>, ErrorOf<P>> {
        let accelerations = self.accelerations(t, y, &modes.plant, (snapshot, rates))?;
        snapshot
            .forces(&modes.contacts, &accelerations)
            .map_err(|contact| EventError::Paradox { contact })
    }

    /// Returns the accelerations of the contacts with the given rates: γ̇ = J v̇ + J̇ v.
    pub(super) fn accelerations(
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
pub(super) fn closes<M, T: Real>(modes: &ContactModes<M, T>) -> bool {
    modes.contacts.iter().any(|mode| mode.is_closed())
}

/// Returns the gap, m, below which surfaces touch: what rounding of the positions leaves.
pub(super) fn touching<P: Plant>(plant: &P, y: &P::State) -> Time<P>
where
    Time<P>: Real,
{
    let one = Time::<P>::from_f64(1.0);
    let positions = &y.entries()[..plant.positions()];
    let size = positions.iter().fold(one, |most, x| most.max(x.abs()));
    Time::<P>::EPSILON * Time::<P>::from_f64(64.0) * size
}
