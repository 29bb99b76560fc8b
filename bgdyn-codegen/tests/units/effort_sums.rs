//! What a law may read: names that its effect declares.

use std::panic;

use bgdyn_codegen::bond_graph::BondNetwork;
use bgdyn_codegen::declaration::{EffectKind, Element};
use bgdyn_codegen::effect::Effect;
use bgdyn_codegen::effort_sums::EffortSums;
use bgdyn_codegen::expr::Builder;
use bgdyn_codegen::format::{Dimension, Key, Reads};

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

const CHOICE: Key = Key {
    name: "choice",
    reads: Reads::Word(&["one", "other"]),
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
        &[DECLARED, CHOICE]
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
    let read = bgdyn_codegen::read_scene(SCENE, "swing", |_| Ok(MECHANISM.to_owned()));
    let (system, _) = read.expect("a sound scene");
    let (b, probe) = (Builder::silent(), &*Box::leak(Box::new(Probe(law))));
    let element = Element {
        name: "needle".into(),
        effect: probe,
        ..system.scene.elements[0].clone()
    };
    let mut sums = system.effort_sums(&b);
    let run = panic::AssertUnwindSafe(|| probe.law(&element, &mut sums));
    let panic = panic::catch_unwind(run).err()?;
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
    let expected =
        "the effect `probe` (element `needle`) uses the key `undeclared`, which is not declared";
    assert_eq!(said.as_deref(), Some(expected));
}

/// Each lookup refuses a key that is not declared, and one that is declared with another type, although the file
/// gives neither.
#[test]
fn values_are_found_by_declared_keys_of_their_type_only() {
    type Law = fn(&Element, &mut EffortSums<'_, '_>);
    const RETYPED: Key = Key {
        reads: Reads::Site,
        ..DECLARED
    };
    const GROUP: Key = Key {
        reads: Reads::Group(&["a", "b"], &[Dimension::One]),
        ..DECLARED
    };
    let lookups: [(&str, Law); 14] = [
        ("key `undeclared`", |e, _| _ = e.has(&UNDECLARED)),
        ("key `undeclared`", |e, _| _ = e.quantity(&UNDECLARED)),
        ("key `undeclared`", |e, _| _ = e.written(&UNDECLARED)),
        ("key `choice`", |e, _| _ = e.quantity(&CHOICE)),
        ("key `declared`", |e, _| _ = e.name(&RETYPED)),
        ("key `declared`", |e, _| _ = e.name(&DECLARED)),
        ("key `declared`", |e, _| _ = e.names(&DECLARED)),
        ("key `declared`", |e, _| _ = e.words(&DECLARED)),
        ("key `declared`", |e, _| _ = e.vector(&DECLARED)),
        ("key `declared`", |e, _| _ = e.group::<2>(&GROUP)),
        ("word `third`", |e, _| _ = e.says(&CHOICE, "third")),
        ("value of the key `choice`", |e, _| {
            _ = e.needed_name(&CHOICE)
        }),
        ("value of the keys `joint, between`", |e, sums| {
            let _ = sums.port(e);
        }),
        ("value of the key `joint`", |e, sums| {
            sums.gear_of_drive(e, &DECLARED);
        }),
    ];
    for (what, law) in lookups {
        let said = panic_of(law).unwrap_or_default();
        let expected =
            format!("the effect `probe` (element `needle`) uses the {what}, which is not declared");
        assert_eq!(said, expected);
    }
    let sound: Law = |e, _| {
        assert!(!e.has(&CHOICE) && !e.says(&CHOICE, "one") && e.name(&CHOICE).is_none());
        assert!(e.quantity(&DECLARED).is_none() && e.joint().is_none() && e.ends().is_none());
    };
    assert_eq!(panic_of(sound), None);
}

#[test]
#[should_panic(expected = "the effect `probe` has no key `undeclared`")]
fn a_key_by_name_is_one_of_the_effect() {
    let probe: &dyn EffectKind = &Probe(|_, _| ());
    assert_eq!(*probe.key("choice"), CHOICE);
    let _ = probe.key("undeclared");
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
