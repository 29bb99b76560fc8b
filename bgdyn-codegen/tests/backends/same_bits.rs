//! Generated C, compiled and run, has the bits of the evaluator.

use std::fs;
use std::path::Path;

use bgdyn_codegen::backend::{BackendInput, GeneratedFile, GivenOptions, backend_named};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::Options;
use bgdyn_codegen::random::Random;
use bgdyn_codegen::{read, selection};

use crate::c_program::{CCall, CProgram, compile, compilers_for, numbers, run};
use crate::values::{CNumber, Expected, close_to, expected, state};

/// States of each mechanism.
const STATES: usize = 64;

/// Returns the model of a spec in the repository.
pub fn model(path: &str, options: &Options) -> Model {
    let (text, stem) = text_of(path);
    model_of(&text, &stem, options)
}

pub fn model_of(text: &str, stem: &str, options: &Options) -> Model {
    let (mechanism, faults) = read(text, Some(stem));
    let mechanism = mechanism.unwrap_or_else(|| panic!("{stem}: {faults:?}"));
    selection::model(mechanism, options).expect("known names")
}

/// Returns the text of a spec, and the stem of its file.
pub fn text_of(path: &str) -> (String, String) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let path = root.join(path);
    let text = fs::read_to_string(&path).expect("a spec");
    let stem = path.file_stem().expect("a file").to_string_lossy();
    (text, stem.into_owned())
}

/// Returns options for these methods.
pub fn selected(names: &[&str]) -> Options {
    Options {
        methods: Some(names.iter().map(ToString::to_string).collect()),
        ..Options::default()
    }
}

/// Fails unless every function of the model has the evaluator's bits, in every entry of every state.
pub fn check<T: CNumber>(name: &str, model: &Model) {
    let reaches = [3.0, 3.0, 100.0, 0.0];
    compare::<T>(name, model, &[], &reaches, &|found, value, _| {
        found.equals(value)
    });
}

/// Fails unless every entry of every function is the evaluator's, by `is_same` of both and of the function's largest
/// entry. Positions reach as far as one of `reaches`.
fn compare<T: CNumber>(
    name: &str,
    model: &Model,
    options: &[(&str, &str)],
    reaches: &[f64],
    is_same: &dyn Fn(T, T, f64) -> bool,
) {
    if cfg!(target_feature = "fma") {
        println!("skipped: Rust fuses products and sums in this build, C is compiled without");
        return;
    }
    let files = files(model, &[options, &[("float", T::NAME)]].concat());
    let mut random = Random(20_261_127);
    let reach = |k: usize| reaches[k % reaches.len()];
    let mut states: Vec<_> = (0..STATES)
        .map(|k| state::<T>(&mut random, model, reach(k)))
        .collect();
    for (k, state) in states.iter_mut().enumerate().filter(|(k, _)| k % 4 != 3) {
        close_to(
            state,
            model,
            &mut random,
            if k % 4 == 0 { 0.0 } else { 0.1 },
        );
    }
    let sizes = [model.mechanism.nq(), model.mechanism.nv()];
    let size = |f: &Function| expected(f, model, &states[0]).values.len();
    let functions: Vec<&Function> = model.functions.iter().filter(|f| size(f) > 0).collect();
    let calls = functions.iter().map(|f| CCall::of(f, sizes, size(f)));
    let program = CProgram::of(model, calls.collect());
    let rows: Vec<Vec<T>> = states.iter().map(numbers).collect();
    for compiler in compilers_for(&files) {
        let program = compile::<T>(&compiler, name, &files, &program);
        let found = run(&program, &rows);
        assert_eq!(found.len(), states.len(), "{compiler}: {name}");
        for (state, found) in states.iter().zip(found) {
            let what = |f: &Function| format!("{compiler}: {name}: {}\n{state:?}", f.name());
            let mut found = found.into_iter();
            for function in &functions {
                let Expected { status, values } = expected(function, model, state);
                let status = Some(i128::from(status));
                assert_eq!(found.next(), status, "{}", what(function));
                let size = values.iter().fold(0.0_f64, |size, x| size.max(x.size()));
                for (k, value) in values.into_iter().enumerate() {
                    let word = found.next().expect("an entry");
                    let found = T::of_bits(u64::try_from(word).expect("a word"));
                    let equal = is_same(found, value, size);
                    assert!(
                        equal,
                        "entry {k}: {found:?} for {value:?}, {}",
                        what(function)
                    );
                }
            }
            assert_eq!(found.next(), None);
        }
    }
}

/// Returns the C files of a model.
pub fn files(model: &Model, options: &[(&str, &str)]) -> Vec<GeneratedFile> {
    let backend = backend_named("c").expect("a backend");
    let pairs = options.iter();
    let pairs = pairs.map(|(name, value)| (name.to_string(), value.to_string()));
    let given = GivenOptions::new("a test".into(), "c", backend.options(), pairs);
    let input = BackendInput::Mechanism(model);
    let files = backend.files(&input, &given.expect("options that exist"));
    files.expect("a mechanism that C can have")
}

