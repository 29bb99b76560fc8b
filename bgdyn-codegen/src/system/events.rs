//! The event functions of a scene: contacts, kinks of laws, limits of inputs.

use super::holds::held;
use super::summed::summed;
use super::{ActuatorEfforts, SceneEquations, signals};
use crate::expr::{Builder, Expr};

/// Returns the event functions; an event occurs where one falls through zero. For a contact it is the slip
/// in its direction, or the margin until it breaks away.
pub(super) fn events<'g>(system: &SceneEquations, b: &'g Builder) -> Vec<Expr<'g>> {
    let sums = summed(b, &system.scene, &system.graph, ActuatorEfforts::FromInputs);
    let of_contacts = if sums.contacts().is_empty() {
        vec![]
    } else {
        let holding = held(system, &sums, b).holding;
        let half = b.number(0.5);
        let contacts = sums.contacts().iter().zip(holding);
        contacts
            .map(|(c, holding)| {
                let mode = sums.mode_at(c.mode);
                let margin = sums.margin(c, holding);
                let name = &system.scene.layout.modes[c.mode].name;
                (
                    name.clone(),
                    mode.abs().if_less(half, margin, c.slip * mode),
                )
            })
            .collect()
    };
    let limits = signals::limit_distances(system, b);
    let value = |part: &crate::scene::Variable| {
        let contact = of_contacts.iter().find(|(name, _)| *name == part.name);
        contact
            .map(|(_, value)| *value)
            .or_else(|| sums.event_named(&part.name))
            .or_else(|| {
                limits
                    .iter()
                    .find(|(name, _)| *name == part.name)
                    .map(|found| found.1)
            })
            .unwrap_or(b.number(1.0))
    };
    system.scene.layout.events.iter().map(value).collect()
}
