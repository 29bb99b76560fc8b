//! Computed torques at joints in loops: at random states the followed joints have the accelerations that their targets
//! demand, by the positions of the open tree alone.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::SceneFunction;
use bgdyn_codegen::refusal::Refusal;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_codegen::{bond_graph, random::Random};
use bgdyn_runtime::Dd;

use super::free_bodies::extrapolated;
use super::random_loops::Text;
use super::references::spec;
use super::robot::{dot, largest};

const ALL: &str = "gravity, inertia, velocity_products";
/// Amplitude, frequency in Hz, offset; stiffness, damping.
const TARGET: [f64; 3] = [0.25, 0.75, 0.125];
const GAINS: [f64; 2] = [90.0, 12.0];

fn read(mechanism: &str, scene: &str) -> Result<SceneEquations, Refusal> {
    // The name is that of another file.
    let lines = mechanism.lines().filter(|line| !line.starts_with("name:"));
    let mechanism = lines.collect::<Vec<_>>().join("\n");
    let read = bgdyn_codegen::read_scene(scene, "scene", |_| Ok(mechanism.clone()));
    read.map(|(system, _)| system)
}

/// Returns a scene in which these joints follow the target.
fn scene(followed: &[&str], effects: &str, inputs: &str) -> String {
    let [amplitude, frequency, offset] = TARGET;
    let target = format!(
        "{{ harmonic: {{ amplitude: {amplitude}, frequency: {frequency} Hz, offset: {offset} }} }}"
    );
    let [stiffness, damping] = GAINS;
    let law = format!(
        "{{ computed_torque: {{ target: {target}, stiffness: {stiffness}, damping: {damping} }} }}"
    );
    let entries: Vec<String> = followed.iter().map(|j| format!("  {j}: {law}\n")).collect();
    format!(
        "scene: 1\nmechanism: own.yaml\neffects: [{effects}]\ninputs:\n{}{inputs}",
        entries.concat()
    )
}

/// Returns the derivative of a function of positions along their rates, by Richardson's extrapolation.
fn rate(of: impl Fn(Dd) -> Vec<Dd>) -> Vec<Dd> {
    const LEVELS: usize = 7;
    let mut table: Vec<Vec<Dd>> = Vec::new();
    let mut h = Dd::from_f64(1.0 / 2048.0);
    for _ in 0..LEVELS {
        let (after, before) = (of(h), of(-h));
        let halved = Dd::from_f64(0.5) / h;
        table.push(
            after
                .iter()
                .zip(&before)
                .map(|(&x, &y)| (x - y) * halved)
                .collect(),
        );
        h *= Dd::from_f64(0.5);
    }
    extrapolated(table)
}

/// Asserts at random states that the followed joints have the accelerations of the law. Their velocities are S u; their
/// accelerations S u̇ + Ṡ u, with Ṡ u from differences of closed positions.
fn assert_followed(mechanism: &str, scene: &str, followed: &[&str], what: &str) {
    let system = read(mechanism, scene).unwrap_or_else(|refusal| panic!("{what}: {refusal:?}"));
    let closure = system.scene.mechanism.closure().expect("loops");
    let names = system.scene.mechanism.open().joint_names();
    let layout = &system.scene.layout;
    let functions = [SceneFunction::Inputs, SceneFunction::Derivative].map(|f| system.function(f));
    let mut random = Random(7);
    for k in 0..4 {
        let mut some = |n: usize, size: f64| -> Vec<Dd> {
            (0..n)
                .map(|_| Dd::from_f64(size * random.signed()))
                .collect()
        };
        let mut state = Inputs {
            q: closure.samples[2 * k].clone(),
            v: some(layout.nv(), 1.5),
            u: some(layout.inputs.len(), 2.0),
            t: Some(Dd::from_f64(0.3125 * k as f64)),
            ..Inputs::default()
        };
        state.u = functions[0].evaluate(state.clone()).0;
        let (found, refused) = functions[1].evaluate(state.clone());
        assert_eq!(refused, None, "{what}, state {k}");
        let accelerations = &found[..layout.nv()];
        let map = closure.velocity_map(&state.q).expect("a regular position");
        let velocities: Vec<Dd> = map.iter().map(|row| dot(row, &state.v)).collect();
        // Along the motion at constant u: independent positions move straight, dependent ones close.
        let along = |h: Dd| -> Vec<Dd> {
            let mut q = state.q.clone();
            for (j, p) in closure.positions.iter().enumerate() {
                if let Some(p) = p {
                    q[p.0] += velocities[j] * h;
                }
            }
            assert!(closure.close(&mut q), "{what}");
            let map = closure.velocity_map(&q).expect("a regular position");
            map.iter().map(|row| dot(row, &state.v)).collect()
        };
        let own = rate(along);
        let t = state.t.expect("a time");
        let [amplitude, frequency, offset] = TARGET.map(Dd::from_f64);
        let omega = Dd::PI * Dd::from_f64(2.0) * frequency;
        let (sin, cos) = (omega * t).sin_cos();
        let [stiffness, damping] = GAINS.map(Dd::from_f64);
        for joint in followed {
            let j = names
                .iter()
                .position(|name| name == joint)
                .expect("a joint");
            let p = layout.positions.iter().position(|p| p.name == *joint);
            let q = state.q[p.expect("a position")];
            let wanted = -(omega * omega * amplitude * sin)
                + (omega * amplitude * cos - velocities[j]) * damping
                + (offset + amplitude * sin - q) * stiffness;
            let moved = dot(&map[j], accelerations) + own[j];
            let off = (moved - wanted).to_f64().abs();
            let size = largest(accelerations).max(largest(&own));
            assert!(
                off <= 1e-17 * size,
                "{what}, state {k}, {joint}: {off:e} of {size}"
            );
        }
    }
}

