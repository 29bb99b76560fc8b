//! Tests elements without a store between them: those in series are solved, others are reported.

use bgdyn_codegen::random::Random;
use std::collections::BTreeSet;

use bgdyn_codegen::bond_graph::{Causality, GraphNodeId, NodeKind};
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::Dd;

use super::bench::{Bench, agree, dd};
use super::common::{read, scene, specs, told, try_scene};
use super::written::{ALL, TENSOR, WRITTEN, mechanism, names};

const EXACT: f64 = 1e-24;

const BLOCK: &str = "
format: 1
links:
  - { name: block, mass: 2 kg, joint: { name: slide, type: prismatic, axis: x } }
";

fn text(effects: &str) -> String {
    let nodes = "scene: 1
mechanism: block.yaml
effects:
  - oil: { type: fluid, bulk_modulus: 1 GPa }
  - left: { type: line, volume: 2 cm^3 }
  - right: { type: line, volume: 5 cm^3 }
";
    let lines = effects.lines().map(str::trim).filter(|l| !l.is_empty());
    let effects: Vec<String> = lines.map(|l| format!("  - {l}\n")).collect();
    format!("{nodes}{}", effects.concat())
}

/// Pressure drop of a member: R q + S q|q|.
struct Member {
    resistance: Dd,
    square: Dd,
}

/// Checks a chain against its members: the same flow, drops that add up to the total, the pressures
/// between them, and dissipation that is the flow times the drop of enthalpy, member by member.
fn hold(effects: &str, members: &[(&str, f64, Member)], junctions: &[&str]) {
    let mut text = text(effects);
    let names = junctions.iter().map(|j| format!("{j}_pressure"));
    let flows = members.iter().map(|(name, ..)| format!("{name}_flow"));
    let outputs: Vec<String> = names.chain(flows).collect();
    text += &format!("outputs: [{}]\n", outputs.join(", "));
    let mut bench = Bench::new(scene(&text, BLOCK));
    let bulk = dd("1e9");
    let mut random = Random(5);
    for _ in 0..20 {
        let mut p = || Dd::from_f64(8e6 + 7e6 * random.signed());
        let (left, right) = (p(), p());
        for (name, volume, p) in [("left", "2e-6", left), ("right", "5e-6", right)] {
            let i = bench.state(name);
            bench.at.x[i] = dd(volume) * (p / bulk).exp();
        }
        let q = bench.rate("right") / (right / bulk).exp();
        let mut at = left;
        for (i, (name, sign, member)) in members.iter().enumerate() {
            let own = bench.output(&format!("{name}_flow"));
            agree(name, own, q * Dd::from_f64(*sign), 1e-9, EXACT);
            let before = at;
            at = at - member.resistance * q - member.square * q * q.abs();
            if let Some(junction) = junctions.get(i) {
                let found = bench.output(&format!("{junction}_pressure"));
                agree(junction, found, at, 1e6, EXACT);
            }
            let enthalpy = |p: Dd| bulk * ((p / bulk).exp() - dd("1"));
            let lost = (enthalpy(before) - enthalpy(at)) * q;
            let [supplied, stored, dissipated] = bench.power(name);
            agree("lost", dissipated, lost, 1e-3, 1e-18);
            assert!(dissipated.to_f64() >= 0.0);
            assert_eq!((supplied, stored), (Dd::ZERO, Dd::ZERO));
        }
        agree("the far end", at, right, 1e6, EXACT);
    }
    super::laws::hold(&bench.system);
}

fn orifice(k: &str, resistance: &str) -> Member {
    Member {
        resistance: dd(resistance),
        square: dd("1") / (dd(k) * dd(k)),
    }
}

fn leakage(conductance: &str) -> Member {
    Member {
        resistance: dd("1") / dd(conductance),
        square: Dd::ZERO,
    }
}

#[test]
fn orifices_in_series_are_one() {
    hold(
        "tee: { type: junction }
         first: { type: orifice, from: left, to: tee, flow: 2e-7 }
         second: { type: orifice, from: tee, to: right, flow: 3e-7 }",
        &[
            ("first", 1.0, orifice("2e-7", "0")),
            ("second", 1.0, orifice("3e-7", "0")),
        ],
        &["tee"],
    );
}

/// The flow's sign follows each element's own direction, for both orders of its nodes.
#[test]
fn elements_may_point_either_way() {
    hold(
        "first: { type: orifice, from: tee, to: left, flow: 2e-7 }
         second: { type: leakage, from: right, to: tee, conductance: 2e-12 }
         tee: { type: junction }",
        &[
            ("first", -1.0, orifice("2e-7", "0")),
            ("second", -1.0, leakage("2e-12")),
        ],
        &["tee"],
    );
}

#[test]
fn leakages_in_series_are_one() {
    hold(
        "tee: { type: junction }
         first: { type: leakage, from: left, to: tee, conductance: 1e-12 }
         second: { type: leakage, from: tee, to: right, conductance: 3e-12 }",
        &[
            ("first", 1.0, leakage("1e-12")),
            ("second", 1.0, leakage("3e-12")),
        ],
        &["tee"],
    );
}

