//! Sines in registers of four lanes have the bits of those in arrays, both with fused instructions: the arrays' loops have
//! the evaluator's bits without them.

use bgdyn_codegen::options::Options;
use bgdyn_codegen::random::Random;

use crate::c_program::{CCall, CProgram, build, compilers, numbers, run, write};
use crate::same_bits::{files, model, selected};
use crate::values::{CNumber, expected, state};

/// States of each mechanism.
const STATES: usize = 200;

/// Near angles, and angles beyond 10⁵ rad, beside each other and alone.
#[test]
fn sines_in_lanes() {
    if !has_lanes() {
        println!("skipped: the processor has no AVX2 with FMA");
        return;
    }
    let of_torso = selected(&["inverse_dynamics", "mass_matrix"]);
    for (arm, options) in [
        ("scara", Options::default()),
        ("puma560", Options::default()),
        ("panda", Options::default()),
        ("ur5", Options::default()),
        // More angles than there are lanes.
        ("torso", of_torso),
    ] {
        let model = model(&format!("specs/{arm}.yaml"), &options);
        let mut random = Random(20_261_130);
        let states = (0..STATES).map(|k| {
            let mut state = state::<f64>(&mut random, &model, [3.0, 100.0, 2e5, 1e9][k % 4]);
            if k % 8 == 0 {
                let at = k / 8 % state.q.len();
                state.q[at] = [f64::NAN, 3e5, 99_999.0][k / 8 % 3];
            }
            state
        });
        let states: Vec<_> = states.collect();
        let sizes = [model.mechanism.nq(), model.mechanism.nv()];
        let size = |f| expected(f, &model, &states[0]).values.len();
        let functions = model.functions.iter().filter(|f| size(f) > 0);
        let calls = functions.map(|f| CCall::of(f, sizes, size(f)));
        let program = CProgram::of(&model, calls.collect());
        let rows: Vec<Vec<f64>> = states.iter().map(numbers).collect();
        let without = format!("-D{}_NO_LANES", arm.to_uppercase());
        for compiler in compilers() {
            let found = [&["-mavx2", "-mfma"][..], &["-mavx2", "-mfma", &without]].map(|flags| {
                let folder = format!("lanes_{arm}_{compiler}_{}", flags.len());
                let folder = write(&folder, &files(&model, &[]));
                let program = build(
                    &compiler,
                    &folder,
                    &program.file,
                    &program.text::<f64>(),
                    flags,
                );
                run(&program, &rows)
            });
            let [in_lanes, in_arrays] = &found;
            assert_eq!(in_lanes.len(), STATES);
            for ((lanes, arrays), state) in in_lanes.iter().zip(in_arrays).zip(&states) {
                assert_eq!(lanes.len(), arrays.len());
                for (&lane, &array) in lanes.iter().zip(arrays) {
                    let is_nan = |word| u64::try_from(word).is_ok_and(|w| f64::of_bits(w).is_nan());
                    let is_same = lane == array || is_nan(lane) && is_nan(array);
                    assert!(is_same, "{compiler}: {arm}\n{state:?}");
                }
            }
        }
    }
}

#[cfg(target_arch = "x86_64")]
fn has_lanes() -> bool {
    std::is_x86_feature_detected!("avx2") && std::is_x86_feature_detected!("fma")
}

#[cfg(not(target_arch = "x86_64"))]
fn has_lanes() -> bool {
    false
}
