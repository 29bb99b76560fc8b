//! Scenes with random loops against the scenes of their open trees: with all effects at dependent joints too, the drives
//! that the open tree needs for the motion of the closed mechanism are drives of the rows alone, Sᵀ (r − P) = 0.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::{Method, SceneFunction};
use bgdyn_codegen::random::Random;
use bgdyn_codegen::refusal::Refusal;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_codegen::verify::check_scene;
use bgdyn_runtime::Dd;

use super::random_loops::{Text, noisy};
use super::robot::{Robot, State, close, dot, largest};

/// Returns the scene with a mechanism.
pub fn scene(text: &str, mechanism: &str) -> SceneEquations {
    match bgdyn_codegen::read_scene(text, "scene", |_| Ok(mechanism.to_owned())) {
        Ok((system, _)) => system,
        Err(Refusal::Spec(faults)) => panic!("{}", faults.render("scene.yaml", text)),
        Err(refusal) => panic!("{refusal:?}"),
    }
}

/// Effects at joints of loops, between links, with states and with coordinates of their own.
pub const EFFECTS: &str = "scene: 1
mechanism: looped.yaml
effects:
  - gravity
  - inertia
  - velocity_products
  - losses: { type: viscous, joints: all, damping: 0.3 }
  - springs: { type: spring, joints: [j2, j5, j6], stiffness: 7, rest: 0.2 }
  - line: { type: spring, between: [body_2, body_5], stiffness: 40, rest: 0.1 }
  - brake: { type: damper, between: [body_1, body_6], damping: 3 }
  - bristles: { type: lugre, joint: j4, stiffness: 1e3, damping: 3, viscous: 3, kinetic: 1, static: 1.5, stribeck_speed: 0.1 }
  - rotors: { type: rotor, joints: [j2, j5], inertia: 1e-3, ratio: 5 }
  - elastic: { type: series_elastic, joint: j6, stiffness: 90, inertia: 1e-2, ratio: 3 }
inputs: { j1: given, j4: given, j5: given }
";

/// Compares at closed positions with random velocities, states and inputs.
fn compare(text: &Text, what: &str) {
    let (closed, open) = (text.closed(), text.open());
    let (looped, tree) = (scene(EFFECTS, &closed), scene(EFFECTS, &open));
    let (robot, of_tree) = (Robot::read(&closed), Robot::read(&open));
    let closure = robot.mechanism.closure().expect("loops").clone();
    let (n, nt) = (robot.nv(), of_tree.nv());
    let layout = &looped.scene.layout;
    assert_eq!(layout.nv() - n, tree.scene.layout.nv() - nt, "{what}");
    let derivative = looped.function(SceneFunction::Derivative);
    for k in 0..2 {
        let mut random = Random(60 + k as u64);
        let mut some = |n: usize, size: f64| -> Vec<Dd> {
            let one = |_| Dd::from_f64(size * random.signed());
            (0..n).map(one).collect()
        };
        let mut at = Inputs {
            q: robot.state(k as u64).q,
            v: some(layout.nv(), 2.0),
            x: some(layout.nx(), 1e-3),
            u: some(layout.inputs.len(), 20.0),
            t: Some(Dd::ZERO),
            ..Inputs::default()
        };
        for p in closure.positions.iter().flatten() {
            at.q[p.0] = closure.samples[5 * k + 1][p.0];
        }
        at.q.extend(some(layout.nq() - robot.mechanism.nq(), 1.0));
        let (found, refused) = derivative.evaluate(at.clone());
        assert_eq!(refused, None, "{what}");
        let (accelerations, rest) = found.split_at(layout.nv());
        let (first_order, coupled) = rest.split_at(layout.nx());
        let state = State {
            q: at.q[..robot.mechanism.nq()].to_vec(),
            v: at.v[..n].to_vec(),
            a: accelerations[..n].to_vec(),
            u: vec![],
        };
        let value = |method| -> Vec<Dd> { state.value(&robot.function(None, method)) };
        let joined = |own: Vec<Dd>, more: &[Dd]| [&own[..], more].concat();
        let moving = Inputs {
            v: joined(value(Method::TreeVelocity), &at.v[n..]),
            a: joined(value(Method::TreeAcceleration), &accelerations[n..]),
            ..at.clone()
        };
        let drives = tree
            .function(SceneFunction::Inverse)
            .evaluate(moving.clone())
            .0;
        let mut missing = drives.clone();
        for (input, &u) in tree.scene.layout.inputs.iter().zip(&at.u) {
            missing[input.drives.expect("the drive of a joint")] -= u;
        }
        let map = value(Method::VelocityMap);
        let column = |k: usize| map.iter().skip(k).step_by(n).copied().collect::<Vec<Dd>>();
        let sums: Vec<Dd> = (0..n).map(|k| dot(&column(k), &missing[..nt])).collect();
        let size = largest(&drives).max(largest(&at.u));
        close(
            &sums,
            &vec![Dd::ZERO; n],
            1e-21,
            size,
            &format!("{what}: Sᵀ (r − P)"),
        );
        let own = &missing[nt..];
        close(
            own,
            &vec![Dd::ZERO; own.len()],
            1e-21,
            size,
            &format!("{what}: own stores"),
        );
        // Rates of first-order states and of positions.
        let of_open = tree
            .function(SceneFunction::Derivative)
            .evaluate(moving.clone())
            .0;
        let open_nv = tree.scene.layout.nv();
        let wanted = &of_open[open_nv..open_nv + layout.nx()];
        close(
            first_order,
            wanted,
            1e-24,
            largest(wanted),
            &format!("{what}: ẋ"),
        );
        let rates = of_tree.rates(&state.q, &moving.v[..nt]);
        let wanted: Vec<Dd> = layout.coupled().into_iter().map(|p| rates[p]).collect();
        close(
            coupled,
            &wanted,
            1e-23,
            largest(&rates),
            &format!("{what}: q̇"),
        );
    }
    let roles = looped.roles_with(true, false);
    let functions: Vec<_> = roles
        .into_iter()
        .map(|role| looped.function(role))
        .collect();
    let differences = check_scene(&looped, &functions);
    assert!(
        differences.is_empty(),
        "{what}: {}",
        bgdyn_codegen::verify::explain(&differences)
    );
}

#[test]
fn effects_act_in_planar_loops_as_in_the_open_tree() {
    let mut random = Random(500);
    let mut text = Text::planar(&mut random, "fixed", 3);
    text.connect(&mut random, "hinge", [3, 6], ([0, 0, 1000], [0; 3]));
    compare(&text, "planar");
}

#[test]
fn effects_act_in_spatial_loops_on_free_bodies_as_in_the_open_tree() {
    for (seed, root) in ["spherical", "floating"].into_iter().enumerate() {
        let mut random = Random(510 + seed as u64);
        let mut text = Text::new(&mut random, root, 3, noisy);
        text.connect(&mut random, "point", [3, 6], ([0, 0, 1000], [0; 3]));
        compare(&text, root);
    }
}
