//! Locked joints of mechanisms with loops: the mechanism moves as the one in which these joints are free does while
//! they are at rest. At every joint but the locked ones the efforts are those that act: Sᵀ (r − P) = 0 with S of the
//! motions at which the locked joints are at rest, and r from the scene of the open tree.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::{Method, SceneFunction};
use bgdyn_codegen::random::Random;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_runtime::Dd;

use super::multiplier_system::solve;
use super::random_loops::{Text, noisy};
use super::references::spec;
use super::robot::{Robot, State, close, dot, largest};
use super::scenes::{EFFECTS, scene};

/// A scene with locked joints, and the same without.
struct Case<'a> {
    closed: &'a str,
    open: &'a str,
    effects: &'a str,
    /// Joints and positions, rad or m.
    locks: &'a [(&'a str, f64)],
}

/// Returns the index of a name.
fn at(names: &[String], name: &str) -> Option<usize> {
    names.iter().position(|own| own == name)
}

/// Returns the locked scene's state: random, at a closed position.
fn state(system: &SceneEquations, seed: u64) -> Inputs<Dd> {
    let mut random = Random(seed);
    let layout = &system.scene.layout;
    let mut some = |n: usize, size: f64| -> Vec<Dd> {
        let one = |_| Dd::from_f64(size * random.signed());
        (0..n).map(one).collect()
    };
    let mut q = some(layout.nq(), 1.0);
    if let Some(closure) = system.scene.mechanism.closure() {
        for p in closure.positions.iter().flatten() {
            q[p.0] = closure.samples[seed as usize + 2][p.0];
        }
    }
    layout.unit_quaternions(&mut q);
    Inputs {
        q,
        v: some(layout.nv(), 2.0),
        x: some(layout.nx(), 1e-3),
        u: some(layout.inputs.len(), 20.0),
        t: Some(Dd::ZERO),
        ..Inputs::default()
    }
}

/// Returns the positions of the open tree: those of the locked mechanism, the locks, and what the loops hold.
fn positions(case: &Case<'_>, free: &Robot, locked: &SceneEquations, own: &[Dd]) -> Vec<Dd> {
    let closure = free.mechanism.closure().expect("loops");
    let names = free.mechanism.position_names();
    let mut q = closure.start.clone();
    let mut given = Vec::new();
    for (name, value) in case.locks {
        let p = at(&names, name).expect("a joint");
        q[p] = Dd::from_f64(*value);
        given.push(p);
    }
    closure.reach(&mut q, &given).expect("closed");
    let of_locked = locked.scene.mechanism.position_names();
    for (name, value) in of_locked.iter().zip(own) {
        q[at(&names, name).expect("a joint")] = *value;
    }
    let (residuals, _) = closure.values(&closure.rows, &q);
    assert!(largest(&residuals) < 1e-24, "closed: {residuals:?}");
    q
}

/// Compares at random closed positions.
fn compare(case: &Case<'_>, what: &str) {
    let entries: Vec<String> = case
        .locks
        .iter()
        .map(|(n, x)| format!("{n}: {x:?}"))
        .collect();
    let text = format!("{}lock: {{ {} }}\n", case.effects, entries.join(", "));
    let (locked, tree) = (scene(&text, case.closed), scene(case.effects, case.open));
    let free = Robot::read(case.closed);
    let (n, own) = (free.nv(), locked.scene.mechanism.joint_names());
    let nt = Robot::read(case.open).nv();
    assert!(own.len() < n, "{what}: less mobility");
    let of_tree = tree.scene.mechanism.joint_names();
    for seed in 0..2 {
        let input = state(&locked, seed);
        let q = positions(
            case,
            &free,
            &locked,
            &input.q[..locked.scene.mechanism.nq()],
        );
        let found = locked
            .function(SceneFunction::Derivative)
            .evaluate(input.clone());
        assert_eq!(found.1, None, "{what}");
        let (found, stores) = found.0[..locked.scene.layout.nv()].split_at(own.len());
        // The rows of S for the velocities of the locked mechanism, and for the locked joints; both together
        // determine the velocities of the mechanism in which they are free.
        let mut still = State {
            q: q.clone(),
            v: vec![Dd::ZERO; n],
            a: vec![Dd::ZERO; n],
            u: vec![],
        };
        let map = still.value(&free.function(None, Method::VelocityMap));
        let row = |name: &str| {
            let j = at(&of_tree, name).expect("a joint");
            map[j * n..(j + 1) * n].to_vec()
        };
        let mut rows: Vec<Vec<Dd>> = own.iter().map(|name| row(name)).collect();
        for (name, _) in case.locks {
            rows.push(row(name));
        }
        rows.truncate(n);
        let sides = |values: &[Dd]| {
            let mut all = values.to_vec();
            all.resize(n, Dd::ZERO);
            all
        };
        still.v = solve(rows.clone(), &sides(&input.v[..own.len()]));
        let drift = still.value(&free.function(None, Method::TreeAcceleration));
        let z = |name: &String| drift[at(&of_tree, name).expect("a joint")];
        let locks: Vec<String> = case
            .locks
            .iter()
            .map(|(name, _)| (*name).to_owned())
            .collect();
        let wanted = own.iter().zip(found).map(|(name, a)| *a - z(name));
        let wanted: Vec<Dd> = wanted.chain(locks.iter().map(|name| -z(name))).collect();
        still.a = solve(rows.clone(), &wanted[..n]);
        let velocities = still.value(&free.function(None, Method::TreeVelocity));
        let accelerations = still.value(&free.function(None, Method::TreeAcceleration));
        for (name, _) in case.locks {
            let j = at(&of_tree, name).expect("a joint");
            assert!(
                velocities[j].to_f64().abs() < 1e-24,
                "{what}: {name} is at rest"
            );
            assert!(
                accelerations[j].to_f64().abs() < 1e-22,
                "{what}: {name} stays at rest"
            );
        }
        let of_input = |name: &str| {
            let mut inputs = locked.scene.layout.inputs.iter();
            inputs.position(|own| own.name == name)
        };
        let inputs = tree.scene.layout.inputs.iter();
        let u = inputs
            .map(|one| of_input(&one.name).map_or(Dd::ZERO, |k| input.u[k]))
            .collect();
        let mut moving = Inputs {
            q,
            v: [&velocities[..], &input.v[own.len()..]].concat(),
            a: [&accelerations[..], stores].concat(),
            u,
            ..input.clone()
        };
        moving.q.extend(&input.q[locked.scene.mechanism.nq()..]);
        let drives = tree
            .function(SceneFunction::Inverse)
            .evaluate(moving.clone())
            .0;
        let mut missing = drives.clone();
        for (input, &u) in tree.scene.layout.inputs.iter().zip(&moving.u) {
            missing[input.drives.expect("the drive of a joint")] -= u;
        }
        let size = largest(&drives).max(largest(&moving.u));
        for (k, name) in own.iter().enumerate() {
            let mut unit = vec![Dd::ZERO; n];
            unit[k] = Dd::ONE;
            let direction = solve(rows.clone(), &unit);
            let column: Vec<Dd> = (0..nt)
                .map(|j| dot(&map[j * n..(j + 1) * n], &direction))
                .collect();
            let sum = dot(&column, &missing[..nt]);
            close(&[sum], &[Dd::ZERO], 1e-20, size, &format!("{what}: {name}"));
        }
        close(
            &missing[nt..],
            &vec![Dd::ZERO; missing.len() - nt],
            1e-20,
            size,
            what,
        );
    }
}

