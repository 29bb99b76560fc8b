//! Compares every quantity of the golden files, evaluated in `f64`, for the formulation chosen and by name.

use bgdyn_codegen::formulation;
use bgdyn_codegen::method::Method;
use nalgebra::DMatrix;
use serde_json::Value;

use super::robot::{Robot, State, WAYS, Way, full, golden_text};

/// All formulations of inverse and forward dynamics.
const DYNAMICS_WAYS: [Way; 7] = [
    None,
    Some("literal"),
    Some("subspaces"),
    Some("recursion"),
    Some("recursion_own"),
    Some("articulated"),
    Some("articulated_base"),
];

/// Relative to the largest component.
const TOLERANCE: f64 = 1e-13;
/// Of accelerations and their derivatives, per unit of the condition number of M.
const SOLVED: f64 = 1e-15;

/// The ends of the names of a joint's positions.
fn position_ends(kind: &str) -> &'static [&'static str] {
    match kind {
        "floating" => &["_x", "_y", "_z", "_qx", "_qy", "_qz", "_qw"],
        "spherical" => &["_qx", "_qy", "_qz", "_qw"],
        "planar" => &["_x", "_y", "_turn"],
        "cylindrical" => &["_turn", "_slide"],
        "universal" => &["_first", "_second"],
        _ => &[""],
    }
}

/// The ends of the names of a joint's velocities.
fn velocity_ends(kind: &str) -> &'static [&'static str] {
    match kind {
        "floating" => &["_x", "_y", "_z", "_rx", "_ry", "_rz"],
        "spherical" => &["_rx", "_ry", "_rz"],
        _ => position_ends(kind),
    }
}

/// A golden mechanism and its file.
struct Golden {
    robot: Robot,
    file: Value,
    /// For each position its place in the file.
    positions: Vec<usize>,
    /// For each velocity its place in the file.
    velocities: Vec<usize>,
}

impl Golden {
    fn new(name: &'static str) -> Self {
        let robot = Robot::golden(name);
        let file: Value =
            serde_json::from_str(&golden_text(&format!("{name}.json"))).expect("JSON");
        let order = |names: Vec<String>, key: &str, ends: fn(&str) -> &'static [&'static str]| {
            let mut theirs = Vec::new();
            for joint in file["layout"].as_array().expect("the layout") {
                let text = |key: &str| joint[key].as_str().expect("a text");
                let first = joint[key][0].as_u64().expect("a place") as usize;
                let ends = ends(text("type"));
                assert_eq!(theirs.len(), first, "{name}: the layout has gaps");
                assert_eq!(joint[key][1].as_u64(), Some(ends.len() as u64), "{name}");
                theirs.extend(ends.iter().map(|end| format!("{}{end}", text("joint"))));
            }
            assert_eq!(
                theirs.len(),
                names.len(),
                "{name}: {theirs:?} against {names:?}"
            );
            let place = |own: &String| theirs.iter().position(|n| n == own);
            let places = names
                .iter()
                .map(|own| place(own).unwrap_or_else(|| panic!("{own}?")));
            places.collect::<Vec<usize>>()
        };
        let (mechanism, number) = (&robot.mechanism, |key: &str| file[key].as_u64());
        assert_eq!(number("nq"), Some(mechanism.nq() as u64));
        assert_eq!(number("nv"), Some(mechanism.nv() as u64));
        Golden {
            positions: order(mechanism.position_names(), "q", position_ends),
            velocities: order(mechanism.joint_names(), "v", velocity_ends),
            robot,
            file,
        }
    }

    fn states(&self) -> &[Value] {
        let states = self.file["states"].as_array().expect("states");
        assert!(states.len() >= 3);
        states
    }

    fn vector(&self, state: &Value, key: &str) -> Option<Vec<f64>> {
        let x = flat(state.get(key)?);
        Some(self.velocities.iter().map(|&i| x[i]).collect())
    }

    /// A square matrix in the robot's order, row by row.
    fn square(&self, state: &Value, key: &str) -> Option<Vec<f64>> {
        let rows: Vec<Vec<f64>> = state.get(key)?.as_array()?.iter().map(flat).collect();
        let order = &self.velocities;
        let entries = order
            .iter()
            .flat_map(|&i| order.iter().map(move |&j| (i, j)));
        Some(entries.map(|(i, j)| rows[i][j]).collect())
    }

    fn state(&self, state: &Value) -> State<f64> {
        let q = flat(&state["q"]);
        let given = |key: &str| self.vector(state, key).expect("every state has it");
        State {
            q: self.positions.iter().map(|&i| q[i]).collect(),
            v: given("v"),
            a: given("a"),
            u: given("tau_in"),
        }
    }

    /// Condition number of M, as the file or the function has it.
    fn condition(&self, s: &State<f64>) -> f64 {
        let n = self.robot.nv();
        let mass = s.value(&self.robot.function(Some("subspaces"), Method::MassMatrix));
        let rows = full(&mass, n);
        let values = DMatrix::from_fn(n, n, |i, j| rows[i][j]).singular_values();
        values.max() / values.min()
    }
}