#[test]
fn mixed_chains_are_solved_by_the_quadratic_law() {
    hold(
        "one: { type: junction }
         two: { type: junction }
         first: { type: orifice, from: left, to: one, flow: 2e-7, resistance: 2e9 }
         middle: { type: leakage, from: two, to: one, conductance: 5e-12 }
         last: { type: orifice, from: two, to: right, flow: 4e-7 }",
        &[
            ("first", 1.0, orifice("2e-7", "2e9")),
            ("middle", -1.0, leakage("5e-12")),
            ("last", 1.0, orifice("4e-7", "0")),
        ],
        &["one", "two"],
    );
}

/// What was solved is listed with its elements and nodes.
#[test]
fn what_was_solved_is_listed() {
    let text = text(
        "tee: { type: junction }
         first: { type: orifice, from: left, to: tee, flow: 2e-7 }
         second: { type: orifice, from: tee, to: right, flow: 3e-7 }",
    );
    let solved = scene(&text, BLOCK).scene.solved();
    assert_eq!(solved.len(), 1);
    assert_eq!(solved[0].elements, ["first", "second"]);
    assert_eq!(solved[0].nodes, ["tee"]);
    let path = specs()
        .into_iter()
        .find(|p| p.ends_with("scara_motors.scene.yaml"));
    let solved = read(&path.expect("the scene")).scene.solved();
    let names: Vec<&str> = solved.iter().map(|s| s.elements[0].as_str()).collect();
    assert_eq!(names, ["elbow_motor"], "the motor without inductance");
}

/// If one effect is removed from a scene, those that need it are removed too.
#[test]
fn what_needs_a_missing_effect_falls_away() {
    let text = text(
        "tee: { type: junction }
         first: { type: orifice, from: left, to: tee, flow: 2e-7 }
         second: { type: orifice, from: tee, to: right, flow: 3e-7 }",
    );
    let whole = scene(&text, BLOCK).scene;
    let without = |gone: &str| {
        let rest = whole.with_effects(|e| e.name != gone);
        assert!(rest.chains.is_empty());
        let names = rest.elements.iter().map(|e| e.name.clone());
        names.collect::<Vec<_>>()
    };
    assert_eq!(without("oil"), Vec::<String>::new());
    assert_eq!(without("first"), ["left", "right", "oil"]);
    assert_eq!(without("tee"), ["left", "right", "oil"]);
    assert_eq!(without("left"), ["right", "oil"]);
    let all = whole.with_effects(|_| true);
    assert_eq!((all.elements.len(), all.chains.len()), (6, 1));
}

/// Checks the rule, the line and the words of the only fault of a scene.
fn refused(effects: &str, rule: &str, line_has: &str, words: &[&str]) {
    let text = text(effects);
    let refusal = try_scene(&text, BLOCK).expect_err("a fault");
    let told = told(&refusal, &text);
    let headlines: Vec<&str> = told
        .lines()
        .filter(|l| l.starts_with("scene.yaml:"))
        .collect();
    assert_eq!(headlines.len(), 1, "{told}");
    let line: usize = headlines[0]
        .split(':')
        .nth(1)
        .and_then(|n| n.parse().ok())
        .expect("a line");
    let source = text.lines().nth(line - 1).expect("the line");
    assert!(source.contains(line_has), "at `{source}`:\n{told}");
    assert!(headlines[0].ends_with(&format!("[{rule}]")), "{told}");
    for word in words {
        assert!(told.contains(word), "no `{word}` in:\n{told}");
    }
}

#[test]
fn loops_that_cannot_be_solved_are_named() {
    refused(
        "tee: { type: junction }
         first: { type: orifice, from: left, to: tee, flow: 2e-7 }
         second: { type: orifice, from: tee, to: right, flow: 3e-7 }
         third: { type: leakage, from: tee, to: right, conductance: 1e-12 }",
        "algebraic-loop",
        "tee:",
        &["`first`, `second`, `third`", "`tee`", "type: line, volume"],
    );
    refused(
        "tee: { type: junction }
         first: { type: orifice, from: left, to: tee, flow: 2e-7 }
         second: { type: orifice, from: tee, to: right, flow: 3e-7, opening: lever }",
        "algebraic-loop",
        "tee:",
        &[
            "`first` and `second`",
            "`second` has an opening that varies",
        ],
    );
    refused(
        "pump: { type: supply, pressure: 1 MPa }
         tee: { type: junction }
         first: { type: orifice, from: left, to: tee, flow: 2e-7 }
         valve: { type: four_way_valve, supply: pump, tank: tee, a: left, b: right, flow: 3e-7 }",
        "algebraic-loop",
        "tee:",
        &["`valve` has an opening that varies"],
    );
    refused(
        "one: { type: junction }
         two: { type: junction }
         first: { type: orifice, from: one, to: two, flow: 2e-7 }
         second: { type: orifice, from: one, to: two, flow: 3e-7 }",
        "algebraic-loop",
        "one:",
        &["circle", "volume"],
    );
}

