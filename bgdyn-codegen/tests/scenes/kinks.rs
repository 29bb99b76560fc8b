//! Checks that every kink of a scene's derivative has an event: a run that did not stop at it would lose
//! the order of its integrator without notice.

use bgdyn_codegen::expr::{Graph, Inputs, Node, NodeId, Signed, evaluate, reachable};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::{Dd, Scalar};

use super::common::{read, scene, specs, state};
use super::one::{BLOCK, text};
use super::written::{ALL, CIRCUIT, TENSOR, WRITTEN, mechanism, names};

/// Number of segments between two states that are searched in each scene.
const SEGMENTS: u64 = 60;
/// Half the distance between the sides of a kink, as a fraction of a segment.
const NEAR: f64 = 1e-13;
/// Slopes with a smaller relative difference are equal; their error is of the size of NEAR².
const NO_KINK: f64 = 1e-9;

fn expr(node: NodeId) -> Signed {
    let negative = false;
    Signed { node, negative }
}

/// Returns the comparisons on which these outputs depend: a branch changes where the two operands are
/// equal, or where the first passes through zero.
fn compared(graph: &Graph, outputs: &[Signed]) -> Vec<(Signed, Option<Signed>)> {
    let needed = reachable(graph, outputs);
    let nodes = (0..graph.len()).filter(|&i| needed[i]);
    let switch = |i: usize| match graph.node(NodeId::at(i)) {
        Node::Abs(a) | Node::Sign(a) => Some((expr(*a), None)),
        Node::Min(a, b) | Node::Max(a, b) | Node::Less(a, b) => Some((*a, Some(*b))),
        _ => None,
    };
    nodes.filter_map(switch).collect()
}

/// States from one to another, with the modes of the first.
struct Segment<'a> {
    derivative: &'a Function,
    events: Option<&'a Function>,
    from: Inputs<Dd>,
    to: Inputs<Dd>,
}

