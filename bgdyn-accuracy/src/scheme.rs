//! How the integrators of a study meet a scene: as it is, or from event to event.

use bgdyn_sim::event_driven::ContactModes;
use bgdyn_sim::{EventDriven, HybridState, Of, Plant, Real};

use crate::integrate::Measured;

/// A plant and its start.
pub type PlantAtStart<P> = (P, HybridState<<P as Plant>::State, <P as Plant>::Modes>);

/// How an integrator meets a scene.
pub trait Scheme: Copy + 'static {
    /// Whether rigid contacts are solved from event to event.
    const BY_EVENTS: bool;
    /// The scene as the integrator meets it.
    type Scene<P: Measured + Clone + 'static>: Measured<State = P::State> + Clone + 'static
    where
        Of<P::State>: Real;

    /// Returns a scene as the integrator meets it, and its start.
    fn scene<P: Measured + Clone + 'static>(
        at_start: PlantAtStart<P>,
    ) -> PlantAtStart<Self::Scene<P>>
    where
        Of<P::State>: Real;
}

/// The scene as it is: without rigid contacts, or for an integrator that solves for their impulses.
#[derive(Clone, Copy, Debug)]
pub struct AsItIs;

/// From event to event, for a scene with rigid contacts ([`EventDriven`]).
#[derive(Clone, Copy, Debug)]
pub struct ByEvents;

impl Scheme for AsItIs {
    const BY_EVENTS: bool = false;
    type Scene<P: Measured + Clone + 'static>
        = P
    where
        Of<P::State>: Real;

    fn scene<P: Measured + Clone + 'static>(at_start: PlantAtStart<P>) -> PlantAtStart<P>
    where
        Of<P::State>: Real,
    {
        at_start
    }
}

impl Scheme for ByEvents {
    const BY_EVENTS: bool = true;
    type Scene<P: Measured + Clone + 'static>
        = EventDriven<P>
    where
        Of<P::State>: Real;

    /// Runs find the modes of the contacts at the start.
    fn scene<P: Measured + Clone + 'static>(
        (plant, begin): PlantAtStart<P>,
    ) -> PlantAtStart<EventDriven<P>>
    where
        Of<P::State>: Real,
    {
        let HybridState { t, y, modes } = begin;
        let modes = ContactModes::open(modes);
        (EventDriven::new(plant), HybridState { t, y, modes })
    }
}
