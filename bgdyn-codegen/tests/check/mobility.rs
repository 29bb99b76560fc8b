//! Tests the warnings of what cannot move: joints that move no inertia, mechanisms without coordinates.

use bgdyn_codegen::read;

/// A joint that moves no inertia is named, in all cases.
#[test]
fn joints_without_inertia_are_named() {
    let tip = |tip: &str| {
        format!(
            "format: 1\nlinks:\n  - {{ name: a, joint: {{ name: one, type: revolute, axis: z }}, mass: 1, com: [1, 0, 0] }}\n  - {{ name: b, parent: a, {tip} }}\n"
        )
    };
    for (text, named) in [
        ("joint: { name: two, type: revolute, axis: x }", true),
        (
            "joint: { name: two, type: revolute, axis: x }, mass: 1",
            true,
        ),
        (
            "joint: { name: two, type: revolute, axis: x }, mass: 1, com: [1, 0, 0]",
            true,
        ),
        (
            "joint: { name: two, type: revolute, axis: x }, inertia: { yy: 1, zz: 1 }",
            true,
        ),
        (
            "joint: { name: two, type: prismatic, axis: x }, inertia: { xx: 1, yy: 1, zz: 1 }",
            true,
        ),
        (
            "joint: { name: two, type: revolute, axis: y }, inertia: { yy: 1, zz: 1 }",
            false,
        ),
        (
            "joint: { name: two, type: revolute, axis: x }, mass: 1, com: [0, 1, 0]",
            false,
        ),
        (
            "joint: { name: two, type: prismatic, axis: x }, mass: { parameter: load, value: 0 }",
            false,
        ),
    ] {
        let (mechanism, faults) = read(&tip(text), Some("arm"));
        assert!(mechanism.is_some(), "{text}: {faults:?}");
        let found = faults.0.iter().filter(|fault| fault.rule == "no-inertia");
        let found: Vec<&str> = found.map(|fault| fault.message.as_str()).collect();
        let wanted = "nothing that the joint `two` moves has inertia";
        assert_eq!(found, if named { vec![wanted] } else { vec![] }, "{text}");
    }
}

#[test]
fn a_mechanism_that_cannot_move_is_told_of() {
    let link = |kind: &str| {
        format!(
            "format: 1\nname: arm\nlinks:\n  - name: a\n    joint: {{ name: j, type: {kind} }}\n    mass: 1\n    com: [1, 0, 0]\n"
        )
    };
    let told = |text: &str| {
        let (mechanism, faults) = read(text, Some("arm"));
        let rules = faults
            .0
            .iter()
            .map(|fault| (fault.rule, fault.path.clone()));
        (mechanism.is_some(), rules.collect::<Vec<_>>())
    };
    let still = vec![("no-coordinates", "links".to_owned())];
    assert_eq!(told(&link("fixed")), (true, still));
    assert_eq!(told(&link("revolute")), (true, vec![]));
    // Other findings come first: they may concern the missing inertia.
    let (_, rules) = told(&link("fixed").replace("mass: 1", "mass: -1"));
    assert_eq!(rules.len(), 1, "{rules:?}");
}
