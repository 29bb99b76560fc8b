//! Tests causality on small graphs.

use bgdyn_codegen::bond_graph::{BondNetwork, Causality, GraphNodeId, NodeKind};

fn text(network: &BondNetwork, nodes: &[GraphNodeId]) -> Vec<String> {
    let text = |n: &GraphNodeId| network.nodes[n.0].text.clone();
    nodes.iter().map(text).filter(|t| !t.is_empty()).collect()
}

/// Returns whether the effort acts on this one-port.
fn acts_on(network: &BondNetwork, causality: &Causality, node: GraphNodeId) -> bool {
    let (bond, _) = network.bonds_at(node).next().expect("a bond");
    causality.strokes[bond] == Some(node)
}

#[test]
fn mass_spring_and_damper_have_integral_causality() {
    let mut n = BondNetwork::empty();
    let one = n.add(NodeKind::One, "");
    let mass = n.add_on(one, NodeKind::Inertia, "mass");
    let spring = n.add_on(one, NodeKind::Compliance, "spring");
    let damper = n.add_on(one, NodeKind::Resistor, "damper");
    let force = n.add_on(one, NodeKind::EffortSource, "force");
    let causality = Causality::of(&n);
    let on = [mass, spring, damper, force].map(|node| acts_on(&n, &causality, node));
    assert_eq!(on, [true, false, false, false]);
    assert!(causality.dependent.is_empty() && causality.loops.is_empty());
    assert!(causality.conflicts.is_empty());
}

#[test]
fn of_two_masses_coupled_by_a_lever_one_is_dependent() {
    let mut n = BondNetwork::empty();
    let (one, other) = (n.add(NodeKind::One, ""), n.add(NodeKind::One, ""));
    let lever = n.add(NodeKind::Transformer, "lever");
    n.bond(one, lever);
    n.bond(lever, other);
    n.add_on(one, NodeKind::Inertia, "first");
    n.add_on(other, NodeKind::Inertia, "second");
    let causality = Causality::of(&n);
    assert_eq!(text(&n, &causality.dependent), ["second"]);
    assert!(causality.conflicts.is_empty());
}

#[test]
fn of_two_springs_between_the_same_bodies_one_is_dependent_where_their_effort_is_one() {
    let mut n = BondNetwork::empty();
    let zero = n.add(NodeKind::Zero, "");
    n.add_on(zero, NodeKind::Compliance, "first");
    n.add_on(zero, NodeKind::Compliance, "second");
    assert_eq!(text(&n, &Causality::of(&n).dependent), ["second"]);
}

/// Returns a DC motor on a freely rotating rotor.
fn motor(resistance: bool, inductance: bool) -> (BondNetwork, Causality) {
    let mut n = BondNetwork::empty();
    let (shaft, current) = (
        n.add(NodeKind::One, "shaft"),
        n.add(NodeKind::One, "current"),
    );
    n.add_on(shaft, NodeKind::Inertia, "rotor");
    let gyrator = n.add(NodeKind::Gyrator, "k");
    n.bond(current, gyrator);
    n.bond(gyrator, shaft);
    n.add_on(current, NodeKind::EffortSource, "u");
    if resistance {
        n.add_on(current, NodeKind::Resistor, "R");
    }
    if inductance {
        n.add_on(current, NodeKind::Inertia, "L");
    }
    let causality = Causality::of(&n);
    (n, causality)
}

#[test]
fn the_inductance_of_a_motor_or_else_its_resistance_gives_the_current() {
    let named = |n: &BondNetwork, name| {
        let found = n.nodes.iter().position(|node| node.text == name);
        GraphNodeId(found.expect("a node"))
    };
    let (n, causality) = motor(true, true);
    assert!(acts_on(&n, &causality, named(&n, "L")));
    assert!(!acts_on(&n, &causality, named(&n, "R")));
    assert!(causality.dependent.is_empty());
    let (n, causality) = motor(true, false);
    assert!(acts_on(&n, &causality, named(&n, "R")));
    assert!(causality.loops.is_empty() && causality.conflicts.is_empty());
    // The voltage determines the speed.
    let (n, causality) = motor(false, false);
    assert_eq!(text(&n, &causality.dependent), ["rotor"]);
}

#[test]
fn orifices_in_series_without_a_volume_are_an_algebraic_loop() {
    let series = |volume: bool| {
        let mut n = BondNetwork::empty();
        let between = n.add(NodeKind::Zero, "between");
        if volume {
            n.add_on(between, NodeKind::Compliance, "volume");
        }
        for name in ["first", "second"] {
            let flow = n.add(NodeKind::One, "");
            n.add_on(flow, NodeKind::Resistor, name);
            n.bond(flow, between);
            n.add_on(flow, NodeKind::EffortSource, "");
        }
        let causality = Causality::of(&n);
        let loops = causality.loops.iter().map(|all| text(&n, all)).collect();
        let loops: Vec<Vec<String>> = loops;
        loops
    };
    assert_eq!(series(false), [["between", "first", "second"]]);
    assert!(series(true).is_empty());
}
