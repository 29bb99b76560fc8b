//! Joints of every type against golden values, and the generator's own check on them.

use std::fs;
use std::path::PathBuf;

use bgdyn_codegen::bond_graph::{self, BondGraph};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::formulation::by_name;
use bgdyn_codegen::mechanism::{Mechanism, Motion};
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::pipeline::{function, model, verify};
use serde_json::Value;

const ALL: [&str; 7] = [
    "anymal_floating",
    "helical_universal_test",
    "mimic_gripper",
    "planar_base_ur5",
    "quadrotor_arm",
    "satellite_arm6",
    "spherical_chain3",
];

struct Golden {
    name: &'static str,
    mechanism: Mechanism,
    graph: BondGraph,
    states: Vec<Value>,
    /// The largest condition number of M.
    condition: f64,
}

impl Golden {
    fn read(name: &'static str) -> Self {
        let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../tests/golden/joints");
        let read =
            |ending: &str| fs::read_to_string(folder.join(format!("{name}.{ending}"))).unwrap();
        let (mechanism, faults) = bgdyn_codegen::read(&read("yaml"), Some(name));
        let mechanism = mechanism.unwrap_or_else(|| panic!("{faults:?}"));
        let golden: Value = serde_json::from_str(&read("json")).unwrap();
        let number = |x: &Value| x.as_f64().unwrap();
        assert_eq!(mechanism.nq() as f64, number(&golden["nq"]));
        assert_eq!(mechanism.nv() as f64, number(&golden["nv"]));
        Golden {
            name,
            graph: bond_graph::build(&mechanism),
            mechanism,
            states: golden["states"].as_array().unwrap().clone(),
            condition: numbers(&golden["cond_M"]).into_iter().fold(1.0, f64::max),
        }
    }

    /// Returns the arguments of a state, with quaternions of length 1.
    fn inputs(&self, state: &Value) -> Inputs<f64> {
        let mut q = numbers(&state["q"]);
        for joint in self.mechanism.compound_joints() {
            if let Motion::Compound(motion) = joint.kind.motion
                && let Some(first) = motion.quaternion()
            {
                let at = joint.degrees.positions[first].0;
                let length = q[at..at + 4].iter().map(|x| x * x).sum::<f64>().sqrt();
                q[at..at + 4].iter_mut().for_each(|x| *x /= length);
            }
        }
        Inputs {
            q,
            v: numbers(&state["v"]),
            a: numbers(&state["a"]),
            u: numbers(&state["tau_in"]),
            ..Inputs::default()
        }
    }

    /// Compares a method at every state that has these values; forward dynamics and its derivatives may
    /// lose what the condition of M costs.
    fn check(
        &self,
        options: &Options,
        method: Method,
        wanted: impl Fn(&Value) -> Option<Vec<f64>>,
    ) {
        let made = function(&self.mechanism, method, options).expect("a function");
        let mut seen = 0;
        for (k, state) in self.states.iter().enumerate() {
            let Some(wanted) = wanted(state) else {
                continue;
            };
            seen += 1;
            let (found, refused) = made.evaluate(self.inputs(state));
            assert!(refused.is_none(), "{}, state {k}: {method:?}", self.name);
            // Forward dynamics returns the accelerations before its derivatives.
            let found = match method {
                Method::ForwardDynamicsDerivatives => &found[self.mechanism.nv()..],
                _ => &found[..],
            };
            let size = wanted.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            let solved = method.shape().checked();
            let allowed = if solved {
                1e-14 * self.condition.max(100.0)
            } else {
                2e-14
            };
            for (i, (found, wanted)) in found.iter().zip(&wanted).enumerate() {
                let off = (found - wanted).abs();
                assert!(
                    off <= allowed * size.max(1e-3),
                    "{}, state {k}, {method:?}[{i}]: {found}, not {wanted}",
                    self.name
                );
            }
        }
        assert!(seen > 0, "{}: {method:?} has no values", self.name);
    }

    fn methods(&self, options: &Options) {
        let of = |key: &'static str| move |s: &Value| Some(flat(&s[key]));
        self.check(options, Method::InverseDynamics, of("tau"));
        self.check(options, Method::Bias, of("nle"));
        self.check(options, Method::Gravity, of("g"));
        self.check(options, Method::ForwardDynamics, of("qdd"));
        self.check(options, Method::KineticEnergy, of("T"));
        self.check(options, Method::PotentialEnergy, of("V"));
        let n = self.mechanism.nv();
        self.check(options, Method::MassMatrix, |s| {
            let all = flat(&s["M"]);
            Some(
                (0..n)
                    .flat_map(|i| all[i * n..=i * n + i].to_vec())
                    .collect(),
            )
        });
        for (i, site) in self.graph.sites.iter().enumerate() {
            let site_of = |s: &Value| s["frames"].get(&site.name).cloned();
            if site_of(&self.states[0]).is_none() {
                continue;
            }
            let [pose, _, jacobian, rate] = Method::of_site(bond_graph::SiteId(i));
            self.check(options, pose, |s| {
                let frame = site_of(s)?;
                Some([flat(&frame["R"]), flat(&frame["p"])].concat())
            });
            self.check(options, jacobian, |s| {
                Some(flat(&site_of(s)?["jacobian_world"]))
            });
            self.check(options, rate, |s| {
                Some(flat(&site_of(s)?["jacobian_dot_v_world"]))
            });
        }
    }

