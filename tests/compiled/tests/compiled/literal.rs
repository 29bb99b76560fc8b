//! Checks that compiled code in `f64` equals equation (6), evaluated term by term in double-double, to
//! 1e-15 of a size that no term exceeds.

use bgdyn_codegen::formulation::{self, Prepared};
use bgdyn_codegen::method::{Method, Shape};
use bgdyn_runtime::Dd;
use compiled::Compiled;

use crate::agreement::generated;
use crate::common::rng::Rng;
use crate::common::{Robot, State, assert_close, full, natural_size};

/// Largest number of joints for which the graph of the literal sum is small enough.
const JOINTS: usize = 8;
/// Tolerance, relative to natural size.
const ROUNDED: f64 = 1e-15;
const STATES: usize = 20;

fn is_equation_six(compiled: &dyn Compiled<f64>) -> bool {
    let origin = compiled.origin();
    let text = std::fs::read_to_string(origin.spec).expect("a spec");
    let robot = Robot::read(&text, Some(origin.name));
    let literal = formulation::by_name("literal").expect("the specification");
    if robot.nv() > JOINTS {
        return false;
    }
    let prepared = Prepared::new(robot.graph);
    let mut rng = Rng::new(6);
    let states: Vec<State> = (0..STATES)
        .map(|_| State::random(&mut rng, &robot.motions()))
        .collect();
    for (number, function) in generated(compiled).functions.iter().enumerate() {
        let (method, shape) = (function.method, function.shape());
        if matches!(method, Method::Regressor(_)) {
            continue; // compared with equation (6) before it is written
        }
        let Some(wanted) = literal.function(&prepared, method) else {
            continue; // derived from the others
        };
        if shape.checked() {
            continue; // its error grows with the mass matrix's condition: see the laws
        }
        for s in &states {
            let state = compiled::State {
                q: s.q.clone(),
                v: s.v.clone(),
                a: s.a.clone(),
                tau: s.tau.clone(),
            };
            let found = compiled.run(number, &state).expect("no error is possible");
            let mut wanted: Vec<Dd> = s.value(&wanted);
            if shape == Shape::Symmetric {
                wanted = full(&wanted, robot.nv()).concat();
            }
            let found: Vec<Dd> = found.into_iter().map(Dd::from_f64).collect();
            let tolerance = ROUNDED * natural_size(&robot, s, method);
            assert_close(&found, &wanted, tolerance, || {
                format!("{}, {}\n{s:?}", origin.name, function.name())
            });
        }
    }
    true
}

#[test]
fn compiled_code_is_equation_six() {
    let models = compiled::all::<f64>();
    let compared = models.iter().filter(|m| is_equation_six(&***m)).count();
    assert!(compared >= 28, "{compared}");
}
