//! Removes effects from scenes, to measure the cost and the influence of each effect.

use super::Scene;
use super::causality::{chains, is_solvable};
use super::check::{assembled, missing};
use crate::declaration::{Element, ElementValue, RejectedEffects, SceneContext};
use crate::fault::Faults;
use crate::mechanism::Mechanism;

impl Scene {
    /// Returns the scene with only the effects for which `keep` is true, and without those that act on a
    /// removed part or need one. Inputs, initial values and outputs of removed parts are dropped.
    pub fn with_effects(&self, keep: impl Fn(&Element) -> bool) -> Scene {
        let mut elements = self.elements.clone();
        elements.retain(|e| keep(e));
        loop {
            let before = elements.len();
            let there: Vec<String> = elements.iter().map(|e| e.name.clone()).collect();
            let missing: Vec<&String> = self
                .elements
                .iter()
                .map(|e| &e.name)
                .filter(|name| !there.contains(name))
                .collect();
            elements.retain(|e| !missing.iter().any(|gone| acts_on(e, gone)));
            let left = elements.clone();
            elements.retain(|e| is_kept(e, &left, &self.written.unloaded));
            if elements.len() == before {
                break;
            }
        }
        let mut written = self.written.clone();
        let chains = chains(&elements, &mut Faults::default());
        let bare = Scene {
            elements,
            chains,
            ..self.clone()
        };
        // Entries for removed parts are no faults here.
        let laid_out = assembled(
            bare.clone(),
            &RejectedEffects::default(),
            &mut Faults::default(),
        );
        let layout = &laid_out.layout;
        let known_input = |name: &str| {
            let held = layout.quasi_joints.iter().any(|joint| joint.name == name);
            held || layout.inputs.iter().any(|i| i.name == name)
        };
        written.inputs.retain(|raw| known_input(&raw.name.value));
        // Other efforts may need other modes: they are determined again.
        written.modes = Some(Vec::new());
        let scene = Scene { written, ..bare };
        let scene = assembled(scene, &RejectedEffects::default(), &mut Faults::default());
        // A controller that would need a removed part has the model of the scene.
        let mut model = scene.controller_model;
        model.take_if(|model| !missing(&model.layout, &scene.layout).is_empty());
        Scene {
            outputs: Vec::new(),
            controller_model: model,
            ..scene
        }
    }
}

/// Returns whether an element still has the elements that it needs: a fluid, two elements at a junction.
fn is_kept(element: &Element, left: &[Element], mechanism: &Mechanism) -> bool {
    let mut faults = Faults::default();
    let beside = SceneContext {
        elements: left,
        mechanism,
    };
    element.effect.check_in_scene(element, &beside, &mut faults);
    !faults.any_fault() && is_solvable(element, left)
}

/// Returns whether an element refers to another: to its coordinate, or to one of its nodes.
fn acts_on(element: &Element, other: &str) -> bool {
    let refers = |name: &String| {
        let side = name
            .strip_prefix(other)
            .and_then(|rest| rest.strip_prefix('_'));
        name == other || side.is_some_and(|side| side.len() == 1)
    };
    element.values.iter().any(|(_, value)| match value {
        ElementValue::Name(name) => refers(name),
        ElementValue::Names(names) => names.iter().any(refers),
        ElementValue::Number(_) | ElementValue::Vector(_) | ElementValue::Words(_) => false,
    })
}
