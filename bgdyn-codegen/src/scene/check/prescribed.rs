//! What a scene with prescribed joints cannot have: effects at places that these joints move, and a canonical form.

use super::super::Scene;
use crate::declaration::Element;
use crate::fault::{Faults, wording};
use crate::format::SceneSpec;
use crate::mechanism::{LinkId, Mechanism};

/// Refuses effects whose efforts act at a place that a prescribed joint moves: its drive would supply a part of
/// their power. Returns whether there is one.
pub(super) fn places(scene: &Scene, faults: &mut Faults) -> bool {
    let before = faults.count();
    for element in &scene.elements {
        let found = sites(element, &scene.mechanism)
            .into_iter()
            .find_map(|site| {
                let joint = moved_by(&scene.mechanism, site)?;
                Some((site, joint))
            });
        if let Some((site, joint)) = found {
            let effect = (element.name.as_str(), element.effect.keyword());
            let fault = wording::effect_beyond_prescribed(&element.location, effect, site, joint);
            faults.push(fault);
        }
    }
    faults.count() > before
}

/// Returns the places at which the efforts of an effect act. A payload becomes part of a link, a rotor of a joint.
fn sites<'a>(element: &'a Element, mechanism: &'a Mechanism) -> Vec<&'a str> {
    match element.effect.keyword() {
        "payload" | "rotor" => vec![],
        _ => {
            let contact = element.contact().map(|name| mechanism.contact_links(name));
            let links = contact.into_iter().flatten();
            element.sites().into_iter().chain(links).collect()
        }
    }
}

/// Returns a prescribed joint between a place and the world.
fn moved_by<'a>(mechanism: &'a Mechanism, site: &str) -> Option<&'a str> {
    let frame = mechanism.frames().iter().find(|f| f.name == site);
    let link = || mechanism.links().iter().position(|l| l.name == site);
    let mut at = match frame {
        Some(frame) => frame.link,
        None => link().map(LinkId),
    };
    while let Some(i) = at {
        let own = &mechanism.links()[i.0];
        if mechanism.is_prescribed(i) {
            return Some(&own.joint.name);
        }
        at = own.parent;
    }
    None
}

/// Refuses canonical integrators: momenta of prescribed joints are not part of the state.
pub(super) fn canonical(spec: &SceneSpec, scene: &Scene, faults: &mut Faults) {
    let joint = scene.layout.prescribed.first();
    let method = scene.integration.method;
    if let (Some(joint), true, Some(raw)) =
        (joint, method.needs_canonical(), spec.integration.value())
    {
        let names = (method.name(), method.on_velocities().name());
        faults.push(wording::canonical_of_prescribed(
            &raw.location,
            joint,
            names,
        ));
    }
}
