//! The laws of a scene's effects, summed on its junctions.

use crate::bond_graph::BondGraph;
use crate::effect;
use crate::expr::{Builder, Ex, Leaf};
use crate::formulation::Formulation;
use crate::laws::{Laws, Own};
use crate::layout::Part;
use crate::scene::Scene;

/// Every law of the scene, summed.
pub(super) fn summed<'g, 'a>(
    b: &'g Builder,
    scene: &'a Scene,
    graph: &'a BondGraph,
    own: Own,
) -> Laws<'g, 'a> {
    summed_by(b, scene, graph, own, None)
}

/// The same, with the mechanism's own methods by this formulation.
pub(super) fn summed_by<'g, 'a>(
    b: &'g Builder,
    scene: &'a Scene,
    graph: &'a BondGraph,
    own: Own,
    asked: Option<&'static dyn Formulation>,
) -> Laws<'g, 'a> {
    let input = |(i, part): (usize, &Part)| match part.drives {
        Some(_) if own != Own::Inputs => b.zero(),
        _ => b.leaf(Leaf::Input(i)),
    };
    let inputs = || scene.layout.inputs.iter().enumerate().map(input).collect();
    summed_under(b, scene, (graph, asked), own, inputs)
}

/// The same under these inputs.
pub(super) fn summed_under<'g, 'a>(
    b: &'g Builder,
    scene: &'a Scene,
    graph: (&'a BondGraph, Option<&'static dyn Formulation>),
    own: Own,
    inputs: impl FnOnce() -> Vec<Ex<'g>>,
) -> Laws<'g, 'a> {
    let mut laws = Laws::empty(b, scene, graph, own, inputs);
    for (at, element) in scene.elements.iter().enumerate() {
        laws.begin(at);
        b.section(|| format!("{}: {}", element.name, element.effect.summary()));
        effect::of(element).law(element, &mut laws);
    }
    laws
}
