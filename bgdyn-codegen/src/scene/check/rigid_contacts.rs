//! Checks that a scene with rigid contacts has an integrator for them, and nothing that it cannot solve with them.

use bgdyn_runtime::MOST_CONTACTS;

use super::super::{IntegratorName, Scene};
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
    let Some(first) = first else { return };
    let method = scene.integration.method;
    if !method.solves_contacts() {
        let location = spec.integration.value().map(|raw| &raw.location);
        let solving = IntegratorName::ALL.into_iter();
        let solving: Vec<&str> = solving
            .filter(|m| m.solves_contacts())
            .map(IntegratorName::name)
            .collect();
        faults.push(wording::integrator_without_contacts(
            location.unwrap_or(&first.location),
            (&first.name, method.name()),
            &solving,
        ));
    }
    if rigid.len() > MOST_CONTACTS {
        faults.push(wording::too_many_rigid_contacts(
            &first.location,
            rigid.len(),
            MOST_CONTACTS,
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