    fn derivatives(&self) {
        let of = |keys: [&'static str; 2]| {
            move |s: &Value| {
                s.get(keys[0])?;
                Some([flat(&s[keys[0]]), flat(&s[keys[1]])].concat())
            }
        };
        let options = Options::default();
        self.check(
            &options,
            Method::InverseDynamicsDerivatives,
            of(["dtau_dq", "dtau_dv"]),
        );
        self.check(
            &options,
            Method::ForwardDynamicsDerivatives,
            of(["dqdd_dq", "dqdd_dv"]),
        );
    }
}

fn numbers(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .collect()
}

/// Returns all numbers of nested arrays, in order.
fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(all) => all.iter().flat_map(flat).collect(),
        other => vec![other.as_f64().unwrap()],
    }
}

#[test]
fn every_method_has_its_golden_value() {
    for name in ALL {
        Golden::read(name).methods(&Options::default());
    }
}

/// The literal sum, and the recursion over motion subspaces by name.
#[test]
fn every_formulation_that_serves_them_agrees() {
    for name in ["mimic_gripper", "quadrotor_arm", "spherical_chain3"] {
        for formulation in ["literal", "subspaces"] {
            let options = Options {
                formulation: by_name(formulation),
                ..Options::default()
            };
            Golden::read(name).methods(&options);
        }
    }
}

#[test]
fn derivatives_along_the_tangent_have_their_golden_values() {
    for name in [
        "mimic_gripper",
        "planar_base_ur5",
        "quadrotor_arm",
        "spherical_chain3",
    ] {
        Golden::read(name).derivatives();
    }
}

/// The generator's own check accepts the functions, the Coriolis matrix among them, and refuses one with a
/// wrong sign.
#[test]
fn the_generators_check_knows_these_joints() {
    for name in [
        "mimic_gripper",
        "planar_base_ur5",
        "quadrotor_arm",
        "spherical_chain3",
    ] {
        let golden = Golden::read(name);
        let options = Options {
            derivatives: true,
            ..Options::default()
        };
        let mut made = model(golden.mechanism.clone(), &options).unwrap();
        verify(&made, &options).unwrap_or_else(|_| panic!("{name} is refused"));
        for method in [Method::InverseDynamics, Method::CoriolisMatrix] {
            let reverse = |model: &mut bgdyn_codegen::model::Model| {
                let made = model.functions.iter_mut().find(|f| f.method == method);
                let outputs = &mut made.unwrap().blocks[0].outputs;
                outputs.iter_mut().for_each(|e| e.negative ^= true);
            };
            reverse(&mut made);
            assert!(verify(&made, &options).is_err(), "{name}, {method:?}");
            reverse(&mut made);
        }
    }
}

/// A formulation of rotations and translations refuses other joints by name.
#[test]
fn a_formulation_says_which_joints_it_serves() {
    let golden = Golden::read("quadrotor_arm");
    let options = Options {
        formulation: by_name("recursion"),
        ..Options::default()
    };
    let refused = model(golden.mechanism, &options)
        .err()
        .expect("it is refused");
    let message = refused[0].to_string();
    assert!(
        message.contains("`recursion`") && message.contains("`body`"),
        "{message}"
    );
}

/// q and −q are one orientation: only products of two components occur.
#[test]
fn the_sign_of_a_quaternion_does_not_matter() {
    let golden = Golden::read("spherical_chain3");
    for method in [
        Method::InverseDynamics,
        Method::MassMatrix,
        Method::ForwardDynamics,
    ] {
        let made = function(&golden.mechanism, method, &Options::default()).unwrap();
        for state in &golden.states {
            let one = golden.inputs(state);
            let mut other = one.clone();
            other.q[4..8].iter_mut().for_each(|x| *x = -*x);
            let bits = |inputs| made.evaluate(inputs).0.into_iter().map(f64::to_bits);
            assert!(bits(one).eq(bits(other)), "{method:?}");
        }
    }
}

/// Functions of a joint with `quaternion: any` do not depend on the length.
#[test]
fn any_length_of_a_quaternion_gives_the_same() {
    let text = "format: 1\nlinks: [{ name: top, joint: { name: ball, type: spherical, quaternion: any }, mass: 2, \
        com: [0.1, 0.02, 0.3], inertia: { xx: 0.1, yy: 0.2, zz: 0.15, xy: 0.01 } }]\n";
    let (mechanism, faults) = bgdyn_codegen::read(text, Some("top"));
    let mechanism = mechanism.unwrap_or_else(|| panic!("{faults:?}"));
    let inputs = |length: f64| Inputs {
        q: [0.1, -0.7, 0.5, 0.5].map(|x| x * length).to_vec(),
        v: vec![1.0, -2.0, 0.5],
        a: vec![0.3, 0.2, -1.0],
        ..Inputs::default()
    };
    let made = function(&mechanism, Method::InverseDynamics, &Options::default()).unwrap();
    let wanted = made.evaluate(inputs(1.0)).0;
    for length in [0.5, 4.0, 3.0, 1e-3] {
        let found = made.evaluate(inputs(length)).0;
        for (x, y) in found.iter().zip(&wanted) {
            assert!((x - y).abs() < 1e-14, "{length}: {x}, not {y}");
        }
    }
}

/// The position of a free root reaches no effort, at any distance.
#[test]
fn efforts_do_not_see_the_position_of_a_free_root() {
    let golden = Golden::read("quadrotor_arm");
    let made = function(
        &golden.mechanism,
        Method::InverseDynamics,
        &Options::default(),
    )
    .unwrap();
    let one = golden.inputs(&golden.states[0]);
    let mut other = one.clone();
    other.q[..3].copy_from_slice(&[1e9, -3e9, 2e9]);
    assert_eq!(made.evaluate(one).0, made.evaluate(other).0);
}