/// All numbers in a value, row by row.
fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(rows) => rows.iter().flat_map(flat).collect(),
        number => vec![number.as_f64().expect("a number")],
    }
}

/// Number of comparisons, and the largest error in units of the tolerance.
#[derive(Default)]
struct Tally {
    compared: usize,
    worst: f64,
}

impl Tally {
    fn compare(&mut self, found: &[f64], expected: &[f64], relative: f64, what: &str) {
        assert_eq!(found.len(), expected.len(), "{what}");
        let size = expected.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let allowed = relative * size;
        for (k, (x, y)) in found.iter().zip(expected).enumerate() {
            let off = (x - y).abs();
            assert!(
                off <= allowed,
                "{what}: entry {k}: {x:e} against {y:e}, off by {off:e}, allowed {allowed:e}"
            );
            if off > 0.0 {
                self.worst = self.worst.max(off / allowed);
            }
        }
        self.compared += found.len();
    }
}

/// Compares the methods of the trait.
fn dynamics(name: &'static str) {
    let golden = Golden::new(name);
    let n = golden.robot.nv();
    let conditions: Vec<f64> = golden
        .states()
        .iter()
        .map(|state| golden.condition(&golden.state(state)))
        .collect();
    for way in DYNAMICS_WAYS {
        let formulation = way.map(|name| formulation::by_name(name).expect("a formulation"));
        if formulation.is_some_and(|f| !f.serves(&golden.robot.graph)) {
            continue;
        }
        for (method, key) in [
            (Method::InverseDynamics, "tau"),
            (Method::Bias, "nle"),
            (Method::Gravity, "g"),
            (Method::ForwardDynamics, "qdd"),
            (Method::KineticEnergy, "T"),
            (Method::PotentialEnergy, "V"),
            (Method::MassMatrix, "M"),
        ] {
            if formulation.is_some_and(|f| !f.knows(method)) {
                continue;
            }
            let function = golden.robot.function(way, method);
            let mut tally = Tally::default();
            for (k, state) in golden.states().iter().enumerate() {
                let expected = match method {
                    Method::MassMatrix => golden.square(state, key),
                    Method::KineticEnergy | Method::PotentialEnergy => {
                        state[key].as_f64().map(|x| vec![x])
                    }
                    _ => golden.vector(state, key),
                };
                let Some(expected) = expected else {
                    assert!(key == "M" && k > 2, "{name}: no {key} in state {k}");
                    continue;
                };
                let mut found = golden.state(state).value(&function);
                if method == Method::MassMatrix {
                    found = full(&found, n).concat();
                }
                let relative = match method {
                    Method::ForwardDynamics => TOLERANCE.max(SOLVED * conditions[k]),
                    _ => TOLERANCE,
                };
                let what = format!("{name}, {way:?}, {key}, state {k}");
                tally.compare(&found, &expected, relative, &what);
            }
            assert!(tally.compared >= 3);
            let Tally { compared, worst } = tally;
            println!("{name} {way:?} {key}: {compared} numbers, at {worst:.1e} of the tolerance");
        }
    }
}

/// Compares poses, Jacobians, their products with v, and J̇v.
fn frames(name: &'static str) {
    let golden = Golden::new(name);
    let mut tally = Tally::default();
    let named: Vec<String> = golden.states()[0]["frames"]
        .as_object()
        .expect("frames")
        .keys()
        .cloned()
        .collect();
    for way in WAYS {
        for frame in &named {
            let site = golden.robot.site(frame);
            let functions = Method::of_site(site).map(|m| golden.robot.function(way, m));
            for (k, state) in golden.states().iter().enumerate() {
                let at = &state["frames"][frame];
                let s = golden.state(state);
                let mut pose = flat(&at["R"]);
                pose.extend(flat(&at["p"]));
                let rows = at["jacobian_world"].as_array().expect("rows");
                let rows: Vec<Vec<f64>> = rows.iter().map(flat).collect();
                let ordered = |row: &Vec<f64>| -> Vec<f64> {
                    golden.velocities.iter().map(|&i| row[i]).collect()
                };
                let jacobian: Vec<Vec<f64>> = rows.iter().map(ordered).collect();
                let moving = |row: &Vec<f64>| row.iter().zip(&s.v).map(|(x, v)| x * v).sum();
                let expected = [
                    pose,
                    jacobian.iter().map(moving).collect(),
                    jacobian.concat(),
                    flat(&at["jacobian_dot_v_world"]),
                ];
                for (function, expected) in functions.iter().zip(expected) {
                    let what = format!("{name}, {way:?}, {}, state {k}", function.name);
                    let found = s.value(function);
                    let (turning, moving) = match expected.len() {
                        12 => expected.split_at(9),
                        whole => expected.split_at(whole / 2),
                    };
                    let (own_turning, own_moving) = found.split_at(turning.len());
                    // Radians and metres each relative to their own.
                    tally.compare(own_turning, turning, TOLERANCE, &what);
                    tally.compare(own_moving, moving, TOLERANCE, &what);
                }
            }
        }
    }
    let Tally { compared, worst } = tally;
    println!("{name}, frames: {compared} numbers, at {worst:.1e} of the tolerance");
    assert!(compared > 0);
}

