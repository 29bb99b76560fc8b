//! Functions with an error of each known kind: each is found.

use bgdyn_codegen::bond_graph::{self, BondGraph, Gyrostat, Rotor};
use bgdyn_codegen::choice::{Choice, GraphMethods};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::mechanism::{LinkId, Value};
use bgdyn_codegen::method::{Method, SceneFunction};
use bgdyn_codegen::options::Options;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_codegen::verify::{Difference, check_functions, check_scene};
use bgdyn_runtime::Dd;

use super::{ARM, all, functions, mechanism, with_rotor};

/// Returns the functions that are found to differ from those of `right`, if they are made from a changed
/// graph.
fn found(
    right: &SceneEquations,
    change: impl Fn(&mut BondGraph),
    roles: &[SceneFunction],
) -> Vec<Difference> {
    let mut graph = BondGraph::clone(&right.graph);
    change(&mut graph);
    let wrong = SceneEquations {
        graph: GraphMethods::new(graph),
        ..right.clone()
    };
    let mut mixed = functions(right);
    for function in &mut mixed {
        if roles
            .iter()
            .any(|role| function.method == Method::Scene(*role))
        {
            let Method::Scene(role) = function.method else {
                unreachable!("chosen by its role")
            };
            *function = wrong.function(role);
        }
    }
    check_scene(right, &mixed)
}

fn names(found: &[Difference]) -> Vec<&str> {
    found.iter().map(|d| d.function.as_str()).collect()
}

/// A mass matrix without a full rotor's entry about the axis of its own joint, 2 N J e·z.
#[test]
fn a_rotor_left_out_of_the_mass_matrix_is_found() {
    let right = with_rotor("hand");
    let missing = |graph: &mut BondGraph| {
        let own = graph.rotors[0].clone();
        graph.multibody.rotors.push(Rotor {
            carrier: None,
            ratio: Value::Fixed(Dd::from_f64(-0.01)),
            ..own
        });
    };
    let differing = found(
        &right,
        missing,
        &[SceneFunction::Derivative, SceneFunction::ToCanonical],
    );
    // The Jacobian and the canonical form are compared with these two.
    for function in ["derivative", "to_canonical"] {
        assert!(names(&differing).contains(&function), "{differing:?}");
    }
    let inverse = found(&right, missing, &[SceneFunction::Inverse]);
    assert_eq!(names(&inverse), ["inverse"], "{inverse:?}");
}

/// A Jacobian without full rotors.
#[test]
fn a_rotor_left_out_of_the_jacobian_is_found() {
    let right = with_rotor("upper");
    let left_out = |graph: &mut BondGraph| graph.multibody.rotors[0].carrier = None;
    let differing = found(&right, left_out, &[SceneFunction::Jacobian]);
    assert_eq!(names(&differing), ["jacobian"], "{differing:?}");
    let elsewhere = |graph: &mut BondGraph| {
        let carrier = graph.multibody.rotors[0]
            .carrier
            .clone()
            .expect("a full rotor");
        graph.multibody.rotors[0].carrier = Some(Gyrostat {
            link: LinkId(1),
            ..carrier
        });
    };
    let differing = found(&right, elsewhere, &[SceneFunction::Jacobian]);
    assert_eq!(names(&differing), ["jacobian"], "{differing:?}");
}

/// Axes of a link that are not orthogonal, or have the opposite direction.
#[test]
fn wrong_axes_are_found_in_every_method() {
    let graph = bond_graph::build(&mechanism(ARM, "arm"));
    for sheared in [false, true] {
        let mut wrong = graph.clone();
        let axes = &mut wrong.multibody.frames[1].origin.rotation.0;
        match sheared {
            // One part in 1e9 is below the digits of a printed value.
            true => axes[2][1] += Dd::from_f64(1e-9),
            false => axes.iter_mut().for_each(|row| row[2] = -row[2]),
        }
        let choice = Choice::new(&wrong, None);
        let methods = Options::select(&all(), &wrong).expect("methods");
        let made = methods.into_iter().filter_map(|m| choice.function(m));
        let made: Vec<Function> = made.map(|f| (*f).clone()).collect();
        let differing = check_functions("arm", &graph, &made);
        let differing = names(&differing);
        for method in [
            "inverse_dynamics",
            "gravity",
            "forward_dynamics",
            "pose_hand",
        ] {
            assert!(
                differing.contains(&method),
                "{method} passes: {differing:?}"
            );
        }
    }
}

/// Each compared function of a scene, with the sign of one of its outputs changed.
#[test]
fn a_turned_sign_is_found_in_every_function_of_a_scene() {
    let right = with_rotor("hand");
    let functions = functions(&right);
    let compared = [
        SceneFunction::Derivative,
        SceneFunction::Inverse,
        SceneFunction::Power,
        SceneFunction::Jacobian,
        SceneFunction::ToCanonical,
        SceneFunction::FromCanonical,
        SceneFunction::CanonicalRates,
    ];
    for role in compared {
        let mut wrong = functions.clone();
        let function = wrong.iter_mut().find(|f| f.method == Method::Scene(role));
        let Function { graph, blocks, .. } = function.expect("generated");
        let outputs = &mut blocks.last_mut().expect("a block").outputs;
        // A constant of zero has no sign.
        let varying = outputs
            .iter_mut()
            .find(|e| graph.constant_of(**e).is_none());
        let output = varying.expect("an output that varies");
        output.negative = !output.negative;
        let differing = check_scene(&right, &wrong);
        assert!(
            names(&differing).contains(&role.name()),
            "{role:?}: {differing:?}"
        );
    }
}

/// Each method alone, with the sign of one of its outputs changed.
#[test]
fn a_turned_sign_is_found_in_every_method() {
    let model = bgdyn_codegen::selection::model(mechanism(ARM, "arm"), &all()).expect("a model");
    let state = |n: usize, from: f64| {
        (0..n)
            .map(|k| Dd::from_f64(from + 0.4 * k as f64))
            .collect()
    };
    let inputs = Inputs {
        q: state(3, 0.3),
        v: state(3, -0.6),
        a: state(3, 1.7),
        u: state(3, -2.0),
        ..Inputs::default()
    };
    for function in &model.functions {
        let values = function.evaluate(inputs.clone()).0;
        // The effort of gravity at the vertical shoulder is zero, or a rounding error.
        let sized = values
            .iter()
            .enumerate()
            .filter(|(_, x)| x.to_f64().abs() > 1e-20);
        for (k, _) in sized {
            let mut wrong = function.clone();
            let outputs = &mut wrong.blocks.last_mut().expect("a block").outputs;
            outputs[k].negative = !outputs[k].negative;
            let one = std::slice::from_ref(&wrong);
            let differing = check_functions("arm", &model.bond_graph, one);
            assert_eq!(
                differing.len(),
                1,
                "{}, output {k} of {values:?}",
                function.name
            );
        }
    }
}