impl Segment<'_> {
    fn at(&self, part: Dd) -> Inputs<Dd> {
        let between = |from: &[Dd], to: &[Dd]| -> Vec<Dd> {
            let pairs = from.iter().zip(to);
            pairs.map(|(&a, &b)| a + (b - a) * part).collect()
        };
        let (from, to) = (&self.from, &self.to);
        Inputs {
            q: between(&from.q, &to.q),
            v: between(&from.v, &to.v),
            x: between(&from.x, &to.x),
            u: between(&from.u, &to.u),
            ..from.clone()
        }
    }

    fn values(&self, of: &[Signed], part: Dd) -> Vec<Dd> {
        let graph = &self.derivative.graph;
        evaluate(graph, of, &self.at(part), &mut Dd::none_refused())
    }

    /// Returns the side of a comparison in a state.
    fn side(&self, (a, b): (Signed, Option<Signed>), part: Dd) -> bool {
        match b {
            None => self.values(&[a], part)[0] < Dd::ZERO,
            Some(b) => {
                let pair = self.values(&[a, b], part);
                pair[0] < pair[1]
            }
        }
    }

    /// Returns the position of a change of side, between 0 and 1.
    fn change(&self, of: (Signed, Option<Signed>)) -> Option<Dd> {
        let (mut low, mut high) = (Dd::ZERO, Dd::ONE);
        let first = self.side(of, low);
        if self.side(of, high) == first {
            return None;
        }
        for _ in 0..100 {
            let middle = (low + high) * Dd::from_f64(0.5);
            if self.side(of, middle) == first {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(high)
    }

    /// Returns whether the derivative's slope along the segment jumps at a position, or the derivative
    /// itself.
    fn is_kink(&self, at: Dd) -> bool {
        let outputs = &self.derivative.blocks[0].outputs;
        let value = |k: f64| self.values(outputs, at + Dd::from_f64(k * NEAR));
        let [a, b, c, d, e, f] = [-3.0, -2.0, -1.0, 1.0, 2.0, 3.0].map(value);
        // Both sides are extrapolated to the middle, with their slopes.
        let slope = |near: Dd, next: Dd, far: Dd| {
            near * Dd::from_f64(-5.0) + next * Dd::from_f64(8.0) - far * Dd::from_f64(3.0)
        };
        (0..outputs.len()).any(|i| {
            let left = -slope(c[i], b[i], a[i]);
            let right = slope(d[i], e[i], f[i]);
            let size = left.to_f64().abs() + right.to_f64().abs();
            let scale = (value(0.0)[i].to_f64().abs() + 1e-12) * NEAR;
            (left - right).to_f64().abs() > NO_KINK * (size + scale)
        })
    }

    /// Returns whether an event changes its sign at a position.
    fn has_event(&self, at: Dd) -> bool {
        let Some(events) = self.events else {
            return false;
        };
        let values = |k: f64| {
            let near = self.at(at + Dd::from_f64(k * NEAR));
            events.evaluate(near).0
        };
        let (before, behind) = (values(-1.0), values(1.0));
        let mut pairs = before.iter().zip(&behind);
        pairs.any(|(&a, &b)| (a < Dd::ZERO) != (b < Dd::ZERO))
    }
}

/// Returns a state far from the start: beyond stops and ends. No current is beyond its limit, because no
/// run has this.
fn far(system: &SceneEquations, random: &mut Random) -> Inputs<Dd> {
    let mut at = state(system, random, true);
    for (mode, part) in at.modes.iter_mut().zip(&system.scene.layout.modes) {
        for (limit, within) in [("_upper_limit", -1.0), ("_lower_limit", 1.0)] {
            if part.name.ends_with(limit) {
                *mode = Dd::from_f64(within);
            }
        }
    }
    for parts in [&mut at.q, &mut at.v, &mut at.u] {
        for x in parts {
            *x *= Dd::from_f64(4.0 * (1.0 + random.signed()).powi(3));
        }
    }
    at
}

fn numbers(of: &[Dd]) -> Vec<f64> {
    of.iter().map(|x| x.to_f64()).collect()
}

/// The kinks found in a scene.
fn kinks(system: &SceneEquations) -> usize {
    let derivative = &system.ways(SceneFunction::Derivative)[0];
    let events = system.roles().contains(&SceneFunction::Events);
    let events = events.then(|| system.function(SceneFunction::Events));
    let all = compared(&derivative.graph, &derivative.blocks[0].outputs);
    let mut found = 0;
    for seed in 0..SEGMENTS {
        let mut random = Random(seed);
        let (from, to) = (far(system, &mut random), far(system, &mut random));
        let segment = Segment {
            derivative,
            events: events.as_ref(),
            from,
            to,
        };
        for &of in &all {
            let Some(at) = segment.change(of).filter(|&at| segment.is_kink(at)) else {
                continue;
            };
            let shown = &segment.at(at);
            assert!(
                segment.has_event(at),
                "{} (seed {seed}): no event at a kink, {:?}, q {:?}, v {:?}, u {:?}",
                system.scene.name,
                derivative.graph.node(of.0.node),
                numbers(&shown.q),
                numbers(&shown.v),
                numbers(&shown.u),
            );
            found += 1;
        }
    }
    found
}

#[test]
fn every_kink_of_the_repositorys_scenes_is_an_event() {
    let found: usize = specs().iter().map(|path| kinks(&read(path))).sum();
    assert!(found > 100, "{found} kinks found");
}

#[test]
fn every_effect_that_has_a_kink_says_where() {
    for (effect, more) in [
        (
            "it: { type: stop, joint: slide, stiffness: 90, restitution: 0.4, impact_speed: 1 }",
            "",
        ),
        (
            "it: { type: gear, joint: slide, efficiency: 0.7 }",
            "inputs: { slide: given }\n",
        ),
        (
            "it: { type: lugre, joint: slide, stiffness: 90, damping: 9, viscous: 9, kinetic: 2, static: 3, stribeck_speed: 0.1 }",
            "",
        ),
        (
            "it: { type: dc_motor, joint: slide, resistance: 0.8, torque_constant: 0.5, voltage_limit: 5, current_limit: 3, efficiency: 0.8 }",
            "",
        ),
        (
            "it: { type: dc_motor, joint: slide, resistance: 0.8, inductance: 0.1, torque_constant: 0.5, voltage_limit: 5, current_limit: 3, efficiency: 0.8 }",
            "",
        ),
    ] {
        let found = kinks(&scene(&text(&[effect], more), BLOCK));
        assert!(found > 5, "{found} kinks found: {effect}");
    }
}

/// Every effect as its example has it: a kink without an event fails here.
#[test]
fn no_effect_has_a_kink_without_an_event() {
    for (_, written) in WRITTEN {
        let declared = format!("effects:\n  extra: {written}\n");
        let called = format!("velocity_products, {}]", names(written));
        let called = ALL.replace("velocity_products]", &called);
        kinks(&scene(&called, &mechanism("", TENSOR, &declared)));
    }
}

/// An opening below 0 or above 1, a spool beyond its ends: the flow stays as it is.
#[test]
fn every_saturation_of_the_hydraulics_is_an_event() {
    let circuit = format!("it: {}", CIRCUIT.trim_start());
    let circuit = circuit.replace(
        "second: { type: orifice,",
        "second: { type: orifice, opening: tap,",
    );
    let circuit = circuit.replace("{ type: junction }", "{ type: line, volume: 3 cm^3 }");
    assert!(circuit.contains("opening: tap"));
    let effects: Vec<&str> = circuit.split("\n  ").collect();
    let found = kinks(&scene(&text(&effects, ""), BLOCK));
    assert!(found > 5, "{found} kinks found");
}

/// Second derivatives that jump are no kinks.
#[test]
fn smooth_laws_have_none() {
    for effect in [
        "it: { type: drag, at: hook, quadratic: 3 }",
        "it: { type: coulomb_smooth, joint: slide, kinetic: 2, width: 0.1 }",
        "it: { type: stribeck, joint: slide, kinetic: 1, static: 2, stribeck_speed: 0.2, width: 0.1, damping: 0.3 }",
    ] {
        assert_eq!(kinks(&scene(&text(&[effect], ""), BLOCK)), 0, "{effect}");
    }
}