#[test]
fn joints_of_planar_loops_follow_their_targets() {
    for (name, followed) in [
        ("slider_crank", &["slider_position"][..]),
        ("slider_crank", &["rod_angle"]),
        ("four_bar", &["rocker_angle"]),
        ("five_bar", &["distal1_angle", "distal2_angle"]),
        ("five_bar", &["proximal1_angle", "distal2_angle"]),
        ("five_bar", &["distal1_angle", "proximal2_angle"]),
    ] {
        let scene = scene(followed, ALL, "");
        assert_followed(
            &spec(name),
            &scene,
            followed,
            &format!("{name}, {followed:?}"),
        );
    }
}

/// With friction and springs at joints in loops, and without velocity products, whose accelerations remain.
#[test]
fn effects_are_compensated() {
    let followed = ["distal1_angle", "distal2_angle"];
    let effects = "gravity, inertia, friction: { type: viscous, joint: distal1_angle, damping: 0.4 }, \
        spring: { type: spring, joint: proximal1_angle, stiffness: 3 N*m/rad }";
    let with = format!("{effects}, velocity_products");
    for effects in [effects, &with] {
        let scene = scene(&followed, effects, "");
        assert_followed(&spec("five_bar"), &scene, &followed, effects);
    }
}

/// Six legs that follow determine six velocities of the platform; arms that follow, with the platform independent.
#[test]
fn joints_of_parallel_robots_follow_their_targets() {
    let legs = super::actuated::legs();
    let legs: Vec<&str> = legs.iter().map(String::as_str).collect();
    assert_followed(
        &spec("stewart_platform"),
        &scene(&legs, ALL, ""),
        &legs,
        "legs",
    );
    let [(_, delta, _), _] = super::actuated::parallel_robots();
    let arms = ["arm1_angle", "arm2_angle", "arm3_angle"];
    assert_followed(&delta, &scene(&arms, ALL, ""), &arms, "arms");
}

/// Random loops of every type, and the joint that carries them.
#[test]
fn joints_of_random_loops_follow_their_targets() {
    for (seed, kind) in ["hinge", "slider", "weld", "universal", "point"]
        .into_iter()
        .enumerate()
    {
        let mut random = Random(1700 + seed as u64);
        let text = Text::of_type(&mut random, "continuous, axis: [1, -2, 3]", kind).closed();
        let (mechanism, _) = bgdyn_codegen::read(&text, None);
        let mechanism = mechanism.expect("a mechanism");
        let closure = mechanism.closure().expect("loops");
        let open = mechanism.open();
        let names = open.joint_names();
        let graph = bond_graph::build(&mechanism);
        let own: Vec<&str> = graph.coordinates.iter().map(|c| c.name.as_str()).collect();
        let dependents: Vec<_> = closure.dependents().collect();
        // The root moves none of them, and must be followed too: its acceleration would move them.
        let ways = closure.movers(&dependents).len();
        assert_eq!(
            ways + 1,
            own.len(),
            "{kind}: the root is outside of the loop"
        );
        let all: Vec<&str> = dependents.iter().map(|j| names[j.0].as_str()).collect();
        for dependents in [&all[..ways.min(all.len())], &all[1..ways.min(all.len())]] {
            let others = own[1..].iter().take(ways - dependents.len());
            let followed = dependents.iter().chain(others).chain([&own[0]]);
            let followed: Vec<&str> = followed.copied().collect();
            let what = format!("{kind}, {followed:?}");
            assert_followed(&text, &scene(&followed, ALL, ""), &followed, &what);
        }
    }
}

#[test]
fn joints_that_do_not_determine_the_motion_are_refused() {
    for (mechanism, followed, words) in [
        (
            "five_bar",
            &["distal1_angle"][..],
            "`proximal1_angle`, `proximal2_angle` move it, 2 velocities",
        ),
        (
            "five_bar",
            &["distal1_angle", "distal2_angle", "proximal1_angle"],
            "leave 1 of them out",
        ),
        (
            "slider_crank",
            &["slider_position", "crank_angle"],
            "no independent joint that is not followed itself move",
        ),
        (
            "stewart_platform",
            &["leg1_length_position", "px_position"],
            "follow 4 more",
        ),
    ] {
        let Err(Refusal::Spec(faults)) = read(&spec(mechanism), &scene(followed, ALL, "")) else {
            panic!("{followed:?}: accepted");
        };
        let [fault] = &faults.0[..] else {
            panic!("{followed:?}: {:?}", faults.0)
        };
        assert_eq!(fault.rule, "followed-joints");
        let text = format!("{fault:?}");
        assert!(text.contains(words), "{text}");
    }
}