/// Compares derivatives along the tangent, and ∂q̈/∂τ with M⁻¹.
fn derivatives(name: &'static str) {
    let golden = Golden::new(name);
    let n = golden.robot.nv();
    for way in WAYS {
        let inverse = golden
            .robot
            .function(way, Method::InverseDynamicsDerivatives);
        let forward = golden
            .robot
            .function(way, Method::ForwardDynamicsDerivatives);
        let mut tally = Tally::default();
        for (k, state) in golden.states().iter().take(3).enumerate() {
            let s = golden.state(state);
            let wanted = |key: &str| {
                let found = golden.square(state, key);
                found.unwrap_or_else(|| panic!("{name}: no {key} in state {k}"))
            };
            let mut compare = |found: &[f64], key: &str, relative: f64| {
                let what = format!("{name}, {way:?}, {key}, state {k}");
                tally.compare(found, &wanted(key), relative, &what);
            };
            let found = s.value(&inverse);
            let (by_q, by_v) = found.split_at(n * n);
            compare(by_q, "dtau_dq", TOLERANCE);
            compare(by_v, "dtau_dv", TOLERANCE);
            let solved = TOLERANCE.max(SOLVED * golden.condition(&s));
            let found = s.value(&forward);
            let parts: Vec<&[f64]> = found[n..].chunks(n * n).collect();
            compare(parts[0], "dqdd_dq", solved);
            compare(parts[1], "dqdd_dv", solved);
            let mass = DMatrix::from_row_slice(n, n, &wanted("M"));
            let product = mass * DMatrix::from_row_slice(n, n, parts[2]);
            let off = (product - DMatrix::identity(n, n)).amax();
            assert!(
                off <= solved,
                "{name}, {way:?}: M ∂q̈/∂τ is off 1 by {off:e}"
            );
        }
        let Tally { compared, worst } = tally;
        println!(
            "{name} {way:?}, derivatives: {compared} numbers, at {worst:.1e} of the tolerance"
        );
    }
}

#[test]
fn quadrotor_arm() {
    dynamics("quadrotor_arm");
    frames("quadrotor_arm");
}

#[test]
fn satellite_arm6() {
    dynamics("satellite_arm6");
    frames("satellite_arm6");
}

#[test]
fn anymal_floating() {
    dynamics("anymal_floating");
    frames("anymal_floating");
}

#[test]
fn spherical_chain3() {
    dynamics("spherical_chain3");
    frames("spherical_chain3");
}

#[test]
fn planar_base_ur5() {
    dynamics("planar_base_ur5");
    frames("planar_base_ur5");
}

#[test]
fn helical_universal_test() {
    dynamics("helical_universal_test");
    frames("helical_universal_test");
}

#[test]
fn mimic_gripper() {
    dynamics("mimic_gripper");
    frames("mimic_gripper");
}

#[test]
fn derivatives_of_quadrotor_arm() {
    derivatives("quadrotor_arm");
}

#[test]
fn derivatives_of_spherical_chain3() {
    derivatives("spherical_chain3");
}

#[test]
fn derivatives_of_planar_base_ur5() {
    derivatives("planar_base_ur5");
}

#[test]
fn derivatives_of_mimic_gripper() {
    derivatives("mimic_gripper");
}

#[test]
fn derivatives_of_satellite_arm6() {
    derivatives("satellite_arm6");
}

#[test]
fn derivatives_of_anymal_floating() {
    derivatives("anymal_floating");
}

#[test]
fn derivatives_of_helical_universal_test() {
    derivatives("helical_universal_test");
}
