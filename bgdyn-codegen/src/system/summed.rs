//! Sums the laws of a scene's effects on its junctions.

use super::equations::SceneEquations;
use crate::choice::GraphMethods;
use crate::effect;
use crate::effort_sums::{ActuatorEfforts, EffortSums};
use crate::expr::{Builder, Expr, Leaf};
use crate::formulation::Formulation;
use crate::layout::Variable;
use crate::scene::{InputSource, Scene, integral_name};

impl SceneEquations {
    /// Returns the sum of all laws, with efforts of actuators as inputs.
    pub fn effort_sums<'g, 'a>(&'a self, b: &'g Builder) -> EffortSums<'g, 'a> {
        summed(b, &self.scene, &self.graph, ActuatorEfforts::FromInputs)
    }
}

/// Returns the sum of all laws of the scene.
pub(super) fn summed<'g, 'a>(
    b: &'g Builder,
    scene: &'a Scene,
    graph: &'a GraphMethods,
    own: ActuatorEfforts,
) -> EffortSums<'g, 'a> {
    summed_by(b, scene, graph, own, None)
}

/// Returns the same, with the mechanism's own methods by this formulation.
pub(super) fn summed_by<'g, 'a>(
    b: &'g Builder,
    scene: &'a Scene,
    graph: &'a GraphMethods,
    own: ActuatorEfforts,
    asked: Option<&'static dyn Formulation>,
) -> EffortSums<'g, 'a> {
    let input = |(i, part): (usize, &Variable)| match part.drives.or(part.drives_dependent) {
        Some(_) if own != ActuatorEfforts::FromInputs => b.zero(),
        _ => b.leaf(Leaf::Input(i)),
    };
    let inputs = || scene.layout.inputs.iter().enumerate().map(input).collect();
    summed_under(b, scene, (graph, asked), own, inputs)
}

/// Returns the same under these inputs.
pub(super) fn summed_under<'g, 'a>(
    b: &'g Builder,
    scene: &'a Scene,
    graph: (&'a GraphMethods, Option<&'static dyn Formulation>),
    own: ActuatorEfforts,
    inputs: impl FnOnce() -> Vec<Expr<'g>>,
) -> EffortSums<'g, 'a> {
    let mut sums = EffortSums::empty(b, scene, graph, own, inputs);
    for (at, element) in scene.elements.iter().enumerate() {
        sums.begin(at);
        b.section(|| format!("{}: {}", element.name, element.effect.summary()));
        effect::of(element).law(element, &mut sums);
    }
    sums.push_wrenches();
    for (i, drive) in scene.drives.iter().enumerate() {
        if let InputSource::IntegralRate(of) = drive {
            let state = integral_name(&scene.layout.inputs[*of].name);
            let rate = sums.inputs()[i];
            sums.flow(&state, rate);
        }
    }
    sums
}
