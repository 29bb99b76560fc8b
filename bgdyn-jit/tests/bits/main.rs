//! Tests that machine code has the bits of the evaluator, where the tape's tests compare: every method of the mechanisms
//! and every function of the scenes in the repository (one of three of them in the usual run), and random functions, in
//! random states, at large angles, with refused pivots, NaN and infinities.

#[path = "../../../bgdyn-codegen/tests/tape/agreement.rs"]
mod agreement;
#[path = "../../../bgdyn-codegen/tests/tape/files.rs"]
#[allow(dead_code, reason = "other tests need more of it")]
mod files;
#[path = "../../../bgdyn-codegen/tests/tape/functions.rs"]
mod functions;
mod fused;
#[path = "../../../bgdyn-codegen/tests/tape/random_functions.rs"]
mod random_functions;
/// What the generator's tests have, of which these need the random numbers.
#[path = "../../../bgdyn-codegen/tests/common"]
#[allow(dead_code, reason = "other tests need more of them")]
mod common {
    pub mod rng;
}

use agreement::{KINDS, Seen, agree, states};
use bgdyn_codegen::engine::{CallArguments, Callable};
use bgdyn_codegen::function::Function;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_jit::Jit;
use common::rng::Rng;
use functions::{functions, scene_functions};

/// Machine code that is compared, and how many states it computed without the tape.
struct Comparison {
    jit: Jit,
    seen: Seen,
    alone: usize,
}

impl Comparison {
    fn new() -> Self {
        Comparison {
            jit: Jit::new().expect("machine code on this machine"),
            seen: Seen::default(),
            alone: 0,
        }
    }

    /// As [`Comparison::new`], with code that is made quickly.
    fn quick() -> Self {
        let all = Comparison::new();
        let jit = all.jit.making_quickly();
        Comparison { jit, ..all }
    }

    fn compare(&mut self, name: &str, function: &Function, scene: Option<&SceneEquations>) {
        let code = self.jit.compile(function).expect("machine code");
        agree(&code, name, function, scene, &mut self.seen);
        let mut out = vec![0.0; code.results()];
        self.alone += states(function, scene)
            .filter(|at| code.call_alone(&CallArguments::from(at), &mut out))
            .count();
    }

    /// Fails if the tape computed states that it was not needed for.
    fn assert_seldom_by_tape(&self) {
        let Comparison { seen, alone, .. } = self;
        println!("{seen:?}, {alone} without the tape");
        // Two states of 16 have large angles, and some finite results come with a refused pivot.
        let usual = seen.finite.saturating_sub(seen.refused);
        assert!(4 * alone > 3 * usual, "{alone} of {usual} without the tape");
    }
}

#[test]
fn methods_of_every_mechanism_have_the_bits_of_the_evaluator() {
    // Every other mechanism with code that is made quickly.
    let part = |mut all: Comparison, first: usize| {
        for (name, mechanism) in files::some_of(files::mechanisms(), 1)
            .skip(first)
            .step_by(2)
        {
            for function in functions(&mechanism, None) {
                all.compare(&format!("{name}: {}", function.name), &function, None);
            }
        }
        all.assert_seldom_by_tape();
        all.seen
    };
    let seen = std::thread::scope(|scope| {
        let quick = scope.spawn(|| part(Comparison::quick(), 1));
        let mut seen = part(Comparison::new(), 0);
        seen.add(quick.join().expect("the other half"));
        seen
    });
    assert!(seen.functions > 250 && seen.refused > 150, "{seen:?}");
    assert!(seen.finite > seen.calls / 4, "{seen:?}");
    assert!(
        seen.cut > 3 && seen.products > 0 && seen.looped > 1,
        "{seen:?}"
    );
}

#[test]
fn functions_of_every_scene_have_the_bits_of_the_evaluator() {
    let mut all = Comparison::new();
    for (name, system) in files::some_of(files::scenes(), 0) {
        for function in scene_functions(&system) {
            let name = format!("{name}: {}", function.name);
            all.compare(&name, &function, Some(&system));
        }
    }
    all.assert_seldom_by_tape();
    let seen = all.seen;
    assert!(seen.functions > 100 && seen.refused > 5, "{seen:?}");
    seen.assert_has(&KINDS);
}

#[test]
fn random_functions_have_the_bits_of_the_evaluator() {
    for mut all in [Comparison::new(), Comparison::quick()] {
        for seed in 0..150 {
            let function = random_functions::random(&mut Rng::new(seed));
            all.compare(&format!("seed {seed}"), &function, None);
        }
        let Comparison { seen, alone, .. } = &all;
        println!("{seen:?}, {alone} without the tape");
        assert!(seen.refused > 300 && *alone > 500, "{seen:?}, {alone}");
        seen.assert_has(&KINDS);
    }
}
