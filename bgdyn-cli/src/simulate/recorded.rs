//! The plants whose runs are recorded: scenes, and scenes whose rigid contacts are solved from event to event.

use bgdyn_runtime::MOST_EVENT_CONTACTS;
use bgdyn_sim::event_driven::{ContactMode, ContactModes, EventError};
use bgdyn_sim::{EventDriven, HybridState, Plant, Reason};

use super::plant::{Evaluated, Numbers};
use super::run_table::ContactEvent;
use super::undefined::Undefined;

/// A scene, or a plant around it.
pub(super) trait Recorded<'a>: Plant<State = Numbers, Entries = Numbers> {
    /// Returns the plant, and its start.
    fn from_scene(scene: Evaluated<'a>) -> (Self, HybridState<Numbers, Self::Modes>)
    where
        Self: Sized;

    /// Returns the scene.
    fn scene(&self) -> &Evaluated<'a>;

    /// Returns the modes of the scene.
    fn scene_modes(modes: &Self::Modes) -> &Numbers;

    /// Returns the forces of the rigid contacts in a state, N along (x, y, normal); `None` if steps have them.
    fn contact_forces(&self, t: f64, y: &Numbers, modes: &Self::Modes) -> Option<Vec<[f64; 3]>> {
        let _ = (t, y, modes);
        None
    }

    /// Returns what rigid contacts did at an event.
    fn contact_events(before: &Self::Modes, after: &Self::Modes) -> Vec<ContactEvent> {
        let _ = (before, after);
        vec![]
    }

    /// Returns the residual of the impulses at the last event, N·s, and whether Poisson's law replaced Newton's.
    fn impact(modes: &Self::Modes) -> Option<(f64, bool)> {
        let _ = modes;
        None
    }

    /// Describes why a run ended.
    fn failure(&self, reason: &Reason<Self::Error>) -> String;
}

impl<'a> Recorded<'a> for Evaluated<'a> {
    fn from_scene(scene: Evaluated<'a>) -> (Self, HybridState<Numbers, Numbers>) {
        let begin = scene.begin();
        (scene, begin)
    }

    fn scene(&self) -> &Evaluated<'a> {
        self
    }

    fn scene_modes(modes: &Numbers) -> &Numbers {
        modes
    }

    fn failure(&self, reason: &Reason<Undefined>) -> String {
        reason.to_string()
    }
}

impl<'a> Recorded<'a> for EventDriven<Evaluated<'a>> {
    fn from_scene(scene: Evaluated<'a>) -> (Self, HybridState<Numbers, Self::Modes>) {
        let HybridState { t, y, modes } = scene.begin();
        let modes = ContactModes::open(modes);
        (EventDriven::new(scene), HybridState { t, y, modes })
    }

    fn scene(&self) -> &Evaluated<'a> {
        &self.plant
    }

    fn scene_modes(modes: &Self::Modes) -> &Numbers {
        &modes.plant
    }

    fn contact_forces(&self, t: f64, y: &Numbers, modes: &Self::Modes) -> Option<Vec<[f64; 3]>> {
        let forces = self.forces(t, y, modes);
        let forces = forces.unwrap_or([[f64::NAN; 3]; MOST_EVENT_CONTACTS]);
        let all = forces.into_iter().take(self.plant.rigid_contacts());
        Some(all.collect())
    }

    fn contact_events(before: &Self::Modes, after: &Self::Modes) -> Vec<ContactEvent> {
        let closed = |mode: &ContactMode<f64>| mode.is_closed();
        let modes = before.contacts.iter().zip(&after.contacts);
        let all = modes.zip(after.jump.impulses).enumerate();
        let what = all.filter_map(|(contact, ((before, after), impulse))| {
            let impulse = impulse[2];
            let text = match after {
                ContactMode::Open if closed(before) => "opens",
                ContactMode::Open if impulse > 0.0 => "bounces",
                ContactMode::Stick if !closed(before) => "closes and sticks",
                ContactMode::Start(_) | ContactMode::Slip(_) if !closed(before) => {
                    "closes and slips"
                }
                ContactMode::Stick if before != after => "sticks",
                ContactMode::Start(_) if *before == ContactMode::Stick => "slips",
                _ => return None,
            };
            Some(ContactEvent {
                contact,
                text,
                impulse,
            })
        });
        what.collect()
    }

    fn impact(modes: &Self::Modes) -> Option<(f64, bool)> {
        Some((modes.jump.residual, modes.jump.by_poisson))
    }

    fn failure(&self, reason: &Reason<EventError<Undefined>>) -> String {
        let system = self.plant.system;
        match reason {
            Reason::Singular(EventError::Plant(undefined)) => {
                Reason::Singular(undefined.clone()).to_string()
            }
            Reason::Singular(EventError::Paradox { contact }) => format!(
                "`{}` slips, and no finite force keeps the surfaces from overlapping (Painlevé's paradox); an impulse does: use `moreau`",
                system.scene.layout.rigid_contacts[*contact]
            ),
            Reason::Singular(other) => other.to_string(),
            other => other.to_string(),
        }
    }
}
