//! Bundles in C: every field of the struct has the evaluator's bits.

use bgdyn_codegen::model::Model;
use bgdyn_codegen::options::{BundleOption, Options};
use bgdyn_codegen::random::Random;

use crate::c_program::{CCall, CProgram, compile, compilers_for, numbers, run};
use crate::same_bits::{MOMENTA, files, model, name, selected};
use crate::values::{CNumber, close_to, expected, state};

/// States whose results are compared; of further ones the status is.
const STATES: usize = 32;

/// A bundle of a spec: what can be computed without an error, or with accelerations that may not exist.
const BUNDLES: [(&str, &[&str]); 10] = [
    ("specs/puma560.yaml", &MOMENTA),
    (
        "specs/scara.yaml",
        &[
            "mass_matrix",
            "bias",
            "pose_tool",
            "jacobian_world_tool",
            "jacobian_dot_v_world_tool",
        ],
    ),
    (
        "specs/panda.yaml",
        &[
            "forward_dynamics",
            "forward_dynamics_derivatives",
            "inverse_dynamics",
        ],
    ),
    (
        "specs/two_masses.yaml",
        &["kinetic_energy", "forward_dynamics", "potential_energy"],
    ),
    (
        "tests/golden/joints/quadrotor_arm.yaml",
        &["forward_dynamics", "kinetic_energy"],
    ),
    (
        "tests/golden/specs/chain32.yaml",
        &["mass_matrix", "bias", "forward_dynamics"],
    ),
    (
        "tests/numeric/specs/puma_payload.yaml",
        &["inverse_dynamics", "mass_matrix"],
    ),
    (
        "specs/loops/four_bar.yaml",
        &["reactions", "velocity_map", "forward_dynamics"],
    ),
    (
        "specs/scara.yaml",
        &[
            "inverse_dynamics",
            "inverse_dynamics_adjoint",
            "forward_dynamics",
        ],
    ),
    (
        "specs/palletiser.yaml",
        &["forward_dynamics", "forward_dynamics_along"],
    ),
];

fn bundled(path: &str, methods: &[&str]) -> Model {
    let options = Options {
        bundles: vec![BundleOption {
            name: "all_of_it".into(),
            methods: methods.iter().map(ToString::to_string).collect(),
        }],
        ..selected(&["gravity"])
    };
    model(path, &options)
}

fn check<T: CNumber>(path: &str, methods: &[&str]) {
    if cfg!(target_feature = "fma") {
        println!("skipped: Rust fuses products and sums in this build, C is compiled without");
        return;
    }
    let model = bundled(path, methods);
    let bundle = &model.bundles[0];
    let parts: Vec<_> = bundle
        .parts
        .iter()
        .map(|part| bundle.function_of(part))
        .collect();
    let mut random = Random(20_261_129);
    let mut states: Vec<_> = (0..STATES)
        .map(|_| state::<T>(&mut random, &model, 3.0))
        .collect();
    states
        .iter_mut()
        .for_each(|state| close_to(state, &model, &mut random, 0.0));
    // A wild number of each kind: the status says so, whichever part reads it.
    for wild in 0..4 {
        let mut state = states[0].clone();
        let numbers = [&mut state.a, &mut state.u, &mut state.x, &mut state.modes];
        let number = numbers.into_iter().nth(wild).and_then(|x| x.last_mut());
        number.into_iter().for_each(|x| *x = T::from_f64(f64::NAN));
        states.push(state);
    }
    let values = |k: usize| -> Vec<T> {
        parts
            .iter()
            .flat_map(|part| expected(part, &model, &states[k]).values)
            .collect()
    };
    let sizes = [model.mechanism.nq(), model.mechanism.nv()];
    let call = CCall::of(&bundle.function, sizes, values(0).len()).in_struct();
    let program = CProgram::of(&model, vec![call]);
    let rows: Vec<Vec<T>> = states.iter().map(numbers).collect();
    let files = files(&model, &[("float", T::NAME)]);
    for compiler in compilers_for(&files) {
        let folder = format!("{}_bundle", name(path));
        let program = compile::<T>(&compiler, &folder, &files, &program);
        let mut wild = 0;
        for (k, found) in run(&program, &rows).into_iter().enumerate() {
            let checked = parts.iter().filter(|part| part.shape().checked());
            let statuses = checked.map(|part| expected(part, &model, &states[k]).status);
            // A pivot is the same in all parts.
            let statuses: Vec<i64> = statuses.filter(|&status| status != 0).collect();
            let refused = statuses.iter().copied().find(|&status| status > 0);
            let status = refused.or(statuses.first().copied()).unwrap_or_default();
            let mut found = found.into_iter();
            assert_eq!(
                found.next(),
                Some(i128::from(status)),
                "{compiler}: {path}: state {k}"
            );
            if k >= STATES {
                wild += usize::from(status == -1);
                continue;
            }
            for (entry, value) in values(k).into_iter().enumerate() {
                let word = found.next().expect("an entry");
                let word = T::of_bits(u64::try_from(word).expect("a word"));
                assert!(
                    word.equals(value),
                    "{compiler}: {path}: entry {entry}: {word:?} for {value:?}"
                );
            }
            assert_eq!(found.next(), None);
        }
        // This part reads all of them, and is not the first one.
        if methods.last().is_some_and(|name| name.ends_with("_along")) {
            assert_eq!(wild, 4, "{compiler}: {path}");
        }
    }
}

#[test]
fn bundles_in_double() {
    BUNDLES
        .iter()
        .for_each(|(path, methods)| check::<f64>(path, methods));
}

#[test]
fn bundles_in_float() {
    BUNDLES
        .iter()
        .for_each(|(path, methods)| check::<f32>(path, methods));
}