#[test]
fn a_dead_end_is_named() {
    refused(
        "tee: { type: junction }",
        "joined-to-nothing",
        "tee:",
        &["nothing is joined"],
    );
    refused(
        "tee: { type: junction }
         first: { type: orifice, from: left, to: tee, flow: 2e-7 }",
        "joined-to-nothing",
        "tee:",
        &["`first` alone"],
    );
}

/// For a motor with neither resistance nor inductance the current is undetermined.
#[test]
fn a_motor_without_both_is_named() {
    refused(
        "drive: { type: dc_motor, joint: slide, resistance: 0, torque_constant: 0.1 }",
        "algebraic-loop",
        "drive:",
        &["voltage → current → torque → speed"],
    );
}

/// Returns the names of elements with these nodes of the bond graph, and of hydraulic junctions.
fn names_of(system: &SceneEquations, nodes: &[GraphNodeId]) -> BTreeSet<String> {
    let element = |id: &GraphNodeId| {
        let at = system.network.nodes[id.0].element?;
        Some(system.scene.elements[at].name.clone())
    };
    nodes.iter().filter_map(element).collect()
}

/// The causality of the bond graph has the loops that the check solves, and no others.
#[test]
fn loops_of_the_bond_graph_are_the_chains_that_are_solved() {
    let chains = text(
        "one: { type: junction }
         two: { type: junction }
         first: { type: orifice, from: left, to: one, flow: 2e-7, resistance: 2e9 }
         middle: { type: leakage, from: two, to: one, conductance: 5e-12 }
         last: { type: orifice, from: two, to: right, flow: 4e-7 }
         aside: { type: leakage, from: left, to: right, conductance: 1e-12 }",
    );
    let files = specs().into_iter();
    let files = files.filter(|p| p.to_string_lossy().ends_with(".scene.yaml"));
    let scenes = files.map(|path| read(&path));
    let mut with_chains = 0;
    for system in scenes.chain([scene(&chains, BLOCK)]) {
        let causality = Causality::of(&system.network);
        let solved = system.scene.solved().into_iter();
        let solved = solved.filter(|s| !s.nodes.is_empty());
        let expected: Vec<BTreeSet<String>> = solved
            .map(|s| s.elements.into_iter().chain(s.nodes).collect())
            .collect();
        let found: Vec<BTreeSet<String>> = causality
            .loops
            .iter()
            .map(|nodes| names_of(&system, nodes))
            .collect();
        assert_eq!(found, expected, "{}", system.scene.name);
        assert_eq!(causality.conflicts, [], "{}", system.scene.name);
        with_chains += usize::from(!found.is_empty());
        let elements = |node: &&GraphNodeId| system.network.nodes[node.0].element.is_some();
        let dependent: Vec<GraphNodeId> = causality
            .dependent
            .iter()
            .filter(elements)
            .copied()
            .collect();
        assert_eq!(dependent, [], "{}", system.scene.name);
    }
    assert!(with_chains > 0);
}

/// The current of a motor without inductance follows from its resistance.
#[test]
fn the_resistance_gives_the_current_where_there_is_no_inductance() {
    let path = specs()
        .into_iter()
        .find(|p| p.ends_with("scara_motors.scene.yaml"));
    let system = read(&path.expect("the scene"));
    let network = &system.network;
    let causality = Causality::of(network);
    let mut giving = BTreeSet::new();
    for node in network.ids() {
        let (bond, _) = network.bonds_at(node).next().expect("a bond");
        let gives_flow = causality.strokes[bond] == Some(node);
        if network.nodes[node.0].kind == NodeKind::Resistor && gives_flow {
            giving.extend(names_of(&system, &[node]));
        }
    }
    let solved = system.scene.solved().into_iter().flat_map(|s| s.elements);
    assert_eq!(giving, solved.collect());
}

/// Every effect that a file declares has nodes of its symbol in the bond graph, without causal conflicts;
/// except those that are part of links or volumes.
#[test]
fn effects_are_on_the_bond_graph_what_their_symbols_say() {
    for (keyword, written) in WRITTEN {
        let declared = format!("effects:\n  extra: {written}\n");
        let called = format!("velocity_products, {}]", names(written));
        let text = ALL.replace("velocity_products]", &called);
        let system = scene(&text, &mechanism("", TENSOR, &declared));
        let causality = Causality::of(&system.network);
        assert_eq!(causality.conflicts, [], "{keyword}");
        let effect = |at: usize| system.scene.elements[at].effect;
        let own = |at: Option<usize>| at.is_some_and(|at| effect(at).keyword() == *keyword);
        let nodes = || system.network.nodes.iter().filter(|n| own(n.element));
        let elements = system.scene.elements.iter();
        let symbol = elements.map(|e| e.effect).find(|e| e.keyword() == *keyword);
        let symbol = symbol.expect("the effect").symbol();
        match *keyword {
            "fluid" | "payload" => assert_eq!(nodes().count(), 0, "{keyword}"),
            _ => assert!(nodes().any(|n| n.kind.symbol() == symbol), "{keyword}"),
        }
    }
}
