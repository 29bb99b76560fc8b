//! Tests second derivatives of l·τ and derivatives of the accelerations by parameters: equal to equation (6) on random
//! trees, joints of every type, loops and constraints; refusals; counts of operations.

use bgdyn_codegen::method::{Directional, Method, ParameterDerivatives, Shape};
use bgdyn_codegen::options::Options;

use crate::checked::{checked, every_turned_sign_is_refused, of_folder, quick_loops};
use crate::common::random::Draft;
use crate::common::rng::Rng;
use crate::common::{Robot, golden};

const CURVATURE: Method = Method::Directional(Directional::InverseCurvature);

fn methods(robot: &Robot) -> Vec<Method> {
    let all = Method::possible_of(robot.graph).into_iter();
    let of_this =
        |method: &Method| *method == CURVATURE || matches!(method, Method::ParameterDerivatives(_));
    all.filter(of_this).collect()
}

fn options(robot: &Robot) -> Options {
    let sites = &robot.graph.sites;
    let names = methods(robot).into_iter().map(|method| method.name(sites));
    Options {
        methods: Some(names.collect()),
        ..Options::default()
    }
}

fn passes(robot: &Robot, what: &str) -> Vec<Method> {
    let all = methods(robot);
    if !all.is_empty() {
        let model = checked(robot, &options(robot), what);
        assert_eq!(model.functions.len(), all.len(), "{what}");
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

/// Run-time parameters: masses, places, lengths.
#[test]
fn specs_with_run_time_parameters_equal_equation_6() {
    let mut with = 0;
    let folders = [
        "specs",
        "specs/loops",
        "tests/scalars/specs",
        "tests/numeric/specs",
    ];
    for (name, text) in folders.into_iter().flat_map(of_folder) {
        if text.contains("parameter:") {
            let all = passes(&Robot::read(&text, Some(&name)), &name);
            let run_time = |method: &Method| {
                let of = ParameterDerivatives::RunTime;
                matches!(method, Method::ParameterDerivatives(found) if *found != ParameterDerivatives::Base
                    && *found != of(0))
            };
            with += usize::from(all.iter().any(run_time));
        }
    }
    assert!(with > 0);
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
        assert!(passes(&Robot::read(&text, Some(&name)), &name).contains(&CURVATURE));
    }
    for (name, text) in of_folder("specs/constraints") {
        passes(&Robot::read(&text, Some(&name)), &name);
    }
}

#[test]
fn every_turned_sign_is_found() {
    let robot = golden::robot("scara4");
    let model = checked(&robot, &options(&robot), "scara4");
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

/// Multiplications and additions by robot, before loops and blocks: second derivatives, by base parameters.
const COUNTS: [(&str, [usize; 2]); 6] = [
    ("scara_rrpr", [142, 205]),
    ("stanford_gen", [3028, 2457]),
    ("puma_gen", [3501, 2768]),
    ("ur5_gen", [2751, 2447]),
    ("panda_gen", [6164, 4604]),
    ("iiwa_gen", [5737, 4448]),
];

#[test]
fn counts_do_not_grow() {
    let by_base = Method::ParameterDerivatives(ParameterDerivatives::Base);
    let counted = COUNTS.map(|(name, _)| {
        let robot = golden::robot(name);
        let counts = [CURVATURE, by_base].map(|method| {
            let operations = robot.emitted(method).operations();
            operations.mul + operations.add
        });
        (name, counts)
    });
    assert_eq!(counted, COUNTS);
}
