//! Loops of MJCFs: accelerations with MuJoCo's matrices, equivalent files, what is reported and refused.

use super::{changed, made, mechanism, near, refused, value};
use bgdyn_cli::import::{Import, Options, import_with};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::mechanism::Mechanism;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::options::Options as Generation;
use bgdyn_codegen::selection::function;
use serde_json::Value;

const PLANAR: &str = include_str!("../mjcf/loop_planar.xml");
const SPATIAL: &str = include_str!("../mjcf/loop_spatial.xml");
const WELDED: &str = include_str!("../mjcf/loop_weld.xml");
const GOLDEN: &str = include_str!("../mjcf/loops.json");

/// Returns the accelerations of the independent joints without efforts.
fn free_accelerations(mechanism: &Mechanism, q: &[f64], v: &[f64]) -> Vec<f64> {
    let method = Method::ForwardDynamics;
    let function = function(mechanism, method, &Generation::default()).expect("the method");
    let inputs = Inputs {
        q: q.to_vec(),
        v: v.to_vec(),
        u: vec![0.0; v.len()],
        ..Inputs::default()
    };
    let (found, refused) = function.evaluate(inputs);
    assert!(refused.is_none(), "a singular position");
    found
}

/// The numbers of a golden list for these joints.
fn of(joints: &[&str], wanted: &[String], numbers: &Value) -> Vec<f64> {
    let at = |name: &String| joints.iter().position(|joint| joint == name);
    let at = |name: &String| at(name).unwrap_or_else(|| panic!("the joint {name}"));
    let number = |name: &String| numbers[at(name)].as_f64().expect("a number");
    wanted.iter().map(number).collect()
}

/// The golden values are of exact constraints with MuJoCo's mass matrix, bias and rows; the change of its rows is a
/// difference, of 1e-10.
#[test]
fn loops_move_as_with_the_matrices_of_mujoco() {
    let golden: Value = serde_json::from_str(GOLDEN).expect("JSON");
    let machines = [("loop_planar", PLANAR, 1), ("loop_spatial", SPATIAL, 9)];
    for (name, text, nv) in machines.into_iter().chain([("loop_weld", WELDED, 2)]) {
        let mechanism = mechanism(&made(text).yaml);
        assert_eq!(mechanism.nv(), nv, "{name}");
        let machine = &golden["machines"][name];
        let joints = machine["joints"].as_array().expect("names");
        let joints: Vec<&str> = joints.iter().filter_map(Value::as_str).collect();
        let positions = mechanism.position_names();
        let independent = mechanism.joint_names();
        for state in machine["states"].as_array().expect("states") {
            let q = of(&joints, &positions, &state["q"]);
            let v = of(&joints, &independent, &state["v"]);
            let a = of(&joints, &independent, &state["a"]);
            near(&free_accelerations(&mechanism, &q, &v), &a, 1e-9);
        }
    }
}

/// Two sites at the place of the anchor are the same loop.
#[test]
fn sites_close_as_bodies_do() {
    let sites = changed(
        PLANAR,
        "<inertial pos=\"0.2 0 0.02\"",
        "<site name=\"end\" pos=\"0.4 0 0\"/><inertial pos=\"0.2 0 0.02\"",
    );
    let bodies = mechanism(&made(PLANAR).yaml);
    let b = bodies.closure().expect("a loop").loops[0]
        .chain
        .end
        .translation;
    let b = b.0.map(|x| x.to_f64());
    // The anchor of the rocker's joint is 10 mm above its body's origin, and that of its link.
    let site = format!(
        "<site name=\"top\" pos=\"{} {} {}\"/><inertial pos=\"0 0 0.15\"",
        b[0],
        b[1],
        b[2] + 0.01
    );
    let sites = changed(&sites, "<inertial pos=\"0 0 0.15\"", &site);
    let sites = changed(
        &sites,
        "body1=\"coupler\" body2=\"rocker\" anchor=\"0.4 0 0\"",
        "site1=\"end\" site2=\"top\"",
    );
    let (by_sites, golden): (Mechanism, Value) = (
        mechanism(&made(&sites).yaml),
        serde_json::from_str(GOLDEN).expect("JSON"),
    );
    for state in golden["machines"]["loop_planar"]["states"]
        .as_array()
        .expect("states")
    {
        let numbers = |key: &str| -> Vec<f64> {
            let list = state[key].as_array().expect("numbers");
            list.iter().filter_map(Value::as_f64).collect()
        };
        let (q, v) = (numbers("q"), &numbers("v")[..1]);
        let [a, b] = [&bodies, &by_sites].map(|m| free_accelerations(m, &q, v));
        near(&a, &b, 1e-12);
        let gap = value(&by_sites, Method::ConstraintResidual, [&q, &[], &[]]);
        near(&gap, &[0.0; 2], 1e-14);
    }
}

