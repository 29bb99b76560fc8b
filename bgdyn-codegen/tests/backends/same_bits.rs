//! Generated C, compiled and run, has the bits of the evaluator.

use std::fs;
use std::path::Path;

use bgdyn_codegen::backend::{BackendInput, GivenOptions, backend_named};
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::{pipeline, read};

use crate::c_program::{compile, compilers, run};
use crate::values::{CNumber, expected, state};

/// States of each mechanism.
const STATES: usize = 64;

fn model(path: &str, options: &Options) -> Model {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let path = root.join(path);
    let text = fs::read_to_string(&path).expect("a spec");
    let stem = path.file_stem().expect("a file").to_string_lossy();
    let (mechanism, _) = read(&text, Some(&stem));
    pipeline::model(mechanism.expect("sound"), options).expect("known names")
}

fn selected(names: &[&str]) -> Options {
    Options {
        methods: Some(names.iter().map(ToString::to_string).collect()),
        ..Options::default()
    }
}

/// Fails unless every function of the model has the evaluator's bits, in every entry of every state.
fn check<T: CNumber>(name: &str, model: &Model, options: &[(&str, &str)]) {
    if cfg!(target_feature = "fma") {
        println!("skipped: Rust fuses products and sums in this build, C is compiled without");
        return;
    }
    let backend = backend_named("c").expect("a backend");
    let pairs = options
        .iter()
        .map(|(name, value)| (name.to_string(), value.to_string()));
    let pairs = pairs.chain([("float".to_string(), T::NAME.to_string())]);
    let given = GivenOptions::new("a test".into(), "c", backend.options(), pairs).expect("options");
    let files = backend
        .files(&BackendInput::Mechanism(model), &given)
        .expect("files");
    let mut random = Random(20_261_127);
    let reach = |k: usize| [3.0, 3.0, 100.0, 0.0][k % 4];
    let states: Vec<_> = (0..STATES)
        .map(|k| state::<T>(&mut random, model, reach(k)))
        .collect();
    let nv = model.mechanism.nv();
    let sizes: Vec<usize> = model
        .functions
        .iter()
        .map(|f| expected(f, nv, &states[0]).values.len())
        .collect();
    for compiler in compilers() {
        let program = compile::<T>(compiler, name, &files, model, &sizes);
        let found = run(&program, &states);
        assert_eq!(found.len(), states.len(), "{compiler}: {name}");
        for (state, found) in states.iter().zip(found) {
            let mut found = found.into_iter();
            for function in &model.functions {
                let expected = expected(function, nv, state);
                let what = || format!("{compiler}: {name}: {}\n{state:?}", function.name());
                assert_eq!(
                    found.next(),
                    Some(i128::from(expected.status)),
                    "{}",
                    what()
                );
                for (k, value) in expected.values.into_iter().enumerate() {
                    let found = found.next().expect("an entry");
                    let found = T::of_bits(u64::try_from(found).expect("a word"));
                    let equal = found.equals(value);
                    assert!(equal, "entry {k}: {found:?} for {value:?}, {}", what());
                }
            }
            assert_eq!(found.next(), None);
        }
    }
}

/// Mechanisms with every kind of joint that a tree can have, with their derivatives where they can be written.
const MECHANISMS: [&str; 12] = [
    "specs/scara.yaml",
    "specs/puma560.yaml",
    "specs/double_pendulum.yaml",
    "specs/gantry.yaml",
    "specs/two_masses.yaml",
    "specs/spring_pendulum.yaml",
    "specs/torso.yaml",
    "tests/golden/joints/helical_universal_test.yaml",
    "tests/golden/joints/spherical_chain3.yaml",
    "tests/golden/joints/quadrotor_arm.yaml",
    "tests/golden/specs/chain8.yaml",
    "tests/free_joints/boom.yaml",
];

#[test]
fn mechanisms_in_double() {
    for path in MECHANISMS {
        check::<f64>(&name(path), &model(path, &Options::default()), &[]);
    }
}

#[test]
fn mechanisms_in_float() {
    for path in MECHANISMS {
        check::<f32>(&name(path), &model(path, &Options::default()), &[]);
    }
}

fn name(path: &str) -> String {
    path.replace(['/', '.'], "_")
}

/// Derivatives of forward dynamics: loops over columns.
#[test]
fn columns() {
    let options = Options {
        derivatives: true,
        ..selected(&[
            "inverse_dynamics_derivatives",
            "forward_dynamics_derivatives",
        ])
    };
    let mut loops = 0;
    for path in ["specs/scara.yaml", "specs/ur5.yaml", "specs/panda.yaml"] {
        let model = model(path, &options);
        loops += model.functions.iter().filter(|f| f.loops.is_some()).count();
        check::<f64>(&format!("{}_derivatives", name(path)), &model, &[]);
    }
    assert!(loops > 0, "none of them has loops over columns");
}

/// A long mass matrix: blocks, and tables of inner products.
#[test]
fn blocks_and_products() {
    let path = "tests/golden/specs/chain32.yaml";
    let options = Options {
        frames: Some(Vec::new()),
        ..selected(&["inverse_dynamics", "mass_matrix", "forward_dynamics"])
    };
    let model = model(path, &options);
    let blocks = |f: &bgdyn_codegen::function::Function| f.blocks.len();
    assert!(model.functions.iter().map(blocks).max() > Some(1));
    let has_products = |f: &bgdyn_codegen::function::Function| {
        f.blocks.iter().any(|block| !block.products.is_empty())
    };
    assert!(model.functions.iter().any(has_products));
    check::<f64>("chain32", &model, &[]);
    check::<f32>("chain32", &model, &[]);
}

/// Run-time parameters, which the caller sets.
#[test]
fn run_time_parameters() {
    for path in [
        "tests/numeric/specs/puma_payload.yaml",
        "tests/scalars/specs/lifter.yaml",
    ] {
        let model = model(path, &Options::default());
        assert!(!model.mechanism.parameters().is_empty(), "{path}");
        check::<f64>(&name(path), &model, &[]);
        check::<f32>(&name(path), &model, &[]);
    }
}
