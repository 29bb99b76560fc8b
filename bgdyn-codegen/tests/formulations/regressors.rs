//! Tests regressors: laws on random trees with noisy numbers, run-time parameters and rotors; their numbers of base
//! parameters; counts of operations.

use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::method::{Method, Regressor};
use bgdyn_codegen::options::Options;
use nalgebra::DMatrix;

use crate::checked::{checked, every_turned_sign_is_refused};
use crate::common::random::Draft;
use crate::common::rng::Rng;
use crate::common::{Robot, golden};

/// Singular values of independent columns are larger than this share of the largest one, others smaller than
/// [`DEPENDENT`].
const INDEPENDENT: f64 = 1e-6;
const DEPENDENT: f64 = 1e-12;

/// A column shorter than this share of the longest one consists of rounding errors.
const ROUNDING: f64 = 1e-15;

fn regressors() -> Options {
    Options {
        methods: Some(Vec::new()),
        identification: true,
        ..Options::default()
    }
}

fn passes(robot: &Robot, what: &str) {
    checked(robot, &regressors(), what);
}

#[test]
fn regressors_of_random_trees_equal_equation_6() {
    let mut rng = Rng::new(101);
    for _ in 0..24 {
        let text = Draft::random(&mut rng, 6).yaml();
        passes(&Robot::read(&text, None), &text);
    }
}

#[test]
fn regressors_of_the_golden_robots_equal_equation_6() {
    for (name, robot) in golden::robots_up_to(8) {
        passes(&robot, &name);
    }
}

/// Joints that follow others: columns that are zero or depend on others in more ways.
#[test]
fn regressors_of_coupled_joints_equal_equation_6() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../specs/constraints");
    let mut checked = 0;
    for entry in std::fs::read_dir(folder).expect("the folder of specs") {
        let path = entry.expect("a file").path();
        let text = std::fs::read_to_string(&path).expect("a spec");
        let robot = Robot::read(&text, path.file_stem().and_then(|stem| stem.to_str()));
        if Method::regressors_of(robot.graph).is_ok() {
            passes(&robot, &path.display().to_string());
            checked += 1;
        }
    }
    assert!(checked > 1, "{checked}");
}

#[test]
fn turned_signs_are_refused() {
    let model = checked(&golden::robot("puma560"), &regressors(), "puma560");
    every_turned_sign_is_refused(&model, |_, k| k % 7 == 0);
}

/// Returns the rank of the columns of all parameters at random states, each scaled to length 1; `None` where axes that are
/// almost parallel leave it unclear in `f64`.
fn rank(robot: &Robot) -> Option<usize> {
    let function = robot.emitted(Method::Regressor(Regressor::Full));
    let (nv, columns) = (robot.nv(), 10 * robot.graph.moving_links().len());
    let states = 2 * columns / nv + 8;
    let mut rng = Rng::new(7);
    let mut rows: Vec<f64> = Vec::new();
    for _ in 0..states {
        let mut any = |size: f64| (0..nv).map(|_| rng.within(size)).collect::<Vec<f64>>();
        let (v, a) = (any(2.0), any(4.0));
        let mut q: Vec<f64> = (robot.graph.positions.iter())
            .map(|_| rng.within(3.0))
            .collect();
        robot.graph.normalize(&mut q);
        rows.extend(
            function
                .evaluate(Inputs {
                    q,
                    v,
                    a,
                    ..Inputs::default()
                })
                .0,
        );
    }
    let mut all = DMatrix::from_row_slice(states * nv, columns, &rows);
    let longest = all.column_iter().map(|c| c.norm()).fold(0.0, f64::max);
    let mut unclear = false;
    for mut column in all.column_iter_mut() {
        let length = column.norm() / longest;
        // A column of rounding errors is zero.
        let is_zero = length < ROUNDING;
        unclear |= !is_zero && length < INDEPENDENT;
        column *= if is_zero { 0.0 } else { 1.0 / length };
    }
    let values = all.singular_values();
    let shares: Vec<f64> = values.iter().map(|x| x / values[0]).collect();
    unclear |= (shares.iter()).any(|x| (DEPENDENT..INDEPENDENT).contains(x));
    let kept = shares.iter().filter(|x| **x >= INDEPENDENT);
    (!unclear).then_some(kept.count())
}

#[test]
fn as_many_base_parameters_as_independent_columns() {
    let specs = std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../specs"));
    let specs = specs.expect("the folder of specs").filter_map(Result::ok);
    let files = specs.map(|entry| entry.path());
    let own = files.filter(|path| path.extension().is_some_and(|e| e == "yaml"));
    let own = own.map(|path| {
        let text = std::fs::read_to_string(&path).expect("a spec");
        let stem = path.file_stem().and_then(|stem| stem.to_str());
        (path.display().to_string(), Robot::read(&text, stem))
    });
    let trees = own.filter(|(_, robot)| Method::regressors_of(robot.graph).is_ok());
    let mut checked = 0;
    for (name, robot) in trees.chain(golden::robots_up_to(8)) {
        let base = robot.emitted(Method::Regressor(Regressor::BaseParameters));
        assert_eq!(Some(base.output_count()), rank(&robot), "{name}");
        checked += 1;
    }
    assert!(checked > 20, "{checked}");
}

/// Multiplications and additions by robot, before loops and blocks: base regressor, that of two velocities, Y_bᵀ s, all
/// parameters.
const COUNTS: [(&str, [usize; 4]); 6] = [
    ("scara_rrpr", [59, 61, 62, 68]),
    ("stanford_gen", [535, 587, 372, 598]),
    ("puma_gen", [626, 678, 443, 723]),
    ("ur5_gen", [519, 570, 425, 599]),
    ("panda_gen", [1087, 1159, 522, 1303]),
    ("iiwa_gen", [1003, 1075, 489, 1146]),
];

#[test]
fn counts_do_not_grow() {
    let methods = [
        Regressor::Base,
        Regressor::Adaptive,
        Regressor::TransposedTimes,
        Regressor::Full,
    ];
    for (name, known) in COUNTS {
        let robot = golden::robot(name);
        let counts = methods.map(|of| {
            let operations = robot.emitted(Method::Regressor(of)).operations();
            assert_eq!(operations.div + operations.sqrt, 0);
            operations.mul + operations.add
        });
        assert_eq!(counts, known, "{name}");
    }
}