/// Mechanisms with every kind of joint that a tree can have, with their derivatives where they can be written.
const MECHANISMS: [&str; 17] = [
    "specs/stanford.yaml",
    "specs/constraints/gear_pair.yaml",
    "specs/constraints/mimic_gripper.yaml",
    "tests/golden/joints/planar_base_ur5.yaml",
    "tests/golden/joints/satellite_arm6.yaml",
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
        check::<f64>(&name(path), &model(path, &Options::default()));
    }
}

#[test]
fn mechanisms_in_float() {
    for path in MECHANISMS {
        check::<f32>(&name(path), &model(path, &Options::default()));
    }
}

pub fn name(path: &str) -> String {
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
        check::<f64>(&format!("{}_derivatives", name(path)), &model);
    }
    assert!(loops > 0, "none of them has loops over columns");
}

/// Names of the centroidal methods, and the rate of the mass matrix.
pub const MOMENTA: [&str; 6] = [
    "centre_of_mass",
    "com_jacobian",
    "centroidal_map",
    "centroidal_momentum",
    "centroidal_bias",
    "mass_matrix_rate",
];

/// Momenta of trees, of a base with wheels, and with run-time masses, which are divided by.
#[test]
fn momenta() {
    for path in [
        "specs/scara.yaml",
        "specs/panda.yaml",
        "specs/constraints/differential_drive.yaml",
        "tests/golden/joints/quadrotor_arm.yaml",
        "tests/numeric/specs/puma_payload.yaml",
    ] {
        let model = model(path, &selected(&MOMENTA));
        check::<f64>(&format!("{}_momenta", name(path)), &model);
        check::<f32>(&format!("{}_momenta", name(path)), &model);
    }
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
    let blocks = |f: &Function| f.blocks.len();
    assert!(model.functions.iter().map(blocks).max() > Some(1));
    let has_products = |f: &Function| f.blocks.iter().any(|block| !block.products.is_empty());
    assert!(model.functions.iter().any(has_products));
    check::<f64>("chain32", &model);
    check::<f32>("chain32", &model);
}

/// Run-time parameters, which the caller sets.
#[test]
fn run_time_parameters() {
    for path in [
        "specs/constraints/carousel.yaml",
        "tests/numeric/specs/puma_payload.yaml",
        "tests/scalars/specs/lifter.yaml",
    ] {
        let model = model(path, &Options::default());
        assert!(!model.mechanism.parameters().is_empty(), "{path}");
        check::<f64>(&name(path), &model);
        check::<f32>(&name(path), &model);
    }
}

/// Far angles are reduced exactly, by integers, as in Rust.
#[test]
fn far_angles() {
    let arm = model(
        "specs/puma560.yaml",
        &selected(&["inverse_dynamics", "mass_matrix"]),
    );
    let reaches = [2e4, 1e7, 1e20, 3e38];
    compare::<f32>("far_puma", &arm, &[], &reaches, &|found, value, _| {
        found.equals(value)
    });
    let reaches = [2e5, 1e7, 1e20, 1e100, 1.7e308];
    compare::<f64>("far_puma", &arm, &[], &reaches, &|found, value, _| {
        found.equals(value)
    });
}

/// The option `libm`: sines of libm differ in the last place.
#[test]
fn sines_of_libm() {
    let arm = model("specs/scara.yaml", &Options::default());
    let is_near = |found: f64, value: f64, size: f64| (found - value).abs() <= 1e-12 * size;
    compare::<f64>("libm", &arm, &[("sincos", "libm")], &[3.0, 0.0], &is_near);
    let is_near =
        |found: f32, value: f32, size: f64| f64::from((found - value).abs()) <= 1e-4 * size;
    compare::<f32>("libm", &arm, &[("sincos", "libm")], &[3.0, 0.0], &is_near);
}

/// A broken encoder is no singular position.
#[test]
fn positions_that_are_not_numbers() {
    for path in ["specs/scara.yaml", "specs/panda.yaml"] {
        let model = model(path, &selected(&["forward_dynamics"]));
        let [nq, nv] = [model.mechanism.nq(), model.mechanism.nv()];
        let call = CCall::of(&model.functions[0], [nq, nv], nv);
        let program = CProgram::of(&model, vec![call]);
        let mut random = Random(20_261_130);
        let broken = (0..nq).map(|k| {
            let mut state = state::<f64>(&mut random, &model, 3.0);
            state.q[k] = f64::NAN;
            numbers(&state)
        });
        let rows: Vec<Vec<f64>> = broken.collect();
        let files = files(&model, &[]);
        for compiler in compilers_for(&files) {
            let folder = format!("{}_broken", name(path));
            let program = compile::<f64>(&compiler, &folder, &files, &program);
            for (k, found) in run(&program, &rows).iter().enumerate() {
                // Neither of the SCARA's first angle nor of the height of its quill depends anything.
                let is_read = found[1..]
                    .iter()
                    .any(|word| f64::from_bits(*word as u64).is_nan());
                assert_eq!(
                    found[0],
                    -i128::from(is_read),
                    "{compiler}: {path}: position {k}"
                );
            }
        }
    }
}
