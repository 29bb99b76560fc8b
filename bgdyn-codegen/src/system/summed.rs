//! Sums the laws of a scene's effects on its junctions.

use crate::choice::GraphMethods;
use crate::effect;
use crate::effort_sums::{ActuatorEfforts, EffortSums};
use crate::expr::{Builder, Expr, Leaf};
use crate::formulation::Formulation;
use crate::layout::Variable;
use crate::scene::Scene;

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
    let input = |(i, part): (usize, &Variable)| match part.drives {
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
    sums
}

#[cfg(test)]
mod tests {
    use super::summed;
    use crate::bond_graph::BondNetwork;
    use crate::declaration::{EffectKind, Element};
    use crate::effect::Effect;
    use crate::effort_sums::{ActuatorEfforts, EffortSums};
    use crate::expr::Builder;
    use crate::format::{Dimension, Key, Reads};

    const MECHANISM: &str = "{ format: 1, name: one, links: [{ name: arm, joint: { name: hinge, type: revolute, axis: y }, mass: 1 }] }";
    const SCENE: &str = "{ scene: 1, name: swing, mechanism: one.yaml, effects: [bearing: { type: viscous, joint: hinge, damping: 1 }] }";

    const DECLARED: Key = Key {
        name: "declared",
        reads: Reads::Number(&[Dimension::One]),
        needed: false,
        about: "a key that the effect declares",
    };
    const UNDECLARED: Key = Key {
        name: "undeclared",
        ..DECLARED
    };

    /// An effect whose law is defined by a test.
    struct Probe(fn(&Element, &mut EffortSums<'_, '_>));

    impl EffectKind for Probe {
        fn keyword(&self) -> &'static str {
            "probe"
        }
        fn family(&self) -> &'static str {
            "probes"
        }
        fn summary(&self) -> &'static str {
            "reads names"
        }
        fn symbol(&self) -> &'static str {
            "R"
        }
        fn keys(&self) -> &'static [Key] {
            &[DECLARED]
        }
    }

    impl Effect for Probe {
        fn elements(&self, _: &Element, _: &[Element], _: &mut BondNetwork) {}

        fn law(&self, element: &Element, sums: &mut EffortSums<'_, '_>) {
            (self.0)(element, sums);
        }
    }

    /// Returns the text of the panic in the law of a probe called `needle`, if it panics.
    fn panic_of(law: fn(&Element, &mut EffortSums<'_, '_>)) -> Option<String> {
        let read = crate::read_scene(SCENE, "swing", |_| Ok(MECHANISM.to_owned()));
        let (system, _) = read.expect("a sound scene");
        let (b, probe) = (Builder::silent(), &*Box::leak(Box::new(Probe(law))));
        let element = Element {
            name: "needle".into(),
            effect: probe,
            ..system.scene.elements[0].clone()
        };
        let mut sums = summed(
            &b,
            &system.scene,
            &system.graph,
            ActuatorEfforts::FromInputs,
        );
        let run = std::panic::AssertUnwindSafe(|| probe.law(&element, &mut sums));
        let panic = std::panic::catch_unwind(run).err()?;
        Some(*panic.downcast::<String>().expect("a message"))
    }

    #[test]
    fn a_declared_key_without_a_value_is_zero() {
        let law = |element: &Element, sums: &mut EffortSums<'_, '_>| {
            assert!(sums.number(element, &DECLARED).is_zero());
        };
        assert_eq!(panic_of(law), None);
    }

    #[test]
    fn an_undeclared_key_is_named_with_its_effect_and_element() {
        let said = panic_of(|element, sums| {
            sums.number(element, &UNDECLARED);
        });
        let expected = "the law of the effect `probe` (element `needle`) uses the key `undeclared`, which is not declared";
        assert_eq!(said.as_deref(), Some(expected));
    }

    #[test]
    fn every_other_undeclared_name_is_refused() {
        type Law = fn(&Element, &mut EffortSums<'_, '_>);
        let lookups: [(&str, Law); 9] = [
            ("state", |_, sums| {
                let _ = sums.state("nowhere");
            }),
            ("mode", |_, sums| {
                let _ = sums.mode("nowhere");
            }),
            ("input", |_, sums| {
                let _ = sums.input("nowhere");
            }),
            ("coordinate", |_, sums| {
                let _ = sums.coordinate("nowhere");
            }),
            ("site", |_, sums| {
                let _ = sums.site("nowhere");
            }),
            ("event", |_, sums| sums.event("nowhere", sums.t)),
            ("state", |_, sums| sums.flow("nowhere", sums.t)),
            ("element", |_, sums| sums.supply_by("nowhere", sums.t)),
            ("coordinate", |element, sums| {
                sums.push_own(element, sums.t);
            }),
        ];
        for (kind, law) in lookups {
            let said = panic_of(law).unwrap_or_default();
            assert!(
                said.contains(&format!("uses the {kind} `")),
                "{kind}: {said}"
            );
        }
    }
}
