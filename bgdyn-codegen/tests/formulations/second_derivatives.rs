//! Tests second derivatives of l·τ and of all efforts, and derivatives of the accelerations by parameters: equal to
//! equation (6) on random trees, joints of every type, loops and constraints; refusals; counts of operations.

use bgdyn_codegen::expr::Signed;
use bgdyn_codegen::method::{Directional, Method, ParameterDerivatives, Shape};

use crate::checked::{
    checked_methods, counted, every_turned_sign_is_refused, of_folder, quick_loops,
};
use crate::common::random::Draft;
use crate::common::rng::Rng;
use crate::common::{Robot, golden};

const CURVATURE: Method = Method::Directional(Directional::InverseCurvature);
const SECOND: Method = Method::Directional(Directional::InverseSecond);

fn methods(robot: &Robot) -> Vec<Method> {
    let all = Method::possible_of(robot.graph).into_iter();
    let of_this = |method: &Method| {
        let by_parameters = matches!(method, Method::ParameterDerivatives(_));
        [CURVATURE, SECOND].contains(method) || by_parameters
    };
    all.filter(of_this).collect()
}

fn passes(robot: &Robot, what: &str) -> Vec<Method> {
    let all = methods(robot);
    if !all.is_empty() {
        checked_methods(robot, &all, what);
    }
    all
}

#[test]
fn random_trees_equal_equation_6() {
    let mut rng = Rng::new(331);
    for _ in 0..12 {
        let text = Draft::random(&mut rng, 6).yaml();
        passes(&Robot::read(&text, None), &text);
    }
}

/// Run-time parameters: masses, centres of mass, inertias.
#[test]
fn specs_with_run_time_parameters_equal_equation_6() {
    let mut with = 0;
    for (name, text) in ["tests/scalars/specs", "tests/numeric/specs"]
        .into_iter()
        .flat_map(of_folder)
    {
        let robot = Robot::read(&text, Some(&name));
        let all = passes(&robot, &name);
        let of_run_time = ParameterDerivatives::RunTime(robot.graph.parameters.len());
        let found = all.contains(&Method::ParameterDerivatives(of_run_time));
        assert_eq!(found, text.contains("parameter:"), "{name}");
        with += usize::from(found);
    }
    assert!(with > 1);
}

/// The motion of the base consists of run-time parameters as well.
#[test]
fn given_bases_equal_equation_6() {
    for name in ["scara", "puma560"] {
        let (_, text) = of_folder("specs")
            .into_iter()
            .find(|(stem, _)| stem == name)
            .expect("the spec");
        let text = text.replacen("format: 1\n", "format: 1\nbase: given\n", 1);
        let robot = Robot::read(&text, Some(name));
        let of_run_time = Method::ParameterDerivatives(ParameterDerivatives::RunTime(9));
        assert!(passes(&robot, &text).contains(&of_run_time), "{name}");
    }
}

/// Free bases, balls, screws: the derivatives along the velocities do not commute.
#[test]
fn joints_of_every_type_equal_equation_6() {
    let specs = of_folder("tests/golden/joints");
    let small = |text: &str| text.matches("joint:").count() <= 7;
    let mut checked = 0;
    for (name, text) in specs.iter().filter(|(_, text)| small(text)) {
        passes(&Robot::read(text, Some(name)), name);
        checked += 1;
    }
    assert!(checked > 2);
}

#[test]
fn loops_and_constraints_equal_equation_6() {
    for (name, text) in quick_loops().into_iter().take(3) {
        let passed = passes(&Robot::read(&text, Some(&name)), &name);
        assert!(passed.contains(&CURVATURE) && passed.contains(&SECOND));
    }
    for (name, text) in of_folder("specs/constraints") {
        passes(&Robot::read(&text, Some(&name)), &name);
    }
}

/// Derivatives by coordinates commute, exactly: the entries are the same expressions. Along velocities of a free body they
/// do not.
#[test]
fn second_derivatives_by_coordinates_are_symmetric() {
    let symmetric = |text: &str| {
        let robot = Robot::read(text, Some("symmetric"));
        let n = robot.nv();
        let is_symmetric =
            |outputs: &[Signed]| (0..n * n).all(|k| outputs[k] == outputs[k % n * n + k / n]);
        let of = |method: Method, matrices: usize| {
            let found = robot.emitted(method);
            let outputs = &found.blocks.last().expect("a block").outputs;
            outputs.chunks(n * n).take(matrices).all(is_symmetric)
        };
        let both = [of(CURVATURE, 1), of(SECOND, n)];
        assert_eq!(both[0], both[1]);
        both[0]
    };
    let (_, five_bar) = quick_loops()
        .into_iter()
        .find(|(name, _)| name == "five_bar")
        .expect("the spec");
    assert!(symmetric(&five_bar));
    let chain = "format: 1
links:
  - name: nut
    joint: { name: screw, type: helical, axis: z, lead: 10 mm }
    mass: 2
    com: [0.1, 0, 0.2]
    inertia: { xx: 0.1, yy: 0.2, zz: 0.25 }
  - name: hand
    parent: nut
    joint: { name: wrist, type: JOINT, axis: [1, 2, 0], origin: { xyz: [0.3, 0.1, 0.2] } }
    mass: 1
    com: [0.1, 0.2, 0.05]
    inertia: { xx: 0.01, yy: 0.02, zz: 0.025 }
";
    assert!(symmetric(&chain.replace("JOINT", "revolute")));
    let ball = chain.replace("JOINT, axis: [1, 2, 0]", "spherical");
    assert!(!symmetric(&ball));
}

#[test]
fn every_turned_sign_is_found() {
    let robot = golden::robot("scara4");
    let model = checked_methods(&robot, &methods(&robot), "scara4");
    every_turned_sign_is_refused(&model, |function, k| match function.shape() {
        Shape::Checked(_) => k >= robot.nv(),
        _ => true,
    });
}

#[test]
fn what_lacks_parameters_says_why() {
    let why = |robot: &Robot, name: &str| Method::named(robot.graph, name).expect_err("no method");
    let arm = golden::robot("puma560");
    let found = why(&arm, "run_time_parameter_derivatives");
    assert!(found.contains("no run-time parameters"), "{found}");
    let (name, text) = quick_loops().swap_remove(0);
    let found = why(&Robot::read(&text, Some(&name)), "parameter_derivatives");
    assert!(found.contains("has no regressors"), "{found}");
}

/// Multiplications and additions by robot, before loops and blocks: second derivatives of l·τ and of τ, by base
/// parameters.
const COUNTS: [(&str, [usize; 3]); 6] = [
    ("scara_rrpr", [142, 118, 205]),
    ("stanford_gen", [3028, 3221, 2457]),
    ("puma_gen", [3501, 3923, 2768]),
    ("ur5_gen", [2751, 2755, 2447]),
    ("panda_gen", [6164, 8791, 4604]),
    ("iiwa_gen", [5737, 7203, 4448]),
];

#[test]
fn counts_do_not_grow() {
    let by_base = Method::ParameterDerivatives(ParameterDerivatives::Base);
    let found = COUNTS.map(|(name, _)| {
        let robot = golden::robot(name);
        (name, counted(&robot, [CURVATURE, SECOND, by_base]))
    });
    assert_eq!(found, COUNTS);
}
