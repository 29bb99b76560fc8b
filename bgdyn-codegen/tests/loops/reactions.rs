//! Forces and moments at the places of loops and at the joints: each link is a free body, whose motion follows from
//! poses alone; references with multipliers; a four-bar by hand.

use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::free_bodies::{assert_free_bodies, three};
use super::free_body_cases::{FreeBodyCase, of_other_types, spatial, with_rows_left_out};
use super::motion_of_tree::motion_of_tree;
use super::references::{joints, names, numbers, reference, spec};
use super::robot::{Robot, State, Way, close, dot, largest};

const WAYS: [Way; 2] = [None, Some("subspaces")];

/// The loads of a mechanism with loops at one state.
struct Loads {
    /// Of the open tree.
    motion: State<Dd>,
    reactions: Vec<Dd>,
    joints: Vec<Dd>,
    /// By velocity of the open tree.
    efforts: Vec<Dd>,
}

fn loads(robot: &Robot, way: Way, state: &State<Dd>) -> Loads {
    let (motion, reactions) = motion_of_tree(robot, way, state);
    let mut efforts = vec![Dd::ZERO; motion.v.len()];
    let closure = robot.mechanism.closure().expect("loops");
    for (j, &p) in closure.independents.iter().zip(&motion.u) {
        efforts[j.0] = p;
    }
    Loads {
        joints: state.value(&robot.function(way, Method::JointReactions)),
        reactions,
        motion,
        efforts,
    }
}

fn compare(case: &FreeBodyCase) {
    let text = &case.text;
    let (tree, robot) = (Robot::read(&text.open()), Robot::read(&text.closed()));
    let closure = robot.mechanism.closure().expect("loops");
    for seed in 0..2 {
        let mut state = robot.state(seed);
        for p in closure.positions.iter().flatten() {
            state.q[p.0] = closure.samples[5 * seed as usize + 1][p.0];
        }
        for way in WAYS {
            let found = loads(&robot, way, &state);
            let given = case.loads(&tree, &found.motion, &found.reactions);
            let what = format!("{}, state {seed}, {way:?}", case.what);
            let all = (&found.joints[..], &given[..], &found.efforts[..]);
            assert_free_bodies(&tree, &found.motion, all, 1e-17, &what);
        }
    }
}

#[test]
fn links_of_spatial_loops_are_free_bodies() {
    spatial().iter().for_each(compare);
}

#[test]
fn links_of_loops_with_rows_left_out_are_free_bodies() {
    with_rows_left_out().iter().for_each(compare);
}

#[test]
fn links_of_loops_of_other_types_are_free_bodies() {
    of_other_types().iter().for_each(compare);
}

