//! Efforts of actuated joints that are not the independent ones: against reference solutions, against a pseudo-inverse.

use bgdyn_codegen::formulation::{self, Prepared};
use bgdyn_codegen::method::Method;
use bgdyn_runtime::Dd;

use super::multiplier_system::solve;
use super::references::{joints, names, numbers, reference, spec};
use super::robot::{Robot, State, Way, close, dot, largest};

const WAYS: [Way; 3] = [None, Some("subspaces"), Some("literal")];

/// A spec of `specs/loops` with other independent joints, and with actuated ones.
pub fn actuated(name: &str, independent: &[&str], actuated: &[&str]) -> String {
    let text = spec(name);
    let lines = text
        .lines()
        .filter(|line| !line.starts_with("independent:"));
    let lines: Vec<&str> = lines.collect();
    let [independent, actuated] = [independent, actuated].map(|names| names.join(", "));
    let independent = match independent.as_str() {
        "" => String::new(),
        names => format!("independent: [{names}]\n"),
    };
    format!(
        "{}\n{independent}actuated: [{actuated}]\n",
        lines.join("\n")
    )
}

pub fn legs() -> Vec<String> {
    (1..=6).map(|k| format!("leg{k}_length_position")).collect()
}

/// The Delta robot with the positions of its platform as independent ones, and the Stewart platform, as in their
/// references.
pub fn parallel_robots() -> [(&'static str, String, f64); 2] {
    let arms = ["arm1_angle", "arm2_angle", "arm3_angle"];
    let platform = ["px_position", "py_position", "platform_position"];
    let legs = legs();
    let legs: Vec<&str> = legs.iter().map(String::as_str).collect();
    let delta = actuated("delta_robot", &platform, &arms);
    let stewart = actuated("stewart_platform", &[], &legs);
    [
        ("delta_robot", delta, 1e-11),
        ("stewart_platform", stewart, 1e-11),
    ]
}

pub fn counted(robot: &Robot) -> usize {
    let closure = robot.mechanism.closure().expect("loops");
    closure.drives().expect("other joints").joints.len()
}

#[test]
fn parallel_robots_are_driven_as_with_multipliers() {
    for (name, text, tolerance) in parallel_robots() {
        let (robot, file) = (Robot::read(&text), reference(&format!("{name}_static")));
        let (all, independent) = joints(&robot, &file);
        let closed = robot.graph.closed.as_deref().expect("loops");
        let of_tree = closed.tree.coordinates.iter();
        let of_tree: Vec<&str> = of_tree.map(|c| c.name.as_str()).collect();
        let drives = closed.closure.drives().expect("other joints");
        let driven = drives.joints.iter().map(|j| of_tree[j.0]);
        let listed = names(&file["actuated"]);
        assert!(
            driven.eq(listed
                .iter()
                .map(|name| of_tree[all.iter().position(|x| x == name).unwrap()])),
            "{name}: the order of the file"
        );
        let states = file["states"].as_array().expect("states").iter();
        assert!(states.len() >= 20);
        for (k, sample) in states.enumerate() {
            let (q, v) = (numbers(&sample["q"]), numbers(&sample["qd"]));
            let (inverse, forward) = (&sample["inverse"], &sample["forward"]);
            let state = State {
                q,
                v: independent.iter().map(|&i| v[i]).collect(),
                a: numbers(&inverse["qdd_independent"]),
                u: numbers(&forward["actuator_efforts"]),
            };
            let wanted = numbers(&inverse["actuator_efforts"]);
            let qdd = numbers(&forward["qdd"]);
            let moved: Vec<f64> = independent.iter().map(|&i| qdd[i]).collect();
            for way in [None, Some("recursion"), Some("subspaces"), Some("literal")] {
                let number = wanted.len();
                let found = state.value(&robot.function(way, Method::ActuatedInverse(number)));
                near(
                    &found,
                    &wanted,
                    tolerance,
                    &format!("{name}, {k}, {way:?}: efforts"),
                );
                let found = state.value(&robot.function(way, Method::ActuatedForward(number)));
                near(
                    &found,
                    &moved,
                    tolerance,
                    &format!("{name}, {k}, {way:?}: accelerations"),
                );
            }
        }
    }
}

fn near(found: &[f64], wanted: &[f64], tolerance: f64, what: &str) {
    assert_eq!(found.len(), wanted.len(), "{what}");
    let size = wanted.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    for (x, y) in found.iter().zip(wanted) {
        let off = (x - y).abs();
        assert!(off <= tolerance * size, "{what}: off by {off:e} of {size}");
    }
}

/// Forces of the balls, in fixed axes, under efforts of the actuated joints.
#[test]
fn balls_of_parallel_robots_carry_the_multipliers_of_the_references() {
    for (name, text, tolerance) in parallel_robots() {
        let (robot, file) = (Robot::read(&text), reference(&format!("{name}_static")));
        let (_, independent) = joints(&robot, &file);
        let closed = robot.graph.closed.as_deref().expect("loops");
        let prepared = Prepared::new(&closed.tree);
        let pose_of = |link: usize| {
            let name = &closed.tree.frames[link].name;
            let site = closed.tree.sites.iter().position(|site| site.name == *name);
            let site = bgdyn_codegen::bond_graph::SiteId(site.expect("a site"));
            let literal = formulation::specification();
            literal
                .function(&prepared, Method::Pose(site))
                .expect("a pose")
        };
        let loops = closed.closure.loops.iter();
        let poses: Vec<_> = loops
            .map(|one| pose_of(one.links[0].expect("a link").0))
            .collect();
        let number = counted(&robot);
        for (k, sample) in file["states"].as_array().unwrap().iter().enumerate() {
            let forward = &sample["forward"];
            let v = numbers(&sample["qd"]);
            let state = State {
                q: numbers(&sample["q"]),
                v: independent.iter().map(|&i| v[i]).collect(),
                a: vec![],
                u: numbers(&forward["actuator_efforts"]),
            };
            let wanted = numbers(&forward["lambda"]);
            for way in WAYS {
                let found = state.value(&robot.function(way, Method::ActuatedReactions(number)));
                let loads = found[robot.nv()..].chunks(6);
                let mut forces = Vec::new();
                for (load, pose) in loads.zip(&poses) {
                    let pose: Vec<f64> = state.value(pose);
                    let turned = |i: usize| (0..3).map(|j| pose[3 * i + j] * load[j]).sum::<f64>();
                    // The file has the force on the link of place a.
                    forces.extend((0..3).map(|i| -turned(i)));
                    assert!(load[3..].iter().all(|x| *x == 0.0), "a ball: no moment");
                }
                near(
                    &forces,
                    &wanted,
                    tolerance,
                    &format!("{name}, {k}, {way:?}: forces"),
                );
            }
        }
    }
}

/// Returns A at a state: the rows of S of the actuated joints, transposed; S is the literal one.
pub fn actuator_matrix(robot: &Robot, state: &State<Dd>) -> Vec<Vec<Dd>> {
    let closure = robot.mechanism.closure().expect("loops");
    let map: Vec<Dd> = state.value(&robot.function(Some("literal"), Method::VelocityMap));
    let n = robot.nv();
    let drives = closure.drives().expect("other joints");
    let row = |k: usize| {
        let joints = drives.joints.iter();
        joints.map(|j| map[j.0 * n + k]).collect()
    };
    (0..n).map(row).collect()
}

/// Returns E² Aᵀ (A E² Aᵀ)⁻¹ f, by elimination with complete pivoting.
fn least_weighted(a: &[Vec<Dd>], limits: &[f64], f: &[Dd]) -> Vec<Dd> {
    let limits = limits.iter().map(|&e| Dd::from_f64(e));
    let squares: Vec<Dd> = limits.map(|e| e * e).collect();
    let product = |x: &[Dd], y: &[Dd]| {
        let terms = x.iter().zip(y).zip(&squares);
        terms.fold(Dd::ZERO, |sum, ((&x, &y), &w)| sum + x * y * w)
    };
    let normal = a
        .iter()
        .map(|x| a.iter().map(|y| product(x, y)).collect())
        .collect();
    let solved = solve(normal, f);
    let column = |j: usize| a.iter().map(|row| row[j]).collect::<Vec<Dd>>();
    (0..squares.len())
        .map(|j| squares[j] * dot(&column(j), &solved))
        .collect()
}

/// Compares efforts at random positions: A P is the effort along the independent velocities by the literal sum, and P
/// is the least of them; forward dynamics returns to the accelerations.
fn compare(text: &str, limits: &[f64], what: &str) {
    let robot = Robot::read(text);
    let closure = robot.mechanism.closure().expect("loops");
    let number = counted(&robot);
    assert_eq!(number, limits.len(), "{what}");
    for k in 0..6 {
        let mut state = robot.state(k);
        for p in closure.positions.iter().flatten() {
            state.q[p.0] = closure.samples[2 * k as usize][p.0];
        }
        let f: Vec<Dd> = state.value(&robot.function(Some("literal"), Method::InverseDynamics));
        let a = actuator_matrix(&robot, &state);
        let wanted = least_weighted(&a, limits, &f);
        let size = largest(&wanted).max(largest(&f));
        for way in WAYS {
            let what = format!("{what}, {k}, {way:?}");
            let found = state.value(&robot.function(way, Method::ActuatedInverse(number)));
            close(&found, &wanted, 1e-22, size, &what);
            let along: Vec<Dd> = a.iter().map(|row| dot(row, &found)).collect();
            close(&along, &f, 1e-24, size, &format!("{what}: A P"));
            let driven = State {
                u: found,
                ..state.clone()
            };
            let moved = driven.value(&robot.function(way, Method::ActuatedForward(number)));
            close(&moved, &state.a, 1e-21, size, &format!("{what}: back"));
        }
    }
}

#[test]
fn five_bars_are_driven_at_any_joints() {
    let all = [
        "proximal1_angle",
        "distal1_angle",
        "proximal2_angle",
        "distal2_angle",
    ];
    let (first, second) = ([all[0], all[2]], [all[0], all[1]]);
    for independent in [&first[..], &second[..]] {
        for (i, one) in all.iter().enumerate() {
            for other in &all[i + 1..] {
                let pair = [*one, *other];
                if pair != *independent {
                    let text = actuated("five_bar", independent, &pair);
                    compare(&text, &[1.0; 2], &format!("{independent:?}, {pair:?}"));
                }
            }
        }
    }
}

#[test]
fn a_four_bar_is_driven_at_its_rocker() {
    let text = actuated("four_bar", &["crank_angle"], &["rocker_angle"]);
    compare(&text, &[1.0], "rocker");
    let text = actuated("four_bar", &["crank_angle"], &["coupler_angle"]);
    compare(&text, &[1.0], "coupler");
}

/// Gives the joints limits of effort, in the order of the file.
fn with_limits(text: &str, limits: &[(&str, f64)]) -> String {
    let mut text = text.to_owned();
    for (joint, effort) in limits {
        let from = format!("name: {joint}, ");
        assert!(text.contains(&from), "{joint}");
        text = text.replace(&from, &format!("{from}limits: {{ effort: {effort} }}, "));
    }
    text
}

#[test]
fn more_drives_than_velocities_share_the_effort() {
    let bars = ["crank_angle", "coupler_angle", "rocker_angle"];
    let text = actuated("four_bar", &[], &bars);
    compare(&text, &[1.0; 3], "four-bar, all joints");
    let limits = [5.0, 0.3, 40.0];
    let each: Vec<(&str, f64)> = bars.into_iter().zip(limits).collect();
    let limited = with_limits(&text, &each);
    compare(&limited, &limits, "four-bar, limits");
    // A joint without a limit: none counts.
    let partly = with_limits(&text, &each[..2]);
    compare(&partly, &[1.0; 3], "four-bar, some limits");
    let joints = [
        "proximal1_angle",
        "distal1_angle",
        "proximal2_angle",
        "distal2_angle",
    ];
    let text = actuated("five_bar", &[], &joints[..3]);
    compare(&text, &[1.0; 3], "five-bar, three joints");
    let limits = [10.0, 2.0, 12.0, 3.0];
    let each: Vec<(&str, f64)> = joints.into_iter().zip(limits).collect();
    let text = with_limits(&actuated("five_bar", &[], &joints), &each);
    compare(&text, &limits, "five-bar, four joints");
    // Forces and torques: N beside N·m.
    let slider = ["crank_angle", "slider_position"];
    let text = actuated("slider_crank", &["crank_angle"], &slider);
    compare(&text, &[1.0; 2], "slider-crank");
}
