//! Checks the names of outputs in a scene whose effects are refused.

use super::super::Scene;
use crate::declaration::RejectedEffects;
use crate::fault::{Faults, wording};

/// Reports outputs that are no parts of the state, no sites, and no outputs of a refused effect.
pub(super) fn names(scene: &Scene, refused: &RejectedEffects, faults: &mut Faults) {
    let (layout, mechanism) = (&scene.layout, &scene.mechanism);
    let links = mechanism.links().iter().map(|l| l.name.as_str());
    let rates = layout.dependents.iter().map(|d| d.rate_name.as_str());
    let frames = mechanism.frames().iter().map(|f| f.name.as_str());
    let known: Vec<&str> = layout
        .state_names()
        .chain(rates)
        .chain(links)
        .chain(frames)
        .collect();
    for output in &scene.outputs {
        let name = output.value.as_str();
        let reported = scene.elements.iter().any(|e| name.starts_with(&e.name));
        if known.contains(&name) || reported || refused.may_bring(name) {
            continue;
        }
        faults.push(wording::unknown_output(&output.location, name, &known));
    }
}
