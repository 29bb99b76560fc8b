//! Tests that tapes have the bits of the evaluator: every method of the mechanisms and every function of the scenes in
//! the repository, and random functions, in random states, at large angles, with refused pivots, NaN and infinities.

#[path = "../common/allocator.rs"]
mod allocator;

mod agreement;
#[path = "../common/mod.rs"]
mod common;
mod files;
mod functions;
mod other_scalars;
mod random_functions;
mod random_graphs;

use agreement::{KINDS, Seen, agree};
use bgdyn_codegen::engine::{CallArguments, Engine, Status};
use bgdyn_codegen::expr::Inputs;
use bgdyn_codegen::function::Function;
use bgdyn_codegen::method::Method;
use bgdyn_codegen::system::SceneEquations;
use bgdyn_codegen::tape::Tape;
use common::rng::Rng;
use functions::{functions, scene_functions};

/// Compares a function's tape with the evaluator in every scalar.
fn compare(name: &str, function: &Function, scene: Option<&SceneEquations>, seen: &mut Seen) {
    agree(&*Tape.prepare(function), name, function, scene, seen);
    other_scalars::agree(name, function, scene);
}

#[test]
fn tapes_of_every_mechanism_have_the_bits_of_the_evaluator() {
    let mut seen = Seen::default();
    for (name, mechanism) in files::mechanisms() {
        for function in functions(&mechanism, None) {
            let name = format!("{name}: {}", function.name);
            compare(&name, &function, None, &mut seen);
        }
    }
    println!("{seen:?}");
    assert!(seen.functions > 800, "{seen:?}");
    assert!(seen.refused > 500, "{seen:?}");
    assert!(seen.finite > seen.calls / 4, "{seen:?}");
    // Functions in several blocks, with inner products, and with loops over columns.
    assert!(
        seen.cut > 3 && seen.products > 1 && seen.looped > 3,
        "{seen:?}"
    );
}

#[test]
fn tapes_of_other_formulations_have_the_bits_of_the_evaluator() {
    let mut seen = Seen::default();
    let small = files::mechanisms().into_iter().filter(|(_, m)| m.nv() <= 2);
    for (name, mechanism) in files::some_of(small.collect(), 0) {
        for formulation in ["literal", "subspaces"] {
            for function in functions(&mechanism, Some(formulation)) {
                let name = format!("{name}: {} by {formulation}", function.name);
                compare(&name, &function, None, &mut seen);
            }
        }
    }
    assert!(seen.functions > 100, "{seen:?}");
}

#[test]
fn tapes_of_every_scene_have_the_bits_of_the_evaluator() {
    let mut seen = Seen::default();
    for (name, system) in files::scenes() {
        for function in scene_functions(&system) {
            let name = format!("{name}: {}", function.name);
            compare(&name, &function, Some(&system), &mut seen);
        }
    }
    println!("{seen:?}");
    assert!(seen.functions > 300, "{seen:?}");
    assert!(seen.refused > 20, "{seen:?}");
    assert!(seen.finite > seen.calls / 4, "{seen:?}");
    seen.assert_has(&KINDS);
}

/// A status names the refused pivot before a result that is not finite.
#[test]
fn a_status_says_what_failed() {
    let text = files::text("specs/double_pendulum.yaml");
    let (mechanism, _) = bgdyn_codegen::read(&text, Some("double_pendulum"));
    let functions = functions(&mechanism.expect("a sound spec"), None);
    let of = |method| {
        let found = functions.iter().find(|f| f.method == method);
        Tape.prepare(found.expect("a method of every mechanism"))
    };
    let forward = of(Method::ForwardDynamics);
    let status = |q: &[f64], v: &[f64], u: &[f64]| {
        let arguments = CallArguments {
            q,
            v,
            u,
            ..CallArguments::default()
        };
        forward.value(&arguments).1
    };
    assert_eq!(status(&[0.3, 0.5], &[1.0, 2.0], &[3.0, 4.0]), Status::Done);
    assert_eq!(
        status(&[0.3, 0.5], &[1.0, f64::NAN], &[3.0, 4.0]),
        Status::NotFinite(0)
    );
    let refused = status(&[0.3, f64::NAN], &[1.0, 2.0], &[3.0, 4.0]);
    assert!(matches!(refused, Status::Refused(_)), "{refused:?}");
}

/// Each thread has memory of its own.
#[test]
fn calls_from_several_threads_do_not_disturb_each_other() {
    let text = files::text("specs/scara.yaml");
    let (mechanism, _) = bgdyn_codegen::read(&text, Some("scara"));
    let functions = functions(&mechanism.expect("a sound spec"), None);
    let tapes: Vec<_> = functions.iter().map(|f| Tape.prepare(f)).collect();
    let inputs = |seed| {
        let mut rng = Rng::new(seed);
        let mut some = |n: usize| (0..n).map(|_| rng.within(3.0)).collect::<Vec<f64>>();
        Inputs {
            q: some(4),
            v: some(4),
            a: some(4),
            x: some(4),
            modes: some(4),
            // Ten parameters of each body are the longest argument.
            u: some(40),
            ..Inputs::default()
        }
    };
    std::thread::scope(|scope| {
        for thread in 0..4 {
            let (functions, tapes) = (&functions, &tapes);
            scope.spawn(move || {
                for (k, (function, tape)) in
                    functions.iter().zip(tapes).cycle().take(400).enumerate()
                {
                    let at = inputs(1000 * thread + k as u64);
                    let (wanted, _) = function.evaluate(at.clone());
                    assert_eq!(tape.value(&(&at).into()).0, wanted, "{}", function.name);
                }
            });
        }
    });
}