/// A parallelogram on a rod of the five-bar: its crank turns as the rod does, so that both together leave one of two
/// velocities open.
#[test]
fn joints_that_move_alike_are_refused() {
    let links = "
  - name: side
    parent: proximal1
    joint: { name: side_angle, type: continuous, origin: { xyz: [0.25, 0.12, 0] } }
    mass: 0.1
  - name: coupler
    parent: side
    joint: { name: coupler_angle, type: continuous, origin: { xyz: [0.1, 0, 0] } }
    mass: 0.1

loops:
  - name: side_pin
    type: hinge
    a: { link: coupler, origin: { xyz: [0.12, 0, 0] } }
    b: { link: distal1, origin: { xyz: [0.1, 0, 0] } }
    near: { side_angle: -1.27, coupler_angle: -0.3 }
";
    let text = spec("five_bar").replacen("\nloops:\n", links, 1);
    let followed = ["distal1_angle", "side_angle"];
    let refused = read(&text, &scene(&followed, ALL, "")).err();
    let refused = format!("{:?}", refused.expect("one velocity is left open"));
    assert!(
        refused.contains("determine 1 of the 2 independent velocities"),
        "{refused}"
    );
    let followed = ["distal2_angle", "side_angle"];
    assert_followed(
        &text,
        &scene(&followed, ALL, ""),
        &followed,
        "parallelogram",
    );
}

/// The Jacobian contains the controller's part.
#[test]
fn the_jacobian_contains_the_controllers() {
    let scene = scene(&["slider_position"], ALL, "");
    let system = read(&spec("slider_crank"), &scene).expect("a scene");
    let jacobian = system.function(SceneFunction::Jacobian);
    let closure = system.scene.mechanism.closure().expect("loops");
    let layout = &system.scene.layout;
    let state = Inputs {
        q: closure.samples[1].clone(),
        v: vec![Dd::from_f64(0.4)],
        u: vec![Dd::ZERO; layout.inputs.len()],
        t: Some(Dd::from_f64(0.2)),
        ..Inputs::default()
    };
    let (found, refused) = jacobian.evaluate(state.clone());
    assert_eq!(refused, None);
    let functions = [SceneFunction::Inputs, SceneFunction::Derivative].map(|f| system.function(f));
    let acceleration = |v: Dd| {
        let mut state = state.clone();
        state.v = vec![v];
        state.u = functions[0].evaluate(state.clone()).0;
        functions[1].evaluate(state).0
    };
    let slope = rate(|h| acceleration(state.v[0] + h));
    let rows = slope.len();
    let column = &found[layout.nq() * rows..(layout.nq() + 1) * rows];
    let size = largest(&slope);
    for (x, y) in column.iter().zip(&slope) {
        let off = (*x - *y).to_f64().abs();
        assert!(off <= 1e-15 * size, "{off:e} of {size}");
    }
}

/// A model of the controllers with loops and other effects: the efforts are those of its own scene.
#[test]
fn a_model_of_the_controllers_may_have_loops() {
    let followed = ["distal1_angle", "proximal2_angle"];
    let believed = "gravity, inertia, velocity_products, \
        wire: { type: spring, joint: proximal1_angle, stiffness: 7 N*m/rad }";
    let model = format!("controller_model: {{ effects: [{believed}] }}\n");
    let effects = format!("{ALL}, grease: {{ type: viscous, joint: distal1_angle, damping: 0.4 }}");
    let mechanism = spec("five_bar");
    let read = |text: String| {
        read(&mechanism, &text).unwrap_or_else(|refusal| panic!("{text}: {refusal:?}"))
    };
    let with = read(scene(&followed, &effects, "") + &model);
    let alone = read(scene(&followed, believed, ""));
    let own = read(scene(&followed, &effects, ""));
    let closure = alone.scene.mechanism.closure().expect("loops");
    for (k, q) in closure.samples.iter().enumerate().take(4) {
        let state = Inputs {
            q: q.clone(),
            v: vec![Dd::from_f64(0.75), Dd::from_f64(-1.25)],
            u: vec![Dd::ZERO; 2],
            t: Some(Dd::from_f64(0.25)),
            ..Inputs::default()
        };
        let efforts = |system: &SceneEquations| {
            let inputs = system.function(SceneFunction::Inputs);
            inputs.evaluate(state.clone()).0
        };
        let (found, wanted, other) = (efforts(&with), efforts(&alone), efforts(&own));
        for i in 0..2 {
            let off = (found[i] - wanted[i]).to_f64().abs();
            assert!(off <= 1e-24 * largest(&wanted), "state {k}, {i}: {off:e}");
        }
        assert!((found[0] - other[0]).to_f64().abs() > 1e-3, "state {k}");
    }
}