/// The multipliers of the references are forces on the link of place a in fixed axes.
#[test]
fn balls_of_parallel_robots_carry_the_forces_of_the_references() {
    for (name, of) in [
        ("delta_robot", "delta_robot_static"),
        ("stewart_platform", "stewart_platform_static"),
    ] {
        let (robot, file) = (Robot::read(&spec(name)), reference(of));
        let (_, independent) = joints(&robot, &file);
        let closed = robot.graph.closed.as_deref().expect("loops");
        // Poses of the links on which the places a are.
        let tree = bgdyn_codegen::formulation::Prepared::new(&closed.tree);
        let links = closed
            .closure
            .loops
            .iter()
            .map(|one| one.links[0].expect("a link"));
        let poses = links.map(|link| {
            let name = &closed.tree.frames[link.0].name;
            let site = closed.tree.sites.iter().position(|site| site.name == *name);
            let method = Method::Pose(bgdyn_codegen::bond_graph::SiteId(site.expect("a site")));
            let literal = bgdyn_codegen::formulation::specification();
            literal.function(&tree, method).expect("a pose")
        });
        let poses: Vec<_> = poses.collect();
        let actuated = names(&file["actuated"]);
        let columns = joints(&robot, &file).0;
        for (k, sample) in file["states"]
            .as_array()
            .expect("states")
            .iter()
            .enumerate()
        {
            let forward = &sample["forward"];
            let dd = |x: &serde_json::Value| -> Vec<Dd> {
                numbers(x).into_iter().map(Dd::from_f64).collect()
            };
            let (mut q, v) = (dd(&sample["q"]), dd(&sample["qd"]));
            let drive = dd(&forward["actuator_efforts"]);
            closed.closure.close(&mut q);
            let map = closed.closure.velocity_map(&q).expect("a regular position");
            let drives: Vec<Dd> = columns
                .iter()
                .map(|column| {
                    let k = actuated.iter().position(|name| name == column);
                    k.map_or(Dd::ZERO, |k| drive[k])
                })
                .collect();
            let u: Vec<Dd> = independent.iter().map(|&i| v[i]).collect();
            // Drives may be at dependent joints: efforts on all joints of the tree.
            let state = State {
                q,
                v: map.iter().map(|row| dot(row, &u)).collect(),
                a: vec![],
                u: drives.clone(),
            };
            let found: Vec<Dd> = state.value(&robot.function(None, Method::ConstrainedDynamics));
            let lambda = &found[columns.len()..];
            let expected = dd(&forward["lambda"]);
            let size = largest(&expected).max(largest(&drive));
            let compared = |forces: &[[Dd; 3]], what: &str| {
                for (l, (pose, force)) in poses.iter().zip(forces).enumerate() {
                    let pose: Vec<Dd> = state.value(pose);
                    let world = three(|i| dot(&pose[3 * i..3 * i + 3], force));
                    let wanted: Vec<Dd> = (0..3).map(|i| -expected[3 * l + i]).collect();
                    let what = format!("{name}, state {k}, ball {l}: {what}");
                    close(&world, &wanted, 1e-11, size, &what);
                }
            };
            let in_link_axes = |(l, lambda): (usize, &[Dd])| {
                let axes = closed.closure.loops[l].chain.start.rotation;
                three(|i| dot(&axes.0[i], lambda))
            };
            let forces: Vec<[Dd; 3]> = lambda.chunks(3).enumerate().map(in_link_axes).collect();
            assert_eq!(forces.len(), poses.len());
            compared(&forces, "multipliers");
            let others = (0..columns.len()).filter(|j| !independent.contains(j));
            if others.map(|j| drives[j]).any(|drive| drive != Dd::ZERO) {
                assert_eq!(name, "stewart_platform", "its legs depend on the platform");
                continue;
            }
            let state = State {
                v: u,
                u: independent.iter().map(|&i| drives[i]).collect(),
                ..state.clone()
            };
            let found: Vec<Dd> = state.value(&robot.function(None, Method::Reactions));
            let loads = found[robot.nv()..].chunks(6);
            let forces: Vec<[Dd; 3]> = loads.clone().map(|load| three(|i| load[i])).collect();
            compared(&forces, "reactions");
            let moments: Vec<Dd> = loads.flat_map(|load| load[3..].to_vec()).collect();
            assert_eq!(largest(&moments), 0.0, "a ball carries no moment");
        }
    }
}