/// Two points on one axis are a hinge: the rows that follow from others are allowed for.
#[test]
fn a_hinge_of_two_points_is_a_hinge() {
    let second = "<connect name=\"pin\" body1=\"coupler\" body2=\"rocker\" anchor=\"0.4 0 0\"/>
    <connect name=\"pin2\" body1=\"coupler\" body2=\"rocker\" anchor=\"0.4 0.05 0\"/>";
    let first = "<connect name=\"pin\" body1=\"coupler\" body2=\"rocker\" anchor=\"0.4 0 0\"/>";
    let double = made(&changed(PLANAR, first, second));
    assert!(double.yaml.contains("redundant: allow"), "{}", double.yaml);
    let [one, two] = [&made(PLANAR), &double].map(|made| mechanism(&made.yaml));
    assert_eq!(two.nv(), 1);
    let q: Vec<f64> = one
        .closure()
        .expect("a loop")
        .start
        .iter()
        .map(|x| x.to_f64())
        .collect();
    let [a, b] = [&one, &two].map(|m| free_accelerations(m, &q, &[0.7]));
    near(&a, &b, 1e-11);
}

#[test]
fn what_is_no_loop_is_reported() {
    let line = |made: &Import, words: &str| {
        let found = made.warnings.iter().any(|line| line.contains(words));
        assert!(found, "{words}\n{:#?}", made.warnings);
    };
    let made_with = |old: &str, new: &str| made(&changed(SPATIAL, old, new));
    let exact = made(SPATIAL);
    line(
        &exact,
        "loops, exact here, while MuJoCo holds them by a soft constraint: `hands`",
    );
    line(&exact, "not active, not imported: `off` (line 37)");
    let ball = made_with(
        "<joint name=\"right_turn\" type=\"hinge\" axis=\"0.1 0 1\"/>",
        "<joint name=\"right_turn\" type=\"ball\"/>",
    );
    assert_eq!(mechanism(&ball.yaml).nv(), mechanism(&exact.yaml).nv() + 2);
    let itself = made_with("body2=\"right_tip\"", "body2=\"left_tip\"");
    line(
        &itself,
        "that no joint moves against each other, not imported: `hands`",
    );
}

#[test]
fn what_is_missing_is_an_error_with_its_line() {
    let refused = |old: &str, new: &str| refused(&changed(SPATIAL, old, new));
    let body = refused("body2=\"right_tip\"", "body2=\"right_hand\"");
    assert_eq!(body, "36:5: `body2`: there is no body `right_hand`");
    let none = refused("body1=\"left_tip\" body2=\"right_tip\"", "");
    assert_eq!(none, "36:5: this `<connect>` has no `body1`");
    let site = refused(
        "body1=\"left_tip\" body2=\"right_tip\"",
        "site1=\"hand\" site2=\"foot\"",
    );
    assert_eq!(site, "36:5: `site2`: there is no site `foot`");
    let anchor = refused("anchor=\"0.2 0.01 0.02\"", "anchor=\"0.2 0.01\"");
    assert!(
        anchor.starts_with("36:5: `anchor` of `<connect>` must be 3 finite numbers"),
        "{anchor}"
    );
}

/// A chain that leaves a link of a loop out opens the loop, and says so; names that are taken are numbered.
#[test]
fn loops_follow_the_changes_of_the_robot() {
    let options = Options {
        chain: Some(["base".into(), "left_tip".into()]),
        ..Options::default()
    };
    let opened = import_with(SPATIAL, &options).expect("an import");
    assert!(!opened.yaml.contains("loops:"), "{}", opened.yaml);
    let words = "--chain: loops with links that are left out: `hands`";
    assert!(
        opened.warnings.iter().any(|line| line == words),
        "{:#?}",
        opened.warnings
    );
    let taken = made(&changed(SPATIAL, "name=\"hands\"", "name=\"left tip\""));
    assert!(
        taken.yaml.contains("  - name: left_tip_2\n"),
        "{}",
        taken.yaml
    );
    mechanism(&taken.yaml);
}
