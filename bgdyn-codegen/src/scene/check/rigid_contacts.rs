//! Checks that a scene with rigid contacts has an integrator for them, and nothing that it cannot solve with them.

use bgdyn_runtime::{ImpactLaw, MOST_CONTACTS, MOST_EVENT_CONTACTS};

use super::super::{IntegratorName, Scene};
use super::run::IMPACTS;
use crate::fault::{Faults, wording};
use crate::format::SceneSpec;

/// Returns the scene with an integrator for rigid contacts, if it has some and names none.
pub(super) fn with_integrator(spec: &SceneSpec, mut scene: Scene) -> Scene {
    let named = spec.integration.value().and_then(|raw| raw.peek("method"));
    if named.is_none() && !scene.layout.rigid_contacts.is_empty() {
        scene.integration.method = IntegratorName::Moreau;
    }
    scene
}

/// Reports what does not go with rigid contacts.
pub(super) fn check(spec: &SceneSpec, scene: &Scene, faults: &mut Faults) {
    let rigid = &scene.layout.rigid_contacts;
    let first = scene.elements.iter().find(|e| rigid.contains(&e.name));
    let impacts = spec.integration.value();
    let impacts = impacts.filter(|raw| raw.peek(IMPACTS.name).is_some());
    let Some(first) = first else {
        if let Some(raw) = impacts {
            faults.push(wording::impacts_without_contacts(&raw.location));
        }
        return;
    };
    let method = scene.integration.method;
    let location = spec.integration.value().map(|raw| &raw.location);
    let location = location.unwrap_or(&first.location);
    if scene.integration.impacts != ImpactLaw::Newton && method.solves_contacts() {
        faults.push(wording::impacts_of_time_stepping(location, method.name()));
    }
    if method.needs_canonical() {
        faults.push(wording::canonical_of_rigid_contacts(
            location,
            &first.name,
            (method.name(), IntegratorName::Moreau.name()),
        ));
    }
    if rigid.len() > MOST_CONTACTS {
        faults.push(wording::too_many_rigid_contacts(
            &first.location,
            rigid.len(),
            MOST_CONTACTS,
        ));
    } else if rigid.len() > MOST_EVENT_CONTACTS && !method.solves_contacts() {
        faults.push(wording::too_many_event_contacts(
            location,
            (method.name(), IntegratorName::Moreau.name()),
            rigid.len(),
            (MOST_EVENT_CONTACTS, MOST_CONTACTS),
        ));
    }
    if let Some(mode) = scene.layout.modes.first() {
        faults.push(wording::rigid_contact_beside_modes(
            &first.location,
            &first.name,
            &mode.name,
        ));
    }
}