/// A four-bar held at rest by its crank: moments of the rocker about its pivot, and of the coupler about its pin.
#[test]
fn the_pin_of_a_four_bar_at_rest_carries_what_statics_says() {
    let robot = Robot::read(&spec("four_bar"));
    let closure = robot.mechanism.closure().expect("loops");
    for sample in [0, 3, 7] {
        let q = closure.samples[sample].clone();
        let [crank, coupler, rocker] = [q[0], q[0] + q[1], q[2]].map(Dd::to_f64);
        let still = State {
            q,
            v: vec![Dd::ZERO],
            a: vec![Dd::ZERO],
            u: vec![],
        };
        let found = loads(&robot, None, &still);
        // Points from the pivot of the crank, m; the rocker's pivot is 0.35 m ahead.
        let along = |angle: f64, length: f64| [length * angle.cos(), length * angle.sin()];
        let sum = |a: [f64; 2], b: [f64; 2]| [a[0] + b[0], a[1] + b[1]];
        let elbow = along(crank, 0.12);
        let weight = |m: f64| m * 9.81;
        // The force F on the rocker at the pin: r × F = x m g about each pivot, with the opposite F on the coupler.
        let (r, s) = (along(rocker, 0.3), along(coupler, 0.4));
        let (right_r, right_s) = (
            along(rocker, 0.15)[0] * weight(0.7),
            -(along(coupler, 0.2)[0] * weight(0.9)),
        );
        let det = -r[1] * s[0] + s[1] * r[0];
        let x = (right_r * s[0] - right_s * r[0]) / det;
        let y = (-r[1] * right_s + s[1] * right_r) / det;
        // In the axes of the coupler.
        let (cos, sin) = (coupler.cos(), coupler.sin());
        let wanted = [x * cos + y * sin, -x * sin + y * cos, 0.0, 0.0, 0.0, 0.0];
        for (k, (found, wanted)) in found.reactions.iter().zip(wanted).enumerate() {
            let off = (found.to_f64() - wanted).abs();
            assert!(
                off < 1e-12,
                "sample {sample}, {k}: {found:?} against {wanted}"
            );
        }
        // The crank's pivot carries the crank, the coupler, and the opposite force of the pin.
        let base = along(-crank, 1.0);
        let up = weight(0.4 + 0.9) + y;
        let force = [x * base[0] - up * base[1], x * base[1] + up * base[0]];
        let torque = along(crank, 0.06)[0] * weight(0.4)
            + sum(elbow, along(coupler, 0.2))[0] * weight(0.9)
            + (sum(elbow, s)[0] * y - sum(elbow, s)[1] * x);
        let wanted = [force[0], force[1], 0.0, 0.0, 0.0, torque];
        for (k, (found, wanted)) in found.joints.iter().zip(wanted).enumerate() {
            let off = (found.to_f64() - wanted).abs();
            assert!(
                off < 1e-12,
                "sample {sample}, crank {k}: {found:?} against {wanted}"
            );
        }
        assert!((found.efforts[0].to_f64() - torque).abs() < 1e-12);
    }
}

/// Base parameters move masses across joints; loads are those of the links nevertheless, in `f64` to 64 roundings.
#[test]
fn loads_do_not_depend_on_where_base_parameters_are() {
    let ways: [Way; 4] = [None, Some("recursion"), Some("subspaces"), Some("literal")];
    for name in ["four_bar", "slider_crank", "five_bar"] {
        let robot = Robot::read(&spec(name));
        let closure = robot.mechanism.closure().expect("loops");
        for seed in 0..4 {
            let mut state = robot.state(seed);
            state.q.clone_from(&closure.samples[seed as usize]);
            for method in [Method::Reactions, Method::JointReactions] {
                let exact: Vec<Dd> = state.value(&robot.function(Some("literal"), method));
                let size = largest(&exact);
                // The recursion knows no loads at joints.
                let knows = |way: &Way| method == Method::Reactions || *way != Some("recursion");
                for way in ways.into_iter().filter(knows) {
                    let function = robot.function(way, method);
                    let found: Vec<Dd> = state.value(&function);
                    close(
                        &found,
                        &exact,
                        1e-26,
                        size,
                        &format!("{name}, {way:?}, {method:?}"),
                    );
                    let short: Vec<f64> = state.rounded().value(&function);
                    for (found, exact) in short.iter().zip(&exact) {
                        let off = (found - exact.to_f64()).abs();
                        let allowed = 64.0 * f64::EPSILON * size;
                        assert!(
                            off <= allowed,
                            "{name}, {way:?}, {method:?}: {off:e} of {size}"
                        );
                    }
                }
            }
        }
    }
}