/// Adds independent joints to a mechanism.
fn with_independents(text: &str, names: &str) -> String {
    format!("{text}independent: [{names}]\n")
}

#[test]
fn joints_of_planar_loops_lock() {
    let mut random = Random(500);
    let mut text = Text::planar(&mut random, "fixed", 3);
    text.connect(&mut random, "hinge", [3, 6], ([0, 0, 1000], [0; 3]));
    let open = text.open();
    for (independents, what) in [
        ("j1, j3, j4, j5", "independent"),
        ("j1, j2, j4, j5", "dependent"),
    ] {
        let closed = with_independents(&text.closed(), independents);
        let case = Case {
            closed: &closed,
            open: &open,
            effects: EFFECTS,
            locks: &[("j3", 0.07)],
        };
        compare(&case, what);
    }
}

#[test]
fn joints_of_spatial_loops_on_free_bodies_lock() {
    for (seed, root) in ["spherical", "floating"].into_iter().enumerate() {
        let mut random = Random(510 + seed as u64);
        let mut text = Text::new(&mut random, root, 3, noisy);
        text.connect(&mut random, "point", [3, 6], ([0, 0, 1000], [0; 3]));
        let (closed, open) = (text.closed(), text.open());
        let case = Case {
            closed: &closed,
            open: &open,
            effects: EFFECTS,
            locks: &[("j3", -0.03)],
        };
        compare(&case, root);
    }
}

const PLAIN: &str = "scene: 1
mechanism: excavator.yaml
effects: [gravity, inertia, velocity_products, { lift_loss: { type: viscous, joint: lift, damping: 300 } }]
inputs: { fold: given }
";

/// The rocker locks the bucket, and the bucket the rocker; slew, lift and fold move on.
#[test]
fn joints_that_the_loops_hold_are_locked_with_them() {
    let text = spec("excavator");
    let (before, rest) = text.split_once("\nloops:").expect("loops");
    let (_, frames) = rest.split_once("\nframes:").expect("frames");
    let (frames, _) = frames.split_once("\neffects:").expect("effects");
    let open = format!("{before}\nframes:{frames}\n");
    for lock in [("rocker_angle", 0.25), ("bucket_angle", -0.4)] {
        let case = Case {
            closed: &text,
            open: &open,
            effects: PLAIN,
            locks: &[lock],
        };
        compare(&case, lock.0);
        let name = format!("{}lock: {{ {}: {} }}\n", PLAIN, lock.0, lock.1);
        let locked = scene(&name, &text);
        assert!(
            locked.scene.mechanism.closure().is_none(),
            "nothing is left to close"
        );
        assert_eq!(
            locked.scene.mechanism.joint_names(),
            ["slew", "lift", "fold"]
        );
    }
}

/// With all independent joints locked nothing moves, and no loop is left.
#[test]
fn loops_of_locked_joints_are_rigid() {
    for (mechanism, lock) in [
        ("slider_crank", "crank_angle: 30 deg"),
        ("slider_crank", "slider_position: 0.6 m"),
        (
            "slider_crank",
            "crank_angle: 0.3, slider_position: 0.689536 m",
        ),
        ("five_bar", "proximal1_angle: 2, proximal2_angle: 60 deg"),
        (
            "stewart_platform",
            "px_position: 0.01, py_position: 0.02, pz_position: 0.6, yaw_angle: 0.1, pitch_angle: 0.05, platform_angle: 0",
        ),
    ] {
        let text = format!(
            "scene: 1\nmechanism: {mechanism}.yaml\neffects: [gravity, inertia]\nlock: {{ {lock} }}\n"
        );
        let system = scene(&text, &spec(mechanism));
        assert_eq!(system.scene.layout.nv(), 0, "{mechanism}: {lock}");
        assert_eq!(system.scene.layout.nq(), 0, "{mechanism}: {lock}");
    }
}
